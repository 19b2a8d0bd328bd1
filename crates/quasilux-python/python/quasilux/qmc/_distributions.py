"""Samples of distributions, made from the points of an engine."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from quasilux import _native
from quasilux.qmc._engine import QMCEngine, count_of_points
from quasilux.qmc._sequences import Sobol

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from quasilux.qmc._engine import LegacySeed, RNGLike, SeedLike


class MultivariateNormalQMC:
    """Normal random vectors from quasi-Monte Carlo points.

    Parameters
    ----------
    mean : array_like (d,)
        The mean.
    cov : array_like (d, d), optional
        The covariance; the identity if neither it nor its root is given.
    cov_root : array_like (d, d), optional
        A root of the covariance R, ``cov = R.T @ R``.
    inv_transform : bool, optional
        Numbers by inversion of the distribution function, which keeps the evenness of the points;
        otherwise pairs by Box and Muller's transformation.
    engine : QMCEngine, optional
        Where points come from, of as many dimensions as `mean`, for pairs rounded up to an even
        number. `Sobol` by default.
    rng, seed
        For the default engine, as for `QMCEngine`.

    Raises
    ------
    ValueError
        If dimensions do not fit, the covariance is not symmetric or has negative eigenvalues, or
        `engine` is none.

    Examples
    --------
    >>> import numpy as np
    >>> from quasilux import qmc
    >>> dist = qmc.MultivariateNormalQMC(mean=[0, 5], cov=[[2, 1], [1, 1]], rng=1)
    >>> np.round(dist.random(4096).mean(axis=0), 2)
    array([0., 5.])
    """

    def __init__(
        self,
        mean: ArrayLike,
        cov: ArrayLike | None = None,
        *,
        cov_root: ArrayLike | None = None,
        inv_transform: bool = True,
        engine: QMCEngine | None = None,
        rng: RNGLike | SeedLike | None = None,
        seed: LegacySeed | None = None,
    ) -> None:
        self._mean = np.atleast_1d(np.asarray(mean))
        self._d = self._mean.shape[0]
        self._inv_transform = inv_transform
        self._corr_matrix = None
        if cov is not None:
            self._corr_matrix = _root(np.atleast_2d(np.asarray(cov)), self._d)
        elif cov_root is not None:
            self._corr_matrix = np.atleast_2d(np.asarray(cov_root))
            _check_dimensions(self._corr_matrix.shape[0], self._d)
        d = self._d if inv_transform else 2 * math.ceil(self._d / 2)
        self.engine = _engine(engine, d, rng, seed)
        if self.engine.d != d:
            raise ValueError(
                "Dimension of `engine` must be consistent with dimensions of mean and covariance:"
                f" {d}, not {self.engine.d}. If `inv_transform` is False, it must be even."
            )

    def random(self, n: int = 1) -> NDArray[np.float64]:
        """Draw vectors.

        Parameters
        ----------
        n : int, optional
            How many.

        Returns
        -------
        ndarray (n, d)
            The vectors.
        """
        numbers = self._standard_normal_samples(n)
        if self._corr_matrix is not None:
            numbers = numbers @ self._corr_matrix
        return numbers + self._mean

    def _standard_normal_samples(self, n: int) -> NDArray[np.float64]:
        """Independent standard normal numbers, (n, d)."""
        uniform = np.ascontiguousarray(self.engine.random(n), dtype=np.float64)
        if self._inv_transform:
            # SciPy's shrinkage, for equal numbers from equal points: all are within 6.5.
            numbers = 0.5 + (1.0 - 1e-10) * (uniform - 0.5)
            _native.to_normal(numbers)
            return numbers
        # The least coordinate but 0 is 2^-53: half of it stands for 0, which has no logarithm.
        radii = np.sqrt(-2.0 * np.log(np.maximum(uniform[:, 0::2], 2.0**-54)))
        angles = 2.0 * math.pi * uniform[:, 1::2]
        pairs = np.stack([radii * np.cos(angles), radii * np.sin(angles)], axis=-1)
        return pairs.reshape(len(uniform), -1)[:, : self._d]


class MultinomialQMC:
    """Multinomial counts from quasi-Monte Carlo points.

    Parameters
    ----------
    pvals : array_like (k,)
        The probabilities of the k outcomes.
    n_trials : int
        The number of trials of each vector of counts.
    engine : QMCEngine, optional
        Where points come from, of one dimension. `Sobol` by default.
    rng, seed
        For the default engine, as for `QMCEngine`.

    Raises
    ------
    ValueError
        If probabilities are negative or do not sum to 1, or `engine` is none of one dimension.

    Examples
    --------
    >>> from quasilux import qmc
    >>> qmc.MultinomialQMC([0.25, 0.75], n_trials=8, rng=1).random(1)
    array([[2., 6.]])
    """

    def __init__(
        self,
        pvals: ArrayLike,
        n_trials: int,
        *,
        engine: QMCEngine | None = None,
        rng: RNGLike | SeedLike | None = None,
        seed: LegacySeed | None = None,
    ) -> None:
        self.pvals = np.atleast_1d(np.asarray(pvals))
        if np.min(self.pvals) < 0:
            raise ValueError("Elements of pvals must be non-negative.")
        if not np.isclose(np.sum(self.pvals), 1):
            raise ValueError(f"Elements of pvals must sum to 1. They sum to {np.sum(self.pvals)}.")
        self.n_trials = count_of_points(n_trials)
        self.engine = _engine(engine, 1, rng, seed)
        if self.engine.d != 1:
            raise ValueError(f"Dimension of `engine` must be 1. It is {self.engine.d}.")

    def random(self, n: int = 1) -> NDArray[np.float64]:
        """Draw vectors of counts.

        Parameters
        ----------
        n : int, optional
            How many.

        Returns
        -------
        ndarray (n, k)
            How often each outcome came; rows sum to the number of trials.
        """
        inner_borders = np.cumsum(self.pvals)[:-1]
        counts = np.empty((count_of_points(n), len(self.pvals)))
        for row in counts:
            draws = self.engine.random(self.n_trials).ravel()
            outcomes = np.searchsorted(inner_borders, draws, side="right")
            row[:] = np.bincount(outcomes, minlength=len(self.pvals))
        return counts


def _root(cov: NDArray[Any], d: int) -> NDArray[np.float64]:
    """A root R of a covariance, cov = R^T R: Cholesky's, or the spectral one if there is none."""
    _check_dimensions(cov.shape[0], d)
    if cov.shape != (d, d) or not np.allclose(cov, cov.T):
        raise ValueError("Covariance matrix is not symmetric.")
    try:
        return np.linalg.cholesky(cov).T
    except np.linalg.LinAlgError:
        values, vectors = np.linalg.eigh(cov)
    if np.any(values < -1e-8):
        raise ValueError("Covariance matrix not PSD. It has a negative eigenvalue.")
    return (vectors * np.sqrt(np.maximum(values, 0.0))).T


def _check_dimensions(of_covariance: int, of_mean: int) -> None:
    if of_covariance != of_mean:
        raise ValueError(
            f"Dimension mismatch between mean and covariance. They have {of_mean} and"
            f" {of_covariance}."
        )


def _engine(engine: object, d: int, rng: RNGLike | SeedLike | None, seed: LegacySeed | None) -> Any:
    """The engine given, also one of SciPy's, or a scrambled Sobol' sequence."""
    if engine is None:
        return Sobol(d, scramble=True, rng=rng, seed=seed)
    if isinstance(engine, QMCEngine) or _looks_like_engine(engine):
        return engine
    raise ValueError(
        f"`engine` must be an instance of `quasilux.qmc.QMCEngine` or `None`, not {engine!r}"
    )


def _looks_like_engine(engine: object) -> bool:
    """Whether it has points of a known number of dimensions, as SciPy's engines have."""
    return hasattr(engine, "d") and callable(getattr(engine, "random", None))
