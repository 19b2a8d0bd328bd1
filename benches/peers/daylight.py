"""Runs rooms with windows through quasilux and Radiance, and writes docs/daylight-comparison.md.

    python3 benches/peers/daylight.py --weather site.epw
    python3 benches/peers/daylight.py --page
"""

import argparse
import datetime
import os
import sys
import tempfile
from pathlib import Path

from contest.machine import processor
from contest.programs.quasilux import BUILT_HERE, REPOSITORY, Quasilux
from contest.programs.radiance import Radiance
from outside import contests, page, picture, results
from outside.moments import Effort
from outside.results import Machine, Results

DOCS = REPOSITORY / "docs"
MEASURED = DOCS / "daylight/measured.json"


def main() -> int:
    """Does what the arguments say."""
    options = _options()
    if not options.page:
        _measure(options)
    found = results.load(MEASURED)
    if found.year:
        picture.draw(found.year, MEASURED.parent / "year.svg")
    (DOCS / "daylight-comparison.md").write_text(page.write(found))
    _say(f"wrote {DOCS / 'daylight-comparison.md'}")
    return 0


def _measure(options: argparse.Namespace) -> None:
    """Saves moments before the year begins: both take long."""
    programs = [Quasilux("quasilux", "auto", options.binary), Radiance()]
    for program in programs:
        if reason := program.missing():
            sys.exit(f"{program.name} is missing: {reason}")
    today = datetime.date.today().isoformat()
    versions = [program.version() for program in programs]
    load_before = os.getloadavg()[0]
    machine = Machine(processor(), os.cpu_count() or 1, load_before, today, *versions)
    before = results.load(MEASURED) if MEASURED.exists() else None
    with tempfile.TemporaryDirectory() as folder:
        if options.only == "year" and before:
            found = before
        else:
            effort = Effort(options.rel_tol, options.seconds)
            moments = contests.moments(options.binary, effort, Path(folder), _say)
            year, year_machine = (before.year, before.year_machine) if before else (None, None)
            found = Results(machine, moments, year, year_machine)
        results.save(found, MEASURED)
        if options.weather:
            contest = contests.YearContest(options.binary, options.weather.resolve(), _say)
            year = contest.run(options.rounds, options.years, Path(folder))
            results.save(Results(found.machine, found.moments, year, machine), MEASURED)


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--weather", type=Path, help="an EPW file; without it no year is measured")
    parser.add_argument("--only", choices=["year"], help="keep the figures of moments")
    parser.add_argument("--rel-tol", type=float, default=0.003, help="of quasilux in a moment")
    parser.add_argument("--seconds", type=float, default=60.0, help="of each program in a moment")
    parser.add_argument("--rounds", type=int, default=3, help="of the year")
    parser.add_argument("--years", type=int, default=16, help="long ones of rcontrib")
    parser.add_argument("--binary", type=Path, default=BUILT_HERE, help="another build of quasilux")
    parser.add_argument("--page", action="store_true", help="only write the page again")
    return parser.parse_args()


def _say(line: str) -> None:
    print(line, flush=True)


if __name__ == "__main__":
    sys.exit(main())
