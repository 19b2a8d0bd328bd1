"""The long runs behind references."""

import tempfile
import time
from pathlib import Path

from contest import references
from contest.programs.mitsuba import LANES, Mitsuba
from contest.programs.quasilux import Quasilux
from contest.references import Reference, Side
from contest.room import Room

BATCHES = 16


def make(room: Room, quasilux: Quasilux, seconds: float, command: str) -> Reference:
    """Runs both programs for some `seconds` each and stores what they say."""
    with tempfile.TemporaryDirectory() as folder:
        sides = [_mitsuba(room, seconds), _quasilux(room, quasilux, seconds, Path(folder))]
    return references.save(room, sides, command)


def _mitsuba(room: Room, seconds: float) -> Side:
    program = Mitsuba()
    reason = program.missing() or program.cannot(room)
    if reason:
        raise RuntimeError(f"no reference without Mitsuba: {reason}")
    loaded = program.load(room, Path("."))
    samples = LANES // len(room.sensors)
    batches = []
    begin = time.perf_counter()
    while len(batches) < BATCHES or time.perf_counter() - begin < seconds:
        batches.append(loaded.batch_lx(samples, 2**31 + len(batches)))
    loaded.close()
    how = f"path, independent sampler, {len(batches)} batches of {samples} paths a sensor"
    return references.side(f"Mitsuba {program.version()}", how, batches)


def _quasilux(room: Room, program: Quasilux, seconds: float, folder: Path) -> Side:
    loaded = program.load(room, folder)
    first = loaded.random_paths(128, seed=1000)
    samples = 128
    while samples * first.seconds / 128 < seconds / BATCHES / 1.5:
        samples *= 2
    batches = [
        loaded.random_paths(samples, seed=1001 + i).illuminances_lx for i in range(BATCHES)
    ]
    how = f"path --sequence random --samples {samples}, {BATCHES} seeds of 16 replicates"
    return references.side(f"quasilux {program.version()}", how, batches)
