"""The rectangle of a grid of sensor points."""

from __future__ import annotations

import dataclasses
from typing import Any


@dataclasses.dataclass(frozen=True)
class Grid:
    """The rectangle of a grid.

    Attributes
    ----------
    origin_m, u_m, v_m : tuple of float
        Its corner and its two edges, in m.
    counts : tuple of int
        Numbers of cells along u and v.
    quantity : {"centre", "mean"}
        Whether a value is that at the centre of its cell, or the mean over it.
    target_lx : float or None
        The illuminance that is wanted everywhere.
    """

    origin_m: tuple[float, float, float]
    u_m: tuple[float, float, float]
    v_m: tuple[float, float, float]
    counts: tuple[int, int]
    quantity: str
    target_lx: float | None

    @classmethod
    def _from_entry(cls, entry: dict[str, Any]) -> Grid:
        return cls(
            origin_m=tuple(entry["origin_m"]),
            u_m=tuple(entry["u_m"]),
            v_m=tuple(entry["v_m"]),
            counts=tuple(entry["counts"]),
            quantity=entry["quantity"],
            target_lx=entry["target_lx"],
        )
