"""What `quasilux.bsdf` reads, computes and draws."""

from __future__ import annotations

import copy
import doctest
import importlib
import io
import json
import os
import pickle
import pkgutil
import subprocess
import sys
import xml.etree.ElementTree
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from quasilux import InputError, bsdf

ROOT = Path(os.environ.get("QUASILUX_ROOT") or Path(__file__).resolve().parents[3])
CORPUS = ROOT.parent / "shared/data/bsdf"

KINDS: list[Any] = [
    (side, mode) for side in ("front", "back") for mode in ("reflection", "transmission")
]
WEIGHTS = np.array([0.2126, 0.7152, 0.0722])

# A cap up to 30 degrees, and four patches.
BASIS = (
    "<AngleBasis><AngleBasisName>five</AngleBasisName><AngleBasisBlock><ThetaBounds>"
    "<LowerTheta>0</LowerTheta><UpperTheta>30</UpperTheta></ThetaBounds><nPhis>1</nPhis>"
    "</AngleBasisBlock><AngleBasisBlock><ThetaBounds><LowerTheta>30</LowerTheta><UpperTheta>90"
    "</UpperTheta></ThetaBounds><nPhis>4</nPhis></AngleBasisBlock></AngleBasis>"
)
FIVE = np.arange(1, 26).reshape(5, 5) / 50


def window(blocks):
    """A WINDOW file of matrices over five patches, incident ones along columns."""
    data = "".join(
        "<WavelengthData><Wavelength>Visible</Wavelength><WavelengthDataBlock>"
        f"<WavelengthDataDirection>{name}</WavelengthDataDirection><ColumnAngleBasis>five"
        "</ColumnAngleBasis><RowAngleBasis>five</RowAngleBasis><ScatteringData>"
        f"{','.join(map(str, values.T.ravel()))}</ScatteringData></WavelengthDataBlock>"
        "</WavelengthData>"
        for name, values in blocks.items()
    )
    return (
        "<WindowElement><Optical><Layer><Material><Name>Blind &lt;1&gt;</Name><Thickness "
        'unit="Millimeter">2.5</Thickness></Material><DataDefinition><IncidentDataStructure>Columns'
        f"</IncidentDataStructure>{BASIS}</DataDefinition>{data}</Layer></Optical></WindowElement>"
    ).encode()


MATRIX = window({"Reflection Front": FIVE, "Transmission Front": FIVE[::-1]})
NARROW = (
    b"TypeSym AxiSymmetrical\nTypeColorModel BW\nsigma 1 0\nphi 1 0\ntheta 8 0 2 4 6 8 10 20 90\n"
    b"bw kbdf 1 def\n40 35 21 10 3 0.8 0.05 0.05\nenddef\n"
)


def merl(rgb):
    """A surface that scatters each colour evenly."""
    counts = np.array([6, 6, 12], dtype="<i4")
    scales = np.array([1.0, 1.15, 1.66]) / 1500
    values = np.repeat(np.array(rgb) / scales, counts.prod())
    return counts.tobytes() + values.astype("<f8").tobytes()


def astm():
    """Columns of three channels, from three polar angles."""
    lines = ["VARS theta_i,phi_i,theta_s,phi_s,R,G,B"]
    for theta_i in (0.0, 0.6, 1.2):
        for theta_s in (0.0, 0.5, 1.0, 1.5):
            for phi_s in np.linspace(0, np.pi, 5):
                f = 0.1 + 0.1 * theta_i + 0.05 * np.cos(phi_s) * theta_s
                lines.append(f"{theta_i},0,{theta_s},{phi_s},{f},{0.5 * f},{0.25 * f}")
    return "\n".join(lines).encode()


# Of rank 3: below each branch there are eight nodes, or as many values.
TREE = (
    "<WindowElement><Optical><Layer><DataDefinition><IncidentDataStructure>TensorTree3"
    "</IncidentDataStructure></DataDefinition><WavelengthData><Wavelength>Visible</Wavelength>"
    "<WavelengthDataBlock><WavelengthDataDirection>Reflection Front</WavelengthDataDirection>"
    "<AngleBasis>LBNL/Shirley-Chiu</AngleBasis><ScatteringData>"
    "{ {0.1} {0.3} {0.1 0.4 0.1 0.2 0.1 0.1 0.5 0.3} {0.05} {0.1} {0.3} {0.1} {0.2} }"
    "</ScatteringData>"
    "</WavelengthDataBlock></WavelengthData></Layer></Optical></WindowElement>"
).encode()

