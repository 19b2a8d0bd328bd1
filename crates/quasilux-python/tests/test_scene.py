"""Scenes from files, arrays and meshes: what is in them, and what is refused."""

from __future__ import annotations

import copy
import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays
from rooms import (
    DESK,
    LIGHT,
    MATERIAL_OF,
    MATERIALS,
    ROOM_TOML,
    TRIANGLES,
    VERTICES,
    command_line,
    comparable,
    example,
    room,
    same_bits,
    write_room,
)

import quasilux
from quasilux import _native, photometry
from quasilux._toml import ProjectText

FEW = {"rel_tol": 0.05, "samples": 16}


def test_a_project_file_is_loaded() -> None:
    scene = quasilux.load(example("office"))
    assert scene.triangles.shape == (2468, 3) and scene.triangles.dtype == np.uint32
    assert scene.vertices.dtype == np.float64 and scene.vertices.shape[1] == 3
    assert scene.material_of.max() < len(scene.materials) and "desk" in scene.materials
    assert np.array_equal(scene.bounds_m, [[0, 0, 0], [6, 5, 2.8]])
    assert scene.flux_lm == pytest.approx(18000.0, rel=1e-3)
    assert {name: sensor.shape for name, sensor in scene.sensors.items()} == {
        "workplane": (16, 20),
        "desks": (4,),
        "whiteboard": (4, 9),
    }
    workplane = scene.sensors["workplane"]
    assert np.allclose(workplane.positions_m[0, 0], [0.625, 0.625, 0.85])
    assert np.allclose(workplane.positions_m[0, 1], [0.875, 0.625, 0.85])
    assert np.array_equal(workplane.normals, np.broadcast_to([0.0, 0, 1], (16, 20, 3)))
    assert scene.cameras == {} and scene.warnings == ()
    assert quasilux.load(example("cornell")).cameras == {"view": (96, 96)}


def test_what_a_scene_hands_out_is_read_only_and_made_once() -> None:
    scene = room()
    for array in (scene.vertices, scene.triangles, scene.material_of):
        assert not array.flags.writeable
    assert scene.vertices is scene.vertices
    assert scene.sensors["desk"].positions_m is scene.sensors["desk"].positions_m
    with pytest.raises(ValueError, match="read-only"):
        scene.vertices[0] = 0.0
    with pytest.raises(TypeError):
        scene.sensors["desk"] = None  # type: ignore[index]


def test_arrays_make_the_scene_of_the_file(tmp_path: Path) -> None:
    of_file = quasilux.load(write_room(tmp_path))
    of_arrays = room()
    assert np.array_equal(of_arrays.vertices, of_file.vertices)
    assert np.array_equal(of_arrays.triangles, of_file.triangles)
    assert np.array_equal(of_arrays.material_of, of_file.material_of)
    assert of_arrays.materials == of_file.materials
    assert same_bits(quasilux.simulate(of_arrays, **FEW), quasilux.simulate(of_file, **FEW))


@pytest.mark.parametrize("name", ["office", "cornell"])
def test_arrays_of_a_loaded_scene_make_it_again(name: str) -> None:
    scene = quasilux.load(example(name))
    desk = {"kind": "points", "points": scene.bounds_m.mean(0)[None], "normals": [[0, 0, 1.0]]}
    again = quasilux.Scene(
        vertices=scene.vertices,
        triangles=scene.triangles,
        material_of=scene.material_of,
        materials={material: {"reflectance": 0.5} for material in scene.materials},
        lights=[LIGHT],
        sensors={"desk": desk},
    )
    assert np.array_equal(again.vertices[again.triangles], scene.vertices[scene.triangles])
    assert again.materials == scene.materials


def test_materials_are_given_by_index_or_by_name() -> None:
    names = np.array(list(MATERIALS))[MATERIAL_OF]
    for material_of in (names, names.tolist(), MATERIAL_OF.tolist(), MATERIAL_OF.astype(np.uint8)):
        assert np.array_equal(room(material_of=material_of).material_of, MATERIAL_OF)
    one = room(material_of=None, materials={"wall": {"reflectance": 0.5}})
    assert one.materials == ("wall",)
    none = room(material_of=None, materials=None)
    assert none.materials == ("default",) and "reflectance 0.5 is used" in none.warnings[0]
    other = room(material_of=["brick"] * 12)
    assert other.materials == ("floor", "wall", "brick")
    assert '"brick" of 12 triangles is not defined' in other.warnings[0]


