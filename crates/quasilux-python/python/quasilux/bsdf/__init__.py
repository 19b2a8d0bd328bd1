r"""Measured surfaces: scattering of WINDOW XML, MERL, ASTM E1392, DDR and DDT files.

A surface is a `Bsdf`: for each side of a thin sheet, what is reflected and what passes, as a
`Table` that keeps the cells of its file and is sampled exactly.

One frame holds for the whole sheet. x and y lie in it, the same two for both sides: seen from the
back, with y up, x points to the right. Directions point away from the sheet, and z is the cosine
of the angle to the normal of the side that a direction is on: it is positive for the incident
direction wi and for the scattered one wo alike, in reflection and in transmission. Light that goes
straight through, or that a mirror reflects, has wo = (-wi.x, -wi.y, wi.z).

>>> from quasilux import bsdf
>>> paper = bsdf.read(b"VARS theta_i,phi_i,theta_s,phi_s,BRDF\n0,0,0,0,0.2\n")
>>> paper
<Bsdf '<bytes>': ASTM E1392; front reflection>
>>> wi = bsdf.direction(theta_deg=[0, 60])
>>> paper.evaluate(wi, [0, 0, 1])
array([0.2, 0.2])
"""

from __future__ import annotations

from quasilux.bsdf._facts import AngleBasis, EnergyBalance, Matrix, Reciprocity
from quasilux.bsdf._surface import Bsdf, read
from quasilux.bsdf._tables import Table, direction
from quasilux.photometry import Diagram, FileWarning

__all__ = [
    "AngleBasis",
    "Bsdf",
    "Diagram",
    "EnergyBalance",
    "FileWarning",
    "Matrix",
    "Reciprocity",
    "Table",
    "direction",
    "read",
]
