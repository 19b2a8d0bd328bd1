"""What can be done to a sample after it is drawn."""

from __future__ import annotations

from enum import Enum
from typing import TYPE_CHECKING, Literal, Union

import numpy as np

from quasilux import _native
from quasilux.qmc._distances import distances_from

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    OptimizationName = Literal["random-cd", "lloyd"]
    Randomness = Union[np.random.Generator, np.random.RandomState]

EXCHANGES = 10_000
"""So many exchanges are tried."""
EXCHANGES_IN_VAIN = 100
"""So many that follow each other in vain are the last."""


class Optimization(Enum):
    """The ways to even out one sample, by their names."""

    RANDOM_CD = "random-cd"
    LLOYD = "lloyd"

    @classmethod
    def of(cls, name: object) -> Optimization:
        """The optimization of a name, upper or lower case; ValueError for any other name."""
        try:
            return cls(name.lower() if isinstance(name, str) else name)
        except ValueError:
            known = ", ".join(repr(one.value) for one in cls)
            raise ValueError(
                f"{name!r} is not a valid optimization method. It must be one of {known}"
            ) from None


def optimize(
    optimization: Optimization, sample: NDArray[np.float64], rng: Randomness
) -> NDArray[np.float64]:
    """The sample (n, d) evened out."""
    if optimization is Optimization.LLOYD:
        return move_to_centroids(sample)
    return exchange_coordinates(sample, rng)


def exchange_coordinates(sample: NDArray[np.float64], rng: Randomness) -> NDArray[np.float64]:
    """Exchange coordinates of pairs of points, at random, where the centred discrepancy falls."""
    n, d = sample.shape
    # One point or one dimension: all exchanges leave the set as it is.
    if n < 2 or d < 2:
        return sample
    integers = rng.integers if isinstance(rng, np.random.Generator) else rng.randint
    exchanges = integers(0, (d, n, n), size=(EXCHANGES, 3), dtype=np.uint64)
    sample = np.array(sample, dtype=np.float64, order="C")
    _native.exchange_coordinates(sample, exchanges, EXCHANGES_IN_VAIN)
    return sample


def move_to_centroids(
    sample: ArrayLike, *, tol: float = 1e-5, maxiter: int = 10
) -> NDArray[np.float64]:
    """Move points towards the centroids of their Voronoi cells (Lloyd's algorithm).

    The centroid is the mean of the cell's finite vertices. Steps are first nearly twice as long as
    the way to it and at last as long; points that would leave the unit cube stay. S. P. Lloyd,
    "Least squares quantization in PCM" (IEEE Trans. Inf. Theory 28, 1982).

    Parameters
    ----------
    sample : array_like (n, d)
        Points in [0, 1]^d, d at least 2.
    tol : float, optional
        Ends when the least distance between points, sums of differences of coordinates, changes by
        less.
    maxiter : int, optional
        How many rounds at most.

    Returns
    -------
    ndarray (n, d)
        The points moved; the sample stays as it is.

    Raises
    ------
    ValueError
        If the sample is no such array.
    ImportError
        If SciPy is not there, which finds the cells.
    """
    points: NDArray[np.float64] = np.array(sample, dtype=np.float64)
    if points.ndim != 2:
        raise ValueError("`sample` is not a 2D array")
    if points.shape[1] < 2:
        raise ValueError("`sample` dimension is not >= 2")
    if not np.all((points >= 0) & (points <= 1)):
        raise ValueError("`sample` is not in unit hypercube")
    try:
        from scipy.spatial import Voronoi
    except ImportError as error:
        raise ImportError('optimization="lloyd" needs SciPy: pip install scipy') from error

    options = "Qbb Qc Qz QJ Qx" if points.shape[1] > 4 else "Qbb Qc Qz QJ"
    least = _least_distance(points)
    for turn in range(maxiter):
        cells = Voronoi(points, qhull_options=options)
        step = 0.9 + 0.1 ** (turn / maxiter)
        moved = points.copy()
        for place, region in enumerate(cells.point_region):
            vertices = cells.vertices[[vertex for vertex in cells.regions[region] if vertex >= 0]]
            if len(vertices) > 0:
                moved[place] += step * (vertices.mean(axis=0) - points[place])
        stays = ~np.all((moved >= 0) & (moved <= 1), axis=1)
        moved[stays] = points[stays]
        points, before = moved, least
        least = _least_distance(points)
        if abs(least - before) < tol:
            break
    return points


def _least_distance(points: NDArray[np.float64]) -> float:
    """The least sum of differences of coordinates between two points."""
    distance = distances_from("cityblock")
    rows = range(len(points) - 1)
    return min((float(distance(points, row, row + 1).min()) for row in rows), default=0.0)
