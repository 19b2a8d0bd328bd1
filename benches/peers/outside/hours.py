"""Hours of a year, whichever program they come from."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from outside.times import Times

GROUND_REFLECTANCE = 0.2

Hours = NDArray[np.float32]
"""Illuminances in lx by point and hour."""

Which = NDArray[np.bool_]
"""Hours that belong to a kind."""


@dataclass(frozen=True)
class Year:
    """The hours of all points, and what they took."""

    hours: Hours
    times: Times


@dataclass(frozen=True)
class Calendar:
    """Hours that count, those among them without sun, and those when people are there."""

    is_lit: Which
    is_sunless: Which
    is_occupied: Which
