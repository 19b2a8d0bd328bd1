"""Results on axes of matplotlib, which is imported here only."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from quasilux import _native
from quasilux._errors import optional

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from numpy.typing import NDArray

    from quasilux._grid import Grid
    from quasilux._shapes import CameraPicture, SensorValues

    Floats = NDArray[np.float64]

_TARGET_INK = "#c4001e"
_NO_VALUE = "#c8c8c8"
_NAMES = {
    "illuminance_lx": "illuminance",
    "half_width_lx": "half-width of the interval",
    "direct_lx": "direct illuminance",
}
_WORLD_AXES = "xyz"
# Shortest contour line with a label, and distance of labels, over the longer side of the plot.
_LEAST_LABELLED = 0.3
_CLEAR = 0.13


def sensor(
    found: SensorValues,
    ax: Axes | None,
    *,
    value: str,
    contours: bool,
    numbers: bool,
    colorbar: bool,
) -> Axes:
    """Plot what `SensorResult.plot` says."""
    optional("matplotlib", "plot")
    if value not in _NAMES:
        raise ValueError(f"value is {value!r}; expected one of {', '.join(map(repr, _NAMES))}")
    axes = _new_axes() if ax is None else ax
    axes.set_title(found.name)
    if found.grid is None:
        _plot_points(found, axes, value)
    else:
        _plot_grid(found, found.grid, axes, value, contours, numbers, colorbar)
    return axes


def camera(found: CameraPicture, ax: Axes | None, *, colorbar: bool) -> Axes:
    """Plot what `CameraResult.plot` says."""
    optional("matplotlib", "plot")
    from matplotlib.colors import LogNorm

    axes = _new_axes() if ax is None else ax
    values = found.luminance_cd_m2
    scale = _native.luminance_scale(values)
    norm = LogNorm(scale["low"], scale["high"], clip=True)
    image = axes.imshow(np.where(values > 0.0, values, scale["low"]), cmap=_colours(), norm=norm)
    axes.set(title=found.name, xticks=[], yticks=[])
    if colorbar:
        axes.figure.colorbar(image, ax=axes, label="luminance (cd/m²)")
    return axes


def _new_axes() -> Axes:
    from matplotlib import pyplot

    return pyplot.figure(layout="constrained").add_subplot()


def _colours() -> Any:
    from matplotlib.colors import ListedColormap

    return ListedColormap(_native.false_colour_map(256), name="quasilux").with_extremes(
        bad=_NO_VALUE
    )


def _plot_points(found: SensorValues, axes: Axes, value: str) -> None:
    values: Floats = getattr(found, value)
    at = np.arange(len(values))
    bars: dict[str, Any] = {"color": _native.false_colour_map(11)[5]}
    if value == "illuminance_lx":
        widths = found.half_width_lx
        bars.update(yerr=np.where(np.isfinite(widths), widths, 0.0), capsize=3.0)
    axes.bar(at, np.nan_to_num(values), **bars)
    axes.set(xlabel="point", ylabel=f"{_NAMES[value]} (lx)", xticks=at[:: max(1, len(at) // 16)])


def _plot_grid(
    found: SensorValues,
    grid: Grid,
    axes: Axes,
    value: str,
    contours: bool,
    numbers: bool,
    colorbar: bool,
) -> None:
    from matplotlib.colors import LogNorm, Normalize

    values: Floats = getattr(found, value)
    scale = _native.false_colour_scale(values, _noise(found, value))
    norm = (LogNorm if scale["is_logarithmic"] else Normalize)(scale["low"], scale["high"])
    sides = [
        _Side.along(edge, grid.origin_m, count, name)
        for edge, count, name in zip((grid.u_m, grid.v_m), grid.counts, "uv", strict=True)
    ]
    mesh = axes.pcolormesh(
        sides[0].borders_m,
        sides[1].borders_m,
        np.ma.masked_invalid(values),
        cmap=_colours(),
        norm=norm,
        shading="flat",
    )
    for set_label, set_limits, side in zip(
        (axes.set_xlabel, axes.set_ylabel), (axes.set_xlim, axes.set_ylim), sides, strict=True
    ):
        set_label(side.title)
        set_limits(side.borders_m[0], side.borders_m[-1])
    axes.set_aspect("equal")
    # Half-widths are noise themselves.
    contours = contours and value != "half_width_lx"
    if contours:
        target_lx = grid.target_lx if value == "illuminance_lx" else None
        _draw_contours(axes, sides, values, scale, target_lx)
    if numbers:
        _draw_numbers(axes, sides, values, norm)
    if colorbar:
        bar = axes.figure.colorbar(mesh, ax=axes, label=f"{_NAMES[value]} (lx)")
        if contours:
            bar.ax.hlines(scale["levels"], 0.0, 1.0, colors="black", linewidth=0.8)
            if grid.target_lx is not None and value == "illuminance_lx":
                bar.ax.axhline(grid.target_lx, color=_TARGET_INK, linewidth=1.8)


def _noise(found: SensorValues, value: str) -> Floats:
    """Half-widths of what is plotted, as far as they are known."""
    if value == "illuminance_lx":
        return found.half_width_lx
    return np.full(found.shape, np.nan)


class _Side:
    """One edge of a grid as an axis: world coordinates where it runs along one of their axes."""

    def __init__(self, title: str, borders_m: Floats) -> None:
        self.title = title
        self.borders_m = borders_m

    @property
    def centres_m(self) -> Floats:
        return 0.5 * (self.borders_m[:-1] + self.borders_m[1:])

    @classmethod
    def along(
        cls,
        edge_m: tuple[float, ...],
        origin_m: tuple[float, ...],
        count: int,
        name: str,
    ) -> _Side:
        """The edge of this name with so many cells."""
        length_m = float(np.linalg.norm(edge_m))
        for axis, letter in enumerate(_WORLD_AXES):
            if abs(edge_m[axis]) > length_m * (1.0 - 1e-9):
                start_m = origin_m[axis]
                return cls(f"{letter} (m)", np.linspace(start_m, start_m + edge_m[axis], count + 1))
        return cls(f"{name} (m)", np.linspace(0.0, length_m, count + 1))


def _draw_contours(
    axes: Axes,
    sides: list[_Side],
    values: Floats,
    scale: _native.ScaleEntry,
    target_lx: float | None,
) -> None:
    if min(values.shape) < 2:
        return
    along, across = (_extended(side) for side in sides)
    field = np.ma.masked_invalid(_extrapolated(values))
    frame = np.array([[along.min(), across.min()], [along.max(), across.max()]])
    labels = dict(zip(scale["levels"], scale["labels"], strict=True))
    taken: list[Floats] = []
    # The wanted illuminance is labelled before others take the room.
    plain = [level for level in scale["levels"] if level != target_lx]
    for levels, style in (
        ([target_lx], {"colors": _TARGET_INK, "linewidths": 1.8, "linestyles": "dashed"}),
        (plain, {"colors": "black", "linewidths": 1.1}),
    ):
        inside = [x for x in levels if x is not None and field.min() < x < field.max()]
        if not inside:
            continue
        lines = axes.contour(along, across, field, levels=inside, **style)
        places = [place for level in lines.allsegs for place in _places(level, frame, taken)]
        if places:
            text = {x: f"{labels.get(x) or format(x, '.4g')} lx" for x in inside}
            axes.clabel(lines, fmt=text, manual=places, fontsize="small")


def _places(lines: list[Floats], frame: Floats, taken: list[Floats]) -> list[tuple[float, float]]:
    """Where labels of a level go: one on each line that is long enough, clear of others."""
    found = []
    size = np.ptp(frame, axis=0).max()
    low, high = frame / size
    for line in lines:
        unit = line / size
        steps = np.linalg.norm(np.diff(unit, axis=0), axis=1)
        if steps.sum() < _LEAST_LABELLED:
            continue
        middle = np.abs(np.cumsum(steps) / steps.sum() - 0.5)
        for number in np.argsort(middle, kind="stable"):
            place = 0.5 * (unit[number] + unit[number + 1])
            is_inside = min((place - low).min(), (high - place).min()) > 0.5 * _CLEAR
            if is_inside and all(np.linalg.norm(place - other) > _CLEAR for other in taken):
                taken.append(place)
                found.append(tuple(place * size))
                break
    return found


def _extended(side: _Side) -> Floats:
    """Centres of cells, and the ends of the edge."""
    return np.concatenate([side.borders_m[:1], side.centres_m, side.borders_m[-1:]])


def _extrapolated(values: Floats) -> Floats:
    """Values at centres of cells, and linear beyond them up to the border."""
    for axis in (0, 1):
        first, second, before, last = (np.take(values, [i], axis) for i in (0, 1, -2, -1))
        ends = [1.5 * first - 0.5 * second, values, 1.5 * last - 0.5 * before]
        values = np.concatenate(ends, axis)
    return values


def _draw_numbers(axes: Axes, sides: list[_Side], values: Floats, norm: Any) -> None:
    colours = _native.false_colour_map(256)
    for row, y in enumerate(sides[1].centres_m):
        for column, x in enumerate(sides[0].centres_m):
            value = values[row, column]
            if np.isfinite(value):
                colour = colours[int(np.clip(float(norm(value)), 0.0, 1.0) * 255)]
                ink = "white" if colour @ [0.2126, 0.7152, 0.0722] < 0.45 else "black"
                axes.text(x, y, f"{value:.3g}", ha="center", va="center", color=ink, fontsize=7)
