"""A year by Radiance's two-phase method: `rcontrib` once, a matrix of skies from `gendaymtx`.

Grey skies of Reinhart's 2305 patches (`-m 4`), one value of three kept. The product is made here in
single precision, faster than by `dctimestep`, in Radiance's favour. All three count.
"""

import os
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from contest.programs.radiance import LUMENS_A_WATT, tool
from outside import rooms
from outside.hours import GROUND_REFLECTANCE, Hours, Year
from outside.times import timed
from outside.rooms import Windowed

SKY = ["void glow sky 0 0 4 1 1 1 0"]
SKY += ["sky source upper 0 0 4 0 0 1 180", "sky source lower 0 0 4 0 0 -1 180"]


@dataclass(frozen=True)
class Setting:
    """`-ad`, and `-lw` as a multiple of one over it."""

    divisions: int
    weight: float

    @property
    def family(self) -> str:
        """Settings of the same weight."""
        return f"rcontrib -lw {self.weight:g}/ad"

    @property
    def name(self) -> str:
        """The options that differ."""
        return f"-ad {self.divisions} -lw {self.weight / self.divisions:.3g}"

    @property
    def options(self) -> list[str]:
        """For rcontrib; paths end by chance below the weight, after 12 bounces at the latest."""
        return ["-ab", "12", "-lr", "-100", *self.name.split()]


@dataclass
class TwoPhase:
    """A room in a folder, and the weather."""

    place: Windowed
    weather: Path
    folder: Path

    def __post_init__(self) -> None:
        self.octree = rooms.write_octree(self.place, SKY, self.folder).name

    def year(self, setting: Setting) -> Year:
        """One year."""
        done = timed(lambda: self.years(setting, 1)[0])
        return Year(done.result, done.times)

    def years(self, setting: Setting, repeats: int) -> list[Hours]:
        """As many, with random numbers that go on: there is no seed."""
        skies = self._skies()
        given = repeats * rooms.sensor_lines(self.place.room)
        rows = self._coefficients(setting, given)
        of_year = rows.reshape(repeats, len(self.place.room.sensors), -1)
        return [np.matmul(coefficients, skies) for coefficients in of_year]

    def _skies(self) -> Hours:
        """Luminances by patch and hour in cd/m2; patch 0 is the ground."""
        ground = 3 * [str(GROUND_REFLECTANCE)]
        options = ["-m", "4", "-c", "1", "1", "1", "-g", *ground, "-h", "-of", str(self.weather)]
        values = np.frombuffer(tool("gendaymtx", options, self.folder, b""), dtype=np.float32)
        patches = 2306
        return np.float32(LUMENS_A_WATT) * values.reshape(patches, -1, 3)[:, :, 1]

    def _coefficients(self, setting: Setting, given: bytes) -> Hours:
        options = ["-h", "-I+", "-V-", "-n", str(os.cpu_count()), "-faf", *setting.options]
        options += ["-e", "MF:4", "-f", "reinhart.cal", "-b", "rbin", "-bn", "Nrbins", "-m", "sky"]
        said = tool("rcontrib", [*options, self.octree], self.folder, given)
        values = np.frombuffer(said, dtype=np.float32)
        count = given.count(b"\n")
        return np.ascontiguousarray(values.reshape(count, -1, 3)[:, :, 1])
