"""Runs the same rooms through quasilux and its peers, and writes docs/comparison.md.

    python3 benches/peers/compare.py [--rooms cube,office] [--programs quasilux,Mitsuba]
    python3 benches/peers/compare.py --references [--rooms cube]
    python3 benches/peers/compare.py --page
"""

import argparse
import datetime
import os
import sys
import tempfile
from importlib import import_module
from pathlib import Path

from contest import bound, page, references, results
from contest.machine import processor
from contest.programs.luxcore import LuxCore
from contest.programs.mitsuba import Mitsuba
from contest.programs.program import Program
from contest.programs.quasilux import REPOSITORY, Quasilux
from contest.programs.radiance import Radiance
from contest.results import Machine, Results, RoomResult
from contest.room import Room
from contest.sweep import Effort, measure

ROOMS = ["cube", "office", "open_office", "mirror", "bend", "gallery", "glass", "canteen"]
GOALS = {"cube": [0.003, 0.001]}
DEFAULT_GOALS = [0.003]
DOCS = REPOSITORY / "docs"
MEASURED = DOCS / "comparison/measured.json"


def main() -> int:
    """Does what the arguments say."""
    options = _options()
    rooms = [_room(name) for name in options.rooms.split(",")]
    if options.page:
        _write_page(results.load(MEASURED))
        return 0
    if options.references:
        return _make_references(rooms, options)
    programs = _present(options)
    load_before = os.getloadavg()[0]
    effort = Effort(0.0, options.cap, options.rounds)
    found = []
    with tempfile.TemporaryDirectory() as folder:
        for room in rooms:
            goals = GOALS.get(room.name, DEFAULT_GOALS)
            reference = references.load(room)
            own = Effort(min(goals), effort.cap_seconds, effort.rounds)
            series = measure(room, reference, programs, own, Path(folder), _say)
            price = _price_of_bound(room, programs, Path(folder), options.rounds)
            found.append(results.room_result(room, goals, reference, series, price))
    measured = Results(_machine(programs, effort, load_before), _with_others(found))
    MEASURED.parent.mkdir(exist_ok=True)
    results.save(measured, MEASURED)
    _write_page(measured)
    return 0


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rooms", default=",".join(ROOMS), help="names, with commas")
    parser.add_argument("--programs", default="", help="names, with commas; all by default")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--cap", type=float, default=5.0, help="seconds of the longest runs")
    parser.add_argument("--binary", type=Path, help="another build of quasilux")
    parser.add_argument("--references", action="store_true", help="make the references again")
    parser.add_argument("--seconds", type=float, default=60.0, help="of a reference, a program")
    parser.add_argument("--page", action="store_true", help="only write the page again")
    return parser.parse_args()


def _programs(options: argparse.Namespace) -> list[Program]:
    binary = {"binary": options.binary.resolve()} if options.binary else {}
    quasilux = [
        Quasilux("quasilux", "auto", **binary),
        Quasilux("quasilux path", "path", **binary),
    ]
    return [*quasilux, Mitsuba(), Radiance(), LuxCore()]


def _present(options: argparse.Namespace) -> list[Program]:
    programs = []
    for program in _programs(options):
        if options.programs and program.name not in options.programs.split(","):
            continue
        reason = program.missing()
        if reason is None:
            programs.append(program)
        else:
            _say(f"{program.name} is left out: {reason}")
    return programs


def _make_references(rooms: list[Room], options: argparse.Namespace) -> int:
    from contest import long_runs

    quasilux = _programs(options)[0]
    agreed = True
    for room in rooms:
        command = f"python3 benches/peers/compare.py --references --rooms {room.name}"
        if options.seconds != 60.0:
            command += f" --seconds {options.seconds:g}"
        made = long_runs.make(room, quasilux, options.seconds, command)
        agreed &= made.agreement.holds()
        sides = made.agreement
        said = f"standard error {100 * made.error_l2:.3f} %, between the two "
        said += f"{100 * sides.deviation:+.3f} % ± {100 * sides.standard_error:.3f}"
        _say(f"{room.name}: {said}, z {sides.rms_z:.2f}{'' if sides.holds() else ': DISAGREE'}")
    return 0 if agreed else 1


def _with_others(found: list[RoomResult]) -> list[RoomResult]:
    """What was measured now, and before in rooms that are not among them."""
    kept = {room.name: room for room in results.load(MEASURED).rooms} if MEASURED.exists() else {}
    kept |= {room.name: room for room in found}
    return [kept[name] for name in ROOMS if name in kept]


def _room(name: str) -> Room:
    if name not in ROOMS:
        sys.exit(f"no room {name}; expected one of {', '.join(ROOMS)}")
    return import_module(f"contest.rooms.{name}").room()


def _price_of_bound(
    room: Room, programs: list[Program], folder: Path, rounds: int
) -> bound.Bound | None:
    own = next((program for program in programs if program.name == page.FIRST), None)
    return bound.measure(room, own, folder / room.name / "bound", rounds) if own else None


def _machine(programs: list[Program], effort: Effort, load_before: float) -> Machine:
    cores = os.cpu_count() or 1
    versions = {
        program.name: program.version() for program in programs if program.name != "quasilux path"
    }
    today = datetime.date.today().isoformat()
    return Machine(
        processor(), cores, load_before, today, effort.rounds, effort.cap_seconds, versions
    )


def _write_page(measured: Results) -> None:
    from contest import picture

    for room in measured.rooms:
        picture.draw(room, MEASURED.parent / f"{room.name}.svg")
    (DOCS / "comparison.md").write_text(page.write(measured))
    _say(f"wrote {DOCS / 'comparison.md'}")


def _say(line: str) -> None:
    print(line, flush=True)


if __name__ == "__main__":
    sys.exit(main())
