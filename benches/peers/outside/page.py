"""docs/daylight-comparison.md: moments and a year in words."""

from contest.markdown import document, table
from outside.moments import Compared, Distance
from outside.results import Machine, Results, YearResult
from outside.years import QUASILUX, RCONTRIB, Level, seconds_to

HEAD = """# Daylight against Radiance

    python3 benches/peers/daylight.py --weather site.epw

The same rooms with windows, under the same skies, through quasilux and Radiance: moments by
`rtrace`, a year by the two-phase method. `benches/peers/README.md` says what to install. This
page is written by the command; any EPW file does.
"""

MOMENTS = """## Moments
A room of 4 m x 6 m x 3 m with a window of 3 m x 1.6 m to the south and 12 sensors. Under the
overcast sky of CIE type 1 with 10 000 lx, and the clear one of type 12 with 12 000 lx and a sun
of 60 000 lx across its rays, 40 degrees high, as a disk of 0.533 degrees. Radiance has the sky by
a formula of `benches/peers`, not by `gensky`, whose constants are rounded; the ground is a
uniform glow in both.

- **Glass.** Radiance's `glass` of transmissivity 0.96; quasilux has a table by angle that
`benches/peers/outside/glass.py` computes by Fresnel's equations for a pane of index 1.52.

- **Blinds.** A Klems matrix, made up in `outside/blinds.py`, given to both as the same XML: light
between the slats goes straight on in its patch, the rest is scattered. The diffuser has no such
peak.

- **rtrace** has no ambient cache and cuts nothing off; sensors are asked again and again, which
gives its own error. Its options:

    rtrace -h -I -aa 0 -as 0 -ab 100 -ad 4096 -lr -100 -lw 1/4096 -dt 0 -dc 1 -dj 1 -st 0 -ss 1

- **quasilux** is `quasilux run --rel-tol 0.3%`, or what a minute gives.

Radiance less quasilux, in % of quasilux. The errors of each are standard errors of a sensor in
the mean; z is a difference of a sensor over its joint standard error, about 1 (r.m.s.) where
programs agree.
"""

BLACK = """### Who is right about blinds
Between black walls the answer is a sum over patches and the window's points, which
`outside/quadrature.py` makes without either program. Both from there, in %:
"""

REASONS = """Through glass the programs agree. quasilux agrees with the sums: it takes patches
as they are, constant with sharp edges. Radiance shifts the direction of view of each look-up by
chance, by about the size of a patch (`bsdf_jitter` in its `m_bsdf.c`), so that edges are blurred:
sensors at the rim of what the sun's patch lights get more or less, and a few thousandths of the
light of the sky are lost. Neither is what blinds do: no matrix knows its edges so well.
"""

YEAR = """## A year
An office of 6 m x 8 m x 2.8 m with a window of 5.4 m x 1.6 m to the south, glass of
transmissivity 0.8, and 96 sensors. The weather is that of {place}, the same file for both.
quasilux is `quasilux annual`, everything counted. The two-phase method is `rcontrib` with
Reinhart's 2305 patches of the sky (MF 4), `gendaymtx -m 4` and the product of the two, all
counted; the product is made in numpy, faster than by `dctimestep`. `rcontrib` has `-ab 12 -lr
-100`.

Errors are root mean squares over points and hours of the difference over what is right. {lit}
hours count: those in which the sky gives 1000 lx and the sun is 3 degrees up. What is right is
the mean of long years of the same program ("own": noise), or of the other one. The noise that is
left in these ({quasilux_noise} and {rcontrib_noise}) is taken off. The last columns: sums over
the year less quasilux's, and the share of sensors that have 300 lx in half of the hours from 8 to
18 (sDA).

The time is that of the processor, on all cores, in the median of {rounds} rounds in which the
programs took turns; in brackets, by the clock.
"""

CHECK = """Long years of both are {between} apart in all hours, and {sunless} in the
{sunless_hours} hours without sun, of which {noise} is noise of rcontrib: there each confirms the
other. Where the sun shines the difference is the method's: `gendaymtx` puts the sun onto the four
nearest patches, some 3 degrees wide each, and its formula for the place of the sun is a coarser
one. No number of divisions mends that. In the sums over the year it is {annual}.
"""


def write(results: Results) -> str:
    """The whole page."""
    lit = [row for row in results.moments if row.quasilux_from_sums is None]
    dark = [row for row in results.moments if row.quasilux_from_sums is not None]
    parts = [HEAD, MOMENTS, _measured(results.machine), _moments(lit), BLACK, _black(dark), REASONS]
    if results.year and results.year_machine:
        parts += _year(results.year, _measured(results.year_machine))
    return document(parts)


