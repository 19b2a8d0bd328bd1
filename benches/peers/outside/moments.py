"""One moment through both programs: what each sensor gets, and how sure each is.

Radiance is asked for all sensors again and again in one process, from which its own error is known:
`rtrace` has no seed, but goes on in its random numbers.
"""

import json
import os
import subprocess
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from contest.programs.radiance import LUMENS_A_WATT, tool
from contest.room import Diffuse, Vectors
from outside import quadrature, rooms
from outside.blinds import Blinds
from outside.times import Times, timed
from outside.rooms import Windowed
from outside.sky import FORMULA, Outside

DIVISIONS = 4096
OPTIONS = ["-h", "-I", "-dt", "0", "-dc", "1", "-dj", "1", "-st", "0", "-ss", "1", "-aa", "0"]
OPTIONS += ["-as", "0", "-ab", "100", "-lr", "-100"]
"""No ambient cache, no light left out, jittered suns, paths ended by chance alone."""

MIN_REPEATS = 30
"""From fewer the error of a mean is not known well."""

STUDENT_95 = 2.131
"""Of the 16 replicates that make an interval."""

LIMITED = 3
"""What quasilux ends with where time was up before the tolerance."""


@dataclass(frozen=True)
class Answer:
    """Illuminances of the sensors with standard errors, in lx."""

    lx: Vectors
    standard_error_lx: Vectors
    times: Times


@dataclass(frozen=True)
class Moment:
    """A room under a sky, as both see it."""

    place: Windowed
    outside: Outside

    @property
    def is_black(self) -> bool:
        """Whether no surface reflects."""
        return all(kind == Diffuse(0.0) for kind in self.place.room.materials.values())

    @property
    def name(self) -> str:
        """In words."""
        walls = ", black walls" if self.is_black else ""
        return f"{self.place.filling.name}, {self.outside.name}{walls}"


@dataclass(frozen=True)
class Effort:
    """The tolerance of quasilux, and the seconds of the clock: at most for it, for Radiance about.

    Through blinds quasilux takes minutes to a small tolerance; its intervals hold before, too.
    """

    rel_tol: float
    seconds: float


@dataclass(frozen=True)
class Distance:
    """How far one answer is from another, in shares of the other one.

    `share` and its standard error are those of the mean over the sensors; `largest_share` is the
    difference of the sensor where it is largest over its joint standard error, `largest_z`.
    """

    share: float
    standard_error: float
    rms_z: float
    largest_z: float
    largest_share: float


@dataclass(frozen=True)
class Compared:
    """A moment in both programs; in black rooms each from sums that share nothing with them."""

    name: str
    mean_lx: float
    quasilux_error: float
    radiance_error: float
    quasilux_cpu_seconds: float
    radiance_cpu_seconds: float
    radiance_from_quasilux: Distance
    quasilux_from_sums: Distance | None = None
    radiance_from_sums: Distance | None = None


def compare(moment: Moment, binary: Path, effort: Effort, folder: Path) -> Compared:
    """Asks both."""
    quasilux = _ask_quasilux(moment, binary, effort, folder)
    radiance = _ask_radiance(moment, effort.seconds, folder)
    sums: dict[str, Distance] = {}
    blinds = moment.place.filling
    if moment.is_black and isinstance(blinds, Blinds):
        lx = quadrature.illuminances(moment.place, blinds, moment.outside)
        exact = Answer(lx, np.zeros_like(lx), Times(0.0, 0.0))
        sums["quasilux_from_sums"] = distance(exact, quasilux)
        sums["radiance_from_sums"] = distance(exact, radiance)
    return Compared(
        name=moment.name,
        mean_lx=float(quasilux.lx.mean()),
        quasilux_error=_relative_error(quasilux),
        radiance_error=_relative_error(radiance),
        quasilux_cpu_seconds=quasilux.times.cpu_seconds,
        radiance_cpu_seconds=radiance.times.cpu_seconds,
        radiance_from_quasilux=distance(quasilux, radiance),
        **sums,
    )


def distance(base: Answer, other: Answer) -> Distance:
    """Of the other one from the base."""
    difference = other.lx - base.lx
    joint = np.hypot(base.standard_error_lx, other.standard_error_lx)
    z = difference / joint
    mean_lx = float(base.lx.mean())
    worst = int(np.argmax(np.abs(z)))
    return Distance(
        share=float(difference.mean()) / mean_lx,
        standard_error=float(np.linalg.norm(joint)) / len(joint) / mean_lx,
        rms_z=float(np.sqrt(np.mean(z**2))),
        largest_z=float(abs(z[worst])),
        largest_share=float(difference[worst] / base.lx[worst]),
    )


def _ask_quasilux(moment: Moment, binary: Path, effort: Effort, folder: Path) -> Answer:
    project = rooms.write_project(moment.place, moment.outside.project(), folder)
    words = [str(binary), "run", str(project), "--quiet", "--rel-tol", f"{100 * effort.rel_tol:g}%"]
    words += ["--time", f"{effort.seconds:g}s", "--out", str(folder / "out")]
    done = timed(lambda: subprocess.run(words, capture_output=True, text=True))
    if done.result.returncode not in (0, LIMITED):
        raise RuntimeError(f"quasilux ended with {done.result.returncode}: {done.result.stderr}")
    document = json.loads((folder / "out/result.json").read_text())
    points = [point for sensor in document["sensors"] for point in sensor["points"]]
    lx = np.array([point["illuminance_lx"] for point in points])
    half_width_lx = np.array([point["half_width_lx"] for point in points])
    return Answer(lx, half_width_lx / STUDENT_95, done.times)


def _ask_radiance(moment: Moment, seconds: float, folder: Path) -> Answer:
    """Two short runs tell how many repetitions one has time for.

    All are made in one process: each begins with the same random numbers.
    """
    (folder / "general.cal").write_text(FORMULA)
    octree = rooms.write_octree(moment.place, moment.outside.radiance(), folder)
    options = [*OPTIONS, "-n", str(os.cpu_count()), "-ad", str(DIVISIONS)]
    options += ["-lw", repr(1 / DIVISIONS), octree.name]
    given = rooms.sensor_lines(moment.place.room)
    short, longer = (timed(lambda: _traced(options, n * given, folder)).times for n in (1, 5))
    of_one = max(longer.wall_seconds - short.wall_seconds, 0.01) / 4
    repeats = max(MIN_REPEATS, round(seconds / of_one))
    done = timed(lambda: _traced(options, repeats * given, folder))
    rows = done.result.reshape(repeats, -1)
    error = rows.std(axis=0, ddof=1) / np.sqrt(repeats)
    return Answer(rows.mean(axis=0), error, done.times)


def _relative_error(answer: Answer) -> float:
    return float(np.mean(answer.standard_error_lx / answer.lx))


def _traced(options: list[str], given: bytes, folder: Path) -> Vectors:
    said = tool("rtrace", options, folder, given)
    return LUMENS_A_WATT * np.array(said.split(), dtype=np.float64).reshape(-1, 3)[:, 1]
