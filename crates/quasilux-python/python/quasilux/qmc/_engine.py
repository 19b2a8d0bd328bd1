"""The base class of all engines, and where their random numbers come from."""

from __future__ import annotations

import copy
import numbers
import operator
import sys
import threading
from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, Any, SupportsIndex, Union

import numpy as np

from quasilux.qmc._optimization import Optimization, optimize
from quasilux.qmc._scale import scale

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import ArrayLike, NDArray
    from typing_extensions import Self

    from quasilux.qmc._optimization import OptimizationName

    RNGLike = Union[np.random.Generator, np.random.BitGenerator]
    """What numpy's `default_rng` takes for a generator."""
    SeedLike = Union[int, np.integer[Any], Sequence[int], np.random.SeedSequence]
    """What numpy's `default_rng` takes for a seed."""
    LegacySeed = Union[int, np.integer[Any], np.random.Generator, np.random.RandomState]
    """What the keyword `seed` took before `rng` came."""
    OwnedGenerator = Union[np.random.Generator, np.random.RandomState]


class QMCEngine(ABC):
    """Base class of quasi-Monte Carlo engines: override `_random` to make your own.

    Parameters
    ----------
    d : int
        The number of dimensions.
    optimization : {None, "random-cd", "lloyd"}, optional
        What is done to each sample after it is drawn. ``"random-cd"`` exchanges coordinates of
        random pairs of points where that lowers the centred discrepancy; ``"lloyd"`` moves points
        towards the centroids of their Voronoi cells and needs SciPy. Both give up the properties of
        a sequence for even single samples.
    rng : int, SeedSequence, Generator, .. , optional
        Anything that `numpy.random.default_rng` takes; a child of it is used, so that engines made
        from one generator differ. Entropy of the operating system by default.
    seed : int, Generator or RandomState, optional
        The older spelling of `rng`: an integer seeds the generator itself and not a child of it.

    Attributes
    ----------
    d : int
        The number of dimensions.
    rng : numpy.random.Generator
        The random numbers of this engine, for subclasses.
    rng_seed : numpy.random.Generator or None
        A copy of `rng` as it was in the beginning; None where `reset` does not need it.
    num_generated : int
        How many points have been drawn or skipped since the beginning or the last `reset`.

    Raises
    ------
    ValueError
        If `d` is not an integer of at least 0, or `optimization` is no known one.
    TypeError
        If both `rng` and `seed` are given.

    Notes
    -----
    One engine may be used by several threads: they take turns, and no two get the same points.
    Engines can be copied and pickled at any point of their sequence.

    Examples
    --------
    >>> from quasilux import qmc
    >>> class Random(qmc.QMCEngine):
    ...     def __init__(self, d, *, rng=None):
    ...         super().__init__(d, rng=rng)
    ...
    ...     def _random(self, n=1, *, workers=1):
    ...         return self.rng.random((n, self.d))
    >>> Random(3, rng=1).random(2).shape
    (2, 3)
    """

    @abstractmethod
    def __init__(
        self,
        d: int,
        *,
        optimization: OptimizationName | None = None,
        rng: RNGLike | SeedLike | None = None,
        seed: LegacySeed | None = None,
    ) -> None:
        self.d = _dimensions(d)
        self._optimization = None if optimization is None else Optimization.of(optimization)
        self.rng = _own_generator(rng, seed)
        self.rng_seed: OwnedGenerator | None = None
        self._remember_rng()
        self.num_generated: int = 0
        self._lock = threading.RLock()
        _join_scipys_engines()

    def _remember_rng(self) -> None:
        """Keep the generator for `reset`."""
        self.rng_seed = copy.deepcopy(self.rng)

    @abstractmethod
    def _random(self, n: int = 1, *, workers: int = 1) -> NDArray[np.float64]:
        """Make the next `n` points as an array (n, d); `num_generated` is counted by `random`."""

    def random(self, n: int = 1, *, workers: int | None = None) -> NDArray[np.float64]:
        """Draw the next points.

        Parameters
        ----------
        n : int, optional
            How many.
        workers : int, optional
            How many threads work, -1 for all processors. By default sequences take as many as pay
            and other engines one. The points do not depend on it.

        Returns
        -------
        ndarray (n, d)
            Coordinates in [0, 1).

        Raises
        ------
        ValueError
            If `n` is negative, or more than the engine has points left.
        """
        count = count_of_points(n)
        with self._lock:
            sample = (
                self._random(count) if workers is None else self._random(count, workers=workers)
            )
            if self._optimization is not None:
                sample = optimize(self._optimization, sample, self.rng)
            self.num_generated += len(sample)
        return sample

    def integers(
        self,
        l_bounds: ArrayLike,
        *,
        u_bounds: ArrayLike | None = None,
        n: int = 1,
        endpoint: bool = False,
        workers: int | None = None,
    ) -> NDArray[np.int64]:
        """Draw integers: the next points, moved to the bounds and rounded down.

        Parameters
        ----------
        l_bounds : int or array_like of ints
            The least integer of each dimension; the bound above, from 0, if `u_bounds` is None.
        u_bounds : int or array_like of ints, optional
            One more than the largest integer, or with `endpoint` the largest.
        n : int, optional
            How many points.
        endpoint : bool, optional
            Whether the upper bounds are drawn too.
        workers : int, optional
            As for `random`.

        Returns
        -------
        ndarray (n, d) of int64
            The integers.

        Raises
        ------
        ValueError
            If bounds are not integers or a lower one is not below its upper one.

        Examples
        --------
        >>> from quasilux import qmc
        >>> qmc.Sobol(d=1, scramble=False).integers(6, n=4).ravel()
        array([0, 3, 4, 1])
        """
        lower, upper = (0, l_bounds) if u_bounds is None else (l_bounds, u_bounds)
        lower, upper = np.atleast_1d(lower), np.atleast_1d(upper)
        if not all(np.issubdtype(bound.dtype, np.integer) for bound in (lower, upper)):
            raise ValueError("'u_bounds' and 'l_bounds' must be integers or array-like of integers")
        sample = self.random(n) if workers is None else self.random(n, workers=workers)
        inside = scale(sample, lower, upper + 1 if endpoint else upper)
        return np.floor(inside).astype(np.int64)

    def reset(self) -> Self:
        """Go back to the beginning: the same points follow again.

        Returns
        -------
        QMCEngine
            The engine itself.
        """
        with self._lock:
            if self.rng_seed is not None:
                self.rng = copy.deepcopy(self.rng_seed)
            self.num_generated = 0
        return self

    def fast_forward(self, n: int) -> Self:
        """Skip the next `n` points.

        Parameters
        ----------
        n : int
            How many.

        Returns
        -------
        QMCEngine
            The engine itself.
        """
        self.random(n)
        return self

    def __getstate__(self) -> dict[str, Any]:
        state = vars(self).copy()
        del state["_lock"]
        return state

    def __setstate__(self, state: dict[str, Any]) -> None:
        vars(self).update(state)
        self._lock = threading.RLock()


