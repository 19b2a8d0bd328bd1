"""Options of runs and years, which the native half takes as they are.

Types are checked here, with the names of the parameters. What a value may be, and what holds
where nothing is said, the native half knows.
"""

from __future__ import annotations

import math
import numbers
import operator
import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import SupportsIndex


@dataclass(frozen=True, kw_only=True)
class RunOptions:
    """Options of a run, by the names of the parameters of `simulate`; None says nothing."""

    rel_tol: float | str | None = None
    abs_tol_lx: float | None = None
    unseen_tol: float | str | None = None
    tolerance_on: str | None = None
    interval: str | None = None
    confidence: float | str | None = None
    samples: int | None = None
    rays: int | None = None
    time_s: float | None = None
    estimator: str | None = None
    sequence: str | None = None
    seed: int | None = None
    threads: int | None = None
    strict: bool = False
    checkpoint: str | os.PathLike[str] | None = None
    checkpoint_every_s: float | None = None

    def __post_init__(self) -> None:
        _take(self, _share, "rel_tol", "unseen_tol", "confidence")
        _take(self, _number, "abs_tol_lx", "time_s", "checkpoint_every_s")
        _take(self, _name, "tolerance_on", "interval", "estimator", "sequence")
        _take(self, _whole, "samples", "rays", "seed", "threads")
        _take(self, _flag, "strict")
        _take(self, _path, "checkpoint")


@dataclass(frozen=True, kw_only=True)
class ResumeOptions:
    """Options of a run that goes on, by the names of the parameters of `resume`."""

    time_s: float | None = None
    threads: int | None = None
    checkpoint_every_s: float | None = None

    def __post_init__(self) -> None:
        _take(self, _number, "time_s", "checkpoint_every_s")
        _take(self, _whole, "threads")


@dataclass(frozen=True, kw_only=True)
class YearOptions:
    """Options of a year, by the names of the parameters of `annual`."""

    rel_tol: float | str | None = None
    abs_tol_lx: float | None = None
    confidence: float | str | None = None
    samples: int | None = None
    occupied_h: tuple[float, float] | None = None
    seed: int | None = None
    threads: int | None = None

    def __post_init__(self) -> None:
        _take(self, _share, "rel_tol", "confidence")
        _take(self, _number, "abs_tol_lx")
        _take(self, _whole, "samples", "seed", "threads")
        _take(self, _span, "occupied_h")


def _take(options: object, read: Callable[[str, object], object], *names: str) -> None:
    """Put values of the types of Python in the place of what was given."""
    for name in names:
        value = getattr(options, name)
        if value is not None:
            object.__setattr__(options, name, read(name, value))


def _share(name: str, value: object) -> float | str:
    if isinstance(value, str):
        return value
    return _real(name, value, 'a number, or percent as in "1%"')


def _number(name: str, value: object) -> float:
    return _real(name, value, "a number")


def _span(name: str, value: object) -> tuple[float, float]:
    if isinstance(value, str) or not isinstance(value, Sequence) or len(value) != 2:
        raise TypeError(f"{name} is {value!r}; expected two numbers")
    start, end = value
    return _real(name, start, "two numbers"), _real(name, end, "two numbers")


def _whole(name: str, value: object) -> int:
    if isinstance(value, bool) or not isinstance(value, SupportsIndex):
        raise TypeError(f"{name} is {value!r}; expected a whole number")
    return operator.index(value)


def _name(name: str, value: object) -> str:
    if not isinstance(value, str):
        raise TypeError(f"{name} is {value!r}; expected a name")
    return value


def _path(name: str, value: object) -> str | bytes:
    if not isinstance(value, (str, os.PathLike)):
        raise TypeError(f"{name} is {value!r}; expected a path")
    return os.fspath(value)


def _flag(_name: str, value: object) -> bool:
    return bool(value)


def _real(name: str, value: object, expected: str) -> float:
    if isinstance(value, bool) or not isinstance(value, numbers.Real):
        raise TypeError(f"{name} is {value!r}; expected {expected}")
    try:
        return float(value)
    except OverflowError:
        return math.inf if operator.gt(value, 0) else -math.inf
