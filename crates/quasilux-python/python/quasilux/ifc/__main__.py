"""The command line: ``python -m quasilux.ifc MODEL --out PROJECT``."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterable, Sequence

from quasilux import InputError
from quasilux.ifc._reading import load, survey


def main(words: Sequence[str] | None = None) -> int:
    """Import a model, or list what it has, and return the exit code."""
    parser = _parser()
    asked = parser.parse_args(words)
    if asked.out is None and not asked.list:
        parser.error("expected --out PROJECT or --list")
    try:
        if asked.list:
            found = survey(asked.model)
            _tell(str(finding) for finding in found.findings)
            print(found)
            return 0
        imported = load(
            asked.model,
            mapping=asked.mapping,
            space=asked.space,
            storey=asked.storey,
            extent=asked.extent,
            weather=asked.weather,
            workplane_m=asked.workplane,
            wall_zone_m=asked.wall_zone,
            keep_bodies=asked.keep_bodies,
        )
        imported.write(str(asked.out))
        _tell(f"{imported.name}: {finding}" for finding in imported.findings)
        _tell(imported.warnings())
    except (InputError, ImportError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    return 0


def _tell(warnings: Iterable[str]) -> None:
    for warning in warnings:
        print(f"warning: {warning}", file=sys.stderr)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="python -m quasilux.ifc",
        description="Write a quasilux project of an IFC model (IFC2x3, 4 or 4.3).",
    )
    add = parser.add_argument
    add("model", metavar="MODEL", help="the model, in clear text (.ifc)")
    add("--out", metavar="PROJECT", help="the project file to write; files that are there stay")
    add("--list", action="store_true", help="list spaces, types of fixtures, and styles")
    add("--mapping", metavar="TOML", help="materials and photometric files by names of the model")
    space = "a space by GlobalId, number or name; may be given several times"
    add("--space", metavar="NAME", action="append", default=[], help=space)
    add("--storey", metavar="NAME", help="the storey whose spaces are taken")
    extent = "what of the building is kept: around spaces or storeys it is these, else all"
    add("--extent", choices=("space", "storey", "building"), help=extent)
    add("--weather", metavar="FILE", help="a weather file (EPW or WEA), for a year")
    height = "height of workplanes above the floor (0.75 m)"
    add("--workplane", metavar="M", type=float, default=0.75, help=height)
    zone = "width along walls that workplanes leave out (0.5 m)"
    add("--wall-zone", metavar="M", type=float, default=0.5, help=zone)
    add("--keep-bodies", action="store_true", help="keep the bodies of light fixtures")
    return parser


if __name__ == "__main__":
    sys.exit(main())
