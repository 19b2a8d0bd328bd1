"""Files that are no sound IFC models, mappings that are wrong, and what is written."""

from __future__ import annotations

import importlib
import os
import pickle
import random
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from files import ROOT, command_line
from ifc_models import Builder
from test_ifc_rooms import found, lamp_file, load

import quasilux
from quasilux import ifc
from quasilux.ifc import __main__ as program
from quasilux.ifc import _care, _geometry, _imported, _isolated, _load
from quasilux.ifc._mapping import read_mapping
from quasilux.ifc._surfaces import GLASS_TRANSMITTANCE, REFLECTANCES


def room() -> Builder:
    model = Builder()
    model.room()
    return model


def test_what_is_no_ifc_file_is_refused(tmp_path: Path) -> None:
    whole = room().write(tmp_path).read_bytes()
    cases: list[tuple[str, bytes, str]] = [
        ("empty.ifc", b"", "no IFC file; expected ISO-10303-21"),
        ("text.ifc", b"hello\n" * 100, "no IFC file; expected ISO-10303-21"),
        ("cut.ifc", whole[: len(whole) // 2], "cut short; expected END-ISO-10303-21"),
        ("new.ifc", whole.replace(b"'IFC4'", b"'IFC9'"), "IFC9"),
        ("model.ifczip", b"PK", "save the model as .ifc"),
        ("odd.ifc", whole.replace(b"IFCDOOR(", b"IFCDOOR(:", 1), "at offset"),
        ("bare.ifc", b"ISO-10303-21;\nEND-ISO-10303-21;\n", "no IFC file that can be read"),
    ]
    for name, data, message in cases:
        path = tmp_path / name
        path.write_bytes(data)
        with pytest.raises(quasilux.InputError) as raised:
            _load.load_here(path)
        assert message in str(raised.value) and str(path) in str(raised.value), name
        if name == "odd.ifc":
            line = data[: data.index(b"IFCDOOR(:")].count(b"\n") + 1
            assert f"{path}:{line}: " in str(raised.value)
    with pytest.raises(FileNotFoundError):
        ifc.load(tmp_path / "missing.ifc")
    with pytest.raises(quasilux.InputError, match="no file"):
        _load.load_here(tmp_path)


def test_unknown_entities_and_missing_units_are_told(tmp_path: Path) -> None:
    path = room().write(tmp_path)
    data = path.read_bytes().replace(b"IFCDOOR(", b"IFCGATE(")
    path.write_bytes(data)
    assert found(_load.load_here(path), "entities that IFC4 does not have are left out: IFCGATE")
    bare = room()
    bare.file.by_type("IfcUnitAssignment")[0].Units = bare.file.by_type("IfcConversionBasedUnit")
    assert found(load(bare, tmp_path), "names no unit of length: metres are assumed")
    wrong = room()
    # Metres that are called millimetres.
    wrong.file.by_type("IfcSIUnit")[0].Prefix = "MILLI"
    assert found(load(wrong, tmp_path), "its unit of length (0.001 m) may be wrong")


def test_products_without_surfaces_are_told(tmp_path: Path) -> None:
    model = room()
    broken = model.element("IfcWall", "Flat", [model.box((1, 1, 1), (8, 0, 0))])
    broken.Representation.Representations[0].Items[0].Depth = 0.0
    model.element("IfcWall", "Bodiless", [])
    circular = model.fixture("Lamp", (1, 1, 1))
    circular.ObjectPlacement.PlacementRelTo = circular.ObjectPlacement
    imported = load(model, tmp_path)
    (finding,) = found(imported, "its geometry cannot be made into surfaces")
    assert finding.places == (f'IfcWall "Flat" {broken.GlobalId}',)
    assert found(imported, "a fixture whose placement cannot be resolved is left out")


def test_models_without_spaces_or_surfaces(tmp_path: Path) -> None:
    empty = Builder()
    expected = "no element with surfaces .it has none.; expected"
    with pytest.raises(quasilux.InputError, match=expected):
        load(empty, tmp_path)
    with pytest.raises(quasilux.InputError, match='no space "1"; the model has no spaces'):
        load(empty, tmp_path, space="1")
    lone = Builder()
    lone.element("IfcWall", "Lone", [lone.box((4, 0.2, 2.5))])
    imported = load(lone, tmp_path)
    assert not imported.measures and found(imported, "the model has no spaces")
    # A project that lacks sensors alone.
    project = imported.write(tmp_path / "out")
    with pytest.raises(quasilux.InputError, match="sensor"):
        quasilux.load(project)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("[materials", "no TOML"),
        ("[lamps.A]\n", r"expected \[materials\] or \[luminaires\]"),
        ("[luminaires]\nA = 1\n", "luminaires.A is no table"),
        ("[luminaires.A]\ndimming = 1\n", "lacks photometry; expected the name of an IES"),
        ('[luminaires.A]\nphotometry = "a.ies"\nturn = 1\n', "has the key turn; expected one of"),
        ('[luminaires.A]\nphotometry = "a.ies"\naim = [1, 2]\n', r"expected \[x, y, z\]"),
        ('[luminaires."*"]\nphotometry = "missing.ies"\n', "missing.ies: No such file"),
        ("[materials.IfcWall]\nreflectanse = 1\n", 'did you mean "?reflectance'),
        ('[materials.IfcWall]\nkind = "bsdf"\nfile = "missing.xml"\n', "missing.xml: No such file"),
    ],
)
def test_mappings_that_are_wrong_are_refused(text: str, message: str, tmp_path: Path) -> None:
    model = room()
    model.fixture("A", (1, 1, 2))
    mapping = tmp_path / "mapping.toml"
    mapping.write_text(text)
    with pytest.raises(quasilux.InputError, match=message):
        load(model, tmp_path, mapping=mapping).warnings()


