"""Impact cases: projectile, target, impact velocity and model options."""

from __future__ import annotations

import html
import os
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from . import _percuss, parts
from .errors import UsageError


class Case:
    """A case built in code: the tables of a case file as keyword arguments.

    Keys, defaults and messages are those of a case file.

    Parameters
    ----------
    name : str
        Name of the case, which messages show instead of a file.
    **tables
        The tables and values of a case file: ``projectile``, ``target``, ``chain``, ``materials`` and so on. A quantity is a text
        with its unit, such as ``"4.8 mm"``, or a quantity of pint or astropy; a plain number is refused. ``None`` leaves a value out.
        Paths in ``material_files`` and ``measured_curves`` are relative to the working directory.

    Raises
    ------
    CaseError, MaterialError
        With the place in the case's text, what is allowed and the remedy.

    Examples
    --------
    >>> import percuss
    >>> case = percuss.Case(
    ...     projectile={"material": "copper", "length": "12.74 mm", "diameter": "4.8 mm", "impact_velocity": "230 m/s"},
    ...     target={"material": "aluminium-2024-t351", "thickness": "25 mm"},
    ... )
    >>> case.impact_velocity_m_s
    230.0
    >>> round(percuss.run(case).depth_of_penetration_mm, 4)
    0.208

    Tables are attributes, whose values can be read and set; a value is checked at once, with its unit.

    >>> case.projectile.impact_velocity = "300 m/s"
    >>> case.target.thickness, case.impact_velocity_m_s
    ('25 mm', 300.0)
    """

    _native: _percuss.Case

    def __init__(self, name: str = "case", /, **tables: Any) -> None:
        self._native = _percuss.Case.from_tables(name, tables, Path.cwd())

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Case:
        """Reads a case file, as :func:`percuss.load` does."""
        return cls._of(_percuss.Case.load(path))

    @classmethod
    def from_text(cls, text: str, name: str = "case", folder: str | os.PathLike[str] | None = None) -> Case:
        """Reads a case from the text of a case file.

        Parameters
        ----------
        text : str
            TOML, as a case file has it.
        name : str
            Name of the case, which messages show instead of a file.
        folder : path, optional
            What paths in ``material_files`` are relative to; the working directory when not given.
        """
        return cls._of(_percuss.Case.from_text(name, text, Path.cwd() if folder is None else folder))

    @classmethod
    def _of(cls, native: _percuss.Case) -> Case:
        case = cls.__new__(cls)
        case._native = native
        return case

    def replace(self, values: Mapping[str, Any]) -> Case:
        """The same case with other values under some dotted keys.

        Examples
        --------
        >>> faster = percuss.load("cases/paper-table1/scenario.toml").replace({"projectile.impact_velocity": "400 m/s"})
        >>> faster.impact_velocity_m_s
        400.0
        """
        return self._of(self._changed({tuple(key.split(".")): value for key, value in values.items()}))

    def _changed(self, values: Mapping[parts.Way, Any]) -> _percuss.Case:
        """The native case with other values under the keys that lead to them."""
        tables = self._tables()
        for (*way, last), value in values.items():
            table: Any = tables
            for part in way:
                table = table[int(part)] if isinstance(table, list) else table.setdefault(part, {})
                if not isinstance(table, (dict, list)):
                    key = ".".join(str(name) for name in (*way, last))
                    raise UsageError(f"`{key}` is no key of a case: `{part}` is a value, and has no keys")
            table[int(last) if isinstance(table, list) else last] = value.to_dict() if isinstance(value, parts.Part) else value
        return _percuss.Case.from_tables(self.name, tables, self._native.folder)

    def _tables(self) -> dict[str, Any]:
        return tomllib.loads(self.text)

    def _put(self, way: parts.Way, value: Any) -> None:
        self._native = self._changed({way: value})

    def __getattr__(self, name: str) -> Any:
        # Names with an underscore belong to protocols of Python and are never keys.
        if name.startswith("_") or name not in parts.keys(()):
            raise AttributeError(f"a case has no `{name}`; its tables: {', '.join(parts.keys(()))}")
        return parts.value(self._tables().get(name), self._tables, self._put, (name,))

    def __setattr__(self, name: str, value: Any) -> None:
        if name.startswith("_"):
            super().__setattr__(name, value)
        else:
            self._put((name,), value)

    def __delattr__(self, name: str) -> None:
        self._put((name,), None)

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *parts.keys(())]

    @property
    def name(self) -> str:
        """Name of the case."""
        return self._native.name

    @property
    def title(self) -> str:
        """One line that says what it is."""
        return self._native.title

    @property
    def impact_velocity_m_s(self) -> float:
        """Impact velocity [m/s]."""
        return self._native.impact_velocity_m_s

    @property
    def text(self) -> str:
        """The text of the case file; of a case that was built in code, the text that it would have."""
        return self._native.text

    @property
    def path(self) -> Path | None:
        """The file; ``None`` for a case that comes from none."""
        return None if self._native.path is None else Path(self._native.path)

    def estimate(self, model: str | None = None) -> dict[str, float]:
        """Estimated cost of a run, before anything is computed.

        Parameters
        ----------
        model : str, optional
            Name of the model, by default that of :func:`percuss.run`.

        Returns
        -------
        dict
            ``memory_bytes``, ``steps`` and ``seconds`` of processor time; 0 for a formula.

        Raises
        ------
        NotApplicableError
            Also for a run that would take more memory than the limit.
        """
        memory, steps, seconds = self._native.estimate(model)
        return {"memory_bytes": memory, "steps": steps, "seconds": seconds}

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes a case file, which the program reads; records and curves of other files, whose paths are relative, stand in it."""
        Path(path).write_text(self._native.self_contained(), encoding="utf-8")

    def __reduce__(self) -> tuple[Any, ...]:
        # Where it came from a file, the file may be on another machine: the text goes along.
        return Case.from_text, (self.text, self.name, os.path.abspath(self._native.folder))

    def __repr__(self) -> str:
        where = f" from {self.path}" if self.path else ""
        return f"<Case {self.name}, {self.impact_velocity_m_s:g} m/s{where}>"

    def _repr_html_(self) -> str:
        head = html.escape(self.title or self.name)
        return f"<details open><summary>{head}</summary><pre>{html.escape(self.text)}</pre></details>"


def load(path: str | os.PathLike[str]) -> Case:
    """Reads a case file and everything that it names.

    Parameters
    ----------
    path : str or path
        Case file; ``percuss new NAME`` writes one to start from.

    Raises
    ------
    ReadError
        When a file cannot be read.
    CaseError, MaterialError
        When its content is not valid; the message has file, line, key, what is allowed and the remedy.

    Examples
    --------
    >>> percuss.load("cases/paper-table1/scenario.toml")
    <Case paper-table1, 230 m/s from cases/paper-table1/scenario.toml>
    """
    return Case.load(path)


def native(case: Case | str | os.PathLike[str]) -> _percuss.Case:
    """The native case of a case, or of the file that it is in."""
    return case._native if isinstance(case, Case) else _percuss.Case.load(case)
