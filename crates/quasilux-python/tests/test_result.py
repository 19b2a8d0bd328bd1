"""Results: arrays, documents, tables, plots, files, and how they show themselves."""

from __future__ import annotations

import dataclasses
import json
import math
import pickle
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from rooms import LIGHT, command_line, example, room, same_bits

import quasilux
from quasilux import Figure, _native

POINTS = {"kind": "points", "points": [[2, 1.5, 0.8], [1, 1, 1]], "normals": [[0, 0, 1]] * 2}
BOARD = {
    "kind": "grid",
    "origin": [0.1, 1, 0.5],
    "u": [0, 1.2, 0],
    "v": [0, 0, 1],
    "counts": [3, 2],
    "normal": [1, 0, 0],
    "target_lx": 40,
}
CAMERA = {
    "name": "view",
    "position": [0.2, 0.2, 1.6],
    "target": [4, 3, 1],
    "vertical_fov_deg": 60,
    "resolution": [24, 16],
    "samples": 2,
}


@pytest.fixture(scope="module")
def scene() -> quasilux.Scene:
    return room(sensors={"board": BOARD, "desks": POINTS}, cameras=[CAMERA], name="room")


def test_points_say_what_they_wait_for(scene: quasilux.Scene) -> None:
    done = quasilux.simulate(scene, rel_tol=0.1)["board"].status
    assert done is not None and done.shape == (2, 3) and set(done.flat) == {"done"}
    few = quasilux.simulate(scene, rel_tol=0.1, samples=16)["desks"].status
    assert few is not None and "done" not in set(few.flat)


@pytest.fixture(scope="module")
def result(scene: quasilux.Scene) -> quasilux.Result:
    return quasilux.simulate(scene, rel_tol=0.05)


def test_a_result_is_a_mapping_of_sensors(result: quasilux.Result) -> None:
    assert list(result) == ["board", "desks"] and len(result) == 2
    assert "board" in result and "view" not in result
    assert dict(result.items())["desks"] is result["desks"]
    assert result.get("none") is None
    with pytest.raises(KeyError, match="no sensor 'none'; there are 'board', 'desks'"):
        result["none"]
    assert list(result.cameras) == ["view"]
    assert result == result and result != 3 and {result: 1}[result] == 1


def test_arrays_have_the_shape_of_their_sensor(result: quasilux.Result) -> None:
    for name, shape in (("board", (2, 3)), ("desks", (2,))):
        sensor = result[name]
        assert sensor.shape == shape
        for array in (sensor.illuminance_lx, sensor.half_width_lx, sensor.direct_lx):
            assert array.shape == shape and array.dtype == np.float64
            assert not array.flags.writeable and array.flags.c_contiguous
        for array in (sensor.unseen_lx, sensor.merged_lx, sensor.disc_radius_m):
            assert array.shape == shape and array.dtype == np.float64
        assert sensor.replicates_lx.shape == (16, *shape)
        assert sensor.positions_m.shape == sensor.normals.shape == (*shape, 3)
        assert sensor.samples.shape == shape and sensor.samples.max() <= result.samples
        assert sensor.illuminance_lx is sensor.illuminance_lx
    board = result["board"]
    assert np.allclose(board.positions_m[1, 2], [0.1, 2.0, 1.25])
    assert np.array_equal(board.normals, np.broadcast_to([1.0, 0, 0], (2, 3, 3)))


def test_values_are_means_of_replicates_within_their_intervals(result: quasilux.Result) -> None:
    for sensor in result.values():
        means = sensor.replicates_lx.mean(0)
        assert np.allclose(sensor.illuminance_lx, means, rtol=1e-12)
        errors = sensor.replicates_lx.std(0, ddof=1) / 4
        # Wider than the plain interval, for the run looked more than once; by far less than twice.
        assert (sensor.half_width_lx > 2.13 * errors).all()
        assert (sensor.half_width_lx < 5.0 * errors + 1e-9).all()
        assert (sensor.half_width_lx <= 0.05 * sensor.illuminance_lx).all()
        assert (sensor.direct_lx < sensor.illuminance_lx).all()
    # I cos / r^2 of the point light, at the desk below it and at the one beside it.
    square = [0 + 0 + 1.4**2, 1 + 0.5**2 + 1.2**2]
    direct = [300 * height / r2**1.5 for height, r2 in zip((1.4, 1.2), square, strict=True)]
    assert np.allclose(result["desks"].direct_lx, direct, rtol=1e-7)


