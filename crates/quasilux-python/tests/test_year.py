"""Years: files of the command line, hours and measures as arrays, blinds, and who stops them."""

from __future__ import annotations

import _thread
import pickle
import threading
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from rooms import command_line, comparable, room
from years import LIT_HOURS, schedule, terrace

import quasilux

FEW: dict[str, Any] = {"rel_tol": 0.1, "abs_tol_lx": 10.0, "samples": 64}
BLINDS = {
    "materials": {"sheet": {"reflectance": 0, "transmittance": 0.5}},
    "control": "schedule",
    "schedule": schedule([hour != 12 for hour in range(48)]),
    "column": "roof",
}
LAMPS = {"sensor": "roof", "target_lx": 500, "power_w": 100}


@pytest.fixture(scope="module")
def scene() -> quasilux.Scene:
    return terrace(blinds=BLINDS, electric_light=LAMPS)


@pytest.fixture(scope="module")
def year(scene: quasilux.Scene) -> quasilux.Year:
    return quasilux.annual(scene, occupied_h=(8, 18.0), **FEW)


def test_files_are_those_of_the_command_line(
    scene: quasilux.Scene, year: quasilux.Year, tmp_path: Path
) -> None:
    scene.save(tmp_path / "terrace.toml")
    words = ["--rel-tol=0.1", "--abs-tol=10", "--samples=64", "--occupied=8-18", "--quiet"]
    run = command_line("annual", tmp_path / "terrace.toml", *words, "--out", tmp_path / "theirs")
    assert run.returncode == (0 if year.tolerance_reached else 3), run.stderr
    year.save(tmp_path / "ours")
    names = sorted(path.name for path in (tmp_path / "theirs").iterdir())
    assert names == sorted(path.name for path in (tmp_path / "ours").iterdir())
    assert {"annual.json", "hours.npy", "roof.annual.csv", "roof.hours.png"} < set(names)
    for name in names:
        theirs, ours = ((tmp_path / folder / name).read_bytes() for folder in ("theirs", "ours"))
        if name.endswith(".json"):
            assert comparable(ours.decode()) == comparable(theirs.decode())
        else:
            assert ours == theirs, name
    hours = np.load(tmp_path / "theirs" / "hours.npy")
    assert np.array_equal(hours[:6, 0].reshape(3, 2, 48), year["roof"].illuminance_lx)
    assert np.array_equal(hours[6:, 1], year["middle"].half_width_lx)
    table = np.genfromtxt(tmp_path / "theirs" / "roof.annual.csv", delimiter=",", names=True)
    assert np.array_equal(table["daylight_autonomy"], np.ravel(year["roof"].daylight_autonomy))
    assert year["roof"].to_csv() == (tmp_path / "theirs" / "roof.annual.csv").read_text()
    assert year.to_csv() == (tmp_path / "theirs" / "hours.csv").read_text()


def test_a_year_is_a_mapping_of_sensors(year: quasilux.Year) -> None:
    assert list(year) == ["roof", "middle"] and len(year) == 2
    with pytest.raises(KeyError, match="no sensor 'none'; there are 'roof', 'middle'"):
        year["none"]
    roof = year["roof"]
    for array in (roof.illuminance_lx, roof.half_width_lx):
        assert array.shape == (3, 2, 48) and array.dtype == np.float32
        assert not array.flags.writeable
    assert year["middle"].illuminance_lx.shape == (1, 48) and np.asarray(roof).shape == (3, 2, 48)
    for name in ("daylight_autonomy", "udi_too_much", "exposure_lx_h", "median_daylight_lx"):
        measure = getattr(roof, name)
        assert measure.value.shape == measure.half_width.shape == measure.shape == (3, 2)
        expected = [point[name] for point in year.to_dict()["sensors"][0]["points"]]
        assert np.array_equal(measure.value.ravel(), expected)
        assert not measure.value.flags.writeable
    # In each of the rooms that blinds make.
    assert roof.samples.max() <= 2 * 64 and roof.relative_half_width.shape == (3, 2)
    assert roof.sunlit_h.shape == (3, 2) and roof.positions_m.shape == (6, 3)
    summary = year.to_dict()["sensors"][0]["summary"]
    assert roof.sda == quasilux.ShareOfPoints(**summary["sda"]) and roof.en17037 is None
    assert roof.ase.low <= roof.ase.value <= roof.ase.high
    assert "sDA" in str(year) and repr(year).startswith("<quasilux.Year of roof, middle: 48 hours")
    assert "2 x 3 points, 48 hours" in repr(roof)
    assert (year._repr_png_() or b"").startswith(b"\x89PNG")


