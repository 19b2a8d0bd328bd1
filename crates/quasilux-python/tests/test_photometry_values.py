"""Intensities, fluxes, beams and samples, as arrays."""

from __future__ import annotations

import copy
import gc
import pickle
import threading
import warnings

import numpy as np
import pytest
from lamps import BATWING, TYPE_A, TYPE_B, UNEVEN, direction, gauss, integral, luminaire_files
from quasilux import InputError, photometry

# Intensities.


def test_intensities_are_bilinear_between_the_angles_of_the_file():
    lamp = photometry.read(UNEVEN)
    table = np.array([[100, 80, 50, 10, 20], [100, 20, 90, 0, 20], [100, 60, 10, 40, 20]])
    np.testing.assert_array_equal(lamp.intensity_cd[:3], table)
    found = lamp.intensity(direction(np.array([[0], [70], [200]]), [0, 20, 60, 110, 180]))
    np.testing.assert_allclose(found, table, rtol=1e-13, atol=1e-12)
    t, s = 0.3, 0.6
    between = lamp.intensity(direction(70 + 130 * t, 20 + 40 * s))
    rows = (1 - t) * table[1] + t * table[2]
    assert between == pytest.approx((1 - s) * rows[1] + s * rows[2], rel=1e-13)
    assert isinstance(between, np.float64)


@pytest.mark.parametrize(("file", "kind"), [(TYPE_A, "A"), (TYPE_B, "B")])
def test_types_a_and_b_lie_where_the_standard_puts_them(file, kind):
    lamp = photometry.read(file)
    assert lamp.type == kind
    h, v = np.radians(lamp.horizontal_deg)[:, None], np.radians(lamp.vertical_deg)
    if kind == "A":
        parts = (np.cos(v) * np.cos(h), -np.cos(v) * np.sin(h), np.sin(v) + 0 * h)
    else:
        parts = (np.cos(h) * np.sin(v), -np.sin(h) + 0 * v, -np.cos(h) * np.cos(v))
    directions = np.stack(np.broadcast_arrays(*parts), axis=-1)
    assert lamp.intensity_cd.tolist() == [[1, 40, 20, 2], [0, 300, 80, 4], [0, 50, 60, 6]]
    # At the poles all angles around are one direction.
    inside = (slice(None), slice(1, -1)) if kind == "A" else (slice(1, -1), slice(None))
    found = lamp.intensity(directions)
    np.testing.assert_allclose(found[inside], lamp.intensity_cd[inside], rtol=1e-12, atol=1e-12)
    assert lamp.intensity([-1, 0, 0] if kind == "A" else [0, 0, 1]) == 0.0
    assert not hasattr(lamp, "c_deg")
    with pytest.raises(
        AttributeError, match=f"type {kind} has no gamma_deg; expected vertical_deg"
    ):
        _ = lamp.gamma_deg
    # The same by other angles.
    c = np.degrees(np.arctan2(directions[..., 1], directions[..., 0]))
    gamma = np.degrees(np.arccos(-directions[..., 2].clip(-1, 1)))
    again = lamp.intensity_at(c_deg=c, gamma_deg=gamma)
    np.testing.assert_allclose(again[inside], found[inside], rtol=1e-7, atol=1e-9)


def test_angles_are_broadcast_and_have_bounds(batwing):
    assert batwing.intensity_at(gamma_deg=0) == 900.5
    whole = batwing.intensity_at(c_deg=batwing.c_deg[:, None], gamma_deg=batwing.gamma_deg)
    np.testing.assert_allclose(whole, batwing.intensity_cd, rtol=1e-13)
    turned = batwing.intensity_at(c_deg=[-30, 330, 690], gamma_deg=40)
    np.testing.assert_allclose(turned, turned[0], rtol=1e-12)
    bad = batwing.intensity_at(c_deg=[0, 0, 0, np.nan, np.inf], gamma_deg=[-1, 181, np.nan, 1, 1])
    assert np.isnan(bad).all()
    assert batwing.intensity_at(c_deg=np.zeros((0, 1)), gamma_deg=[1, 2]).shape == (0, 2)
    with pytest.raises(ValueError, match="expected shapes that broadcast together"):
        batwing.intensity_at(c_deg=[1, 2, 3], gamma_deg=[1, 2])