def test_summaries_have_intervals(result: quasilux.Result) -> None:
    board = result["board"]
    assert board.average.value == pytest.approx(board.illuminance_lx.mean(), rel=1e-12)
    assert board.minimum.value <= board.average.value <= board.maximum.value
    assert float(board.uniformity) == pytest.approx(board.minimum.value / board.average.value, 0.1)
    assert 0 < board.average.half_width < board.half_width_lx.max()
    assert repr(board.average) in str(result)


def test_figures_print_the_digits_that_they_have() -> None:
    assert repr(Figure(531.4812, 0.36)) == "531.5 ± 0.4"
    assert repr(Figure(531.4812, math.nan)) == "531.5" and repr(Figure(math.nan, 1.0)) == "-"
    figure = Figure(531.4812, 0.36)
    assert f"{figure}" == str(figure) == "531.5 ± 0.4" and f"{figure:.2f}" == "531.48"
    assert float(Figure(2.5, 0.1)) == 2.5 and math.sqrt(Figure(4.0, 0.1)) == 2.0


def test_the_run_is_described(result: quasilux.Result, scene: quasilux.Scene) -> None:
    assert result.tolerance_reached and result.stopped is None and not result.biased
    assert result.samples >= 128 and result.rays > 0 and result.seconds > 0
    assert result.replicates == 16 and result.warnings == () == result.caveats == result.findings
    assert result.settings["rel_tol"] == 0.05 and result.settings["estimator"] == "auto"
    document = result.to_dict()
    assert document["format"] == "quasilux-result/1"
    assert document["run"]["scene_sha256"] == scene.sha256
    assert json.loads(result.to_json()) == document
    document["sensors"].clear()
    assert len(result.to_dict()["sensors"]) == 2


def test_estimators_without_a_bound_say_nothing_of_what_is_unseen() -> None:
    paths = quasilux.simulate(room(), samples=16, estimator="path", unseen_tol="off")
    desk = paths["desk"]
    assert np.isnan(desk.unseen_lx).all() and np.isnan(desk.merged_lx).all()
    assert math.isnan(desk.average.unseen_lx) and math.isnan(desk.uniformity.unseen_lx)
    assert paths.settings["unseen_tol"] == "off" and paths.cannot_see == ()
    run = paths.to_dict()["run"]
    assert run["unseen_confidence"] == 0.95 and run["cannot_see"] == []
    photons = quasilux.simulate(room(), samples=16, estimator="photon")
    assert len(photons.cannot_see) == 1 and photons.settings["unseen_tol"] == 0.05


def test_certified_limits_are_there_where_they_are_asked_for() -> None:
    plain = quasilux.simulate(room(), samples=16)
    assert np.isnan(plain["desk"].certified_lower_lx).all()
    assert math.isnan(plain["desk"].average.certified_lower_lx)
    both = quasilux.simulate(room(), samples=16, interval="certified", sequence="random")
    desk = both["desk"]
    assert (desk.certified_lower_lx < desk.illuminance_lx).all()
    assert (desk.certified_upper_lx > desk.illuminance_lx).all()
    assert desk.average.certified_lower_lx < desk.average.value < desk.average.certified_upper_lx
    assert both.settings["interval"] == "certified"
    lower = quasilux.simulate(room(), samples=16, interval="certified")["desk"]
    assert (lower.certified_lower_lx > 0).all() and np.isinf(lower.certified_upper_lx).all()
    assert math.isnan(lower.average.certified_upper_lx)


def test_values_that_are_unknown_are_not_numbers() -> None:
    few = quasilux.simulate(room(), samples=1, estimator="photon")
    desk = few["desk"]
    assert np.isnan(desk.half_width_lx).any() and not np.isnan(desk.illuminance_lx).any()
    entries = few.to_dict()["sensors"][0]["points"]
    assert [point["half_width_lx"] is None for point in entries] == list(
        np.isnan(desk.half_width_lx).ravel()
    )
    (caveat,) = (caveat for caveat in few.caveats if caveat.kind == "no_interval")
    assert caveat.figures["points"] >= np.isnan(desk.half_width_lx).sum()
    assert str(caveat) == caveat.message and caveat.message in few.warnings


