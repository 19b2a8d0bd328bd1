"""Points that keep a distance from each other."""

from __future__ import annotations

from itertools import product
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from quasilux.qmc._engine import QMCEngine
from quasilux.qmc._scale import Bounds

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray
    from typing_extensions import Self

    from quasilux.qmc._engine import LegacySeed, RNGLike, SeedLike
    from quasilux.qmc._optimization import OptimizationName


class PoissonDisk(QMCEngine):
    """Random points of which no two are closer than a radius.

    Parameters
    ----------
    d : int
        The number of dimensions; time and memory grow fast with it.
    radius : float, optional
        The least distance of two points, in the unit of the bounds.
    hypersphere : {"volume", "surface"}, optional
        Where candidates around a point are drawn: up to two radii away, or one radius away.
    ncandidates : int, optional
        How many candidates each point has; more make denser samples.
    optimization, rng, seed
        As for `QMCEngine`.
    l_bounds, u_bounds : array_like (d,), optional
        The box to fill, the unit cube by default.

    Raises
    ------
    ValueError
        If the radius is not positive, `hypersphere` is unknown or bounds do not fit.

    Notes
    -----
    A sample has fewer than `n` points where the box is full. R. Bridson, "Fast Poisson disk
    sampling in arbitrary dimensions" (SIGGRAPH sketches, 2007).

    Examples
    --------
    >>> from quasilux import qmc
    >>> sample = qmc.PoissonDisk(d=2, radius=0.2, rng=1).fill_space()
    >>> bool(qmc.geometric_discrepancy(sample) >= 0.2)
    True
    """

    def __init__(
        self,
        d: int,
        *,
        radius: float = 0.05,
        hypersphere: Literal["volume", "surface"] = "volume",
        ncandidates: int = 30,
        optimization: OptimizationName | None = None,
        rng: RNGLike | SeedLike | None = None,
        l_bounds: ArrayLike | None = None,
        u_bounds: ArrayLike | None = None,
        seed: LegacySeed | None = None,
    ) -> None:
        super().__init__(d, optimization=optimization, rng=rng, seed=seed)
        if hypersphere not in ("volume", "surface"):
            raise ValueError(
                f"{hypersphere!r} is not a valid hypersphere sampling method."
                " It must be one of 'volume' and 'surface'"
            )
        if not radius > 0:
            raise ValueError(f"radius must be positive, not {radius!r}")
        self.radius = float(radius)
        self.ncandidates = int(ncandidates)
        self._on_surface = hypersphere == "surface"
        lower = 0.0 if l_bounds is None else l_bounds
        upper = 1.0 if u_bounds is None else u_bounds
        bounds = Bounds.of(lower, upper, self.d)
        self.l_bounds = bounds.lower.astype(np.float64)
        self.u_bounds = bounds.upper.astype(np.float64)
        # What `scipy.integrate.qmc_quad` makes more engines of this kind from.
        self._init_quad: dict[str, Any] = {
            "d": d,
            "radius": radius,
            "hypersphere": hypersphere,
            "ncandidates": ncandidates,
            "optimization": optimization,
        }
        self._clear()

    def _clear(self) -> None:
        """Begin with an empty box.

        The diagonal of a cell is the radius, so a cell holds at most one point, and points closer
        than the radius are at most sqrt(d) cells away along each axis. As many empty cells around
        the box spare the test of its border.
        """
        self._cell = self.radius / np.sqrt(max(self.d, 1))
        reach = int(np.ceil(np.sqrt(self.d)))
        sides = np.ceil((self.u_bounds - self.l_bounds) / self._cell).astype(np.int64)
        shape = sides + 1 + 2 * reach
        self._strides = np.append(np.cumprod(shape[:0:-1])[::-1], [1])[: self.d].astype(np.int64)
        self._grid = np.full((int(np.prod(shape)), self.d), np.nan)
        steps = np.array(list(product(range(-reach, reach + 1), repeat=self.d)), dtype=np.int64)
        self._neighbours = steps @ self._strides
        self._reach = reach
        self._is_empty = True
        self._active: list[NDArray[np.float64]] = []

    def _random(self, n: int = 1, *, workers: int = 1) -> NDArray[np.float64]:
        return np.empty((n, 0)) if self.d == 0 else self._draw(n)

    def _draw(self, n: int | None) -> NDArray[np.float64]:
        """At most `n` points more, or all that find room."""
        drawn: list[NDArray[np.float64]] = []
        if self._is_empty and n != 0:
            self._put(self.rng.uniform(self.l_bounds, self.u_bounds), drawn)
        while self._active and len(drawn) != n:
            place = min(int(self.rng.uniform() * len(self._active)), len(self._active) - 1)
            before = len(drawn)
            for candidate in self._free(self._candidates(self._active[place])):
                if len(drawn) == n:
                    # The centre keeps its turn for the next sample.
                    break
                others = np.array(drawn[before:]).reshape(-1, self.d)
                if np.all(((others - candidate) ** 2).sum(axis=1) >= self.radius**2):
                    self._put(candidate, drawn)
            else:
                self._active.pop(place)
        return np.array(drawn).reshape(-1, self.d)

    def _candidates(self, centre: NDArray[np.float64]) -> NDArray[np.float64]:
        """Points around a centre: uniform in a ball of two radii, or just off a radius away."""
        directions = self.rng.standard_normal(size=(self.ncandidates, self.d))
        directions /= np.sqrt((directions**2).sum(axis=1, keepdims=True))
        if self._on_surface:
            # Rounding must not bring a point back within the radius.
            return centre + 1.001 * self.radius * directions
        # The ball within a share r of the radius has a share r^d of the volume.
        shares = self.rng.uniform(size=(self.ncandidates, 1)) ** (1.0 / self.d)
        return centre + 2.0 * self.radius * shares * directions

    def _free(self, candidates: NDArray[np.float64]) -> NDArray[np.float64]:
        """Those that are in the box and not closer than the radius to any point."""
        inside = np.all((candidates >= self.l_bounds) & (candidates <= self.u_bounds), axis=1)
        candidates = candidates[inside]
        nearby = self._grid[self._cells(candidates)[:, np.newaxis] + self._neighbours]
        squares = ((nearby - candidates[:, np.newaxis]) ** 2).sum(axis=2)
        # Empty cells hold no numbers, which are less than nothing.
        return candidates[~np.any(squares < self.radius**2, axis=1)]

    def _cells(self, points: NDArray[np.float64]) -> NDArray[np.int64]:
        """The numbers of the cells that points are in."""
        places = ((points - self.l_bounds) / self._cell).astype(np.int64) + self._reach
        return places @ self._strides

    def _put(self, point: NDArray[np.float64], drawn: list[NDArray[np.float64]]) -> None:
        """Take a point into the sample, and into the box."""
        self._grid[self._cells(point)] = point
        self._is_empty = False
        self._active.append(point)
        drawn.append(point)

    def fill_space(self) -> NDArray[np.float64]:
        """Draw points until no candidate finds room.

        Returns
        -------
        ndarray (n, d)
            All points that were found.
        """
        with self._lock:
            sample = self._draw(None)
            self.num_generated += len(sample)
        return sample

    def reset(self) -> Self:
        """Go back to the beginning, with an empty box.

        Returns
        -------
        PoissonDisk
            The engine itself.
        """
        with self._lock:
            super().reset()
            self._clear()
        return self