def test_hours_are_those_of_the_weather(year: quasilux.Year) -> None:
    calendar = year.calendar
    assert len(calendar) == 48 and set(calendar.month) == {3} and year.interval_h == 1.0
    assert list(calendar.day[[0, 24]]) == [20, 21] and calendar.middle_h[12] == 12.5
    lit = np.flatnonzero(calendar.sky_horizontal_lx > 0)
    assert list(lit) == LIT_HOURS and np.isnan(calendar.sky_horizontal_lx[0])
    assert calendar.is_occupied.sum() == 2 * 10 and calendar.is_daylit.sum() == 24
    assert not calendar.day.flags.writeable and year.site["latitude_deg"] == 37.72
    assert year.thresholds["enough_lx"] == 300.0
    # By the schedule the sheet takes half of the light of all hours but that of noon.
    blinds = year.blinds["blinds"]
    assert blinds.positions == ("open", "closed")
    assert list(blinds.position[LIT_HOURS]) == [1, 0, 1] and blinds.position[0] == -1
    sun_lx = 60_000 * np.sin(np.radians(calendar.sun_altitude_deg[12]))
    expected = np.array([4500, 12_000 + sun_lx, 125])
    lx = year["middle"].illuminance_lx[0, LIT_HOURS]
    assert np.allclose(lx, expected, rtol=0.1)
    assert (abs(lx - expected) <= 3 * year["middle"].half_width_lx[0, LIT_HOURS] + 1).all()


def test_lamps_have_their_energy(year: quasilux.Year, scene: quasilux.Scene) -> None:
    zone = year.lamps["electric_light"]
    assert zone.sensor == "roof" and zone.full_power_kwh == pytest.approx(2.0)
    assert year.energy_kwh == zone.energy_kwh
    # Of 20 hours two need none, and one three quarters.
    assert float(zone.energy_kwh) == pytest.approx(1.7 + 0.075, abs=0.01)
    assert quasilux.annual(terrace(), **FEW).energy_kwh is None


def test_no_bit_depends_on_threads(scene: quasilux.Scene, year: quasilux.Year) -> None:
    one = quasilux.annual(scene, threads=1, occupied_h=(8, 18.0), **FEW)
    assert np.array_equal(one["roof"].illuminance_lx, year["roof"].illuminance_lx)
    other = quasilux.annual(scene, seed=2, **FEW)
    assert not np.array_equal(other["roof"].illuminance_lx, year["roof"].illuminance_lx)


def test_years_are_pickled(year: quasilux.Year) -> None:
    again = pickle.loads(pickle.dumps(year))
    assert again.to_json() == year.to_json() and str(again) == str(year)
    assert np.array_equal(again["roof"].half_width_lx, year["roof"].half_width_lx)
    assert not again.calendar.day.flags.writeable


def test_a_callback_hears_of_a_year_and_stops_it(scene: quasilux.Scene) -> None:
    told: list[quasilux.YearProgress] = []

    def watch(progress: quasilux.YearProgress) -> None:
        told.append(progress)

    quasilux.annual(scene, progress=watch, **FEW)
    assert told and 0.0 <= told[0].done <= 1.0 and "% done" in repr(told[0])
    stopped = quasilux.annual(scene, progress=lambda progress: True, **LONG)
    assert not stopped.complete and not stopped.tolerance_reached
    assert np.isnan(stopped["roof"].illuminance_lx).all() and "stopped" in repr(stopped)
    assert np.isnan(stopped["roof"].daylight_autonomy.value).all()

    def fail(progress: quasilux.YearProgress) -> None:
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        quasilux.annual(scene, progress=fail, **LONG)


LONG: dict[str, Any] = {"rel_tol": 1e-6, "abs_tol_lx": 1e-6, "samples": 1 << 30}


def test_ctrl_c_ends_a_year(scene: quasilux.Scene) -> None:
    timer = threading.Timer(0.3, _thread.interrupt_main)
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        quasilux.annual(scene, **LONG)
    timer.join()


def test_progress_of_a_year_is_shown(
    scene: quasilux.Scene, capfd: pytest.CaptureFixture[str]
) -> None:
    from quasilux import _progress

    lines: list[str] = []
    quasilux.annual(scene, progress=lambda it: lines.append(_progress.line(it)), **FEW)
    assert "% of the year" in lines[0]
    quasilux.annual(scene, progress=True, **FEW)
    assert capfd.readouterr().out == ""


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"rel_tol": 0}, "^rel_tol is"),
        ({"abs_tol_lx": -1.0}, "^abs_tol_lx is"),
        ({"occupied_h": (18, 8)}, '^occupied_h is "18-8"; expected hours of a day'),
        ({"samples": 0}, "^samples is"),
    ],
)
def test_values_that_make_no_sense_are_refused(options: dict[str, Any], message: str) -> None:
    with pytest.raises(quasilux.InputError, match=message):
        quasilux.annual(terrace(), **options)


def test_scenes_without_a_year_are_refused() -> None:
    with pytest.raises(quasilux.InputError, match="no weather; add"):
        quasilux.annual(room())
    for bad in ("8-18", (8,), 8):
        with pytest.raises(TypeError, match="expected two numbers"):
            quasilux.annual(terrace(), occupied_h=bad)  # type: ignore[arg-type]


def test_what_is_outside_is_named_in_errors() -> None:
    for changes, message in (
        ({"sky": {"model": "clear"}}, r'^sky\["model"\]'),
        ({"weather": {"file": b"nothing"}}, "weather.epw"),
        ({"annual": {"enough_lx": -1}}, r'^annual\["enough_lx"\]'),
        ({"blinds": {"materials": {"none": {"reflectance": 0.5}}}}, "blinds"),
    ):
        with pytest.raises(quasilux.InputError, match=message):
            terrace(**changes)
