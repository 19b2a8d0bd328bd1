"""What is known of one sensor, and the picture of one camera."""

from __future__ import annotations

import dataclasses
import json
from functools import cached_property
from typing import TYPE_CHECKING, Any

from quasilux._figure import Figure

if TYPE_CHECKING:
    import numpy as np
    import pandas
    import xarray
    from matplotlib.axes import Axes
    from numpy.typing import NDArray

    from quasilux._result import Result

    Floats = NDArray[np.float64]


@dataclasses.dataclass(frozen=True)
class Grid:
    """The rectangle of a grid.

    Attributes
    ----------
    origin_m, u_m, v_m : tuple of float
        Its corner and its two edges, in m.
    counts : tuple of int
        Numbers of cells along u and v.
    quantity : {"centre", "mean"}
        Whether a value is that at the centre of its cell, or the mean over it.
    target_lx : float or None
        The illuminance that is wanted everywhere.
    """

    origin_m: tuple[float, float, float]
    u_m: tuple[float, float, float]
    v_m: tuple[float, float, float]
    counts: tuple[int, int]
    quantity: str
    target_lx: float | None

    @classmethod
    def _from_entry(cls, entry: dict[str, Any]) -> Grid:
        return cls(
            origin_m=tuple(entry["origin_m"]),
            u_m=tuple(entry["u_m"]),
            v_m=tuple(entry["v_m"]),
            counts=tuple(entry["counts"]),
            quantity=entry["quantity"],
            target_lx=entry["target_lx"],
        )


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

    def __init__(self, result: Result, index: int, entry: dict[str, Any]) -> None:
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

        return _tables.sensor_dataset(self)

    def to_pandas(self) -> pandas.DataFrame:
        """Return the values as a table of pandas, one row a point; see `Result.to_pandas`."""
        from quasilux import _tables

        return _tables.frame([self])

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


class CameraResult:
    """The picture of one camera.

    All arrays are read-only, have rows from the top, and hold no number but nan where the run was
    stopped before there was a picture.
    """

    def __init__(self, result: Result, index: int, entry: dict[str, Any]) -> None:
        self._result = result
        self._index = index
        self._entry = entry

    def __reduce__(self) -> tuple[Any, ...]:
        return _camera_of, (self._result, self.name)

    @property
    def name(self) -> str:
        """The name of the camera."""
        return self._entry["name"]

    @property
    def resolution(self) -> tuple[int, int]:
        """Width and height in pixels."""
        width, height = self._entry["resolution"]
        return width, height

    @property
    def samples(self) -> int:
        """Paths of each pixel in each replicate; 0 where there is no picture."""
        return self._entry["samples"]

    @cached_property
    def _arrays(self) -> dict[str, Any]:
        arrays = self._result._outcome.camera_arrays(self._index)
        if arrays is not None:
            return arrays
        import numpy as np

        width, height = self.resolution
        blank = np.full((height, width, 3), np.nan, np.float32)
        blank.flags.writeable = False
        plane = blank[..., 0]
        planes = ("luminance_cd_m2", "half_width_cd_m2", "unseen_cd_m2")
        return {"rgb_cd_m2": blank} | dict.fromkeys(planes, plane)

    @property
    def luminance_cd_m2(self) -> NDArray[np.float32]:
        """Luminance of each pixel in cd/m2, shape (height, width)."""
        return self._arrays["luminance_cd_m2"]

    @property
    def half_width_cd_m2(self) -> NDArray[np.float32]:
        """Half the width of each luminance's interval in cd/m2, shape (height, width)."""
        return self._arrays["half_width_cd_m2"]

    @property
    def unseen_cd_m2(self) -> NDArray[np.float32]:
        """Luminance of each pixel in cd/m2 at most that no sample met, with a confidence of 95 %,
        shape (height, width): infinite where nothing is known, not a number of plain paths."""
        return self._arrays["unseen_cd_m2"]

    @property
    def rgb_cd_m2(self) -> NDArray[np.float32]:
        """Linear RGB of each pixel in cd/m2, shape (height, width, 3)."""
        return self._arrays["rgb_cd_m2"]

    @property
    def mean(self) -> Figure:
        """Mean luminance of the picture in cd/m2."""
        return Figure._from_entry(self._entry["mean_luminance_cd_m2"])

    @property
    def tolerance_reached(self) -> bool:
        """Whether the picture is what was wanted."""
        return self._entry["tolerance_reached"]

    def _file(self, ending: str) -> bytes:
        content = self._result._outcome.file(f"{self.name}.{ending}")
        if content is None:
            raise ValueError(f"the run was stopped before {self.name!r} had a picture")
        return content

    def png(self) -> bytes:
        """Return the picture as it would look on a screen, as a PNG file.

        Raises
        ------
        ValueError
            Where there is no picture.
        """
        return self._file("png")

    def exr(self) -> bytes:
        """Return colours, luminances and half-widths as an OpenEXR file.

        Raises
        ------
        ValueError
            Where there is no picture.
        """
        return self._file("exr")

    def plot(self, ax: Axes | None = None, *, colorbar: bool = True) -> Axes:
        """Plot luminances in false colours on a logarithmic scale with matplotlib.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, default those of a new figure
            Where to.
        colorbar : bool, default True
            Whether a bar beside it says what colours mean.

        Returns
        -------
        matplotlib.axes.Axes
            The axes.
        """
        from quasilux import _plot

        return _plot.camera(self, ax, colorbar=colorbar)

    def __repr__(self) -> str:
        size = " x ".join(map(str, self.resolution))
        return f"<quasilux.CameraResult {self.name!r}: {size} pixels, mean {self.mean} cd/m²>"

    def _repr_png_(self) -> bytes | None:
        return self.png() if self.samples else None


def _sensor_of(result: Result, name: str) -> SensorResult:
    return result.sensors[name]


def _camera_of(result: Result, name: str) -> CameraResult:
    return result.cameras[name]
