"""What `quasilux.photometry` reads, computes, writes and draws."""

from __future__ import annotations

import copy
import doctest
import gc
import importlib
import io
import json
import os
import pickle
import pkgutil
import subprocess
import sys
import threading
import warnings
import xml.etree.ElementTree
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st
from quasilux import InputError, photometry

ROOT = Path(os.environ.get("QUASILUX_ROOT") or Path(__file__).resolve().parents[3])
CORPUS = ROOT.parent / "shared/data"
BATWING = ROOT / "examples/office/batwing.ies"

HEAD = b"IESNA:LM-63-2002\n[TEST] made up\n[LUMINAIRE] Lamp <b>\n"
# Without symmetry, with a kink at each angle.
UNEVEN = HEAD + (
    b"TILT=NONE\n1 -1 1 5 4 1 2 0.3 0.6 0.1\n1 1 10\n0 20 60 110 180\n0 70 200 360\n"
    b"100 80 50 10 20\n100 20 90 0 20\n100 60 10 40 20\n100 80 50 10 20\n"
)
# A floodlight of type B, and a headlight of type A, both with four vertical angles.
TYPE_B, TYPE_A = (
    HEAD
    + f"TILT=NONE\n1 -1 1 4 3 {kind} 2 0 0 0\n1 1 10\n-90 0 20 90\n-90 10 90\n".encode()
    + b"1 40 20 2\n0 300 80 4\n0 50 60 6\n"
    for kind in (2, 3)
)

fuzz = settings(
    deadline=None,
    max_examples=60,
    database=None,
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large],
)


def corpus(*patterns: str) -> list[Path]:
    """Files of others, which the repository does not hold."""
    if os.environ.get("QUASILUX_CORPUS") == "none":
        pytest.skip("left out without the corpus: QUASILUX_CORPUS is none")
    files = sorted(file for pattern in patterns for file in CORPUS.glob(pattern) if file.is_file())
    assert files, f"{CORPUS} is missing; QUASILUX_CORPUS=none leaves out the tests that read it"
    return files


def luminaire_files() -> list[Path]:
    return corpus("ies/*.[iI][eE][sS]", "ldt/*.ldt", "ies/tm33/*.xml")


def command_line(*words: str | Path, code: int = 0) -> bytes:
    """What the command line prints; it is another process, for it writes past `sys.stdout`."""
    command = [sys.executable, "-m", "quasilux._command_line", *map(str, words)]
    done = subprocess.run(command, capture_output=True, check=False)
    assert done.returncode == code, done.stderr.decode()
    return done.stdout


def direction(c_deg, gamma_deg):
    """The frame's definition: gamma = 0 is -z, C0 is +x, C90 is +y."""
    c, gamma = np.radians(c_deg), np.radians(gamma_deg)
    sine = np.sin(gamma)
    parts = np.broadcast_arrays(sine * np.cos(c), sine * np.sin(c), -np.cos(gamma))
    return np.stack(parts, axis=-1)


def gauss(edges_deg, order=10):
    """Places in degrees and weights in radians, a rule of Gauss and Legendre for each interval."""
    x, w = np.polynomial.legendre.leggauss(order)
    low, high = edges_deg[:-1, None], edges_deg[1:, None]
    place = low + (high - low) * (x + 1) / 2
    return place.ravel(), np.radians((high - low) * w / 2).ravel()


def integral(lamp, low_deg=0.0, high_deg=180.0, c_range=(0.0, 360.0)):
    """Of intensities of type C over solid angle, between the kinks of the table."""
    grid = lamp.unfolded()
    inside = [g for g in grid.vertical_deg if low_deg < g < high_deg]
    gamma, w_gamma = gauss(np.array([low_deg, *inside, high_deg]))
    planes = [c for c in grid.horizontal_deg % 360 if c_range[0] < c < c_range[1]]
    c, w_c = gauss(np.array(sorted({c_range[0], *planes, c_range[1]})), 2)
    values = lamp.intensity_at(c_deg=c[:, None], gamma_deg=gamma)
    return w_c @ values @ (w_gamma * np.sin(np.radians(gamma)))


@pytest.fixture(scope="module")
def batwing():
    return photometry.read(BATWING)


# What a file says.


def test_facts_are_those_of_the_header(batwing):
    assert (batwing.format, batwing.standard, batwing.type) == ("LM-63", "LM-63-2002", "C")
    assert (batwing.symmetry, batwing.counts) == ("quadrant", "7 x 37")
    assert batwing.name.startswith("Linear suspended luminaire")
    assert (batwing.manufacturer, batwing.catalog_number) == ("quasilux examples", "BATWING-1200")
    assert batwing.keywords["TESTLAB"] == "none"
    assert list(batwing.keywords)[:2] == ["TEST", "TESTLAB"]
    assert batwing.facts.keywords[0].line == 2
    assert (batwing.facts.lamp_count, batwing.facts.lumens_per_lamp) == (1.0, 3000.0)
    assert (batwing.rated_flux_lm, batwing.facts.input_watts) == (3000.0, 24.0)
    assert batwing.luminous_shape == photometry.LuminousShape("rectangle", (1.2, 0.2, 0.0))
    assert batwing.warnings == ()
    assert (batwing.file, batwing.data) == (str(BATWING), BATWING.read_bytes())
    assert batwing.misnamed is None


