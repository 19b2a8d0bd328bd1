"""Engines whose points are a function of the index, made in compiled code."""

from __future__ import annotations

import os
import warnings
from typing import TYPE_CHECKING, Any, ClassVar, Literal

import numpy as np

from quasilux import _native
from quasilux.qmc._discrepancy import count_of_workers
from quasilux.qmc._engine import QMCEngine, count_of_points

if TYPE_CHECKING:
    from numpy.typing import NDArray
    from typing_extensions import Self

    from quasilux.qmc._engine import LegacySeed, RNGLike, SeedLike
    from quasilux.qmc._optimization import OptimizationName

    Randomization = Literal["none", "owen", "shift", "rotation"]
    SobolRandomization = Literal["none", "owen", "linear", "shift", "rotation"]

MOST_WORKERS = 8
"""More threads than these only wait for memory."""
LEAST_FOR_THREADS = 2**20
"""So many coordinates take a millisecond; for fewer the start of threads is not repaid for sure."""


class _SequenceEngine(QMCEngine):
    """An engine over a native point set; its state is the number of points drawn."""

    def __init__(
        self,
        d: int,
        sequence: str,
        randomization: str,
        *,
        optimization: OptimizationName | None,
        rng: RNGLike | SeedLike | None,
        seed: LegacySeed | None,
    ) -> None:
        super().__init__(d, optimization=optimization, rng=rng, seed=seed)
        self._points = _native.PointSet(sequence, randomization, self._key, self.d)
        # What `scipy.integrate.qmc_quad` makes more engines of this kind from.
        self._init_quad: dict[str, Any] = {"d": d, "optimization": optimization}

    def _remember_rng(self) -> None:
        """Draw the key of the randomization, 64 random bits; then only optimizations are random."""
        integers = (
            self.rng.integers if isinstance(self.rng, np.random.Generator) else self.rng.randint
        )
        self._key = int(integers(0, 2**64, dtype=np.uint64))
        if self._optimization is not None:
            super()._remember_rng()

    def _points_left(self) -> int:
        """How many points are left of the sequence."""
        return 2**64 - self.num_generated

    def _random(self, n: int = 1, *, workers: int | None = None) -> NDArray[np.float64]:
        if n > self._points_left():
            raise ValueError(self._exhausted(n))
        sample = np.empty((n, self.d))
        if sample.size > 0:
            self._points.fill(sample, self.num_generated, _threads(workers, sample.size))
        return sample

    def _exhausted(self, n: int) -> str:
        """What is wrong with drawing so many points more."""
        return f"{n} points are more than the {self._points_left()} that are left"

    def fast_forward(self, n: int) -> Self:
        """Skip the next `n` points, which takes no time.

        Parameters
        ----------
        n : int
            How many.

        Returns
        -------
        QMCEngine
            The engine itself.
        """
        with self._lock:
            self.num_generated += count_of_points(n)
        return self


