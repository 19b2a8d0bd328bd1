"""Glass of odd shapes, panes behind one another, and bodies that face inward."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from ifc_models import Builder
from test_ifc_rooms import area_m2, found, load

from quasilux import ifc
from quasilux.ifc import _geometry, _glass, _model, _openings
from quasilux.ifc._findings import Findings


def bare_room() -> Builder:
    model = Builder()
    model.room(window=False, door=False)
    return model


def tube(model: Builder) -> Any:
    """A curtain of 4 mm around a circle."""
    centre = model.make("IfcAxis2Placement2D", model.make("IfcCartesianPoint", [0.0, 0.0]))
    profile = model.make("IfcCircleHollowProfileDef", "AREA", None, centre, 0.5, 0.004)
    up = model.make("IfcDirection", [0.0, 0.0, 1.0])
    return model.make("IfcExtrudedAreaSolid", profile, model.axes((2, 1.5, 0)), up, 2.0)


def glass_of(imported: ifc.Imported) -> dict[str, float]:
    return {
        name: area_m2(imported.triangles(name))
        for name in imported.materials
        if name.startswith("glass")
    }


def test_glass_of_any_shape_makes_a_model_that_loads(tmp_path: Path) -> None:
    model = bare_room()
    block = model.styled(model.box((0.3, 0.3, 0.3), (1, 1, 0)), "Glass cube", 0.8)
    model.element("IfcFurnishingElement", "Cube", [block])
    thick = model.styled(model.box((1.5, 0.15, 1.2), (1, -1, 1)), "Whole", 0.5)
    model.element("IfcWindow", "Whole", [thick])
    imported = load(model, tmp_path)
    imported.warnings()
    assert imported.materials["glass Glass cube body"]["kind"] == "dielectric"
    assert glass_of(imported)["glass Whole"] == pytest.approx(1.5 * 1.2)


@pytest.mark.parametrize(
    "keys",
    [
        {"kind": "pane", "transmittance": 0.2},
        {"kind": "diffuse", "reflectance": 0.5, "transmittance": 0.2},
    ],
)
def test_a_curved_curtain_keeps_what_the_mapping_says(keys: Any, tmp_path: Path) -> None:
    model = bare_room()
    model.element("IfcFurnishingElement", "Drape", [model.styled(tube(model), "Fabric")])
    imported = load(model, tmp_path, mapping={"materials": {"Fabric": keys}})
    assert imported.materials["Fabric"] == keys
    assert len(imported.triangles("Fabric")) and not glass_of(imported)
    assert found(imported, "light passes two of them")
    imported.warnings()


def test_panes_beside_one_another_stay(tmp_path: Path) -> None:
    """Two triangles of one square with a gap of 0.05 m, whose boxes overlap."""
    model = bare_room()
    halves = [[(0, 0), (1.95, 0), (0, 1.95)], [(2, 0.05), (2, 2), (0.05, 2)]]
    model.element(
        "IfcWindow",
        "Gable",
        [model.styled(model.prism(half, (5, 0, 0), 0.006), "Glass", 0.8) for half in halves],
    )
    assert sum(glass_of(load(model, tmp_path)).values()) == pytest.approx(1.95**2)


@pytest.mark.parametrize("styles", [("All", "All"), ("Glass outer", "Glass inner")])
def test_double_panes_are_one(styles: tuple[str, str], tmp_path: Path) -> None:
    model = bare_room()
    transparency = 0.0 if styles[0] == "All" else 0.8
    bars = [
        model.styled(model.box((1.5, 0.06, 0.1), (5, 0, z)), "All") for z in (0, 1.1)
    ]
    panes = [
        model.styled(model.box((1.5, 0.004, 1.0), (5, y, 0.1)), style, transparency)
        for y, style in zip((0.02, 0.04), styles)
    ]
    model.element("IfcWindow", "Double", [*bars, *panes])
    imported = load(model, tmp_path)
    assert sum(glass_of(imported).values()) == pytest.approx(1.5)
    assert found(imported, "panes behind one another are one sheet")
    if transparency:
        # Each pane with an entry of its own stays.
        own = {name: {"kind": "pane", "transmittance": 0.9} for name in styles}
        apart = load(model, tmp_path, mapping={"materials": own})
        assert [area_m2(apart.triangles(name)) for name in styles] == pytest.approx([1.5, 1.5])


def test_panes_with_a_spacer_are_one_sheet() -> None:
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)])
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    box = corners[np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))])]
    bodies = [
        box * size + [0, y, 0]
        for size, y in (((1, 0.004, 2), 0), ((1, 0.012, 0.01), 0.004), ((1, 0.004, 2), 0.016))
    ]
    (sheet,) = _glass.sheets_of(np.concatenate(bodies)).flat
    assert area_m2(sheet.corners) == pytest.approx(2.0)


def loops(model: Builder, faces: Sequence[Sequence[Sequence[float]]]) -> list[Any]:
    made = []
    for face in faces:
        loop = model.make("IfcPolyLoop", [model.point(point) for point in face])
        made.append(model.make("IfcFace", [model.make("IfcFaceOuterBound", loop, True)]))
    return made


@pytest.mark.parametrize("is_inward", [False, True])
def test_floors_of_bodies_that_face_inward_are_floors(is_inward: bool, tmp_path: Path) -> None:
    model = Builder()
    at = [(x, y, z) for x in (0, 4) for y in (0, 3) for z in (0, 0.2)]
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    faces = [[at[k] for k in (quad[::-1] if is_inward else quad)] for quad in quads]
    shell = model.make("IfcClosedShell", loops(model, faces))
    model.element("IfcSlab", "Slab", [model.make("IfcFacetedBrep", shell)])
    # A ceiling of no thickness, whichever way it faces.
    sheet = [(0, 0, 2.5), (4, 0, 2.5), (4, 3, 2.5), (0, 3, 2.5)]
    sheet = sheet[::-1] if is_inward else sheet
    covering = model.element("IfcCovering", "Ceiling", [])
    covering.PredefinedType = "CEILING"
    surface = model.make("IfcOpenShell", loops(model, [sheet]))
    model.shaped(covering, [model.make("IfcShellBasedSurfaceModel", [surface])], "SurfaceModel")
    imported = load(model, tmp_path)
    np.testing.assert_allclose(imported.triangles("floor")[..., 2], 0.2)
    assert set(imported.triangles("ceiling")[..., 2].ravel()) == {0.0, 2.5}


def test_names_of_a_mapping_that_nothing_has_are_told(tmp_path: Path) -> None:
    mapping = {"materials": {"IfcWal": {"reflectance": 0.9}, "IfcWall": {"reflectance": 0.6}}}
    imported = load(bare_room(), tmp_path, mapping=mapping)
    assert found(imported, 'no facet is of "IfcWal", which')
    assert not found(imported, 'no facet is of "IfcWall", which')


@pytest.mark.parametrize("fault", ["no shape", "no depth", "no volume"])
def test_openings_that_are_not_cut_are_told(fault: str, tmp_path: Path) -> None:
    model = Builder()
    wall = model.element("IfcWall", "South", [model.box((4, 0.2, 2.5), (0, 0, 0))])
    opening = model.opening(wall, (1, 0.6, 1), (1, -0.2, 1))
    solid = opening.Representation.Representations[0].Items[0]
    if fault == "no shape":
        opening.Representation = None
    elif fault == "no depth":
        solid.Depth = 0.0
    else:
        solid.ExtrudedDirection = model.make("IfcDirection", [1.0, 0.0, 0.0])
    (finding,) = found(load(model, tmp_path), "an opening without a sound body")
    assert opening.GlobalId in finding.places[0]


def test_openings_that_the_kernel_passes_over_are_told(tmp_path: Path) -> None:
    model = bare_room()
    wall = model.file.by_type("IfcWall")[0]
    load(model, tmp_path)
    opened = _model.Model(tmp_path / "model.ifc", Findings())
    whole = _geometry.shapes_of(opened, opened.of_class("IfcWall"))
    opening = model.opening(wall, (1, 0.6, 1), (1, -0.4, 1))
    assert not found(load(model, tmp_path), "an opening")
    again = _model.Model(tmp_path / "model.ifc", Findings())
    openings = _openings.openings_of(again, again.of_class("IfcWall"))
    own = _geometry.shapes_of(again, again.of_class("IfcOpeningElement"))
    # The wall as it was without its opening.
    _openings.tell_uncut(again, openings, {**whole, **own})
    (finding,) = again.findings.all()
    assert "does not cut" in finding.message and opening.GlobalId in finding.places[0]
