"""Latin hypercube designs."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from quasilux.qmc._engine import QMCEngine

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from quasilux.qmc._engine import LegacySeed, RNGLike, SeedLike
    from quasilux.qmc._optimization import OptimizationName


class LatinHypercube(QMCEngine):
    """Latin hypercubes: each of n equal parts of each axis has one of the n points.

    Parameters
    ----------
    d : int
        The number of dimensions.
    scramble : bool, optional
        Points are uniform in their cells; without it they are in the middle.
    strength : {1, 2}, optional
        With 2 the points come of an orthogonal array: each pair of axes, cut into sqrt(n) parts,
        has one point in each of the n squares. n must then be the square of a prime number p, and
        d at most p + 1.
    optimization, rng, seed
        As for `QMCEngine`.

    Raises
    ------
    ValueError
        If `strength` is neither 1 nor 2, or with 2 `n` is no square of a prime or too small.

    Notes
    -----
    No sequence: each sample is another design, and two of them together are none. Samples without
    optimization are those of SciPy from the same `rng`.

    References
    ----------
    M. D. McKay, R. J. Beckman and W. J. Conover, "A comparison of three methods for selecting
    values of input variables in the analysis of output from a computer code" (Technometrics 21,
    1979). A. B. Owen, "Orthogonal arrays for computer experiments, integration and visualization"
    (Statistica Sinica 2, 1992). B. Tang, "Orthogonal array-based Latin hypercubes" (J. Amer.
    Statist. Assoc. 88, 1993).

    Examples
    --------
    >>> import numpy as np
    >>> from quasilux import qmc
    >>> np.sort(qmc.LatinHypercube(d=2, scramble=False, rng=1).random(4), axis=0)
    array([[0.125, 0.125],
           [0.375, 0.375],
           [0.625, 0.625],
           [0.875, 0.875]])
    """

    def __init__(
        self,
        d: int,
        *,
        scramble: bool = True,
        strength: Literal[1, 2] = 1,
        optimization: OptimizationName | None = None,
        rng: RNGLike | SeedLike | None = None,
        seed: LegacySeed | None = None,
    ) -> None:
        super().__init__(d, optimization=optimization, rng=rng, seed=seed)
        if strength not in (1, 2):
            raise ValueError(f"{strength!r} is not a valid strength. It must be 1 or 2")
        self.scramble = scramble
        self._strength = strength
        # What `scipy.integrate.qmc_quad` makes more engines of this kind from.
        self._init_quad: dict[str, Any] = {
            "d": d,
            "scramble": True,
            "strength": strength,
            "optimization": optimization,
        }

    def _random(self, n: int = 1, *, workers: int = 1) -> NDArray[np.float64]:
        return self._latin(n) if self._strength == 1 else self._of_orthogonal_array(n)

    def _latin(self, n: int) -> NDArray[np.float64]:
        """Each axis by itself: a permutation of the cells, and the way back from their ends."""
        within = self.rng.uniform(size=(n, self.d)) if self.scramble else 0.5
        cells = np.empty((n, self.d))
        for axis in range(self.d):
            cells[:, axis] = self.rng.permutation(n)
        return (cells + 1.0 - within) / n

    def _of_orthogonal_array(self, n: int) -> NDArray[np.float64]:
        """Bose's orthogonal array over the integers modulo p, its symbols permuted, and the p
        points with one symbol spread over their part of the axis by a Latin hypercube."""
        p = math.isqrt(n)
        if p * p != n or not _is_prime(p):
            below = next((q for q in range(p, 1, -1) if _is_prime(q)), 2)
            above = next(q for q in range(p + 1, 2 * p + 3) if _is_prime(q))
            raise ValueError(
                f"n is not the square of a prime number: {n}. The closest are {below**2} and"
                f" {above**2}"
            )
        if self.d > p + 1:
            raise ValueError(
                f"n is too small for d: {n} points have at most {p + 1} dimensions, not {self.d}"
            )
        x, y = np.arange(n) % p, np.arange(n) // p
        symbols = np.stack([x, y, *((x + slope * y) % p for slope in range(1, p))], axis=1)
        for column in symbols.T:
            column[:] = self.rng.permutation(p)[column]
        within = LatinHypercube(d=1, scramble=self.scramble, seed=self.rng)
        sample = symbols[:, : self.d].astype(np.float64)
        for axis in range(self.d):
            for symbol in range(p):
                sample[symbols[:, axis] == symbol, axis] += within.random(p)[:, 0]
        return sample / p


def _is_prime(n: int) -> bool:
    """Whether a number is prime, by trial division."""
    return n > 1 and all(n % divisor != 0 for divisor in range(2, math.isqrt(n) + 1))
