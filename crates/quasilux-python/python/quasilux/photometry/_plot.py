"""Curves of luminaires and lobes of surfaces on axes of matplotlib, which is imported here only."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from quasilux._errors import optional

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes

    from quasilux.photometry._arrays import Floats
    from quasilux.photometry._facts import PlaneCurve

_STYLES = ("-", "--", "-.", ":")
RAYS_DEG = range(0, 360, 30)
# Curves are straight in gamma, so bent in a polar diagram.
_STEP_DEG = 1.0


def new_axes(*, polar: bool) -> Axes:
    """Return axes of a new figure."""
    pyplot: Any = optional("matplotlib.pyplot", "plot")
    figure = pyplot.figure(layout="constrained")
    return figure.add_subplot(projection="polar" if polar else None)


def is_polar(ax: Axes) -> bool:
    """Whether axes are polar."""
    return ax.name == "polar"


def polar_axes(ax: Axes | None) -> Axes:
    """Return polar axes with angle 0 down and angles growing to the right.

    Raises
    ------
    ValueError
        For axes that are not polar.
    """
    ax = new_axes(polar=True) if ax is None else ax
    if not is_polar(ax):
        raise ValueError('found axes that are not polar; expected subplot_kw={"polar": True}')
    polar: Any = ax
    polar.set_theta_zero_location("S")
    polar.set_theta_direction(1)
    return ax


def label_angles(ax: Axes, angles_deg: Sequence[int]) -> None:
    """Write angles at the rays of polar axes, each 30 degrees."""
    polar: Any = ax
    polar.set_thetagrids(RAYS_DEG, [f"{angle}\N{DEGREE SIGN}" for angle in angles_deg])


def style_of(number: int) -> dict[str, Any]:
    """The dashes of a line, which tell lines apart where there is no colour."""
    return {"linestyle": _STYLES[number % len(_STYLES)]}


def intensities(
    ax: Axes | None,
    curves: Sequence[PlaneCurve],
    *,
    kind: str,
    factor: float,
    unit: str,
    line: dict[str, Any],
) -> Axes:
    """Draw the curves of planes.

    Raises
    ------
    ValueError
        For other kinds than ``"polar"`` and ``"cartesian"``.
    """
    if kind == "polar":
        ax = polar_axes(ax)
        ax.set_xlabel(f"intensity / {unit}")
        # Gamma is counted from nadir on both sides.
        label_angles(ax, [min(angle, 360 - angle) for angle in RAYS_DEG])
    elif kind == "cartesian":
        ax = new_axes(polar=False) if ax is None else ax
        ax.set(xlabel="gamma / \N{DEGREE SIGN}", ylabel=f"intensity / {unit}")
    else:
        raise ValueError(f'kind is {kind!r}; expected "polar" or "cartesian"')
    for number, curve in enumerate(curves):
        style: dict[str, Any] = {**style_of(number), "label": curve.name, **line}
        x, y = curve.gamma_deg, factor * curve.intensity_cd
        if kind == "polar":
            x, y = refined(x, y)
            x = np.radians(x)
        ax.plot(x, y, **style)
    if kind == "cartesian":
        above = [curve.intensity_cd[np.abs(curve.gamma_deg) > 90.0] for curve in curves]
        is_down = not any(values.any() for values in above)
        end_deg = 90 if is_down else 180
        ax.set_xlim(-end_deg, end_deg)
        ax.set_xticks(np.arange(-end_deg, end_deg + 1, 30))
    finish(ax)
    return ax


def finish(ax: Axes) -> None:
    """Give axes their scale, and a legend beside what is round."""
    ax.set_ylim(bottom=0.0)
    if not is_polar(ax):
        ax.legend()
        return
    ticker: Any = optional("matplotlib.ticker", "plot")
    polar: Any = ax
    polar.set_rlabel_position(90.0)
    polar.yaxis.set_major_locator(ticker.MaxNLocator(5))
    ax.legend(loc="upper left", bbox_to_anchor=(1.08, 1.0))


def refined(gamma_deg: Floats, value: Floats) -> tuple[Floats, Floats]:
    """Points so close that straight lines between them show how a curve is bent."""
    xs, ys = [gamma_deg[:1]], [value[:1]]
    for x0, x1, y0, y1 in zip(gamma_deg[:-1], gamma_deg[1:], value[:-1], value[1:]):
        share = np.linspace(0.0, 1.0, max(1, int(np.ceil((x1 - x0) / _STEP_DEG))) + 1)[1:]
        xs.append(x0 + share * (x1 - x0))
        ys.append((1.0 - share) * y0 + share * y1)
    return np.concatenate(xs), np.concatenate(ys)


def lobes(ax: Axes | None, curves: Sequence[tuple[str, Floats]], *, line: dict[str, Any]) -> Axes:
    """Draw lobes: an angle from the lower pole in degrees, and f times the cosine, in turn."""
    ax = polar_axes(ax)
    label_angles(ax, [min(angle % 180, 180 - angle % 180) for angle in RAYS_DEG])
    for number, (name, curve) in enumerate(curves):
        style: dict[str, Any] = {**style_of(number), "label": name, **line}
        ax.plot(np.radians(curve[:, 0]), curve[:, 1], **style)
    ax.set_xlabel("f cos in the plane of incidence / (1/sr)")
    finish(ax)
    return ax
