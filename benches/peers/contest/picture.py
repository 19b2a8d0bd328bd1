"""Error against time, one picture a room."""

from pathlib import Path

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402

from contest.results import RoomResult  # noqa: E402

COLOURS = {
    "quasilux": "#1f6fb4",
    "quasilux path": "#7fb2dd",
    "Mitsuba": "#d1495b",
    "Radiance": "#3a8f5c",
    "LuxCore": "#c98a1b",
}


def draw(room: RoomResult, path: Path) -> None:
    """Both axes logarithmic; the goals are dashed, the reference's own error is dotted."""
    plt.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": room.name, "font.size": 10})
    figure, axes = plt.subplots(figsize=(6.0, 4.0), layout="constrained")
    for line in room.lines:
        if line.points:
            seconds = [point.seconds for point in line.points]
            errors = [100 * point.error for point in line.points]
            colour = COLOURS.get(line.program, "black")
            axes.plot(seconds, errors, "o-", ms=4, color=colour, label=line.program)
    for goal in room.goals:
        axes.axhline(100 * goal, color="black", lw=0.8, ls="--")
    axes.axhline(100 * room.reference_error, color="grey", lw=0.8, ls=":")
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel("time, s")
    axes.set_ylabel("error, % (relative L2)")
    axes.set_title(room.title)
    axes.grid(True, which="both", lw=0.3, color="#dddddd")
    axes.legend(frameon=False)
    figure.savefig(path, metadata={"Date": None})
    plt.close(figure)
