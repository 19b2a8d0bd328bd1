"""What `quasilux.qmc` has beside sequences: measures, designs, distributions, the module itself."""

from __future__ import annotations

import inspect
import math
import subprocess
import sys
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from quasilux import qmc as package

# Some tests give what the types forbid.
qmc: Any = package
scipy_stats = pytest.importorskip("scipy.stats")
scipy_qmc = scipy_stats.qmc

METHODS = ["CD", "WD", "MD", "L2-star"]


def sample_of(seed, n, d):
    points = np.random.default_rng(seed).random((n, d))
    # Coordinates at the ends and equal ones.
    points[points < 0.05], points[points > 0.95] = 0.0, 1.0
    return points


@settings(deadline=None, max_examples=100)
@given(
    seed=st.integers(0, 2**32),
    n=st.integers(1, 40),
    d=st.integers(1, 12),
    method=st.sampled_from(METHODS),
    iterative=st.booleans(),
)
def test_discrepancies_are_scipys(seed, n, d, method, iterative):
    points = sample_of(seed, n, d)
    ours, scipys = (
        module.discrepancy(points, method=method, iterative=iterative)
        for module in (qmc, scipy_qmc)
    )
    assert ours == pytest.approx(scipys, rel=1e-9, abs=1e-7 if method == "L2-star" else 1e-12)


def test_discrepancies_do_not_depend_on_threads():
    points = sample_of(1, 3000, 4)
    for method in METHODS:
        values = {qmc.discrepancy(points, method=method, workers=k) for k in (1, 2, 3, 100, -1)}
        assert len(values) == 1
        assert values.pop() == pytest.approx(scipy_qmc.discrepancy(points, method=method), rel=1e-9)


@settings(deadline=None, max_examples=50)
@given(seed=st.integers(0, 2**32), n=st.integers(2, 30), d=st.integers(1, 8))
def test_updates_are_the_discrepancy_of_all_points(seed, n, d):
    points = sample_of(seed, n, d)
    start = qmc.discrepancy(points[:-1], iterative=True)
    updated = qmc.update_discrepancy(points[-1], points[:-1], start)
    assert updated == pytest.approx(qmc.discrepancy(points), rel=1e-9, abs=1e-13)
    assert updated == pytest.approx(
        scipy_qmc.update_discrepancy(points[-1], points[:-1], start), rel=1e-9, abs=1e-13
    )


def test_any_layout_of_a_sample_will_do():
    points = sample_of(2, 20, 3)
    expected = qmc.discrepancy(points)
    for same in (np.asfortranarray(points), points.tolist(), np.repeat(points, 2, axis=0)[::2]):
        assert qmc.discrepancy(same) == expected
    assert qmc.discrepancy(np.array([[0, 1], [1, 0]])) == scipy_qmc.discrepancy([[0, 1], [1, 0]])


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: qmc.discrepancy([0.5]), "not a 2D array"),
        (lambda: qmc.discrepancy([[1.5]]), "not in unit hypercube"),
        (lambda: qmc.discrepancy([[math.nan]]), "not in unit hypercube"),
        (lambda: qmc.discrepancy([[0.5]], method="cd"), "'cd' is not a valid method"),
        (lambda: qmc.discrepancy([[0.5]], workers=0), "number of workers"),
        (lambda: qmc.discrepancy(np.empty((0, 2))), "at least one point"),
        (lambda: qmc.discrepancy(np.empty((2, 0))), "at least one point"),
        (lambda: qmc.update_discrepancy([0.5], [[0.5, 0.5]], 0.1), "broadcastable"),
        (lambda: qmc.update_discrepancy([2.0], [[0.5]], 0.1), "x_new is not in unit"),
        (lambda: qmc.geometric_discrepancy([[0.5]]), "at least two points"),
        (lambda: qmc.geometric_discrepancy([[0.5], [1]], method="max"), "not a valid method"),
        (lambda: qmc.geometric_discrepancy([[0.5], [1]], metric="none"), "Unknown"),
        (lambda: qmc.scale([[0.5]], 1, 1), "not consistent"),
        (lambda: qmc.scale([[math.nan]], 0, 1), "not in unit hypercube"),
        (lambda: qmc.scale([[3.0]], 0, 1, reverse=True), "out of bounds"),
        (lambda: qmc.scale([[0.5, 0.5]], [0, 0, 0], 1), "broadcastable"),
    ],
)
def test_bad_samples_are_refused(call, message):
    with pytest.raises(ValueError, match=message):
        call()


METRICS = ["euclidean", "sqeuclidean", "cityblock", "chebyshev", "canberra", "seuclidean"]


@pytest.mark.parametrize("metric", [*METRICS, lambda x, y: abs(x[0] - y[0]) + 0.1])
@pytest.mark.parametrize("method", ["mindist", "mst"])
def test_distances_are_scipys(metric, method):
    points = np.random.default_rng(3).random((60, 3))
    ours, scipys = (
        module.geometric_discrepancy(points, method=method, metric=metric)
        for module in (qmc, scipy_qmc)
    )
    assert ours == pytest.approx(scipys, rel=1e-12)


