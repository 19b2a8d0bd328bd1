"""Radiance: `rtrace -I` without the ambient cache, at settings that do not bias it.

Every light is asked with certainty (-dt 0 -dc 1), Russian roulette ends paths (-lr -100) and the
number of ambient divisions makes the effort. Panels are sampled all over (-dj 1 -ds 0.1), once a
sensor however many divisions there are: in rooms with panels sensors are asked again and again.
Luminaires go through `ies2rad -i`, a small sphere with the file's intensities, as the other
programs have points. Radiance counts in watts: lumens over 179. Timed is rtrace, which reads the
octree; `oconv`, `ies2rad` and `obj2mesh` are not.
"""

import importlib.metadata
import importlib.util
import os
import subprocess
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from contest import obj
from contest.programs.program import Run
from contest.room import Diffuse, Luminaire, Material, Mirror, Pane, Room

LUMENS_A_WATT = 179.0
RADIUS_M = 0.005
MESH_FROM = 20000


class Radiance:
    """16 ambient divisions at the first level, then four times as many each.

    With panels 256 divisions at all levels, sensors once at the first and four times as often each.
    """

    name = "Radiance"

    def missing(self) -> str | None:
        """The package has the binaries inside."""
        if importlib.util.find_spec("pyradiance") is None:
            return "no Python package pyradiance"
        return None

    def version(self) -> str:
        """Of the binaries and the package."""
        said = tool("rtrace", ["-version"], Path("."), b"").decode()
        return f"{said.split()[1]} (pyradiance {importlib.metadata.version('pyradiance')})"

    def cannot(self, room: Room) -> str | None:
        """It can."""
        del room

    def load(self, room: Room, folder: Path) -> "LoadedRadiance":
        """Writes the room and makes an octree."""
        sources = _write(room, folder)
        octree = folder / "room.oct"
        octree.write_bytes(tool("oconv", ["-r", "16384", *sources], folder, b""))
        rows = np.hstack([room.sensors.positions, room.sensors.normals])
        points = "\n".join(" ".join(f"{x:.7g}" for x in row) for row in rows) + "\n"
        return LoadedRadiance(folder, points.encode(), bool(room.panels))


@dataclass
class LoadedRadiance:
    """An octree and the points to ask for."""

    folder: Path
    points: bytes
    has_panels: bool

    def run(self, effort: int, seed: int) -> Run:
        """Radiance has no seed: each run of a level gives nearly the same."""
        del seed
        divisions, repeats = (256, 4**effort) if self.has_panels else (16 * 4**effort, 1)
        options = ["-h", "-I", "-n", str(os.cpu_count()), "-dt", "0", "-dc", "1"]
        options += ["-ab", "100", "-aa", "0", "-as", "0", "-ad", str(divisions)]
        options += ["-lr", "-100", "-lw", repr(1 / divisions)]
        if self.has_panels:
            options += ["-dj", "1", "-ds", "0.1"]
        begin = time.perf_counter()
        said = tool("rtrace", [*options, "room.oct"], self.folder, repeats * self.points)
        seconds = time.perf_counter() - begin
        rows = np.array(said.split(), dtype=np.float64).reshape(repeats, -1, 3)
        return Run(LUMENS_A_WATT * rows[:, :, 1].mean(axis=0), seconds)

    def close(self) -> None:
        """Files stay for who wants to look."""


def tool(name: str, options: list[str], folder: Path, given: bytes) -> bytes:
    """What a program of the package prints, run in a folder."""
    package = Path(importlib.util.find_spec("pyradiance").origin).parent
    surroundings = {
        **os.environ,
        "RAYPATH": f".:{package / 'lib'}",
        "PATH": f"{package / 'bin'}:{os.environ['PATH']}",
    }
    done = subprocess.run(
        [name, *options], cwd=folder, env=surroundings, input=given, capture_output=True
    )
    if done.returncode != 0:
        raise RuntimeError(f"{name} ended with {done.returncode}: {done.stderr.decode()}")
    return done.stdout


