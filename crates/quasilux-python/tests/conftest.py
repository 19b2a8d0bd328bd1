"""A luminaire that many tests look at."""

from __future__ import annotations

import pytest
from lamps import BATWING
from quasilux import photometry


@pytest.fixture(scope="module")
def batwing() -> photometry.Photometry:
    return photometry.read(BATWING)
