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
(measured surfaces), `quasilux.ray` (simulations on a cluster).
"""

from __future__ import annotations

import importlib
import importlib.util
from typing import TYPE_CHECKING, Any

from quasilux import _native
from quasilux._native import InputError, Progress

if TYPE_CHECKING:
    from quasilux import bsdf, photometry, qmc, ray
    from quasilux._caveat import Caveat
    from quasilux._figure import Figure
    from quasilux._finding import Check, Finding
    from quasilux._result import Result
    from quasilux._scene import Scene, SensorPlace, load
    from quasilux._sensor_result import CameraResult, Grid, SensorResult
    from quasilux._simulation import resume, simulate

__version__: str = _native.__version__

__all__ = [
    "CameraResult",
    "Caveat",
    "Check",
    "Figure",
    "Finding",
    "Grid",
    "InputError",
    "Progress",
    "Result",
    "Scene",
    "SensorPlace",
    "SensorResult",
    "__version__",
    "bsdf",
    "load",
    "photometry",
    "qmc",
    "resume",
    "simulate",
]

# What is imported when it is first asked for: importing the package takes a few milliseconds.
_HOMES = {
    "CameraResult": "_sensor_result",
    "Caveat": "_caveat",
    "Check": "_finding",
    "Figure": "_figure",
    "Finding": "_finding",
    "Grid": "_sensor_result",
    "Result": "_result",
    "Scene": "_scene",
    "SensorPlace": "_scene",
    "SensorResult": "_sensor_result",
    "load": "_scene",
    "resume": "_simulation",
    "simulate": "_simulation",
}
_SUBMODULES = frozenset({"bsdf", "photometry", "qmc", "ray"})


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
