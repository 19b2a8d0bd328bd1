"""Skies and the sun: the documents of the command line, luminances, and places of the sun."""

from __future__ import annotations

import datetime
import json
import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from rooms import command_line, room
from years import terrace, weather

import quasilux
from quasilux import sky


def document(*words: object) -> dict[str, Any]:
    """What the command line prints."""
    run = command_line("sky", *words, "--json")
    assert run.returncode == 0, run.stderr
    return json.loads(run.stdout)


def test_cie_skies_are_those_of_the_command_line() -> None:
    options = ("--altitude=60", "--azimuth=180", "--lx=20000")
    clear = sky.cie(12, sun_deg=(60, 180), horizontal_lx=20_000)
    assert clear.to_dict() == document("--type=12", *options)
    assert (clear.model, clear.type, clear.time, clear.site) == ("cie", 12, None, None)
    assert clear.sun is not None and clear.sun.altitude_deg == 60.0
    assert clear.sun.normal_illuminance_lx is None and clear.sun_horizontal_lx == 0.0
    assert clear.horizontal_lx == pytest.approx(20_000) == clear.sky_horizontal_lx
    assert sky.cie(16).to_dict() == document("--type=16")
    assert "overcast" in str(sky.cie(16)) and "cie 12" in repr(clear)


@pytest.mark.parametrize("number", range(1, 17))
def test_luminances_make_the_horizontal_illuminance(number: int) -> None:
    found = sky.cie(number, sun_deg=(40, 130), horizontal_lx=10_000)
    altitudes = np.radians(np.arange(0.25, 90, 0.5))
    azimuths = np.arange(1, 360, 2)
    luminance = found.luminance_cd_m2(np.degrees(altitudes)[:, None], azimuths)
    assert luminance.shape == (180, 180)
    weights = np.sin(altitudes) * np.cos(altitudes) * np.radians(0.5) * np.radians(2)
    assert (luminance * weights[:, None]).sum() == pytest.approx(10_000, rel=2e-3)
    entries = found.to_dict()["sky"]["luminances"]
    places = np.array([[entry["altitude_deg"], entry["azimuth_deg"]] for entry in entries]).T
    assert np.array_equal(
        found.luminance_cd_m2(*places), [entry["luminance_cd_m2"] for entry in entries]
    )
    assert found.luminance_cd_m2(90) == pytest.approx(found.zenith_luminance_cd_m2)
    assert found.luminance_cd_m2(-1) == 0.0 and np.isnan(found.luminance_cd_m2(91))


def test_skies_of_weather_are_those_of_the_command_line(tmp_path: Path) -> None:
    (tmp_path / "site.wea").write_bytes(weather())
    expected = document("--weather", tmp_path / "site.wea", "--time=2026-03-20T12:30")
    for time in (
        "2026-03-20T12:30",
        np.datetime64("2026-03-20T12:30"),
        datetime.datetime(2026, 3, 20, 12, 30),
    ):
        assert sky.of_weather(tmp_path / "site.wea", time).to_dict() == expected
    noon = sky.of_weather(weather(), "2026-03-20T12:15")
    assert noon.model == "weather" and noon.site == sky.Site(37.72, -122.22, -8)
    assert noon.time is not None and (noon.time.hour, noon.time.minute) == (12, 30)
    assert noon.sky_horizontal_lx == pytest.approx(12_000)
    assert noon.sun is not None and noon.sun.normal_illuminance_lx == 60_000
    height = np.sin(np.radians(noon.sun.altitude_deg))
    assert noon.sun_horizontal_lx == pytest.approx(60_000 * height, rel=1e-3)
    again = pickle.loads(pickle.dumps(noon))
    assert again.to_dict() == noon.to_dict()