MADE = {
    "matrix.xml": MATRIX,
    "tree.xml": TREE,
    "narrow.ddr": NARROW,
    "narrow.ddt": NARROW,
    "narrow.txt": NARROW,
    "red.binary": merl([0.2, 0.1, 0.05]),
    "colour.astm": astm(),
}


def corpus() -> list[Path]:
    """Files of others, which the repository does not hold."""
    if os.environ.get("QUASILUX_CORPUS") == "none":
        pytest.skip("left out without the corpus: QUASILUX_CORPUS is none")
    files = sorted(file for file in CORPUS.glob("*") if file.is_file())
    assert files, f"{CORPUS} is missing; QUASILUX_CORPUS=none leaves out the tests that read it"
    return files


def surfaces():
    """Every made surface, by name."""
    return {name: bsdf.read(data, name=name) for name, data in MADE.items()}


def tables():
    return [(name, table) for name, surface in surfaces().items() for table in surface.tables]


def command_line(*words: str | Path, code: int = 0) -> bytes:
    """What the command line prints; it is another process, for it writes past `sys.stdout`."""
    command = [sys.executable, "-m", "quasilux._command_line", *map(str, words)]
    done = subprocess.run(command, capture_output=True, check=False)
    assert done.returncode == code, done.stderr.decode()
    return done.stdout


def close(found, expected, path="", rel=1e-12):
    """Whether two documents are the same but for the rounding of numbers."""
    if isinstance(expected, dict):
        assert found.keys() == expected.keys(), path
        for key in expected:
            close(found[key], expected[key], f"{path}.{key}", rel)
    elif isinstance(expected, list):
        assert len(found) == len(expected), path
        for index, (one, other) in enumerate(zip(found, expected)):
            close(one, other, f"{path}[{index}]", rel)
    elif isinstance(expected, float):
        assert found == pytest.approx(expected, rel=rel, abs=1e-12), path
    else:
        assert found == expected, path


def hemisphere(count=400):
    """Places and weights of solid angle: midpoints in the squared sine and the azimuth."""
    sin2 = (np.arange(count) + 0.5) / count
    phi = 2 * np.pi * (np.arange(2 * count) + 0.5) / (2 * count)
    sine, cosine = np.sqrt(sin2)[:, None], np.sqrt(1 - sin2)[:, None]
    parts = np.broadcast_arrays(sine * np.cos(phi), sine * np.sin(phi), cosine)
    directions = np.stack(parts, axis=-1).reshape(-1, 3)
    # Of projected solid angle all are equal.
    return directions, np.pi / len(directions)


# What a file says.


def test_all_figures_warnings_and_errors_are_those_of_the_command_line(tmp_path):
    for name, data in MADE.items():
        (tmp_path / name).write_bytes(data)
    files = [*sorted(tmp_path.iterdir()), *corpus()]
    document = json.loads(command_line("bsdf", "--json", *files, code=2))
    chosen = ["--incidence", "10", "--incidence", "45,200"]
    other = json.loads(command_line("bsdf", "--json", *chosen, *files, code=2))
    count = 0
    for file, entry, further in zip(files, document["files"], other["files"]):
        try:
            surface = bsdf.read(file)
        except InputError as error:
            found = {"line": error.line, "column": error.column, "message": error.message}
            assert entry["error"] == found
            assert str(error) == f"{file}:{error.line}:{error.column}: {error.message}"
            continue
        count += 1
        assert entry["error"] is None
        close(surface.to_dict(), entry["surface"], file.name)
        close(surface.to_dict(incidences_deg=[10, (45, 200)]), further["surface"], file.name)
        warnings = [
            {
                "rule": w.kind,
                "line": w.line,
                "column": w.column,
                "count": w.count,
                "message": w.message,
            }
            for w in surface.warnings
        ]
        assert warnings == entry["warnings"]
    assert count >= len(MADE) + 8


