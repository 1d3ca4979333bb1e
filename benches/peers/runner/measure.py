"""Whether all programs come to the same end, and how fast they are."""

import array
import math
import os
import statistics
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass

import work
from prepare import BATCH, BATCH_ON_TWO, ONE_POWER, PEERS, TARGET, Missing, Program

REFERENCE = "percuss"
STEPS = 5000
"""Steps of every chain: 24 microseconds, in which the wave crosses both bodies five times and the slower rods come to rest."""

Work = tuple[str, str, int]


@dataclass(frozen=True)
class Timing:
    """Seconds by the clock and of all processors, for work of so many elements times steps, in so many chains or runs."""

    clock: float
    processor: float
    amount: float
    cores: int
    chains: int = 1

    @property
    def rate(self) -> float:
        """Million elements times steps a second: of processor time on one core, which others may share, by the clock on several."""
        return self.amount / (self.processor if self.cores == 1 else self.clock) / 1e6

    @property
    def each(self) -> float:
        """Seconds a chain or run."""
        return self.amount / (self.rate * 1e6) / self.chains

    @property
    def share(self) -> float:
        """The part of its cores that the program had."""
        return self.processor / (self.clock * self.cores)


@dataclass(frozen=True)
class Checked:
    """A program on a kind of work: how far its end is from the reference's, and how fast it was."""

    program: Program
    work: Work
    difference: float
    timing: Timing

    @property
    def agrees(self) -> bool:
        return self.difference <= self.program.tolerance


def run(program: Program, kind: Work, chains: int) -> tuple[Timing, array.array]:
    """Advances chains or computes runs; gives where their masses end [m], or four numbers a run, too."""
    together, law, cores = kind
    problem, end = TARGET / f"{'runs' if law == 'cavity' else 'chains'}_{chains}.txt", TARGET / "end.f64"
    if not problem.exists():
        if law == "cavity":
            work.write_runs(problem, chains)
        else:
            work.write(problem, chains, STEPS)
    end.unlink(missing_ok=True)
    words = [*program.command, str(problem), together, law, str(cores), str(end)]
    seconds = answer(words, program.environment)
    ends = array.array("d", end.read_bytes())
    if sys.byteorder == "big":
        ends.byteswap()
    # Complete runs tell how many steps they took.
    amount = seconds[2] if law == "cavity" else float(chains * STEPS * len(work.springs()))
    return Timing(seconds[0], seconds[1], amount, cores, chains), ends


def answer(words: list[str], environment: dict[str, str]) -> list[float]:
    done = subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=os.environ | environment)
    if done.returncode:
        said = done.stderr.strip().splitlines()
        raise Missing(f"`{' '.join(words)}` failed: {said[-1] if said else 'without a word'}")
    return [float(word) for word in done.stdout.split()]


def check(programs: list[Program], skipped: dict[str, str]) -> list[Checked]:
    """Runs every program on every kind of work that it knows, and compares the ends. What fails joins the programs that are skipped."""
    for old in [*TARGET.glob("chains_*.txt"), *TARGET.glob("runs_*.txt")]:
        old.unlink()
    reference = next(program for program in programs if program.name == REFERENCE)
    checked = []
    for program in programs:
        for kind in program.works:
            _, wanted = run(reference, (*kind[:2], 1), program.chains)
            try:
                timing, ends = run(program, kind, program.chains)
            except Missing as missing:
                skipped[f"{program.name}, {words_of(kind)}"] = missing.why
                print(f"{program.name}, {words_of(kind)}: skipped: {missing.why}", file=sys.stderr)
                continue
            off = difference(wanted, ends, kind[1] == "cavity")
            checked.append(Checked(program, kind, off, timing))
            verdict = "agrees" if checked[-1].agrees else f"DOES NOT AGREE within {program.tolerance:g}: not timed"
            print(f"{program.name}, {words_of(kind)}: {verdict} (off by {off:.1e})", file=sys.stderr)
    return checked


def difference(wanted: array.array, ends: array.array, own: bool) -> float:
    """The largest difference as a part of the largest displacement, or each as a part of its `own` number; infinite where something is no number or missing."""
    if len(wanted) != len(ends) or not all(map(math.isfinite, ends)):
        return math.inf
    if own:
        return max(abs(a - b) / abs(a) for a, b in zip(wanted, ends))
    return max(abs(a - b) for a, b in zip(wanted, ends)) / max(map(abs, wanted))


