"""What is known of one sensor."""

from __future__ import annotations

import json
import os
from functools import cached_property
from typing import TYPE_CHECKING, Any

from quasilux._figure import Figure
from quasilux._figures import Figures, of_points
from quasilux._grid import Grid
from quasilux._whole_file import write_whole

if TYPE_CHECKING:
    import numpy as np
    import pandas
    import xarray
    from matplotlib.axes import Axes
    from numpy.typing import NDArray

    from quasilux._shapes import Owner

    Floats = NDArray[np.float64]


class SensorResult:
    """What is known of one sensor.

    All arrays are read-only. Those of a grid have one row for each step along its second edge, v,
    and one column for each along its first, u.

    Examples
    --------
    >>> import quasilux
    >>> result = quasilux.simulate("examples/cube/cube.toml", rel_tol=0.05)
    >>> wall = result["wall"]
    >>> wall.illuminance_lx.shape, wall.replicates_lx.shape
    ((10, 10), (16, 10, 10))
    >>> abs(wall.average.value - 3141.6) < 2.0 * wall.average.half_width
    True
    """

    def __init__(self, result: Owner, index: int, entry: dict[str, Any]) -> None:
        self._result = result
        self._index = index
        self._entry = entry

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> Floats:
        """Return the illuminances, so that numpy takes a sensor for them."""
        import numpy as np

        values = self.illuminance_lx
        if copy is False and dtype is not None and np.dtype(dtype) != values.dtype:
            raise ValueError(f"a copy is needed for {np.dtype(dtype)}")
        return values.astype(dtype or values.dtype, copy=bool(copy))

    def __reduce__(self) -> tuple[Any, ...]:
        return _sensor_of, (self._result, self.name)

    @property
    def name(self) -> str:
        """The name of the sensor."""
        return self._entry["name"]

    @cached_property
    def grid(self) -> Grid | None:
        """The rectangle of a grid; None for single points."""
        entry = json.loads(self._result._outcome.grids())[self._index]
        return None if entry is None else Grid._from_entry(entry)

    @cached_property
    def _arrays(self) -> dict[str, Any]:
        return self._result._outcome.sensor_arrays(self._index)

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape of the arrays: (v, u) of a grid, (n,) of points."""
        return self.illuminance_lx.shape

    @property
    def illuminance_lx(self) -> Floats:
        """Illuminance in lx, shape (v, u) or (n,); not a number where it is undefined."""
        return self._arrays["illuminance_lx"]

    @property
    def half_width_lx(self) -> Floats:
        """Half the width of each interval in lx, shape (v, u) or (n,).

        Not a number where there is no interval.
        """
        return self._arrays["half_width_lx"]

    @property
    def unseen_lx(self) -> Floats:
        """Light in lx at most that no sample met, with 95 %, shape (v, u) or (n,).

        Infinite where nothing is known; not a number where the estimator has no bound.
        """
        return self._arrays["unseen_lx"]

    @property
    def certified_lower_lx(self) -> Floats:
        """What the illuminance is at least, certified, in lx, shape (v, u) or (n,).

        Not a number where it was not asked for.
        """
        return self._arrays["certified_lower_lx"]

    @property
    def certified_upper_lx(self) -> Floats:
        """What the illuminance is at most, certified, in lx, shape (v, u) or (n,).

        Infinite where nothing certain is known; not a number where it was not asked for.
        """
        return self._arrays["certified_upper_lx"]

    @property
    def merged_lx(self) -> Floats:
        """What of the illuminance is known as a mean over a disc, in lx, shape (v, u) or (n,).

        Not a number where the estimator has no discs.
        """
        return self._arrays["merged_lx"]

    @property
    def disc_radius_m(self) -> Floats:
        """Radius of that disc in m, shape (v, u) or (n,); not a number where there is none."""
        return self._arrays["disc_radius_m"]

    @property
    def replicates_lx(self) -> Floats:
        """Illuminance of each replicate in lx, shape (r, v, u) or (r, n).

        Their mean is the value, and their spread makes the interval.
        """
        return self._arrays["replicates_lx"]

    @property
    def direct_lx(self) -> Floats:
        """What of the illuminance comes straight from the lights, in lx, shape (v, u) or (n,)."""
        return self._arrays["direct_lx"]

    @property
    def samples(self) -> NDArray[np.uint64]:
        """Indices that each replicate used for each point, shape (v, u) or (n,)."""
        return self._arrays["samples"]

    @cached_property
    def status(self) -> NDArray[np.str_] | None:
        """Whether each point is known as well as was asked for, shape (v, u) or (n,).

        Either ``"done"``, or what is missing: its ``"half_width"`` is too large, the bound on
        ``"unseen"`` light is, the ``"average"`` of the sensor is not known well enough, no light
        was found (``"dark"``), too little of light that is rare and bright (``"rare_light"``), or
        there are too few samples (``"few_samples"``). None without a tolerance.
        """
        import numpy as np

        names = self._result._outcome.statuses(self._index)
        if names is None:
            return None
        status = np.array(names, np.str_).reshape(self.shape)
        status.flags.writeable = False
        return status

    @property
    def positions_m(self) -> Floats:
        """Positions in m, centres of cells, shape (v, u, 3) or (n, 3)."""
        return self._arrays["positions_m"]

    @property
    def normals(self) -> Floats:
        """Unit normals; light from their side counts. Shape (v, u, 3) or (n, 3)."""
        return self._arrays["normals"]

    # Daylight factors: shares of the horizontal illuminance outside.

    def _share(self, name: str) -> Figures | None:
        points = self._entry["points"]
        if not points or name not in points[0]:
            return None
        return Figures._of_points(points, name, self.shape)

    @property
    def daylight_factor(self) -> Figures | None:
        """Illuminance over that outside, a share, shape (v, u) or (n,).

        None where something else than the sky shines, as lamps or the sun.
        """
        return self._share("daylight_factor")

    @property
    def sky_component(self) -> Figures | None:
        """What of the daylight factor comes straight from the sky, shape (v, u) or (n,).

        None without a daylight factor, and where there are no openings.
        """
        return self._share("sky_component")

    @property
    def externally_reflected_component(self) -> Figures | None:
        """What of it surfaces beyond the openings, or the ground, reflected last.

        Shape (v, u) or (n,); None as `sky_component` is.
        """
        return self._share("externally_reflected_component")

    @property
    def internally_reflected_component(self) -> Figures | None:
        """What remains of it: surfaces within reflected it last.

        Shape (v, u) or (n,); None as `sky_component` is.
        """
        return self._share("internally_reflected_component")

    @property
    def components_unseen(self) -> Floats | None:
        """What no path met of each of the first two components at most, with 95 %, a share.

        Shape (v, u) or (n,); None as `sky_component` is. Read-only.
        """
        points = self._entry["points"]
        if not points or "components_unseen" not in points[0]:
            return None
        return of_points(points, "components_unseen", self.shape)

    # All points together.

    def _figure(self, name: str) -> Figure:
        return Figure._from_entry(self._entry["summary"][name])

    @property
    def average(self) -> Figure:
        """Mean of the points in lx."""
        return self._figure("average_lx")

    @property
    def minimum(self) -> Figure:
        """Smallest value in lx."""
        return self._figure("minimum_lx")

    @property
    def maximum(self) -> Figure:
        """Largest value in lx."""
        return self._figure("maximum_lx")

    @property
    def uniformity(self) -> Figure:
        """Minimum over average."""
        return self._figure("uniformity")

    def to_xarray(self) -> xarray.Dataset:
        """Return the values as a dataset of xarray.

        Returns
        -------
        xarray.Dataset
            ``illuminance``, ``half_width``, ``unseen``, ``direct``, ``merged`` and ``replicates``,
            in lx; over ``v`` and ``u``, lengths in m along the edges of a grid, or over ``point``;
            with ``x``, ``y`` and ``z``, positions in m.

        Raises
        ------
        ImportError
            Where xarray is not installed.
        """
        from quasilux import _tables

        return _tables.sensor_dataset(self, self._result.to_dict()["run"])

    def to_pandas(self) -> pandas.DataFrame:
        """Return the values as a table of pandas, one row a point; see `Result.to_pandas`."""
        from quasilux import _tables

        return _tables.frame([self])

    def to_csv(self, path: str | os.PathLike[str] | None = None) -> str:
        """Return the values as the file NAME.csv of ``quasilux run`` has them, a line a point.

        Parameters
        ----------
        path : path-like, optional
            Also write it to this file, whole or not at all.

        Raises
        ------
        OSError
            When the file cannot be written.
        """
        content = self._result._outcome.file(f"{self.name}.csv") or b""
        if path is not None:
            write_whole(path, content)
        return content.decode()

    def plot(
        self,
        ax: Axes | None = None,
        *,
        value: str = "illuminance_lx",
        contours: bool = True,
        numbers: bool = False,
        colorbar: bool = True,
    ) -> Axes:
        """Plot the values with matplotlib: a grid in false colours, points as bars.

        The colours, their scale and the values of the contour lines are those of the pictures that
        ``quasilux run`` writes; the wanted illuminance, if there is one, is a dashed line.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, default those of a new figure
            Where to.
        value : {"illuminance_lx", "half_width_lx", "direct_lx"}, default "illuminance_lx"
            What is plotted.
        contours : bool, default True
            Whether a grid has contour lines.
        numbers : bool, default False
            Whether each cell of a grid has its value in it.
        colorbar : bool, default True
            Whether a bar beside a grid says what colours mean.

        Returns
        -------
        matplotlib.axes.Axes
            The axes.

        Raises
        ------
        ImportError
            Where matplotlib is not installed.
        """
        from quasilux import _plot

        return _plot.sensor(
            self,
            ax,
            value=value,
            contours=contours,
            numbers=numbers,
            colorbar=colorbar,
        )

    def __repr__(self) -> str:
        points = " x ".join(map(str, reversed(self.shape)))
        return f"<quasilux.SensorResult {self.name!r}: {points} points, average {self.average} lx>"

    def _repr_png_(self) -> bytes | None:
        return self._result._outcome.file(f"{self.name}.png")


def _sensor_of(result: Owner, name: str) -> SensorResult:
    return result.sensors[name]
