"""What of a building is taken, where fixtures shine, and which of two statements counts."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from ifc_models import Builder
from test_ifc_rooms import found, lamp_file, load

import quasilux
from quasilux.ifc import _model, _sources
from quasilux.ifc._findings import Findings

GAMMA = (0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0)


def bare_room() -> Builder:
    model = Builder()
    model.room(window=False, door=False)
    return model


def lambertian(peak: float) -> dict[float, float]:
    return {g: float(peak * np.cos(math.radians(g))) + 0.0 for g in GAMMA}


def lamps(folder: Path, **keys: Any) -> dict[str, Any]:
    return {"luminaires": {"*": {"photometry": str(lamp_file(folder)), **keys}}}


def test_windows_at_the_far_side_of_thick_walls_stay(tmp_path: Path) -> None:
    model = Builder()
    wall = model.element("IfcWall", "Thick", [model.box((4, 0.8, 2.5), (0, -0.8, 0))])
    opening = model.opening(wall, (1, 2, 1), (1, -1.2, 1))
    pane = model.styled(model.box((1, 0.02, 1), (1, -0.78, 1)), "Glass", 0.8)
    model.relate("IfcRelFillsElement", opening, model.element("IfcWindow", "Far", [pane]))
    # A roof of two parts, of which one is away from the room.
    roof = model.element("IfcRoof", "Roof", [model.box((4, 3, 0.1), (0, 0, 2.5))])
    dormer = model.element("IfcSlab", "Dormer", [model.box((1, 1, 0.1), (0, 0, 5))])
    model.relate("IfcRelAggregates", roof, [dormer])
    model.space("101", (4, 3, 2.5), (0, 0, 0))
    imported = load(model, tmp_path, space="101")
    assert "glass Glass" in imported.materials
    assert any("Dormer" in name for name, _, _ in imported._objects)


def test_a_storey_without_spaces_keeps_its_fixtures(tmp_path: Path) -> None:
    model = Builder()
    model.element("IfcWall", "South", [model.box((4, 0.2, 2.5), (0, -0.2, 0))])
    model.fixture("Lamp", (1, 1, 2))
    for name in ("Ground", "gROUND"):
        imported = load(model, tmp_path, storey=name, mapping=lamps(tmp_path))
        assert len(imported.luminaires) == 1 and len(imported.triangles("wall"))


def test_bodies_of_fixtures_of_other_spaces_are_kept(tmp_path: Path) -> None:
    model = bare_room()
    model.room(x=10.0, name="102")
    for x in (2, 12):
        model.fixture("Lamp", (x, 1, 2), [model.box((0.2, 0.2, 0.1))])
    for keys, options in (({"keep_body": True}, {}), ({}, {"keep_bodies": True})):
        mapping = lamps(tmp_path, **keys)
        kept = load(model, tmp_path, space="102", extent="building", mapping=mapping, **options)
        assert len({name for name, _, _ in kept._objects if "IfcLight" in name}) == 2


def test_aims_say_which_side_of_a_body_shines(tmp_path: Path) -> None:
    model = bare_room()
    model.fixture("Lamp", (1, 1, 1), [model.box((0.4, 0.2, 0.1), (-0.2, -0.1, 0.05))])
    for aim, centre in (
        ([0, 0, 1], [1, 1, 1.15]),
        ([0, 0, -1], [1, 1, 1.05]),
        ([1, 0, 0], [1.2, 1, 1.1]),
    ):
        imported = load(model, tmp_path, mapping=lamps(tmp_path, aim=aim))
        np.testing.assert_allclose(imported.luminaires[0]["position"], centre, atol=1e-9)
        imported.warnings()
    with pytest.raises(quasilux.InputError, match="c0 is along aim; expected another direction"):
        load(model, tmp_path, mapping=lamps(tmp_path, aim=[1, 0, 0], c0=[2, 0, 0]))
    with pytest.raises(quasilux.InputError, match=r"aim is \[0, 0, 0\]; expected a direction"):
        load(model, tmp_path, mapping=lamps(tmp_path, aim=[0, 0, 0]))


def test_luminaires_inside_bodies_are_told(tmp_path: Path) -> None:
    model = bare_room()
    model.fixture("Lamp", (2, 1.5, 2.6))
    model.fixture("Lamp", (2, 1.5, 2.4))
    (finding,) = found(load(model, tmp_path, mapping=lamps(tmp_path)), "a luminaire inside a body")
    assert finding.places == ("(2.000, 1.500, 2.599) m",)


def test_directions_that_are_not_square_are_made_so(tmp_path: Path) -> None:
    model = bare_room()
    model.fixture("Lamp", (2, 1.5, 2), x=(1, 0, 1), z=(0, 0, 1))
    (lamp,) = load(model, tmp_path, mapping=lamps(tmp_path)).luminaires
    assert (lamp["aim"], lamp["c0"]) == ([0, 0, -1], [1, 0, 0])


def test_the_map_goes_before_true_north(tmp_path: Path) -> None:
    model = Builder(north=(0.0, 1.0))
    model.room(window=False, door=False)
    crs = model.make("IfcProjectedCRS", "EPSG:25832")
    model.make("IfcMapConversion", model.context, crs, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0)
    imported = load(model, tmp_path)
    assert "north_deg = -90.0" in imported.text
    assert found(imported, "-90 degrees from +y by IfcMapConversion, which is taken, and 0 by")


@pytest.mark.parametrize(
    ("peak", "flux_lm", "unit"),
    [
        (500 / np.pi, 500, "cd"),
        (1000 / np.pi, 500, "cd/klm"),
        (800 / np.pi, 2000, "cd/klm"),
        (1 / np.pi, 500, "cd/lm"),
        (1 / np.pi, 2, "cd/lm"),
        # 60 % in cd/klm, or 120 % in cd.
        (600 / np.pi, 500, ""),
    ],
)
def test_units_of_intensities(peak: float, flux_lm: float, unit: str, tmp_path: Path) -> None:
    model = bare_room()
    source = model.distribution({0.0: lambertian(peak)})
    model.goniometric(model.fixture("Panel", (2, 1.5, 2.2)), source, flux_lm=flux_lm)
    imported = load(model, tmp_path)
    if unit:
        assert found(imported, f"intensities are taken as {unit}: ")
        data = imported.files[imported.luminaires[0]["photometry"]]
        factor = {"cd": 1.0, "cd/klm": flux_lm / 1000, "cd/lm": flux_lm}[unit]
        expected = math.pi * peak * factor
        # Straight lines between 15 degrees lose 0.6 % of a cosine.
        assert quasilux.photometry.read(data).flux_lm == pytest.approx(expected, rel=0.01)
    else:
        assert not imported.luminaires
        assert found(imported, "the model does not say which")


def test_a_declared_unit_of_intensities_counts(tmp_path: Path) -> None:
    model = bare_room()
    units = model.file.by_type("IfcUnitAssignment")[0]
    candela, lumen = model.make("IfcSIUnit"), model.make("IfcSIUnit")
    candela.UnitType, candela.Name = "LUMINOUSINTENSITYUNIT", "CANDELA"
    lumen.UnitType, lumen.Name, lumen.Prefix = "LUMINOUSFLUXUNIT", "LUMEN", "KILO"
    elements = [
        model.make("IfcDerivedUnitElement", candela, 1),
        model.make("IfcDerivedUnitElement", lumen, -1),
    ]
    kind = "LUMINOUSINTENSITYDISTRIBUTIONUNIT"
    units.Units = [*units.Units, model.make("IfcDerivedUnit", elements, kind)]
    source = model.distribution({0.0: lambertian(600 / np.pi)})
    model.goniometric(model.fixture("Panel", (2, 1.5, 2.2)), source, flux_lm=500)
    imported = load(model, tmp_path)
    (lamp,) = imported.luminaires
    flux_lm = quasilux.photometry.read(imported.files[lamp["photometry"]]).flux_lm
    assert flux_lm == pytest.approx(300, rel=0.01)


def test_a_source_in_two_representations_is_one_luminaire(tmp_path: Path) -> None:
    model = bare_room()
    panel = model.fixture("Panel", (2, 1.5, 2.2))
    model.goniometric(panel, model.distribution({0.0: lambertian(1 / np.pi)}))
    shapes = panel.Representation.Representations
    item = shapes[0].Items
    again = model.make("IfcShapeRepresentation", model.context, "Light", "LightSource", item)
    panel.Representation.Representations = [*shapes, again]
    # One that is mirrored by an item that maps it.
    mapped = model.make("IfcRepresentationMap", model.axes(), shapes[0])
    flip = model.make(
        "IfcCartesianTransformationOperator3D", None, model.make("IfcDirection", [0.0, -1.0, 0.0]),
        model.make("IfcCartesianPoint", [0.0, 0.0, 0.0]), None, None,
    )  # fmt: skip
    other = model.fixture("Mirror", (1, 1, 2), [model.make("IfcMappedItem", mapped, flip)])
    imported = load(model, tmp_path)
    assert len(imported.luminaires) == 2
    (finding,) = found(imported, "a mirrored light source")
    assert other.GlobalId in finding.places[0]


def test_distributions_that_leave_out_nadir_are_told(tmp_path: Path) -> None:
    model = bare_room()
    part = {g: i for g, i in lambertian(1 / np.pi).items() if g >= 30}
    for number, planes in enumerate(({0.0: part}, {0.0: lambertian(1 / np.pi), 180.0: part})):
        model.goniometric(model.fixture(f"Type {number}", (2, 1, 2)), model.distribution(planes))
    imported = load(model, tmp_path)
    assert found(imported, "begins at gamma 30: below that it is dark")
    assert found(imported, "its planes begin at different gamma")


def test_items_that_map_items_without_end_are_bounded(tmp_path: Path) -> None:
    model = bare_room()
    colour = model.make("IfcColourRgb", None, 1.0, 1.0, 1.0)
    items = [model.make("IfcLightSourceAmbient", "A", colour)]
    origin = model.make("IfcCartesianPoint", [0.0, 0.0, 0.0])
    same = model.make("IfcCartesianTransformationOperator3D", None, None, origin, None, None)
    # 8^8 ways to the source.
    for _ in range(8):
        shape = model.make("IfcShapeRepresentation", model.context, "Body", "X", items)
        mapped = model.make("IfcRepresentationMap", model.axes(), shape)
        items = [model.make("IfcMappedItem", mapped, same) for _ in range(8)]
    model.shaped(model.fixture("Bomb", (2, 1.5, 2.2)), items, "LightSource")
    opened = _model.Model(model.write(tmp_path), Findings())
    assert _sources.sources_of(opened) == []
    assert any("more than 2000 items" in str(one) for one in opened.findings.all())