def words_of(kind: Work) -> str:
    together, law, cores = kind
    if law == "cavity":
        return "complete runs, " + ("batch" if together == "batch" else "one by one")
    law = "power law" if law == "power" else "linear"
    return f"{'batch' if together == 'batch' else 'one chain'}, {law}, {cores} core{'s' if cores > 1 else ''}"


def rounds(checked: list[Checked], count: int, seconds: float) -> dict[tuple[str, Work], list[Timing]]:
    """Times all programs in turn, so many times. Each run takes about as long. What takes ten times as long for one chain is timed by its check alone."""
    slow = [c for c in checked if c.timing.processor > 10 * seconds and c.program.chains == 1]
    plans = [(c, chains_for(c, seconds)) for c in checked if c not in slow]
    percuss = next(c.program for c in checked if c.program.name == REFERENCE)
    results = {(c.program.name, c.work): [c.timing] for c in slow}
    for number in range(1, count + 1):
        print(f"round {number} of {count}", file=sys.stderr)
        for c, chains in plans:
            results.setdefault((c.program.name, c.work), []).append(run(c.program, c.work, chains)[0])
        if ONE_POWER not in percuss.works:
            continue
        for name, kind, timing in complete_runs(percuss, seconds):
            results.setdefault((name, kind), []).append(timing)
    return results


def chains_for(checked: Checked, seconds: float) -> int:
    """Chains that take about so long: a batch is of 64 or more, and of whole bundles of lanes for every core."""
    together, _, cores = checked.work
    enough = seconds * checked.timing.rate * 1e6 / checked.timing.amount * checked.program.chains
    if together == "one":
        return max(1, round(enough))
    return max(64, 16 * cores * round(enough / (16 * cores)))


BLOCK = 64
"""Runs of a block of `percuss sweep`."""
RUNS, SWEEPS = "percuss run, to rest", "percuss sweep, to rest"


def complete_runs(percuss: Program, seconds: float) -> Iterator[tuple[str, Work, Timing]]:
    """percuss's own runs of the same case, which it computes with large strain, contact, border shear and the energy balance: for information."""
    # About how long a run takes [s].
    run, swept = 6e-3, 2e-3
    for name, what, kind, each in (
        (RUNS, "runs", ONE_POWER, run),
        (SWEEPS, "sweep", BATCH, swept),
        (SWEEPS, "sweep", BATCH_ON_TWO, swept),
    ):
        cores = kind[2]
        count = max(1, round(seconds * cores / each / BLOCK)) * BLOCK if what == "sweep" else max(8, round(seconds / each))
        words = [*percuss.command, str(PEERS / "runs.toml"), what, str(count), str(cores)]
        clock, processor, amount = answer(words, {})
        yield name, kind, Timing(clock, processor, amount, cores, count)


def ratios(results: dict[tuple[str, Work], list[Timing]], name: str, kind: Work) -> list[float]:
    """How much faster than percuss, in every round."""
    pairs = zip(results[name, kind], results[REFERENCE, kind])
    return [mine.rate / theirs.rate for mine, theirs in pairs]


def ratio(results: dict[tuple[str, Work], list[Timing]], name: str, kind: Work) -> float:
    """How much faster than percuss, as the median over the rounds."""
    return statistics.median(ratios(results, name, kind))


def machine() -> str:
    """The processor and its load."""
    try:
        lines = open("/proc/cpuinfo", encoding="utf-8").read().splitlines()
    except OSError:
        lines = []
    fields = dict(line.split(":", 1) for line in lines[:40] if ":" in line)
    fields = {name.strip(): value.strip() for name, value in fields.items()}
    words = [fields.get("model name", "processor unknown")]
    words += [f"{name} {fields[key]}" for name, key in (("family", "cpu family"), ("model", "model")) if key in fields]
    words += ["AVX-512"] if "avx512f" in fields.get("flags", "") else []
    return f"{', '.join(words)}; {os.cpu_count()} cores, load {load()}"


def load() -> str:
    """How many programs wanted a processor in the last minute."""
    return f"{os.getloadavg()[0]:.1f}"