def test_tables_are_those_of_the_file(batwing):
    numbers = BATWING.read_text().splitlines()
    start = numbers.index("TILT=NONE") + 3
    written = np.array(" ".join(numbers[start:]).split(), dtype=float)
    gamma, c, candela = np.split(written, [37, 44])
    np.testing.assert_array_equal(batwing.gamma_deg, gamma)
    np.testing.assert_array_equal(batwing.c_deg, c)
    np.testing.assert_array_equal(batwing.intensity_cd, candela.reshape(7, 37))
    for array in (
        batwing.c_deg,
        batwing.gamma_deg,
        batwing.intensity_cd,
        batwing.analysis.zones_lm,
    ):
        assert not array.flags.writeable
        with pytest.raises(ValueError, match="read-only"):
            array[...] = 0
    assert batwing.intensity_cd is batwing.intensity_cd


def test_unfolded_tables_mirror_the_measured_one(batwing):
    grid = batwing.unfolded()
    np.testing.assert_allclose(grid.horizontal_deg, np.arange(0, 361, 15), atol=1e-9)
    quarter = batwing.intensity_cd
    half = np.vstack([quarter, quarter[-2::-1]])
    np.testing.assert_array_equal(grid.intensity_cd, np.vstack([half, half[-2::-1]]))


def test_all_figures_warnings_and_errors_are_those_of_the_command_line():
    files = [*luminaire_files(), BATWING, Path(__file__)]
    document = json.loads(command_line("photometry", "--json", *files, code=2))
    assert len(document["files"]) == len(files)
    for file, entry in zip(files, document["files"]):
        try:
            lamp = photometry.read(file)
        except InputError as error:
            found = {"line": error.line, "column": error.column, "message": error.message}
            assert entry["error"] == found
            assert error.file == str(file)
            assert str(error) == f"{file}:{error.line}:{error.column}: {error.message}"
            continue
        assert entry["error"] is None
        assert lamp.to_dict() == entry["luminaire"]
        warnings = [
            {
                "rule": w.kind,
                "line": w.line,
                "column": w.column,
                "count": w.count,
                "message": w.message,
            }
            for w in lamp.warnings
        ]
        assert warnings == entry["warnings"]


def test_warnings_say_where():
    lamp = photometry.read(UNEVEN.replace(b"\n1 -1 1", b"\n1 -2 1"), name="lamp.ies")
    (warning,) = lamp.warnings
    assert (warning.line, warning.column, warning.kind) == (5, 3, "NegativeLumens")
    assert str(warning) == (
        "lamp.ies:5:3: found -2; expected -1 for absolute photometry (read as such) "
        "[NegativeLumens]"
    )


def test_strict_readers_refuse_what_is_odd_but_for_losses():
    odd = UNEVEN.replace(b"\n1 -1 1", b"\n1 -2 1")
    with pytest.raises(InputError, match=r"^lamp.ies:5:3: found -2") as caught:
        photometry.read(odd, name="lamp.ies", strict=True)
    assert (caught.value.file, caught.value.line, caught.value.column) == ("lamp.ies", 5, 3)
    lossy = UNEVEN.replace(b"\n1 -1 1", b"\n1 5000 1")
    lamp = photometry.read(lossy, strict=True)
    assert [warning.kind for warning in lamp.warnings] == ["FluxDiffers"]
    with pytest.raises(InputError, match="integrated flux"):
        photometry.read(UNEVEN.replace(b"\n1 -1 1", b"\n1 5 1"), strict=True)


# Sources.


def test_files_bytes_and_open_files_are_read_alike(tmp_path):
    path = tmp_path / "lamp.ies"
    path.write_bytes(UNEVEN)
    with path.open("rb") as buffered, path.open("rb", buffering=0) as raw:
        sources = [
            str(path), path, UNEVEN, bytearray(UNEVEN), memoryview(UNEVEN), io.BytesIO(UNEVEN),
            buffered, raw,
        ]  # fmt: skip
        for source in sources:
            assert photometry.read(source).data == UNEVEN
    assert photometry.read(UNEVEN).file == "<bytes>"
    assert photometry.read(io.BytesIO(UNEVEN)).file == "<file>"
    assert photometry.read(UNEVEN, name="a.ies").file == "a.ies"

    class Reluctant:
        """Gives a byte at a time, as a socket may."""

        def __init__(self):
            self.rest = UNEVEN

        def read(self, size):
            piece, self.rest = self.rest[:1], self.rest[1:]
            return piece

    assert photometry.read(Reluctant()).data == UNEVEN