class Sobol(_SequenceEngine):
    """Sobol's sequence with the direction numbers of Joe and Kuo.

    Parameters
    ----------
    d : int
        The number of dimensions, at most `MAXDIM` (21201).
    scramble : bool, optional
        Random triangular matrices and a digital shift, as in SciPy; without them the points are
        those of SciPy.
    bits : int, optional
        At most ``2**bits`` points can be drawn; 30 by default, 64 at most. Unlike SciPy's,
        scrambled coordinates have 53 bits whatever `bits` is.
    rng, seed, optimization
        As for `QMCEngine`. `rng` picks the scrambling.
    randomization : {"owen", "linear", "shift", "rotation", "none"}, optional
        Overrules `scramble`: random triangular matrices and a digital shift ("linear"); Owen's
        nested uniform scrambling by hashing, with the same variances of means, but more digits that
        are independent, at half the speed ("owen"); a digital shift alone; a random rotation modulo
        1 (Cranley and Patterson); or none.

    Attributes
    ----------
    bits : int
        As given, or 30.
    maxn : int
        ``2**bits``.
    MAXDIM : int
        The largest number of dimensions.

    Raises
    ------
    ValueError
        If `d` or `bits` is too large, or the randomization is unknown.

    Notes
    -----
    Draw 2^m points from the first on: other counts lose the gain over n^-1. Points come in the
    order of Gray's code, as in SciPy; the first is the origin if nothing is randomized.

    References
    ----------
    S. Joe and F. Y. Kuo, "Constructing Sobol sequences with better two-dimensional projections"
    (SIAM J. Sci. Comput. 30, 2008). A. B. Owen, "Randomly permuted (t, m, s)-nets and (t,
    s)-sequences" (1995). J. Matousek, "On the L2-discrepancy for anchored boxes" (J. Complexity 14,
    1998).

    Examples
    --------
    >>> from quasilux import qmc
    >>> points = qmc.Sobol(d=4, scramble=True, rng=1).random_base2(m=10)
    >>> points.shape, bool(abs(points.mean() - 0.5) < 1e-3)
    ((1024, 4), True)
    """

    MAXDIM: ClassVar[int] = _native.SOBOL_DIMENSIONS

    def __init__(
        self,
        d: int,
        *,
        scramble: bool = True,
        bits: int | None = None,
        rng: RNGLike | SeedLike | None = None,
        optimization: OptimizationName | None = None,
        seed: LegacySeed | None = None,
        randomization: SobolRandomization | None = None,
    ) -> None:
        _check_dimensions(d, self.MAXDIM)
        if bits is not None and not 0 < bits <= 64:
            raise ValueError(f"Maximum supported 'bits' is 64 and the least 1, not {bits}")
        self.scramble = scramble
        self.bits = 30 if bits is None else int(bits)
        self.maxn = 2**self.bits
        is_linear = randomization == "linear" or (randomization is None and scramble)
        kind = "linear" if is_linear else _randomization(scramble, randomization)
        super().__init__(d, "sobol", kind, optimization=optimization, rng=rng, seed=seed)
        self._init_quad |= {"scramble": True, "bits": bits, "randomization": _random(randomization)}

    def _points_left(self) -> int:
        return self.maxn - self.num_generated

    def _exhausted(self, n: int) -> str:
        advice = "" if self.bits == 64 else " Consider increasing `bits`."
        return (
            f"At most 2**{self.bits}={self.maxn} distinct points can be generated, of which"
            f" {self.num_generated} have been, and {n} more are too many.{advice}"
        )

    def _random(self, n: int = 1, *, workers: int | None = None) -> NDArray[np.float64]:
        if self.num_generated == 0 and n & (n - 1) != 0:
            warnings.warn(
                "The balance properties of Sobol' points require n to be a power of 2.",
                stacklevel=3,
            )
        return super()._random(n, workers=workers)

    def random_base2(self, m: int, *, workers: int | None = None) -> NDArray[np.float64]:
        """Draw the next 2^m points, with those before them a power of 2.

        Parameters
        ----------
        m : int
            The logarithm to base 2 of the number of points.
        workers : int, optional
            As for `random`.

        Returns
        -------
        ndarray (2^m, d)
            Coordinates in [0, 1).

        Raises
        ------
        ValueError
            If there would not be a power of 2 of points in all; `random` draws any number.
        """
        n = 2 ** count_of_points(m)
        with self._lock:
            total = self.num_generated + n
            if total & (total - 1) != 0:
                raise ValueError(
                    "The balance properties of Sobol' points require n to be a power of 2:"
                    f" {self.num_generated} points have been generated and 2**{m} more make"
                    f" {total}. 'Sobol.random()' draws any number."
                )
            return self.random(n, workers=workers)