def test_cameras_have_pictures(result: quasilux.Result) -> None:
    view = result.cameras["view"]
    assert view.resolution == (24, 16) and view.samples == 2 and view.tolerance_reached
    assert view.luminance_cd_m2.shape == view.half_width_cd_m2.shape == (16, 24)
    assert view.unseen_cd_m2.shape == (16, 24) and (view.unseen_cd_m2 >= 0).all()
    assert view.rgb_cd_m2.shape == (16, 24, 3) and view.rgb_cd_m2.dtype == np.float32
    weights = np.array([0.2126, 0.7152, 0.0722], np.float32)
    assert np.allclose(view.rgb_cd_m2 @ weights, view.luminance_cd_m2, rtol=1e-4)
    assert view.mean.value == pytest.approx(view.luminance_cd_m2.mean(dtype=float), rel=1e-5)
    assert view.png().startswith(b"\x89PNG") and view.exr()[:4] == bytes([0x76, 0x2F, 0x31, 0x01])
    assert not view.luminance_cd_m2.flags.writeable and "24 x 16 pixels" in repr(view)


def test_stopped_runs_may_lack_pictures(scene: quasilux.Scene) -> None:
    def stop(progress: quasilux.Progress) -> bool:
        return progress.is_checkpoint or progress.camera is not None

    result = quasilux.simulate(scene, rel_tol=1e-6, progress=stop)
    view = result.cameras["view"]
    assert result.stopped == "callback" and view.samples in (0, 1, 2)
    assert np.isnan(view.luminance_cd_m2).all() == (view.samples == 0)
    assert view.luminance_cd_m2.shape == (16, 24)
    if not view.samples:
        assert view._repr_png_() is None
        with pytest.raises(ValueError, match="stopped before 'view' had a picture"):
            view.png()


def test_datasets_have_dimensions_and_units(result: quasilux.Result) -> None:
    xarray = pytest.importorskip("xarray")
    board = result["board"].to_xarray()
    assert isinstance(board, xarray.Dataset) and board.illuminance.dims == ("v", "u")
    assert board.replicates.dims == ("replicate", "v", "u")
    assert np.array_equal(board.illuminance, result["board"].illuminance_lx)
    assert np.allclose(board.u, [0.2, 0.6, 1.0]) and np.allclose(board.v, [0.25, 0.75])
    assert np.allclose(board.y.sel(v=0.25), 1 + board.u) and board.u.attrs["units"] == "m"
    assert {board[name].attrs["units"] for name in board} == {"lx"}
    assert board.attrs["sensor"] == "board" and board.attrs["seed"] == 1
    both = result.to_xarray()
    assert np.array_equal(both.board, board.illuminance) and both.desks.dims == ("desks_point",)
    assert np.array_equal(both.desks_half_width, result["desks"].half_width_lx)
    assert float(both.desks_x.sel(desks_point=1)) == 1.0


def test_datasets_do_not_mix_sensors_up() -> None:
    pytest.importorskip("xarray")
    names = {"desk": POINTS, "desk_half_width": POINTS}
    result = quasilux.simulate(room(sensors=names), samples=1)
    with pytest.raises(ValueError, match="desk_half_width"):
        result.to_xarray()


def test_tables_have_a_row_for_each_point(result: quasilux.Result) -> None:
    pandas = pytest.importorskip("pandas")
    table = result.to_pandas()
    assert isinstance(table, pandas.DataFrame) and len(table) == 8
    board = table[table.sensor == "board"]
    assert list(board.i) == [0, 1, 2, 0, 1, 2] and list(board.j) == [0, 0, 0, 1, 1, 1]
    assert np.array_equal(board.illuminance_lx, result["board"].illuminance_lx.ravel())
    assert np.array_equal(board[["x_m", "y_m", "z_m"]], result["board"].positions_m.reshape(-1, 3))
    desks = result["desks"].to_pandas()
    assert desks.i.isna().all() and list(desks.columns) == list(table.columns)
    assert (table[["nx", "ny", "nz"]] ** 2).sum(axis=1).eq(1.0).all()