def test_units_and_axes_are_turned() -> None:
    plain = room()
    for units, metres in (("mm", 1e-3), ("ft", 0.3048)):
        scene = room(vertices=VERTICES / metres, units=units)
        assert np.allclose(scene.vertices, plain.vertices)
    turned = VERTICES @ np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]])
    assert np.allclose(room(vertices=turned, up="y").vertices, plain.vertices)
    light = {**LIGHT, "position": [200, 150, 220]}
    desk = {**DESK, "origin": [50, 50, 80], "u": [300, 0, 0], "v": [0, 200, 0], "spacing": 50}
    scene = room(lights=[light], sensors=[{"name": "desk", **desk}], position_units="cm")
    ours, theirs = scene.sensors["desk"].positions_m, plain.sensors["desk"].positions_m
    assert np.allclose(ours, theirs)


def test_pairs_by_material_are_a_mesh() -> None:
    mesh = {
        "floor": (VERTICES, TRIANGLES[:2]),
        "wall": (VERTICES.tolist(), TRIANGLES[2:].tolist()),
    }
    scene, plain = room(mesh=mesh), room()
    assert np.array_equal(scene.vertices[scene.triangles], plain.vertices[plain.triangles])
    assert np.array_equal(scene.material_of, plain.material_of)


def test_meshes_of_trimesh_are_taken() -> None:
    trimesh = pytest.importorskip("trimesh")
    box = trimesh.creation.box(extents=[4, 3, 2.5])
    box.apply_translation([2, 1.5, 1.25])
    box.invert()
    one = room(mesh=box, materials={"wall": {"reflectance": 0.5}})
    assert len(one.triangles) == 12 and one.materials == ("wall",)
    assert np.array_equal(one.bounds_m, [[0, 0, 0], [4, 3, 2.5]])
    both = trimesh.Scene()
    both.add_geometry(box, geom_name="wall")
    desk = trimesh.creation.box(extents=[1, 0.5, 0.02])
    desk.visual = trimesh.visual.TextureVisuals(
        material=trimesh.visual.material.SimpleMaterial(name="wood")
    )
    shift = trimesh.transformations.translation_matrix([2, 1.5, 0.4])
    both.add_geometry(desk, geom_name="desk", transform=shift)
    mirror = np.diag([-1.0, 1, 1, 1])
    mirror[0, 3] = 2.0
    both.add_geometry(desk, geom_name="other", transform=shift @ mirror)
    scene = room(mesh=both, materials={"wall": {"reflectance": 0.5}, "wood": {"reflectance": 0.3}})
    assert len(scene.triangles) == 36 and set(scene.materials) == {"wall", "wood"}
    corners = scene.vertices[scene.triangles[scene.material_of == scene.materials.index("wood")]]
    a, b, c = np.moveaxis(corners, 1, 0)
    volume = np.einsum("ij,ij->i", a, np.cross(b, c)).reshape(2, -1).sum(1) / 6
    # Of both boxes the front sides are outside, of the mirrored one, too.
    assert np.allclose(volume, 0.01)


IES = (
    "IESNA:LM-63-2002\n[TEST] none\n[MANUFAC] none\nTILT=NONE\n"
    "1 -1 1 2 1 1 2 0 0 0\n1 1 10\n0 90\n0\n1000 1000\n"
)


def test_luminaires_come_from_files_bytes_and_objects(tmp_path: Path) -> None:
    (tmp_path / "lamp.ies").write_text(IES)

    def scene(photometry: Any) -> quasilux.Scene:
        lamp = {"photometry": photometry, "position": np.array([2, 1.5, 2.2])}
        return room(luminaires=[lamp, {**lamp, "position": (1, 1, 2)}], folder=tmp_path)

    class Lamp:
        def to_ies(self) -> bytes:
            return IES.encode()

    result = quasilux.simulate(scene("lamp.ies"), **FEW)
    for photometry in (tmp_path / "lamp.ies", IES.encode(), Lamp()):
        assert same_bits(quasilux.simulate(scene(photometry), **FEW), result)
    assert scene(IES.encode()).flux_lm == pytest.approx(2 * 2000 * np.pi + 1200 * np.pi, rel=1e-6)
    with pytest.raises(quasilux.InputError) as caught:
        scene(IES.replace("1000 1000", "1000").encode())
    assert caught.value.file == "luminaires[0].ies" and caught.value.line
    with pytest.raises(TypeError, match=r"luminaires\[0\]\[\"photometry\"\] is float"):
        scene(3.0)


