"""Sweeps of a case, on this machine or on a cluster."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, nullcontext
from pathlib import Path as FilePath
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

from . import _percuss, cluster, laws, plots
from .command_line import Path, answer, execute, formats, several
from .case import Case
from .errors import LibraryError, UsageError
from .laws import StrengthLaw
from .progress import Progress, watching
from .optional import library
from .record import CommandRecord, Record, in_words, table_html, units_of
from .results import MAIN
from .unit_systems import dataset, in_units

if TYPE_CHECKING:
    import pandas
    import pyarrow
    import xarray
    from distributed import Client
    from matplotlib.axes import Axes


class SweepResult:
    """Folder of a sweep: one row per run, in Parquet files. It can be used as a path. A temporary folder lasts as long as this object."""

    def __init__(self, folder: Path | TemporaryDirectory[str]) -> None:
        self._temporary = folder if isinstance(folder, TemporaryDirectory) else None
        self.folder = FilePath(folder.name if isinstance(folder, TemporaryDirectory) else folder)

    def __fspath__(self) -> str:
        return str(self.folder)

    @property
    def status(self) -> Record:
        """Progress of the folder, as printed by ``percuss sweep status``: ``runs_done``, ``blocks_done``, ``blocks_damaged``, ``running`` and the ``manifest``."""
        return Record(answer("sweep status", self.folder))

    @property
    def manifest(self) -> Record:
        """Manifest of the sweep."""
        manifest: Record = self.status.manifest
        return manifest

    @property
    def complete(self) -> bool:
        """Whether all runs are complete."""
        status = self.status
        return bool(status.runs_done == status.manifest.runs)

    def files(self) -> list[FilePath]:
        """Files of the computed blocks, in the order of the runs."""
        return [self.folder / f"block-{block:06}.parquet" for block in self.status.blocks_done]

    def to_arrow(self) -> pyarrow.Table:
        """All computed rows as a table of Arrow, in the order of the runs."""
        arrow = library("pyarrow")
        parquet = library("pyarrow.parquet")
        return arrow.concat_tables(parquet.read_table(file) for file in self.files())

    def to_pandas(self, units: str | None = None) -> pandas.DataFrame:
        """All computed rows as a table of pandas, in the order of the runs; ``units`` is a unit system, such as ``"mm-ms-kN"``."""
        library("pandas")
        rows: pandas.DataFrame = self.to_arrow().to_pandas()
        names = list(rows.columns)
        for name, (new, column) in zip(names, in_units({name: rows[name] for name in names}, units).items()):
            rows[name] = column
            rows = rows.rename(columns={name: new})
        return rows

    def to_xarray(self, units: str | None = None) -> xarray.Dataset:
        """All computed rows as variables of xarray with their ``units``, along ``run``."""
        rows = self.to_arrow()
        return dataset({name: rows[name].to_pylist() for name in rows.column_names}, "run", units, "run")

    def merge(self, out: Path, units: str | None = None) -> int:
        """Writes all rows into one file, as :func:`percuss.merge` does; returns their number."""
        return merge(self, out, units=units)

    def plot(self, x: str, y: str, colour: str | None = None, ax: Axes | None = None) -> Axes:
        """Draws a column versus another one, one dot per run, coloured by a third; :func:`percuss.plot` chooses what suits the sweep."""
        return plots.sweep(self, x, y, colour, ax)

    def __repr__(self) -> str:
        return f"<SweepResult {self.folder}; {'; '.join(self._headline())}>"

    def _headline(self) -> list[str]:
        """What matters, in words."""
        status, manifest = self.status, self.manifest
        head = f"{status.runs_done} of {manifest.runs} runs, model {manifest.model}, design {manifest.design}"
        return [head, *self._ranges(), units_of(column.name for column in manifest.columns)]

    def _ranges(self) -> list[str]:
        """Smallest and largest main numbers of the rows in words; none without pyarrow."""
        try:
            parquet = library("pyarrow.parquet")
        except LibraryError:
            return []
        import numpy

        held = [column.name for column in self.manifest.columns]
        words: list[str] = []
        for name in (name for name in MAIN if name in held):
            if len(words) == 2:
                break
            values = [parquet.read_table(file, columns=[name])[name].to_numpy() for file in self.files()]
            numbers = numpy.concatenate([numpy.asarray(column, dtype=float) for column in values]) if values else numpy.array([])
            numbers = numbers[~numpy.isnan(numbers)]
            if len(numbers):
                words.append(in_words(name, numbers.min(), numbers.max()))
        return words

    def _repr_html_(self) -> str:
        status, manifest = self.status, self.manifest
        rows = [
            ["folder", str(self.folder)],
            ["runs", f"{status.runs_done} of {manifest.runs}"],
            ["model", manifest.model],
            ["design", manifest.design],
            *(["results", words] for words in self._ranges()),
            ["columns", ", ".join(column.name for column in manifest.columns)],
        ]
        return table_html(["", ""], rows, manifest.title or manifest.case)


def sweep(
    sweep: Path | Mapping[str, Any],
    out: Path | None = None,
    *,
    resume: bool = False,
    shard: tuple[int, int] = (1, 1),
    threads: int | None = None,
    client: Client | None = None,
    progress: Progress | bool | None = None,
    projectile_law: StrengthLaw | None = None,
    target_law: StrengthLaw | None = None,
) -> SweepResult:
    """Computes a case many times with some of its numbers varied.

    Rows depend on the sweep, the case and the run alone: they are the same, bit for bit, whatever the number of threads, shards and
    workers, and the same as those of ``percuss sweep``.

    Parameters
    ----------
    sweep : path or mapping
        A sweep file, or what it says as a mapping, whose ``base`` may be a :class:`Case`. A mapping is written to ``out`` as
        ``sweep.toml``, so that the program can go on with the folder.
    out : path, optional
        Folder of the results. It is written by this process alone, also on a cluster. A temporary folder when not given: it is removed with
        the result, so that such a sweep cannot be resumed.
    resume : bool
        Whether to go on with a folder that holds a part of this sweep.
    shard : tuple of int
        Which of how many parts to compute, such as ``(2, 8)``.
    threads : int, optional
        Threads; as many as there are cores when not given. On a cluster the workers have their own.
    client : distributed.Client, optional
        A Dask cluster to compute on.
    progress : callable or bool, optional
        As in :func:`percuss.run`.
    projectile_law, target_law : callable, optional
        Strength laws in Python, as in :func:`percuss.run`, for every run; threads take turns in them. A folder goes on with the same law
        only. An exception in a law ends the sweep. Not on a cluster.

    Returns
    -------
    SweepResult
        The folder.

    Raises
    ------
    CaseError
        When the sweep or its case is not valid.
    ClusterError
        When the cluster was lost; what was done stays in the folder, and ``resume=True`` goes on.

    Examples
    --------
    >>> rows = percuss.sweep(
    ...     {
    ...         "base": percuss.load("cases/paper-table1/scenario.toml"),
    ...         "model": "chain",
    ...         "design": "grid",
    ...         "parameter": [{"key": "projectile.impact_velocity", "values": ["200 m/s", "230 m/s"]}],
    ...     }
    ... )
    >>> rows.complete, rows.to_pandas()["impact_velocity_m_s"].tolist()
    (True, [200.0, 230.0])
    """
    part, parts = shard
    if threads is not None and not 1 <= threads <= _percuss.MOST_THREADS:
        raise UsageError(f"`threads` = {threads} is out of range: 1 to {_percuss.MOST_THREADS}, or None for one per core")
    if not 1 <= part <= parts:
        raise UsageError(f"shard {part}/{parts} does not exist: parts are counted from 1 to their number")
    if out is None and (resume or shard != (1, 1)):
        raise UsageError("`resume` and `shard` need a folder that stays: give `out`")
    own = laws.name(projectile_law, target_law)
    if own and client is not None:
        raise UsageError("strength laws in Python are computed on this machine: leave out `client`, or add the law to the library")
    result = SweepResult(TemporaryDirectory(prefix="percuss-sweep-") if out is None else out)
    with _placed(sweep, result.folder) if isinstance(sweep, Mapping) else nullcontext(FilePath(sweep)) as path:
        native = _percuss.Sweep(path, projectile_law, target_law, own)
        folder = _percuss.SweepFolder(result.folder, native, resume)
    try:
        with watching(progress) as hear:
            if client is None:
                _percuss.compute_sweep(native, folder, part, parts, threads, hear)
            else:
                cluster.compute(native, folder, folder.missing(part, parts), client, hear)
    finally:
        folder.close()
    return result


def merge(folders: Path | Sequence[Path], out: Path, *, units: str | None = None) -> int:
    """Joins folders that hold all parts of a sweep into one file, as ``percuss sweep merge`` does.

    Parameters
    ----------
    folders : path, SweepResult or sequence of them
        Folders of results.
    out : path
        File to write, CSV if its name ends with ``.csv``, otherwise Parquet; it is replaced if it exists.
    units : str, optional
        Unit system of the columns, such as ``"mm-ms-kN"``; their names say so. The units of the folder when not given.

    Returns
    -------
    int
        Number of rows.
    """
    rows: int = answer("sweep merge", *several(folders), out=out, units=units)
    return rows


class Drawing(CommandRecord):
    """A figure that was written: :attr:`files` are its SVG and its PNG. A notebook shows it.

    Attributes
    ----------
    title : str
        What it shows.
    """

    title: str

    def _repr_svg_(self) -> str:
        return self.files[0].read_text(encoding="utf-8")

    def _repr_html_(self) -> str:
        return self._repr_svg_()


def plot(
    folders: Path | Sequence[Path],
    *,
    out: Path | None = None,
    figures: str | Sequence[str] | None = None,
    figure_width: str | None = None,
    quantity: str | None = None,
    style: str | None = None,
    x: str | None = None,
    y: str | None = None,
) -> Drawing:
    """Draws a result of a sweep, as ``percuss sweep plot`` does: what is not said is chosen from what is varied.

    Parameters
    ----------
    folders : path, SweepResult or sequence of them
        Folders of results; several are parts of one sweep. What is not computed yet is counted.
    out : path, optional
        Folder for the figure; the first of the folders of results when not given.
    figures : str or sequence of str, optional
        Formats of the figure: ``svg``, ``png`` and ``pdf``, or ``"none"``; SVG and PNG when not given.
    figure_width : str, optional
        Width of the figures in print, 60 mm to 182 mm; ``"88 mm"`` fits a column of a journal. 182 mm when not given.
    quantity : str, optional
        Column of the result to draw.
    style : str, optional
        ``curves``, ``map`` or ``parallel`` coordinates.
    x, y : str, optional
        Keys of the parameters that run from left to right and upwards; means are taken over the others.

    Raises
    ------
    UsageError
        When the folders hold no rows, or what is asked for does not fit the sweep.
    """
    return Drawing(execute("sweep plot", *several(folders), out=out, figures=formats(figures), figure_width=figure_width, quantity=quantity, style=style, x=x, y=y))


@contextmanager
def _placed(sweep: Mapping[str, Any], out: FilePath) -> Iterator[FilePath]:
    """The sweep file of a mapping, with its case beside it. A sweep that is refused leaves the folder as it was."""
    tables = dict(sweep)
    base = tables.get("base")
    texts: dict[str, str] = {}
    if isinstance(base, Case):
        name = re.sub(r"[^\w.-]+", "-", base.name)
        name = "sweep-case.toml" if name == "sweep" else f"{name}.toml"
        texts[name] = base._native.self_contained()
        tables["base"] = name
    elif isinstance(base, os.PathLike):
        tables["base"] = os.path.relpath(base, out)
    texts["sweep.toml"] = _percuss.toml_text(tables)
    files = {out / name: text.encode() for name, text in texts.items()}
    before = {file: file.read_bytes() if file.exists() else None for file in files}
    # Files of another sweep are found by its manifest; what else is there belongs to somebody.
    foreign = [file for file, old in before.items() if old is not None and old != files[file]]
    if foreign and not (out / "manifest.json").exists():
        raise UsageError(f"{foreign[0]} is there and is not of this sweep: give another folder")
    made = not out.exists()
    try:
        out.mkdir(parents=True, exist_ok=True)
        for file, text in files.items():
            file.write_bytes(text)
        yield out / "sweep.toml"
    except BaseException:
        for file, old in before.items():
            if old is None:
                file.unlink(missing_ok=True)
            else:
                file.write_bytes(old)
        if made and not any(out.iterdir()):
            out.rmdir()
        raise