def test_plots_have_the_colours_of_the_pictures(result: quasilux.Result) -> None:
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    from matplotlib import pyplot

    axes = result.plot()
    assert axes.get_title() == "board"
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("y (m)", "z (m)")
    assert np.allclose([*axes.get_xlim(), *axes.get_ylim()], [1.0, 2.2, 0.5, 1.5])
    mesh = axes.collections[0]
    assert np.allclose(mesh.get_array(), result["board"].illuminance_lx)  # type: ignore[arg-type]
    scale = _native.false_colour_scale(
        result["board"].illuminance_lx, result["board"].half_width_lx
    )
    assert (mesh.norm.vmin, mesh.norm.vmax) == (scale["low"], scale["high"])
    assert np.allclose(mesh.cmap([0.0, 1.0])[:, :3], _native.false_colour_map(2))
    figure, both = pyplot.subplots(1, 2)
    assert result.plot("desks", both[0]) is both[0]
    heights = [bar.get_height() for bar in both[0].patches]
    assert np.allclose(heights, result["desks"].illuminance_lx)
    options: dict[str, Any] = {"value": "direct_lx", "numbers": True, "colorbar": False}
    result["board"].plot(both[1], contours=False, **options)
    assert len(both[1].texts) == 6 and len(both[1].collections) == 1
    result["board"].plot(value="half_width_lx")
    view = result.cameras["view"]
    norm = view.plot().images[0].norm
    scale = _native.luminance_scale(view.luminance_cd_m2)
    high = scale["high"]
    assert (norm.vmin, norm.vmax) == (scale["low"], high)
    # A number 1, 2 or 5 times a power of ten, just above the brightest pixel.
    brightest = float(view.luminance_cd_m2.max())
    assert brightest <= high < 2.51 * brightest
    assert f"{high:.0e}"[0] in "125" and math.isclose(high, float(f"{high:.0e}"))
    figure.canvas.draw()
    with pytest.raises(ValueError, match="value is 'lx'"):
        result["board"].plot(value="lx")
    pyplot.close("all")


def test_contour_lines_are_labelled_with_their_unit() -> None:
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    from matplotlib import pyplot

    desk = {
        "kind": "grid",
        "origin": [0.2, 0.2, 0.8],
        "u": [3.6, 0, 0],
        "v": [0, 2.6, 0],
        "counts": [12, 9],
        "normal": [0, 0, 1],
        "target_lx": 170,
    }
    result = quasilux.simulate(room(sensors={"desk": desk}), samples=64)
    axes = result.plot()
    texts = {text.get_text() for text in axes.texts}
    assert "170 lx" in texts and len(texts) > 2 and all(text.endswith(" lx") for text in texts)
    assert len(axes.collections) == 3
    pyplot.close("all")


@pytest.mark.parametrize("module", ["xarray", "pandas", "matplotlib"])
def test_what_is_missing_is_named_with_what_to_install(
    result: quasilux.Result, module: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, module, None)
    call = {"xarray": result.to_xarray, "pandas": result.to_pandas, "matplotlib": result.plot}
    extra = "plot" if module == "matplotlib" else "tables"
    with pytest.raises(ImportError, match=rf"needs {module}: pip install 'quasilux\[{extra}\]'"):
        call[module]()


def test_files_are_those_of_the_command_line(
    result: quasilux.Result, scene: quasilux.Scene, tmp_path: Path
) -> None:
    scene.save(tmp_path / "room.scene")
    command_line("run", "room.scene", "--rel-tol=0.05", "--out=theirs", "--quiet", cwd=tmp_path)
    result.save(tmp_path / "ours")
    names = sorted(path.name for path in (tmp_path / "ours").iterdir())
    assert names == sorted(path.name for path in (tmp_path / "theirs").iterdir())
    assert {"board.png", "board.csv", "desks.csv", "view.exr", "result.json"} <= set(names)
    for name in set(names) - {"result.json"}:
        assert (tmp_path / "ours" / name).read_bytes() == (tmp_path / "theirs" / name).read_bytes()
    assert result._repr_png_() == (tmp_path / "ours" / "board.png").read_bytes()
    assert result["desks"]._repr_png_() is None
    with pytest.raises(OSError, match="cannot write"):
        result.save(tmp_path / "room.scene")