def test_duplicates_are_told():
    with pytest.warns(UserWarning, match="duplicate") as caught:
        assert qmc.geometric_discrepancy([[0.0], [0.5], [0.5], [0.75]]) == 0.25
    assert caught[0].filename == __file__
    with pytest.warns(UserWarning, match="duplicate"):
        assert qmc.geometric_discrepancy([[0.0], [0.0], [0.5]], method="mst") == 0.25
    with pytest.warns(UserWarning, match="duplicate"):
        assert qmc.geometric_discrepancy([[0.5], [0.5]]) == 0.0


@settings(deadline=None, max_examples=40)
@given(
    seed=st.integers(0, 2**32),
    n=st.integers(0, 40),
    d=st.integers(0, 6),
    scramble=st.booleans(),
    kind=st.sampled_from(["rng", "seed", "generator"]),
)
def test_latin_hypercubes_are_scipys(seed, n, d, scramble, kind):
    samples = []
    for module in (qmc, scipy_qmc):
        given = np.random.default_rng(seed) if kind == "generator" else seed
        keyword = {"seed" if kind == "seed" else "rng": given}
        engine = module.LatinHypercube(d, scramble=scramble, **keyword)
        with np.errstate(divide="ignore", invalid="ignore"):
            samples.append(np.concatenate([engine.random(n), engine.random(n + 1)]))
    np.testing.assert_array_equal(*samples, strict=True)


@pytest.mark.parametrize("p", [2, 3, 5, 7, 11])
@pytest.mark.parametrize("scramble", [True, False])
def test_orthogonal_arrays_are_scipys(p, scramble):
    for d in {1, 2, p, p + 1}:
        samples = [
            module.LatinHypercube(d, strength=2, scramble=scramble, rng=p).random(p * p)
            for module in (qmc, scipy_qmc)
        ]
        np.testing.assert_allclose(*samples, rtol=0, atol=1e-15)


@pytest.mark.parametrize("n", [0, 1, 2, 8, 16, 24, 81])
def test_orthogonal_arrays_need_squares_of_primes(n):
    with pytest.raises(ValueError, match="not the square of a prime number"):
        qmc.LatinHypercube(1, strength=2).random(n)


@pytest.mark.parametrize("d", [1, 2, 3, 5])
@pytest.mark.parametrize("hypersphere", ["volume", "surface"])
def test_disks_keep_their_distance_and_fill_the_box(d, hypersphere):
    radius = {1: 0.02, 2: 0.1, 3: 0.3, 5: 0.6}[d]
    engine = qmc.PoissonDisk(d, radius=radius, hypersphere=hypersphere, ncandidates=100, rng=d)
    some = engine.random(5)
    rest = engine.fill_space()
    assert len(engine.random(5)) == 0, "the box is full"
    points = np.concatenate([some, rest])
    assert engine.num_generated == len(points) and np.all((points >= 0) & (points <= 1))
    assert qmc.geometric_discrepancy(points) >= radius
    if d < 3:
        probes = np.random.default_rng(d).random((2000, d))
        nearest = np.sqrt(((probes[:, None] - points) ** 2).sum(axis=2)).min(axis=1)
        assert np.mean(nearest < radius) > 0.98, "hardly a place is free"


def test_disks_need_a_radius():
    for radius in (0, -1.0, math.nan):
        with pytest.raises(ValueError, match="radius must be positive"):
            qmc.PoissonDisk(2, radius=radius)


def test_optimizations_even_out_and_keep_their_input():
    for optimization in ("random-cd", "RANDOM-CD"):
        engine = qmc.LatinHypercube(3, optimization=optimization, rng=5)
        plain, better = qmc.LatinHypercube(3, rng=5).random(40), engine.random(40)
        assert qmc.discrepancy(better) < 0.9 * qmc.discrepancy(plain)
        np.testing.assert_array_equal(np.sort(better, axis=0), np.sort(plain, axis=0))
        np.testing.assert_array_equal(engine.reset().random(40), better)
    engine = qmc.Halton(2, optimization="lloyd", rng=5)
    plain, better = qmc.Halton(2, rng=5).random(64), engine.random(64)
    assert qmc.geometric_discrepancy(better) > qmc.geometric_discrepancy(plain)


@pytest.mark.parametrize("inv_transform", [True, False])
@pytest.mark.parametrize("d", [1, 2, 3])
def test_normal_numbers_are_scipys_from_equal_points(d, inv_transform):
    even = d if inv_transform else 2 * math.ceil(d / 2)
    root = np.random.default_rng(4).random((d, d)) + np.eye(d)
    mean, cov = np.arange(d), root.T @ root
    samples = []
    for module in (qmc, scipy_qmc):
        engine = module.Sobol(even, scramble=False, bits=40)
        engine.random(1)
        dist = module.MultivariateNormalQMC(mean, cov, engine=engine, inv_transform=inv_transform)
        samples.append(dist.random(2000))
    np.testing.assert_allclose(*samples, rtol=1e-12, atol=1e-12)
    first = qmc.Sobol(even, scramble=False)
    numbers = qmc.MultivariateNormalQMC(mean, cov, engine=first, inv_transform=inv_transform)
    assert np.all(np.isfinite(numbers.random(1))), "also of the origin"


