"""A made-up matrix of blinds over Klems' patches, for both programs.

Flat slats as wide as they are apart, which slope by `SLOPE_DEG` and hang askew, hide a share of
what comes; the rest goes straight on within its patch. What slats catch is scattered, more from and
to where they catch more. The file has what passes from the front alone: each program turns it round
by reciprocity.
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from contest.room import Vectors

BANDS = ((5, 1), (15, 8), (25, 16), (35, 20), (45, 24), (55, 24), (65, 24), (75, 16), (90, 12))
"""LBNL/Klems Full: where bands of the polar angle end, in degrees, and their patches."""

SLOPE_DEG = 30.0
ASKEW = 0.3
SCATTERED = 0.25
REFLECTANCE = 0.4
FILE = "blinds.xml"
MIDPOINTS = 20
"""Directions of a patch, each way, over which the gap between slats is averaged."""


@dataclass(frozen=True)
class Patches:
    """Directions in which light goes on, and the projected solid angle of each patch in sr."""

    directions: Vectors
    projected_sr: Vectors


@dataclass(frozen=True)
class Blinds:
    """`peak` says whether what passes between the slats goes straight on, or is scattered, too."""

    peak: bool = True

    @property
    def name(self) -> str:
        """In words."""
        return "Klems blinds" if self.peak else "Klems diffuser"

    def transmission(self) -> Vectors:
        """By exit and incident patch, in sr^-1."""
        cells = patches()
        passing = _gap(cells.directions).mean(axis=1)
        scattered = SCATTERED * np.outer(1 - passing, 1 - passing) / np.pi
        if self.peak:
            return scattered + np.diag(passing / cells.projected_sr)
        return scattered + 0.5 * np.outer(passing, passing) / np.pi

    def project(self, folder: Path) -> str:
        """A material of a project file of quasilux."""
        (folder / FILE).write_text(self._xml())
        return f'{{ kind = "bsdf", file = "{FILE}", up = [0, 0, 1] }}'

    def radiance(self, name: str, folder: Path) -> str:
        """A material of Radiance."""
        (folder / FILE).write_text(self._xml())
        return f"void BSDF {name} 6 0 {FILE} 0 0 1 . 0 0"

    def _xml(self) -> str:
        through = self.transmission()
        mirrored = _reflection()
        blocks = [
            _block("Transmission Front", through),
            _block("Reflection Front", mirrored),
            _block("Reflection Back", mirrored.T),
        ]
        return HEAD + "".join(blocks) + "</Layer></Optical></WindowElement>\n"


HEAD = """<?xml version="1.0" encoding="UTF-8"?>
<WindowElement>
<WindowElementType>System</WindowElementType>
<Optical><Layer>
<Material><Name>blinds</Name><Manufacturer>none</Manufacturer><DeviceType>Other</DeviceType>
</Material>
<DataDefinition><IncidentDataStructure>Columns</IncidentDataStructure></DataDefinition>
"""


def patches() -> Patches:
    """Of the basis, each with `MIDPOINTS` squared directions of equal projected solid angle."""
    directions, projected, low = [], [], 0.0
    parts = (np.arange(MIDPOINTS) + 0.5) / MIDPOINTS
    for upper_deg, count in BANDS:
        high = float(np.sin(np.radians(upper_deg)) ** 2)
        for number in range(count):
            sin2, turn = np.meshgrid(
                low + parts * (high - low), 2 * np.pi * (number + parts - 0.5) / count
            )
            aside = np.sqrt(sin2)
            rows = [aside * np.cos(turn), aside * np.sin(turn), np.sqrt(1 - sin2)]
            directions.append(np.stack([row.ravel() for row in rows], axis=1))
            projected.append(np.pi * (high - low) / count)
        low = high
    return Patches(np.array(directions), np.array(projected))


def _reflection() -> Vectors:
    """Of the front. Light that leaves it in a patch meets slats as light that comes from there."""
    directions = patches().directions
    coming = 1 - _gap(directions).mean(axis=1)
    leaving = 1 - _gap(directions * np.array([-1.0, -1.0, 1.0])).mean(axis=1)
    return REFLECTANCE * np.outer(leaving, coming) / np.pi


def _gap(directions: Vectors) -> Vectors:
    """The share that passes between the slats; y is upward, z is the window's normal."""
    slope = np.radians(SLOPE_DEG)
    rising = (directions[..., 1] + ASKEW * directions[..., 0]) / directions[..., 2]
    return np.clip(1 - np.abs(np.sin(slope) + np.cos(slope) * rising), 0, 1)


def _block(direction: str, values: Vectors) -> str:
    rows = ",\n".join(", ".join(f"{value:.7g}" for value in row) for row in values)
    return (
        "<WavelengthData><LayerNumber>System</LayerNumber>"
        '<Wavelength unit="Integral">Visible</Wavelength>'
        "<SourceSpectrum>CIE Illuminant D65 1nm.ssp</SourceSpectrum>"
        "<DetectorSpectrum>ASTM E308 1931 Y.dsp</DetectorSpectrum>\n"
        f"<WavelengthDataBlock><WavelengthDataDirection>{direction}</WavelengthDataDirection>"
        "<ColumnAngleBasis>LBNL/Klems Full</ColumnAngleBasis>"
        "<RowAngleBasis>LBNL/Klems Full</RowAngleBasis>"
        "<ScatteringDataType>BTDF</ScatteringDataType>\n"
        f"<ScatteringData>\n{rows}\n</ScatteringData></WavelengthDataBlock></WavelengthData>\n"
    )
