"""Matrices, densities and samples of BSDFs, as arrays."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from quasilux import InputError, bsdf
from surfaces import FIVE, KINDS, MADE, MATRIX, WEIGHTS, hemisphere, surface_files, surfaces, tables

# Matrices.


def matrix_of(table):
    assert table.matrix is not None
    return table.matrix


def test_matrices_are_those_of_the_file():
    table = bsdf.read(MATRIX).table("front", "reflection")
    matrix = matrix_of(table)
    np.testing.assert_array_equal(matrix.values, FIVE)
    for basis in (matrix.incident, matrix.exit):
        assert basis.name == "five"
        assert basis.patches.tolist() == [1, 4]
        assert (basis.lower_deg.tolist(), basis.upper_deg.tolist()) == ([0, 30], [30, 90])
        assert basis.theta_deg.tolist() == [0, 60, 60, 60, 60]
        assert basis.phi_deg.tolist() == [0, 0, 90, 180, 270]
        omega = np.pi * np.array([0.25, *[0.75 / 4] * 4])
        np.testing.assert_allclose(basis.projected_solid_angle_sr, omega, rtol=1e-14)
    # Azimuths of patches are those of light going onwards.
    exits = bsdf.direction(theta_deg=matrix.exit.theta_deg, phi_deg=matrix.exit.phi_deg)
    arriving = exits * [-1, -1, 1]
    found = table.evaluate(arriving[:, None], exits)
    np.testing.assert_array_equal(found, FIVE)
    np.testing.assert_allclose(table.albedo(arriving), FIVE @ omega, rtol=1e-14)
    np.testing.assert_allclose(
        bsdf.direction(theta_deg=60, phi_deg=[180, 270, 0, 90])[:, :2],
        arriving[1:, :2],
        atol=1e-15,
    )
    for array in (matrix.values, omega := matrix.exit.phi_deg, table.incidences):
        assert not array.flags.writeable
    assert omega.shape == (5,)


def test_balances_are_sums_of_the_matrix():
    surface = bsdf.read(MATRIX)
    front, back = surface.energy
    omega = matrix_of(surface.tables[0]).exit.projected_solid_angle_sr
    reflected, passed = FIVE @ omega, FIVE[::-1] @ omega
    assert (front.side, back.side) == ("front", "back")
    assert front.normal_reflectance == pytest.approx(reflected[0])
    assert front.normal_transmittance == pytest.approx(passed[0])
    assert front.diffuse_reflectance == pytest.approx(reflected @ omega / np.pi)
    assert front.diffuse_transmittance == pytest.approx(passed @ omega / np.pi)
    assert front.most_scattered == pytest.approx((reflected + passed).max())
    worst = front.most_scattered_wi
    total = sum(surface.albedo(worst, mode=mode) for mode in ("reflection", "transmission"))
    assert total == pytest.approx(front.most_scattered)
    # Swapped directions: the incident patch of light that comes from where an exit patch sends it.
    opposite = [0, 3, 4, 1, 2]
    swapped = FIVE.T[np.ix_(opposite, opposite)]
    weights = omega[:, None] * omega
    off, greater = abs(FIVE - swapped), np.maximum(FIVE, swapped)
    reflection = surface.reciprocity[0]
    assert (reflection.side, reflection.mode) == ("front", "reflection")
    assert reflection.mean_defect == pytest.approx(
        (weights * off).sum() / (weights * greater).sum()
    )
    assert reflection.worst_defect == pytest.approx((off / greater).max())
    wi, wo = reflection.worst_pair
    one, other = surface.evaluate(wi, wo), surface.evaluate(wo, wi)
    assert abs(one - other) / max(one, other) == pytest.approx(reflection.worst_defect)


def test_other_tables_have_no_matrix():
    made = surfaces()
    (table,) = made["tree.xml"].tables
    assert (table.kind, table.matrix, table.leaves, table.resolution) == (
        "tensor tree",
        None,
        15,
        4,
    )
    assert repr(table).startswith("<Table front reflection: tensor tree, ")
    (table,) = made["red.binary"].tables
    assert (table.kind, table.matrix, table.leaves, table.is_coloured) == (
        "gridded",
        None,
        None,
        True,
    )


def test_matrices_of_published_files_add_up():
    for file in surface_files():
        try:
            surface = bsdf.read(file)
        except InputError:
            continue
        for table in surface.tables:
            if table.matrix is None:
                continue
            omega = table.matrix.exit.projected_solid_angle_sr
            assert omega.sum() == pytest.approx(np.pi)
            shares = table.matrix.values @ omega
            np.testing.assert_allclose(table.albedo(table.incidences), shares, rtol=1e-12)


# Scattering.


@pytest.mark.parametrize(("name", "table"), tables())
def test_shares_are_integrals_of_what_is_scattered(name, table):
    directions, weight = hemisphere()
    for wi in ([0, 0, 1], [0.5, 0.2, 0.8], [-0.1, 0.9, 0.3]):
        share = table.albedo(wi)
        luminance = table.evaluate(wi, directions)
        rgb = table.evaluate(wi, directions, rgb=True)
        assert luminance.sum() * weight == pytest.approx(share, rel=5e-3)
        expected = table.albedo(wi, rgb=True)
        np.testing.assert_allclose(rgb.sum(axis=0) * weight, expected, rtol=5e-3)
        np.testing.assert_allclose(rgb @ WEIGHTS, luminance, rtol=1e-12)
        assert expected @ WEIGHTS == pytest.approx(share)
        if not table.is_coloured:
            assert np.ptp(rgb, axis=1).max() == 0


@pytest.mark.parametrize(("name", "table"), tables())
def test_densities_integrate_to_one_and_samples_are_inverted(name, table):
    directions, weight = hemisphere()
    wi = np.array([0.5, 0.2, 0.8])
    density = table.pdf(wi, directions)
    assert (density / directions[:, 2]).sum() * weight == pytest.approx(1, rel=5e-3)
    expected = table.evaluate(wi, directions) * directions[:, 2] / table.albedo(wi)
    np.testing.assert_allclose(density, expected, rtol=1e-6)
    u = np.random.default_rng(1).random((50, 40, 2))
    wo = table.sample(wi, u)
    assert wo.shape == (50, 40, 3)
    np.testing.assert_allclose(np.linalg.norm(wo, axis=-1), 1, atol=1e-14)
    assert (wo[..., 2] >= 0).all()
    again = table.sample(wi, table.invert(wi, wo))
    np.testing.assert_allclose(again, wo, atol=1e-6)
    if table.kind != "gridded":
        # Of mixtures of lobes several coordinates lead to a direction.
        np.testing.assert_allclose(table.invert(wi, wo), u, atol=1e-8)


@pytest.mark.parametrize(("name", "table"), tables())
def test_samples_are_distributed_as_light_is_scattered(name, table):
    """Seed 2, significance 1e-6 of each of 9; light that is 2 % wrong in each cell is found."""
    stats = pytest.importorskip("scipy.stats")
    wi = np.array([0.3, -0.4, 0.8])
    directions, _ = hemisphere()
    light = table.evaluate(wi, directions)

    def cells(at):
        """Of 4 rings and 8 sectors of equal projected solid angle."""
        ring = np.minimum((at[:, 0] ** 2 + at[:, 1] ** 2) * 4, 3).astype(int)
        sector = np.minimum((np.arctan2(at[:, 1], at[:, 0]) / np.pi + 1) * 4, 7).astype(int)
        return 8 * ring + sector

    def probability(found):
        counts = np.bincount(found, minlength=32)
        expected = np.bincount(cells(directions), light, minlength=32)
        expected *= counts.sum() / expected.sum()
        enough = expected > 5
        assert counts[~enough].sum() <= 10 * max(1, expected[~enough].sum())
        statistic = ((counts - expected)[enough] ** 2 / expected[enough]).sum()
        return stats.chi2.sf(statistic, enough.sum() - 1)

    rng = np.random.default_rng(2)
    found = cells(table.sample(wi, rng.random((400_000, 2))))
    assert probability(found) > 1e-6
    # Of each second cell, in the order of their light, 4 % are left out.
    order = np.argsort(np.bincount(found, minlength=32))
    is_kept = (order.argsort()[found] % 2 == 0) | (rng.random(found.size) < 0.96)
    assert probability(found[is_kept]) < 1e-6


def test_even_surfaces_have_their_closed_form():
    surface = bsdf.read(MADE["red.binary"])
    wi = bsdf.direction(theta_deg=[0, 20, 55])
    share = surface.albedo(wi, rgb=True)
    np.testing.assert_allclose(share, np.pi * np.array([[0.2, 0.1, 0.05]] * 3), rtol=0.01)
    found = surface.evaluate(wi, [0.1, 0.2, 0.9], rgb=True)
    np.testing.assert_allclose(found, [[0.2, 0.1, 0.05]] * 3, rtol=1e-6)


def test_surfaces_and_their_tables_say_the_same():
    surface = bsdf.read(MATRIX)
    rng = np.random.default_rng(3)
    wi, wo = np.abs(rng.normal(size=(2, 30, 3)))
    u = rng.random((30, 2))
    for side, mode in KINDS:
        table = next((t for t in surface.tables if (t.side, t.mode) == (side, mode)), None)
        which: Any = {"side": side, "mode": mode}
        if table is None:
            assert (surface.albedo(wi, **which) == 0).all()
            assert (surface.evaluate(wi, wo, **which, rgb=True) == 0).all()
            assert (surface.pdf(wi, wo, **which) == 0).all()
            assert np.isnan(surface.sample(wi, u, **which)).all()
            assert np.isnan(surface.invert(wi, wo, **which)).all()
            continue
        assert surface.table(side, mode) is table
        np.testing.assert_array_equal(surface.albedo(wi, **which), table.albedo(wi))
        np.testing.assert_array_equal(surface.evaluate(wi, wo, **which), table.evaluate(wi, wo))
        np.testing.assert_array_equal(surface.pdf(wi, wo, **which), table.pdf(wi, wo))
        np.testing.assert_array_equal(surface.sample(wi, u, **which), table.sample(wi, u))
        np.testing.assert_array_equal(surface.invert(wi, wo, **which), table.invert(wi, wo))


def test_nothing_is_scattered_below_a_side():
    for name, table in tables():
        up, down = [0.3, 0.1, 0.8], [0.3, 0.1, -0.8]
        for wi, wo in ((up, down), (down, up), (down, down)):
            assert table.evaluate(wi, wo) == 0, name
            assert table.pdf(wi, wo) == 0, name
            assert np.isnan(table.invert(wi, wo)).all(), name
        assert table.albedo(down) == 0, name
        assert np.isnan(table.sample(down, [0.5, 0.5])).all(), name


# Arrays.


def test_arrays_are_broadcast():
    table = bsdf.read(MATRIX).tables[0]
    rng = np.random.default_rng(4)
    wi, wo = np.abs(rng.normal(size=(5, 1, 3))), np.abs(rng.normal(size=(7, 3)))
    found = table.evaluate(wi, wo)
    assert found.shape == (5, 7)
    one_by_one = [[table.evaluate(a, b) for b in wo] for a in wi[:, 0]]
    np.testing.assert_array_equal(found, one_by_one)
    assert table.evaluate(wi, wo, rgb=True).shape == (5, 7, 3)
    assert table.evaluate(wi[0, 0], wo).shape == (7,)
    assert table.evaluate(wi, wo[:1]).shape == (5, 1)
    assert isinstance(table.evaluate(wi[0, 0], wo[0]), np.float64)
    assert table.sample(wi, rng.random((1, 4, 2))).shape == (5, 4, 3)
    assert table.sample(wi[0, 0], rng.random((2, 3, 2))).shape == (2, 3, 3)
    assert table.albedo(wi, rgb=True).shape == (5, 1, 3)
    for shape in ((0,), (3, 0)):
        empty = np.empty((*shape, 3))
        assert table.evaluate(empty, wo[0]).shape == shape
        assert table.evaluate([0, 0, 1], empty, rgb=True).shape == (*shape, 3)
        assert table.albedo(empty).shape == shape
        assert table.sample([0, 0, 1], np.empty((*shape, 2))).shape == (*shape, 3)
    assert table.evaluate(np.empty((0, 1, 3)), wo).shape == (0, 7)


def test_arrays_may_have_any_layout_type_and_length():
    table = bsdf.read(MATRIX).tables[0]
    wide = np.abs(np.random.default_rng(5).normal(size=(6, 8)))
    expected = table.evaluate(wide[:, :3].copy(), wide[:, 4:7].copy())
    np.testing.assert_array_equal(table.evaluate(wide[:, :3], wide[:, 4:7]), expected)
    np.testing.assert_array_equal(
        table.evaluate(wide[::-1, :3], np.asfortranarray(wide[::-1, 4:7])), expected[::-1]
    )
    np.testing.assert_array_equal(table.evaluate(1e200 * wide[:, :3], wide[:, 4:7]), expected)
    single = wide[:, :3].astype(np.float32)
    assert table.evaluate(single, [0, 0, 1]).dtype == np.float64
    none = [[0, 0, 0], [np.nan, 0, 1], [0, 0, np.inf]]
    assert np.isnan(table.evaluate(none, [0, 0, 1])).all()
    assert np.isnan(table.evaluate([0, 0, 1], none, rgb=True)).all()
    assert np.isnan(table.albedo(none)).all()
    assert np.isnan(table.pdf(none, none)).all()
    assert np.isnan(table.sample(none, [0.5, 0.5])).all()
    assert np.isnan(table.invert(none, [0, 0, 1])).all()


def test_what_is_no_array_is_refused():
    table = bsdf.read(MATRIX).tables[0]
    up = [0, 0, 1]
    with pytest.raises(ValueError, match=r"wi has the shape \(2,\); expected \(\.\.\., 3\)"):
        table.albedo([1, 2])
    with pytest.raises(ValueError, match=r"wo has the shape \(\); expected \(\.\.\., 3\)"):
        table.evaluate(up, 1)
    with pytest.raises(ValueError, match="wi and wo have the shapes .* that broadcast together"):
        table.evaluate(np.ones((2, 3)), np.ones((3, 3)))
    with pytest.raises(ValueError, match="wi and u have the shapes"):
        table.sample(np.ones((2, 3)), np.full((3, 2), 0.5))
    with pytest.raises(ValueError, match="expected coordinates of the unit square"):
        table.sample(up, [0.5, 1.5])
    with pytest.raises(TypeError, match="wi has the type complex128; expected real numbers"):
        table.albedo(np.ones(3, complex))


def test_angles_make_directions():
    found = bsdf.direction(theta_deg=[[0], [90]], phi_deg=[0, 90])
    expected = [[[0, 0, 1], [0, 0, 1]], [[1, 0, 0], [0, 1, 0]]]
    np.testing.assert_allclose(found, expected, atol=1e-15)
    assert bsdf.direction(theta_deg=30).shape == (3,)
    assert bsdf.direction(theta_deg=np.empty((0, 2)), phi_deg=[1, 2]).shape == (0, 2, 3)
    assert np.isnan(bsdf.direction(theta_deg=[np.nan, 1], phi_deg=[0, np.inf])).all()
    with pytest.raises(
        ValueError, match=r"theta_deg and phi_deg have the shapes \(2,\) and \(3,\)"
    ):
        bsdf.direction(theta_deg=[1, 2], phi_deg=[1, 2, 3])