def test_normal_numbers_with_a_root():
    root = np.array([[2.0, 1.0], [0.0, 1.0]])
    by_root = qmc.MultivariateNormalQMC([0, 1], cov_root=root, rng=1).random(2**14)
    np.testing.assert_allclose(np.cov(by_root.T), root.T @ root, atol=0.02)
    with pytest.raises(ValueError, match="Dimension mismatch"):
        qmc.MultivariateNormalQMC([0, 1, 2], cov_root=root)


def test_counts_are_scipys_from_equal_points():
    # No sum of them is a coordinate: on a border SciPy takes the one side or the other.
    pvals = [0.11, 0.0, 0.42, 0.27, 0.2]
    samples = [
        module.MultinomialQMC(pvals, 64, engine=module.Sobol(1, scramble=False)).random(10)
        for module in (qmc, scipy_qmc)
    ]
    np.testing.assert_array_equal(*samples, strict=True)
    assert np.all(samples[0].sum(axis=1) == 64)
    halves = qmc.MultinomialQMC([0.5, 0.5], 8, engine=qmc.Sobol(1, scramble=False))
    np.testing.assert_array_equal(halves.random(2), [[4, 4], [4, 4]])


def test_engines_of_scipy_serve_ours():
    for d, make in [
        (2, lambda engine: qmc.MultivariateNormalQMC([0, 0], engine=engine)),
        (1, lambda engine: qmc.MultinomialQMC([0.5, 0.5], 4, engine=engine)),
    ]:
        assert make(scipy_qmc.Halton(d, rng=1)).random(3).shape == (3, 2)


@pytest.mark.parametrize(
    "make",
    [
        lambda: qmc.Sobol(2, rng=1),
        lambda: qmc.Halton(2, rng=1),
        lambda: qmc.Faure4(2, rng=1),
        lambda: qmc.Hammersley(2, 512, rng=1),
        lambda: qmc.Independent(2, rng=1),
        lambda: qmc.LatinHypercube(2, rng=1),
    ],
)
def test_our_engines_serve_scipy(make):
    engine = make()
    assert isinstance(engine, scipy_qmc.QMCEngine)
    quad = pytest.importorskip("scipy.integrate").qmc_quad
    result = quad(lambda x: x[0] * x[1], [0, 0], [1, 2], qrng=engine, n_points=512)
    assert abs(result.integral - 1.0) < max(6 * result.standard_error, 1e-3)


@pytest.mark.parametrize("kind", [qmc.Sobol, qmc.Halton])
def test_scipy_makes_more_engines_of_the_same_randomization(kind):
    for name, expected in [("owen", "owen"), ("shift", "shift"), ("none", None), (None, None)]:
        engine = kind(2, rng=1, randomization=name)
        assert engine._init_quad["randomization"] == expected
        kind(rng=2, **engine._init_quad)


def test_every_name_of_scipy_is_here():
    assert set(scipy_qmc.__all__) <= set(qmc.__all__)
    for name in scipy_qmc.__all__:
        ours, theirs = (getattr(module, name) for module in (qmc, scipy_qmc))
        expected = inspect.signature(theirs).parameters
        found = inspect.signature(ours).parameters
        for parameter in expected.values():
            assert parameter.name in found, (name, parameter.name)
            if parameter.name != "seed":
                twin = found[parameter.name]
                assert (twin.kind, twin.default) == (parameter.kind, parameter.default), twin
        if inspect.isclass(theirs):
            methods = {method for method in vars(theirs) if not method.startswith("_")}
            assert methods <= set(dir(ours)), name
    with pytest.raises(AttributeError, match="quasilux.qmc.*van_der_corput"):
        qmc.van_der_corput  # noqa: B018


def test_scipy_is_not_imported():
    program = """
import sys
from quasilux import qmc
qmc.Sobol(3).random(8), qmc.Halton(3).random(8), qmc.LatinHypercube(3).random(8)
qmc.PoissonDisk(2, optimization="random-cd").random(8)
qmc.MultivariateNormalQMC([0, 0]).random(8), qmc.MultinomialQMC([0.5, 0.5], 8).random(8)
points = qmc.scale(qmc.Faure4(2).random(8), 0, 1)
qmc.discrepancy(points), qmc.geometric_discrepancy(points, method="mst")
assert not [name for name in sys.modules if name.partition(".")[0] == "scipy"]
sys.modules["scipy"] = None
try:
    qmc.geometric_discrepancy(points, metric="canberra")
except ImportError as error:
    assert "needs SciPy: pip install scipy" in str(error)
try:
    qmc.Sobol(2, optimization="lloyd").random(8)
except ImportError as error:
    print(error)
"""
    done = subprocess.run(
        [sys.executable, "-c", program], check=True, capture_output=True, text=True
    )
    assert done.stdout.strip() == 'optimization="lloyd" needs SciPy: pip install scipy'
