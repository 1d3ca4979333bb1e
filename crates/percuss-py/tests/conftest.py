"""What the tests share: the repository as working folder, and the program to compare with."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import matplotlib
import pytest

matplotlib.use("agg")

ROOT = Path(__file__).resolve().parents[3]
CASES = sorted(path.parent.name for path in ROOT.glob("cases/*/scenario.toml"))


def content(path: Path) -> bytes:
    """What a file holds. Ids in figures count the figures that a process has drawn: they are left out."""
    return re.sub(rb"kuva-clip-\d+", b"kuva-clip", path.read_bytes())


def of_arguments(printed: str) -> str:
    """What the program prints, about arguments of functions in place of options."""
    text = printed.removesuffix("For more information, try '--help'.\n").rstrip()
    return re.sub(r"'--([a-z-]+)[^']*'", lambda option: f"`{option[1].replace('-', '_')}`", text, count=1)


Program = Callable[..., subprocess.CompletedProcess[str]]


@pytest.fixture(autouse=True)
def in_repository(monkeypatch: pytest.MonkeyPatch) -> None:
    """Paths of cases are those of the documentation."""
    monkeypatch.chdir(ROOT)


@pytest.fixture(scope="session")
def program() -> Program:
    """Runs the program: the one that cargo built where PERCUSS_PROGRAM names it, otherwise the command of the wheel."""
    command = os.environ.get("PERCUSS_PROGRAM") or str(Path(sys.executable).with_name("percuss"))

    def run(*words: str | os.PathLike[str]) -> subprocess.CompletedProcess[str]:
        line = [str(ROOT / command), *map(str, words)]
        return subprocess.run(line, capture_output=True, text=True, cwd=ROOT, timeout=120)

    return run
