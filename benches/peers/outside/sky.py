"""CIE standard general skies (CIE S 011/E:2003) with a sun, as both programs are told of them.

x points east, y north; luminances are in cd/m2.
"""

import math
from dataclasses import dataclass

import numpy as np

from contest.programs.radiance import LUMENS_A_WATT, light
from contest.room import Vectors

SUN_DEG = 0.533
"""How wide the sun is."""

COEFFICIENTS = {1: (4.0, -0.70, 0.0, -1.0, 0.0), 12: (-1.0, -0.32, 10.0, -3.0, 0.45)}
"""a to e of the types that are used here: the overcast and the clear sky."""

FORMULA = """gamma = acos(if(c - 1, 1, if(-1 - c, -1, c)));
c = Dx * A7 + Dy * A8 + Dz * A9;
z = if(Dz - 1e-4, Dz, 1e-4);
f = 1 + A3 * (exp(A4 * gamma) - exp(A4 * PI / 2)) + A5 * c * c;
general = A6 * f * (1 + A1 * exp(A2 / z));
"""
"""The same formula in Radiance's language; A6 scales it."""


@dataclass(frozen=True)
class Sun:
    """Where the sun is, from north clockwise, and what it gives on a plane across its rays."""

    altitude_deg: float
    azimuth_deg: float
    normal_lx: float = 0.0

    def direction(self) -> Vectors:
        """Toward it."""
        up, around = math.radians(self.altitude_deg), math.radians(self.azimuth_deg)
        aside = math.cos(up)
        return np.array([aside * math.sin(around), aside * math.cos(around), math.sin(up)])


@dataclass(frozen=True)
class Outside:
    """A sky by type, its illuminance, the sun, and the ground."""

    name: str
    kind: int
    sky_lx: float
    sun: Sun
    ground_reflectance: float = 0.2

    def relative_luminance(self, directions: Vectors) -> Vectors:
        """phi times f of the standard, not normalised."""
        a, b, c, d, e = COEFFICIENTS[self.kind]
        cosine = np.clip(directions @ self.sun.direction(), -1.0, 1.0)
        around = 1 + c * (np.exp(d * np.arccos(cosine)) - math.exp(d * math.pi / 2))
        gradation = 1 + a * np.exp(b / np.maximum(directions[:, 2], 1e-4))
        return gradation * (around + e * cosine**2)

    def scale_cd_m2(self) -> float:
        """What makes `relative_luminance` have the wanted illuminance: midpoints of 400 x 800."""
        up, around = 400, 800
        sin2 = (np.arange(up) + 0.5) / up
        azimuth = 2 * math.pi * (np.arange(around) + 0.5) / around
        aside, turn = (grid.ravel() for grid in np.meshgrid(np.sqrt(sin2), azimuth))
        heights = np.sqrt(1 - aside**2)
        rows = np.stack([aside * np.sin(turn), aside * np.cos(turn), heights], axis=1)
        return self.sky_lx / (math.pi * float(self.relative_luminance(rows).mean()))

    def horizontal_lx(self) -> float:
        """Of sky and sun on the ground."""
        return self.sky_lx + self.sun.normal_lx * math.sin(math.radians(self.sun.altitude_deg))

    def project(self) -> list[str]:
        """Lines of a project file of quasilux."""
        shines = "true" if self.sun.normal_lx > 0 else "false"
        lines = ["[sky]", 'model = "cie"', f"type = {self.kind}"]
        lines += [f"horizontal_illuminance_lx = {self.sky_lx}", "[sun]", f"direct = {shines}"]
        lines += [f"altitude_deg = {self.sun.altitude_deg}"]
        lines += [f"azimuth_deg = {self.sun.azimuth_deg}"]
        if self.sun.normal_lx > 0:
            lines.append(f"normal_illuminance_lx = {self.sun.normal_lx}")
        return [*lines, "[ground]", f"reflectance = {self.ground_reflectance}"]

    def radiance(self) -> list[str]:
        """Lines of a scene of Radiance, with `FORMULA` in general.cal."""
        x, y, z = self.sun.direction()
        scale = self.scale_cd_m2() / LUMENS_A_WATT
        ground = self.ground_reflectance * self.horizontal_lx() / (math.pi * LUMENS_A_WATT)
        numbers = (*COEFFICIENTS[self.kind], scale, x, y, z)
        lines = [f"void brightfunc formula 2 general general.cal 0 9 {_words(numbers)}"]
        lines += ["formula glow sky 0 0 4 1 1 1 0", "sky source upper 0 0 4 0 0 1 180"]
        lines += [f"void glow ground 0 0 4 {_words((ground, ground, ground))} 0"]
        lines += ["ground source lower 0 0 4 0 0 -1 180"]
        if self.sun.normal_lx > 0:
            disk = math.pi * math.sin(math.radians(SUN_DEG / 2)) ** 2
            lines += [light("solar", self.sun.normal_lx / (disk * LUMENS_A_WATT))]
            lines += [f"solar source sun 0 0 4 {_words((x, y, z))} {SUN_DEG}"]
        return lines


def _words(numbers: tuple[float, ...]) -> str:
    return " ".join(f"{number:.9g}" for number in numbers)