def test_what_is_no_source_is_refused(tmp_path):
    with pytest.raises(FileNotFoundError):
        photometry.read(tmp_path / "none.ies")
    with pytest.raises(OSError):
        photometry.read(tmp_path)
    wrong: list[Any] = [12, None, [UNEVEN], io.StringIO("IESNA")]
    for source in wrong[:3]:
        with pytest.raises(TypeError, match="expected a path, bytes or a file in binary mode"):
            photometry.read(source)
    with pytest.raises(TypeError, match="text mode"):
        photometry.read(wrong[3])
    with pytest.raises(ValueError, match="expected a path, or bytes"):
        photometry.read(UNEVEN.decode())
    with pytest.raises(InputError, match="larger than 64 MiB"):
        photometry.read(bytes((64 << 20) + 1))


@pytest.mark.skipif(not os.path.exists("/dev/zero"), reason="no such device")
def test_files_without_an_end_are_read_to_a_bound():
    with pytest.raises(InputError, match=r"/dev/zero: the file is larger than 64 MiB"):
        photometry.read("/dev/zero")


def test_formats_are_told_by_content_name_or_the_user(tmp_path):
    path = tmp_path / "lamp.ldt"
    path.write_bytes(UNEVEN)
    lamp = photometry.read(path)
    assert (lamp.format, lamp.misnamed) == ("LM-63", "EULUMDAT")
    for format in ("LM-63", "ies"):
        assert photometry.read(UNEVEN, format=format).format == "LM-63"
    with pytest.raises(InputError) as caught:
        photometry.read(UNEVEN, format="ldt")
    assert caught.value.line is not None
    wrong: Any = "pdf"
    with pytest.raises(InputError, match="expected LM-63, EULUMDAT, TM-33"):
        photometry.read(UNEVEN, format=wrong)
    with pytest.raises(InputError, match=r"^<bytes>:1:1: found no line TILT="):
        photometry.read(b"nothing")


@pytest.mark.skipif(sys.platform != "linux", reason="names of files are bytes on Linux")
def test_names_may_hold_any_bytes(tmp_path):
    path = os.fsencode(tmp_path) + b"/lamp-\xff.ies"
    with open(path, "wb") as file:
        file.write(UNEVEN)
    lamp = photometry.read(os.fsdecode(path))
    assert str(lamp.file).endswith("lamp-?.ies")
    assert "lamp" in repr(lamp) or lamp.name


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


# Tilted lamps.

TILTED = HEAD + b"TILT=lamp.tlt\n1 1000 1 2 1 1 2 0 0 0\n1 1 10\n0 90\n0\n100 0\n"
FACTORS = b"1\n3\n0 45 90\n1 0.9 0.8\n"


def test_tilt_files_are_read_beside_the_luminaire(tmp_path):
    path = tmp_path / "lamp.ies"
    path.write_bytes(TILTED)
    lamp = photometry.read(path)
    (warning,) = (w for w in lamp.warnings if w.kind == "TiltFile")
    assert "cannot read the tilt file" in warning.message
    assert "No such file" in warning.message
    assert (warning.line, lamp.facts.tilt_file, lamp.facts.tilt) == (4, "lamp.tlt", None)
    assert lamp.tilt_factor([0, 0, -1]).support == "not read"
    (tmp_path / "lamp.tlt").write_bytes(FACTORS)
    lamp = photometry.read(path)
    assert [w.kind for w in lamp.warnings] == ["FluxDiffers"]
    assert lamp.facts.tilt is not None
    assert lamp.facts.tilt.lamp_geometry == 1
    np.testing.assert_array_equal(lamp.facts.tilt.angles_deg, [0, 45, 90])
    half = np.sqrt(0.5)
    found = lamp.tilt_factor([half, 0, -half])
    assert found.factor == pytest.approx(0.9)
    assert (found.angle_deg, found.support) == (pytest.approx(45), "listed")
    assert lamp.tilt_factor([0, 2, -2]).factor == pytest.approx(0.9)
    assert pickle.loads(pickle.dumps(lamp)).tilt_factor([1, 0, -1]).factor == pytest.approx(0.9)
    (tmp_path / "lamp.tlt").write_bytes(FACTORS.replace(b"0.8", b"x"))
    with pytest.raises(InputError, match=r"lamp.tlt:4:7: found \"x\""):
        photometry.read(path)
    (tmp_path / "lamp.tlt").unlink()
    (tmp_path / "lamp.tlt").mkdir()
    assert "no regular file" in str(photometry.read(path).warnings)


