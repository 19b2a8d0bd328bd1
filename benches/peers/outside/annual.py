"""A year by `quasilux annual`."""

import csv
import subprocess
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from outside import rooms
from outside.hours import GROUND_REFLECTANCE, Calendar, Year
from outside.moments import LIMITED
from outside.rooms import Windowed
from outside.times import timed

MAX_PATHS = 8192
"""Of a sensor in a replicate of quasilux: more of them than some sensors need for 1 %."""

LIT_LX = 1000.0
"""Hours count in which the sky gives this on the ground, and the sun is up by `LIT_ALTITUDE_DEG`.

Around sunrise programs differ about whether there is a sky at all.
"""

LIT_ALTITUDE_DEG = 3.0


@dataclass
class QuasiluxYears:
    """`quasilux annual` of a room in a folder."""

    binary: Path
    place: Windowed
    weather: Path
    folder: Path

    def __post_init__(self) -> None:
        outside = ["[weather]", f'file = "{self.weather}"', "[sky]", 'model = "weather"']
        outside += ["[ground]", f"reflectance = {GROUND_REFLECTANCE}"]
        self.project = rooms.write_project(self.place, outside, self.folder)

    def year(self, rel_tol: float, seed: int) -> Year:
        """All that a user waits for."""
        words = [str(self.binary), "annual", str(self.project), "--quiet", "--seed", str(seed)]
        words += ["--rel-tol", f"{100 * rel_tol:g}%", "--samples", str(MAX_PATHS)]
        words += ["--out", str(self.folder / "out")]
        done = timed(lambda: subprocess.run(words, capture_output=True, text=True))
        if done.result.returncode not in (0, LIMITED):
            said = done.result.stderr
            raise RuntimeError(f"quasilux ended with {done.result.returncode}: {said}")
        return Year(np.load(self.folder / "out/hours.npy")[:, 0], done.times)

    def calendar(self) -> Calendar:
        """Which hours are which, from the last year."""
        with (self.folder / "out/hours.csv").open() as file:
            rows = list(csv.DictReader(file))

        def column(name: str) -> NDArray[np.float64]:
            return np.array([float(row[name] or 0) for row in rows])

        is_up = column("sun_altitude_deg") > LIT_ALTITUDE_DEG
        is_lit = (column("sky_horizontal_lx") >= LIT_LX) & is_up
        is_sunless = is_lit & (column("sun_normal_lx") == 0)
        return Calendar(is_lit, is_sunless, column("occupied") > 0)
