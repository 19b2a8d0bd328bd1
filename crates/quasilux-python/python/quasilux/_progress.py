"""How far a run is, on stderr: one line that changes, or a line now and then."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any, TextIO

from quasilux._native import Progress, YearProgress

if TYPE_CHECKING:
    from collections.abc import Callable
    from types import TracebackType

    Told = Progress | YearProgress

_STEPS = 24
_SECONDS_BETWEEN_LINES = 8.0
# Before this share of the work the pace says little of the whole.
_MIN_SHARE = 0.02


class Silent:
    """A context that passes a callback on, and shows nothing."""

    def __init__(self, callback: Callable[[Any], object] | None) -> None:
        self._callback = callback

    def __enter__(self) -> Callable[[Any], object] | None:
        return self._callback

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        pass


class Bar:
    """A context whose callback shows on stderr how far a run is."""

    def __init__(self) -> None:
        self._out: TextIO = sys.stderr
        self._changes = _can_change_a_line(self._out)
        self._shown = 0
        self._next_s = _SECONDS_BETWEEN_LINES

    def __enter__(self) -> Callable[[Any], object]:
        return self._show

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        if self._shown:
            self._write("\r" + " " * self._shown + "\r")

    def _show(self, progress: Told) -> None:
        text = line(progress)
        if self._changes:
            blank = " " * (self._shown - len(text))
            self._shown = len(text)
            self._write(f"\r{text}{blank}")
        elif progress.seconds >= self._next_s:
            self._next_s = progress.seconds + _SECONDS_BETWEEN_LINES
            self._write(f"{text}\n")

    def _write(self, text: str) -> None:
        self._out.write(text)
        self._out.flush()


def line(progress: Told) -> str:
    """Return how far a run is as one line of text."""
    done = progress.done or 0.0
    bar = ("=" * int(done * _STEPS) + ">")[:_STEPS].ljust(_STEPS)
    left = "time left not known yet"
    if done >= _MIN_SHARE:
        left = f"{max(1.0, progress.seconds * (1.0 - done) / done):.0f} s left"
    if isinstance(progress, YearProgress):
        return f"{bar} {progress.seconds:.0f} s, {100.0 * done:.0f} % of the year, {left}"
    rays_per_s = progress.rays / max(progress.seconds, 1e-3)
    width = progress.largest_relative_half_width
    known = "\N{PLUS-MINUS SIGN}?" if width is None else f"\N{PLUS-MINUS SIGN}{100.0 * width:.2f} %"
    what = f"picture {progress.camera}" if progress.camera else f"{progress.samples} samples"
    rate = f"{rays_per_s * 1e-6:.2f} M rays/s"
    return f"{bar} {progress.seconds:.0f} s, {what}, {rate}, {known}, {left}"


def _can_change_a_line(out: TextIO) -> bool:
    """Whether a carriage return goes back: on terminals and in notebooks."""
    return out.isatty() or type(out).__module__.startswith("ipykernel")