def test_the_mapping_of_the_page_is_one() -> None:
    page = (ROOT / "docs/from-ifc.md").read_text(encoding="utf-8")
    parser = importlib.import_module("tomllib" if sys.version_info >= (3, 11) else "tomli")
    mapping = read_mapping(parser.loads(page.split("```toml\n")[1].split("```")[0]))
    assert len(mapping.materials) == 4 and len(mapping.luminaires) == 2
    for role, value in (*REFLECTANCES.items(), ("pane of transmittance", GLASS_TRANSMITTANCE)):
        assert str(value) in page, role


def test_only_new_files_are_written(tmp_path: Path) -> None:
    model = room()
    model.fixture("A", (1, 1, 2))
    mapping = {"luminaires": {"A": {"photometry": str(lamp_file(tmp_path))}}}
    imported = load(model, tmp_path, mapping=mapping)
    project = imported.write(tmp_path / "out" / "room.toml")
    names = sorted(path.name for path in project.parent.iterdir())
    assert names == ["room-lamp.ldt", "room-model.obj", "room.toml"]
    scene = quasilux.load(project)
    assert scene.flux_lm == pytest.approx(1000, rel=1e-3)
    assert list(scene.sensors) == ["101"]
    with pytest.raises(quasilux.InputError, match="room.toml: is there already"):
        imported.write(project)
    project.unlink()
    with pytest.raises(quasilux.InputError, match="the project would have a file of this name"):
        imported.write(project)
    assert not project.exists()
    # In a folder it has the name of the model.
    assert imported.write(tmp_path / "other") == tmp_path / "other" / "model.toml"
    assert pickle.loads(pickle.dumps(imported)).text == imported.text


def test_the_command_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    model = room()
    model.fixture("Panel", (2, 1.5, 2.4))
    path = model.write(tmp_path)
    (tmp_path / "m.toml").write_text('[luminaires.Panel]\nphotometry = "lamp.ldt"\n')
    lamp_file(tmp_path)
    out = tmp_path / "p.toml"
    words = [str(path), "--out", str(out), "--mapping", str(tmp_path / "m.toml"), "--space", "101"]
    assert program.main(words) == 0
    assert 'model.ifc: "ceiling": reflectance 0.7 by default' in capsys.readouterr().err
    command_line("check", out, "--out", tmp_path / "checked")
    assert program.main(words) == 2
    assert f"error: {out}: is there already" in capsys.readouterr().err
    assert program.main([str(path), "--list"]) == 0
    assert "Panel" in capsys.readouterr().out


def test_the_program_names_the_command_of_python(tmp_path: Path) -> None:
    path = room().write(tmp_path)
    for words in (["import", path, "--out", tmp_path / "a.toml"], ["run", path], ["check", path]):
        said = refused(*words)
        assert "python -m quasilux.ifc" in said, said
    light = '[[lights]]\nkind = "point"\nposition = [0, 0, 2]\nintensity_cd = 100\n'
    points = "points = [[0, 0, 1]]\nnormals = [[0, 0, 1]]\n"
    sensor = f'[[sensors]]\nname = "s"\nkind = "points"\n{points}'
    (tmp_path / "p.toml").write_text(f'[scene]\ngeometry = ["model.ifc"]\n{light}{sensor}')
    assert "python -m quasilux.ifc" in refused("check", tmp_path / "p.toml")


