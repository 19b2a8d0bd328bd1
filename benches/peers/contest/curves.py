"""When an error is reached: a line through points of (time, error) in logarithms."""

import math
from dataclasses import dataclass
from enum import Enum


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

    Where the cheapest run is better already, its time is an upper bound. Beyond the last point time
    grows with the inverse square of the error where `extrapolate` allows it.
    """
    ordered = sorted(points, key=lambda point: point.seconds)
    if not ordered:
        return Reached(math.inf, Found.NEVER)
    if ordered[0].error <= wanted:
        return Reached(ordered[0].seconds, Found.BEFORE)
    for before, after in zip(ordered, ordered[1:]):
        if after.error <= wanted:
            part = math.log(before.error / wanted) / math.log(before.error / after.error)
            log_ratio = math.log(after.seconds / before.seconds)
            return Reached(before.seconds * math.exp(part * log_ratio), Found.BETWEEN)
    if not extrapolate:
        return Reached(math.inf, Found.NEVER)
    last = ordered[-1]
    return Reached(last.seconds * (last.error / wanted) ** 2, Found.BEYOND)
