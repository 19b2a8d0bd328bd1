"""Runs: the bits of the command line, callbacks, interrupts, checkpoints, threads and processes."""

from __future__ import annotations

import gc
import multiprocessing
import os
import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from rooms import (
    DESK,
    LIGHT,
    command_line,
    comparable,
    example,
    room,
    same_bits,
    write_room,
)
from years import terrace

import quasilux
from quasilux import Progress

FEW: dict[str, Any] = {"rel_tol": 0.05, "samples": 16}
LONG: dict[str, Any] = {"rel_tol": 1e-6, "estimator": "path"}


@pytest.mark.parametrize(
    ("name", "options"),
    [
        ("cube", {"rel_tol": 0.05, "seed": 7}),
        ("cube", {"rel_tol": 0.03, "abs_tol_lx": 20.0, "confidence": 0.99, "samples": 256}),
        ("cube", {"rel_tol": 0.03, "unseen_tol": "off", "samples": 64}),
        ("cube", {"rel_tol": 0.03, "unseen_tol": 0.02, "samples": 64}),
        ("cube", {"sequence": "hammersley", "samples": 64, "estimator": "photon"}),
        ("diffuser", {"rel_tol": 0.01, "tolerance_on": "summary"}),
        ("cornell", {"samples": 2, "estimator": "path"}),
        ("corridor", {"samples": 16}),
        ("office", {"rays": 1_000_000, "rel_tol": 0.3}),
    ],
)
def test_results_are_those_of_the_command_line(
    name: str, options: dict[str, Any], tmp_path: Path
) -> None:
    renamed = {"abs_tol_lx": "abs-tol"}
    words = [f"--{renamed.get(key, key).replace('_', '-')}={x}" for key, x in options.items()]
    out = tmp_path / "of_the_command_line"
    run = command_line("run", example(name), *words, "--quiet", "--out", out)
    result = quasilux.simulate(example(name), **options)
    assert run.returncode == (0 if result.tolerance_reached else 3), run.stderr
    assert comparable((out / "result.json").read_text()) == comparable(result.to_json())
    for sensor in result.values():
        table = np.genfromtxt(out / f"{sensor.name}.csv", delimiter=",", names=True)
        lx = ("illuminance_lx", "half_width_lx", "direct_lx", "unseen_lx", "merged_lx")
        for column in lx:
            ours = getattr(sensor, column).ravel()
            assert np.array_equal(ours, np.atleast_1d(table[column]), equal_nan=True)
    result.save(tmp_path / "ours")
    files = sorted(path.name for path in out.iterdir())
    assert files == sorted(path.name for path in (tmp_path / "ours").iterdir())
    for file in files:
        if not file.endswith(".json"):
            assert (out / file).read_bytes() == (tmp_path / "ours" / file).read_bytes(), file
    for path in map(Path, result.to_csv(tmp_path / "tables")):
        assert path.read_bytes() == (out / path.name).read_bytes()
        assert result[path.stem].to_csv() == path.read_text()


def test_no_bit_depends_on_threads() -> None:
    results = [quasilux.simulate(room(), threads=threads, **FEW) for threads in (1, 2, 3)]
    assert same_bits(results[0], results[1]) and same_bits(results[0], results[2])
    assert not same_bits(results[0], quasilux.simulate(room(), seed=2, **FEW))
    assert results[0].settings["seed"] == 1


def test_a_path_is_as_good_as_a_scene(tmp_path: Path) -> None:
    project = write_room(tmp_path)
    of_path = quasilux.simulate(project, **FEW)
    assert same_bits(of_path, quasilux.simulate(str(project), **FEW))
    assert same_bits(of_path, quasilux.simulate(quasilux.load(project), **FEW))
    assert same_bits(of_path, quasilux.simulate(room(simulation=FEW_IN_PROJECT), samples=16))


FEW_IN_PROJECT = {"rel_tol": "5%", "seed": 1, "map_elements": 4194304}


