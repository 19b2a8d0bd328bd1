"""What it costs to wait for the bound on unseen light: the same runs with it and without."""

import time
from dataclasses import dataclass
from pathlib import Path
from statistics import median

from contest.programs.quasilux import Quasilux
from contest.room import Room

TOLERANCE = "1%"
LIMIT_SECONDS = 60


@dataclass(frozen=True)
class Bound:
    """Seconds until every point is done, and the largest of what may be unseen over the value."""

    seconds_without: float
    unseen_without: float
    seconds_with: float
    unseen_with: float


def measure(room: Room, quasilux: Quasilux, folder: Path, rounds: int) -> Bound:
    """Both in turn, each round with a seed of its own; medians of the times, the largest shares."""
    folder.mkdir(parents=True, exist_ok=True)
    loaded = quasilux.load(room, folder)
    seconds: dict[str, list[float]] = {"off": [], "5%": []}
    unseen: dict[str, list[float]] = {"off": [], "5%": []}
    for seed in range(1, rounds + 1):
        for wanted in seconds:
            begin = time.perf_counter()
            shares = loaded.unseen(TOLERANCE, wanted, LIMIT_SECONDS, seed)
            seconds[wanted].append(time.perf_counter() - begin)
            unseen[wanted].append(float(shares.max()))
    return Bound(
        median(seconds["off"]), max(unseen["off"]), median(seconds["5%"]), max(unseen["5%"])
    )
