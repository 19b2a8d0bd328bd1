"""The picture of one camera."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any

from quasilux._figure import Figure

if TYPE_CHECKING:
    import numpy as np
    from matplotlib.axes import Axes
    from numpy.typing import NDArray

    from quasilux._shapes import Owner


class CameraResult:
    """The picture of one camera.

    All arrays are read-only, have rows from the top, and hold no number but nan where the run was
    stopped before there was a picture.
    """

    def __init__(self, result: Owner, index: int, entry: dict[str, Any]) -> None:
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


def _camera_of(result: Owner, name: str) -> CameraResult:
    return result.cameras[name]
