"""What `quasilux.bsdf` reads, from any bytes."""

from __future__ import annotations

import copy
import io
import json
import pickle
import xml.etree.ElementTree
from typing import Any

import numpy as np
import pytest
from files import command_line, warnings_of
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from quasilux import InputError, bsdf
from surfaces import MADE, MATRIX, NARROW, close, surface_files

# What a file says.


def test_all_figures_warnings_and_errors_are_those_of_the_command_line(tmp_path):
    for name, data in MADE.items():
        (tmp_path / name).write_bytes(data)
    files = [*sorted(tmp_path.iterdir()), *surface_files()]
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
        assert warnings_of(surface) == entry["warnings"]
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
