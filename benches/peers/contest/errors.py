"""How far a run is from the reference."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Values = NDArray[np.float64]


def relative_l2(values: Values, reference: Values) -> float:
    """The Euclidean norm of the differences over that of the reference."""
    return float(np.linalg.norm(values - reference) / np.linalg.norm(reference))


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
    reference's average over the average: from the spread of the runs, and from the spread of the
    sensors' differences, which one run has too.
    """
    mean = float(np.mean(reference))
    stack = np.array(runs)
    averages = stack.mean(axis=1)
    differences = stack.mean(axis=0) - reference
    share = float(differences.mean()) / mean
    of_sensors = float(np.std(differences, ddof=1)) / np.sqrt(len(reference))
    of_runs = float(np.std(averages, ddof=1)) / np.sqrt(len(runs)) if len(runs) > 1 else 0.0
    own = max(of_sensors, of_runs) / mean
    return Deviation(share, float(np.hypot(own, reference_error)))
