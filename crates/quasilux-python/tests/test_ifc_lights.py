"""Fixtures and light sources of IFC models: direct light in closed form, and a room by hand."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from ifc_models import ROOM, SCHEMAS, Builder
from test_ifc_rooms import found, lamp_file, load

import quasilux
from quasilux import ifc

WIDTH, DEPTH, HEIGHT = ROOM
BLACK = {"*": {"reflectance": 0.0}}
# Intensities in cd of half-planes, the same at all gamma up to 90 degrees.
PLANES_CD = {0.0: 300.0, 90.0: 100.0, 180.0: 50.0, 270.0: 20.0}


def planes_file(folder: Path) -> Path:
    """A luminaire that has another intensity in each half-plane."""
    intensity = np.repeat(list(PLANES_CD.values()), 2).reshape(4, 2)
    luminaire = quasilux.photometry.from_intensities(list(PLANES_CD), [0, 90], intensity)
    path = folder / "planes.ies"
    luminaire.save(path)
    return path


def direct_lx(imported: ifc.Imported, points: np.ndarray, folder: Path) -> np.ndarray:
    """Illuminance of upward points in a room that reflects nothing, as a run of the project."""
    project = imported.write(folder / "run")
    text = project.read_text(encoding="utf-8")
    listed = ", ".join(str([float(c) for c in point]) for point in points)
    text += f'\n[[sensors]]\nname = "here"\nkind = "points"\npoints = [{listed}]\n'
    text += f"normals = [{', '.join(['[0, 0, 1]'] * len(points))}]\n"
    project.write_text(text, encoding="utf-8")
    return quasilux.simulate(quasilux.load(project), rel_tol=0.1)["here"].illuminance_lx


def expected_lx(lamp: np.ndarray, points: np.ndarray, intensity_cd: Any) -> np.ndarray:
    """E = I cos / d^2 of a point over horizontal points."""
    way = points - lamp
    distance = np.linalg.norm(way, axis=1)
    return intensity_cd * -way[:, 2] / distance**3


@pytest.mark.parametrize("schema", SCHEMAS)
def test_fixtures_light_as_they_are_turned(schema: str, tmp_path: Path) -> None:
    model = Builder(schema, unit="mm")
    model.room(window=False, door=False)
    # Its x axis, where C0 is, points along y.
    model.fixture("Turned", (2, 1.5, 2.4), x=(0, 1, 0), z=(0, 0, 1))
    mapping = {
        "luminaires": {"turned": {"photometry": str(planes_file(tmp_path)), "dimming": 2.0}},
        "materials": BLACK,
    }
    imported = load(model, tmp_path, mapping=mapping)
    (lamp,) = imported.luminaires
    assert lamp["position"] == [2.0, 1.5, 2.4]
    assert (lamp["aim"], lamp["c0"]) == ([0.0, 0.0, -1.0], [0.0, 1.0, 0.0])
    points = np.array([[2, 2.5, 0.8], [3, 1.5, 0.8], [2, 0.5, 0.8], [1, 1.5, 0.8]])
    # C90 of a luminaire that is not turned is y: c0 x aim.
    c90 = np.cross(lamp["c0"], lamp["aim"])
    way = points - lamp["position"]
    c_deg = np.round(np.degrees(np.arctan2(way @ c90, way @ lamp["c0"]))) % 360
    expected = expected_lx(
        np.array(lamp["position"]), points, 2.0 * np.array([PLANES_CD[c] for c in c_deg])
    )
    assert sorted(c_deg) == [0, 90, 180, 270] and c_deg[0] == 0
    np.testing.assert_allclose(direct_lx(imported, points, tmp_path), expected, rtol=1e-5)


def test_an_imported_room_is_the_room_by_hand(tmp_path: Path) -> None:
    model = Builder("IFC2X3", unit="ft")
    model.room(window=False, door=False)
    model.fixture("Lamp", (1.4, 1.5, 2.3))
    lamp = lamp_file(tmp_path)
    mapping = {"luminaires": {"*": {"photometry": str(lamp)}}}
    imported = load(model, tmp_path, mapping=mapping)
    result = quasilux.simulate(quasilux.load(imported.write(tmp_path / "a")), rel_tol=0.005)
    corners = np.array([[x, y, z] for x in (0, WIDTH) for y in (0, DEPTH) for z in (0, HEIGHT)])
    # Floor, ceiling, walls.
    faces = [(0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6)]
    by_hand = quasilux.Scene(
        vertices=corners,
        triangles=[t for a, b, c, d in faces for t in ((a, b, c), (a, c, d))],
        material_of=[0, 0, 1, 1, 2, 2, 2, 2, 2, 2, 2, 2],
        materials={
            "floor": {"reflectance": 0.2},
            "ceiling": {"reflectance": 0.7},
            "wall": {"reflectance": 0.5},
        },
        luminaires=[{"photometry": lamp, "position": [1.4, 1.5, 2.3]}],
        sensors=[sensor for sensor in imported.sensors],
    )
    expected = quasilux.simulate(by_hand, rel_tol=0.005, seed=7)
    one, other = result["101"], expected["101"]
    half_width = np.hypot(one.half_width_lx, other.half_width_lx)
    # 95 % intervals: 1.7 times as wide they hold for all of some hundred points together.
    assert (np.abs(one.illuminance_lx - other.illuminance_lx) < 1.7 * half_width).all()
    assert (half_width < 0.01 * other.illuminance_lx).all()


@pytest.mark.parametrize(("schema", "scale"), [("IFC2X3", 1.0), ("IFC4", 1e-3), ("IFC4X3", 1.0)])
def test_goniometric_sources_become_files(schema: str, scale: float, tmp_path: Path) -> None:
    """A Lambertian web of 2000 lm in cd/klm (scale 1) and cd/lm, on a source that is turned."""
    gamma = [0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0]
    web = {g: 1000 * scale * np.cos(np.radians(g)) / np.pi + 0.0 for g in gamma}
    model = Builder(schema, unit="mm")
    model.room(window=False, door=False)
    product = model.fixture("Panel", (2, 1.5, 2.2))
    at = model.axes((0, 0, 0.1), z=(0, 0, 1), x=(0, 1, 0))
    source = model.distribution({0.0: {g: float(i) for g, i in web.items()}})
    model.goniometric(product, source, at, flux_lm=2000)
    imported = load(model, tmp_path, mapping={"materials": BLACK})
    (lamp,) = imported.luminaires
    np.testing.assert_allclose(lamp["position"], [2, 1.5, 2.3], atol=1e-9)
    np.testing.assert_allclose(lamp["c0"], [0, 1, 0], atol=1e-9)
    assert found(imported, "cd/klm" if scale == 1 else "cd/lm")
    data = imported.files[lamp["photometry"]]
    luminaire = quasilux.photometry.read(data)
    # The web is a polygon of the cosine: straight lines between 15 degrees lose 0.5 %.
    assert luminaire.flux_lm == pytest.approx(2000, rel=0.01)
    points = np.array([[2, 1.5, 0.8], [3.5 - 1e-9, 1.5, 0.8 + 1e-9]])
    below, beside = direct_lx(imported, points, tmp_path)
    assert below == pytest.approx(2000 / np.pi / 1.5**2, rel=1e-4)
    # At 45 degrees: 1.5 m beside and 1.5 m below.
    assert beside == pytest.approx(2000 / np.pi * 0.5 / (2 * 1.5**2), rel=1e-4)
    assert not found(imported, "have no light")


def test_sources_that_cannot_be_used_are_told(tmp_path: Path) -> None:
    model = Builder()
    model.room(window=False, door=False)
    # 4 pi x 3 lm by lumen or kilolumen.
    even = {0.0: 3.0, 180.0: 3.0}
    cases = [
        (model.distribution({0.0: even}), "not plausible in any of cd/lm, cd/klm and cd"),
        (model.distribution({0.0: even}, "TYPE_A"), "a goniometric source of TYPE_A is left out"),
        (model.distribution({0.0: even}, "TYPE_B"), "a goniometric source of TYPE_B is left out"),
        (model.distribution({0.0: {0.0: -80.0, 180.0: 80.0}}), "makes no luminaire"),
        (model.distribution({0.0: {}}), "a plane has no angles"),
        (model.make("IfcDocumentReference", "../lamp.ldt"), 'the file "../lamp.ldt"'),
        (model.make("IfcDocumentReference", "https://example.com/lamp.ldt"), "in the folder of"),
        (model.make("IfcDocumentReference", "missing.ies"), 'the file "missing.ies"'),
    ]
    (tmp_path / "models").mkdir()
    lamp_file(tmp_path)
    for number, (source, _) in enumerate(cases):
        model.goniometric(model.fixture(f"type {number}", (2, 1.5, 2)), source)
    colour = model.make("IfcColourRgb", None, 1.0, 1.0, 1.0)
    model.make("IfcLightSourceAmbient", "Sky", colour)
    imported = load(model, tmp_path / "models")
    assert imported.luminaires == []
    for _, message in cases:
        assert found(imported, message), message
    assert found(imported, "IfcLightSourceAmbient is left out")
    assert len(found(imported, "have no light")) == len(cases)


def test_files_of_sources_are_taken_from_the_folder_of_the_model(tmp_path: Path) -> None:
    lamp = lamp_file(tmp_path)
    model = Builder()
    model.room(window=False, door=False)
    product = model.fixture("Panel", (2, 1.5, 2.2))
    model.goniometric(product, model.make("IfcDocumentReference", "./lamp.ldt"))
    imported = load(model, tmp_path)
    (keys,) = imported.luminaires
    assert imported.files[keys["photometry"]] == lamp.read_bytes()
    # A mapping goes before.
    mapping = {"luminaires": {"Panel": {"photometry": str(planes_file(tmp_path))}}}
    mapped = load(model, tmp_path, mapping=mapping)
    assert [keys["photometry"] for keys in mapped.luminaires] == ["model-planes.ies"]
    assert found(mapped, "the mapping goes before the goniometric source")


def test_bodies_say_where_the_light_leaves(tmp_path: Path) -> None:
    model = Builder()
    model.room(window=False, door=False)
    # Origins: at the ceiling above a pendant, on the lower side of a panel, and moved.
    model.fixture("Pendant", (1, 1, 2.5), [model.box((1.2, 0.1, 0.1), (-0.6, -0.05, -0.9))])
    model.fixture("Panel", (2, 1, 2.4), [model.box((0.6, 0.6, 0.1), (-0.3, -0.3, 0))])
    model.fixture("Kept", (3, 1, 2.5), [model.box((0.2, 1.2, 0.1), (-0.1, -0.6, -0.1))])
    lamp = {"photometry": str(lamp_file(tmp_path))}
    mapping = {
        "luminaires": {
            "Pendant": lamp,
            "Panel": lamp,
            "Kept": {
                **lamp, "position": "origin", "offset_m": [0, 0, -0.2], "aim": [0, 0, 1],
                "keep_body": True, "rotation_deg": 90,
            },
        }
    }  # fmt: skip
    imported = load(model, tmp_path, mapping=mapping)
    places = [lamp["position"] for lamp in imported.luminaires]
    np.testing.assert_allclose(places, [[1, 1, 1.6], [2, 1, 2.4], [3, 1, 2.3]], atol=1e-9)
    assert imported.luminaires[2]["aim"] == [0, 0, 1]
    assert imported.luminaires[2]["rotation_deg"] == 90
    (moved,) = found(imported, "the photometric centre is the middle of the lower side")
    assert "Lamp" in moved.places[0] and moved.count == 1
    assert found(imported, "bodies of light fixtures (2) are left out")
    kept = [name for name, _, _ in imported._objects if "IfcLightFixture" in name]
    assert len(set(kept)) == 1


def test_a_mapping_may_name_a_fixture_of_another_class(tmp_path: Path) -> None:
    model = Builder("IFC2X3")
    model.room(window=False, door=False)
    proxy = model.element("IfcBuildingElementProxy", "Globe:12", [model.box((0.2, 0.2, 0.2))])
    model.placed(proxy, (1, 1, 2))
    proxy.ObjectType = "Globe"
    lamp = model.fixture("Frame", (2, 1, 2), [model.box((0.2, 0.2, 0.2))])
    # The lamp within a fixture is in its light, too.
    bulb = model.element("IfcFlowTerminal", "Bulb", [model.box((0.1, 0.1, 0.1), (2, 1, 1.5))])
    kind = model.root("IfcLampType", "LED")
    kind.PredefinedType = "NOTDEFINED"
    model.relate("IfcRelDefinesByType", kind, [bulb])
    file = {"photometry": str(lamp_file(tmp_path))}
    imported = load(model, tmp_path, mapping={"luminaires": {"globe": file}})
    (globe,) = imported.luminaires
    assert globe["position"][2] == 2.0
    for product in (proxy, lamp, bulb):
        assert not [name for name, _, _ in imported._objects if product.GlobalId in name]
    assert found(imported, "bodies of light fixtures (3) are left out")


def test_fixtures_without_a_file_are_counted_by_type(tmp_path: Path) -> None:
    model = Builder("IFC2X3")
    model.room(window=False, door=False)
    for x in (1, 2, 3):
        model.fixture("Downlight 15 W", (x, 1, 2.5))
    model.fixture("Exit sign", (1, 2, 2.5))
    mapping = {"luminaires": {"Exit*": {"skip": True}, "Spot": {"photometry": "spot.ies"}}}
    imported = load(model, tmp_path, mapping=mapping)
    assert found(imported, 'fixtures of "Downlight 15 W" (3) have no light')
    assert found(imported, 'fixtures of "Exit*" are left out')
    assert found(imported, 'no fixture is called "Spot"')
    assert "[sky]" in imported.text
    assert found(imported, "an overcast sky of 10,000 lx")