def test_measured_surfaces_come_from_bytes() -> None:
    content = (example("diffuser").parent / "diffuser.ddt").read_bytes()
    scene = room(materials={**MATERIALS, "floor": {"kind": "bsdf", "file": content}})
    assert scene.materials == ("floor", "wall")
    # The content does not tell which it is; a name in .ddt does.
    assert any("read as reflection" in warning for warning in scene.warnings)
    with pytest.raises(quasilux.InputError) as caught:
        room(materials={**MATERIALS, "floor": {"kind": "bsdf", "file": b"no such"}})
    assert caught.value.file == "materials.floor.bsdf"


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"vertices": VERTICES[:, :2]}, r"vertices has the shape \(8, 2\); expected \(n, 3\)"),
        ({"vertices": [["a"] * 3]}, "vertices is an array of <U1; expected numbers"),
        ({"vertices": [[0, 0], [1]]}, "vertices is no array"),
        ({"triangles": TRIANGLES[0]}, r"triangles has the shape \(3,\); expected \(m, 3\)"),
        ({"triangles": TRIANGLES + 0.5}, "array of float64; expected indices of vertices"),
        ({"triangles": TRIANGLES - 1}, r"triangles\[0\]\[0\] is -1; expected"),
        ({"triangles": TRIANGLES + 2**33}, r"triangles\[0\]\[0\] is 8589934592; expected"),
        ({"triangles": TRIANGLES + 1}, "mesh: triangle 2 has the vertices 5, 8, 6; expected"),
        ({"material_of": [0]}, r"material_of has the shape \(1,\); expected \(12,\)"),
        ({"material_of": MATERIAL_OF + 1}, r"material_of\[2\] is 2; expected an index below 2"),
        ({"material_of": None}, "material_of is missing, and there are 2 materials"),
        ({"vertices": VERTICES * np.nan}, "mesh: triangle 0 has a vertex that is not finite"),
        ({"lights": [{**LIGHT, "intensity_cd": np.nan}]}, r'lights\[0\]\["intensity_cd"\] is nan'),
        ({"lights": [{**LIGHT, "position": [1, np.inf, 2]}]}, r'\["position"\]\[1\] is inf'),
        ({"lights": [{**LIGHT, "position": [1, 2]}]}, r'lights\[0\]\["position"\]: "position" is'),
        ({"lights": [{"kind": "point"}]}, r"lights\[0\]: \[\[lights\]\] lacks \"position\""),
        ({"lights": []}, "no lights; expected at least one"),
        ({"sensors": {"desk": {**DESK, "spacing": -1}}}, r'sensors\["desk"\]\["spacing"\]: '),
        ({"sensors": {"desk": {**DESK, "sping": 1}}}, r'sensors\["desk"\]\["sping"\]: unknown key'),
        ({"sensors": {"desk": {**DESK, "name": "x"}}}, r'\["name"\] is \'x\'; expected \'desk\''),
        ({"sensors": [DESK]}, r"sensors\[0\]: \[\[sensors\]\] lacks \"name\""),
        ({"materials": {"wall": {"reflectance": 2}}, "material_of": [0] * 12}, "materials"),
        ({"simulation": {"rel_tol": 3.0}}, r'simulation\["rel_tol"\]: '),
        ({"units": "mile"}, 'units: "units" is "mile"; expected'),
        ({"maintenance_factor": 0}, "maintenance_factor: "),
    ],
)
def test_what_is_wrong_is_named(changes: dict[str, Any], message: str) -> None:
    with pytest.raises(quasilux.InputError, match=message) as caught:
        room(**changes)
    assert isinstance(caught.value, ValueError)
    assert caught.value.file is None and caught.value.line is None
    assert caught.value.message == str(caught.value)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"lights": LIGHT}, "lights is dict; expected a list of dicts"),
        ({"lights": [3]}, r"lights\[0\] is int; expected a dict"),
        ({"lights": [{1: 2}]}, r"lights\[0\] has the key 1"),
        ({"lights": [{**LIGHT, "position": object()}]}, r'lights\[0\]\["position"\] is object'),
        ({"materials": [1]}, "materials is list"),
        ({"mesh": 3}, "mesh is int; expected a trimesh"),
        ({"vertices": None}, "vertices and triangles go together"),
    ],
)
def test_types_that_stand_for_nothing_are_refused(changes: dict[str, Any], message: str) -> None:
    with pytest.raises(TypeError, match=message):
        room(**changes)
    with pytest.raises(TypeError):
        quasilux.Scene(VERTICES, TRIANGLES)  # type: ignore[misc]


