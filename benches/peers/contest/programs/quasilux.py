"""quasilux as a user runs it: one command for each run, start-up and loading in its time."""

import json
import subprocess
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from contest import obj
from contest.programs.program import Run
from contest.room import Diffuse, Material, Mirror, Pane, Room

REPOSITORY = Path(__file__).resolve().parents[4]
BUILT_HERE = REPOSITORY / "target/release/quasilux"


@dataclass
class Quasilux:
    """`quasilux run --samples`: 16 indices a replicate at the first level, then four times as many.

    There are 16 replicates. The tolerance only stops points that are far better than the goals.
    """

    name: str
    estimator: str
    binary: Path = BUILT_HERE

    def missing(self) -> str | None:
        """The release build has to exist."""
        if self.binary.exists():
            return None
        return f"no {self.binary}; cargo build --release -p quasilux"

    def version(self) -> str:
        """As the program states it, and the commit of the tree where it was built in it."""
        said = subprocess.run([self.binary, "--version"], capture_output=True, text=True)
        number = said.stdout.splitlines()[0].split()[-1]
        if self.binary != BUILT_HERE:
            return number
        words = ["git", "-C", str(REPOSITORY), "rev-parse", "--short", "HEAD"]
        commit = subprocess.run(words, capture_output=True, text=True)
        return f"{number} ({commit.stdout.strip()})"

    def cannot(self, room: Room) -> str | None:
        """It can."""
        del room

    def load(self, room: Room, folder: Path) -> "LoadedQuasilux":
        """Writes the project."""
        project = write_project(room, folder)
        return LoadedQuasilux(self, project, folder)


@dataclass
class LoadedQuasilux:
    """A project file."""

    program: Quasilux
    project: Path
    folder: Path

    def run(self, effort: int, seed: int) -> Run:
        """All that a user waits for."""
        begin = time.perf_counter()
        options = ["--estimator", self.program.estimator, "--rel-tol", "0.1%"]
        options += ["--samples", str(16 * 4**effort)]
        self._run([*options, "--seed", str(seed)])
        seconds = time.perf_counter() - begin
        return Run(self._figures("illuminance_lx"), seconds)

    def random_paths(self, samples: int, seed: int) -> Run:
        """Plain paths from random points, as many for each sensor: for references."""
        begin = time.perf_counter()
        options = ["--estimator", "path", "--sequence", "random", "--rel-tol", "0.00001"]
        self._run([*options, "--samples", str(samples), "--seed", str(seed)])
        return Run(self._figures("illuminance_lx"), time.perf_counter() - begin)

    def unseen(self, tolerance: str, unseen: str, limit_seconds: int, seed: int) -> np.ndarray:
        """Runs until both are reached; what may be unseen over the value, at each point."""
        options = ["--estimator", self.program.estimator, "--rel-tol", tolerance]
        options += ["--unseen-tol", unseen, "--time", f"{limit_seconds}s", "--seed", str(seed)]
        self._run(options)
        return self._figures("unseen_lx") / self._figures("illuminance_lx")

    def close(self) -> None:
        """Files stay for who wants to look."""

    def _run(self, options: list[str]) -> None:
        words = [str(self.program.binary), "run", str(self.project), "--quiet"]
        done = subprocess.run(
            [*words, *options, "--out", str(self.folder / "out")], capture_output=True, text=True
        )
        if done.returncode not in (0, 3):
            raise RuntimeError(f"quasilux ended with {done.returncode}: {done.stderr}")

    def _figures(self, key: str) -> np.ndarray:
        result = json.loads((self.folder / "out/result.json").read_text())
        figures = [point[key] for sensor in result["sensors"] for point in sensor["points"]]
        return np.array([np.nan if figure is None else figure for figure in figures])


def write_project(room: Room, folder: Path) -> Path:
    """The project file of a room, with its OBJ beside it."""
    panels = [f"panel{i}" for i in range(len(room.panels))]
    obj.write(room, folder / "room.obj", panels)
    lines = ["[scene]", 'geometry = ["room.obj"]', "", "[materials]"]
    lines += [f"{name} = {material(kind)}" for name, kind in room.materials.items()]
    lines += [f"{name} = {{ reflectance = 0 }}" for name in panels]
    for point in room.points:
        lines += ["", "[[lights]]", 'kind = "point"', f"position = {list(point.position)}"]
        lines += [f"intensity_cd = {point.intensity_cd}"]
    for name, panel in zip(panels, room.panels, strict=True):
        lines += ["", "[[lights]]", 'kind = "area"', f'material = "{name}"']
        lines += [f"luminance_cd_m2 = {panel.luminance_cd_m2}"]
    for luminaire in room.luminaires:
        lines += ["", "[[luminaires]]", f'photometry = "{luminaire.file}"']
        lines += [f"position = {list(luminaire.position)}", f"aim = {list(luminaire.aim)}"]
        lines += [f"c0 = {list(luminaire.c0)}"]
    lines += ["", "[[sensors]]", 'name = "sensors"', 'kind = "points"']
    lines += [f"points = {room.sensors.positions.tolist()}"]
    lines += [f"normals = {room.sensors.normals.tolist()}", ""]
    path = folder / "room.toml"
    path.write_text("\n".join(lines))
    return path


def material(kind: Material) -> str:
    """A material of a project file."""
    match kind:
        case Diffuse(reflectance):
            return f"{{ reflectance = {reflectance} }}"
        case Mirror(reflectance):
            return f'{{ kind = "mirror", reflectance = {reflectance} }}'
        case Pane() as pane:
            angles = [*range(0, 60), *(60 + i / 4 for i in range(121))]
            mirrored = [(angle, pane.reflectance(angle)) for angle in angles]
            reflectance = ", ".join(f"[{angle}, {share:.7f}]" for angle, share in mirrored)
            transmittance = ", ".join(f"[{angle}, {1 - share:.7f}]" for angle, share in mirrored)
            keys = f"transmittance = [{transmittance}], reflectance = [{reflectance}]"
            return f'{{ kind = "pane", {keys} }}'