def test_facts_are_those_of_the_file():
    surface = bsdf.read(MATRIX, name="blind.xml")
    assert (surface.name, surface.manufacturer, surface.title) == ("Blind <1>", "", "Blind <1>")
    assert (surface.format, surface.thickness_m) == ("WINDOW XML, Klems", 0.0025)
    assert (surface.is_isotropic, surface.is_coloured) == (False, False)
    assert (surface.file, surface.data) == ("blind.xml", MATRIX)
    names = [(table.side, table.mode, table.kind) for table in surface.tables]
    assert names == [
        ("front", "reflection", "Klems"),
        ("front", "transmission", "Klems"),
        ("back", "transmission", "Klems"),
    ]
    with pytest.raises(LookupError, match="blind.xml has no back reflection; expected front refl"):
        surface.table("back", "reflection")
    assert surface.table("front") is surface.tables[0]
    kinds = {warning.kind for warning in surface.warnings}
    assert {"ByReciprocity", "NotReciprocal"} <= kinds
    wrong: list[Any] = [("top", "reflection"), ("front", "absorption")]
    for side, mode in wrong:
        with pytest.raises(ValueError, match="expected (front or back|reflection or transmission)"):
            surface.table(side, mode)
        with pytest.raises(ValueError, match="unknown (side|scattering mode)"):
            surface.albedo([0, 0, 1], side=side, mode=mode)


def test_names_tell_reflection_from_transmission():
    for name, mode in (("a.ddr", "reflection"), ("a.DDT", "transmission"), ("a", "reflection")):
        (table,) = bsdf.read(NARROW, name=name).tables
        assert (table.mode, table.kind, table.is_isotropic) == (mode, "gridded", True)
    assert "UnknownScatteringMode" in {w.kind for w in bsdf.read(NARROW).warnings}
    with pytest.raises(InputError, match=r"^a\.ddt:\d+:\d+: "):
        bsdf.read(NARROW, name="a.ddt", strict=True)


def test_sources_are_those_of_luminaires(tmp_path):
    path = tmp_path / "narrow.ddr"
    path.write_bytes(NARROW)
    with path.open("rb") as file:
        for source in (path, str(path), NARROW, bytearray(NARROW), io.BytesIO(NARROW), file):
            assert bsdf.read(source).data == NARROW
    with pytest.raises(FileNotFoundError):
        bsdf.read(tmp_path / "none.xml")
    number: Any = 3
    with pytest.raises(TypeError, match="expected a path, bytes or a file in binary mode"):
        bsdf.read(number)
    with pytest.raises(InputError, match="found an empty file; expected a measured surface") as e:
        bsdf.read(b"")
    assert (e.value.file, e.value.line, e.value.column) == ("<bytes>", 1, 1)


@pytest.mark.parametrize("name", MADE)
def test_surfaces_are_copied_and_pickled(name):
    surface = bsdf.read(MADE[name], name=name)
    for again in (copy.deepcopy(surface), pickle.loads(pickle.dumps(surface))):
        assert again.to_dict() == surface.to_dict()
        assert again.warnings == surface.warnings


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
    for file in corpus():
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


# Diagrams.


def test_diagrams_are_those_of_the_command_line(tmp_path):
    (tmp_path / "drawings").mkdir()
    for name, data in MADE.items():
        (tmp_path / name).write_bytes(data)
    files = [
        path for path in sorted(tmp_path.iterdir()) if path.suffix in (".xml", ".ddr", ".astm")
    ]
    files += [file for file in corpus() if file.stem.startswith(("klems", "tt"))]
    incidences = ["--incidence", "0", "--incidence", "45", "--incidence", "70,90"]
    command_line("bsdf", "--svg", tmp_path / "drawings", *incidences, *files)
    for file in files:
        drawing = (tmp_path / "drawings" / f"{file.stem}.svg").read_text(encoding="utf-8")
        assert bsdf.read(file).diagram([0, 45, (70, 90)]).to_svg() == drawing, file


@pytest.mark.parametrize("name", MADE)
def test_notebooks_show_facts_and_lobes(name):
    surface = bsdf.read(MADE[name], name=name)
    html = surface._repr_html_()
    xml.etree.ElementTree.fromstring(html)
    assert "most scattered" in html
    assert surface._repr_svg_() == surface.diagram().to_svg()
    png, size = surface._repr_png_()
    assert png.startswith(b"\x89PNG")
    assert set(size) == {"width", "height"}
    assert repr(surface).startswith(f"<Bsdf '{surface.title}': {surface.format}; front ")
    assert repr(surface.diagram(title="a")) == "<Diagram 'a'>"