# Figures.


def test_fluxes_are_the_integrals_of_intensities():
    for file in [BATWING, *luminaire_files()]:
        try:
            lamp = photometry.read(file)
        except InputError:
            continue
        if lamp.type == "C":
            expected = integral(lamp)
        else:
            grid = lamp.unfolded()
            latitude, longitude = grid.vertical_deg, grid.horizontal_deg
            values = grid.intensity_cd.T
            if lamp.type == "B":
                latitude, longitude, values = longitude, latitude, values.T
            place, weight = gauss(latitude)
            rows = np.array([np.interp(place, latitude, column) for column in values.T])
            bands = rows @ (weight * np.cos(np.radians(place)))
            middles = (bands[:-1] + bands[1:]) / 2
            expected = middles @ np.diff(np.radians(longitude))
        assert lamp.flux_lm == pytest.approx(expected, rel=1e-9), file


def test_zones_and_cones_are_parts_of_the_flux():
    lamp = photometry.read(UNEVEN)
    for low, high in ((0, 10), (10, 20), (90, 100), (170, 180)):
        zone = lamp.analysis.zones_lm[low // 10]
        assert zone == pytest.approx(integral(lamp, low, high), rel=1e-10)
        cones = lamp.flux_below_lm([low, high])
        assert zone == pytest.approx(cones[1] - cones[0], rel=1e-10)
    assert lamp.flux_below_lm(180) == pytest.approx(lamp.flux_lm)
    assert lamp.analysis.downward_flux_lm == pytest.approx(integral(lamp, 0, 90))
    assert np.isnan(lamp.flux_below_lm([-1, 181, np.nan])).all()
    assert lamp.flux_below_lm(np.zeros((2, 0))).shape == (2, 0)


def test_beams_end_where_the_curve_crosses_half_its_maximum(batwing):
    plane = batwing.plane(90)
    assert plane.name == "C90-C270"
    assert plane.maximum_cd == batwing.maximum_cd == 1441.3
    edge = plane.beam.end_deg
    assert batwing.intensity_at(c_deg=90, gamma_deg=edge) == pytest.approx(1441.3 / 2)
    assert plane.beam.angle_deg == pytest.approx(2 * edge)
    assert plane.field.end_deg > plane.beam.end_deg
    wide = np.linspace(0, 90, 20001)
    outermost = wide[batwing.intensity_at(c_deg=90, gamma_deg=wide) >= 1441.3 / 2].max()
    assert edge == pytest.approx(outermost, abs=0.005)
    oblique = batwing.plane(-325)
    assert oblique.name == "C35-C215"
    found = np.interp([-30, 30], oblique.gamma_deg, oblique.intensity_cd)
    expected = batwing.intensity_at(c_deg=[215, 35], gamma_deg=30)
    np.testing.assert_allclose(found, expected, rtol=1e-9)
    for c_deg in (np.nan, np.inf):
        with pytest.raises(ValueError, match="not finite"):
            batwing.plane(c_deg)


def test_silhouettes_are_those_of_the_shape():
    lamp = photometry.read(UNEVEN)
    assert lamp.luminous_shape == photometry.LuminousShape("box", (0.6, 0.3, 0.1))
    area = lamp.projected_area_m2([[0, 0, -1], [2, 0, 0], [0, -3, 0], [1, 1, 1], [0, 0, 0]])
    sides = np.array([0.18, 0.03, 0.06])
    np.testing.assert_allclose(area[:4], [*sides, sides.sum() / np.sqrt(3)])
    assert np.isnan(area[4])


# Samples.


def chi_square(lamp, directions):
    """The probability of as large a deviation in 16 x 9 cells of C and gamma."""
    stats = pytest.importorskip("scipy.stats")
    gamma = np.degrees(np.arccos(-directions[:, 2].clip(-1, 1)))
    c = np.degrees(np.arctan2(directions[:, 1], directions[:, 0])) % 360
    gamma_edges, c_edges = np.linspace(0, 180, 10), np.linspace(0, 360, 17)
    counts, *_ = np.histogram2d(gamma, c, [gamma_edges, c_edges])
    expected = np.array([
        [integral(lamp, *g, c_range=cs) for cs in zip(c_edges[:-1], c_edges[1:])]
        for g in zip(gamma_edges[:-1], gamma_edges[1:])
    ])  # fmt: skip
    expected *= len(directions) / expected.sum()
    enough = expected > 5
    assert counts[~enough].sum() <= 10 * max(1, expected[~enough].sum())
    statistic = ((counts - expected)[enough] ** 2 / expected[enough]).sum()
    return stats.chi2.sf(statistic, enough.sum() - 1)


def test_samples_are_distributed_as_the_light_is(batwing):
    """Seed 1, significance 1e-6 of each of 2; light moved by 2 % between halves is found."""
    for lamp in (batwing, photometry.read(UNEVEN)):
        u = np.random.default_rng(1).random((400_000, 2))
        found = lamp.sample(u)
        np.testing.assert_allclose(np.linalg.norm(found, axis=1), 1, atol=1e-15)
        assert chi_square(lamp, found) > 1e-6
        # A distribution that is 2 % wrong: of the second coordinate the lower half is more likely.
        u[:, 1] = np.where(u[:, 1] < 0.51, u[:, 1] / 1.02, 0.5 + (u[:, 1] - 0.51) / 0.98)
        assert chi_square(lamp, lamp.sample(u)) < 1e-6


@pytest.mark.parametrize("file", [BATWING, UNEVEN, TYPE_A, TYPE_B])
def test_densities_integrate_to_one(file):
    lamp = photometry.read(file)
    # A lattice over the sphere, equal solid angles; the sectors of types A and B have bright edges.
    count = 1_000_000
    index = np.arange(count)
    z = 1 - (2 * index + 1) / count
    phi = 2 * np.pi * ((index * 0.6180339887498949) % 1)
    sine = np.sqrt(1 - z * z)
    directions = np.column_stack([sine * np.cos(phi), sine * np.sin(phi), z])
    density = lamp.pdf(directions)
    assert 4 * np.pi * density.mean() == pytest.approx(1, abs=1e-3)
    np.testing.assert_allclose(density, lamp.intensity(directions) / lamp.flux_lm, rtol=1e-13)


@pytest.mark.parametrize("file", [BATWING, UNEVEN, TYPE_A, TYPE_B])
def test_samples_are_inverted(file):
    lamp = photometry.read(file)
    u = np.random.default_rng(2).random((5, 200, 2)) * 0.998 + 0.001
    found = lamp.sample(u)
    assert found.shape == (5, 200, 3)
    np.testing.assert_allclose(lamp.invert(found), u, atol=1e-9)
    assert (lamp.pdf(found) > 0).all()


def test_coordinates_have_bounds(batwing):
    assert np.isfinite(batwing.sample([[0, 0], [1, 1]])).all()
    for bad in ([-0.1, 0], [0, 1.1], [np.nan, 0], [0, np.inf]):
        with pytest.raises(ValueError, match="expected coordinates of the unit square"):
            batwing.sample([[0.5, 0.5], bad])
    dark = photometry.from_intensities(0, [0, 90], [0, 0])
    with pytest.raises(ValueError, match="gives no light"):
        dark.sample([0.5, 0.5])
    assert dark.pdf([0, 0, -1]) == 0
    assert dark.analysis.maximum is None


# Arrays.


def test_arrays_may_have_any_layout_and_type(batwing):
    wide = np.random.default_rng(3).normal(size=(4, 6, 5))
    expected = batwing.intensity(np.ascontiguousarray(wide[::2, :, 1:4]))
    assert expected.shape == (2, 6)
    np.testing.assert_array_equal(batwing.intensity(wide[::2, :, 1:4]), expected)
    np.testing.assert_array_equal(batwing.intensity(np.asfortranarray(wide[::2, :, 1:4])), expected)
    np.testing.assert_array_equal(batwing.intensity(wide[::2, ::-1, 1:4]), expected[:, ::-1])
    np.testing.assert_array_equal(batwing.intensity(wide[::2, :, 1:4].tolist()), expected)
    single = wide[..., 1:4].astype(np.float32)
    np.testing.assert_array_equal(
        batwing.intensity(single), batwing.intensity(single.astype(float))
    )
    big = single.astype(">f8")
    np.testing.assert_array_equal(batwing.intensity(big), batwing.intensity(single))
    for kind in (np.int8, np.uint64, np.float16, np.longdouble, bool):
        np.testing.assert_allclose(batwing.intensity(np.array([0, 0, 1], kind)), 0)
    locked = wide[..., 1:4].copy()
    locked.flags.writeable = False
    batwing.intensity(locked)
    for shape in ((0, 3), (2, 0, 3)):
        assert batwing.intensity(np.empty(shape)).shape == shape[:-1]
        assert batwing.invert(np.empty(shape)).shape == (*shape[:-1], 2)
    assert batwing.sample(np.empty((0, 2))).shape == (0, 3)


def test_directions_may_have_any_length(batwing):
    ways = direction([10, 100, 200], [30, 80, 5])
    expected = batwing.intensity(ways)
    for length in (1e-300, 1e-9, 7.0, 1e300):
        np.testing.assert_allclose(batwing.intensity(length * ways), expected, rtol=1e-11)
    none = [[0, 0, 0], [np.nan, 0, 1], [np.inf, 0, 0], [-np.inf, np.inf, 1]]
    assert np.isnan(batwing.intensity(none)).all()
    assert np.isnan(batwing.pdf(none)).all()
    assert np.isnan(batwing.invert(none)).all()


def test_what_is_no_array_of_directions_is_refused(batwing):
    for shape in ((), (2,), (3, 2), (0,), (3, 4)):
        with pytest.raises(
            ValueError, match=r"directions has the shape .*; expected \(\.\.\., 3\)"
        ):
            batwing.intensity(np.zeros(shape))
    with pytest.raises(ValueError, match=r"u has the shape \(3,\); expected \(\.\.\., 2\)"):
        batwing.sample(np.zeros(3))
    for values in (np.zeros(3, complex), ["a", "b", "c"], [None, 1, 2]):
        with pytest.raises(TypeError, match="directions has the type .*; expected real numbers"):
            batwing.intensity(values)
    with pytest.raises((ValueError, TypeError)), warnings.catch_warnings(record=True):
        batwing.intensity([[1, 2, 3], [1, 2]])


def test_threads_share_a_luminaire(batwing):
    ways = np.random.default_rng(4).normal(size=(20_000, 3))
    expected = batwing.intensity(ways)
    found = {}

    def work(number):
        found[number] = batwing.intensity(ways), batwing.analysis.flux_lm

    threads = [threading.Thread(target=work, args=(number,)) for number in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(found) == 8
    for intensities, flux_lm in found.values():
        np.testing.assert_array_equal(intensities, expected)
        assert flux_lm == batwing.flux_lm


def test_results_outlive_their_luminaire():
    lamp = photometry.read(UNEVEN)
    table, plane, samples = lamp.intensity_cd, lamp.plane(10), lamp.sample([[0.5, 0.5]])
    kept = table.copy(), plane.intensity_cd.copy(), samples.copy()
    del lamp
    gc.collect()
    for array, copied in zip((table, plane.intensity_cd, samples), kept):
        np.testing.assert_array_equal(array, copied)


@pytest.mark.parametrize("make", [pickle.loads, None])
def test_luminaires_are_copied_and_pickled(make, tmp_path):
    lamp = photometry.from_intensities([0, 90], [0, 90], [[9, 1], [9, 2]], name="own")
    for original in (photometry.read(UNEVEN, name="a.ies"), lamp):
        again = copy.deepcopy(original) if make is None else make(pickle.dumps(original))
        assert again.to_dict() == original.to_dict()
        assert (again.file, again.warnings) == (original.file, original.warnings)
        np.testing.assert_array_equal(again.intensity_cd, original.intensity_cd)