def refused(*words: Any) -> str:
    command = [sys.executable, "-m", "quasilux._command_line", *map(str, words)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 2, done.stderr
    return done.stderr


def test_what_breaks_the_kernel_is_left_out(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A process that dies, first as a whole and then at one product, as native code does."""
    model = room()
    path = model.write(tmp_path)
    door = model.file.by_type("IfcDoor")[0]
    deaths: list[tuple[bool, list[int]]] = []

    def run(folder: str, job: Any, end: float) -> str:
        care: _care.Care = job[3]
        deaths.append((care.one_by_one, list(care.skipped)))
        if not care.one_by_one:
            return "broke off (SIGSEGV)"
        if not care.skipped:
            care.note(door.id())
            return "broke off (SIGSEGV)"
        return real(folder, job, end)

    real = _isolated._run
    monkeypatch.setattr(_isolated, "_run", run)
    imported = ifc.load(path)
    assert deaths == [(False, []), (True, []), (True, [door.id()])]
    (finding,) = found(imported, "ifcopenshell broke off (SIGSEGV)")
    assert finding.places == (f'IfcDoor "Door" {door.GlobalId}',)
    assert "door" not in imported.materials and "glass Clear" in imported.materials
    monkeypatch.setattr(_isolated, "_run", lambda folder, job, end: "took more than 900 s")
    with pytest.raises(quasilux.InputError, match="ifcopenshell took more than 900 s; export"):
        ifc.load(path)


def test_a_process_that_dies_is_an_error(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = room().write(tmp_path)
    # What each new process runs first.
    (tmp_path / "sitecustomize.py").write_text("import os, signal\nos.kill(os.getpid(), 9)\n")
    monkeypatch.syspath_prepend(str(tmp_path))
    with pytest.raises(quasilux.InputError, match=r"ifcopenshell broke off \(SIGKILL\)"):
        ifc.load(path)


def test_a_process_ends_at_its_limits(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = room().write(tmp_path)
    monkeypatch.setattr(_isolated, "MOST_S", 0.0)
    with pytest.raises(quasilux.InputError, match="took more than 0 s in all"):
        ifc.load(path)


@pytest.mark.skipif(sys.platform == "win32", reason="has no named pipes in folders")
def test_a_process_ends_with_its_parent(tmp_path: Path) -> None:
    """The other process runs as long as its standard input is open, and not in its folder."""
    (tmp_path / "numpy.py").write_text("raise ImportError('taken from the folder')")
    os.mkfifo(tmp_path / "job")
    # It waits for a writer of its job, who never comes.
    process = subprocess.Popen(
        [sys.executable, "-c", _isolated._CODE, str(tmp_path)],
        stdin=subprocess.PIPE,
        cwd=tmp_path,
        stderr=subprocess.PIPE,
    )
    with pytest.raises(subprocess.TimeoutExpired):
        process.wait(0.5)
    _, told = process.communicate(timeout=20)
    assert process.returncode == 1 and told == b""


@pytest.mark.skipif(sys.platform != "linux", reason="bounds memory on Linux alone")
def test_memory_is_bounded() -> None:
    code = (
        "import resource; from quasilux.ifc import _child; _child._bound_memory(); "
        "print(resource.getrlimit(resource.RLIMIT_AS)[0])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, check=True)
    assert 0 < int(done.stdout) <= os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")


def test_the_last_product_is_not_blamed_for_what_comes_later(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    progress = tmp_path / "progress"
    care = _care.Care(progress=str(progress), one_by_one=True)
    monkeypatch.setattr(_geometry, "CARE", care)
    _load.load_here(room().write(tmp_path))
    assert not progress.exists()


@pytest.mark.skipif(sys.platform == "win32", reason="links ask for rights there")
def test_links_and_odd_names_are_not_written_through(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    imported = load(room(), tmp_path)
    (tmp_path / "a.toml").symlink_to(tmp_path / "elsewhere.toml")
    with pytest.raises(quasilux.InputError, match="a.toml: is there already"):
        imported.write(tmp_path / "a.toml")
    with pytest.raises(quasilux.InputError, match="File name too long"):
        imported.write(tmp_path / ("x" * 246 + ".toml"))
    with pytest.raises(quasilux.InputError, match="control characters in the name"):
        imported.write(tmp_path / "a\nb.toml")
    assert not (tmp_path / "elsewhere.toml").exists()
    # The second of two files cannot be written: none stays.
    real = _imported.write_whole

    def write_whole(place: Path, data: bytes) -> None:
        if place.suffix == ".toml":
            raise OSError(28, "No space left on device", str(place))
        real(place, data)

    monkeypatch.setattr(_imported, "write_whole", write_whole)
    with pytest.raises(quasilux.InputError, match="No space left on device"):
        imported.write(tmp_path / "out" / "b.toml")
    assert list((tmp_path / "out").iterdir()) == []


@pytest.mark.skipif(sys.platform == "win32", reason="has no such names")
def test_models_of_odd_names_make_projects(tmp_path: Path) -> None:
    path = room().write(tmp_path)
    for name in ("x" * 246 + ".ifc", "a\x01b.ifc"):
        other = path.rename(tmp_path / name)
        project = _load.load_here(other).write(tmp_path / "out")
        quasilux.load(project)
        path = other


def test_damaged_models_are_errors_or_projects(tmp_path: Path) -> None:
    """Bytes that are changed at random; what natively breaks is behind a process of its own."""
    shares = random.Random(20261201)
    whole = room().write(tmp_path).read_bytes()
    words = [b"$", b"*", b"-1.", b"1.E300", b"#1", b"()", b"'", b"NAN", b"IFCWALL", b".T."]
    for number in range(int(os.environ.get("QUASILUX_IFC_MUTANTS", "3"))):
        data = bytearray(whole)
        for _ in range(shares.randint(1, 6)):
            at = shares.randrange(200, len(data) - 40)
            data[at : at + shares.randint(0, 3)] = shares.choice(words)
        path = tmp_path / f"mutant-{number}.ifc"
        path.write_bytes(data)
        try:
            ifc.load(path).warnings()
        except quasilux.InputError as error:
            assert str(path) in str(error)
