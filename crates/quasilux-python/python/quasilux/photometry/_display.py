"""A luminaire in a notebook: a table of facts beside the polar diagram."""

from __future__ import annotations

import base64
from functools import cached_property
from html import escape
from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from collections.abc import Iterable

    from quasilux.photometry._diagram import Diagram
    from quasilux.photometry._facts import Analysis, Facts, FileWarning, LuminousShape, PlaneCurve

_LONGEST = 60
_LEFT = 'style="text-align: left; vertical-align: top"'


class Described(Protocol):
    """What is said of a luminaire; properties are cached where the luminaire caches them."""

    @property
    def title(self) -> str: ...
    @property
    def manufacturer(self) -> str: ...
    @property
    def standard(self) -> str: ...
    @property
    def type(self) -> str: ...
    @property
    def symmetry(self) -> str: ...
    @property
    def counts(self) -> str: ...
    @cached_property
    def luminous_shape(self) -> LuminousShape: ...
    @property
    def flux_lm(self) -> float: ...
    @cached_property
    def analysis(self) -> Analysis: ...
    @cached_property
    def facts(self) -> Facts: ...
    @property
    def warnings(self) -> tuple[FileWarning, ...]: ...
    def diagram(self) -> Diagram: ...


def short(title: str) -> str:
    """Return what of a title fits on a line with other words."""
    return title if len(title) <= _LONGEST else f"{title[: _LONGEST - 1]}\N{HORIZONTAL ELLIPSIS}"


def html(luminaire: Described) -> str:
    """Return the facts of a luminaire and its polar diagram."""
    return table(luminaire.title, _rows(luminaire), luminaire.diagram())


def table(title: str, rows: Iterable[tuple[str, str]], diagram: Diagram) -> str:
    """Return a table of names and values, without empty ones, above a diagram."""
    lines = "".join(
        f"<tr><th {_LEFT}>{escape(name)}</th><td {_LEFT}>{escape(value)}</td></tr>"
        for name, value in rows
        if value
    )
    # As an image the drawing keeps its own styles, and the page those that it has.
    svg = base64.b64encode(diagram.to_svg().encode()).decode()
    image = f'<img alt="{escape(title)}" src="data:image/svg+xml;base64,{svg}"/>'
    return f"<div><b>{escape(title)}</b><table>{lines}</table>{image}</div>"


def _rows(luminaire: Described) -> list[tuple[str, str]]:
    """Facts in the order of the command line's summary."""
    found = luminaire.analysis
    rated_lm, ratio = found.rated_flux_lm, found.light_output_ratio
    rated = "absolute photometry" if rated_lm is None else f"{rated_lm:.5g} lm of the lamps"
    efficacy = found.efficacy_lm_w
    watts = luminaire.facts.input_watts
    code = " ".join(f"{percent:.0f}" for percent in found.flux_code.percent)
    return [
        ("manufacturer", luminaire.manufacturer),
        ("standard", f"{luminaire.standard}, type {luminaire.type}"),
        ("symmetry", f"{luminaire.symmetry}; {luminaire.counts}"),
        ("luminous shape", _shape(luminaire)),
        ("flux", f"{luminaire.flux_lm:.5g} lm integrated; {rated}"),
        ("output ratio", "" if ratio is None else f"{100.0 * ratio:.1f} %"),
        ("efficacy", "" if efficacy is None else f"{efficacy:.4g} lm/W at {watts:.5g} W"),
        ("maximum", _maximum(luminaire)),
        *((plane.name, _plane(plane)) for plane in found.principal_planes),
        ("CIE flux code", code),
        *(("warning", str(warning)) for warning in luminaire.warnings),
    ]


def _shape(luminaire: Described) -> str:
    shape = luminaire.luminous_shape
    size = " x ".join(f"{extent:.4g}" for extent in shape.size_m)
    return f"{shape.name}, {size} m" if any(shape.size_m) else shape.name


def _maximum(luminaire: Described) -> str:
    maximum = luminaire.analysis.maximum
    if maximum is None:
        return "no light"
    c, gamma = (f"{angle:.4g}\N{DEGREE SIGN}" for angle in (maximum.c_deg, maximum.gamma_deg))
    return f"{maximum.intensity_cd:.5g} cd at C {c}, gamma {gamma}"


def _plane(plane: PlaneCurve) -> str:
    if plane.beam is None or plane.field is None:
        return "no light"
    beam, field = (f"{spread.angle_deg:.1f}\N{DEGREE SIGN}" for spread in (plane.beam, plane.field))
    return f"beam {beam}, field {field}"