def test_tilt_files_may_be_given():
    for tilt in (FACTORS, io.BytesIO(FACTORS)):
        lamp = photometry.read(TILTED, tilt=tilt)
        assert lamp.tilt_factor([1, 0, 0]).factor == pytest.approx(0.8)
    assert photometry.read(TILTED).tilt_factor([1, 0, 0]).factor == 1.0
    odd = photometry.read(TILTED, tilt=FACTORS.replace(b"0 45 90", b"5 45 80"))
    assert ("<bytes>", "TiltFactors") in [(w.file, w.kind) for w in odd.warnings]
    assert odd.tilt_factor([0, 0, -1]).support == "end held"
    for down in ([0, 0, 0], [np.nan, 0, 1]):
        with pytest.raises(ValueError, match="no direction"):
            odd.tilt_factor(down)
    with pytest.raises(ValueError, match=r"expected \(3,\)"):
        odd.tilt_factor([[0, 0, 1]])


# Writing.


def test_written_files_read_back_to_the_same_table():
    count = 0
    for file in [BATWING, *luminaire_files()]:
        try:
            lamp = photometry.read(file)
        except InputError:
            continue
        count += 1
        for data in (lamp.to_ies(), lamp.to_ldt()):
            again = photometry.read(data)
            if lamp.type != "C":
                continue
            ways = np.random.default_rng(5).normal(size=(500, 3))
            # Where a plane was dropped that differs from the first one, the flux moves.
            if any(note.kind == "ClosingPlaneDropped" for note in data.notes):
                continue
            np.testing.assert_allclose(
                again.intensity(ways), lamp.intensity(ways), rtol=1e-9, atol=1e-9 * lamp.maximum_cd
            )
            assert again.flux_lm == pytest.approx(lamp.flux_lm, rel=1e-9)
            if data.startswith(b"IES"):
                assert again.luminous_shape.name == lamp.luminous_shape.name
                assert again.facts.input_watts == lamp.facts.input_watts
    assert count > 100


def test_conversions_are_those_of_the_command_line(tmp_path):
    files = [BATWING, *luminaire_files()[::12]]
    for number, file in enumerate(files):
        try:
            lamp = photometry.read(file)
        except InputError:
            continue
        for ending, data in ((".ies", lamp.to_ies()), (".ldt", lamp.to_ldt())):
            path = tmp_path / f"{number}{ending}"
            command_line("photometry", "--convert", path, file)
            assert path.read_bytes() == data


def test_notes_say_what_a_format_cannot_hold(batwing):
    assert batwing.to_ies().notes == ()
    data = batwing.to_ldt()
    assert bytes in type(data).mro()
    assert [note.kind for note in data.notes] == ["KeywordsLeftOut", "TextCut"]
    assert str(data.notes[1]) == "the type of lamps (field 26b) was cut to 24 characters"
    resampled = photometry.read(TYPE_B).to_ldt()
    assert "photometric type B was resampled" in str(resampled.notes[0])
    assert resampled.notes[0].kind == "Resampled"
    assert pickle.loads(pickle.dumps(data)).notes == data.notes
    assert "notes" in repr(data)


def test_editions_are_as_asked_for(batwing):
    for year, first in (
        ("1991", b"IESNA91"),
        ("1995", b"IESNA:LM-63-1995"),
        ("2019", b"IES:LM-63-2019"),
    ):
        data = batwing.to_ies(edition=f"LM-63-{year}")
        assert data.splitlines()[0] == first
        assert photometry.read(data).standard == f"LM-63-{year}"
    assert (
        photometry.read(batwing.to_ies(edition="LM-63-2019")).to_ies().startswith(b"IES:LM-63-2019")
    )
    with pytest.raises(InputError, match="unknown edition of LM-63"):
        batwing.to_ies(edition="2002")


def test_files_are_saved_whole_and_measurements_are_kept(batwing, tmp_path):
    path = tmp_path / "lamp.ies"
    assert batwing.save(path) == ()
    assert path.read_bytes() == batwing.to_ies()
    assert [note.kind for note in batwing.save(str(tmp_path / "lamp.LDT"))] == [
        "KeywordsLeftOut",
        "TextCut",
    ]
    assert sorted(file.name for file in tmp_path.iterdir()) == ["lamp.LDT", "lamp.ies"]
    link = tmp_path / "link.ies"
    link.symlink_to("lamp.ies")
    path.write_bytes(b"old")
    batwing.save(link, edition="LM-63-1995")
    assert link.is_symlink()
    assert path.read_bytes() == batwing.to_ies(edition="LM-63-1995")
    own = photometry.read(path)
    for same in (path, link, tmp_path / "." / "lamp.ies"):
        with pytest.raises(InputError, match="would replace the measured file") as caught:
            own.save(same)
        assert caught.value.file == str(path)
    for name in ("lamp.txt", "lamp", "lamp.xml"):
        with pytest.raises(ValueError, match=r"expected \.ies or \.ldt"):
            batwing.save(tmp_path / name)
    with pytest.raises(ValueError, match="EULUMDAT"):
        batwing.save(tmp_path / "a.ldt", edition="LM-63-1995")
    with pytest.raises(FileNotFoundError):
        batwing.save(tmp_path / "none" / "lamp.ies")
    (tmp_path / "folder.ies").mkdir()
    with pytest.raises(OSError):
        batwing.save(tmp_path / "folder.ies")
    assert len(list(tmp_path.iterdir())) == 4


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="no such device")
def test_devices_keep_their_place(tmp_path, batwing):
    link = tmp_path / "full.ies"
    link.symlink_to("/dev/full")
    with pytest.raises(OSError, match="No space left"):
        batwing.save(link)
    assert os.path.exists("/dev/full") and not os.path.isfile("/dev/full")


