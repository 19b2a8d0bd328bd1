"""Files of others, and what the command line says of files, for the tests of readers."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(os.environ.get("QUASILUX_ROOT") or Path(__file__).resolve().parents[3])
CORPUS = ROOT.parent / "shared/data"


def corpus(*patterns: str) -> list[Path]:
    """Files of others, which the repository does not hold."""
    if os.environ.get("QUASILUX_CORPUS") == "none":
        pytest.skip("left out without the corpus: QUASILUX_CORPUS is none")
    files = sorted(file for pattern in patterns for file in CORPUS.glob(pattern) if file.is_file())
    assert files, f"{CORPUS} is missing; QUASILUX_CORPUS=none leaves out the tests that read it"
    return files


def command_line(*words: str | Path, code: int = 0) -> bytes:
    """What the command line prints; it is another process, for it writes past `sys.stdout`."""
    command = [sys.executable, "-m", "quasilux._command_line", *map(str, words)]
    done = subprocess.run(command, capture_output=True, check=False)
    assert done.returncode == code, done.stderr.decode()
    return done.stdout


def warnings_of(thing: Any) -> list[dict[str, object]]:
    """The warnings of a luminaire or a surface, as the command line writes them."""
    return [
        {
            "rule": w.kind,
            "line": w.line,
            "column": w.column,
            "count": w.count,
            "message": w.message,
        }
        for w in thing.warnings
    ]