@pytest.mark.parametrize(
    ("incidences", "message"),
    [
        ([], "expected 1 to 24"),
        (range(25), "expected 1 to 24"),
        ([90], "from 0 to below 90"),
        ([-1], "from 0 to below 90"),
        ([np.nan], "from 0 to below 90"),
        ([(30, 361)], "from 0 to below 90"),
        ([(30, 0, 0)], "expected degrees"),
    ],
)
def test_what_is_no_incidence_is_refused(incidences, message):
    surface = bsdf.read(NARROW, name="a.ddr")
    for method in (surface.diagram, lambda given: surface.to_dict(incidences_deg=given)):
        with pytest.raises(ValueError, match=message):
            method(incidences)


def test_lobes_are_plotted():
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    from matplotlib import pyplot

    surface = bsdf.read(MATRIX)
    ax = surface.plot(incidences_deg=[0, (60, 90)], color="k")
    first, second = ax.lines
    assert (first.get_label(), second.get_label()) == (
        "0\N{DEGREE SIGN}",
        "60\N{DEGREE SIGN}, 90\N{DEGREE SIGN}",
    )
    angle, value = map(np.asarray, first.get_data())
    # Up is the side of the light: angles are from the pole below.
    theta = np.pi - np.abs(angle)
    reflected = surface.evaluate([0, 0, 1], [0, 0, 1])
    assert value[np.argmin(theta)] == pytest.approx(reflected)
    assert value[np.argmax(theta)] == pytest.approx(
        surface.evaluate([0, 0, 1], [0, 0, 1], mode="transmission")
    )
    ax.figure.canvas.draw()
    wrong: Any = "top"
    with pytest.raises(ValueError, match="unknown side"):
        surface.plot(side=wrong)
    with pytest.raises(ValueError, match="not polar"):
        surface.plot(pyplot.figure().add_subplot())
    pyplot.close("all")


# Any bytes.

fuzz = settings(
    deadline=None,
    max_examples=50,
    database=None,
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large],
)


def read_any(data, name):
    try:
        surface = bsdf.read(data, name=name)
    except InputError as error:
        assert (error.line or 0) >= 1
        assert (error.column or 0) >= 1
        assert error.message
        return
    json.dumps(surface.to_dict(), allow_nan=False)
    assert repr(surface)
    wi = [[0, 0, 1], [0.9, 0.3, 0.1], [-0.2, 0.1, 0]]
    for table in surface.tables:
        assert np.isfinite(table.albedo(wi, rgb=True)).all()
        assert np.isfinite(table.evaluate(wi, wi, rgb=True)).all()
        assert np.isfinite(table.pdf(wi, wi)).all()
        wo = table.sample(wi, [0.3, 0.6])
        assert np.isfinite(wo[table.albedo(wi) > 0]).all()
    xml.etree.ElementTree.fromstring(surface.diagram([10]).to_svg())


@fuzz
@given(
    data=st.binary(max_size=300),
    head=st.sampled_from([b"", MATRIX[:400], NARROW[:60], b"VARS theta_i,phi_i,theta_s,phi_s,B\n"]),
    name=st.sampled_from(["a", "a.ddt", "a.xml"]),
)
def test_any_bytes_are_read_or_refused(data, head, name):
    read_any(head + data, name)


@fuzz
@given(data=st.data())
def test_mutated_files_are_read_or_refused(data):
    name = data.draw(st.sampled_from(sorted(MADE)))
    file = bytearray(MADE[name])
    for _ in range(data.draw(st.integers(1, 3))):
        place = data.draw(st.integers(0, len(file) - 1))
        match data.draw(st.integers(0, 3)):
            case 0:
                file[place] = data.draw(st.integers(0, 255))
            case 1:
                del file[place : place + data.draw(st.integers(1, 40))]
            case 2:
                word = st.sampled_from([b"0", b"-1", b"1e300", b"nan", b"9" * 20, b"<", b"{", b","])
                file[place:place] = data.draw(word)
            case _:
                del file[place:]
        if not file:
            break
    read_any(bytes(file), name)


# Documentation.


@pytest.mark.parametrize(
    "name",
    ["quasilux.bsdf"]
    + [f"quasilux.bsdf.{module.name}" for module in pkgutil.iter_modules(bsdf.__path__)],
)
def test_examples_are_true(name):
    assert doctest.testmod(importlib.import_module(name)).failed == 0


def test_everything_public_is_documented():
    for name in bsdf.__all__:
        thing = getattr(bsdf, name)
        assert thing.__doc__, name
        for member, value in vars(thing).items() if isinstance(thing, type) else ():
            if not member.startswith("_") and (callable(value) or isinstance(value, property)):
                assert value.__doc__, f"{name}.{member}"
