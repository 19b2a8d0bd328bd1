"""Mitsuba 3: its `path` integrator with the `independent` sampler, in `llvm_ad_mono`.

The integrator is handed its rays directly: each looks, from half a millimetre away, at a white
diffuse tile of 2 mm at a sensor point, whose radiance times pi is the illuminance. Runs are timed
with the scene loaded and after one run that compiles; files of lamps are given by an emitter of our
own (`mitsuba_luminaires.py`), since Mitsuba reads none.
"""

import ctypes.util
import importlib.util
import os
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from contest.programs.program import Run
from contest.room import Diffuse, Material, Mirror, Pane, Rectangle, Room
from contest.tiles import TILE_M, merged, tiles, two_each

LIBRARY = "/usr/lib/x86_64-linux-gnu/libLLVM-19.so"
LANES = 2**21


class Mitsuba:
    """Samples a sensor: 16 at the first level, then four times as many each."""

    name = "Mitsuba"

    def missing(self) -> str | None:
        """Package and LLVM have to be there."""
        if importlib.util.find_spec("mitsuba") is None:
            return "no Python package mitsuba"
        if "DRJIT_LIBLLVM_PATH" not in os.environ:
            if not Path(LIBRARY).exists() and ctypes.util.find_library("LLVM") is None:
                return "no LLVM; apt-get install libllvm19"
            if Path(LIBRARY).exists():
                os.environ["DRJIT_LIBLLVM_PATH"] = LIBRARY
        return None

    def version(self) -> str:
        """Of the package."""
        return _mitsuba().__version__

    def cannot(self, room: Room) -> str | None:
        """Its paths never meet a point behind glass or in a mirror."""
        pointlike = bool(room.points or room.luminaires)
        if pointlike and any(not isinstance(kind, Diffuse) for kind in room.materials.values()):
            return "no light of points by mirrors and through panes"
        return None

    def load(self, room: Room, folder: Path) -> "LoadedMitsuba":
        """Builds the scene and compiles."""
        del folder
        begin = time.perf_counter()
        loaded = LoadedMitsuba(_scene(room), _mitsuba().load_dict(_integrator()), room)
        loaded.run(0, 0)
        loaded.warm_up_seconds = time.perf_counter() - begin
        return loaded


@dataclass
class LoadedMitsuba:
    """A scene with compiled kernels."""

    scene: Any
    integrator: Any
    room: Room
    warm_up_seconds: float = 0.0

    def run(self, effort: int, seed: int) -> Run:
        """Averages over 16 4^effort paths for each sensor."""
        begin = time.perf_counter()
        count, samples = len(self.room.sensors), 16 * 4**effort
        passes = -(-count * samples // LANES)
        each = -(-samples // passes)
        total = np.zeros(count)
        for index in range(passes):
            total += self.batch_lx(each, (seed * 4096 + index) & 0xFFFFFFFF)
        return Run(total / passes, time.perf_counter() - begin)

    def batch_lx(self, samples: int, seed: int) -> np.ndarray:
        """The mean of `samples` paths for each sensor, in one wave."""
        import drjit as dr

        mi = _mitsuba()
        count = len(self.room.sensors)
        sampler = mi.load_dict({"type": "independent"})
        sampler.seed(seed, count * samples)
        sensor = dr.arange(mi.UInt32, count * samples) // samples
        normal = dr.gather(mi.Vector3f, _columns(self.room.sensors.normals), sensor)
        point = dr.gather(mi.Point3f, _points(self.room.sensors.positions), sensor)
        ray = mi.Ray3f(point + normal * (TILE_M / 4), -normal)
        radiance, _, _ = self.integrator.sample(self.scene, sampler, ray)
        sums = dr.block_sum(mi.Float64(radiance[0]), samples)
        return np.pi * np.array(sums) / samples

    def close(self) -> None:
        """Frees scene and memory."""
        import drjit as dr

        self.scene = None
        dr.flush_malloc_cache()


def _mitsuba() -> Any:
    import mitsuba

    if mitsuba.variant() is None:
        mitsuba.set_variant("llvm_ad_mono")
    return mitsuba


def _integrator() -> dict[str, Any]:
    return {"type": "path", "max_depth": -1}


def _columns(rows: np.ndarray) -> Any:
    return _mitsuba().Vector3f(rows.T.astype(np.float32))


def _points(rows: np.ndarray) -> Any:
    return _mitsuba().Point3f(rows.T.astype(np.float32))


def _scene(room: Room) -> Any:
    mi = _mitsuba()
    parts: dict[str, Any] = {"type": "scene"}
    bsdfs = {name: mi.load_dict(_bsdf(kind)) for name, kind in room.materials.items()}
    for name, bsdf in bsdfs.items():
        vertices, triangles = merged(room, name)
        if len(triangles):
            parts[f"mesh_{name}"] = _mesh(name, vertices, triangles, bsdf)
    corners = tiles(room)
    white = mi.load_dict({"type": "diffuse", "reflectance": 1.0})
    parts["tiles"] = _mesh("tiles", corners.reshape(-1, 3), two_each(len(corners)), white)
    for index, panel in enumerate(room.panels):
        parts[f"panel_{index}"] = {
            "type": "rectangle",
            "to_world": mi.ScalarTransform4f(_square_to(panel.rectangle)),
            "bsdf": {"type": "diffuse", "reflectance": 0.0},
            "emitter": {"type": "area", "radiance": panel.luminance_cd_m2},
        }
    for index, point in enumerate(room.points):
        intensity, position = point.intensity_cd, list(point.position)
        parts[f"point_{index}"] = {"type": "point", "intensity": intensity, "position": position}
    if room.luminaires:
        from contest.programs import mitsuba_luminaires

        parts |= mitsuba_luminaires.emitters(room.luminaires)
    return mi.load_dict(parts)


def _bsdf(kind: Material) -> dict[str, Any]:
    match kind:
        case Diffuse(reflectance):
            inner: dict[str, Any] = {"type": "diffuse", "reflectance": reflectance}
        case Mirror(reflectance):
            inner = {"type": "conductor", "material": "none", "specular_reflectance": reflectance}
        case Pane(eta):
            return {"type": "thindielectric", "int_ior": eta, "ext_ior": 1.0}
    return {"type": "twosided", "bsdf": inner}


def _mesh(name: str, vertices: np.ndarray, triangles: np.ndarray, bsdf: Any) -> Any:
    mi = _mitsuba()
    properties = mi.Properties()
    properties["bsdf"] = bsdf
    properties["face_normals"] = True
    mesh = mi.Mesh(name, len(vertices), len(triangles), properties)
    parameters = mi.traverse(mesh)
    parameters["vertex_positions"] = mi.Float(vertices.astype(np.float32).ravel())
    parameters["faces"] = mi.UInt32(triangles.astype(np.uint32).ravel())
    parameters.update()
    return mesh


def _square_to(rectangle: Rectangle) -> np.ndarray:
    corner, u, v = (np.array(part) for part in (rectangle.corner, rectangle.u, rectangle.v))
    normal = np.cross(u, v)
    columns = [u / 2, v / 2, normal / np.linalg.norm(normal), corner + (u + v) / 2]
    matrix = np.eye(4)
    matrix[:3] = np.array(columns).T
    return matrix
