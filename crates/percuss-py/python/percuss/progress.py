"""Progress bar of computations that take longer than a second."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, TypeAlias

#: Callback with the progress, 0 to 1, and a short text; an exception in it ends the computation.
Progress: TypeAlias = Callable[[float, str], None]

#: Time before the progress is shown [s].
DELAY = 1.0


class _Bar:
    """Bar of tqdm that appears after a delay."""

    def __init__(self) -> None:
        self.start = time.monotonic()
        self.bar: Any = None

    def __call__(self, fraction: float, words: str) -> None:
        if self.bar is None:
            if time.monotonic() - self.start < DELAY:
                return
            self.bar = _tqdm()(total=1.0, leave=False, bar_format="{percentage:3.0f} %|{bar}| {desc}")
        # The estimate never decreases.
        self.bar.n = max(self.bar.n, min(fraction, 1.0))
        self.bar.set_description_str(words, refresh=False)
        self.bar.refresh()

    def close(self) -> None:
        if self.bar is not None:
            self.bar.close()


def _tqdm() -> Any:
    """Bar of a notebook if it can be drawn, otherwise that of a terminal."""
    try:
        import ipywidgets  # noqa: F401
        from tqdm.auto import tqdm
    except ImportError:
        from tqdm import tqdm
    return tqdm


def _is_watched() -> bool:
    """Whether a bar can be drawn and is visible."""
    if not ("ipykernel" in sys.modules or (sys.stderr is not None and sys.stderr.isatty())):
        return False
    try:
        import tqdm  # noqa: F401
    except ImportError:
        return False
    return True


@contextmanager
def watching(progress: Progress | bool | None) -> Iterator[Progress | None]:
    """Progress callback: the given callable, or a bar for ``True`` and, where it is visible, for ``None``."""
    if callable(progress):
        yield progress
    elif progress is False or (progress is None and not _is_watched()):
        yield None
    else:
        bar = _Bar()
        try:
            yield bar
        finally:
            bar.close()