class Halton(_SequenceEngine):
    """Halton's sequence: radical inverses in prime bases.

    Parameters
    ----------
    d : int
        The number of dimensions, at most `MAXDIM` (1024, up to base 8161).
    scramble : bool, optional
        Owen's nested uniform scrambling of the digits in each base; without it the points are those
        of SciPy to 1e-15.
    optimization, rng, seed
        As for `QMCEngine`. `rng` picks the scrambling.
    randomization : {"owen", "shift", "rotation", "none"}, optional
        As for `Sobol`, shifts and permutations being of digits in the base of each dimension.

    Attributes
    ----------
    MAXDIM : int
        The largest number of dimensions.

    Raises
    ------
    ValueError
        If `d` is too large or the randomization is unknown.

    References
    ----------
    J. H. Halton, "On the efficiency of certain quasi-random sequences of points in evaluating
    multi-dimensional integrals" (Numer. Math. 2, 1960). A. B. Owen, "A randomized Halton algorithm
    in R" (arXiv:1706.02808, 2017).

    Examples
    --------
    >>> from quasilux import qmc
    >>> qmc.Halton(d=2, scramble=False).random(3)
    array([[0.        , 0.        ],
           [0.5       , 0.33333333],
           [0.25      , 0.66666667]])
    """

    MAXDIM: ClassVar[int] = 1024

    def __init__(
        self,
        d: int,
        *,
        scramble: bool = True,
        optimization: OptimizationName | None = None,
        rng: RNGLike | SeedLike | None = None,
        seed: LegacySeed | None = None,
        randomization: Randomization | None = None,
    ) -> None:
        _check_dimensions(d, self.MAXDIM)
        self.scramble = scramble
        kind = _randomization(scramble, randomization)
        super().__init__(d, "halton", kind, optimization=optimization, rng=rng, seed=seed)
        self._init_quad |= {"scramble": True, "randomization": _random(randomization)}


class Faure4(_SequenceEngine):
    """The (0, 4)-sequence of Faure and Niederreiter in base 4.

    Each aligned block of 4^m points has one point in each of the 4^m boxes of any shape whose sides
    are powers of 1/4, in four dimensions at once; Sobol's points have not. More dimensions are
    independently shuffled and scrambled copies of the four, also without randomization.

    Parameters
    ----------
    d : int
        The number of dimensions, best at most 4.
    randomization : {"owen", "shift", "rotation", "none"}, optional
        As for `Sobol`; nested scrambling by default.
    optimization, rng, seed
        As for `QMCEngine`. `rng` picks the randomization.

    Raises
    ------
    ValueError
        If `d` or the randomization is no valid one.

    Notes
    -----
    Not in SciPy. Draw 4^m points from the first on.

    References
    ----------
    H. Faure, "Discrepance de suites associees a un systeme de numeration (en dimension s)" (Acta
    Arith. 41, 1982). H. Niederreiter, "Point sets and sequences with small discrepancy" (Monatsh.
    Math. 104, 1987).

    Examples
    --------
    >>> from quasilux import qmc
    >>> qmc.Faure4(d=4, randomization="none").random(4)
    array([[0.  , 0.  , 0.  , 0.  ],
           [0.5 , 0.5 , 0.5 , 0.5 ],
           [0.25, 0.25, 0.25, 0.25],
           [0.75, 0.75, 0.75, 0.75]])
    """

    def __init__(
        self,
        d: int,
        *,
        randomization: Randomization = "owen",
        optimization: OptimizationName | None = None,
        rng: RNGLike | SeedLike | None = None,
        seed: LegacySeed | None = None,
    ) -> None:
        kind = _randomization(True, randomization)
        super().__init__(d, "faure4", kind, optimization=optimization, rng=rng, seed=seed)
        self._init_quad |= {"randomization": randomization}


