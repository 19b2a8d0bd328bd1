"""Measures of a sample by the distances between its points."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Literal, Union

import numpy as np

from quasilux.qmc._scale import points_of_unit_cube

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    Metric = Union[str, Callable[[NDArray[np.float64], NDArray[np.float64]], float]]
    """A name, or a function of two points."""

Distances = Callable[["NDArray[np.float64]", int, int], "NDArray[np.float64]"]
"""The distances of one point, by its row, to all points from a row on."""


def geometric_discrepancy(
    sample: ArrayLike,
    method: Literal["mindist", "mst"] = "mindist",
    metric: Metric = "euclidean",
) -> float:
    """How far apart the points of a sample are: higher is more even.

    Parameters
    ----------
    sample : array_like (n, d)
        Points in [0, 1]^d, at least two.
    method : {"mindist", "mst"}, optional
        The least distance between two points that differ, or the mean length of the edges of the
        minimum spanning tree.
    metric : str or callable, optional
        ``"euclidean"``, ``"sqeuclidean"``, ``"cityblock"`` or ``"chebyshev"``, a function of two
        points, or any other name that `scipy.spatial.distance.pdist` knows, for which SciPy must be
        there.

    Returns
    -------
    float
        The measure, in the metric's unit. Only samples of equally many points compare.

    Warns
    -----
    UserWarning
        If two points are the same.

    Raises
    ------
    ValueError
        If the sample is no such array or the method is unknown.

    Notes
    -----
    Edges of length 0 between points that are the same count in the mean of the tree; SciPy leaves
    them out.

    Examples
    --------
    >>> from quasilux import qmc
    >>> qmc.geometric_discrepancy([[0, 0], [0, 1], [0.5, 1]])
    0.5
    >>> qmc.geometric_discrepancy([[0, 0], [0, 1], [0.5, 1]], method="mst")
    0.75
    """
    points = points_of_unit_cube(sample)
    if len(points) < 2:
        raise ValueError("Sample must contain at least two points")
    if method not in ("mindist", "mst"):
        raise ValueError(f"{method!r} is not a valid method. It must be one of 'mindist' and 'mst'")
    distances = distances_from(metric)
    if method == "mst":
        edges = _spanning_tree(points, distances)
        has_duplicates = not np.all(edges)
    else:
        rows = (distances(points, row, row + 1) for row in range(len(points) - 1))
        nearest = [(row.min(), row[row > 0].min(initial=np.inf)) for row in rows]
        edges = np.array([positive for _, positive in nearest if positive < np.inf] or [0.0])
        has_duplicates = any(least == 0 for least, _ in nearest)
    if has_duplicates:
        warnings.warn("Sample contains duplicate points.", stacklevel=2)
    return float(edges.mean() if method == "mst" else edges.min())


def distances_from(metric: Metric) -> Distances:
    """The distances of one point to others in a metric."""
    known = _METRICS.get(metric) if isinstance(metric, str) else None
    if known is not None:
        return lambda points, row, first: known(points[first:] - points[row])
    if callable(metric):
        return lambda points, row, first: np.array(
            [metric(points[row], other) for other in points[first:]], dtype=np.float64
        )
    return _ScipysDistances(metric)


_METRICS: dict[str, Callable[[NDArray[np.float64]], NDArray[np.float64]]] = {
    "euclidean": lambda offsets: np.sqrt(np.einsum("ij,ij->i", offsets, offsets)),
    "sqeuclidean": lambda offsets: np.einsum("ij,ij->i", offsets, offsets),
    "cityblock": lambda offsets: np.abs(offsets).sum(axis=1),
    "chebyshev": lambda offsets: np.abs(offsets).max(axis=1),
}


class _ScipysDistances:
    """All distances at once, for metrics that depend on the whole sample."""

    def __init__(self, metric: str) -> None:
        try:
            from scipy.spatial import distance
        except ImportError as error:
            known = ", ".join(_METRICS)
            raise ImportError(
                f"metric={metric!r} needs SciPy: pip install scipy; without it there are {known}"
            ) from error
        self._scipys: Any = distance
        self._metric = metric
        self._matrix: NDArray[np.float64] | None = None

    def __call__(self, points: NDArray[np.float64], row: int, first: int) -> NDArray[np.float64]:
        matrix = self._matrix
        if matrix is None:
            matrix = self._scipys.squareform(self._scipys.pdist(points, self._metric))
            self._matrix = matrix
        return matrix[row, first:]


def _spanning_tree(points: NDArray[np.float64], distances: Distances) -> NDArray[np.float64]:
    """The lengths of the edges of the minimum spanning tree.

    R. C. Prim, "Shortest connection networks and some generalizations" (Bell Syst. Tech. J. 36,
    1957): the tree grows by the point that is nearest to it.
    """
    n = len(points)
    to_tree = distances(points, 0, 0).astype(np.float64)
    outside = np.ones(n, dtype=bool)
    outside[0] = False
    edges = np.empty(n - 1)
    for place in range(n - 1):
        nearest = int(np.argmin(np.where(outside, to_tree, np.inf)))
        edges[place] = to_tree[nearest]
        outside[nearest] = False
        np.minimum(to_tree, distances(points, nearest, 0), out=to_tree)
    return edges
