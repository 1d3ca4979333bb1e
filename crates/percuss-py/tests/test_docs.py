"""The examples of the documentation do what they say."""

from __future__ import annotations

import doctest
import importlib
import pkgutil
import runpy
from pathlib import Path

import percuss
import pytest
from conftest import ROOT

MODULES = [module.name for module in pkgutil.iter_modules(percuss.__path__) if not module.name.startswith("_")]
PAGES = [ROOT / "docs/python.md", ROOT / "docs/quick-start.md"]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_the_examples_of_a_page_run(page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Blocks with ``>>>`` run in their order, in a folder that has the cases; the lines below show what is printed."""
    (tmp_path / "cases").symlink_to(ROOT / "cases")
    monkeypatch.chdir(tmp_path)
    names: dict[str, object] = {}
    blocks = python_blocks(page.read_text(encoding="utf-8"))
    assert blocks
    for i, block in enumerate(blocks):
        test = doctest.DocTestParser().get_doctest(block, names, f"{page.name}, block {i}", str(page), 0)
        runner = doctest.DocTestRunner(optionflags=doctest.NORMALIZE_WHITESPACE | doctest.ELLIPSIS)
        said: list[str] = []
        runner.run(test, out=said.append, clear_globs=False)
        names = test.globs
        assert not runner.failures, "".join(said)


def python_blocks(text: str) -> list[str]:
    """Blocks of Python with ``>>>``; others need what a test does not have, a cluster say."""
    blocks: list[str] = []
    inside = False
    for line in text.splitlines():
        if line.startswith("```"):
            inside = line == "```python"
            if inside:
                blocks.append("")
        elif inside:
            blocks[-1] += line + "\n"
    return [block for block in blocks if ">>>" in block]


@pytest.mark.parametrize("module", ["", *MODULES])
def test_the_examples_of_a_module_run(module: str) -> None:
    said: list[str] = []
    runner = doctest.DocTestRunner()
    name = f"percuss.{module}".rstrip(".")
    for test in doctest.DocTestFinder().find(importlib.import_module(name), name, extraglobs={"percuss": percuss}):
        runner.run(test, out=said.append)
    assert not runner.failures, "".join(said)


def test_the_reference_is_what_the_docstrings_say() -> None:
    program = runpy.run_path(str(ROOT / "crates/percuss-py/reference.py"))
    for path, text in (("PAGE", "page"), ("TYPES", "types")):
        assert program[path].read_text(encoding="utf-8") == program[text](), "run `python crates/percuss-py/reference.py`"


def test_every_function_has_an_example() -> None:
    lacking = [name for name in percuss.__all__ if name.islower() and not name.startswith("__")]
    lacking = [name for name in lacking if ">>>" not in (getattr(percuss, name).__doc__ or "")]
    # Their examples go with a folder of rows, on the page about Python, as that of `benchmark`, which takes seconds, is one that runs there.
    assert lacking == ["merge", "plot"]
