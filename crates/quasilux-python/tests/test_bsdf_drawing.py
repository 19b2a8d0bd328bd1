"""Diagrams of BSDFs, as files, in notebooks and by matplotlib."""

from __future__ import annotations

import xml.etree.ElementTree
from typing import Any

import numpy as np
import pytest
from files import command_line
from quasilux import bsdf
from surfaces import MADE, MATRIX, NARROW, surface_files


def test_diagrams_are_those_of_the_command_line(tmp_path):
    (tmp_path / "drawings").mkdir()
    for name, data in MADE.items():
        (tmp_path / name).write_bytes(data)
    files = [
        path for path in sorted(tmp_path.iterdir()) if path.suffix in (".xml", ".ddr", ".astm")
    ]
    files += [file for file in surface_files() if file.stem.startswith(("klems", "tt"))]
    incidences = ["--incidence", "0", "--incidence", "45", "--incidence", "70,90"]
    command_line("bsdf", "--svg", tmp_path / "drawings", *incidences, *files)
    for file in files:
        drawing = (tmp_path / "drawings" / f"{file.stem}.svg").read_text(encoding="utf-8")
        assert bsdf.read(file).diagram([0, 45, (70, 90)]).to_svg() == drawing, file


@pytest.mark.parametrize("name", MADE)
def test_notebooks_show_facts_and_lobes(name):
    surface = bsdf.read(MADE[name], name=name)
    html = surface._repr_html_()
    xml.etree.ElementTree.fromstring(html)
    assert "most scattered" in html
    assert surface._repr_svg_() == surface.diagram().to_svg()
    png, size = surface._repr_png_()
    assert png.startswith(b"\x89PNG")
    assert set(size) == {"width", "height"}
    assert repr(surface).startswith(f"<Bsdf '{surface.title}': {surface.format}; front ")
    assert repr(surface.diagram(title="a")) == "<Diagram 'a'>"


@pytest.mark.parametrize(
    ("incidences", "message"),
    [
        ([], "expected 1 to 24"),
        (range(25), "expected 1 to 24"),
        ([90], "from 0 to below 90"),
        ([-1], "from 0 to below 90"),
        ([np.nan], "from 0 to below 90"),
        ([(30, 361)], "from 0 to below 90"),
        ([(30, 0, 0)], "expected degrees"),
    ],
)
def test_what_is_no_incidence_is_refused(incidences, message):
    surface = bsdf.read(NARROW, name="a.ddr")
    for method in (surface.diagram, lambda given: surface.to_dict(incidences_deg=given)):
        with pytest.raises(ValueError, match=message):
            method(incidences)


def test_lobes_are_plotted():
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    from matplotlib import pyplot

    surface = bsdf.read(MATRIX)
    ax = surface.plot(incidences_deg=[0, (60, 90)], color="k")
    first, second = ax.lines
    assert (first.get_label(), second.get_label()) == (
        "0\N{DEGREE SIGN}",
        "60\N{DEGREE SIGN}, 90\N{DEGREE SIGN}",
    )
    angle, value = map(np.asarray, first.get_data())
    # Up is the side of the light: angles are from the pole below.
    theta = np.pi - np.abs(angle)
    reflected = surface.evaluate([0, 0, 1], [0, 0, 1])
    assert value[np.argmin(theta)] == pytest.approx(reflected)
    assert value[np.argmax(theta)] == pytest.approx(
        surface.evaluate([0, 0, 1], [0, 0, 1], mode="transmission")
    )
    ax.figure.canvas.draw()
    wrong: Any = "top"
    with pytest.raises(ValueError, match="unknown side"):
        surface.plot(side=wrong)
    with pytest.raises(ValueError, match="not polar"):
        surface.plot(pyplot.figure().add_subplot())
    pyplot.close("all")
