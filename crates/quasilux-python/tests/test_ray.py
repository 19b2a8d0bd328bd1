"""Runs on a local cluster of Ray: the bits of one process, whatever is killed."""

from __future__ import annotations

import os
import re
import signal
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

os.environ["RAY_AUTH_MODE"] = "disabled"
os.environ["RAY_ACCEL_ENV_VAR_OVERRIDE_ON_ZERO"] = "0"

ray = pytest.importorskip("ray")

import quasilux  # noqa: E402
import quasilux.ray  # noqa: E402

ROOT = Path(os.environ.get("QUASILUX_ROOT", Path(__file__).parents[3]))
CUBE = ROOT / "examples/cube/cube.toml"
OFFICE = ROOT / "examples/office/office.toml"


@pytest.fixture(scope="module")
def cluster() -> Iterator[None]:
    ray.init(address="local", num_cpus=2, include_dashboard=False, log_to_driver=False)
    yield
    ray.shutdown()


def same_bits(one: quasilux.Result, other: quasilux.Result) -> bool:
    return list(one) == list(other) and all(
        np.array_equal(getattr(one[name], field), getattr(other[name], field), equal_nan=True)
        for name in one
        for field in ("illuminance_lx", "half_width_lx", "replicates_lx", "samples")
    )


def blocks_traced(caplog: pytest.LogCaptureFixture) -> int:
    """Blocks of all runs that the log tells of."""
    told = re.findall(r"done: (\d+) blocks traced", caplog.text)
    return sum(int(count) for count in told)


@pytest.mark.parametrize(
    ("estimator", "samples"),
    [("auto", 1 << 8), ("path", 1 << 9), ("photon", 1 << 17)],
)
def test_results_have_the_bits_of_one_process(
    cluster: None, caplog: pytest.LogCaptureFixture, estimator: Any, samples: int
) -> None:
    scene = quasilux.load(CUBE)
    options: dict[str, Any] = {"rel_tol": 1e-6, "seed": 3, "samples": samples}
    expected = quasilux.simulate(scene, estimator=estimator, **options)
    with caplog.at_level("INFO", logger="quasilux.ray"):
        result = quasilux.ray.simulate(scene, estimator=estimator, **options)
    assert same_bits(result, expected)
    assert result.rays == expected.rays
    assert blocks_traced(caplog) > 0


def test_scenes_of_arrays_are_shipped_whole(
    cluster: None, caplog: pytest.LogCaptureFixture
) -> None:
    side = 4.0
    corners = np.array([[x, y, z] for x in (0, side) for y in (0, side) for z in (0, side)])
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    triangles = [t for a, b, c, d in faces for t in ((a, b, c), (a, c, d))]
    scene = quasilux.Scene(
        vertices=corners,
        triangles=np.array(triangles),
        materials={"default": {"reflectance": 0.5}},
        lights=[{"kind": "point", "position": [2, 2, 3], "intensity_cd": 100.0}],
        sensors={
            "desk": {
                "kind": "grid", "origin": [0.5, 0.5, 0.8], "u": [3, 0, 0], "v": [0, 3, 0],
                "spacing": 0.2, "normal": [0, 0, 1],
            }
        },
    )
    expected = quasilux.simulate(scene, rel_tol=0.003)
    with caplog.at_level("INFO", logger="quasilux.ray"):
        assert same_bits(quasilux.ray.simulate(scene, rel_tol=0.003), expected)
    assert blocks_traced(caplog) > 0


def test_a_new_driver_goes_on_from_the_parts(cluster: None, tmp_path: Path) -> None:
    scene = quasilux.load(OFFICE)
    expected = quasilux.simulate(scene, rel_tol=0.01, estimator="path")

    class Stop(Exception):
        pass

    def stop_late(progress: quasilux.Progress) -> None:
        if progress.samples >= 256:
            raise Stop

    options: dict[str, Any] = {"rel_tol": 0.01, "estimator": "path", "directory": tmp_path}
    with pytest.raises(Stop):
        quasilux.ray.simulate(scene, progress=stop_late, **options)
    kept = sorted(tmp_path.rglob("*.block"))
    assert kept
    # One that is cut short and one that is changed are traced again.
    kept[0].write_bytes(kept[0].read_bytes()[:40])
    content = bytearray(kept[-1].read_bytes())
    content[-1] ^= 1
    kept[-1].write_bytes(content)
    times = {path: path.stat().st_mtime_ns for path in kept[1:-1]}
    assert same_bits(quasilux.ray.simulate(scene, **options), expected)
    assert all(path.stat().st_mtime_ns == time for path, time in times.items())
    assert not list(tmp_path.rglob(".new-*"))


def test_processes_that_are_killed_change_nothing(cluster: None) -> None:
    scene = quasilux.load(OFFICE)
    expected = quasilux.simulate(scene, rel_tol=0.008, estimator="path", seed=5)
    killed: list[int] = []

    def kill(progress: quasilux.Progress) -> None:
        for folder in Path("/proc").glob("[0-9]*"):
            try:
                name = (folder / "cmdline").read_bytes()
            except OSError:
                continue
            if name.startswith(b"ray::_trace") and len(killed) < 3:
                os.kill(int(folder.name), signal.SIGKILL)
                killed.append(int(folder.name))
                time.sleep(0.2)
                return

    result = quasilux.ray.simulate(
        scene, rel_tol=0.008, estimator="path", seed=5, progress=kill
    )
    assert killed and same_bits(result, expected)


def test_errors_of_workers_and_options_are_raised(cluster: None) -> None:
    scene = quasilux.load(CUBE)
    with pytest.raises(quasilux.InputError, match="estimator"):
        quasilux.ray.simulate(scene, estimator="magic")  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="num_cpus"):
        quasilux.ray.simulate(scene, num_cpus=0)


def test_progress_is_logged(cluster: None, caplog: pytest.LogCaptureFixture) -> None:
    with caplog.at_level("INFO", logger="quasilux.ray"):
        quasilux.ray.simulate(quasilux.load(CUBE), rel_tol=0.02, estimator="path")
    assert "checkpoint" in caplog.text and "done" in caplog.text
