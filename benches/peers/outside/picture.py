"""Error against time of a year."""

from pathlib import Path

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402

from contest.picture import COLOURS  # noqa: E402
from outside.results import YearResult  # noqa: E402
from outside.years import QUASILUX, families  # noqa: E402


def draw(year: YearResult, path: Path) -> None:
    """Noise as full lines, what two-phase hours are off dashed; both axes logarithmic."""
    plt.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": "year", "font.size": 10})
    figure, axes = plt.subplots(figsize=(6.0, 4.0), layout="constrained")
    for family, levels in families(year.levels).items():
        is_quasilux = family == QUASILUX
        colour = COLOURS["quasilux" if is_quasilux else "Radiance"]
        marker = "s" if family.endswith("0.1/ad") else "o"
        seconds = [level.cpu_seconds for level in levels]
        own = [100 * level.errors.to_own for level in levels]
        axes.plot(seconds, own, marker + "-", ms=4, color=colour, label=f"{family}, noise")
        if not is_quasilux:
            off = [100 * level.errors.to_other for level in levels]
            label = f"{family}, from quasilux"
            axes.plot(seconds, off, marker + "--", ms=4, color=colour, label=label)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel("time of the processor, s")
    axes.set_ylabel("error by point and hour, % (r.m.s.)")
    axes.grid(True, which="both", lw=0.3, color="#dddddd")
    axes.legend(frameon=False, fontsize=8)
    figure.savefig(path, metadata={"Date": None})
    plt.close(figure)
