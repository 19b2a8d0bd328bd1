"""Measured luminaires for Mitsuba: one emitter for all that share a file.

A shadow ray goes to one of them, each as likely as the others, as Mitsuba chooses among its own
emitters. Intensities are linear between the angles of the file, as everywhere else.
"""

from pathlib import Path
from typing import Any

import drjit as dr
import mitsuba as mi
import numpy as np

from contest import photometry
from contest.room import Luminaire

STEP_DEG = 0.5


def emitters(luminaires: list[Luminaire]) -> dict[str, Any]:
    """An emitter for each file."""
    files = sorted({luminaire.file for luminaire in luminaires})
    if len(files) > 1:
        raise ValueError("several files would not be chosen as Mitsuba chooses among emitters")
    return {
        f"luminaires_{i}": _emitter([part for part in luminaires if part.file == file], file)
        for i, file in enumerate(files)
    }


def _emitter(luminaires: list[Luminaire], file: Path) -> "LuminaireGroup":
    group = LuminaireGroup(mi.Properties())
    group.take(luminaires, photometry.read(file).regular(STEP_DEG))
    return group


class LuminaireGroup(mi.Emitter):
    """Point lights with one table of intensities, each with a frame of its own."""

    def __init__(self, properties: mi.Properties) -> None:
        super().__init__(properties)
        self.m_flags = +mi.EmitterFlags.DeltaPosition

    def take(self, luminaires: list[Luminaire], table: np.ndarray) -> None:
        """Holds positions, frames and the table, which has [C, gamma] in steps of STEP_DEG."""
        aims = _unit(np.array([part.aim for part in luminaires]))
        c0 = np.array([part.c0 for part in luminaires])
        c0 = _unit(c0 - aims * np.sum(aims * c0, axis=1, keepdims=True))
        self.count = len(luminaires)
        self.position = mi.Point3f(np.array([part.position for part in luminaires]).T)
        self.aim = mi.Vector3f(aims.T)
        self.c0 = mi.Vector3f(c0.T)
        self.c90 = mi.Vector3f(np.cross(-aims, c0).T)
        self.columns = table.shape[1]
        self.rows = table.shape[0]
        self.table = mi.Float(table.astype(np.float32).ravel())

    def sample_direction(self, it: Any, sample: Any, active: Any = True) -> Any:
        """A direction to one of the luminaires, and its light over the chance of that one."""
        index = dr.minimum(mi.UInt32(sample.x * self.count), self.count - 1)
        position = dr.gather(mi.Point3f, self.position, index, active)
        to_light = position - it.p
        distance_squared = dr.squared_norm(to_light)
        distance = dr.sqrt(distance_squared)
        ds = dr.zeros(mi.DirectionSample3f)
        ds.p = position
        ds.d = to_light / distance
        ds.n = -ds.d
        ds.dist = distance
        ds.time = it.time
        ds.pdf = 1.0 / self.count
        ds.delta = mi.Bool(True)
        ds.emitter = mi.EmitterPtr(self)
        light = self._intensity(-ds.d, index, active) * self.count / distance_squared
        return ds, mi.Spectrum(light) & active

    def pdf_direction(self, it: Any, ds: Any, active: Any = True) -> Any:
        """No ray meets a point by chance."""
        del it, ds, active
        return mi.Float(0.0)

    def eval_direction(self, it: Any, ds: Any, active: Any = True) -> Any:
        """Not asked for by paths."""
        del it, ds, active
        return mi.Spectrum(0.0)

    def eval(self, si: Any, active: Any = True) -> Any:
        """No surface shows it."""
        del si, active
        return mi.Spectrum(0.0)

    def bbox(self) -> Any:
        """Points."""
        return mi.ScalarBoundingBox3f()

    def _intensity(self, direction: Any, index: Any, active: Any) -> Any:
        local = [
            dr.dot(direction, dr.gather(mi.Vector3f, axis, index, active))
            for axis in (self.c0, self.c90, self.aim)
        ]
        gamma = dr.rad2deg(dr.acos(dr.clip(local[2], -1.0, 1.0))) / STEP_DEG
        c = dr.rad2deg(dr.atan2(local[1], local[0]))
        c = dr.select(c < 0.0, c + 360.0, c) / STEP_DEG
        column = dr.minimum(mi.UInt32(gamma), self.columns - 2)
        row = dr.minimum(mi.UInt32(c), self.rows - 2)
        s, t = gamma - mi.Float(column), c - mi.Float(row)
        low = self._between(row, column, s, active)
        high = self._between(row + 1, column, s, active)
        return dr.fma(high - low, t, low)

    def _between(self, row: Any, column: Any, s: Any, active: Any) -> Any:
        start = row * self.columns + column
        low = dr.gather(mi.Float, self.table, start, active)
        high = dr.gather(mi.Float, self.table, start + 1, active)
        return dr.fma(high - low, s, low)


def _unit(rows: np.ndarray) -> np.ndarray:
    return rows / np.linalg.norm(rows, axis=1, keepdims=True)