# Parameters.


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"rel_tol": 2}, "^rel_tol: 2 stands for 200 %: was 2 % meant"),
        ({"rel_tol": -0.1}, '^rel_tol is "-0.1"; expected a share above 0'),
        ({"rel_tol": float("nan")}, '^rel_tol is "nan"; expected a share'),
        ({"rel_tol": "much"}, '^rel_tol is "much"; expected a share'),
        ({"abs_tol_lx": 0.0}, "^abs_tol_lx is"),
        ({"unseen_tol": "much"}, '^unseen_tol is "much"; expected .* or off'),
        ({"unseen_tol": 2}, "^unseen_tol: 2 stands for 200 %"),
        ({"confidence": 1.0}, "^confidence is"),
        ({"samples": 0}, "^samples is"),
        ({"samples": 2**60}, "^samples is"),
        ({"rays": -1}, "^rays is"),
        ({"time_s": float("inf")}, "^time_s is"),
        ({"threads": 5000}, "^threads is"),
        ({"seed": -1}, "^seed is"),
        ({"estimator": "pat"}, 'estimator is "pat"; expected one of auto, .* did you mean "path"'),
        ({"sequence": "hammersley"}, "^sequence: hammersley needs .* give samples"),
        ({"tolerance_on": "all"}, "^tolerance_on is"),
        ({"interval": "sure"}, "^interval is"),
        ({"interval": "certified", "estimator": "path"}, 'interval = "certified" needs bounds'),
        ({"sequence": "hammersley", "samples": 64, "time_s": 1.0}, "time_s cannot end it before"),
        ({"checkpoint": "/"}, "is a folder, expected a file"),
        ({"checkpoint": "x", "checkpoint_every_s": 0.0}, "^checkpoint_every_s is"),
    ],
)
def test_values_that_make_no_sense_are_refused(options: dict[str, Any], message: str) -> None:
    with pytest.raises(quasilux.InputError, match=message):
        quasilux.simulate(room(), **options)


@pytest.mark.parametrize(
    "options",
    [
        {"rel_tol": True},
        {"rel_tol": [0.1]},
        {"samples": 1.5},
        {"samples": "16"},
        {"seed": True},
        {"time_s": "5"},
        {"estimator": 3},
        {"progress": 3},
        {"checkpoint": 3},
        {"unknown": 3},
    ],
)
def test_values_of_other_types_are_refused(options: dict[str, Any]) -> None:
    with pytest.raises(TypeError):
        quasilux.simulate(room(), **options)


def test_numbers_of_numpy_are_numbers() -> None:
    options = {"rel_tol": np.float32(0.25), "samples": np.int64(16), "seed": np.uint8(1)}
    result = quasilux.simulate(room(), **options)
    assert result.settings["rel_tol"] == 0.25
    percent = quasilux.simulate(room(), rel_tol="5%", confidence="90%", samples=16)
    assert (percent.settings["rel_tol"], percent.settings["confidence"]) == (0.05, 0.9)
    with pytest.raises(TypeError):
        quasilux.simulate(3)  # type: ignore[arg-type]


def test_a_strict_run_refuses_what_is_probably_wrong() -> None:
    odd = room(lights=[LIGHT, {**LIGHT, "position": [2, 1.5, 5.0]}])
    with pytest.raises(quasilux.InputError):
        quasilux.simulate(odd, strict=True, **FEW)
    result = quasilux.simulate(odd, **FEW)
    assert result.findings and any("lights[1]" in finding.file for finding in result.findings)


# Limits, progress and stopping.


def test_limits_are_told() -> None:
    assert quasilux.simulate(room(), **FEW).stopped == "limit"
    assert quasilux.simulate(room(), rel_tol=0.1).stopped is None
    result = quasilux.simulate(room(), time_s=0.05, **LONG)
    assert result.stopped == "time" and not result.tolerance_reached


