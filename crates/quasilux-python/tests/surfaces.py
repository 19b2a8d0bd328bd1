"""Surfaces of every kind, own and of others, for the tests of BSDFs."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from files import corpus
from quasilux import bsdf

KINDS: list[Any] = [
    (side, mode) for side in ("front", "back") for mode in ("reflection", "transmission")
]
WEIGHTS = np.array([0.2126, 0.7152, 0.0722])

# A cap up to 30 degrees, and four patches.
BASIS = (
    "<AngleBasis><AngleBasisName>five</AngleBasisName><AngleBasisBlock><ThetaBounds>"
    "<LowerTheta>0</LowerTheta><UpperTheta>30</UpperTheta></ThetaBounds><nPhis>1</nPhis>"
    "</AngleBasisBlock><AngleBasisBlock><ThetaBounds><LowerTheta>30</LowerTheta><UpperTheta>90"
    "</UpperTheta></ThetaBounds><nPhis>4</nPhis></AngleBasisBlock></AngleBasis>"
)
FIVE = np.arange(1, 26).reshape(5, 5) / 50


def window(blocks):
    """A WINDOW file of matrices over five patches, incident ones along columns."""
    data = "".join(
        "<WavelengthData><Wavelength>Visible</Wavelength><WavelengthDataBlock>"
        f"<WavelengthDataDirection>{name}</WavelengthDataDirection><ColumnAngleBasis>five"
        "</ColumnAngleBasis><RowAngleBasis>five</RowAngleBasis><ScatteringData>"
        f"{','.join(map(str, values.T.ravel()))}</ScatteringData></WavelengthDataBlock>"
        "</WavelengthData>"
        for name, values in blocks.items()
    )
    return (
        "<WindowElement><Optical><Layer><Material><Name>Blind &lt;1&gt;</Name><Thickness "
        'unit="Millimeter">2.5</Thickness></Material><DataDefinition><IncidentDataStructure>Columns'
        f"</IncidentDataStructure>{BASIS}</DataDefinition>{data}</Layer></Optical></WindowElement>"
    ).encode()


MATRIX = window({"Reflection Front": FIVE, "Transmission Front": FIVE[::-1]})
NARROW = (
    b"TypeSym AxiSymmetrical\nTypeColorModel BW\nsigma 1 0\nphi 1 0\ntheta 8 0 2 4 6 8 10 20 90\n"
    b"bw kbdf 1 def\n40 35 21 10 3 0.8 0.05 0.05\nenddef\n"
)


def merl(rgb):
    """A surface that scatters each colour evenly."""
    counts = np.array([6, 6, 12], dtype="<i4")
    scales = np.array([1.0, 1.15, 1.66]) / 1500
    values = np.repeat(np.array(rgb) / scales, counts.prod())
    return counts.tobytes() + values.astype("<f8").tobytes()


def astm():
    """Columns of three channels, from three polar angles."""
    lines = ["VARS theta_i,phi_i,theta_s,phi_s,R,G,B"]
    for theta_i in (0.0, 0.6, 1.2):
        for theta_s in (0.0, 0.5, 1.0, 1.5):
            for phi_s in np.linspace(0, np.pi, 5):
                f = 0.1 + 0.1 * theta_i + 0.05 * np.cos(phi_s) * theta_s
                lines.append(f"{theta_i},0,{theta_s},{phi_s},{f},{0.5 * f},{0.25 * f}")
    return "\n".join(lines).encode()


# Of rank 3: below each branch there are eight nodes, or as many values.
TREE = (
    "<WindowElement><Optical><Layer><DataDefinition><IncidentDataStructure>TensorTree3"
    "</IncidentDataStructure></DataDefinition><WavelengthData><Wavelength>Visible</Wavelength>"
    "<WavelengthDataBlock><WavelengthDataDirection>Reflection Front</WavelengthDataDirection>"
    "<AngleBasis>LBNL/Shirley-Chiu</AngleBasis><ScatteringData>"
    "{ {0.1} {0.3} {0.1 0.4 0.1 0.2 0.1 0.1 0.5 0.3} {0.05} {0.1} {0.3} {0.1} {0.2} }"
    "</ScatteringData>"
    "</WavelengthDataBlock></WavelengthData></Layer></Optical></WindowElement>"
).encode()

MADE = {
    "matrix.xml": MATRIX,
    "tree.xml": TREE,
    "narrow.ddr": NARROW,
    "narrow.ddt": NARROW,
    "narrow.txt": NARROW,
    "red.binary": merl([0.2, 0.1, 0.05]),
    "colour.astm": astm(),
}


def surface_files() -> list[Path]:
    return corpus("bsdf/*")


def surfaces():
    """Every made surface, by name."""
    return {name: bsdf.read(data, name=name) for name, data in MADE.items()}


def tables():
    return [(name, table) for name, surface in surfaces().items() for table in surface.tables]


def close(found, expected, path="", rel=1e-12):
    """Whether two documents are the same but for the rounding of numbers."""
    if isinstance(expected, dict):
        assert found.keys() == expected.keys(), path
        for key in expected:
            close(found[key], expected[key], f"{path}.{key}", rel)
    elif isinstance(expected, list):
        assert len(found) == len(expected), path
        for index, (one, other) in enumerate(zip(found, expected)):
            close(one, other, f"{path}[{index}]", rel)
    elif isinstance(expected, float):
        assert found == pytest.approx(expected, rel=rel, abs=1e-12), path
    else:
        assert found == expected, path


def hemisphere(count=400):
    """Places and weights of solid angle: midpoints in the squared sine and the azimuth."""
    sin2 = (np.arange(count) + 0.5) / count
    phi = 2 * np.pi * (np.arange(2 * count) + 0.5) / (2 * count)
    sine, cosine = np.sqrt(sin2)[:, None], np.sqrt(1 - sin2)[:, None]
    parts = np.broadcast_arrays(sine * np.cos(phi), sine * np.sin(phi), cosine)
    directions = np.stack(parts, axis=-1).reshape(-1, 3)
    # Of projected solid angle all are equal.
    return directions, np.pi / len(directions)