# Own luminaires.


def test_own_luminaires_have_the_flux_of_their_closed_form():
    isotropic = photometry.from_intensities(0, [0, 180], [100, 100])
    assert isotropic.flux_lm == pytest.approx(400 * np.pi, rel=1e-14)
    gamma = np.linspace(0, 90, 181)
    lambert = photometry.from_intensities(0, gamma, 100 * np.cos(np.radians(gamma)))
    assert lambert.flux_lm == pytest.approx(100 * np.pi, rel=5e-5)
    assert (lambert.symmetry, lambert.format, lambert.file, lambert.data) == (
        "rotational", None, None, None,
    )  # fmt: skip


@pytest.mark.parametrize(
    ("c_deg", "symmetry"),
    [
        (0, "rotational"),
        ([0], "rotational"),
        ([0, 20, 90], "quadrant"),
        ([90, 120, 180], "quadrant"),
        ([0, 20, 180], "bilateral"),
        ([90, 100, 270], "bilateral"),
        ([-90, 0, 90], "bilateral"),
        ([0, 20, 360], "none"),
        ([15, 100, 375], "none"),
        (np.arange(0, 360, 30), "none"),
        (np.linspace(0, 90, 7), "quadrant"),
    ],
)
def test_planes_of_own_luminaires_mean_what_they_mean_in_files(c_deg, symmetry):
    gamma = np.array([0, 35, 60, 90])
    planes = np.atleast_1d(c_deg)
    table = np.random.default_rng(6).random((planes.size, 4)) * 100
    table[:, 0] = 50
    if planes.size > 1 and planes[-1] - planes[0] == 360:
        table[-1] = table[0]
    lamp = photometry.from_intensities(c_deg, gamma, table, lumens_per_lamp=700)
    assert lamp.symmetry == symmetry
    np.testing.assert_array_equal(lamp.intensity_cd, table)
    np.testing.assert_allclose(lamp.c_deg, planes, atol=1e-9)
    np.testing.assert_array_equal(lamp.gamma_deg, gamma)
    at_nodes = lamp.intensity_at(c_deg=planes[:, None], gamma_deg=gamma)
    np.testing.assert_allclose(at_nodes, table, rtol=1e-12)
    if symmetry == "bilateral":
        mirrored = lamp.intensity_at(c_deg=2 * planes[0] - planes[:, None], gamma_deg=gamma)
        np.testing.assert_allclose(mirrored, table, rtol=1e-10)
    assert lamp.flux_lm == pytest.approx(integral(lamp, 0, 90), rel=1e-9)
    for data in (lamp.to_ies(), lamp.to_ldt()):
        again = photometry.read(data)
        assert again.flux_lm == pytest.approx(lamp.flux_lm, rel=1e-12)
        assert again.symmetry == symmetry
        ways = direction(np.linspace(0, 720, 50), np.linspace(1, 89, 50))
        np.testing.assert_allclose(again.intensity(ways), lamp.intensity(ways), rtol=1e-9)


def test_facts_of_own_luminaires_are_written_and_read_back():
    lamp = photometry.from_intensities(
        0,
        [0, 90],
        [300, 10],
        name="Name",
        manufacturer="Maker",
        catalog_number="N 1",
        lamp="LED\nwarm",
        keywords={"TESTLAB": "own", "_NOTE-2": "x"},
        lamp_count=2,
        lumens_per_lamp=450.5,
        input_watts=9.5,
        luminous_shape="cylinder",
        luminous_size_m=(0.2, 0.3, 0.05),
    )
    again = photometry.read(lamp.to_ies())
    for found in (lamp, again):
        assert (found.name, found.manufacturer, found.catalog_number) == ("Name", "Maker", "N 1")
        assert found.keywords["LAMP"] == "LED\nwarm"
        assert found.keywords["TESTLAB"] == "own"
        assert found.keywords["_NOTE-2"] == "x"
        assert (found.rated_flux_lm, found.facts.input_watts) == (901, 9.5)
        assert found.luminous_shape.name == "vertical elliptical cylinder"
        assert found.luminous_shape.size_m == pytest.approx((0.2, 0.3, 0.05))
    assert "name" in photometry.from_intensities(0, [0, 9], [1, 1], name="a name").title
    assert photometry.from_intensities(0, [0, 9], [1, 1]).title == "luminaire"


