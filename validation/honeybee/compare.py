#!/usr/bin/env python3
"""A year of quasilux read by honeybee-radiance-postprocess: the same measures, of the same hours.

    python3 -m venv venv
    venv/bin/pip install honeybee-radiance "numpy<3"
    venv/bin/pip install --no-deps honeybee-radiance-postprocess==0.5.25
    venv/bin/python validation/honeybee/compare.py [MODEL.hbjson WEATHER.epw]

(`--no-deps` leaves out its library for graphics cards.) Without arguments the model is that of
`validation/scenes`, which has a dynamic group, in the weather of `examples/daylight-office`.

Daylight autonomy, useful daylight and ASE of every sensor, and the level of EN 17037 of every grid,
are compared. Groups move in the hours in which they moved in quasilux; with groups the hours are
sums of several simulations, and measures agree within their half-widths.
"""

import csv
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy as np
from honeybee_radiance_postprocess.dynamic import ApertureGroupSchedule, DynamicSchedule
from honeybee_radiance_postprocess.en17037 import en17037_to_folder
from honeybee_radiance_postprocess.results import AnnualDaylight

ROOT = pathlib.Path(__file__).resolve().parents[2]
MODEL = ROOT / "validation/scenes/two-rooms.hbjson"
WEATHER = ROOT / "examples/daylight-office/made-up.epw"
# Half-widths of differences are those of two measures; so much more is let pass, as a share.
ALLOWED = 1e-3


def simulate(model, weather, folder):
    command = ["cargo", "run", "--quiet", "--release", "--package", "quasilux", "--", "annual"]
    command += [str(model), "--weather", str(weather), "--rel-tol", "5%", "--quiet"]
    command += ["--out", str(folder / "year"), "--honeybee", str(folder / "honeybee")]
    subprocess.run(command, cwd=ROOT, check=True)


def schedules(hours):
    """Where groups are, hour by hour of the year."""
    states = DynamicSchedule()
    for column in hours[0]:
        name, _, kind = column.rpartition("_")
        if kind in ("position", "closed"):
            positions = [int(hour[column] or 0) for hour in hours]
            states.add_aperture_group_schedule(ApertureGroupSchedule(name, positions))
    states.add_aperture_group_schedule(
        ApertureGroupSchedule("__static_apertures__", [0], is_static=True)
    )
    return states


def daylit(hours):
    """The half of the year with most skylight (EN 17037), of equally bright hours the earlier."""
    sky = [float(hour["sky_horizontal_lx"] or 0) for hour in hours]
    chosen = sorted(range(len(sky)), key=lambda hour: (-sky[hour], hour))[: len(sky) // 2]
    schedule = np.zeros(len(sky), dtype=int)
    schedule[chosen] = 1
    return schedule.tolist()


def worst(name, theirs, points, keys, scale=1.0):
    """Compares a measure at all points; how many half-widths it is off at most."""
    ours = np.array([sum(point[key] for key in keys) for point in points])
    widths = np.array([sum(point[f"{key}_half_width"] for key in keys) for point in points])
    off = np.abs(np.asarray(theirs) * scale - ours)
    allowed = 2 * widths + ALLOWED * np.maximum(1, np.abs(ours))
    print(f"  {name}: {len(ours)} sensors, differences up to {off.max():.4f}, "
          f"half-widths up to {widths.max():.4f}")
    return bool(np.all(off <= allowed))


def main():
    model, weather = sys.argv[1:3] if len(sys.argv) == 3 else (MODEL, WEATHER)
    with tempfile.TemporaryDirectory() as place:
        folder = pathlib.Path(place)
        simulate(model, weather, folder)
        document = json.loads((folder / "year/annual.json").read_text())
        hours = list(csv.DictReader((folder / "year/hours.csv").open()))
        results = AnnualDaylight(str(folder / "honeybee/results"))
        states = schedules(hours)
        autonomy, grids = results.daylight_autonomy(threshold=300, states=states)
        useful, _ = results.useful_daylight_illuminance(min_t=100, max_t=3000, states=states)
        _, sunlit, _ = results.annual_sunlight_exposure(direct_threshold=1000, occ_hours=250)
        levels = en17037_to_folder(results, daylit(hours), states, sub_folder=folder / "en17037")
        agree = True
        sensors = {sensor["name"]: sensor for sensor in document["sensors"]}
        for number, grid in enumerate(grids):
            sensor = sensors[grid["full_id"]]
            points = sensor["points"]
            print(grid["full_id"])
            agree &= worst("daylight autonomy", autonomy[number], points, ["daylight_autonomy"], 0.01)
            keys = ["udi_supplementary", "udi_autonomous"]
            agree &= worst("useful daylight", useful[number], points, keys, 0.01)
            agree &= worst("sunlit hours", sunlit[number], points, ["sunlit_hours"])
            low, high = sensor["summary"]["en17037_level_bounds"]
            level = compliance(levels, grid["full_id"])
            print(f"  EN 17037: level {level}, ours from {low} to {high}")
            agree &= low <= level <= high
    print("all agree" if agree else "NOT ALL AGREE")
    sys.exit(0 if agree else 1)


def compliance(folder, grid):
    """The lower of the levels of both targets."""
    kinds = ("Minimum Illuminance", "Target Illuminance")
    files = [folder / "compliance_level" / kind / f"{grid}.pf" for kind in kinds]
    return int(min(np.loadtxt(file).min() for file in files))


if __name__ == "__main__":
    main()
