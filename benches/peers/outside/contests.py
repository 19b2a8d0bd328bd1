"""What is measured: which moments, which settings of a year, in which order."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from outside import rooms, years
from outside.annual import QuasiluxYears
from outside.blinds import Blinds
from outside.glass import Glass
from outside.hours import Calendar, Year
from outside.moments import Compared, Effort, Moment, compare
from outside.quadrature import black
from outside.results import YearResult
from outside.sky import Outside, Sun
from outside.two_phase import Setting, TwoPhase
from outside.years import QUASILUX, RCONTRIB, Key, Limits

OVERCAST = Outside("overcast sky", 1, 10000.0, Sun(60.0, 180.0))
SUNNY = Outside("clear sky with sun", 12, 12000.0, Sun(40.0, 200.0, 60000.0))

TOLERANCES = (0.08, 0.04, 0.02)
LONG_TOLERANCE = 0.001
LONG_YEARS = 2
"""Of quasilux: up to the most paths that a sensor gets, with other seeds."""

SETTINGS = [Setting(ad, weight) for weight in (1.0, 0.1) for ad in (1024, 4096, 16384)]
LONG_SETTING = Setting(16384, 0.2)
"""No setting of the contest: random numbers would be the same."""

Say = Callable[[str], None]


def moments(binary: Path, effort: Effort, folder: Path, say: Say) -> list[Compared]:
    """Glass, blinds and a diffuser, and blinds between black walls."""
    places = [rooms.small(filling) for filling in (Glass(0.96), Blinds(), Blinds(False))]
    cases = [Moment(place, outside) for place in places for outside in (OVERCAST, SUNNY)]
    cases += [
        Moment(black(place), outside) for place in places[1:] for outside in (OVERCAST, SUNNY)
    ]
    found = []
    for case in cases:
        own = folder / case.name.replace(" ", "_")
        own.mkdir()
        found.append(compare(case, binary, effort, own))
        apart = found[-1].radiance_from_quasilux
        said = f"{100 * apart.share:+.2f} % ± {100 * apart.standard_error:.2f}"
        say(f"{case.name}: Radiance {said}, z {apart.rms_z:.2f}")
    return found


@dataclass
class YearContest:
    """A year of the office under the weather of a file."""

    binary: Path
    weather: Path
    say: Say

    def run(self, rounds: int, long_years: int, folder: Path) -> YearResult:
        """Long years first, then settings of both, one after the other, in rounds."""
        place = rooms.office()
        own = [folder / name for name in (QUASILUX, RCONTRIB)]
        for path in own:
            path.mkdir()
        quasilux = QuasiluxYears(self.binary, place, self.weather, own[0])
        two_phase = TwoPhase(place, self.weather, own[1])
        right = [quasilux.year(LONG_TOLERANCE, 1000 + i).hours for i in range(LONG_YEARS)]
        calendar = quasilux.calendar()
        limits = Limits(
            years.limit(right, calendar),
            years.limit(two_phase.years(LONG_SETTING, long_years), calendar),
        )
        self.say(f"noise left: {limits.quasilux.noise:.2%}, {limits.rcontrib.noise:.2%}")
        runs: dict[Key, list[Year]] = {}
        for number in range(rounds):
            for tolerance in TOLERANCES:
                key = Key(QUASILUX, QUASILUX, f"--rel-tol {100 * tolerance:g}%")
                runs.setdefault(key, []).append(quasilux.year(tolerance, number + 1))
                for setting in SETTINGS[TOLERANCES.index(tolerance) :: len(TOLERANCES)]:
                    key = Key(RCONTRIB, setting.family, setting.name)
                    runs.setdefault(key, []).append(two_phase.year(setting))
        return self._result(runs, limits, calendar)

    def _result(
        self, runs: dict[Key, list[Year]], limits: Limits, calendar: Calendar
    ) -> YearResult:
        levels = [years.level(key, found, limits, calendar) for key, found in runs.items()]
        for level in levels:
            said = f"{level.cpu_seconds:.1f} s, to its own {level.errors.to_own:.2%}"
            self.say(f"{level.key.program} {level.key.setting}: {said}")
        return YearResult(
            place=self.weather.read_text(errors="replace").split(",")[1].strip(),
            rounds=len(next(iter(runs.values()))),
            lit_hours=int(calendar.is_lit.sum()),
            sunless_hours=int(calendar.is_sunless.sum()),
            quasilux_noise=limits.quasilux.noise,
            rcontrib_noise=limits.rcontrib.noise,
            rcontrib_sunless_noise=limits.rcontrib.sunless_noise,
            between=years.errors(RCONTRIB, [limits.rcontrib.hours], limits, calendar),
            levels=sorted(levels, key=lambda level: level.key.program),
        )
