"""Models that tests make: a room with a window and a door, fixtures, sources, in three schemas.

Without `ifcopenshell` the tests fail, unless ``QUASILUX_IFC=none`` says that it is missing.
"""

from __future__ import annotations

import math
import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pytest

if os.environ.get("QUASILUX_IFC") == "none":
    pytest.skip("QUASILUX_IFC=none: ifcopenshell is missing", allow_module_level=True)

import ifcopenshell  # noqa: E402
import ifcopenshell.guid  # noqa: E402

# The inside of the room in m, its walls, and its openings: width and height.
ROOM = (4.0, 3.0, 2.5)
WALL = 0.2
WINDOW = (1.5, 1.2)
DOOR = (0.9, 2.0)
PANE = (1.3, 1.0)

UNITS_M = {"m": 1.0, "mm": 0.001, "ft": 0.3048}


class Builder:
    """A model that is being made; lengths are in m, whatever its unit."""

    def __init__(
        self,
        schema: str = "IFC4",
        unit: str = "m",
        north: Sequence[float] | None = None,
        site: Sequence[Sequence[int]] | None = None,
    ) -> None:
        self.file: Any = ifcopenshell.file(schema=schema)  # pyright: ignore
        self.is_2x3 = schema == "IFC2X3"
        self.unit_m = UNITS_M[unit]
        self.roots = 0
        at = self.axes()
        true_north = None if north is None else self.make("IfcDirection", list(north))
        self.context = self.make(
            "IfcGeometricRepresentationContext", None, "Model", 3, 1e-5, at, true_north
        )
        self.project = self.make("IfcProject", self.guid(), None, "Test")
        self.project.RepresentationContexts = [self.context]
        self.project.UnitsInContext = self.make("IfcUnitAssignment", self._units(unit))
        self.site = self.root("IfcSite", "Site")
        if site is not None:
            self.site.RefLatitude, self.site.RefLongitude = site
        self.building = self.root("IfcBuilding", "Building")
        self.storey = self.root("IfcBuildingStorey", "Ground")
        for whole, part in (
            (self.project, self.site),
            (self.site, self.building),
            (self.building, self.storey),
        ):
            self.relate("IfcRelAggregates", whole, [part])

    def _units(self, unit: str) -> list[Any]:
        length = self.make("IfcSIUnit")
        length.UnitType, length.Name = "LENGTHUNIT", "METRE"
        if unit == "mm":
            length.Prefix = "MILLI"
        if unit == "ft":
            measure = self.make("IfcMeasureWithUnit")
            measure.ValueComponent = self.make("IfcLengthMeasure", 0.3048)
            measure.UnitComponent = length
            powers = self.make("IfcDimensionalExponents", 1, 0, 0, 0, 0, 0, 0)
            length = self.make("IfcConversionBasedUnit", powers, "LENGTHUNIT", "FOOT", measure)
        radian = self.make("IfcSIUnit")
        radian.UnitType, radian.Name = "PLANEANGLEUNIT", "RADIAN"
        degree = self.make("IfcMeasureWithUnit")
        degree.ValueComponent = self.make("IfcPlaneAngleMeasure", math.pi / 180)
        degree.UnitComponent = radian
        powers = self.make("IfcDimensionalExponents", 0, 0, 0, 0, 0, 0, 0)
        angle = self.make("IfcConversionBasedUnit", powers, "PLANEANGLEUNIT", "DEGREE", degree)
        return [length, angle]

    def make(self, ifc_class: str, *values: Any) -> Any:
        return self.file.create_entity(ifc_class, *values)

    def guid(self) -> str:
        """The next of identifiers that each test counts anew."""
        self.roots += 1
        return ifcopenshell.guid.compress(f"{self.roots:032x}")

    def root(self, ifc_class: str, name: str) -> Any:
        return self.file.create_entity(ifc_class, GlobalId=self.guid(), Name=name)

    def relate(self, ifc_class: str, one: Any, others: Any) -> None:
        names = {
            "IfcRelAggregates": ("RelatingObject", "RelatedObjects"),
            "IfcRelContainedInSpatialStructure": ("RelatingStructure", "RelatedElements"),
            "IfcRelVoidsElement": ("RelatingBuildingElement", "RelatedOpeningElement"),
            "IfcRelFillsElement": ("RelatingOpeningElement", "RelatedBuildingElement"),
            "IfcRelDefinesByType": ("RelatingType", "RelatedObjects"),
            "IfcRelAssociatesMaterial": ("RelatingMaterial", "RelatedObjects"),
        }[ifc_class]
        relation = self.file.create_entity(ifc_class, GlobalId=self.guid())
        setattr(relation, names[0], one)
        setattr(relation, names[1], others)

    def point(self, place: Sequence[float]) -> Any:
        return self.make("IfcCartesianPoint", [float(c) / self.unit_m for c in place])

    def axes(
        self,
        place: Sequence[float] = (0, 0, 0),
        z: Sequence[float] | None = None,
        x: Sequence[float] | None = None,
    ) -> Any:
        axis = None if z is None else self.make("IfcDirection", [float(c) for c in z])
        along = None if x is None else self.make("IfcDirection", [float(c) for c in x])
        return self.make("IfcAxis2Placement3D", self.point(place), axis, along)

    def placed(self, product: Any, place: Sequence[float], **turn: Any) -> None:
        product.ObjectPlacement = self.make("IfcLocalPlacement", None, self.axes(place, **turn))

    def box(self, size: Sequence[float], at: Sequence[float] = (0, 0, 0)) -> Any:
        """An extruded rectangle with its lowest corner at a place."""
        x, y, z = (float(side) / self.unit_m for side in size)
        centre = self.make("IfcCartesianPoint", [x / 2, y / 2])
        flat = self.make("IfcAxis2Placement2D", centre)
        profile = self.make("IfcRectangleProfileDef", "AREA", None, flat, x, y)
        up = self.make("IfcDirection", [0.0, 0.0, 1.0])
        return self.make("IfcExtrudedAreaSolid", profile, self.axes(at), up, z)

    def prism(
        self, corners: Sequence[Sequence[float]], at: Sequence[float], depth: float
    ) -> Any:
        """An outline in x and z, extruded towards -y."""
        flat = [[float(c) / self.unit_m for c in corner] for corner in corners]
        points = [self.make("IfcCartesianPoint", corner) for corner in flat]
        line = self.make("IfcPolyline", [*points, points[0]])
        profile = self.make("IfcArbitraryClosedProfileDef", "AREA", None, line)
        along = self.make("IfcDirection", [0.0, 0.0, 1.0])
        axes = self.axes(at, z=(0, -1, 0), x=(1, 0, 0))
        return self.make("IfcExtrudedAreaSolid", profile, axes, along, depth / self.unit_m)

    def styled(self, item: Any, name: str, transparency: float = 0.0) -> Any:
        colour = self.make("IfcColourRgb", None, 0.8, 0.7, 0.6)
        rendering = self.make("IfcSurfaceStyleRendering", colour, transparency)
        rendering.ReflectanceMethod = "FLAT"
        style = self.make("IfcSurfaceStyle", name, "BOTH", [rendering])
        if self.is_2x3:
            style = self.make("IfcPresentationStyleAssignment", [style])
        self.make("IfcStyledItem", item, [style])
        return item

    def shaped(self, product: Any, items: Sequence[Any], kind: str = "SweptSolid") -> Any:
        shape = self.make("IfcShapeRepresentation", self.context, "Body", kind, list(items))
        product.Representation = self.make("IfcProductDefinitionShape", None, None, [shape])
        return product

    def element(self, ifc_class: str, name: str, items: Sequence[Any]) -> Any:
        """An element of the storey with a body in coordinates of the model."""
        product = self.root(ifc_class, name)
        self.placed(product, (0, 0, 0))
        self.relate("IfcRelContainedInSpatialStructure", self.storey, [product])
        return self.shaped(product, items) if items else product

    def opening(self, host: Any, size: Sequence[float], at: Sequence[float]) -> Any:
        product = self.root("IfcOpeningElement", "Opening")
        self.placed(product, (0, 0, 0))
        self.shaped(product, [self.box(size, at)])
        self.relate("IfcRelVoidsElement", host, product)
        return product

    def space(self, name: str, size: Sequence[float], at: Sequence[float]) -> Any:
        product = self.root("IfcSpace", name)
        self.placed(product, (0, 0, 0))
        self.relate("IfcRelAggregates", self.storey, [product])
        return self.shaped(product, [self.box(size, at)])

    def fixture(
        self, type_name: str, place: Sequence[float], items: Sequence[Any] = (), **turn: Any
    ) -> Any:
        """A light fixture with a type, as each schema has them."""
        product = self.root("IfcFlowTerminal" if self.is_2x3 else "IfcLightFixture", "Lamp")
        self.placed(product, place, **turn)
        kind = self.root("IfcLightFixtureType", type_name)
        kind.PredefinedType = "NOTDEFINED"
        self.relate("IfcRelDefinesByType", kind, [product])
        self.relate("IfcRelContainedInSpatialStructure", self.storey, [product])
        return self.shaped(product, items) if items else product

    def goniometric(self, product: Any, source: Any, at: Any = None, flux_lm: float = 1000) -> Any:
        """Gives a product a goniometric source."""
        colour = self.make("IfcColourRgb", None, 1.0, 1.0, 1.0)
        item = self.make(
            "IfcLightSourceGoniometric", "Lamp A", colour, None, None, at or self.axes(), None,
            4000.0, float(flux_lm), "NOTDEFINED", source,
        )  # fmt: skip
        return self.shaped(product, [item], "LightSource")

    def distribution(
        self, planes: dict[float, dict[float, float]], curve: str = "TYPE_C"
    ) -> Any:
        rows = [
            self.make("IfcLightDistributionData", c, list(plane), list(plane.values()))
            for c, plane in planes.items()
        ]
        return self.make("IfcLightIntensityDistribution", curve, rows)

    def room(
        self, x: float = 0.0, *, name: str = "101", window: bool = True, door: bool = True
    ) -> None:
        """A room whose inside begins at (x, 0, 0)."""
        width, depth, height = ROOM
        wall = "IfcWallStandardCase" if self.is_2x3 else "IfcWall"
        south = self.element(
            wall, "South", [self.box((width + 2 * WALL, WALL, height), (x - WALL, -WALL, 0))]
        )
        north = self.element(
            wall, "North", [self.box((width + 2 * WALL, WALL, height), (x - WALL, depth, 0))]
        )
        self.element(wall, "West", [self.box((WALL, depth, height), (x - WALL, 0, 0))])
        self.element(wall, "East", [self.box((WALL, depth, height), (x + width, 0, 0))])
        slab = (width + 2 * WALL, depth + 2 * WALL, WALL)
        self.element("IfcSlab", "Floor", [self.box(slab, (x - WALL, -WALL, -WALL))])
        self.element("IfcSlab", "Roof", [self.box(slab, (x - WALL, -WALL, height))])
        if window:
            self._window(south, x + 1.0)
        if door:
            opening = self.opening(north, (DOOR[0], 3 * WALL, DOOR[1]), (x + 1, depth - WALL, 0))
            leaf = self.box((DOOR[0], 0.04, DOOR[1]), (x + 1, depth + 0.05, 0))
            self.relate("IfcRelFillsElement", opening, self.element("IfcDoor", "Door", [leaf]))
        self.space(name, ROOM, (x, 0, 0))

    def _window(self, wall: Any, x: float) -> None:
        (width, height), (clear_width, clear_height) = WINDOW, PANE
        side, rail = (width - clear_width) / 2, (height - clear_height) / 2
        opening = self.opening(wall, (width, 3 * WALL, height), (x, -2 * WALL, 1.0))
        y, thick = -0.13, 0.06
        bars = [
            self.box((width, thick, rail), (x, y, 1.0)),
            self.box((width, thick, rail), (x, y, 1.0 + height - rail)),
            self.box((side, thick, clear_height), (x, y, 1.0 + rail)),
            self.box((side, thick, clear_height), (x + width - side, y, 1.0 + rail)),
        ]
        for bar in bars:
            self.styled(bar, "Window frame")
        pane = self.box((clear_width, 0.02, clear_height), (x + side, -0.11, 1.0 + rail))
        items = [*bars, self.styled(pane, "Clear", 0.8)]
        self.relate("IfcRelFillsElement", opening, self.element("IfcWindow", "Window", items))

    def write(self, folder: Path, name: str = "model.ifc") -> Path:
        path = folder / name
        self.file.write(str(path))
        return path


SCHEMAS = ["IFC2X3", "IFC4", "IFC4X3"]