def test_a_callback_hears_of_every_checkpoint() -> None:
    seen: list[Progress] = []
    threads = set()

    def hear(progress: Progress) -> None:
        seen.append(progress)
        threads.add(threading.get_ident())

    result = quasilux.simulate(room(), rel_tol=0.05, progress=hear)
    assert threads == {threading.get_ident()}
    checkpoints = [progress for progress in seen if progress.is_checkpoint]
    assert [progress.samples for progress in checkpoints] == sorted(
        {progress.samples for progress in checkpoints}
    )
    last = checkpoints[-1]
    assert last.samples == result.samples
    desk = result["desk"]
    assert np.array_equal(last.illuminance_lx["desk"], desk.illuminance_lx)
    assert np.array_equal(last.half_width_lx["desk"], desk.half_width_lx, equal_nan=True)
    assert np.array_equal(last.unseen_lx["desk"], desk.unseen_lx, equal_nan=True)
    shares = desk.half_width_lx / desk.illuminance_lx
    assert last.largest_relative_half_width == np.nanmax(shares)
    others = [progress for progress in seen if not progress.is_checkpoint]
    assert all(progress.illuminance_lx == {} for progress in others)
    assert all(0 <= (progress.done or 0) <= 1 for progress in seen) and "samples=" in repr(last)


@pytest.mark.parametrize("how", ["true", "raised", "numpy"])
def test_a_callback_ends_the_run_where_it_says(how: str) -> None:
    def stop(progress: Progress) -> object:
        if not progress.is_checkpoint or progress.samples < 64:
            return None
        if how == "raised":
            raise StopIteration
        return True if how == "true" else np.bool_(True)

    result = quasilux.simulate(room(), progress=stop, **LONG)
    assert (result.samples, result.stopped) == (64, "callback")
    assert result.tolerance_reached is False
    limited = quasilux.simulate(room(), samples=64, **LONG)
    assert np.array_equal(result["desk"].illuminance_lx, limited["desk"].illuminance_lx)


def test_what_a_callback_raises_is_raised() -> None:
    class Own(Exception):
        pass

    calls = 0

    def fail(progress: Progress) -> None:
        nonlocal calls
        calls += 1
        raise Own("here")

    start = time.monotonic()
    with pytest.raises(Own, match="here"):
        quasilux.simulate(room(), progress=fail, **LONG)
    assert calls == 1 and time.monotonic() - start < 60.0
    with pytest.raises(ValueError, match="ambiguous"):
        quasilux.simulate(room(), progress=lambda _: np.zeros(2), **FEW)


def test_a_callback_may_simulate() -> None:
    inner: list[quasilux.Result] = []

    def simulate(progress: Progress) -> bool:
        if progress.is_checkpoint and not inner:
            inner.append(quasilux.simulate(room(), **FEW))
        return False

    outer = quasilux.simulate(room(), progress=simulate, **FEW)
    assert same_bits(outer, inner[0])


def test_progress_is_shown_on_stderr(capfd: pytest.CaptureFixture[str]) -> None:
    quasilux.simulate(room(), progress=True, **FEW)
    quasilux.simulate(room(), **FEW)
    out, err = capfd.readouterr()
    # No line is due within seconds where stderr is no terminal.
    assert out == "" and err == ""
    from quasilux import _progress

    class Terminal:
        def __init__(self) -> None:
            self.text = ""

        def isatty(self) -> bool:
            return True

        def write(self, text: str) -> None:
            self.text += text

        def flush(self) -> None:
            pass

    terminal = Terminal()
    bar = _progress.Bar()
    bar._out, bar._changes = terminal, True  # type: ignore[assignment]
    with bar as show:
        quasilux.simulate(room(), progress=show, **FEW)
    assert "samples" in terminal.text and "rays/s" in terminal.text
    assert terminal.text.endswith(" \r") and "\n" not in terminal.text


