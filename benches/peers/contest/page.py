"""docs/comparison.md: tables of a sweep in words."""

import math

from contest.curves import Found
from contest.errors import Deviation
from contest.markdown import document, table
from contest.results import Line, Results, RoomResult

FIRST = "quasilux"

HEAD = """# Against other programs

    python3 benches/peers/compare.py

The same rooms through quasilux, Mitsuba 3, Radiance and LuxCore: illuminances in lux at the same
sensor points, and how long each program takes until they are right. `benches/peers/README.md` says
what to install; a program that is missing is left out. This page is written by the command.
"""

PROGRAMS = [
    [
        "quasilux",
        "`quasilux run --samples N --rel-tol 0.1%`, `N` makes the effort",
        "everything: start-up, loading, checks, surveys, error bars, files",
    ],
    ["quasilux path", "the same with `--estimator path`", "everything"],
    [
        "Mitsuba",
        "`path`, `independent` sampler, `llvm_ad_mono`; rays look at white tiles of 2 mm at the"
        " sensors",
        "a run on the loaded scene, after one that compiled (listed below)",
    ],
    [
        "Radiance",
        "`rtrace -I -n`, no ambient cache (`-aa 0 -as 0 -ab 100 -dt 0 -dc 1 -lr -100 -lw 1/ad`);"
        " `-ad` makes the effort, with panels (`-dj 1 -ds 0.1 -ad 256`) repetitions of the sensors",
        "`rtrace` with reading the octree; not `oconv`, `ies2rad`, `obj2mesh`",
    ],
    [
        "LuxCore",
        "`BAKECPU` onto white tiles of 2 mm, `SOBOL` sampler, up to 100 bounces",
        "from start to end of a session on the loaded scene, its ray structure included",
    ],
]

METHOD = """## What is measured
An error is the Euclidean norm of the differences at all sensors over that of the reference. Each
program runs at rising levels of effort; all take turns, in {rounds} rounds with different seeds.
A level has the median of its times and the root of the mean of its squared errors, from which the
variance of the reference is taken off; between levels time is interpolated in logarithms. Runs
that would
take over some {cap:g} s are not made: `~` means drawn out from the last level at the rate of random
points (four times the work for half the error), `<` that the least effort was enough. In
brackets: the time over that of quasilux.

{programs}
Luminaires are points with the intensities of their IES file in all programs: quasilux
and LuxCore read the file, Radiance by `ies2rad -i`. Mitsuba reads none: an emitter of
`benches/peers` looks the same table up, and chooses among luminaires as Mitsuba chooses among
emitters.
"""

BOUND = """## What the bound on unseen light costs

In the tables above nothing waits for the bound on light that no sample met. Here every point of the
same rooms is known to a half-width of 1 % (`--rel-tol 1% --unseen-tol off`), and then, as by
default, to 5 % of unseen light too: seconds from start to end, and the largest bound over value
that is left. Other programs state neither.
"""

AGREEMENT = """## Do they compute the same room?
By how much the average over all sensors differs from the reference's, in %, at the highest level of
effort, with the joint standard error of both. **Bold**: more than three standard errors and more
than 0.1 %; such a program is biased here (or its input means something else), and its curve is not
drawn out. Radiance leaves out what panes mirror of lamps.
"""

REFERENCES = """## References
Each is the mean of two plain path tracers that share no code, with random points: Mitsuba's `path`
and quasilux's `path --sequence random`, weighted by their variances. `benches/peers/references/`
has them, with numbers of paths and the command that makes them again:

    python3 benches/peers/compare.py --references

"between the two" is the difference of their averages with its standard error; z is the root of the
mean of the squared differences at the sensors in units of their standard errors (1 is chance; 16
batches make it 1.07).
"""


def write(results: Results) -> str:
    """The whole page."""
    machine = results.machine
    versions = ", ".join(f"{name} {version}" for name, version in machine.versions.items())
    parts = [
        HEAD,
        f"Measured {machine.date} on {machine.cores} cores of {machine.processor}; other work made a"
        f" load of {machine.load_before:.1f} before it began. {versions}.\n",
        *_times(results),
        METHOD.format(
            rounds=machine.rounds,
            cap=machine.cap_seconds,
            programs=table(["program", "how it runs", "what its time holds"], PROGRAMS),
        ),
        _warm_ups(results),
        BOUND,
        _bounds(results),
        AGREEMENT,
        _agreement(results),
        REFERENCES,
        _references(results),
        "## Pictures\nDashed: the goal. Dotted: the standard error of the reference.\n",
        *[f"![{room.title}](comparison/{room.name}.svg)\n" for room in results.rooms],
    ]
    return document(parts)


