"""Diagrams of luminaires, as files, in notebooks and by matplotlib."""

from __future__ import annotations

import subprocess
import sys
import xml.etree.ElementTree

import numpy as np
import pytest
from files import command_line
from lamps import BATWING, UNEVEN, luminaire_files
from quasilux import InputError, photometry


def svg_texts(text):
    root = xml.etree.ElementTree.fromstring(text)
    return ["".join(node.itertext()) for node in root.iter() if node.tag.endswith("text")]


def png_size(data):
    assert data.startswith(b"\x89PNG\r\n\x1a\n")
    return int.from_bytes(data[16:20], "big"), int.from_bytes(data[20:24], "big")


def test_diagrams_are_those_of_the_command_line(tmp_path):
    files = {file.stem: file for file in [BATWING, *luminaire_files()[::5]]}
    for kind in ("polar", "cartesian", "both"):
        folder = tmp_path / kind
        folder.mkdir()
        readable = []
        for file in files.values():
            try:
                readable.append((file, photometry.read(file)))
            except InputError:
                continue
        paths = [file for file, _ in readable]
        command_line("photometry", "--svg", folder, "--diagram", kind, *paths)
        for file, lamp in readable:
            expected = (folder / f"{file.stem}.svg").read_text(encoding="utf-8")
            assert lamp.diagram(kind).to_svg() == expected, file


def test_diagrams_are_shown_and_saved(batwing, tmp_path):
    diagram = batwing.diagram("polar", planes_deg=[0, 22.5, 45, 90], title="a <title>")
    texts = svg_texts(diagram.to_svg())
    assert {"a <title>", "C22.5\u2013C202.5", "cd/klm"} <= set(texts)
    assert "cd" in svg_texts(batwing.diagram(unit="cd").to_svg())
    width, height = png_size(diagram.to_png(scale=1))
    assert png_size(diagram.to_png()) == (2 * width, 2 * height)
    png, metadata = diagram._repr_png_()
    assert (png_size(png), metadata) == (
        (2 * width, 2 * height),
        {"width": width, "height": height},
    )
    assert diagram._repr_svg_() == diagram.to_svg()
    diagram.save(tmp_path / "a.svg")
    diagram.save(tmp_path / "a.PNG", scale=0.5)
    assert (tmp_path / "a.svg").read_text(encoding="utf-8") == diagram.to_svg()
    assert (tmp_path / "a.PNG").read_bytes() == diagram.to_png(scale=0.5)
    assert len(list(tmp_path.iterdir())) == 2
    with pytest.raises(ValueError, match=r"expected \.svg or \.png"):
        diagram.save(tmp_path / "a.pdf")
    for scale in (0, -1, np.nan, 1e9):
        with pytest.raises(ValueError, match=r"expected 0\.1 to 10"):
            diagram.to_png(scale=scale)
    assert repr(diagram) == "<Diagram 'a <title>'>"


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"kind": "pie"}, 'kind is "pie"; expected "polar", "cartesian" or "both"'),
        ({"unit": "lm"}, "unit is 'lm'"),
        ({"planes_deg": []}, "expected 1 to 24 angles"),
        ({"planes_deg": range(25)}, "expected 1 to 24 angles"),
        ({"planes_deg": [np.nan]}, "not finite"),
        ({"planes_deg": 30}, "expected 1 to 24 angles"),
    ],
)
def test_what_is_no_diagram_is_refused(batwing, arguments, message):
    with pytest.raises(ValueError, match=message):
        batwing.diagram(**arguments)


def test_notebooks_show_facts_and_the_polar_diagram(batwing):
    lamp = photometry.read(UNEVEN, name="x.ies")
    assert repr(lamp) == "<Photometry 'Lamp <b>': LM-63-2002, type C, none, 4 x 5, " + (
        f"{lamp.flux_lm:.4g} lm>"
    )
    assert len(repr(photometry.from_intensities(0, [0, 9], [1, 1], name="long " * 50))) < 150
    html = lamp._repr_html_()
    assert "Lamp &lt;b&gt;" in html
    assert "<b>Lamp <b>" not in html
    assert "data:image/svg+xml;base64," in html
    xml.etree.ElementTree.fromstring(html)
    assert lamp._repr_svg_() == lamp.diagram().to_svg()
    assert lamp._repr_png_() == lamp.diagram()._repr_png_()
    xml.etree.ElementTree.fromstring(photometry.from_intensities(0, [0, 9], [0, 0])._repr_html_())
    assert "beam" in batwing._repr_html_()


def test_luminaires_are_plotted(batwing):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    from matplotlib import pyplot

    ax = batwing.plot()
    first, second = ax.lines
    assert (first.get_label(), second.get_label()) == ("C0-C180", "C90-C270")
    theta, radius = second.get_data()
    assert radius.max() == 1441.3
    np.testing.assert_allclose(
        radius,
        batwing.intensity_at(c_deg=np.where(theta < 0, 270, 90), gamma_deg=np.degrees(abs(theta))),
        atol=1e-6,
    )
    straight = batwing.plot(kind="cartesian", planes_deg=[30], unit="cd/klm", color="k")
    (line,) = straight.lines
    assert (line.get_color(), straight.get_xlim()) == ("k", (-90, 90))
    assert line.get_ydata().max() == pytest.approx(batwing.plane(30).maximum_cd / 3)
    figure, axes = pyplot.subplots(subplot_kw={"projection": "polar"})
    assert batwing.plot(axes) is axes
    figure.canvas.draw()
    with pytest.raises(ValueError, match="not polar"):
        batwing.plot(straight)
    for bad in ({"kind": "both"}, {"unit": "lm"}):
        with pytest.raises(ValueError, match="expected"):
            batwing.plot(**bad)
    pyplot.close("all")


def test_nothing_else_is_imported():
    program = "import sys, quasilux.photometry, quasilux.bsdf\n" + (
        "assert not {'matplotlib', 'scipy', 'pandas', 'xarray', 'IPython'} & set(sys.modules)"
    )
    subprocess.run([sys.executable, "-c", program], check=True)
