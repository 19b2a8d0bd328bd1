"""What one sensor has of a year."""

from __future__ import annotations

import dataclasses
import os
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from quasilux._figures import Figures, of_points
from quasilux._whole_file import write_whole

if TYPE_CHECKING:
    from numpy.typing import NDArray


@dataclasses.dataclass(frozen=True)
class ShareOfPoints:
    """A share of points, with what it may be.

    Attributes
    ----------
    value : float
        By the estimates, in [0, 1].
    low, high : float
        Of the points that surely count, and of those that do not surely not count.
    """

    value: float
    low: float
    high: float


@dataclasses.dataclass(frozen=True)
class DaylightLevel:
    """The level of EN 17037: 0 none, 1 minimum, 2 medium, 3 high.

    Attributes
    ----------
    level : int
        By the estimates.
    low, high : int
        The lowest and the highest that it may be.
    """

    level: int
    low: int
    high: int


class SensorYear:
    """What one sensor has of a year.

    All arrays are read-only. Those of a grid have one row for each step along its second edge, v,
    and one column for each along its first, u; hours come last. Shares of hours are of the
    occupied ones. Of a year that was stopped, points that are missing have no numbers.
    """

    def __init__(
        self,
        entry: dict[str, Any],
        shape: tuple[int, ...],
        hours: NDArray[np.float32],
        table: str,
    ) -> None:
        self._entry = entry
        self._hours = hours
        self._table = table
        self.shape = shape
        """Shape of the points: (v, u) of a grid, (n,) of points."""

    @property
    def name(self) -> str:
        """The name of the sensor."""
        return self._entry["name"]

    @property
    def illuminance_lx(self) -> NDArray[np.float32]:
        """Illuminance of each hour in lx, shape (v, u, h) or (n, h)."""
        return self._hours[:, 0].reshape(*self.shape, -1)

    @property
    def half_width_lx(self) -> NDArray[np.float32]:
        """Half the width of each interval in lx, shape (v, u, h) or (n, h)."""
        return self._hours[:, 1].reshape(*self.shape, -1)

    @cached_property
    def _points(self) -> list[dict[str, Any]]:
        points = self._entry["points"]
        return points + [{}] * (int(np.prod(self.shape)) - len(points))

    def _figures(self, name: str) -> Figures:
        return Figures._of_points(self._points, name, self.shape)

    def _column(self, name: str) -> NDArray[np.float64]:
        return of_points(self._points, name, self.shape)

    # Measures of each point.

    @property
    def daylight_autonomy(self) -> Figures:
        """Share of hours with enough light, shape (v, u) or (n,)."""
        return self._figures("daylight_autonomy")

    @property
    def continuous_daylight_autonomy(self) -> Figures:
        """The same, where an hour with less counts in part, shape (v, u) or (n,)."""
        return self._figures("continuous_daylight_autonomy")

    @property
    def udi_too_little(self) -> Figures:
        """Share of hours below what is of use, shape (v, u) or (n,)."""
        return self._figures("udi_too_little")

    @property
    def udi_supplementary(self) -> Figures:
        """Share of hours of use, but not enough without lamps, shape (v, u) or (n,)."""
        return self._figures("udi_supplementary")

    @property
    def udi_autonomous(self) -> Figures:
        """Share of hours of use, and enough, shape (v, u) or (n,)."""
        return self._figures("udi_autonomous")

    @property
    def udi_too_much(self) -> Figures:
        """Share of hours with more than is of use, shape (v, u) or (n,)."""
        return self._figures("udi_too_much")

    @property
    def sunlit_hours(self) -> Figures:
        """Occupied hours with too much light straight from the sun, in h, shape (v, u) or (n,)."""
        return self._figures("sunlit_hours")

    @property
    def exposure_lx_h(self) -> Figures:
        """Light exposure of all hours in lx h, shape (v, u) or (n,)."""
        return self._figures("exposure_lx_h")

    @property
    def median_daylight_lx(self) -> Figures:
        """What half of the hours with daylight exceed (EN 17037), in lx, shape (v, u) or (n,)."""
        return self._figures("median_daylight_lx")

    @property
    def sunlit_h(self) -> NDArray[np.float64]:
        """How long the point is in the sun by the weather, in h, shape (v, u) or (n,)."""
        return self._column("sunlit_h")

    @property
    def clear_sky_sunlit_h(self) -> NDArray[np.float64]:
        """The same if it were always clear, in h, shape (v, u) or (n,)."""
        return self._column("clear_sky_sunlit_h")

    @property
    def equinox_sunlit_h(self) -> NDArray[np.float64]:
        """The same on 20 March, in h, shape (v, u) or (n,)."""
        return self._column("equinox_sunlit_h")

    # How well it is known.

    @property
    def relative_half_width(self) -> NDArray[np.float64]:
        """Root mean square over hours of half-width over value, shape (v, u) or (n,)."""
        return self._column("relative_half_width")

    @property
    def samples(self) -> NDArray[np.float64]:
        """Paths of each point in each replicate, in all rooms that blinds make.

        Shape (v, u) or (n,).
        """
        return self._column("samples")

    # Measures of all points together.

    @property
    def sda(self) -> ShareOfPoints:
        """Spatial daylight autonomy: points with enough light for half of the hours (LM-83)."""
        return ShareOfPoints(**self._entry["summary"]["sda"])

    @property
    def ase(self) -> ShareOfPoints:
        """Annual sunlight exposure: points with over 250 hours of direct sunlight (LM-83)."""
        return ShareOfPoints(**self._entry["summary"]["ase"])

    @property
    def en17037(self) -> DaylightLevel | None:
        """The level of EN 17037; None where hours are not those of a year."""
        summary = self._entry["summary"]
        if summary["en17037_level"] is None:
            return None
        return DaylightLevel(summary["en17037_level"], *summary["en17037_level_bounds"])

    # Other forms.

    @property
    def positions_m(self) -> NDArray[np.float64]:
        """Positions in m of the points that are over, shape (k, 3), in the order of rows."""
        return np.array([point["position"] for point in self._entry["points"]]).reshape(-1, 3)

    def to_csv(self, path: str | os.PathLike[str] | None = None) -> str:
        """Return the points, a line each, as the file NAME.annual.csv has them.

        Parameters
        ----------
        path : path-like, optional
            Also write it to this file, whole or not at all.

        Raises
        ------
        OSError
            When the file cannot be written.
        """
        if path is not None:
            write_whole(path, self._table.encode())
        return self._table

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> NDArray[Any]:
        """Return the illuminances, so that numpy takes a sensor for them."""
        values = self.illuminance_lx
        if copy is False and dtype is not None and np.dtype(dtype) != values.dtype:
            raise ValueError(f"a copy is needed for {np.dtype(dtype)}")
        return values.astype(dtype or values.dtype, copy=bool(copy))

    def __repr__(self) -> str:
        points = " x ".join(map(str, reversed(self.shape)))
        share, hours = self.sda, self._hours.shape[-1]
        known = f"sDA {100 * share.low:.3g} to {100 * share.high:.3g} %"
        return f"<quasilux.SensorYear {self.name!r}: {points} points, {hours} hours, {known}>"
