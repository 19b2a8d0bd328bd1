"""What `quasilux.photometry` reads, and from where."""

from __future__ import annotations

import io
import json
import os
import pickle
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from files import command_line, warnings_of
from lamps import BATWING, FACTORS, TILTED, UNEVEN, luminaire_files
from quasilux import InputError, photometry

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
            # The command line reads containers, too.
            told = entry["error"]["message"].replace(", TM-33 or GLDF", " or TM-33")
            assert {**entry["error"], "message": told} == found
            assert error.file == str(file)
            assert str(error) == f"{file}:{error.line}:{error.column}: {error.message}"
            continue
        assert entry["error"] is None
        assert lamp.to_dict() == entry["luminaire"]
        assert warnings_of(lamp) == entry["warnings"]


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


# Tilted lamps.


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
    assert "not a regular file" in str(photometry.read(path).warnings)


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


def test_the_same_bytes_are_the_same_luminaire() -> None:
    file = b"IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 1 1 2 0 0 0\n1 1 10\n0 45 90\n0\n100 80 10\n"
    one, other = (photometry.read(file, name=name) for name in ("a.ies", "b.ies"))
    assert one == other and hash(one) == hash(other)
    assert one != photometry.read(file.replace(b"80", b"81")) and one != file
    made = [photometry.from_intensities(0, [0, 90], [x, 0]) for x in (100, 100, 90)]
    assert made[0] == made[1] and made[0] != made[2]