def _dimensions(d: object) -> int:
    """A number of dimensions; ValueError for anything that is none."""
    if not isinstance(d, (int, np.integer)) or isinstance(d, bool) or d < 0:
        raise ValueError(f"d must be a non-negative integer value, not {d!r}")
    return int(d)


def count_of_points(n: SupportsIndex) -> int:
    """A number of points; TypeError or ValueError for anything that is none."""
    count = operator.index(n)
    if count < 0:
        raise ValueError(f"the number of points must not be negative, but is {count}")
    return count


def _own_generator(rng: RNGLike | SeedLike | None, seed: LegacySeed | None) -> OwnedGenerator:
    """The generator that an engine owns."""
    if seed is None:
        return _child(rng)
    if rng is not None:
        raise TypeError(
            "got multiple values for argument now known as `rng`: give one of `rng` and `seed`"
        )
    if isinstance(seed, np.random.Generator):
        return _child(seed)
    if isinstance(seed, np.random.RandomState):
        return seed
    if isinstance(seed, (numbers.Integral, np.integer)):
        return np.random.default_rng(int(seed))
    raise ValueError(f"{seed!r} cannot be used to seed a numpy.random.Generator instance")


def _child(rng: RNGLike | SeedLike | None) -> np.random.Generator:
    """A generator that is independent of its parent, numpy's `default_rng` of what is given, and of
    all other children of it."""
    if isinstance(rng, (np.random.Generator, np.random.BitGenerator, np.random.RandomState)):
        parent = np.random.default_rng(rng)
        bits = parent.bit_generator
        # The name without an underscore came with numpy 1.25.
        sequence = getattr(bits, "seed_seq", None) or getattr(bits, "_seed_seq", None)
        if not isinstance(sequence, np.random.SeedSequence):
            # Made without a seed sequence: the parent's numbers are all there is.
            words = parent.integers(0, 2**64, size=4, dtype=np.uint64)
            return np.random.default_rng(words.tolist())
        kind = type(bits)
    else:
        # The parent itself would take as long to make as its child.
        kind = np.random.PCG64
        sequence = rng if isinstance(rng, np.random.SeedSequence) else np.random.SeedSequence(rng)
    child: np.random.SeedSequence = sequence.spawn(1)[0]
    return np.random.Generator(kind(child))


def _join_scipys_engines() -> None:
    """Where SciPy is there, let it take these engines for its own: `qmc_quad` asks for that."""
    scipys = getattr(sys.modules.get("scipy.stats.qmc"), "QMCEngine", None)
    if scipys is not None and not issubclass(QMCEngine, scipys):
        scipys.register(QMCEngine)
