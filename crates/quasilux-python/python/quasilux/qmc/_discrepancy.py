"""Discrepancies in the mean square."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Literal

import numpy as np

from quasilux import _native
from quasilux.qmc._scale import is_in_unit_cube, points_of_unit_cube

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

METHODS = ("CD", "WD", "MD", "L2-star")


def discrepancy(
    sample: ArrayLike,
    *,
    iterative: bool = False,
    method: Literal["CD", "WD", "MD", "L2-star"] = "CD",
    workers: int = 1,
) -> float:
    """How far the share of points in a box is from its volume, in the mean square over boxes.

    Parameters
    ----------
    sample : array_like (n, d)
        Points in [0, 1]^d.
    iterative : bool, optional
        As if there were one point more, which `update_discrepancy` then adds.
    method : {"CD", "WD", "MD", "L2-star"}, optional
        Which boxes: from the nearest corner (centred), wrapped around, a mixture of both, or from
        the origin.
    workers : int, optional
        How many threads work, -1 for all processors. The result does not depend on it.

    Returns
    -------
    float
        The *square* of the discrepancy for ``"CD"``, ``"WD"`` and ``"MD"``, and the discrepancy
        itself for ``"L2-star"``; lower is more even. Takes time in proportion to n^2 d.

    Raises
    ------
    ValueError
        If the sample is not an array (n, d) of points of the unit cube, n and d at least 1, or the
        method or the number of workers is no valid one.

    Examples
    --------
    >>> from quasilux import qmc
    >>> points = [[1 / 4, 1 / 4], [3 / 4, 3 / 4]]
    >>> round(qmc.discrepancy(points), 6)
    0.062283
    """
    points = points_of_unit_cube(sample)
    if method not in METHODS:
        raise ValueError(f"{method!r} is not a valid method. It must be one of {METHODS}")
    return _native.discrepancy(points, method, iterative, count_of_workers(workers))


def update_discrepancy(x_new: ArrayLike, sample: ArrayLike, initial_disc: float) -> float:
    """Add one point to a centred discrepancy.

    Parameters
    ----------
    x_new : array_like (d,)
        The point that is added.
    sample : array_like (n, d)
        The points that are there already.
    initial_disc : float
        Their ``discrepancy(sample, iterative=True)``.

    Returns
    -------
    float
        The centred discrepancy of all n + 1 points, in time proportional to n d.

    Raises
    ------
    ValueError
        If points are not of the unit cube or their dimensions differ.

    Examples
    --------
    >>> from quasilux import qmc
    >>> start = qmc.discrepancy([[1 / 4, 1 / 4]], iterative=True)
    >>> round(qmc.update_discrepancy([3 / 4, 3 / 4], [[1 / 4, 1 / 4]], start), 6)
    0.062283
    """
    points = points_of_unit_cube(sample)
    new = np.asarray(x_new, dtype=np.float64)
    if new.ndim != 1:
        raise ValueError("x_new is not a 1D array")
    if not is_in_unit_cube(new):
        raise ValueError("x_new is not in unit hypercube")
    if new.shape[0] != points.shape[1]:
        raise ValueError("x_new and sample must be broadcastable: their dimensions differ")
    n = len(points) + 1
    # Distances from the centre of the cube; the new point is in n - 1 pairs, each counted twice,
    # and in one with itself.
    new_off, off = np.abs(new - 0.5), np.abs(points - 0.5)
    single = np.prod(1.0 + 0.5 * (new_off - new_off**2))
    pairs = np.prod(1.0 + 0.5 * (new_off + off - np.abs(new - points)), axis=1).sum()
    itself = np.prod(1.0 + new_off)
    return float(initial_disc + (2.0 * pairs + itself) / n**2 - 2.0 * single / n)


def count_of_workers(workers: int) -> int:
    """How many threads are meant, -1 being one for each processor; ValueError for other numbers."""
    count = int(workers)
    if count == -1:
        processors = os.cpu_count()
        if processors is None:
            raise NotImplementedError(
                "Cannot determine the number of processors: give a number of workers instead of -1"
            )
        return processors
    if count <= 0:
        raise ValueError(f"Invalid number of workers: {count}, must be -1 or > 0")
    return count
