"""Results and scenes in a notebook: a table with a picture below it."""

from __future__ import annotations

import base64
from html import escape
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterable

    from quasilux._shapes import Room, Run

_LEFT = 'style="text-align: left; vertical-align: top"'


def result(found: Run, png: bytes | None) -> str:
    """Return the figures of each sensor and camera as the terminal's table has them."""
    parts = []
    if found.sensors:
        heads = ["sensor", "points", "average", "minimum", "maximum", "uniformity"]
        rows = [
            [
                name,
                " x ".join(map(str, reversed(sensor.shape))),
                *(f"{x} lx" for x in (sensor.average, sensor.minimum, sensor.maximum)),
                str(sensor.uniformity),
            ]
            for name, sensor in found.sensors.items()
        ]
        parts.append(_table(heads, rows))
    if found.cameras:
        heads = ["camera", "pixels", "samples", "mean"]
        rows = [
            [
                name,
                " x ".join(map(str, camera.resolution)),
                str(camera.samples),
                f"{camera.mean} cd/m²",
            ]
            for name, camera in found.cameras.items()
        ]
        parts.append(_table(heads, rows))
    parts.append(f"<p>{escape(_facts(found))}</p>")
    parts.extend(map(_warning, found.warnings))
    return "".join(["<div>", *parts, _image(png, "first picture"), "</div>"])


def scene(found: Room, contents: dict[str, Any], plan: bytes) -> str:
    """Return what was understood of a scene, and its plan."""
    materials = [
        entry["name"] + (" (not diffuse)" if entry["kind"] != "diffuse" else "")
        for entry in contents["materials"]
    ]
    low, high = found.bounds_m
    size = " x ".join(f"{edge:.4g}" for edge in high - low) + " m"
    rows = [
        ("geometry", f"{contents['triangles']} triangles, {size}"),
        ("materials", ", ".join(materials)),
        ("lights", f"{len(contents['lights'])}, {contents['flux_lm']:.5g} lm"),
        *(
            ("sensor", f"{name}: {' x '.join(map(str, reversed(sensor.shape)))} points")
            for name, sensor in found.sensors.items()
        ),
        *(
            ("camera", f"{name}: {width} x {height} pixels")
            for name, (width, height) in found.cameras.items()
        ),
    ]
    lines = "".join(
        f"<tr><th {_LEFT}>{escape(name)}</th><td {_LEFT}>{escape(value)}</td></tr>"
        for name, value in rows
    )
    warnings = "".join(map(_warning, found.warnings))
    heading = f"<b>{escape(found.name)}</b>"
    image = _image(plan, "plan")
    return f"<div>{heading}<table>{lines}</table>{warnings}{image}</div>"


def _facts(found: Run) -> str:
    confidence = 100.0 * found.settings["confidence"]
    tolerance = 100.0 * found.settings["rel_tol"]
    verdict = "reached" if found.tolerance_reached else f"not reached: {found.stopped}"
    return (
        f"{confidence:.4g} % confidence, {found.replicates} replicates, {found.samples} samples, "
        f"{found.seconds:.3g} s; tolerance of {tolerance:.3g} % {verdict}"
    )


def _table(heads: Iterable[str], rows: Iterable[Iterable[str]]) -> str:
    head = "".join(f"<th {_LEFT}>{escape(name)}</th>" for name in heads)
    body = "".join(
        "<tr>" + "".join(f"<td {_LEFT}>{escape(cell)}</td>" for cell in row) + "</tr>"
        for row in rows
    )
    return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"


def _warning(text: str) -> str:
    return f"<p><b>warning:</b> {escape(text)}</p>"


def _image(png: bytes | None, what: str) -> str:
    if not png:
        return ""
    data = base64.b64encode(png).decode()
    return f'<img alt="{what}" style="max-width: 100%" src="data:image/png;base64,{data}">'