def test_skies_of_scenes_are_what_shines_there(tmp_path: Path) -> None:
    scene = terrace(sun={"time": "2026-03-20T12:30:00", "direct": True})
    scene.save(tmp_path / "terrace.toml")
    found = sky.of_scene(scene)
    entry = document(tmp_path / "terrace.toml")
    assert {**found.to_dict(), "project": None} == {**entry, "project": None}
    assert pickle.loads(pickle.dumps(found)).to_dict() == found.to_dict()
    with pytest.raises(quasilux.InputError, match="nothing is outside"):
        sky.of_scene(room())
    with pytest.raises(quasilux.InputError, match="no time says which interval"):
        sky.of_scene(terrace())


def test_skies_are_drawn() -> None:
    drawn = sky.cie(12, sun_deg=(60, 180)).diagram()
    assert "<svg " in drawn.to_svg() and drawn.to_png().startswith(b"\x89PNG")
    png, size = sky.cie(1, sun_deg=(60, 180))._repr_png_()
    assert png.startswith(b"\x89PNG") and size["width"] > 0


def test_the_sun_is_where_the_command_line_has_it(tmp_path: Path) -> None:
    site = sky.Site(52.5, 13.4, 1)
    csv = tmp_path / "sun.csv"
    listed = document("--site=52.5,13.4,1", "--positions=2026-06-21", "--csv", csv)
    table = np.genfromtxt(csv, delimiter=",", names=True, dtype=None, encoding="utf-8")
    hours = np.arange("2026-06-21", "2026-06-22", dtype="datetime64[h]")
    found = site.sun(hours)
    assert found.shape == (24, 2)
    assert np.array_equal(found, np.column_stack([table["altitude_deg"], table["azimuth_deg"]]))
    assert np.array_equal(site.sun(hours.reshape(4, 6)), found.reshape(4, 6, 2))
    assert np.array_equal(site.sun("2026-06-21T12:00"), found[12])
    assert np.array_equal(site.sun([datetime.datetime(2026, 6, 21, 5)]), found[[5]])
    day, entry = site.day("2026-06-21"), listed["days"][0]
    assert [list(span) for span in day.up_h] == entry["up"]
    assert day.altitude_deg == entry["highest"]["altitude_deg"] > 60
    assert day == site.day(datetime.date(2026, 6, 21)) and 12 < day.highest_h < 12.5
    assert sky.Site(80, 0, 0).day("2026-12-21").up_h == ()
    assert sky.Site(80, 0, 0).day("2026-06-21").up_h == ((0.0, 24.0),)


def test_what_makes_no_sky_is_refused(tmp_path: Path) -> None:
    with pytest.raises(quasilux.InputError, match="expected 1 to 16"):
        sky.cie(17)
    with pytest.raises(TypeError, match="whole number"):
        sky.cie(1.5)  # type: ignore[arg-type]
    with pytest.raises(quasilux.InputError, match="depend on the sun; give sun_deg"):
        sky.cie(12)
    with pytest.raises(quasilux.InputError, match="no interval with 06-21"):
        sky.of_weather(weather(), "2026-06-21T12:00")
    with pytest.raises(quasilux.InputError, match="nothing shines"):
        sky.of_weather(weather(), "2026-03-20T02:00")
    with pytest.raises(quasilux.InputError, match="^<bytes>:1:1"):
        sky.of_weather(b"nothing", "2026-03-20T12:30")
    with pytest.raises(FileNotFoundError):
        sky.of_weather(tmp_path / "none.epw", "2026-03-20T12:30")
    with pytest.raises(quasilux.InputError, match="latitude_deg"):
        sky.Site(91, 0, 0)
    site = sky.Site(0, 0, 0)
    with pytest.raises(quasilux.InputError, match="1583 to 3000"):
        site.sun("1500-01-01T12:00")
    with pytest.raises(TypeError, match="time zone"):
        site.sun([datetime.datetime(2026, 6, 21, tzinfo=datetime.timezone.utc)])
    with pytest.raises(TypeError, match="expected datetime64"):
        site.sun([1.0])
    with pytest.raises(ValueError, match="is not a time"):
        site.sun(np.datetime64("NaT"))
