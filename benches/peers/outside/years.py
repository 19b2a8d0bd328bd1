"""A year through both programs: how far each setting is from what is right, and what it takes.

There are two answers that are taken for right, the means of long years of each program. Those of
rcontrib have the sun on the four nearest patches of the sky, as all two-phase years: against them
settings of rcontrib show their noise alone.
"""

from dataclasses import dataclass
from statistics import median

import numpy as np
from numpy.typing import NDArray

from contest.curves import Point, time_to
from contest.errors import without_reference
from outside.hours import Calendar, Hours, Which, Year

QUASILUX, RCONTRIB = "quasilux", "rcontrib"


@dataclass(frozen=True)
class Limit:
    """What is taken for right, and the noise that is left in it, in lit and in sunless hours."""

    hours: Hours
    noise: float
    sunless_noise: float


@dataclass(frozen=True)
class Limits:
    """One of each program."""

    quasilux: Limit
    rcontrib: Limit


@dataclass(frozen=True)
class Errors:
    """Root mean squares over points and hours of differences in shares of what is right.

    `to_own` is against the limit of the same program, `to_other` against that of the other one;
    `annual_share` is the mean difference of the points' sums over the year from quasilux's, and
    `sda` the share of points with 300 lx in half of the occupied hours.
    """

    to_own: float
    to_other: float
    to_own_sunless: float
    to_other_sunless: float
    annual_share: float
    sda: float


@dataclass(frozen=True)
class Key:
    """A program at a setting, one of a family that makes a curve."""

    program: str
    family: str
    setting: str


@dataclass(frozen=True)
class Level:
    """Times are medians of rounds."""

    key: Key
    wall_seconds: float
    cpu_seconds: float
    errors: Errors


def limit(years: list[Hours], calendar: Calendar) -> Limit:
    """The mean of independent years."""
    many = np.stack(years)
    mean = many.mean(axis=0)
    noise = many.std(axis=0, ddof=1) / np.sqrt(len(years)) / np.maximum(mean, 1e-6)
    lit, sunless = noise[:, calendar.is_lit], noise[:, calendar.is_sunless]
    return Limit(mean, _rms(lit), _rms(sunless))


def level(key: Key, runs: list[Year], limits: Limits, calendar: Calendar) -> Level:
    """What the runs of a setting have in common."""
    found = errors(key.program, [run.hours for run in runs], limits, calendar)
    wall = median(run.times.wall_seconds for run in runs)
    return Level(key, wall, median(run.times.cpu_seconds for run in runs), found)


def errors(name: str, years: list[Hours], limits: Limits, calendar: Calendar) -> Errors:
    """Of years of a program; the variance of what is taken for right is taken off."""
    own, other = limits.quasilux, limits.rcontrib
    if name != QUASILUX:
        own, other = other, own
    lit, sunless = calendar.is_lit, calendar.is_sunless
    return Errors(
        to_own=without_reference(_square(years, own, lit), own.noise),
        to_other=without_reference(_square(years, other, lit), other.noise),
        to_own_sunless=without_reference(_square(years, own, sunless), own.sunless_noise),
        to_other_sunless=without_reference(_square(years, other, sunless), other.sunless_noise),
        annual_share=float(np.mean([_annual_share(it, limits.quasilux) for it in years])),
        sda=float(np.mean([_sda(hours, calendar) for hours in years])),
    )


def families(levels: list[Level]) -> dict[str, list[Level]]:
    """Levels by family, cheapest first."""
    found: dict[str, list[Level]] = {}
    for level in sorted(levels, key=lambda level: level.cpu_seconds):
        found.setdefault(level.key.family, []).append(level)
    return found


def seconds_to(noise: float, levels: list[Level]) -> float:
    """Of the processor, that rcontrib takes to an error from its own limit: the fastest family."""
    curves = families([level for level in levels if level.key.program == RCONTRIB]).values()
    points = [[Point(it.cpu_seconds, it.errors.to_own) for it in curve] for curve in curves]
    return min(time_to(noise, curve, extrapolate=True).seconds for curve in points)


def _square(years: list[Hours], right: Limit, which: Which) -> float:
    shares = [hours[:, which] / right.hours[:, which] - 1 for hours in years]
    return _rms(np.stack(shares)) ** 2


def _annual_share(hours: Hours, right: Limit) -> float:
    return float(np.mean(hours.sum(axis=1) / right.hours.sum(axis=1) - 1))


def _sda(hours: Hours, calendar: Calendar) -> float:
    enough = (hours[:, calendar.is_occupied] >= 300).mean(axis=1) >= 0.5
    return float(enough.mean())


def _rms(values: NDArray[np.floating]) -> float:
    return float(np.sqrt(np.mean(np.square(values, dtype=np.float64))))