@pytest.mark.parametrize(
    ("shape", "size_m", "name"),
    [
        ("box", (0, 0, 0), "point"),
        ("box", (1, 0, 0), "line"),
        ("box", (1, 0.5, 0), "rectangle"),
        ("box", (1, 0.5, 0.1), "box"),
        ("cylinder", (0.5, 0.5, 0), "disk"),
        ("cylinder", (0.5, 0.3, 0), "ellipse"),
        ("cylinder along x", (1, 0.1, 0.1), "horizontal cylinder"),
        ("cylinder along y", (0.1, 1, 0.1), "horizontal cylinder"),
        ("ellipsoid", (0.3, 0.3, 0.3), "sphere"),
    ],
)
def test_own_luminaires_have_shapes(shape, size_m, name):
    lamp = photometry.from_intensities(
        0, [0, 90], [1, 1], luminous_shape=shape, luminous_size_m=size_m
    )
    for found in (lamp, photometry.read(lamp.to_ies())):
        assert found.luminous_shape == photometry.LuminousShape(name, size_m)


OWN = {"c_deg": [0, 90], "gamma_deg": [0, 45, 90], "intensity_cd": [[9, 5, 1], [9, 6, 0]]}


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"c_deg": [0, 50]}, "c_deg spans 0 to 50 degrees; expected one plane"),
        ({"c_deg": [10, 100]}, "c_deg spans 10 to 100 degrees"),
        ({"c_deg": [90, 0]}, r"c_deg\[1\] is 0 after 90; expected ascending"),
        ({"c_deg": [0, np.nan]}, r"c_deg\[1\] is NaN; expected -720 to 720 degrees"),
        ({"c_deg": [0, 1e9]}, r"c_deg\[1\] is 1000000000; expected"),
        ({"c_deg": []}, r"intensity_cd has the shape \(2, 3\); expected \(0, 3\)"),
        ({"c_deg": [[0, 90]]}, r"expected \(m,\) and \(n,\)"),
        ({"gamma_deg": [0, 45, 181]}, r"gamma_deg\[2\] is 181; expected 0 to 180 degrees"),
        ({"gamma_deg": [0, 45, 45]}, r"gamma_deg\[2\] is 45 after 45; expected ascending"),
        ({"gamma_deg": [0, 45, 45.001]}, "ascending angles, 0.002 degrees apart or more"),
        ({"gamma_deg": [0, 45]}, r"expected \(2, 2\)"),
        ({"gamma_deg": 0}, r"expected \(m,\) and \(n,\)"),
        ({"gamma_deg": [0], "intensity_cd": [[1], [1]]}, "gamma_deg has 1 angles; expected 2"),
        ({"c_deg": [], "intensity_cd": np.empty((0, 3))}, "c_deg has no angles"),
        ({"intensity_cd": [[9, 5, 1], [9, -6, 0]]}, r"intensity_cd\[1, 1\] is -6; expected 0"),
        ({"intensity_cd": [[9, 5, np.nan], [9, 6, 0]]}, r"intensity_cd\[0, 2\] is NaN"),
        ({"intensity_cd": [[9, 5, np.inf], [9, 6, 0]]}, r"intensity_cd\[0, 2\] is inf"),
        ({"lamp_count": 0}, "lamp_count is 0; expected a number above 0"),
        ({"lamp_count": np.nan}, "lamp_count is NaN"),
        ({"lumens_per_lamp": -1}, "lumens_per_lamp is -1; expected lumens above 0, or None"),
        ({"input_watts": -1}, "input_watts is -1; expected watts"),
        ({"luminous_shape": "cube"}, 'luminous_shape is "cube"; expected "box"'),
        ({"luminous_size_m": (1, 1)}, r"luminous_size_m has the shape \(2,\); expected \(3,\)"),
        ({"luminous_size_m": (1, -1, 0)}, "luminous_size_m is 1, -1, 0; expected 0 to"),
        ({"keywords": {"test": "x"}}, "keywords has the name 'test'; expected capitals"),
        ({"keywords": {"A]": "x"}}, "expected capitals"),
        ({"keywords": {"": "x"}}, "expected capitals"),
    ],
)  # fmt: skip
def test_what_makes_no_luminaire_is_refused(change, message):
    with pytest.raises(ValueError, match=message):
        photometry.from_intensities(**{**OWN, **change})


def test_own_arrays_are_copied():
    table = np.array(OWN["intensity_cd"], dtype=float)
    lamp = photometry.from_intensities(**{**OWN, "intensity_cd": table})
    table[:] = 0
    assert lamp.maximum_cd == 9
    assert pickle.loads(pickle.dumps(lamp)).maximum_cd == 9


# Diagrams.


def svg_texts(text):
    root = xml.etree.ElementTree.fromstring(text)
    return ["".join(node.itertext()) for node in root.iter() if node.tag.endswith("text")]


def png_size(data):
    assert data.startswith(b"\x89PNG\r\n\x1a\n")
    return int.from_bytes(data[16:20], "big"), int.from_bytes(data[20:24], "big")


