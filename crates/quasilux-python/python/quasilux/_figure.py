"""A value with half the width of its confidence interval."""

from __future__ import annotations

import dataclasses
import math
import numbers
from typing import Any

from quasilux import _native


def _is_number(value: object) -> bool:
    return isinstance(value, numbers.Real)


@dataclasses.dataclass(frozen=True, eq=False)
class Figure:
    """A value and half the width of its confidence interval.

    It can stand where a number is wanted, and prints with the digits that its interval leaves it.
    With exact numbers it is added and multiplied; two of them have errors that nobody knows to be
    apart.
    Figures are equal where all of their numbers are, or are not numbers in both.

    Attributes
    ----------
    value : float
        The estimate; not a number where it is undefined.
    half_width : float
        Half the width of the interval, in the unit of the value; not a number where there is no
        interval.
    unseen_lx : float
        Light in lx at most that no sample met; not a number where nothing bounds it.
    certified_lower_lx, certified_upper_lx : float
        Limits in lx that hold for any number of samples; not numbers where they were not asked
        for, or nothing certain is known.

    Examples
    --------
    >>> figure = Figure(531.4812, 0.36)
    >>> figure
    531.5 ± 0.4
    >>> float(figure)
    531.4812
    >>> 0.8 * figure + 20
    445.18 ± 0.29
    """

    value: float
    half_width: float
    unseen_lx: float = math.nan
    certified_lower_lx: float = math.nan
    certified_upper_lx: float = math.nan

    @classmethod
    def _from_entry(cls, entry: dict[str, Any]) -> Figure:
        certified = entry.get("certified_lx", {})
        limits = (certified.get("lower"), certified.get("upper"))
        known = (entry["value"], entry["half_width"], entry.get("unseen_lx"), *limits)
        return cls(*(math.nan if x is None else x for x in known))

    def _numbers(self) -> tuple[float | None, ...]:
        return tuple(None if math.isnan(x) else x for x in dataclasses.astuple(self))

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Figure):
            return NotImplemented
        return self._numbers() == other._numbers()

    def __hash__(self) -> int:
        return hash(self._numbers())

    def __float__(self) -> float:
        return self.value

    def __add__(self, other: float) -> Figure:
        return self._moved(1.0, other) if _is_number(other) else NotImplemented

    def __sub__(self, other: float) -> Figure:
        return self._moved(1.0, -other) if _is_number(other) else NotImplemented

    def __rsub__(self, other: float) -> Figure:
        return self._moved(-1.0, other) if _is_number(other) else NotImplemented

    def __mul__(self, other: float) -> Figure:
        return self._moved(other, 0.0) if _is_number(other) else NotImplemented

    def __truediv__(self, other: float) -> Figure:
        return self._moved(1.0 / other, 0.0) if _is_number(other) else NotImplemented

    def __neg__(self) -> Figure:
        return self._moved(-1.0, 0.0)

    __radd__ = __add__
    __rmul__ = __mul__

    def _moved(self, factor: float, summand: float) -> Figure:
        """Return a factor times it, and an exact number more."""
        limits = (self.certified_lower_lx, self.certified_upper_lx)
        lower, upper = (factor * x + summand for x in limits)
        if factor < 0.0:
            lower, upper = upper, lower
        half_width, unseen_lx = (abs(factor) * x for x in (self.half_width, self.unseen_lx))
        return Figure(factor * self.value + summand, half_width, unseen_lx, lower, upper)

    def __repr__(self) -> str:
        known = [x if math.isfinite(x) else None for x in (self.value, self.half_width)]
        return _native.figure_text(*known)

    def __format__(self, spec: str) -> str:
        return format(self.value, spec) if spec else repr(self)
