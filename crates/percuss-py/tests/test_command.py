"""The wheel installs the program."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import percuss
from conftest import ROOT

COMMAND = Path(sys.executable).with_name("percuss")


def test_the_command_is_the_program(tmp_path: Path) -> None:
    def run(*words: str) -> subprocess.CompletedProcess[str]:
        return subprocess.run([COMMAND, *words], capture_output=True, text=True, cwd=ROOT, timeout=60)

    assert run("--version").stdout == f"percuss {percuss.__version__}\n"
    assert "Exit codes" in run("--help").stdout
    assert run("new", str(tmp_path / "shot")).returncode == 0
    case = tmp_path / "shot/scenario.toml"
    assert "depth of penetration" in run("run", str(case), "--fast").stdout
    case.write_text(case.read_text().replace(' mm"', ' kg"'))
    bad = run("run", str(case))
    assert bad.returncode == 2 and bad.stdout == "" and "unit of mass" in bad.stderr
    assert run("frobnicate").returncode == 2
    assert run("run", "no-such.toml").returncode == 4
    module = [sys.executable, "-m", "percuss", "--version"]
    assert subprocess.run(module, capture_output=True, text=True).stdout == f"percuss {percuss.__version__}\n"


def test_the_web_server_is_left_out_and_says_where_it_is() -> None:
    refused = subprocess.run([COMMAND, "serve", "--port", "0"], capture_output=True, text=True, timeout=60)
    assert refused.returncode == 2 and refused.stdout == ""
    assert "needs the feature `serve`" in refused.stderr and "cargo install" in refused.stderr
    assert "serve" not in subprocess.run([COMMAND, "--help"], capture_output=True, text=True, timeout=60).stdout
