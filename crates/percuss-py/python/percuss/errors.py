"""Exceptions, with the messages of the program ``percuss``."""

from __future__ import annotations


class PercussError(Exception):
    """Any failure of the package; ``str()`` gives the message."""


class CaseError(PercussError, ValueError):
    """A case, a sweep or a file of tests is not valid.

    Attributes
    ----------
    file : str
        The file, or the name of a case that was built in code.
    line : int
        Line of the mistake, counted from 1.
    key : str
        The key in dotted form, such as ``projectile.diameter``; empty when there is none.
    message : str
        What is wrong, in one line.
    help : str
        What is allowed and what to do.
    """

    file: str = ""
    line: int = 1
    key: str = ""
    message: str = ""
    help: str = ""


class MaterialError(CaseError):
    """A material is not valid, or none has the name."""


class NumericalError(PercussError, ArithmeticError):
    """The numerical solution failed, or its balances do not close.

    Attributes
    ----------
    message : str
        What failed.
    step : int
        Time step.
    time_us : float
        Time [us].
    element : int or None
        Element, counted from the tail of the projectile, if one can be named.
    help : str
        What to do.
    """

    message: str = ""
    step: int = 0
    time_us: float = 0.0
    element: int | None = None
    help: str = ""


class NotApplicableError(PercussError, ValueError):
    """The model does not apply to the case.

    Attributes
    ----------
    model : str
        Name of the model.
    reason : str
        Why, in words.
    """

    model: str = ""
    reason: str = ""


class UsageError(PercussError, ValueError):
    """An argument asks for something that does not exist, or leaves nothing to compute."""


class LibraryError(PercussError, ImportError):
    """A library that a table or figure needs is not installed; the message says how to install it."""


class _FileError(PercussError, OSError):
    message: str = ""
    help: str = ""

    def __str__(self) -> str:
        # An OSError with the name of a file would write its own text.
        return str(self.args[0])


class ReadError(_FileError):
    """A file could not be read; ``filename`` is its path, ``message`` the reason and ``help`` the remedy."""


class WriteError(_FileError):
    """A file or folder could not be written; ``filename`` is its path, ``message`` the reason and ``help`` the remedy."""


class ClusterError(PercussError, RuntimeError):
    """A cluster was lost during a sweep; computed rows are kept."""