class Hammersley(_SequenceEngine):
    """Hammersley's points: Halton's sequence behind an axis of equal steps.

    Parameters
    ----------
    d : int
        The number of dimensions, at most 1025.
    points : int
        How many points there are; draw all of them, for any part leaves part of the first
        dimension out.
    randomization : {"owen", "shift", "rotation", "none"}, optional
        As for `Sobol`; nested scrambling by default, which rotates the first dimension by whole
        steps and makes each point uniform within its step.
    optimization, rng, seed
        As for `QMCEngine`. `rng` picks the randomization.

    Raises
    ------
    ValueError
        If `d`, `points` or the randomization is no valid one, or more than `points` are drawn.

    Notes
    -----
    Not in SciPy.

    References
    ----------
    J. M. Hammersley, "Monte Carlo methods for solving multivariable problems" (Ann. New York Acad.
    Sci. 86, 1960).

    Examples
    --------
    >>> from quasilux import qmc
    >>> qmc.Hammersley(d=2, points=4, randomization="none").random(4)
    array([[0.  , 0.  ],
           [0.25, 0.5 ],
           [0.5 , 0.25],
           [0.75, 0.75]])
    """

    def __init__(
        self,
        d: int,
        points: int,
        *,
        randomization: Randomization = "owen",
        optimization: OptimizationName | None = None,
        rng: RNGLike | SeedLike | None = None,
        seed: LegacySeed | None = None,
    ) -> None:
        _check_dimensions(d, Halton.MAXDIM + 1)
        self.points = count_of_points(points)
        if not 0 < self.points < 2**64:
            raise ValueError(f"there must be at least one point and fewer than 2**64, not {points}")
        kind = _randomization(True, randomization)
        sequence = f"hammersley:{self.points}"
        super().__init__(d, sequence, kind, optimization=optimization, rng=rng, seed=seed)
        self._init_quad |= {"points": points, "randomization": randomization}

    def _points_left(self) -> int:
        return self.points - self.num_generated


class Independent(_SequenceEngine):
    """Independent pseudo-random points, to compare with.

    Unlike numpy's they are a function of the index, so `fast_forward` takes no time.

    Parameters
    ----------
    d : int
        The number of dimensions.
    optimization, rng, seed
        As for `QMCEngine`.

    Raises
    ------
    ValueError
        If `d` is no valid number.

    Notes
    -----
    Not in SciPy.

    Examples
    --------
    >>> from quasilux import qmc
    >>> engine = qmc.Independent(d=3, rng=1)
    >>> first = engine.random(100)
    >>> bool((engine.reset().fast_forward(99).random() == first[99:]).all())
    True
    """

    def __init__(
        self,
        d: int,
        *,
        optimization: OptimizationName | None = None,
        rng: RNGLike | SeedLike | None = None,
        seed: LegacySeed | None = None,
    ) -> None:
        super().__init__(d, "random", "none", optimization=optimization, rng=rng, seed=seed)


def _randomization(scramble: bool, name: str | None) -> str:
    """The name of a randomization; ValueError for one that is none."""
    if name is None:
        return "owen" if scramble else "none"
    if name not in ("none", "owen", "shift", "rotation"):
        raise ValueError(
            f"{name!r} is not a valid randomization."
            " It must be one of 'owen', 'shift', 'rotation' and 'none'"
        )
    return name


def _random(name: str | None) -> str | None:
    """The randomization of more engines of a kind, which must differ."""
    return None if name == "none" else name


def _check_dimensions(d: object, most: int) -> None:
    """ValueError where there are not enough dimensions."""
    if isinstance(d, (int, np.integer)) and d > most:
        raise ValueError(f"Maximum supported dimensionality is {most}, not {d}")


def _threads(workers: int | None, coordinates: int) -> int:
    """How many threads may make so many coordinates."""
    if workers is not None:
        return count_of_workers(workers)
    if coordinates < LEAST_FOR_THREADS:
        return 1
    # Where the platform says so, only the processors that this process may use.
    usable = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
    return min(usable or 1, MOST_WORKERS)
