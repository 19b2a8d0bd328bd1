"""How far a run is from the reference."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Values = NDArray[np.float64]


def relative_l2(values: Values, reference: Values) -> float:
    """The Euclidean norm of the differences over that of the reference."""
    return float(np.linalg.norm(values - reference) / np.linalg.norm(reference))


def without_reference(mean_square: float, reference_error: float) -> float:
    """The error of a program alone: the reference's own variance is taken off.

    Below half of the reference's error nothing is known, so no smaller error is claimed.
    """
    own = mean_square - reference_error**2
    return max(own, (reference_error / 2) ** 2) ** 0.5


@dataclass(frozen=True)
class Deviation:
    """The deviation of the average over all sensors, over that of the reference."""

    share: float
    standard_error: float

    def within(self, sigmas: float) -> bool:
        """Whether chance explains it."""
        return abs(self.share) <= sigmas * self.standard_error


def deviation(runs: list[Values], reference: Values, reference_error: float) -> Deviation:
    """The deviation of the mean of runs that are independent of each other.

    Its standard error is the larger of two, joined with `reference_error`, which is that of the
    reference's average over the average: from the spread of the runs, widened for being few, and
    from the spread of the sensors' differences, which one run has too.
    """
    mean = float(np.mean(reference))
    stack = np.array(runs)
    averages = stack.mean(axis=1)
    differences = stack.mean(axis=0) - reference
    share = float(differences.mean()) / mean
    of_sensors = float(np.std(differences, ddof=1)) / np.sqrt(len(reference))
    of_runs = 0.0
    if len(runs) > 1:
        of_runs = float(np.std(averages, ddof=1)) / np.sqrt(len(runs)) * _few(len(runs))
    own = max(of_sensors, of_runs) / mean
    return Deviation(share, float(np.hypot(own, reference_error)))


def _few(runs: int) -> float:
    """Student's 97.5 % quantile over that of the normal distribution, for runs - 1 degrees."""
    quantiles = {2: 12.71, 3: 4.30, 4: 3.18, 5: 2.78, 6: 2.57, 7: 2.45, 8: 2.36}
    return quantiles.get(runs, 2.31) / 1.96