def test_diagrams_are_those_of_the_command_line(tmp_path):
    files = {file.stem: file for file in [BATWING, *luminaire_files()[::5]]}
    for kind in ("polar", "cartesian", "both"):
        folder = tmp_path / kind
        folder.mkdir()
        readable = []
        for file in files.values():
            try:
                readable.append((file, photometry.read(file)))
            except InputError:
                continue
        paths = [file for file, _ in readable]
        command_line("photometry", "--svg", folder, "--diagram", kind, *paths)
        for file, lamp in readable:
            expected = (folder / f"{file.stem}.svg").read_text(encoding="utf-8")
            assert lamp.diagram(kind).to_svg() == expected, file


def test_diagrams_are_shown_and_saved(batwing, tmp_path):
    diagram = batwing.diagram("polar", planes_deg=[0, 22.5, 45, 90], title="a <title>")
    texts = svg_texts(diagram.to_svg())
    assert {"a <title>", "C22.5\u2013C202.5", "cd/klm"} <= set(texts)
    assert "cd" in svg_texts(batwing.diagram(unit="cd").to_svg())
    width, height = png_size(diagram.to_png(scale=1))
    assert png_size(diagram.to_png()) == (2 * width, 2 * height)
    png, metadata = diagram._repr_png_()
    assert (png_size(png), metadata) == (
        (2 * width, 2 * height),
        {"width": width, "height": height},
    )
    assert diagram._repr_svg_() == diagram.to_svg()
    diagram.save(tmp_path / "a.svg")
    diagram.save(tmp_path / "a.PNG", scale=0.5)
    assert (tmp_path / "a.svg").read_text(encoding="utf-8") == diagram.to_svg()
    assert (tmp_path / "a.PNG").read_bytes() == diagram.to_png(scale=0.5)
    assert len(list(tmp_path.iterdir())) == 2
    with pytest.raises(ValueError, match=r"expected \.svg or \.png"):
        diagram.save(tmp_path / "a.pdf")
    for scale in (0, -1, np.nan, 1e9):
        with pytest.raises(ValueError, match=r"expected 0\.1 to 10"):
            diagram.to_png(scale=scale)
    assert repr(diagram) == "<Diagram 'a <title>'>"


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"kind": "pie"}, 'kind is "pie"; expected "polar", "cartesian" or "both"'),
        ({"unit": "lm"}, "unit is 'lm'"),
        ({"planes_deg": []}, "expected 1 to 24 angles"),
        ({"planes_deg": range(25)}, "expected 1 to 24 angles"),
        ({"planes_deg": [np.nan]}, "not finite"),
        ({"planes_deg": 30}, "expected 1 to 24 angles"),
    ],
)
def test_what_is_no_diagram_is_refused(batwing, arguments, message):
    with pytest.raises(ValueError, match=message):
        batwing.diagram(**arguments)


def test_notebooks_show_facts_and_the_polar_diagram(batwing):
    lamp = photometry.read(UNEVEN, name="x.ies")
    assert repr(lamp) == "<Photometry 'Lamp <b>': LM-63-2002, type C, none, 4 x 5, " + (
        f"{lamp.flux_lm:.4g} lm>"
    )
    assert len(repr(photometry.from_intensities(0, [0, 9], [1, 1], name="long " * 50))) < 150
    html = lamp._repr_html_()
    assert "Lamp &lt;b&gt;" in html
    assert "<b>Lamp <b>" not in html
    assert "data:image/svg+xml;base64," in html
    xml.etree.ElementTree.fromstring(html)
    assert lamp._repr_svg_() == lamp.diagram().to_svg()
    assert lamp._repr_png_() == lamp.diagram()._repr_png_()
    xml.etree.ElementTree.fromstring(photometry.from_intensities(0, [0, 9], [0, 0])._repr_html_())
    assert "beam" in batwing._repr_html_()


def test_luminaires_are_plotted(batwing):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    from matplotlib import pyplot

    ax = batwing.plot()
    first, second = ax.lines
    assert (first.get_label(), second.get_label()) == ("C0-C180", "C90-C270")
    theta, radius = second.get_data()
    assert radius.max() == 1441.3
    np.testing.assert_allclose(
        radius,
        batwing.intensity_at(c_deg=np.where(theta < 0, 270, 90), gamma_deg=np.degrees(abs(theta))),
        atol=1e-6,
    )
    straight = batwing.plot(kind="cartesian", planes_deg=[30], unit="cd/klm", color="k")
    (line,) = straight.lines
    assert (line.get_color(), straight.get_xlim()) == ("k", (-90, 90))
    assert line.get_ydata().max() == pytest.approx(batwing.plane(30).maximum_cd / 3)
    figure, axes = pyplot.subplots(subplot_kw={"projection": "polar"})
    assert batwing.plot(axes) is axes
    figure.canvas.draw()
    with pytest.raises(ValueError, match="not polar"):
        batwing.plot(straight)
    for bad in ({"kind": "both"}, {"unit": "lm"}):
        with pytest.raises(ValueError, match="expected"):
            batwing.plot(**bad)
    pyplot.close("all")


