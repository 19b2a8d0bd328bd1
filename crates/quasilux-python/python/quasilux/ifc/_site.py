"""Where a model stands on the earth, and where north is."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from quasilux.ifc import _model

if TYPE_CHECKING:
    from quasilux.ifc._model import Model


def site_of(model: Model) -> dict[str, float]:
    """Return the keys of [site]: latitude, longitude, time zone and north, as far as known."""
    keys: dict[str, float] = {}
    place = _coordinates(model)
    if place is not None:
        latitude, longitude = place
        zone = float(round(longitude / 15.0))
        keys = {"latitude_deg": latitude, "longitude_deg": longitude, "time_zone_h": zone}
        model.findings.note(
            f"IFC has no time zone: {zone:+g} h is taken from the longitude; mend time_zone_h in "
            "[site], or use a weather file"
        )
    north = _north_deg(model)
    if north:
        keys["north_deg"] = north
    return keys


def _coordinates(model: Model) -> tuple[float, float] | None:
    for site in model.of_class("IfcSite"):
        angles = [_degrees(_model.get(site, name)) for name in ("RefLatitude", "RefLongitude")]
        latitude, longitude = angles
        if latitude is None or longitude is None:
            continue
        if abs(latitude) > 90 or abs(longitude) > 180:
            message = f"latitude {latitude:g}, longitude {longitude:g} are on no globe: left out"
            model.findings.note(message, _model.label(site))
            continue
        return round(latitude, 6), round(longitude, 6)
    return None


def _degrees(parts: Any) -> float | None:
    """Degrees of IfcCompoundPlaneAngleMeasure: degrees, minutes, seconds, millionths of them."""
    try:
        values = [float(part) for part in parts or ()]
    except (TypeError, ValueError):
        return None
    if not 3 <= len(values) <= 4:
        return None
    # All parts have the sign of the angle; some files give it to the first that is not 0 alone.
    sign = -1.0 if any(value < 0 for value in values) else 1.0
    whole = [abs(value) for value in values] + [0.0]
    return sign * (whole[0] + whole[1] / 60 + (whole[2] + whole[3] * 1e-6) / 3600)


def _north_deg(model: Model) -> float:
    """North, counter-clockwise from +y: that of the map, which IFC puts before TrueNorth."""
    of_map, true = _map_north_deg(model), _true_north_deg(model)
    if of_map is not None:
        if true is None:
            message = "north is that of the map's grid: the model has no TrueNorth"
            model.findings.note(message)
        elif abs((of_map - true + 180) % 360 - 180) > 0.01:
            model.findings.note(
                f"north is {of_map:g} degrees from +y by IfcMapConversion, which is taken, and "
                f"{true:g} by TrueNorth; mend north_deg in [site] if that is right"
            )
        return of_map
    if true is not None:
        return true
    model.findings.note("the model does not say where north is: +y is taken")
    return 0.0


def _true_north_deg(model: Model) -> float | None:
    for context in model.of_class("IfcGeometricRepresentationContext"):
        if _model.is_a(context, "IfcGeometricRepresentationSubContext"):
            continue
        if _model.text_of(context, "ContextType") == "Plan":
            continue
        direction = _model.get(context, "TrueNorth")
        ratios = _model.get(direction, "DirectionRatios") if direction is not None else None
        if ratios is None or len(ratios) < 2:
            continue
        x, y = (float(ratio) for ratio in tuple(ratios)[:2])
        if len(ratios) != 2:
            message = f"TrueNorth has {len(ratios)} ratios; expected 2: the first two are taken"
            model.findings.note(message)
        if math.hypot(x, y) > 0:
            return _counter_clockwise_deg(x, y)
    return None


def _map_north_deg(model: Model) -> float | None:
    for conversion in model.of_class("IfcMapConversion"):
        abscissa = _model.get(conversion, "XAxisAbscissa")
        ordinate = _model.get(conversion, "XAxisOrdinate")
        if abscissa is not None and ordinate is not None and math.hypot(abscissa, ordinate) > 0:
            # Map north (0, 1) in coordinates of the model.
            return _counter_clockwise_deg(float(ordinate), float(abscissa))
    return None


def _counter_clockwise_deg(x: float, y: float) -> float:
    return round(math.degrees(math.atan2(-x, y)), 6) + 0.0
