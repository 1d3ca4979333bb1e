"""Sweeps on a Dask cluster: workers compute blocks, this process writes them."""

from __future__ import annotations

import functools
import os
import tempfile
import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import _percuss
from .errors import ClusterError, PercussError, UsageError
from .progress import Progress

if TYPE_CHECKING:
    from distributed import Client

#: How often one looks whether the cluster is still there [s].
_PULSE = 0.5


@dataclass(frozen=True)
class Bundle:
    """The files of a sweep, for a machine that does not have them."""

    version: str
    #: Name of the sweep file among them.
    sweep: str
    #: Names, relative to one folder, and texts.
    files: tuple[tuple[str, str], ...]

    @classmethod
    def of(cls, sweep: _percuss.Sweep) -> Bundle:
        """The files that a sweep rests on. They name each other relatively, so they can stand in any folder."""
        paths = [Path(path) for path in sweep.files()]
        for path, names in ((paths[0], ["base"]), (paths[1], ["material_files"])):
            tables = tomllib.loads(path.read_text(encoding="utf-8"))
            named = [item for name in names for item in _list(tables.get(name, []))]
            for item in named:
                if os.path.isabs(item):
                    raise UsageError(
                        f"{path}: `{item}` is an absolute path, which workers on other machines do not have; make it relative"
                    )
        absolute = [Path(os.path.abspath(path)) for path in paths]
        # A case takes its name from its folder, so that goes along.
        root = Path(os.path.commonpath([path.parent for path in absolute])).parent
        files = tuple((str(path.relative_to(root)), path.read_text(encoding="utf-8")) for path in absolute)
        return cls(_percuss.VERSION, files[0][0], files)


def _list(value: Any) -> list[str]:
    return [value] if isinstance(value, str) else list(value)


@functools.lru_cache(maxsize=4)
def _unpacked(bundle: Bundle) -> _percuss.Sweep:
    """The sweep of a bundle; a worker reads it once."""
    if bundle.version != _percuss.VERSION:
        raise UsageError(
            f"the worker has percuss {_percuss.VERSION}, not {bundle.version}: install the same version on all machines"
        )
    with tempfile.TemporaryDirectory(prefix="percuss-") as folder:
        for name, text in bundle.files:
            path = Path(folder, name)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        return _percuss.Sweep(Path(folder, bundle.sweep))


def compute_block(bundle: Bundle, block: int) -> bytes:
    """The file of a block: what a worker does."""
    return _unpacked(bundle).block(block)


def compute(
    sweep: _percuss.Sweep,
    folder: _percuss.SweepFolder,
    blocks: list[int],
    client: Client,
    progress: Progress | None,
) -> None:
    """Computes blocks on a cluster and puts each into the folder as it comes. A worker that dies costs its blocks only."""
    import distributed

    bundle = Bundle.of(sweep)
    waiting = {client.submit(compute_block, bundle, block, pure=False): block for block in blocks}
    total, done = len(blocks), 0
    lost = f"{{}} of {total} blocks are done and kept: sweep(..., resume=True) computes the rest"
    try:
        while waiting:
            try:
                ended = distributed.wait(list(waiting), timeout=_PULSE, return_when="FIRST_COMPLETED").done
            except (TimeoutError, distributed.TimeoutError):
                ended = set()
            for future in ended:
                block = waiting.pop(future)
                folder.put(block, future.result())
                done += 1
            if not ended and client.status != "running":
                raise ClusterError(f"the connection to the cluster is {client.status}; " + lost.format(done))
            if progress is not None:
                progress(done / total, f"{done} of {total} blocks")
    except PercussError:
        raise
    except (distributed.CancelledError, distributed.KilledWorker, OSError) as error:
        raise ClusterError(f"the cluster lost the sweep: {error or type(error).__name__}; " + lost.format(done)) from error
    finally:
        if waiting:
            try:
                client.cancel(list(waiting))
            except Exception:  # noqa: BLE001  A cluster that is gone has nothing left to cancel.
                pass