def test_python_goes_on_while_light_is_simulated() -> None:
    counted = 0
    is_over = threading.Event()

    def count() -> None:
        nonlocal counted
        while not is_over.is_set():
            counted += 1
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    result = quasilux.simulate(room(), samples=1024, threads=1, **LONG)
    is_over.set()
    thread.join()
    assert counted > 100 * result.seconds


INTERRUPTED = """
import os, signal, sys, threading
sys.path[:0] = {path!r}
import quasilux
from rooms import room
reached = []
def hear(progress):
    if progress.is_checkpoint and progress.samples >= 64 and not reached:
        reached.append(progress.samples)
        print("at", progress.samples, flush=True)
        {send}
try:
    quasilux.simulate(room(), rel_tol=1e-6, estimator="path", progress=hear, checkpoint={kept!r})
except KeyboardInterrupt:
    print("interrupted", flush=True)
    sys.exit(130)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="there is no SIGINT to send")
@pytest.mark.parametrize("sender", ["itself", "another"])
def test_ctrl_c_ends_the_run_and_keeps_it(tmp_path: Path, sender: str) -> None:
    kept = tmp_path / "run.ck"
    send = "os.kill(os.getpid(), signal.SIGINT)" if sender == "itself" else "pass"
    code = INTERRUPTED.format(path=sys.path, send=send, kept=str(kept))
    with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True) as child:
        assert child.stdout is not None
        assert child.stdout.readline().startswith("at ")
        if sender == "another":
            os.kill(child.pid, signal.SIGINT)
        said, _ = child.communicate(timeout=120)
    assert (child.returncode, said) == (130, "interrupted\n")
    stopped = quasilux.resume(kept, progress=lambda p: p.is_checkpoint)
    whole = quasilux.simulate(room(), samples=stopped.samples, **LONG)
    assert np.array_equal(stopped["desk"].illuminance_lx, whole["desk"].illuminance_lx)


# Checkpoints.


def stop_at(samples: int) -> Any:
    return lambda progress: progress.is_checkpoint and progress.samples >= samples


@pytest.mark.parametrize("kind", ["file", "arrays"])
def test_a_run_goes_on_to_the_same_bits(tmp_path: Path, kind: str) -> None:
    scene = quasilux.load(write_room(tmp_path)) if kind == "file" else room()
    kept = tmp_path / "run.ck"
    whole = quasilux.simulate(scene, rel_tol=0.02)
    part = quasilux.simulate(scene, rel_tol=0.02, checkpoint=kept, progress=stop_at(32))
    assert part.samples == 32 and whole.samples > 32
    more = quasilux.resume(kept, progress=stop_at(64), checkpoint_every_s=0.001)
    assert (more.samples, more.stopped) == (64, "callback")
    result = quasilux.resume(kept, scene=scene, threads=1)
    assert same_bits(result, whole)
    document, expected = comparable(result.to_json()), comparable(whole.to_json())
    for each in (document, expected):
        each["run"].pop("earlier")
        each["run"].pop("rays")
        each["run"].pop("prediction")
    assert document == expected


def test_the_command_line_goes_on_with_a_run_of_python(tmp_path: Path) -> None:
    kept = tmp_path / "run.ck"
    whole = quasilux.simulate(room(), rel_tol=0.05)
    quasilux.simulate(room(), rel_tol=0.05, checkpoint=kept, progress=stop_at(32))
    run = command_line("resume", kept, "--quiet", "--out", tmp_path / "out", cwd=tmp_path)
    assert run.returncode == 0, run.stderr
    points = comparable((tmp_path / "out" / "result.json").read_text())["sensors"]
    assert points == comparable(whole.to_json())["sensors"]


def test_a_kept_run_is_not_lost(tmp_path: Path) -> None:
    kept = tmp_path / "run.ck"
    with pytest.raises(quasilux.InputError, match="no such|No such"):
        quasilux.resume(kept)
    quasilux.simulate(room(), rel_tol=0.05, checkpoint=kept, progress=stop_at(32))
    with pytest.raises(quasilux.InputError, match="keeps a run of"):
        quasilux.simulate(room(), rel_tol=0.05, checkpoint=kept)
    with pytest.raises(quasilux.InputError, match="is another scene now"):
        quasilux.resume(kept, scene=room(maintenance_factor=0.5))
    content = kept.read_bytes()
    kept.write_bytes(content[: len(content) // 2])
    kept.with_name("run.ck.previous").unlink(missing_ok=True)
    with pytest.raises(quasilux.InputError, match="cut short or changed"):
        quasilux.resume(kept)


def test_a_run_that_was_over_says_so(tmp_path: Path) -> None:
    kept = tmp_path / "run.ck"
    whole = quasilux.simulate(room(), checkpoint=kept, **FEW)
    with pytest.warns(RuntimeWarning, match="the run was over"):
        again = quasilux.resume(kept)
    assert same_bits(again, whole)


# Threads, processes, memory.


def seeded(seed: int) -> quasilux.Result:
    return quasilux.simulate(room(), seed=seed, **FEW)


def test_two_threads_simulate_at_once() -> None:
    expected = [seeded(seed) for seed in range(4)]
    with ThreadPoolExecutor(2) as pool:
        assert all(map(same_bits, pool.map(seeded, range(4)), expected))
        scene = room()
        ours = pool.map(lambda seed: quasilux.simulate(scene, seed=seed, **FEW), range(4))
        assert all(map(same_bits, ours, expected))


@pytest.mark.parametrize("method", ["spawn", "fork"])
def test_two_processes_simulate_at_once(method: str) -> None:
    if method not in multiprocessing.get_all_start_methods():
        pytest.skip(f"there is no {method} here")
    expected = [seeded(seed) for seed in range(4)]
    context = multiprocessing.get_context(method)
    with ProcessPoolExecutor(2, mp_context=context) as pool:
        assert all(map(same_bits, pool.map(seeded, range(4)), expected))


def all_that_computes(_: int) -> tuple[str, bytes, int]:
    """Calls that have threads: of a scene, a run, its pictures and a year."""
    result = quasilux.simulate(room(), **FEW)
    found = len(room().check())
    year = quasilux.annual(terrace(), samples=8)
    return year.to_csv(), result["desk"]._repr_png_() or b"", found


@pytest.mark.skipif(
    "fork" not in multiprocessing.get_all_start_methods(), reason="there is no fork here"
)
def test_a_process_that_has_computed_may_be_forked() -> None:
    expected = all_that_computes(0)
    context = multiprocessing.get_context("fork")
    with ProcessPoolExecutor(1, mp_context=context) as pool:
        assert pool.submit(all_that_computes, 1).result(timeout=120) == expected


def resident_bytes() -> int:
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


@pytest.mark.skipif(not os.path.exists("/proc/self/statm"), reason="memory is told by Linux")
def test_calls_leave_nothing_behind() -> None:
    one = {"kind": "points", "points": [[2, 1.5, 0.8]], "normals": [[0, 0, 1]]}

    def call() -> None:
        scene = room(sensors={"desk": DESK, "one": one}, lights=[LIGHT] * 3)
        options: dict[str, Any] = {"samples": 1, "estimator": "path", "threads": 1}
        result = quasilux.simulate(scene, progress=lambda p: False, **options)
        assert result["desk"].replicates_lx.shape == (16, 4, 6)

    def growth(count: int) -> int:
        before = resident_bytes()
        for _ in range(count):
            call()
        gc.collect()
        return resident_bytes() - before

    growth(60)
    # The allocator takes more now and then; what leaks does so every time. One of 2 kB a call would
    # show; benches/python/leak.py makes 10 000.
    assert min(growth(80) for _ in range(3)) < 80 * 2048
