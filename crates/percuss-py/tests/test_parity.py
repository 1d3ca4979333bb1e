"""Everything that the program can do is there in Python, with the same names: a new command or option asks for its row here."""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable
from typing import Any

import percuss
import pytest
from conftest import ROOT, Program

PAGE = (ROOT / "docs/reference/python-commands.md").read_text(encoding="utf-8")


def rows(heading: str) -> list[list[str]]:
    """Cells of the table under a heading of the page."""
    section = PAGE.split(f"\n## {heading}\n")[1].split("\n## ")[0]
    lines = [line for line in section.splitlines() if line.startswith("|")][2:]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]


def code(cell: str) -> list[str]:
    """What stands in backticks."""
    return re.findall(r"`([^`]+)`", cell)


# Commands to what they are in Python, and why some are not.
COMMANDS = {code(command)[0]: there for command, there in rows("Command by command")}
# Options that stand for something else in Python, by command; `all` is every command.
OPTIONS = {(code(cell)[0], option) for cell, options, _ in rows("Options that are something else") for option in code(options)}


def commands(program: Program, *words: str) -> list[tuple[str, ...]]:
    """All commands and their own commands, as the help names them."""
    text = program(*words, "--help").stdout
    found = re.search(r"^Commands:\n((?:  .*\n)+)", text, re.MULTILINE)
    inner = re.findall(r"^  (\S+)", found[1], re.MULTILINE) if found else []
    return [way for name in inner for way in [(*words, name), *commands(program, *words, name)]]


def options(program: Program, command: tuple[str, ...]) -> list[str]:
    """Long options of a command, as the help names them."""
    found = re.findall(r"^\s+(?:-\w, )?--([a-z][a-z-]*)", program(*command, "--help").stdout, re.MULTILINE)
    return [name for name in found if name != "help"]


def in_python(there: str) -> Callable[..., Any] | property | None:
    """The function, method or property that a cell names."""
    if there.startswith("none: "):
        return None
    names = code(there)
    thing: Any = percuss
    for part in names[0].removesuffix("()").split("."):
        thing = getattr(thing, part)
    assert callable(thing) or isinstance(thing, property), there
    return thing  # type: ignore[no-any-return]


def test_every_command_has_its_counterpart_or_a_reason(program: Program) -> None:
    there = [" ".join(way) for way in commands(program)]
    assert len(there) > 20 and "sweep plot" in there
    assert sorted(there) == sorted(COMMANDS), "the table in docs/reference/python-commands.md lists the commands of the program"
    for command, cell in COMMANDS.items():
        assert in_python(cell) is not None or len(cell) > 20, f"`{command}` has neither a counterpart nor a reason"


@pytest.mark.parametrize("command", COMMANDS)
def test_every_option_has_its_name_in_python(command: str, program: Program) -> None:
    thing = in_python(COMMANDS[command])
    given = options(program, tuple(command.split()))
    if thing is None or isinstance(thing, property):
        assert set(given) <= {"json"} or thing is None
        return
    known = {(where, option.lstrip("-")) for where, option in OPTIONS}
    parameters = inspect.signature(thing).parameters
    missing = [
        name for name in given if name.replace("-", "_") not in parameters and not {("all", name), (command, name)} & known
    ]
    assert not missing, f"`percuss.{getattr(thing, '__name__', thing)}` lacks {missing}"


def test_no_row_is_about_what_is_not_there(program: Program) -> None:
    for command, option in OPTIONS:
        some = [command] if command != "all" else [way for way in COMMANDS if in_python(COMMANDS[way]) is not None]
        assert any(option.lstrip("-") in options(program, tuple(way.split())) for way in some), (command, option)
        for way in some:
            thing = in_python(COMMANDS[way])
            assert not callable(thing) or option.lstrip("-").replace("-", "_") not in inspect.signature(thing).parameters, (way, option)
