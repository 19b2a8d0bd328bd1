"""IFC models (IFC2x3, 4 and 4.3) as projects: rooms, materials, luminaires, workplanes.

>>> from quasilux import ifc
>>> model = ifc.load("office.ifc", space="101", mapping="mapping.toml")  # doctest: +SKIP
>>> model.write("office.toml")  # doctest: +SKIP

``python -m quasilux.ifc office.ifc --out office.toml`` does the same on the command line, and
``--list`` shows what a mapping may name. What the project has otherwise than the model, and every
default, is one of `Imported.findings`.

Needs the extra ``quasilux[ifc]``: `ifcopenshell`, under the LGPL.
"""

from __future__ import annotations

from quasilux.ifc._findings import Finding
from quasilux.ifc._imported import Imported
from quasilux.ifc._reading import load, survey
from quasilux.ifc._survey import SpaceEntry, Survey

__all__ = ["Finding", "Imported", "SpaceEntry", "Survey", "load", "survey"]
