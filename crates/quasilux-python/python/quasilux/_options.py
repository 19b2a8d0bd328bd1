"""Parameters of runs as options of the command line, which knows their ranges."""

from __future__ import annotations

import numbers
import operator
import os
from collections.abc import Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable


class Options:
    """Options of a run, in the words of the command line."""

    def __init__(self) -> None:
        self._words: list[str] = []

    @property
    def words(self) -> list[str]:
        """Options, as in ``--rel-tol=0.01``."""
        return self._words

    def _put(self, option: str, value: str) -> None:
        self._words.append(f"--{option}={value}")

    def run(
        self,
        *,
        rel_tol: float | str | None,
        abs_tol_lx: float | None,
        unseen_tol: float | str | None,
        tolerance_on: str | None,
        interval: str | None,
        confidence: float | str | None,
        samples: int | None,
        rays: int | None,
        time_s: float | None,
        estimator: str | None,
        sequence: str | None,
        seed: int | None,
    ) -> None:
        """Add what every run may be asked for, whoever traces it."""
        self.share("rel-tol", "rel_tol", rel_tol)
        self.number("abs-tol", "abs_tol_lx", abs_tol_lx)
        self.share("unseen-tol", "unseen_tol", unseen_tol)
        self.name("tolerance-on", "tolerance_on", tolerance_on)
        self.name("interval", "interval", interval)
        self.share("confidence", "confidence", confidence)
        self.whole("samples", "samples", samples)
        self.whole("rays", "rays", rays)
        self.number("time", "time_s", time_s)
        self.name("estimator", "estimator", estimator)
        self.name("sequence", "sequence", sequence)
        self.whole("seed", "seed", seed)

    def whole(self, option: str, name: str, value: int | None) -> None:
        """Add a whole number."""
        if value is None:
            return
        if isinstance(value, bool) or not hasattr(value, "__index__"):
            raise TypeError(f"{name} is {value!r}; expected a whole number")
        self._put(option, str(operator.index(value)))

    def number(self, option: str, name: str, value: float | None) -> None:
        """Add a number."""
        if value is not None:
            self._put(option, _number(name, value, "a number"))

    def share(self, option: str, name: str, value: float | str | None) -> None:
        """Add a share, as a number or in percent."""
        if isinstance(value, str):
            self._put(option, value)
        elif value is not None:
            self._put(option, _number(name, value, 'a number, or percent as in "1%"'))

    def span(self, option: str, name: str, value: tuple[float, float] | None) -> None:
        """Add a pair of numbers, from one to the other."""
        if value is None:
            return
        if isinstance(value, str) or not isinstance(value, Sequence) or len(value) != 2:
            raise TypeError(f"{name} is {value!r}; expected two numbers")
        start, end = (_number(name, x, "two numbers") for x in value)
        self._put(option, f"{start}-{end}")

    def name(self, option: str, name: str, value: str | None) -> None:
        """Add a name out of a few."""
        if value is None:
            return
        if not isinstance(value, str):
            raise TypeError(f"{name} is {value!r}; expected a name")
        self._put(option, value)

    def path(self, option: str, name: str, value: str | os.PathLike[str] | None) -> None:
        """Add a path."""
        if value is None:
            return
        if not isinstance(value, (str, os.PathLike)):
            raise TypeError(f"{name} is {value!r}; expected a path")
        self._put(option, os.fspath(value))

    def flag(self, option: str, is_set: bool) -> None:
        """Add an option without a value."""
        self._words.extend([f"--{option}"] if is_set else [])

    def extend(self, words: Iterable[str]) -> None:
        """Add options in words of the command line."""
        self._words.extend(words)


def _number(name: str, value: object, expected: str) -> str:
    if isinstance(value, bool) or not isinstance(value, numbers.Real):
        raise TypeError(f"{name} is {value!r}; expected {expected}")
    return repr(float(value)) if not isinstance(value, numbers.Integral) else str(int(value))
