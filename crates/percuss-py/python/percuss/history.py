"""Histories of a run: arrays that look at the memory of the result."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy

from . import _percuss

if TYPE_CHECKING:
    import pandas
    import pyarrow
    from numpy.typing import NDArray

    Array = NDArray[Any]


class _Columns:
    """Arrays by name: attributes, made when they are asked for, without a copy and read-only."""

    def names(self) -> list[str]:
        """Names of the columns, which end with the unit."""
        raise NotImplementedError

    def _column(self, name: str) -> _percuss.Column | None:
        raise NotImplementedError

    def __getattr__(self, name: str) -> Array:
        column = None if name.startswith("_") else self._column(name)
        if column is None:
            raise AttributeError(f"no column is named `{name}`; columns: {', '.join(self.names())}")
        array: Array = numpy.asarray(column)
        self.__dict__[name] = array
        return array

    def __getitem__(self, name: str) -> Array:
        try:
            array: Array = getattr(self, name)
        except AttributeError as error:
            raise KeyError(str(error)) from None
        return array

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self.names()]

    def to_pandas(self) -> pandas.DataFrame:
        """All columns as a table of pandas, which is a copy."""
        import pandas

        return pandas.DataFrame({name: self[name] for name in self.names()})

    def to_arrow(self) -> pyarrow.Table:
        """All columns as a table of Arrow, which is a copy."""
        import pyarrow

        return pyarrow.table({name: numpy.ascontiguousarray(self[name]) for name in self.names()})


class Profile(_Columns):
    """State along the axis at one moment: a value an element, from the projectile's tail to the target's back face.

    Attributes
    ----------
    part : array of int
        0 for the projectile, 1 for the first layer of the target.
    initial_position_m, position_m : array
        Initial and current position of the element's middle, depth positive [m].
    length_m, diameter_m : array
        Current length and diameter [m].
    stress_pa : array
        Axial stress, compression positive [Pa].
    strain, plastic_strain : array
        Axial strain, compression positive; equivalent plastic strain.
    temperature_k : array
        Temperature [K].
    """

    part: Array
    initial_position_m: Array
    position_m: Array
    length_m: Array
    stress_pa: Array
    strain: Array
    plastic_strain: Array
    diameter_m: Array
    temperature_k: Array

    def __init__(self, native: _percuss.RunResult, index: int) -> None:
        self._native = native
        self._index = index

    @property
    def time_s(self) -> float:
        """Time [s]."""
        time = self._native.profile_time(self._index)
        assert time is not None
        return time

    def names(self) -> list[str]:
        return _percuss.RunResult.element_names()

    def _column(self, name: str) -> _percuss.Column | None:
        return self._native.element_column(self._index, name)

    def __repr__(self) -> str:
        return f"<Profile at {self.time_s:.4g} s, {len(self.part)} elements>"


class History(_Columns):
    """Scalars against time, in SI units. A long run thins its history out, so the steps between moments are not all alike.

    Attributes
    ----------
    time_s : array
        Time [s].
    step : array of int
        Time step.
    tip_velocity_m_s, tail_velocity_m_s, mean_velocity_m_s : array
        Speed of the projectile's front end, of its rear end, and of all of it [m/s].
    interface_velocity_m_s, back_velocity_m_s : array
        Speed of the crater floor and of the target's back face [m/s]; not a number where there is none.
    tip_position_m, depth_m : array
        Position of the projectile's front end and of the crater floor below the original face [m].
    projectile_length_m : array
        Current length of the projectile [m].
    contact_force_n, back_force_n : array
        Force between projectile and target, and on the back face [N].
    energy_*_j, momentum_*_n_s : array
        The lines of the books of energy [J] and momentum [N s]; :meth:`names` lists them.

    Examples
    --------
    >>> history = percuss.run("cases/paper-table1/scenario.toml").history
    >>> bool(history.depth_m.max() > 0.2e-3), history.depth_m.flags.owndata, history.depth_m.flags.writeable
    (True, False, False)
    """

    time_s: Array
    step: Array
    tip_velocity_m_s: Array
    tail_velocity_m_s: Array
    interface_velocity_m_s: Array
    back_velocity_m_s: Array
    mean_velocity_m_s: Array
    tip_position_m: Array
    depth_m: Array
    projectile_length_m: Array
    contact_force_n: Array
    back_force_n: Array

    def __init__(self, native: _percuss.RunResult) -> None:
        self._native = native

    def names(self) -> list[str]:
        return _percuss.RunResult.sample_names()

    def _column(self, name: str) -> _percuss.Column | None:
        return self._native.sample_column(name)

    def __len__(self) -> int:
        return self._native.samples() or 0

    @property
    def profiles(self) -> list[Profile]:
        """The state along the axis at some moments, from the first to the last."""
        return [Profile(self._native, index) for index in range(self._native.profiles())]

    def __repr__(self) -> str:
        return f"<History of {len(self)} moments, {self._native.profiles()} profiles>"
