"""What the contest asks of a program."""

from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from contest.room import Room


@dataclass(frozen=True)
class Run:
    """Illuminances in lux at all sensors, and what they took."""

    illuminances_lx: NDArray[np.float64]
    seconds: float


class Loaded(Protocol):
    """A room that a program is ready to compute."""

    def run(self, effort: int, seed: int) -> Run:
        """Computes at a level of effort: 0 is the least, each next about four times the work."""

    def close(self) -> None:
        """Frees what it holds."""


class Program(Protocol):
    """A program of the contest."""

    name: str

    def missing(self) -> str | None:
        """Why it cannot run here, or None."""

    def version(self) -> str:
        """The version that runs."""

    def cannot(self, room: Room) -> str | None:
        """Why it cannot compute this room, or None."""

    def load(self, room: Room, folder: Path) -> Loaded:
        """Writes or hands over the room; files go to `folder`."""
