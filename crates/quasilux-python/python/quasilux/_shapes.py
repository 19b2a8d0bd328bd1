"""What those who draw results and scenes know of them.

A property that is cached is so here, too: type checkers tell one kind from the other.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Any, Protocol

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from quasilux._figure import Figure
    from quasilux._grid import Grid
    from quasilux._native import Outcome
    from quasilux._stored import Stored

    Floats = NDArray[np.float64]


class Place(Protocol):
    """Where a sensor measures."""

    @property
    def name(self) -> str: ...
    @property
    def shape(self) -> tuple[int, ...]: ...


class SensorValues(Place, Protocol):
    """The values of a sensor."""

    @cached_property
    def grid(self) -> Grid | None: ...
    @property
    def positions_m(self) -> Floats: ...
    @property
    def normals(self) -> Floats: ...
    @property
    def illuminance_lx(self) -> Floats: ...
    @property
    def half_width_lx(self) -> Floats: ...


class SensorFigures(Place, Protocol):
    """The figures of a sensor."""

    @property
    def average(self) -> Figure: ...
    @property
    def minimum(self) -> Figure: ...
    @property
    def maximum(self) -> Figure: ...
    @property
    def uniformity(self) -> Figure: ...


class CameraPicture(Protocol):
    """The picture of a camera."""

    @property
    def name(self) -> str: ...
    @property
    def resolution(self) -> tuple[int, int]: ...
    @property
    def samples(self) -> int: ...
    @property
    def mean(self) -> Figure: ...
    @property
    def luminance_cd_m2(self) -> NDArray[np.float32]: ...


class Run(Protocol):
    """The results of a run."""

    @cached_property
    def sensors(self) -> Mapping[str, SensorFigures]: ...
    @cached_property
    def cameras(self) -> Mapping[str, CameraPicture]: ...
    @cached_property
    def settings(self) -> dict[str, Any]: ...
    @property
    def warnings(self) -> tuple[str, ...]: ...
    @property
    def tolerance_reached(self) -> bool: ...
    @property
    def stopped(self) -> str | None: ...
    @property
    def replicates(self) -> int: ...
    @property
    def samples(self) -> int: ...
    @property
    def seconds(self) -> float: ...


class Room(Protocol):
    """A scene."""

    @property
    def name(self) -> str: ...
    @property
    def bounds_m(self) -> Floats: ...
    @property
    def sensors(self) -> Mapping[str, Place]: ...
    @property
    def cameras(self) -> Mapping[str, tuple[int, int]]: ...
    @property
    def warnings(self) -> tuple[str, ...]: ...


class Owner(Protocol):
    """The results that a sensor or a camera is of."""

    @property
    def _outcome(self) -> Outcome | Stored: ...
    @cached_property
    def sensors(self) -> Mapping[str, Any]: ...
    @cached_property
    def cameras(self) -> Mapping[str, Any]: ...
    def to_dict(self) -> dict[str, Any]: ...
