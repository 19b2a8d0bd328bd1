"""Bodies among triangles: which belong together, which are closed, and which face inward."""

from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from quasilux.ifc._geometry import Floats, Shape

_WELD_M = 1e-6


def bodies(corners: Floats) -> list[NDArray[np.intp]]:
    """Return the numbers of the triangles of each body: bodies share no corners."""
    body_of = _body_of(corners)
    order = np.argsort(body_of, kind="stable")
    return np.split(order, np.flatnonzero(np.diff(body_of[order])) + 1)


def _body_of(corners: Floats) -> NDArray[np.int64]:
    triangles = _welded(corners)
    # The lowest number among connected corners, by repeated halving of the way to it.
    parent = np.arange(triangles.max() + 1)
    while True:
        lowest = parent[triangles].min(axis=1)
        new = parent.copy()
        for corner in range(3):
            np.minimum.at(new, triangles[:, corner], lowest)
        new = new[new]
        if (new == parent).all():
            return parent[triangles[:, 0]]
        parent = new


def is_closed(corners: Floats) -> bool:
    """Whether each edge of triangles, of shape (n, 3, 3), is run through both ways."""
    triangles = _welded(corners)
    is_facet = (triangles != np.roll(triangles, 1, axis=1)).all(axis=1)
    begin = triangles[is_facet]
    end = np.roll(begin, -1, axis=1)
    forward = np.sort(begin.ravel() * (triangles.max() + 1) + end.ravel())
    backward = np.sort(end.ravel() * (triangles.max() + 1) + begin.ravel())
    return bool(len(forward) and (forward == backward).all())


def outward(shape: Shape) -> Shape:
    """Return a shape whose closed bodies face outward; hollows within others stay as they are."""
    corners = shape.corners
    is_turned = np.zeros(len(corners), dtype=bool)
    around: list[Floats] = []
    inward: list[NDArray[np.intp]] = []
    for body in bodies(corners):
        if volume_m3(corners[body]) >= 0:
            around.append(_box(corners[body]))
        elif is_closed(corners[body]):
            inward.append(body)
    boxes = np.array(around).reshape(-1, 2, 3)
    for body in inward:
        low, high = _box(corners[body])
        is_around = (boxes[:, 0] <= low).all(axis=1) & (boxes[:, 1] >= high).all(axis=1)
        is_turned[body] = not is_around.any()
    if not is_turned.any():
        return shape
    turned = np.where(is_turned[:, None, None], corners[:, ::-1], corners)
    counts = np.cumsum([len(part.corners) for part in shape.parts])[:-1]
    parts = zip(shape.parts, np.split(turned, counts))
    return dataclasses.replace(
        shape, parts=tuple(dataclasses.replace(part, corners=own) for part, own in parts)
    )


def volume_m3(corners: Floats) -> float:
    """Return the volume of a body by the divergence theorem; below 0 where it faces inward."""
    near = corners - corners[0, 0]
    return float(np.einsum("ij,ij->", near[:, 0], np.cross(near[:, 1], near[:, 2])) / 6)


def _box(corners: Floats) -> Floats:
    points = corners.reshape(-1, 3)
    return np.array([points.min(axis=0), points.max(axis=0)])


def _welded(corners: Floats) -> NDArray[np.int64]:
    """Numbers of corners, of shape (n, 3): those at one place have one number."""
    keys = np.round(corners.reshape(-1, 3) / _WELD_M).astype(np.int64)
    _, index = np.unique(keys, axis=0, return_inverse=True)
    return np.asarray(index, dtype=np.int64).reshape(-1, 3)
