"""LuxCore: `BAKECPU`, its light maps, onto white tiles of 2 mm at the sensors.

Every tile is one texel. Point lights and IES files are given the flux of the light, which LuxCore
spreads as the file says; panels their luminance. Timed is a session from start to end.
"""

import importlib.metadata
import importlib.util
import os
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from contest import photometry
from contest.programs.program import Run
from contest.room import Diffuse, Luminaire, Material, Mirror, Pane, Room
from contest.tiles import merged, tiles, two_each

SPOT = 0.9
REACH = 0.05
WORKER = Path(__file__).with_name("luxcore_worker.py")


class LuxCore:
    """Samples a texel: 16 at the first level, then four times as many each."""

    name = "LuxCore"

    def missing(self) -> str | None:
        """Package and allocator have to be there."""
        if importlib.util.find_spec("pyluxcore") is None:
            return "no Python package pyluxcore"
        if _allocator() is None:
            return "no libtbbmalloc_proxy beside pyluxcore"
        return None

    def version(self) -> str:
        """Of the package."""
        return importlib.metadata.version("pyluxcore")

    def cannot(self, room: Room) -> str | None:
        """Its paths never meet a point in a mirror."""
        pointlike = bool(room.points or room.luminaires)
        if pointlike and any(isinstance(kind, Mirror) for kind in room.materials.values()):
            return "no light of points by mirrors"
        return None

    def load(self, room: Room, folder: Path) -> "LoadedLuxCore":
        """Starts the worker with the room."""
        _write(room, folder)
        surroundings = {**os.environ, "LD_PRELOAD": str(_allocator())}
        with (folder / "luxcore.log").open("w") as log:
            worker = subprocess.Popen(
                [sys.executable, str(WORKER), str(folder)],
                env=surroundings,
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=log,
                text=True,
            )
        loaded = LoadedLuxCore(worker, folder)
        loaded.answer()
        return loaded


@dataclass
class LoadedLuxCore:
    """A worker that holds a room."""

    worker: subprocess.Popen
    folder: Path

    def run(self, effort: int, seed: int) -> Run:
        """Averages over 16 4^effort paths for each sensor."""
        self.worker.stdin.write(f"{16 * 4**effort} {seed}\n")
        self.worker.stdin.flush()
        seconds = float(self.answer())
        return Run(np.pi * _read_pfm(self.folder / "tiles.pfm"), seconds)

    def answer(self) -> str:
        """The next line of the worker."""
        line = self.worker.stdout.readline()
        if not line:
            raise RuntimeError(f"LuxCore ended; see {self.folder / 'luxcore.log'}")
        return line.strip()

    def close(self) -> None:
        """Ends the worker."""
        self.worker.stdin.close()
        self.worker.wait()


def _allocator() -> Path | None:
    package = importlib.util.find_spec("pyluxcore")
    beside = Path(package.origin).parents[1] / "pyluxcore.libs"
    return next(iter(sorted(beside.glob("libtbbmalloc_proxy*"))), None)


def _write(room: Room, folder: Path) -> None:
    arrays: dict[str, np.ndarray] = {}
    lines = [
        "scene.camera.type = perspective",
        "scene.camera.lookat.orig = 0 0 0",
        "scene.camera.lookat.target = 1 0 0",
    ]
    for name, kind in room.materials.items():
        vertices, triangles = merged(room, name)
        if len(triangles):
            arrays[f"{name}_vertices"], arrays[f"{name}_triangles"] = vertices, triangles
            lines += [*_material(name, kind), *_object(name)]
    corners = tiles(room)
    arrays["tiles_vertices"] = corners.reshape(-1, 3)
    arrays["tiles_triangles"] = two_each(len(corners))
    arrays["tiles_uvs"] = _texels(len(corners))
    lines += [*_material("tiles", Diffuse(1.0)), *_object("tiles")]
    for index, panel in enumerate(room.panels):
        name = f"panel{index}"
        arrays[f"{name}_vertices"] = panel.rectangle.corners()
        arrays[f"{name}_triangles"] = two_each(1)
        lines += [*_material(name, Diffuse(0.0)), *_object(name)]
        lines.append(f"scene.materials.{name}.emission = {_grey(panel.luminance_cd_m2)}")
    for index, point in enumerate(room.points):
        light = f"scene.lights.point{index}"
        lines += [f"{light}.type = point", f"{light}.position = {_words(point.position)}"]
        lines.append(f"{light}.color = {_grey(4 * np.pi * point.intensity_cd)}")
    for index, luminaire in enumerate(room.luminaires):
        lines += _luminaire(f"scene.lights.lamp{index}", luminaire)
    np.savez(folder / "scene.npz", **arrays)
    (folder / "scene.cfg").write_text("\n".join(lines) + "\n")


def _luminaire(light: str, luminaire: Luminaire) -> list[str]:
    aim = np.array(luminaire.aim) / np.linalg.norm(luminaire.aim)
    c0 = np.array(luminaire.c0) - aim * np.dot(aim, luminaire.c0)
    c0 /= np.linalg.norm(c0)
    matrix = np.eye(4)
    matrix[0, :3], matrix[1, :3], matrix[2, :3] = c0, np.cross(-aim, c0), -aim
    matrix[3, :3] = luminaire.position
    return [
        f"{light}.type = mappoint",
        f"{light}.iesfile = {luminaire.file}",
        f"{light}.flipz = 1",
        f"{light}.color = {_grey(4 * np.pi * photometry.read(luminaire.file).flux_lm())}",
        f"{light}.transformation = {_words(tuple(matrix.ravel()))}",
    ]


def _material(name: str, kind: Material) -> list[str]:
    material = f"scene.materials.{name}"
    match kind:
        case Diffuse(reflectance):
            return [f"{material}.type = matte", f"{material}.kd = {_grey(reflectance)}"]
        case Mirror(reflectance):
            return [f"{material}.type = mirror", f"{material}.kr = {_grey(reflectance)}"]
        case Pane(eta):
            return [
                f"{material}.type = archglass",
                f"{material}.kr = 1 1 1",
                f"{material}.kt = 1 1 1",
                f"{material}.interiorior = {eta}",
            ]


def _object(name: str) -> list[str]:
    return [f"scene.objects.{name}.shape = {name}", f"scene.objects.{name}.material = {name}"]


def _texels(count: int) -> np.ndarray:
    """A spot for each tile that falls into its texel alone: baking is half a texel off."""
    middle = (np.arange(count) + SPOT) / count
    left, right = middle - REACH / count, middle + REACH / count
    low, high = np.full(count, 0.5 - REACH), np.full(count, 0.5 + REACH)
    corners = [[left, low], [right, low], [right, high], [left, high]]
    return np.moveaxis(np.array(corners), 2, 0).reshape(-1, 2)


def _read_pfm(path: Path) -> np.ndarray:
    """The first channel of the only row of a portable float map."""
    data = path.read_bytes()
    kind, size, scale, rest = data.split(b"\n", 3)
    width = int(size.split()[0])
    order = "<" if float(scale) < 0 else ">"
    channels = 3 if kind == b"PF" else 1
    values = np.frombuffer(rest, dtype=f"{order}f4", count=width * channels)
    return values.reshape(width, channels)[:, 0].astype(np.float64)


def _grey(value: float) -> str:
    return " ".join(3 * [f"{value:.9g}"])


def _words(values: tuple[float, ...]) -> str:
    return " ".join(f"{value:.9g}" for value in values)