def _times(results: Results) -> list[str]:
    goals = sorted({goal for room in results.rooms for goal in room.goals}, reverse=True)
    parts = []
    for goal in goals:
        rooms = [room for room in results.rooms if goal in room.goals]
        names = [line.program for line in rooms[0].lines]
        rows = [_row(room, goal) for room in rooms]
        head = ["room", "triangles", "lights", "sensors", *names]
        parts.append(f"## Time to an error of {100 * goal:.1g} %\n")
        parts.append(table(head, rows))
    return [*parts, _faster(results)]


def _faster(results: Results) -> str:
    """Where a peer is ahead, in so many words."""
    said = []
    for room in results.rooms:
        own = next((line for line in room.lines if line.program == FIRST), None)
        for goal in room.goals if own else []:
            base = own.time_to(goal).seconds
            for line in room.lines:
                ratio = line.time_to(goal).seconds / base
                if not line.program.startswith(FIRST) and ratio < 1:
                    said.append(f"{line.program} in {room.name} to {100 * goal:.1g} %")
    if not said:
        return "In none of these is a peer faster than quasilux.\n"
    return f"Faster than quasilux: {', '.join(said)}.\n"


def _row(room: RoomResult, goal: float) -> list[str]:
    first = next((line for line in room.lines if line.program == FIRST), None)
    base = first.time_to(goal).seconds if first else math.inf
    counts = [f"{room.triangles:,}".replace(",", " "), str(room.lights), str(room.sensors)]
    return [room.title, *counts, *[_cell(line, goal, base) for line in room.lines]]


def _cell(line: Line, goal: float, base: float) -> str:
    if line.cannot is not None:
        return "cannot"
    reached = line.time_to(goal)
    if reached.found is Found.NEVER:
        least = min(point.error for point in line.points)
        return f"not reached ({100 * least:.1f} %)"
    sign = {Found.BEFORE: "< ", Found.BEYOND: "~ "}.get(reached.found, "")
    said = f"{sign}{_figures(reached.seconds)} s"
    if line.program == FIRST or math.isinf(base):
        return said
    return f"{said} ({_figures(reached.seconds / base)})"


def _warm_ups(results: Results) -> str:
    said = [
        f"{room.name} {_figures(line.warm_up_seconds)} s"
        for room in results.rooms
        for line in room.lines
        if line.warm_up_seconds is not None
    ]
    if not said:
        return ""
    return (
        f"Loading and compiling in Mitsuba, not counted above: {', '.join(said)}. Kernels that an"
        " earlier run compiled come from a cache on disk.\n"
    )


def _bounds(results: Results) -> str:
    rows = [
        [
            room.title,
            f"{_figures(it.seconds_without)} s",
            f"{_figures(100 * it.unseen_without)} %",
            f"{_figures(it.seconds_with)} s",
            f"{_figures(100 * it.unseen_with)} %",
        ]
        for room in results.rooms
        if (it := room.bound)
    ]
    return table(["room", "half-width alone", "unseen", "with the bound", "unseen"], rows)


def _agreement(results: Results) -> str:
    names = [line.program for line in results.rooms[0].lines]
    rows = []
    for room in results.rooms:
        cells = []
        for line in room.lines:
            if line.deviation is None:
                cells.append(line.cannot or "-")
            else:
                said = _percent(line.deviation)
                cells.append(said if line.agrees() else f"**{said}**")
        rows.append([room.title, *cells])
    return table(["room", *names], rows)


def _references(results: Results) -> str:
    rows = [
        [
            room.title,
            f"{100 * room.reference_error:.2g} %",
            f"{_percent(room.reference_deviation)} %",
            f"{room.reference_rms_z:.2f}",
        ]
        for room in results.rooms
    ]
    return table(["room", "standard error (L2)", "between the two", "z"], rows)


def _percent(share: Deviation) -> str:
    return f"{100 * share.share:+.2f} ± {100 * share.standard_error:.2f}"


def _figures(value: float) -> str:
    """Two digits, without an exponent."""
    if value >= 10:
        return f"{value:.0f}"
    return f"{value:.2g}"
