"""Sweeps on a real Dask cluster on this machine: what happens to workers and scheduler changes no bit of the result."""

from __future__ import annotations

import os
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import percuss
import pytest

pytest.importorskip("distributed", reason="Dask is not installed")

from distributed import Client, LocalCluster
from test_sweep import contents, sweep_file

Cluster = tuple[Any, Any]


@pytest.fixture(scope="module")
def cluster() -> Iterator[Cluster]:
    """Two workers, a process and a thread each."""
    with (
        LocalCluster(n_workers=2, threads_per_worker=1, host="127.0.0.1", dashboard_address=None) as cluster,
        Client(cluster) as client,
    ):
        yield cluster, client


@pytest.fixture(scope="module")
def local(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, dict[str, str]]:
    """A sweep, and what its folder holds when it is computed here."""
    folder = tmp_path_factory.mktemp("sweep")
    path = sweep_file(folder)
    return path, contents(percuss.sweep(path, folder / "local").folder)


def test_a_cluster_computes_the_same_bits(
    cluster: Cluster, local: tuple[Path, dict[str, str]], tmp_path: Path
) -> None:
    path, expected = local
    heard: list[float] = []
    rows = percuss.sweep(path, tmp_path / "rows", client=cluster[1], progress=lambda part, _: heard.append(part))
    assert contents(rows.folder) == expected
    assert heard[-1] == 1.0 and heard == sorted(heard)
    # Nothing is left to do, and nothing is done again.
    percuss.sweep(path, tmp_path / "rows", client=cluster[1], resume=True)
    assert contents(rows.folder) == expected


def computed(client: Client) -> dict[str, int]:
    """Blocks that every worker has computed so far."""

    def count() -> int:
        from percuss.cluster import _unpacked

        known = _unpacked.cache_info()
        return known.hits + known.misses

    found: dict[str, int] = client.run(count)
    return found


def test_a_slow_worker_gets_fewer_blocks(
    cluster: Cluster, local: tuple[Path, dict[str, str]], tmp_path: Path
) -> None:
    path, expected = local
    _, client = cluster
    before = computed(client)
    slow, _ = sorted(before)
    busy = client.submit(time.sleep, 3.0, workers=[slow], pure=False)
    rows = percuss.sweep(path, tmp_path / "rows", client=client)
    blocks = {worker: count - before[worker] for worker, count in computed(client).items()}
    busy.result()
    assert contents(rows.folder) == expected
    # Of six blocks one at the most waits behind what keeps it busy, and none is computed twice.
    assert blocks.pop(slow) <= 1 and sum(blocks.values()) >= 5, blocks


def test_a_worker_that_is_killed_costs_no_row(
    cluster: Cluster, local: tuple[Path, dict[str, str]], tmp_path: Path
) -> None:
    path, expected = local
    _, client = cluster
    # All blocks are with the worker that will be killed: the other one is busy.
    slow, killed = sorted(client.scheduler_info(n_workers=-1)["workers"])
    pid = client.run(os.getpid, workers=[killed])[killed]
    busy = client.submit(time.sleep, 2.0, workers=[slow], pure=False)
    seen: list[float] = []

    def kill_once(part: float, _words: str) -> None:
        if part > 0.0 and not seen:
            seen.append(part)
            os.kill(pid, signal.SIGKILL)

    rows = percuss.sweep(path, tmp_path / "rows", client=client, progress=kill_once)
    assert seen and seen[0] < 1.0, "the worker was killed before the sweep was done"
    assert pid not in client.run(os.getpid).values()
    assert contents(rows.folder) == expected
    busy.result()


def test_what_is_wrong_with_a_sweep_or_a_worker_is_said(
    cluster: Cluster, local: tuple[Path, dict[str, str]], tmp_path: Path
) -> None:
    _, client = cluster
    case = percuss.load("cases/paper-table1/scenario.toml").path
    assert case is not None
    sweep = {
        "base": str(case.resolve()),
        "model": "tate",
        "design": "grid",
        "parameter": [{"key": "projectile.impact_velocity", "values": ["900 m/s"]}],
    }
    with pytest.raises(percuss.UsageError, match="is an absolute path"):
        percuss.sweep(sweep, tmp_path / "rows", client=client)
    from percuss.cluster import Bundle, compute_block

    bundle = Bundle("0.0.0", "sweep.toml", (("sweep.toml", ""),))
    with pytest.raises(percuss.UsageError, match="install the same version"):
        client.submit(compute_block, bundle, 0).result()


def test_a_scheduler_that_is_lost_is_said_and_the_sweep_goes_on(
    tmp_path: Path,
) -> None:
    # Blocks that take longer than it takes to stop the scheduler.
    path = sweep_file(tmp_path, elements=160)
    expected = contents(percuss.sweep(path, tmp_path / "local").folder)
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        address = f"127.0.0.1:{free.getsockname()[1]}"
    host, port = address.split(":")

    def start(module: str, *words: str) -> subprocess.Popen[bytes]:
        line = [sys.executable, "-m", f"distributed.cli.{module}", *words]
        return subprocess.Popen(line, cwd=tmp_path, stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL)

    def scheduler() -> subprocess.Popen[bytes]:
        return start("dask_scheduler", "--host", host, "--port", port, "--no-dashboard")

    running = [scheduler()]
    worker = [address, "--nthreads", "1", "--no-nanny", "--no-dashboard", "--death-timeout", "60"]
    running.append(start("dask_worker", *worker))
    try:
        client = Client(address, timeout=60)
        client.wait_for_workers(1, timeout=60)
        seen: list[float] = []

        def kill_once(part: float, _words: str) -> None:
            if part > 0.0 and not seen:
                seen.append(part)
                running[0].kill()

        with pytest.raises(percuss.ClusterError, match=r"of 6 blocks are done and kept.*resume=True") as lost:
            percuss.sweep(path, tmp_path / "rows", client=client, progress=kill_once)
        assert seen and str(lost.value)
        client.close(timeout=1)
        rows = percuss.SweepResult(tmp_path / "rows")
        assert 0 < rows.status.runs_done < 24
        # A new scheduler under the same address, a new worker: what is there is not computed again.
        running += [scheduler(), start("dask_worker", *worker)]
        with Client(address, timeout=60) as client:
            client.wait_for_workers(1, timeout=60)
            percuss.sweep(path, tmp_path / "rows", client=client, resume=True)
        assert contents(tmp_path / "rows") == expected
    finally:
        for process in running:
            process.kill()
            process.wait()


def depth_of(case: percuss.Case) -> float | None:
    return percuss.run(case).depth_of_penetration_mm


def test_runs_are_mapped_over_a_cluster(cluster: Cluster) -> None:
    """The example of the page about Python."""
    case = percuss.load("cases/paper-table1/scenario.toml")
    cases = [case.replace({"projectile.impact_velocity": f"{speed} m/s"}) for speed in (200, 230, 400)]
    depths = cluster[1].gather(cluster[1].map(lambda case: percuss.run(case).depth_of_penetration_mm, cases))
    assert depths == [depth_of(case) for case in cases]
