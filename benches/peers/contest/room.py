"""What a room is, in words that every program's exporter understands.

Lengths are in metres, z points up. Surfaces are two-sided; panels shine from the side of u x v.
"""

import hashlib
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

Vectors = NDArray[np.float64]


@dataclass(frozen=True)
class Diffuse:
    """A Lambertian surface."""

    reflectance: float


@dataclass(frozen=True)
class Mirror:
    """A perfect mirror, the same at all angles."""

    reflectance: float


@dataclass(frozen=True)
class Pane:
    """A clear flat pane drawn as one sheet: light goes straight through or is mirrored.

    All inner reflections are summed, with the reflectance of unpolarised light at each surface, as
    Mitsuba has it. (Light is polarised after the first surface, and a real pane mirrors less.)
    """

    eta: float

    def reflectance(self, angle_deg: float) -> float:
        """The share that is mirrored; the rest goes through."""
        outer = np.cos(np.radians(angle_deg))
        inner = np.sqrt(1 - (1 - outer**2) / self.eta**2)
        across = (outer - self.eta * inner) / (outer + self.eta * inner)
        along = (self.eta * outer - inner) / (self.eta * outer + inner)
        once = float(across**2 + along**2) / 2
        return 2 * once / (1 + once)


Material = Diffuse | Mirror | Pane


@dataclass(frozen=True)
class Rectangle:
    """A parallelogram from `corner` along `u` and `v`."""

    material: str
    corner: tuple[float, float, float]
    u: tuple[float, float, float]
    v: tuple[float, float, float]

    def corners(self) -> Vectors:
        """The four corners, counter-clockwise seen from the side of u x v."""
        corner, u, v = np.array(self.corner), np.array(self.u), np.array(self.v)
        return np.array([corner, corner + u, corner + u + v, corner + v], dtype=np.float64)


@dataclass(frozen=True)
class Mesh:
    """Triangles of one material."""

    material: str
    vertices: Vectors
    triangles: NDArray[np.int64]


@dataclass(frozen=True)
class PointLight:
    """The same intensity, in cd, in all directions."""

    position: tuple[float, float, float]
    intensity_cd: float


@dataclass(frozen=True)
class Luminaire:
    """A photometric file at a point. gamma = 0 along `aim`, C0 toward `c0`."""

    file: Path
    position: tuple[float, float, float]
    aim: tuple[float, float, float] = (0.0, 0.0, -1.0)
    c0: tuple[float, float, float] = (1.0, 0.0, 0.0)


@dataclass(frozen=True)
class Panel:
    """A rectangle that emits the same luminance in all directions and reflects nothing."""

    rectangle: Rectangle
    luminance_cd_m2: float


@dataclass(frozen=True)
class Sensors:
    """Points at which the illuminance is asked for, away from all surfaces."""

    positions: Vectors
    normals: Vectors

    def __len__(self) -> int:
        return len(self.positions)


@dataclass
class Room:
    """A scene with its sensors."""

    name: str
    title: str
    sensors: Sensors
    materials: dict[str, Material]
    rectangles: list[Rectangle] = field(default_factory=list)
    meshes: list[Mesh] = field(default_factory=list)
    points: list[PointLight] = field(default_factory=list)
    luminaires: list[Luminaire] = field(default_factory=list)
    panels: list[Panel] = field(default_factory=list)

    def triangle_count(self) -> int:
        """Triangles of all surfaces, panels included."""
        flat = 2 * (len(self.rectangles) + len(self.panels))
        return flat + sum(len(mesh.triangles) for mesh in self.meshes)

    def light_count(self) -> int:
        """Lights of all kinds."""
        return len(self.points) + len(self.luminaires) + len(self.panels)

    def digest(self) -> str:
        """Changes when anything changes that the illuminances depend on."""
        sha = hashlib.sha256()
        for part in (self.materials, self.rectangles, self.points, self.panels):
            sha.update(repr(part).encode())
        for mesh in self.meshes:
            sha.update(mesh.material.encode())
            sha.update(np.round(mesh.vertices, 6).tobytes() + mesh.triangles.tobytes())
        for luminaire in self.luminaires:
            sha.update(repr((luminaire.position, luminaire.aim, luminaire.c0)).encode())
            sha.update(luminaire.file.read_bytes())
        sha.update(np.round(self.sensors.positions, 6).tobytes())
        sha.update(np.round(self.sensors.normals, 6).tobytes())
        return sha.hexdigest()[:16]


def grid(
    corner: tuple[float, float, float],
    u: tuple[float, float, float],
    v: tuple[float, float, float],
    counts: tuple[int, int],
    normal: tuple[float, float, float],
) -> Sensors:
    """The centres of counts[0] x counts[1] cells of the rectangle."""
    s, t = np.meshgrid(
        (np.arange(counts[0]) + 0.5) / counts[0], (np.arange(counts[1]) + 0.5) / counts[1]
    )
    positions = np.array(corner) + np.outer(s.ravel(), u) + np.outer(t.ravel(), v)
    return Sensors(positions, np.tile(np.array(normal, dtype=np.float64), (len(positions), 1)))


def joined(parts: list[Sensors]) -> Sensors:
    """All sensors of the parts, in their order."""
    return Sensors(
        np.concatenate([part.positions for part in parts]),
        np.concatenate([part.normals for part in parts]),
    )
