"""Daylight factors and their components, as the document has them."""

from __future__ import annotations

import pickle
from typing import Any

import numpy as np
import pytest
from rooms import example, room
from years import FACES, square

import quasilux

COMPONENTS = (
    "sky_component",
    "externally_reflected_component",
    "internally_reflected_component",
)


@pytest.fixture(scope="module")
def result() -> quasilux.Result:
    return quasilux.simulate(example("daylight-office").with_name("overcast.toml"), samples=32)


def test_daylight_factors_are_those_of_the_document(result: quasilux.Result) -> None:
    workplane = result["workplane"]
    assert result.horizontal_illuminance_lx == pytest.approx(10_000)
    points = result.to_dict()["sensors"][0]["points"]
    for name in ("daylight_factor", *COMPONENTS):
        found: quasilux.Figures = getattr(workplane, name)
        assert found.shape == found.half_width.shape == workplane.shape == (8, 6)
        assert np.array_equal(found.value.ravel(), [point[name] for point in points])
        half_widths = np.array([point[f"{name}_half_width"] for point in points], float)
        assert np.array_equal(found.half_width.ravel(), half_widths, equal_nan=True)
        assert not found.value.flags.writeable and not found.half_width.flags.writeable
    unseen = [point["components_unseen"] for point in points]
    assert workplane.components_unseen is not None
    assert np.array_equal(workplane.components_unseen.ravel(), unseen)


def test_components_make_the_factor(result: quasilux.Result) -> None:
    workplane = result["workplane"]
    factor = workplane.daylight_factor
    assert factor is not None and result.horizontal_illuminance_lx is not None
    outside_lx = result.horizontal_illuminance_lx
    assert np.allclose(factor.value, workplane.illuminance_lx / outside_lx, rtol=1e-12)
    assert np.allclose(factor.half_width, workplane.half_width_lx / outside_lx, rtol=1e-12)
    parts = sum(np.asarray(getattr(workplane, name)) for name in COMPONENTS)
    assert np.allclose(parts, factor, rtol=1e-12)
    again = pickle.loads(pickle.dumps(workplane))
    assert np.array_equal(again.daylight_factor, factor) and np.asarray(factor).shape == (8, 6)


def test_where_there_is_none() -> None:
    few: dict[str, Any] = {"samples": 1}
    lamp = quasilux.simulate(room(), **few)
    assert lamp.horizontal_illuminance_lx is None and lamp["desk"].daylight_factor is None
    assert lamp["desk"].components_unseen is None
    under_the_sky = quasilux.Scene(
        mesh={"floor": (square(1, 0), FACES)},
        materials={"floor": {"reflectance": 0.2}},
        sky={"model": "cie", "type": 16, "horizontal_illuminance_lx": 10_000},
        ground={"reflectance": 0.2},
        sensors={"up": {"kind": "points", "points": [[0.5, 0.5, 1]], "normals": [[0, 0, 1]]}},
    )
    result = quasilux.simulate(under_the_sky, rel_tol=0.05)
    factor = result["up"].daylight_factor
    # All of the sky is there, and nothing else; without openings there are no parts.
    assert factor is not None and abs(factor.value[0] - 1.0) <= 2 * factor.half_width[0] + 1e-9
    assert result["up"].sky_component is None


def test_openings_make_an_inside() -> None:
    opening = {"origin": [0, 0, 2], "u": [1, 0, 0], "v": [0, 1, 0]}
    scene = room(
        lights=[],
        sky={"model": "uniform", "horizontal_illuminance_lx": 1000},
        openings=[opening],
        sensors={"up": {"kind": "points", "points": [[0.5, 0.5, 3]], "normals": [[0, 0, 1]]}},
    )
    result = quasilux.simulate(scene, samples=16)
    assert result["up"].sky_component is not None