def test_nothing_else_is_imported():
    program = "import sys, quasilux.photometry, quasilux.bsdf\n" + (
        "assert not {'matplotlib', 'scipy', 'pandas', 'xarray', 'IPython'} & set(sys.modules)"
    )
    subprocess.run([sys.executable, "-c", program], check=True)


# Any bytes.


def use(lamp):
    """What a user does with a luminaire: numbers are finite, and nothing panics."""
    ways = direction([0, 90, 123], [0, 45, 180])
    assert np.isfinite(lamp.intensity(ways)).all()
    assert np.isfinite(lamp.pdf(ways)).all()
    assert np.isfinite(lamp.invert(ways)).all()
    if lamp.flux_lm > 0:
        assert np.isfinite(lamp.sample(np.array([[0, 0], [0.3, 0.7], [1, 1]]))).all()
    json.dumps(lamp.to_dict(), allow_nan=False)
    for found in (repr(lamp), lamp.facts, lamp.unfolded(), lamp.plane(33)):
        assert found
    xml.etree.ElementTree.fromstring(lamp.diagram("both").to_svg())
    lamp.diagram().to_png(scale=0.1)
    for data in (lamp.to_ies(), lamp.to_ldt()):
        photometry.read(data)


def read_any(data, **options):
    try:
        lamp = photometry.read(data, **options)
    except InputError as error:
        assert error.file == "<bytes>"
        assert (error.line or 0) >= 1
        assert (error.column or 0) >= 1
        assert error.message
        return
    use(lamp)


@fuzz
@given(data=st.binary(max_size=400), format=st.sampled_from([None, "ies", "ldt", "xml"]))
def test_any_bytes_are_read_or_refused(data, format):
    read_any(data, format=format)
    read_any(HEAD + b"TILT=NONE\n" + data)
    read_any(TILTED, tilt=data)


NUMBERS = st.sampled_from(
    "0 1 -1 2 3 1e300 -1e300 1e-300 nan inf 90 180 360 99999999999999999999 0x1 1,5 . [ \x00".split(
        " "
    )
)


@fuzz
@given(data=st.data())
def test_mutated_files_are_read_or_refused(data):
    seeds = [UNEVEN, TYPE_A, TYPE_B, BATWING.read_bytes(), photometry.read(UNEVEN).to_ldt()]
    if os.environ.get("QUASILUX_CORPUS") != "none":
        small = [file for file in luminaire_files() if file.stat().st_size < 6000]
        seeds += [file.read_bytes() for file in small[:: max(1, len(small) // 20)]]
    lines = data.draw(st.sampled_from(seeds)).decode("latin-1").split("\n")
    for _ in range(data.draw(st.integers(1, 3))):
        place = data.draw(st.integers(0, len(lines) - 1))
        words = lines[place].split(" ")
        word = data.draw(st.integers(0, len(words) - 1))
        match data.draw(st.integers(0, 3)):
            case 0:
                words[word] = data.draw(NUMBERS)
            case 1:
                words[word] = data.draw(st.text(max_size=5))
            case 2:
                words.pop(word)
            case _:
                words = words[:word]
        lines[place] = " ".join(words)
    text = "\n".join(lines)
    assume("\ud800" not in text)
    read_any(text.encode("utf-8", "surrogatepass"))


@fuzz
@given(
    c=st.lists(st.floats(), max_size=5),
    gamma=st.lists(st.floats(0, 180), min_size=2, max_size=6, unique=True).map(sorted),
    seed=st.integers(0, 2**31),
    scale=st.sampled_from([0.0, 1e-200, 1.0, 1e18, np.inf]),
)
def test_any_arrays_make_a_luminaire_or_an_error(c, gamma, seed, scale):
    choices = [c, [0], [0, 90], [0, 30, 180], [90, 200, 270], [0, 100, 250, 360], [0, 120, 240]]
    rng = np.random.default_rng(seed)
    planes = choices[rng.integers(len(choices))]
    table = rng.random((len(planes), len(gamma))) * min(scale, 1e18)
    if not np.isfinite(scale) and table.size:
        table.flat[0] = scale
    try:
        lamp = photometry.from_intensities(planes, gamma, table)
    except InputError:
        return
    use(lamp)


# Documentation.


@pytest.mark.parametrize(
    "name", ["quasilux.photometry"] + [
        f"quasilux.photometry.{module.name}" for module in pkgutil.iter_modules(photometry.__path__)
    ],
)  # fmt: skip
def test_examples_are_true(name):
    assert doctest.testmod(importlib.import_module(name)).failed == 0


def test_everything_public_is_documented():
    for name in photometry.__all__:
        thing = getattr(photometry, name)
        assert thing.__doc__, name
        for member, value in vars(thing).items() if isinstance(thing, type) else ():
            if not member.startswith("_") and (callable(value) or isinstance(value, property)):
                assert value.__doc__, f"{name}.{member}"
