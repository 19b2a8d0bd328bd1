"""From the unit cube to a box and back."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from typing import Any

    from numpy.typing import ArrayLike, NDArray


class Bounds(NamedTuple):
    """A box: one lower and one upper bound for each dimension."""

    lower: NDArray[Any]
    upper: NDArray[Any]

    @classmethod
    def of(cls, l_bounds: ArrayLike, u_bounds: ArrayLike, d: int) -> Bounds:
        """Bounds of ``d`` dimensions from numbers or one number for all; ValueError otherwise."""
        try:
            bounds = cls(np.broadcast_to(l_bounds, d), np.broadcast_to(u_bounds, d))
        except ValueError as error:
            raise ValueError(
                f"'l_bounds' and 'u_bounds' must be broadcastable and respect the sample dimension,"
                f" which is {d}"
            ) from error
        if not np.all(bounds.lower < bounds.upper):
            raise ValueError("Bounds are not consistent 'l_bounds' < 'u_bounds'")
        return bounds


def scale(
    sample: ArrayLike,
    l_bounds: ArrayLike,
    u_bounds: ArrayLike,
    *,
    reverse: bool = False,
) -> NDArray[np.float64]:
    """Move points of the unit cube into a box, or back.

    Parameters
    ----------
    sample : array_like (n, d)
        Points in [0, 1]^d; with `reverse` points of the box.
    l_bounds, u_bounds : array_like (d,)
        The lower and the upper bound of each dimension, or one for all.
    reverse : bool, optional
        From the box to the unit cube.

    Returns
    -------
    ndarray (n, d)
        ``l + (u - l) * sample``, or the inverse of it.

    Raises
    ------
    ValueError
        If the sample is not two-dimensional or leaves its box, or if a lower bound is not below its
        upper bound.

    Examples
    --------
    >>> from quasilux import qmc
    >>> qmc.scale([[0.5, 0.75]], l_bounds=[-2, 0], u_bounds=[6, 4])
    array([[2., 3.]])
    """
    points: NDArray[Any] = np.asarray(sample)
    if points.ndim != 2:
        raise ValueError("Sample is not a 2D array")
    lower, upper = Bounds.of(l_bounds, u_bounds, points.shape[1])
    if reverse:
        if not (np.all(points >= lower) and np.all(points <= upper)):
            raise ValueError("Sample is out of bounds")
        return (points - lower) / (upper - lower)
    if not is_in_unit_cube(points):
        raise ValueError("Sample is not in unit hypercube")
    return points * (upper - lower) + lower


def is_in_unit_cube(points: NDArray[Any]) -> bool:
    """Whether all coordinates are in [0, 1]; those that are no numbers are not."""
    return bool(np.all((points >= 0) & (points <= 1)))


def points_of_unit_cube(sample: ArrayLike) -> NDArray[np.float64]:
    """An array (n, d) of coordinates in [0, 1], row after row; ValueError for anything else."""
    points = np.ascontiguousarray(sample, dtype=np.float64)
    if points.ndim != 2:
        raise ValueError("Sample is not a 2D array")
    if not is_in_unit_cube(points):
        raise ValueError("Sample is not in unit hypercube")
    return points
