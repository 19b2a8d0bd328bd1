"""Values of many points, each with half the width of its interval."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray


@dataclasses.dataclass(frozen=True, eq=False)
class Figures:
    """Values, and half the width of the confidence interval of each.

    Attributes
    ----------
    value : ndarray of float64
        The estimates; not a number where one is undefined. Read-only.
    half_width : ndarray of float64
        Half the width of each interval, in the unit of the values; not a number where there is no
        interval. Read-only, of the same shape.
    """

    value: NDArray[np.float64]
    half_width: NDArray[np.float64]

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape of both arrays."""
        return self.value.shape

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> NDArray[Any]:
        """Return the values, so that numpy takes figures for them."""
        if copy is False and dtype is not None and np.dtype(dtype) != self.value.dtype:
            raise ValueError(f"a copy is needed for {np.dtype(dtype)}")
        return self.value.astype(dtype or self.value.dtype, copy=bool(copy))

    @classmethod
    def _of_points(
        cls, points: Iterable[Mapping[str, Any]], name: str, shape: tuple[int, ...]
    ) -> Figures:
        """Of the entries of a document, which have a value and, beside it, its half-width."""
        points = list(points)
        return cls(of_points(points, name, shape), of_points(points, f"{name}_half_width", shape))


def of_points(
    points: Iterable[Mapping[str, Any]], name: str, shape: tuple[int, ...]
) -> NDArray[np.float64]:
    """Return the numbers that entries of a document have under a name, as a read-only array."""
    array = np.array([point.get(name) for point in points], np.float64).reshape(shape)
    array.flags.writeable = False
    return array
