"""Workplanes: a sensor in each space, at a height above its floor, within a wall zone.

A rectangular space gets a grid by the rule of EN 12464-1 that project files have. In other spaces
the points of that grid that lie inside, a wall zone from all walls, are taken. Points outside the
body of the space, as under a roof, or inside another body are left out.
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from quasilux.ifc._inside import Bodies, is_inside
from quasilux.ifc._solids import is_closed

if TYPE_CHECKING:
    from quasilux.ifc._findings import Findings
    from quasilux.ifc._geometry import Floats
    from quasilux.ifc._spaces import Space

# Share of its smallest rectangle that a rectangular footprint fills.
_RECTANGULAR = 0.995
# Narrow spaces keep at least this share of their width.
_LEAST_WIDTH_SHARE = 0.7
_MOST_POINTS = 200_000


@dataclass(frozen=True)
class Terms:
    """How workplanes are laid.

    Attributes
    ----------
    height_m, wall_zone_m : float
        Above the floor, and along the walls.
    origin_m : ndarray of shape (3,)
        What is subtracted from coordinates.
    bodies : Bodies
        Within these no point is to lie.
    """

    height_m: float
    wall_zone_m: float
    origin_m: Floats
    bodies: Bodies


def workplanes(spaces: Sequence[Space], terms: Terms, findings: Findings) -> list[dict[str, Any]]:
    """Return the keys of a sensor for each space that can have one."""
    sensors: list[dict[str, Any]] = []
    taken: set[str] = set()
    for space in spaces:
        sensor = _workplane(space, terms, findings)
        if isinstance(sensor, str):
            place = f'IfcSpace "{space.title}" {space.global_id}'
            findings.note(f"a space {sensor} gets no workplane", place)
        else:
            sensors.append({"name": _free_name(space.title, taken), **sensor})
    return sensors


def _workplane(space: Space, terms: Terms, findings: Findings) -> dict[str, Any] | str:
    """The keys of a sensor, or what a space is that gets none."""
    box = space.box_m
    if space.corners is None or box is None:
        return "without a shape"
    if space.is_outside:
        return "outside"
    if space.is_whole:
        return "made of other spaces"
    if box[1][2] - box[0][2] <= terms.height_m:
        return f"no higher than {terms.height_m:g} m"
    footprint = space.footprint
    if footprint is None or footprint.area < 0.01:
        return "without a floor"
    z = float(box[0][2]) + terms.height_m
    place = f'IfcSpace "{space.title}" {space.global_id}'
    if not _has_level_floor(space.corners):
        findings.note("the floor is not level: the workplane is above its lowest point", place)
    corner, u, v = _rectangle(footprint)
    sides = np.array([np.linalg.norm(u), np.linalg.norm(v)])
    grid = None
    if sides.all() and footprint.area >= _RECTANGULAR * sides.prod():
        grid = _grid(corner, u, v, z, terms)
        points = _grid_points(grid)
    else:
        points = _points(footprint, z, terms.wall_zone_m)
    if not len(points):
        return "too narrow for its wall zone"
    if len(points) > _MOST_POINTS:
        return f"with more than {_MOST_POINTS} points"
    kept = _kept(points, space.corners, terms.bodies, findings, place)
    if not len(kept):
        return "filled by a body"
    if grid is not None and len(kept) == len(points):
        rounded = (np.round(grid["origin"] - terms.origin_m, 6) + 0.0).tolist()
        return {**grid, "origin": rounded, "rule": "en12464", "normal": [0, 0, 1]}
    return {
        "kind": "points",
        "points": (np.round(kept - terms.origin_m, 6) + 0.0).tolist(),
        "normals": [[0, 0, 1]] * len(kept),
    }


def _has_level_floor(corners: Floats) -> bool:
    """Whether the facets of a space at its lowest point have a good part of its area in plan."""
    cross = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    heights = corners[..., 2] - corners[..., 2].min()
    is_low = heights.max(axis=1) < 0.01
    # Facets below and above make up twice the area in plan.
    return bool(np.abs(cross[is_low, 2]).sum() >= 0.45 * np.abs(cross[:, 2]).sum())


def _kept(
    points: Floats, space: Floats, bodies: Bodies, findings: Findings, place: str
) -> Floats:
    """Points within the body of their space and in no other."""
    if is_closed(space):
        is_within = is_inside(points, space)
        if not is_within.all():
            findings.note("points of the workplane outside the space are left out", place)
        points = points[is_within]
    is_free = ~bodies.hold(points)
    if not is_free.all():
        findings.note("points of the workplane inside bodies are left out", place)
    return points[is_free]


def en12464_spacing_m(side_m: float) -> float:
    """Return the largest spacing for a side, by EN 12464-1:2021, 4.4: 0.2 x 5^log10(d)."""
    return min(0.2 * 5.0 ** math.log10(max(side_m, 1e-3)), 10.0)


def _rectangle(footprint: Any) -> tuple[Floats, Floats, Floats]:
    """A corner and the two edges of the smallest rectangle, counter-clockwise, u nearest to x."""
    corners = np.array(footprint.minimum_rotated_rectangle.exterior.coords)[:4, :2]
    edges = np.roll(corners, -1, axis=0) - corners
    if edges[0][0] * edges[1][1] - edges[0][1] * edges[1][0] < 0:
        corners = corners[::-1]
        edges = np.roll(corners, -1, axis=0) - corners
    length = np.linalg.norm(edges, axis=1)
    first = int(np.argmax(np.divide(edges[:, 0], length, where=length > 0, out=np.zeros(4))))
    return corners[first], edges[first], edges[(first + 1) % 4]


def _zone_m(wall_zone_m: float, width_m: float) -> float:
    return min(wall_zone_m, (1.0 - _LEAST_WIDTH_SHARE) / 2.0 * width_m)


def _grid(corner: Floats, u: Floats, v: Floats, z: float, terms: Terms) -> dict[str, Any]:
    """Origin, in coordinates of the model, and edges of a grid for a space that is a rectangle."""
    sides = [float(np.linalg.norm(edge)) for edge in (u, v)]
    insets = [_zone_m(terms.wall_zone_m, side) for side in sides]
    begin = corner + u / sides[0] * insets[0] + v / sides[1] * insets[1]
    edges = [edge * (side - 2 * inset) / side for edge, side, inset in zip((u, v), sides, insets)]
    # Edges of a turned rectangle stay square.
    flat = [[*(np.round(edge, 9) + 0.0).tolist(), 0.0] for edge in edges]
    return {"kind": "grid", "origin": np.array([*begin, z]), "u": flat[0], "v": flat[1]}


def _grid_points(grid: dict[str, Any]) -> Floats:
    """The points that the rule of EN 12464-1 gives to a grid, of shape (n, 3)."""
    edges = np.array([grid["u"], grid["v"]])
    sides = np.linalg.norm(edges, axis=1)
    # The shorter side counts where the other is twice as long or more.
    side = float(sides.min() if sides.max() >= 2 * sides.min() else sides.max())
    counts = [max(1, math.ceil(one / en12464_spacing_m(side) * (1 - 1e-9))) for one in sides]
    if counts[0] * counts[1] > _MOST_POINTS:
        counts = [9, 9]
    s, t = np.meshgrid(*((np.arange(count) + 0.5) / count for count in counts))
    return grid["origin"] + s.reshape(-1, 1) * edges[0] + t.reshape(-1, 1) * edges[1]


def _points(footprint: Any, z: float, wall_zone_m: float) -> Floats:
    """Points of a grid that lie inside a footprint and its wall zone, of shape (n, 3)."""
    import shapely

    corner, u, v = _rectangle(footprint)
    sides = (float(np.linalg.norm(u)), float(np.linalg.norm(v)))
    spacing = en12464_spacing_m(max(sides))
    counts = [max(1, math.ceil(side / spacing)) for side in sides]
    if counts[0] * counts[1] > 10 * _MOST_POINTS:
        return np.zeros((0, 3))
    s, t = np.meshgrid(*((np.arange(count) + 0.5) / count for count in counts))
    flat = corner + s.reshape(-1, 1) * u + t.reshape(-1, 1) * v
    zone = wall_zone_m
    # A narrower zone where nothing is left of the space.
    for _ in range(4):
        inner = footprint.buffer(-zone)
        inside = shapely.contains_xy(inner, flat[:, 0], flat[:, 1])
        if inside.any():
            chosen = flat[inside]
            return np.column_stack([chosen, np.full(len(chosen), z)])
        zone /= 2
    return np.zeros((0, 3))


def _free_name(title: str, taken: set[str]) -> str:
    """A name for a sensor, which is that of its files, too."""
    kept = "".join(c if c.isalnum() or c in "_." else "-" for c in title)
    plain = re.sub(r"-+", "-", kept).strip("-.")[:60] or "space"
    name, number = plain, 2
    while name.casefold() in taken:
        name, number = f"{plain}-{number}", number + 1
    taken.add(name.casefold())
    return name
