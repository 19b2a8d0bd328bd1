"""Luminaires: measured intensities of IES, EULUMDAT and TM-33 files, or of one's own arrays.

A luminaire is a `Photometry`: a table of luminous intensities over directions, with the facts of
its file. It is integrated and sampled exactly.

>>> from quasilux import photometry
>>> lamp = photometry.from_intensities(0, [0, 60, 90], [500, 300, 0], name="Downlight")
>>> lamp.to_dict()["principal_planes"][0]["beam"]["angle_deg"]
130.0
"""

from __future__ import annotations

from quasilux.photometry._diagram import Diagram
from quasilux.photometry._facts import (
    Analysis,
    Encoded,
    EncodingNote,
    EulumdatFacts,
    Facts,
    FileWarning,
    FluxCode,
    Grid,
    Keyword,
    LuminousShape,
    Maximum,
    PlaneCurve,
    Spread,
    TiltFactor,
    TiltTable,
)
from quasilux.photometry._luminaire import Photometry
from quasilux.photometry._reading import from_intensities, read

__all__ = [
    "Analysis",
    "Diagram",
    "Encoded",
    "EncodingNote",
    "EulumdatFacts",
    "Facts",
    "FileWarning",
    "FluxCode",
    "Grid",
    "Keyword",
    "LuminousShape",
    "Maximum",
    "Photometry",
    "PlaneCurve",
    "Spread",
    "TiltFactor",
    "TiltTable",
    "from_intensities",
    "read",
]
