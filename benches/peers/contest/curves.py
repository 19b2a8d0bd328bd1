"""When an error is reached: a line through points of (time, error) in logarithms."""

import math
from dataclasses import dataclass
from enum import Enum

GROWTH = 4
"""How much more work each level of effort is than the one before."""


class Found(Enum):
    """Where the wanted error lies among the measured ones."""

    BETWEEN = "between two measured points"
    BEFORE = "below the error of the cheapest run"
    BEYOND = "beyond the dearest run, at the rate of random points"
    NEVER = "not reached"


@dataclass(frozen=True)
class Point:
    """A level of effort: its time and its error."""

    seconds: float
    error: float


@dataclass(frozen=True)
class Reached:
    """The time at which the wanted error is reached."""

    seconds: float
    found: Found


def time_to(wanted: float, points: list[Point], extrapolate: bool) -> Reached:
    """The earliest time at which the curve through the points comes down to `wanted`.

    `points` are in the order of their effort. Where the cheapest run is better already, its time is
    an upper bound. Beyond the last point the curve is drawn out where `extrapolate` allows it.
    """
    if not points:
        return Reached(math.inf, Found.NEVER)
    if points[0].error <= wanted:
        return Reached(points[0].seconds, Found.BEFORE)
    for before, after in zip(points, points[1:]):
        if after.error <= wanted:
            part = math.log(before.error / wanted) / math.log(before.error / after.error)
            log_ratio = math.log(after.seconds / before.seconds)
            return Reached(before.seconds * math.exp(part * log_ratio), Found.BETWEEN)
    if not extrapolate:
        return Reached(math.inf, Found.NEVER)
    return Reached(_drawn_out(wanted, points), Found.BEYOND)


def _drawn_out(wanted: float, points: list[Point]) -> float:
    """Work grows with the inverse square of the error; what start-up takes does not grow."""
    last = points[-1]
    factor = (last.error / wanted) ** 2
    work = last.seconds
    if len(points) > 1 and last.seconds > points[-2].seconds:
        work = min(work, (last.seconds - points[-2].seconds) * GROWTH / (GROWTH - 1))
    return last.seconds + (factor - 1) * work