def test_errors_of_files_have_a_place(tmp_path: Path) -> None:
    project = write_room(tmp_path)
    project.write_text(ROOM_TOML.replace("spacing = 0.5", "spacing = -0.5"))
    with pytest.raises(quasilux.InputError) as caught:
        quasilux.load(project)
    error = caught.value
    assert (error.file, error.line, error.column) == (str(project), 19, 11)
    assert str(error).startswith(f"{project}:19:11: ") and str(error).endswith(error.message)
    again = pickle.loads(pickle.dumps(error))
    assert (again.line, str(again)) == (19, str(error))
    with pytest.raises(quasilux.InputError) as caught:
        quasilux.load(tmp_path / "none.toml")
    assert caught.value.file == str(tmp_path / "none.toml") and caught.value.line is None
    (tmp_path / "mesh.obj").write_text("v 0 0 x\n")
    project.write_text(ROOM_TOML)
    with pytest.raises(quasilux.InputError) as caught:
        quasilux.load(project)
    assert (caught.value.file, caught.value.line) == ("mesh.obj", 1)


FINITE = st.floats(allow_nan=False, allow_infinity=False)


@given(st.text(), st.lists(FINITE), st.integers(-(2**62), 2**62), st.text(min_size=1))
def test_text_and_numbers_survive_the_project_text(
    text: str, numbers: list[float], whole: int, key: str
) -> None:
    tomllib = pytest.importorskip("tomllib")
    written = ProjectText()
    try:
        values = {"text": text, "numbers": numbers, "whole": whole, "array": np.array(numbers)}
        written.table("[table]", {key: 1, **values}, "table")
    except quasilux.InputError as error:
        assert "UTF-8" in str(error)
        return
    read = tomllib.loads(written.text)["table"]
    assert read == {key: 1, **values, "array": numbers}
    assert len(written.lines) == len(written.origins) == written.text.count("\n")


SHAPES = arrays.array_shapes(min_dims=0, max_dims=3, max_side=5)
ANY_ARRAY = st.one_of(
    arrays.arrays(np.float64, SHAPES),
    arrays.arrays(np.int64, SHAPES),
    arrays.arrays(np.uint8, SHAPES),
    arrays.arrays(np.complex128, SHAPES),
    arrays.arrays(np.dtype("U3"), SHAPES),
)


@settings(max_examples=200, deadline=None)
@given(ANY_ARRAY, ANY_ARRAY, st.none() | ANY_ARRAY)
def test_arrays_of_any_shape_are_a_scene_or_refused(
    vertices: Any, triangles: Any, material_of: Any
) -> None:
    try:
        room(vertices=vertices, triangles=triangles, material_of=material_of)
    except (quasilux.InputError, TypeError) as error:
        assert str(error)


ANY_VALUE = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text() | st.binary(max_size=9),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(), inner, max_size=3),
    max_leaves=8,
)
SECTIONS = ["materials", "luminaires", "lights", "sensors", "cameras", "simulation"]
KEYS = ["kind", "name", "position", "points", "normals", "photometry", "file", "resolution", "seed"]


@settings(max_examples=300, deadline=None)
@given(st.sampled_from(SECTIONS), st.sampled_from(KEYS) | st.text(), ANY_VALUE)
def test_values_of_any_type_are_a_scene_or_refused(section: str, key: str, value: Any) -> None:
    given_ = {"materials": {"wall": {key: value}}, "simulation": {key: value}}
    try:
        room(**{section: given_.get(section, [{**LIGHT, key: value}])})
    except (quasilux.InputError, TypeError) as error:
        assert str(error)