def _measured(machine: Machine) -> str:
    return (
        f"Measured {machine.date} on {machine.cores} cores of {machine.processor}; other work"
        f" made a load of {machine.load_before:.1f} before it began. quasilux {machine.quasilux},"
        f" Radiance {machine.radiance}.\n"
    )


def _moments(rows: list[Compared]) -> str:
    head = ["window and sky", "mean, lx", "difference of the mean", "r.m.s. z"]
    head += ["sensor furthest off", "error of quasilux"]
    head += ["of Radiance", "quasilux, s", "Radiance, s"]
    lines = []
    for row in rows:
        apart = row.radiance_from_quasilux
        furthest = f"{100 * apart.largest_share:+.2f} (z {apart.largest_z:.1f})"
        errors = [f"{100 * x:.2f}" for x in (row.quasilux_error, row.radiance_error)]
        seconds = [f"{x:.0f}" for x in (row.quasilux_cpu_seconds, row.radiance_cpu_seconds)]
        said = [_share(apart), f"{apart.rms_z:.2f}", furthest, *errors, *seconds]
        lines.append([row.name, f"{row.mean_lx:.0f}", *said])
    return table(head, lines)


def _black(rows: list[Compared]) -> str:
    head = ["window and sky", "quasilux, mean", "r.m.s. z", "furthest off"]
    head += ["Radiance, mean", "r.m.s. z", "furthest off"]
    lines = []
    for row in rows:
        cells = [row.name]
        for apart in (row.quasilux_from_sums, row.radiance_from_sums):
            if apart:
                furthest = f"{100 * apart.largest_share:+.2f} (z {apart.largest_z:.1f})"
                cells += [_share(apart), f"{apart.rms_z:.2f}", furthest]
        lines.append(cells)
    return table(head, lines)


def _share(apart: Distance) -> str:
    return f"{100 * apart.share:+.2f} ± {100 * apart.standard_error:.2f}"


def _year(year: YearResult, measured: str) -> list[str]:
    between = year.between
    text = YEAR.format(
        place=year.place,
        lit=year.lit_hours,
        quasilux_noise=_percent(year.quasilux_noise),
        rcontrib_noise=_percent(year.rcontrib_noise),
        rounds=year.rounds,
    )
    check = CHECK.format(
        between=_percent(between.to_other),
        sunless=_percent(between.to_other_sunless),
        sunless_hours=year.sunless_hours,
        noise=_percent(year.rcontrib_sunless_noise),
        annual=f"{100 * between.annual_share:+.2f} %",
    )
    head = ["program", "setting", "time, s", "error, own", "error, other"]
    head += ["without sun, own", "without sun, other", "annual sum", "sDA"]
    figure = "![Error against time of a year](daylight/year.svg)\n"
    rows = [_level(level) for level in year.levels]
    return [text, measured, table(head, rows), figure, check, _ratios(year)]


def _level(level: Level) -> list[str]:
    errors = level.errors
    shares = [errors.to_own, errors.to_other, errors.to_own_sunless, errors.to_other_sunless]
    seconds = f"{level.cpu_seconds:.1f} ({level.wall_seconds:.1f})"
    ends = [f"{100 * errors.annual_share:+.2f} %", _percent(errors.sda)]
    return [level.key.program, level.key.setting, seconds, *map(_percent, shares), *ends]


def _ratios(year: YearResult) -> str:
    own = [level for level in year.levels if level.key.program == QUASILUX]
    rows = []
    for level in own:
        noise = level.errors.to_own
        seconds = seconds_to(noise, year.levels)
        ratio = f"{seconds / level.cpu_seconds:.1f}"
        rows.append([_percent(noise), f"{level.cpu_seconds:.1f}", f"{seconds:.0f}", ratio])
    text = (
        "## Speed at equal error\nTime of the processor until the noise alone is as small, in the"
        f" better of {RCONTRIB}'s two families, interpolated, or drawn out at the rate of random"
        " points. The sun on its patches is not counted against it here: from the sun in its place"
        " its hours stay as far off as the table above says, however long it runs.\n"
    )
    return text + "\n" + table(["noise", "quasilux, s", "rcontrib, s", "ratio"], rows)


def _percent(share: float) -> str:
    return f"{100 * share:.2g} %" if share < 0.1 else f"{100 * share:.0f} %"