def _write(room: Room, folder: Path) -> list[str]:
    lines = [material(name, kind) for name, kind in room.materials.items()]
    for index, rectangle in enumerate(room.rectangles):
        lines.append(polygon(rectangle.material, f"r{index}", rectangle.corners()))
    for index, panel in enumerate(room.panels):
        watts = panel.luminance_cd_m2 / LUMENS_A_WATT
        lines.append(light(f"panel{index}_light", watts))
        lines.append(polygon(f"panel{index}_light", f"panel{index}", panel.rectangle.corners()))
    for index, point in enumerate(room.points):
        watts = point.intensity_cd / (LUMENS_A_WATT * np.pi * RADIUS_M**2)
        lines.append(light(f"point{index}_light", watts))
        place = " ".join(map(str, point.position))
        lines.append(f"point{index}_light sphere point{index} 0 0 4 {place} {RADIUS_M}")
    for index, mesh in enumerate(room.meshes):
        if len(mesh.triangles) >= MESH_FROM:
            lines.append(_compiled(room, index, folder))
        else:
            for number, corners in enumerate(mesh.vertices[mesh.triangles]):
                lines.append(polygon(mesh.material, f"m{index}_{number}", corners))
    (folder / "room.rad").write_text("\n".join(lines) + "\n")
    if not room.luminaires:
        return ["room.rad"]
    (folder / "lamps.rad").write_bytes(_lamps(room.luminaires, folder))
    return ["room.rad", "lamps.rad"]


def material(name: str, kind: Material) -> str:
    """A material by name."""
    match kind:
        case Diffuse(reflectance):
            return f"void plastic {name} 0 0 5 {' '.join(3 * [str(reflectance)])} 0 0"
        case Mirror(reflectance):
            return f"void mirror {name} 0 0 3 {' '.join(3 * [str(reflectance)])}"
        case Pane(eta):
            return f"void glass {name} 0 0 4 1 1 1 {eta}"


def light(name: str, watts: float) -> str:
    """A material of light sources, of the same radiance in all channels, in W/(sr m2)."""
    return f"void light {name} 0 0 3 {watts:.9g} {watts:.9g} {watts:.9g}"


def polygon(material: str, name: str, corners: np.ndarray) -> str:
    """A polygon; its normal is on the side from which the corners go counter-clockwise."""
    numbers = " ".join(f"{x:.9g}" for x in corners.ravel())
    return f"{material} polygon {name} 0 0 {corners.size} {numbers}"


def _compiled(room: Room, index: int, folder: Path) -> str:
    mesh = room.meshes[index]
    alone = Room("mesh", "", room.sensors, room.materials, meshes=[mesh])
    obj.write(alone, folder / f"mesh{index}.obj", [])
    tool("obj2mesh", [f"mesh{index}.obj", f"mesh{index}.rtm"], folder, b"")
    return f"{mesh.material} mesh mesh{index} 1 mesh{index}.rtm 0 0"


def _lamps(luminaires: list[Luminaire], folder: Path) -> bytes:
    names: dict[Path, str] = {}
    made = b""
    for luminaire in luminaires:
        if luminaire.file not in names:
            names[luminaire.file] = f"lamp{len(names)}"
            options = ["-t", "default", "-i", str(RADIUS_M), "-o", names[luminaire.file]]
            tool("ies2rad", [*options, str(luminaire.file)], folder, b"")
        place = _turn(luminaire) + ["-t", *map(str, luminaire.position)]
        made += tool("xform", [*place, f"{names[luminaire.file]}.rad"], folder, b"")
    return made


def _turn(luminaire: Luminaire) -> list[str]:
    """Rotations about x, y and z that take -z to `aim` and +x to `c0`."""
    aim = np.array(luminaire.aim) / np.linalg.norm(luminaire.aim)
    c0 = np.array(luminaire.c0) - aim * np.dot(aim, luminaire.c0)
    c0 /= np.linalg.norm(c0)
    matrix = np.array([c0, np.cross(-aim, c0), -aim]).T
    about_y = -np.arcsin(np.clip(matrix[2, 0], -1.0, 1.0))
    if abs(matrix[2, 0]) < 1 - 1e-9:
        about_x = np.arctan2(matrix[2, 1], matrix[2, 2])
        about_z = np.arctan2(matrix[1, 0], matrix[0, 0])
    else:
        about_x, about_z = np.arctan2(-matrix[1, 2], matrix[1, 1]), 0.0
    degrees = np.degrees([about_x, about_y, about_z])
    return ["-rx", f"{degrees[0]:.9g}", "-ry", f"{degrees[1]:.9g}", "-rz", f"{degrees[2]:.9g}"]
