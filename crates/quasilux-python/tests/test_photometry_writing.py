"""Luminaires written to files, and own ones from arrays."""

from __future__ import annotations

import os
import pickle

import numpy as np
import pytest
from files import command_line
from lamps import BATWING, TYPE_B, direction, integral, luminaire_files
from quasilux import InputError, photometry

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
