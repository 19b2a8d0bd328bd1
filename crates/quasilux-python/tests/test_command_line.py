"""The program in the wheel: the same commands, output and exit codes."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from rooms import ROOM_TOML, command_line, room_obj, write_room

import quasilux


def test_it_tells_its_version() -> None:
    run = command_line("--version")
    version, commit, kernel = run.stdout.splitlines()
    assert (run.returncode, version) == (0, f"quasilux {quasilux.__version__}")
    assert commit.startswith("commit: ") and kernel.startswith("ray kernel: ")


def test_a_project_is_run(tmp_path: Path) -> None:
    write_room(tmp_path)
    run = command_line("run", "room.toml", "--rel-tol=5%", cwd=tmp_path)
    assert run.returncode == 0 and run.stdout.startswith("sensor ")
    assert run.stdout.endswith("results in out/room\n".replace("/", os.sep))
    document = json.loads((tmp_path / "out" / "room" / "result.json").read_text())
    assert document["run"]["tolerance_reached"]
    limited = command_line("run", "room.toml", "--samples=16", "--json", cwd=tmp_path)
    assert limited.returncode == 3 and json.loads(limited.stdout)["run"]["samples"] == 16


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["run", "room.toml", "--rel-tol", "x"], '--rel-tol is "x"; expected a share'),
        (["run", "none.toml"], "none.toml: "),
        (["run", "bad.toml"], 'bad.toml:2:1: unknown key "geometri" in [scene]'),
        (["rum"], 'unknown command "rum"'),
    ],
)
def test_what_is_wrong_ends_with_code_2(tmp_path: Path, words: list[str], said: str) -> None:
    write_room(tmp_path)
    (tmp_path / "bad.toml").write_text(ROOM_TOML.replace("geometry", "geometri"))
    run = command_line(*words, cwd=tmp_path)
    assert run.returncode == 2 and run.stderr.startswith("error: ") and said in run.stderr
    assert "Traceback" not in run.stderr


def test_other_commands_are_there(tmp_path: Path) -> None:
    write_room(tmp_path)
    check = command_line("check", "room.toml", "--json", cwd=tmp_path)
    assert check.returncode == 0 and json.loads(check.stdout)["format"] == "quasilux-check/1"
    assert room_obj().count("\nf ") == 12


@pytest.mark.skipif(sys.platform == "win32", reason="there is no SIGINT to send")
def test_ctrl_c_writes_the_results_of_the_last_checkpoint(tmp_path: Path) -> None:
    write_room(tmp_path)
    words = ["run", "room.toml", "--rel-tol=1e-7", "--estimator=path", "--checkpoint=run.ck"]
    command = [sys.executable, "-m", "quasilux._command_line", *words, "--checkpoint-every=0.1"]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    with subprocess.Popen(command, cwd=tmp_path, env=environment, stdout=-1, stderr=-1) as child:
        end = time.monotonic() + 60
        while not (tmp_path / "run.ck").exists() and time.monotonic() < end:
            time.sleep(0.05)
        child.send_signal(signal.SIGINT)
        child.communicate(timeout=120)
    assert child.returncode == 130
    assert (tmp_path / "out" / "room" / "result.json").exists()
    assert quasilux.resume(tmp_path / "run.ck", progress=lambda p: True).stopped == "callback"
