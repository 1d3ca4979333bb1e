"""Strength laws in Python as part of a study."""

from __future__ import annotations

import hashlib
import marshal
from collections.abc import Callable
from typing import TypeAlias

#: Flow stress [Pa] from plastic strain, strain rate [1/s] and temperature [K].
StrengthLaw: TypeAlias = Callable[[float, float, float], float]


def name(projectile: StrengthLaw | None, target: StrengthLaw | None) -> str:
    """What tells the laws of a study from others: their names and the code of functions.

    Values that a function takes from elsewhere are not part of it, but for those that it closes over or has as defaults.

    Examples
    --------
    >>> name(None, None)
    ''
    >>> name(lambda *_: 300e6, None) == name(lambda *_: 200e6, None)
    False
    """
    laws = {"projectile": projectile, "target": target}
    return "; ".join(f"{part} strength law {_identity(law)}" for part, law in laws.items() if law is not None)


def _identity(law: StrengthLaw) -> str:
    words = f"{getattr(law, '__module__', '')}.{getattr(law, '__qualname__', type(law).__qualname__)}"
    code = getattr(law, "__code__", None)
    if code is None:
        return f"{words} {law!r}"
    closed = [cell.cell_contents for cell in getattr(law, "__closure__", None) or ()]
    content = (code.co_code, repr(code.co_consts), code.co_names, repr(getattr(law, "__defaults__", None)), repr(closed))
    return f"{words} {hashlib.sha256(marshal.dumps(content)).hexdigest()[:16]}"
