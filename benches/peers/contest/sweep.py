"""Who takes how long for which error: programs take turns, in rounds.

In the first round each program climbs from its least effort, two levels at least, until its error
is well below the goal or the next run would take too long; later rounds repeat its last levels, one
level of every program after the other, with other seeds.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from statistics import median

import numpy as np

from contest.curves import GROWTH, Point
from contest.errors import Deviation, deviation, relative_l2, without_reference
from contest.programs.program import Loaded, Program, Run
from contest.references import Reference
from contest.room import Room

REPEATED_LEVELS = 3


@dataclass(frozen=True)
class Effort:
    """When to stop climbing, and how often to repeat."""

    goal: float
    cap_seconds: float
    rounds: int


@dataclass
class Series:
    """All runs of a program in a room, by level of effort."""

    program: str
    levels: dict[int, list[Run]] = field(default_factory=dict)
    cannot: str | None = None
    warm_up_seconds: float | None = None

    def points(self, reference: Reference) -> list[Point]:
        """For each level the median time and the root of the mean square error."""
        return [
            Point(median(run.seconds for run in runs), _own_error(runs, reference))
            for _, runs in sorted(self.levels.items())
        ]

    def deviation(self, reference: Reference) -> Deviation:
        """Of the average over all sensors, at the highest level."""
        runs = [run.illuminances_lx for run in self.levels[max(self.levels)]]
        return deviation(runs, reference.illuminances_lx, reference.error_of_average)


def measure(
    room: Room,
    reference: Reference,
    programs: list[Program],
    effort: Effort,
    folder: Path,
    say: Callable[[str], None],
) -> list[Series]:
    """All rounds of all programs in one room."""
    series = [Series(program.name, cannot=program.cannot(room)) for program in programs]
    loaded: dict[str, Loaded] = {}
    for program, row in zip(programs, series, strict=True):
        if row.cannot is None:
            own = folder / room.name / program.name.replace(" ", "_")
            own.mkdir(parents=True, exist_ok=True)
            loaded[row.program] = program.load(room, own)
            row.warm_up_seconds = getattr(loaded[row.program], "warm_up_seconds", None)
    for row in series:
        if row.cannot is None:
            _climb(row, loaded[row.program], reference, effort)
            say(f"{room.name}: {row.program}: {_said(row, reference)}")
    for number in range(1, effort.rounds):
        for back in reversed(range(REPEATED_LEVELS)):
            for row in series:
                level = max(row.levels, default=-1) - back
                if level in row.levels:
                    row.levels[level].append(loaded[row.program].run(level, seed=number + 1))
    for handle in loaded.values():
        handle.close()
    return series


def _climb(row: Series, loaded: Loaded, reference: Reference, effort: Effort) -> None:
    level, before_seconds = 0, 0.0
    while True:
        run = loaded.run(level, seed=1)
        row.levels[level] = [run]
        well_below = _own_error([run], reference) <= 0.7 * effort.goal
        too_long = _next_seconds(run.seconds, before_seconds) > effort.cap_seconds
        # One level does not tell start-up from what grows.
        if well_below or (too_long and level > 0) or run.seconds > effort.cap_seconds:
            return
        level, before_seconds = level + 1, run.seconds


def _next_seconds(seconds: float, before_seconds: float) -> float:
    """What the next level takes: the part that grew grows on, start-up does not."""
    grown = max(seconds - before_seconds, 0.0)
    return min(GROWTH * seconds, seconds + GROWTH * grown)


def _error(run: Run, reference: Reference) -> float:
    """Points without a value count as dark."""
    return relative_l2(np.nan_to_num(run.illuminances_lx), reference.illuminances_lx)


def _own_error(runs: list[Run], reference: Reference) -> float:
    square = float(np.mean([_error(run, reference) ** 2 for run in runs]))
    return without_reference(square, reference.error_l2)


def _said(row: Series, reference: Reference) -> str:
    last = row.points(reference)[-1]
    return f"{100 * last.error:.2f} % in {last.seconds:.2f} s at level {max(row.levels)}"
