"""Arrays of users as the native half takes them: contiguous, double precision, one axis."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Rows:
    """Rows of a few numbers one after the other, and the shape that they came in."""

    flat: Floats
    shape: tuple[int, ...]
    width: int

    @property
    def count(self) -> int:
        """The number of rows."""
        return self.flat.size // self.width

    @property
    def own_shape(self) -> tuple[int, ...]:
        """The shape of the array that they came in."""
        return self.shape if self.width == 1 else (*self.shape, self.width)

    def broadcast(self, shape: tuple[int, ...]) -> Floats:
        """The rows repeated to a shape; a single one is not, for it goes with all."""
        if self.count == 1 or self.shape == shape:
            return self.flat
        array = self.flat.reshape(*self.shape, self.width)
        return np.broadcast_to(array, (*shape, self.width)).reshape(-1)


def real(values: ArrayLike, name: str) -> Floats:
    """Real numbers of any type and layout as doubles in C order, copied only where they are not.

    Raises
    ------
    TypeError
        For complex numbers, texts and objects.
    """
    array = np.asarray(values)
    if array.dtype.kind not in "buif":
        raise TypeError(f"{name} has the type {array.dtype}; expected real numbers")
    return np.asarray(array, dtype=np.float64, order="C")


def rows(values: ArrayLike, name: str, width: int) -> Rows:
    """Rows of an array of the shape (..., width).

    Raises
    ------
    ValueError
        For other shapes.
    """
    array = real(values, name)
    if array.ndim == 0 or array.shape[-1] != width:
        raise ValueError(f"{name} has the shape {array.shape}; expected (..., {width})")
    return Rows(array.reshape(-1), array.shape[:-1], width)


def scalars(values: ArrayLike, name: str) -> Rows:
    """Real numbers of any shape, as rows of one."""
    array = real(values, name)
    return Rows(array.reshape(-1), array.shape, 1)


def coordinates(u: ArrayLike) -> Rows:
    """Coordinates in the unit square.

    Raises
    ------
    ValueError
        For other shapes, and where one is no number or not in [0, 1].
    """
    found = rows(u, "u", 2)
    if not ((found.flat >= 0.0) & (found.flat <= 1.0)).all():
        raise ValueError("u has values outside [0, 1); expected coordinates of the unit square")
    return found


def common_shape(one: Rows, other: Rows, names: str) -> tuple[int, ...]:
    """The shape that both are broadcast to.

    Raises
    ------
    ValueError
        When there is none.
    """
    try:
        return np.broadcast_shapes(one.shape, other.shape)
    except ValueError:
        shapes = " and ".join(str(found.own_shape) for found in (one, other))
        message = f"{names} have the shapes {shapes}; expected shapes that broadcast together"
        raise ValueError(message) from None


def shaped(flat: Floats, shape: tuple[int, ...]) -> Floats:
    """Numbers in a shape; one alone as a scalar of numpy."""
    return flat.reshape(shape)[()]


def frozen(array: Floats) -> Floats:
    """The same array, not to be written to."""
    array.flags.writeable = False
    return array