def test_pickled_results_are_the_same(result: quasilux.Result, tmp_path: Path) -> None:
    again = pickle.loads(pickle.dumps(pickle.loads(pickle.dumps(result))))
    assert same_bits(again, result) and again.to_json() == result.to_json()
    assert str(again) == str(result) and again.settings == result.settings
    assert again["board"].grid == result["board"].grid and again["desks"].grid is None
    assert not again["board"].illuminance_lx.flags.writeable
    view = again.cameras["view"]
    assert np.array_equal(view.luminance_cd_m2, result.cameras["view"].luminance_cd_m2)
    result.save(tmp_path / "ours")
    again.save(tmp_path / "again")
    for path in (tmp_path / "ours").iterdir():
        assert path.read_bytes() == (tmp_path / "again" / path.name).read_bytes()
    assert again._repr_png_() == result._repr_png_()
    sensor = pickle.loads(pickle.dumps(result["board"]))
    assert np.array_equal(sensor.illuminance_lx, result["board"].illuminance_lx)
    assert pickle.loads(pickle.dumps(view)).name == "view"
    average = result["board"].average
    copy = pickle.loads(pickle.dumps(average))
    assert copy.unseen_lx > 0.0 and copy == average and hash(copy) == hash(average)
    assert copy != dataclasses.replace(average, unseen_lx=0.0) and copy != average.value
    unbounded = dataclasses.replace(average, unseen_lx=math.nan)
    copy = pickle.loads(pickle.dumps(unbounded))
    assert math.isnan(copy.unseen_lx) and copy == unbounded and hash(copy) == hash(unbounded)


def test_results_show_themselves(result: quasilux.Result) -> None:
    assert repr(result).startswith("<quasilux.Result of board, desks, view: ")
    assert "tolerance reached" in repr(result) and "2 points" in repr(result["desks"])
    table = str(result)
    assert table.splitlines()[0].split() == [
        "sensor",
        "points",
        "average",
        "unseen",
        "minimum",
        "maximum",
        "uniformity",
    ]
    html = result._repr_html_()
    assert f"<td {quasilux._html._LEFT}>{result['board'].average} lx</td>" in html
    assert html.count("<table>") == 2 and "data:image/png;base64," in html
    assert (result["board"]._repr_png_() or b"").startswith(b"\x89PNG")


def test_examples_say_what_they_promise() -> None:
    result = quasilux.simulate(example("diffuser"), rel_tol=0.01)
    assert (result["floor"].half_width_lx <= 0.01 * result["floor"].illuminance_lx).all()
    assert [name for name in result] == ["floor"] and LIGHT["kind"] == "point"


def test_figures_reckon_with_exact_numbers() -> None:
    figure = Figure(500.0, 4.0, 2.0, 490.0, 520.0)
    assert figure + 1 == 1 + figure == Figure(501.0, 4.0, 2.0, 491.0, 521.0)
    assert figure - 1 == Figure(499.0, 4.0, 2.0, 489.0, 519.0)
    assert 1000 - figure == Figure(500.0, 4.0, 2.0, 480.0, 510.0)
    assert figure * 2 == 2 * figure == Figure(1000.0, 8.0, 4.0, 980.0, 1040.0)
    assert figure / 2 == Figure(250.0, 2.0, 1.0, 245.0, 260.0)
    assert -figure == Figure(-500.0, 4.0, 2.0, -520.0, -490.0)
    others: tuple[Any, ...] = (figure, "1")
    for other in others:
        with pytest.raises(TypeError):
            _ = figure + other


def test_a_sensor_is_an_array_of_illuminances(result: quasilux.Result) -> None:
    board = result["board"]
    assert np.array_equal(np.asarray(board), board.illuminance_lx)
    assert np.asarray(board, dtype=np.float32).dtype == np.float32
    assert np.array(board).shape == (2, 3) and float(np.asarray(board).mean()) > 0.0
