# SPDX-License-Identifier: GPL-3.0-or-later
"""Who is told how far a verb is."""
import contextlib
import sys
import time
from typing import Any, Callable, Iterator, Optional, Union

#: A function of the fraction that is done (0 to 1) and the name of the stage; or whether a bar is drawn. None: a bar in
#: a notebook, nothing elsewhere.
Progress = Union[Callable[[float, str], object], bool, None]

_PATIENCE_S = 0.5  # what is done sooner has no bar


def _in_notebook() -> bool:
    shell = sys.modules.get("IPython")
    here = shell.get_ipython() if shell else None  # None: imported, but not running in it
    return here is not None and hasattr(here, "kernel")


def _bar(fraction: float, stage: str) -> str:
    return f"[{'#' * int(fraction * 30):<30}] {fraction:4.0%} {stage}"


class _NotebookBar:
    """One output of the cell, which is written anew."""

    def __init__(self) -> None:
        import IPython.display  # type: ignore[import]

        self._display = IPython.display.display
        self._handle: Any = None
        self._since = time.monotonic()

    def __call__(self, fraction: float, stage: str) -> None:
        if self._handle is None and time.monotonic() - self._since < _PATIENCE_S:
            return
        shown = {"text/plain": _bar(fraction, stage)}
        if self._handle is None:
            self._handle = self._display(shown, raw=True, display_id=True)
        else:
            self._handle.update(shown, raw=True)

    def close(self) -> None:
        pass


class _LineBar:
    """A line of standard error, which is written anew."""

    def __call__(self, fraction: float, stage: str) -> None:
        print(f"\r\033[K{_bar(fraction, stage)}", end="", file=sys.stderr, flush=True)

    def close(self) -> None:
        print("\r\033[K", end="", file=sys.stderr, flush=True)


@contextlib.contextmanager
def watching(progress: Progress) -> Iterator[Optional[Callable[[float, str], object]]]:
    """What is to be called for as long as a verb runs."""
    if callable(progress):
        yield progress
        return
    if progress is False or (progress is None and not _in_notebook()):
        yield None
        return
    bar: Union[_NotebookBar, _LineBar] = _NotebookBar() if _in_notebook() else _LineBar()
    try:
        yield bar
    finally:
        bar.close()
