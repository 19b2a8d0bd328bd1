"""Any bytes, and any arrays, are a luminaire or an error."""

from __future__ import annotations

import json
import os
import xml.etree.ElementTree

import numpy as np
from hypothesis import assume, given
from hypothesis import strategies as st
from lamps import (
    BATWING,
    HEAD,
    TILTED,
    TYPE_A,
    TYPE_B,
    UNEVEN,
    direction,
    fuzz,
    luminaire_files,
)
from quasilux import InputError, photometry


def use(lamp):
    """What a user does with a luminaire: numbers are finite, and nothing panics."""
    ways = direction([0, 90, 123], [0, 45, 180])
    assert np.isfinite(lamp.intensity(ways)).all()
    assert np.isfinite(lamp.pdf(ways)).all()
    assert np.isfinite(lamp.invert(ways)).all()
    if lamp.flux_lm > 0:
        assert np.isfinite(lamp.sample(np.array([[0, 0], [0.3, 0.7], [1, 1]]))).all()
    json.dumps(lamp.to_dict(), allow_nan=False)
    for found in (repr(lamp), lamp.facts, lamp.unfolded(), lamp.plane(33)):
        assert found
    xml.etree.ElementTree.fromstring(lamp.diagram("both").to_svg())
    lamp.diagram().to_png(scale=0.1)
    for data in (lamp.to_ies(), lamp.to_ldt()):
        photometry.read(data)


def read_any(data, **options):
    try:
        lamp = photometry.read(data, **options)
    except InputError as error:
        assert error.file == "<bytes>"
        assert (error.line or 0) >= 1
        assert (error.column or 0) >= 1
        assert error.message
        return
    use(lamp)


@fuzz
@given(data=st.binary(max_size=400), format=st.sampled_from([None, "ies", "ldt", "xml"]))
def test_any_bytes_are_read_or_refused(data, format):
    read_any(data, format=format)
    read_any(HEAD + b"TILT=NONE\n" + data)
    read_any(TILTED, tilt=data)


NUMBERS = st.sampled_from(
    "0 1 -1 2 3 1e300 -1e300 1e-300 nan inf 90 180 360 99999999999999999999 0x1 1,5 . [ \x00".split(
        " "
    )
)


@fuzz
@given(data=st.data())
def test_mutated_files_are_read_or_refused(data):
    seeds = [UNEVEN, TYPE_A, TYPE_B, BATWING.read_bytes(), photometry.read(UNEVEN).to_ldt()]
    if os.environ.get("QUASILUX_CORPUS") != "none":
        small = [file for file in luminaire_files() if file.stat().st_size < 6000]
        seeds += [file.read_bytes() for file in small[:: max(1, len(small) // 20)]]
    lines = data.draw(st.sampled_from(seeds)).decode("latin-1").split("\n")
    for _ in range(data.draw(st.integers(1, 3))):
        place = data.draw(st.integers(0, len(lines) - 1))
        words = lines[place].split(" ")
        word = data.draw(st.integers(0, len(words) - 1))
        match data.draw(st.integers(0, 3)):
            case 0:
                words[word] = data.draw(NUMBERS)
            case 1:
                words[word] = data.draw(st.text(max_size=5))
            case 2:
                words.pop(word)
            case _:
                words = words[:word]
        lines[place] = " ".join(words)
    text = "\n".join(lines)
    assume("\ud800" not in text)
    read_any(text.encode("utf-8", "surrogatepass"))


@fuzz
@given(
    c=st.lists(st.floats(), max_size=5),
    gamma=st.lists(st.floats(0, 180), min_size=2, max_size=6, unique=True).map(sorted),
    seed=st.integers(0, 2**31),
    scale=st.sampled_from([0.0, 1e-200, 1.0, 1e18, np.inf]),
)
def test_any_arrays_make_a_luminaire_or_an_error(c, gamma, seed, scale):
    choices = [c, [0], [0, 90], [0, 30, 180], [90, 200, 270], [0, 100, 250, 360], [0, 120, 240]]
    rng = np.random.default_rng(seed)
    planes = choices[rng.integers(len(choices))]
    table = rng.random((len(planes), len(gamma))) * min(scale, 1e18)
    if not np.isfinite(scale) and table.size:
        table.flat[0] = scale
    try:
        lamp = photometry.from_intensities(planes, gamma, table)
    except InputError:
        return
    use(lamp)
