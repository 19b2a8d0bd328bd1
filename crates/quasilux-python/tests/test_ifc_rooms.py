"""Rooms of IFC models: areas in closed form, spaces, units, north, materials and workplanes."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from ifc_models import DOOR, PANE, ROOM, SCHEMAS, WALL, WINDOW, Builder

import quasilux
from quasilux import ifc
from quasilux.ifc import _glass, _load, _survey

WIDTH, DEPTH, HEIGHT = ROOM


def load(model: Builder, folder: Path, **options: Any) -> ifc.Imported:
    """Read a model in this process."""
    return _load.load_here(model.write(folder), **options)


def area_m2(corners: np.ndarray) -> float:
    cross = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return float(np.linalg.norm(cross, axis=1).sum() / 2)


def facing(corners: np.ndarray, normal: tuple[float, float, float]) -> np.ndarray:
    cross = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return corners[cross @ np.array(normal) > 0.999 * np.linalg.norm(cross, axis=1)]


def volume_m3(corners: np.ndarray) -> float:
    """By the divergence theorem, of bodies whose facets look outward."""
    return float(np.einsum("ij,ij->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6)


def found(imported: ifc.Imported, text: str) -> list[ifc.Finding]:
    return [finding for finding in imported.findings if text in str(finding)]


@pytest.mark.parametrize("schema", SCHEMAS)
def test_openings_are_cut_and_panes_are_sheets(schema: str, tmp_path: Path) -> None:
    model = Builder(schema)
    model.room()
    imported = load(model, tmp_path)
    walls = imported.triangles("wall")
    window_m2, door_m2 = np.prod(WINDOW), np.prod(DOOR)
    # Inner faces: the outer one of the south wall looks the other way.
    south = facing(walls, (0, 1, 0))
    south = south[np.abs(south[..., 1]).max(axis=1) < 1e-9]
    assert area_m2(south) == pytest.approx((WIDTH + 2 * WALL) * HEIGHT - window_m2, abs=1e-6)
    solid_m3 = (2 * (WIDTH + 2 * WALL) + 2 * DEPTH) * HEIGHT * WALL
    # Edges of the slabs are walls as well: the sheets of a body by themselves.
    bodies = [c for name, m, c in imported._objects if "IfcWall" in name]
    assert sum(map(volume_m3, bodies)) == pytest.approx(
        solid_m3 - (window_m2 + door_m2) * WALL, abs=1e-6
    )
    pane = imported.triangles("glass Clear")
    assert area_m2(pane) == pytest.approx(np.prod(PANE), abs=1e-6)
    np.testing.assert_allclose(pane[..., 1], -0.10, atol=1e-9)
    assert imported.materials["glass Clear"] == {"kind": "pane", "transmittance": 0.78}
    floor = facing(imported.triangles("floor"), (0, 0, 1))
    assert imported.materials["floor"]["reflectance"] == 0.2
    assert area_m2(floor) == pytest.approx(2 * (WIDTH + 2 * WALL) * (DEPTH + 2 * WALL), abs=1e-6)
    for role in ("floor", "ceiling", "wall", "door", "frame"):
        assert found(imported, f"by default, for {role}"), role
    assert found(imported, "transmittance 0.78 by default")


def test_all_units_give_one_room(tmp_path: Path) -> None:
    rooms = []
    for unit in ("m", "mm", "ft"):
        model = Builder(unit=unit)
        model.room()
        rooms.append(load(model, tmp_path))
    for other in rooms[1:]:
        assert list(other.materials) == list(rooms[0].materials)
        for name in other.materials:
            # Facets of a face may be cut in other ways.
            one, two = (room.triangles(name) for room in (rooms[0], other))
            assert area_m2(two) == pytest.approx(area_m2(one), rel=1e-9)
            corners = [np.unique(t.reshape(-1, 3).round(6) + 0.0, axis=0) for t in (one, two)]
            np.testing.assert_allclose(corners[1], corners[0], atol=2e-6)


def test_a_survey_knows_spaces_fixtures_and_styles(tmp_path: Path) -> None:
    model = Builder("IFC4X3", unit="mm")
    model.room(name="Office 1")
    model.fixture("Panel 600", (1, 1, 2.4))
    model.fixture("Panel 600", (2, 1, 2.4))
    survey = _survey.survey_here(model.write(tmp_path))
    (space,) = survey.spaces
    assert (space.name, space.storey) == ("Office 1", "Ground")
    assert space.area_m2 == pytest.approx(WIDTH * DEPTH, rel=1e-9)
    assert space.height_m == pytest.approx(HEIGHT, rel=1e-9)
    assert survey.fixtures == {"Panel 600": 2}
    assert survey.styles["Clear"] == {"IfcWindow": 1}
    assert "12.00 m2, 2.50 m high" in str(survey)


def test_a_space_is_chosen_with_what_bounds_it(tmp_path: Path) -> None:
    model = Builder()
    model.room(name="101")
    model.room(x=10.0, name="102")
    model.fixture("Lamp", (2, 1.5, 2.4))
    model.fixture("Lamp", (12, 1.5, 2.4))
    mapping = {"luminaires": {"Lamp": {"photometry": str(lamp_file(tmp_path))}}}
    whole = load(model, tmp_path, mapping=mapping)
    assert len(whole.luminaires) == len(whole.sensors) == 2
    one = load(model, tmp_path, mapping=mapping, space="102")
    assert [lamp["position"] for lamp in one.luminaires] == [[12.0, 1.5, 2.4]]
    assert [sensor["name"] for sensor in one.sensors] == ["102"]
    assert len(one.triangles()) == len(whole.triangles()) / 2
    assert one.triangles()[..., 0].min() == pytest.approx(10 - WALL)
    assert found(one, "products away from the chosen space (8)")
    around = load(model, tmp_path, mapping=mapping, space="102", extent="building")
    assert len(around.triangles()) == len(whole.triangles())
    assert len(around.luminaires) == 1
    by_id = model.file.by_type("IfcSpace")[1].GlobalId
    assert load(model, tmp_path, space=by_id).spaces == ("102",)
    assert load(model, tmp_path, storey="ground").spaces == ("101", "102")
    with pytest.raises(quasilux.InputError, match='no space "103"; expected one of "101", "102"'):
        load(model, tmp_path, space="103")
    with pytest.raises(quasilux.InputError, match='no storey "2"; expected one of "Ground"'):
        load(model, tmp_path, storey="2")


def lamp_file(folder: Path, flux_lm: float = 1000.0) -> Path:
    """A Lambertian point of a flux."""
    gamma = np.linspace(0, 90, 91)
    path = folder / "lamp.ldt"
    if not path.exists():
        lamp = quasilux.photometry.from_intensities(
            0, gamma, flux_lm / np.pi * np.cos(np.radians(gamma))
        )
        lamp.save(path)
    return path


def test_workplanes_keep_the_wall_zone_and_stay_inside(tmp_path: Path) -> None:
    model = Builder()
    model.room()
    # An L: a rectangle of 4 m x 3 m without a corner of 2 m x 1.5 m.
    corners = [(0, 0), (4, 0), (4, 1.5), (2, 1.5), (2, 3), (0, 3)]
    points = [model.make("IfcCartesianPoint", [10.0 + x, float(y)]) for x, y in corners]
    line = model.make("IfcPolyline", [*points, points[0]])
    profile = model.make("IfcArbitraryClosedProfileDef", "AREA", None, line)
    up = model.make("IfcDirection", [0.0, 0.0, 1.0])
    solid = model.make("IfcExtrudedAreaSolid", profile, model.axes((0, 0, 1)), up, 2.5)
    space = model.root("IfcSpace", "L")
    model.placed(space, (0, 0, 0))
    model.relate("IfcRelAggregates", model.storey, [space])
    model.shaped(space, [solid])
    model.space("low", (1, 1, 0.5), (20, 0, 0))
    both = model.space("both", (2, 2, 2), (30, 0, 0))
    model.relate("IfcRelAggregates", both, [model.space("half", (1, 2, 2), (30, 0, 0))])
    # A cupboard in the long arm of the L.
    model.element("IfcFurnishingElement", "Cupboard", [model.box((0.5, 0.5, 2), (12.9, 0.5, 1))])
    imported = load(model, tmp_path, workplane_m=0.8)
    grid, ell, half = imported.sensors
    assert half["name"] == "half" and found(imported, "made of other spaces")
    assert grid == {
        "name": "101", "kind": "grid", "origin": [0.5, 0.45, 0.8], "u": [3.0, 0.0, 0.0],
        "v": [0.0, 2.1, 0.0], "rule": "en12464", "normal": [0, 0, 1],
    }  # fmt: skip
    at = np.array(ell["points"]) - [10, 0, 0]
    np.testing.assert_allclose(at[:, 2], 1.8)
    in_foot = (at[:, 0] < 1.5) | (at[:, 1] < 1.0)
    assert len(at) > 10 and in_foot.all() and at[:, :2].min() > 0.5
    in_cupboard = ((at[:, :2] > [2.9, 0.5]) & (at[:, :2] < [3.4, 1.0])).all(axis=1)
    assert not in_cupboard.any()
    assert found(imported, "points of the workplane inside bodies are left out")
    assert found(imported, "a space no higher than 0.8 m gets no workplane")


def test_site_and_north_are_taken_over(tmp_path: Path) -> None:
    # True north 30 degrees clockwise from +y: (sin 30, cos 30).
    model = Builder(
        north=(0.5, 3**0.5 / 2), site=((52, 30, 0, 500_000), (-13, -24, -36, 0))
    )
    model.room()
    text = load(model, tmp_path).text
    assert "north_deg = -30.0" in text
    assert f"latitude_deg = {round(52.5 + 0.5 / 3600, 6)}" in text
    assert "longitude_deg = -13.41" in text
    assert "time_zone_h = -1.0" in text


def test_a_map_conversion_turns_north(tmp_path: Path) -> None:
    model = Builder("IFC4")
    model.room()
    crs = model.make("IfcProjectedCRS", "EPSG:25832")
    # The model's x axis points 90 degrees counter-clockwise from east: to the north.
    model.make("IfcMapConversion", model.context, crs, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0)
    imported = load(model, tmp_path)
    assert "north_deg = -90.0" in imported.text
    assert found(imported, "north is that of the map's grid")


def test_models_far_from_the_origin_are_moved(tmp_path: Path) -> None:
    model = Builder()
    model.room(x=3.5e6)
    imported = load(model, tmp_path)
    assert np.abs(imported.triangles()).max() < 10
    assert found(imported, "is subtracted everywhere")
    (sensor,) = imported.sensors
    low = imported.triangles().min(axis=(0, 1))
    assert sensor["origin"][0] - low[0] == pytest.approx(WALL + 0.5, abs=1e-6)


def test_a_mapping_names_styles_materials_and_classes(tmp_path: Path) -> None:
    model = Builder()
    model.room()
    brick = model.make("IfcMaterial", "Red brick")
    walls = model.file.by_type("IfcWall")
    model.relate("IfcRelAssociatesMaterial", brick, walls[:2])
    mapping = {
        "materials": {
            "red *": {"reflectance": [0.4, 0.2, 0.1]},
            "IfcWall": {"reflectance": 0.8},
            "IfcDoor": {"skip": True},
            "clear": {"kind": "pane", "transmittance": 0.6},
        }
    }
    imported = load(model, tmp_path, mapping=mapping)
    assert imported.materials["Red brick"] == {"reflectance": [0.4, 0.2, 0.1]}
    assert imported.materials["IfcWall"] == {"reflectance": 0.8}
    assert imported.materials["Clear"] == {"kind": "pane", "transmittance": 0.6}
    assert area_m2(imported.triangles("Clear")) == pytest.approx(np.prod(PANE))
    assert "door" not in imported.materials
    assert found(imported, 'facets of "IfcDoor" are left out')
    assert not found(imported, "for walls: name")
    imported.warnings()


@pytest.mark.parametrize("styled", [True, False])
def test_windows_that_do_not_tell_their_glass(styled: bool, tmp_path: Path) -> None:
    model = Builder()
    model.room(window=False)
    bodies = [model.box((1.5, 0.1, 1.2), (5, 0, 0))]
    if styled:
        # A frame of two bars and a thin pane between, all of one style.
        bodies = [
            model.styled(model.box(size, at), "All")
            for size, at in (
                ((1.5, 0.06, 0.1), (5, 0, 0)),
                ((1.5, 0.06, 0.1), (5, 0, 1.1)),
                ((1.5, 0.01, 1.0), (5, 0.02, 0.1)),
            )
        ]
    model.element("IfcWindow", "Silent", bodies)
    imported = load(model, tmp_path)
    glass = next(name for name in imported.materials if name.startswith("glass"))
    expected = 1.5 * 1.0 if styled else 1.5 * 1.2
    assert area_m2(imported.triangles(glass)) == pytest.approx(expected, abs=1e-6)
    assert found(imported, "no style tells its glass" if styled else "a window of one body")


def test_double_panes_are_one_sheet_and_rods_are_none() -> None:
    def box(size: tuple[float, ...], at: tuple[float, ...]) -> np.ndarray:
        corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)])
        faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
        triangles = [t for a, b, c, d in faces for t in ((a, b, c), (a, c, d))]
        return corners[np.array(triangles)] * np.array(size) + np.array(at)

    panes = np.concatenate([box((1, 0.004, 2), (0, 0, 0)), box((1, 0.004, 2), (0, 0.02, 0))])
    sheets = _glass.sheets_of(panes)
    assert (len(sheets.flat), len(sheets.solid)) == (2, 0)
    assert area_m2(sheets.flat[0].corners) == pytest.approx(2.0)
    assert _glass.is_behind(*sheets.flat)
    beside = np.concatenate([box((1, 0.004, 2), (0, 0, 0)), box((1, 0.004, 2), (1.1, 0, 0))])
    assert not _glass.is_behind(*_glass.sheets_of(beside).flat)
    rod = _glass.sheets_of(box((0.05, 0.05, 2), (0, 0, 0)))
    assert (len(rod.flat), len(rod.solid)) == (0, 1)
    # A sheet of a sheet is the sheet.
    again = _glass.sheets_of(sheets.flat[0].corners)
    np.testing.assert_allclose(again.flat[0].corners, sheets.flat[0].corners)


def test_workplanes_stay_under_a_roof_and_out_of_furniture(tmp_path: Path) -> None:
    model = Builder()
    # An attic 8 m wide and 2 m high in its middle: 0.75 m high from 1.5 m to 6.5 m.
    attic = model.space("Attic", (1, 1, 1), (0, 0, 0))
    model.shaped(attic, [model.prism([(0, 0), (8, 0), (4, 2)], (0, 6, 0), 6)])
    model.element("IfcSlab", "Floor", [model.box((8, 6, 0.2), (0, 0, -0.2))])
    # A room with a desk that is higher than the workplane.
    model.space("Desk", (4, 3, 2.5), (20, 0, 0))
    model.element("IfcFurnishingElement", "Desk", [model.box((1.6, 0.8, 0.78), (21, 1, 0))])
    # The same room without one.
    model.space("Free", (4, 3, 2.5), (30, 0, 0))
    imported = load(model, tmp_path)
    under_roof, with_desk, free = imported.sensors
    x = np.array(under_roof["points"])[:, 0]
    assert x.min() >= 1.5 and x.max() <= 6.5 and len(x) > 20
    at = np.array(with_desk["points"])
    on_desk = ((at[:, :2] > [21, 1]) & (at[:, :2] < [22.6, 1.8])).all(axis=1)
    assert len(at) > 20 and not on_desk.any()
    assert free["kind"] == "grid"
    (outside,) = found(imported, "points of the workplane outside the space are left out")
    assert "Attic" in outside.places[0] and outside.count == 1
    (inside,) = found(imported, "points of the workplane inside bodies are left out")
    assert "Desk" in inside.places[0] and inside.count == 1


def test_a_sloping_floor_is_told(tmp_path: Path) -> None:
    model = Builder()
    hall = model.space("Hall", (1, 1, 1), (0, 0, 0))
    model.shaped(hall, [model.prism([(0, 0), (8, 1), (8, 4), (0, 4)], (0, 6, 0), 6)])
    model.element("IfcSlab", "Roof", [model.box((8, 6, 0.2), (0, 0, 4))])
    imported = load(model, tmp_path)
    assert found(imported, "the floor is not level")
    # The floor is as high as the workplane at x = 6 m.
    assert max(point[0] for point in imported.sensors[0]["points"]) <= 6.0
