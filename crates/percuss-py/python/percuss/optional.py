"""Libraries that tables and figures need and the package does without."""

from __future__ import annotations

import importlib
from types import ModuleType

from .errors import LibraryError

#: What to install for each library.
_EXTRAS = {"pandas": "tables", "pyarrow": "tables", "xarray": "arrays", "matplotlib": "plots"}


def library(name: str) -> ModuleType:
    """Imports a library, or says how to install it."""
    try:
        return importlib.import_module(name)
    except ImportError as error:
        whole = name.partition(".")[0]
        extra = _EXTRAS[whole]
        raise LibraryError(f"this needs {whole}, which cannot be imported: {error}\nhelp: install it with `pip install {whole}`, or all of its kind with `pip install \".[{extra}]\"` in a clone of percuss") from error