@pytest.mark.parametrize("kind", ["file", "arrays"])
def test_a_pickled_scene_is_the_same_without_its_files(tmp_path: Path, kind: str) -> None:
    project = write_room(tmp_path)
    scene = quasilux.load(project) if kind == "file" else room()
    pickled = pickle.dumps(scene)
    project.unlink()
    (tmp_path / "mesh.obj").unlink()
    again = pickle.loads(pickled)
    assert again == scene and hash(again) == hash(scene) and again.name == scene.name
    assert same_bits(quasilux.simulate(again, **FEW), quasilux.simulate(scene, **FEW))
    assert copy.copy(scene) is scene and copy.deepcopy(scene) is scene
    assert scene != room(maintenance_factor=0.8)
    if kind == "file":
        with pytest.raises(quasilux.InputError, match=r"mesh\.obj"):
            pickle.dumps(scene)


def test_a_changed_file_is_not_pickled(tmp_path: Path) -> None:
    scene = quasilux.load(write_room(tmp_path))
    with (tmp_path / "mesh.obj").open("a") as file:
        file.write("# more\n")
    with pytest.raises(quasilux.InputError, match="has changed since the scene was loaded"):
        pickle.dumps(scene)


def test_a_saved_scene_is_a_project_for_the_command_line(tmp_path: Path) -> None:
    scene = room()
    scene.save(tmp_path / "room.scene")
    assert quasilux.load(tmp_path / "room.scene") == scene
    run = command_line("run", "room.scene", "--samples=16", "--json", "--quiet", cwd=tmp_path)
    assert run.returncode == 3, run.stderr
    result = quasilux.simulate(scene, samples=16)
    assert comparable(run.stdout) == comparable(result.to_json())
    content = (tmp_path / "room.scene").read_bytes()
    (tmp_path / "cut.scene").write_bytes(content[:-40])
    with pytest.raises(quasilux.InputError, match="cut short or changed"):
        quasilux.load(tmp_path / "cut.scene")


@given(st.binary(max_size=200) | st.binary(max_size=40).map(lambda b: b"quasilux-scene/1\n" + b))
def test_bytes_that_are_no_bundle_are_refused(content: bytes) -> None:
    with pytest.raises(quasilux.InputError):
        _native.Scene.from_bundle(content)


def test_findings_name_the_value() -> None:
    assert len(quasilux.load(example("office")).check()) == 0
    lamp = {**LIGHT, "position": [2, 1.5, 5.0]}
    check = room(lights=[LIGHT, lamp]).check()
    assert check and check.findings[0].file.startswith("lights[1]")
    assert check[0].message and check[0].cure and "warning 1: lights[1]" in str(check)


def test_plans_are_drawn() -> None:
    scene = room()
    assert scene.plan().startswith(b"\x89PNG") and scene.plan("svg").lstrip().startswith("<")
    with pytest.raises(ValueError, match="format is 'pdf'"):
        scene.plan("pdf")  # type: ignore[call-overload]


def test_scenes_show_themselves() -> None:
    scene = room()
    assert repr(scene) == "<quasilux.Scene 'scene': 12 triangles, 1 light, sensors: desk>"
    html = scene._repr_html_()
    assert "12 triangles, 4 x 3 x 2.5 m" in html and "data:image/png;base64," in html
    assert scene._repr_png_().startswith(b"\x89PNG")
    assert 'geometry = ["mesh"]' in scene.project_text
    assert "<script>" not in room(name="<script>")._repr_html_()


def test_a_mesh_may_stand_first() -> None:
    square = ([[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0]], [[0, 1, 2], [0, 2, 3]])
    rest: dict[str, Any] = {"materials": {"wood": {"reflectance": 0.4}}, "lights": [LIGHT]}
    sensors = {"desk": {"kind": "points", "points": [[1, 1, 0.8]], "normals": [[0, 0, 1]]}}
    first = quasilux.Scene({"wood": square}, **rest, sensors=sensors)
    assert first == quasilux.Scene(mesh={"wood": square}, **rest, sensors=sensors)


def test_a_missing_file_is_of_both_kinds() -> None:
    for kind in (quasilux.InputError, FileNotFoundError):
        with pytest.raises(kind, match="none.toml: No such file"):
            quasilux.load("none.toml")
        with pytest.raises(kind, match="none.ies: No such file"):
            photometry.read("none.ies")
