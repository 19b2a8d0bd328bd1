"""How many lux, and how sure: lighting simulation with confidence intervals.

>>> import quasilux
>>> scene = quasilux.Scene(
...     vertices=[[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0]],
...     triangles=[[0, 1, 2], [0, 2, 3]],
...     materials={"wood": {"reflectance": 0.4}},
...     lights=[{"kind": "point", "position": [1, 1, 2], "intensity_cd": 300}],
...     sensors={"desk": {"kind": "points", "points": [[1, 1, 0.8]], "normals": [[0, 0, 1]]}},
... )
>>> result = quasilux.simulate(scene)
>>> print(f"{result['desk'].illuminance_lx[0]:.1f} lx")
208.3 lx

Submodules: `quasilux.qmc` (point sets), `quasilux.photometry` (luminaires), `quasilux.bsdf`
(measured surfaces), `quasilux.sky` (skies and the sun), `quasilux.ray` (simulations on a cluster),
`quasilux.ifc` (models of buildings).
"""

from __future__ import annotations

import importlib
import importlib.util
from typing import TYPE_CHECKING, Any

from quasilux import _native
from quasilux._native import InputError, Progress, YearProgress

if TYPE_CHECKING:
    from quasilux import bsdf, ifc, photometry, qmc, ray, sky
    from quasilux._annual import annual
    from quasilux._camera_result import CameraResult
    from quasilux._caveat import Caveat
    from quasilux._figure import Figure
    from quasilux._figures import Figures
    from quasilux._finding import Check, Finding
    from quasilux._grid import Grid
    from quasilux._result import Result
    from quasilux._scene import Scene, SensorPlace, load
    from quasilux._sensor_result import SensorResult
    from quasilux._sensor_year import DaylightLevel, SensorYear, ShareOfPoints
    from quasilux._simulation import resume, simulate
    from quasilux._year import BlindsOfYear, Calendar, LampZone, Year

__version__: str = _native.__version__

__all__ = [
    "BlindsOfYear",
    "Calendar",
    "CameraResult",
    "Caveat",
    "Check",
    "DaylightLevel",
    "Figure",
    "Figures",
    "Finding",
    "Grid",
    "InputError",
    "LampZone",
    "Progress",
    "Result",
    "Scene",
    "SensorPlace",
    "SensorResult",
    "SensorYear",
    "ShareOfPoints",
    "Year",
    "YearProgress",
    "__version__",
    "annual",
    "bsdf",
    "ifc",
    "load",
    "photometry",
    "qmc",
    "resume",
    "simulate",
    "sky",
]

# What is imported when it is first asked for: importing the package takes a few milliseconds.
_HOMES = {
    "BlindsOfYear": "_year",
    "Calendar": "_year",
    "CameraResult": "_camera_result",
    "Caveat": "_caveat",
    "Check": "_finding",
    "DaylightLevel": "_sensor_year",
    "Figure": "_figure",
    "Figures": "_figures",
    "Finding": "_finding",
    "Grid": "_grid",
    "LampZone": "_year",
    "Result": "_result",
    "Scene": "_scene",
    "SensorPlace": "_scene",
    "SensorResult": "_sensor_result",
    "SensorYear": "_sensor_year",
    "ShareOfPoints": "_sensor_year",
    "Year": "_year",
    "annual": "_annual",
    "load": "_scene",
    "resume": "_simulation",
    "simulate": "_simulation",
}
_SUBMODULES = frozenset({"bsdf", "ifc", "photometry", "qmc", "ray", "sky"})


def __getattr__(name: str) -> Any:
    if name in _SUBMODULES:
        return importlib.import_module(f"quasilux.{name}")
    home = _HOMES.get(name)
    if home is None:
        raise AttributeError(f"module 'quasilux' has no attribute {name!r}")
    found = getattr(importlib.import_module(f"quasilux.{home}"), name)
    globals()[name] = found
    return found


def __dir__() -> list[str]:
    # Ray is an extra.
    ray = {"ray"} if importlib.util.find_spec("ray") else set[str]()
    return sorted({*globals(), *__all__, *ray})
