"""Reading models, each in a process of its own."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

from quasilux.ifc._imported import Imported
from quasilux.ifc._isolated import isolated
from quasilux.ifc._survey import Survey

if TYPE_CHECKING:
    from quasilux.ifc._spaces import Extent


def load(
    path: str | os.PathLike[str],
    *,
    mapping: str | os.PathLike[str] | Mapping[str, Any] | None = None,
    space: str | Iterable[str] = (),
    storey: str | None = None,
    extent: Extent | None = None,
    weather: str | os.PathLike[str] | None = None,
    workplane_m: float = 0.75,
    wall_zone_m: float = 0.5,
    keep_bodies: bool = False,
) -> Imported:
    """Read an IFC model (IFC2x3, 4 or 4.3) as a project.

    Parameters
    ----------
    path : str or os.PathLike
        The model, in clear text (``.ifc``).
    mapping : str, os.PathLike or dict, optional
        A TOML file, or a dict of its tables: ``[materials.NAME]`` with the keys of a material for
        the name of a style, a material, a type or a class, ``[luminaires.NAME]`` with
        ``photometry`` for the name of a type of fixtures.
    space : str or iterable of str, optional
        Spaces by GlobalId, number, name or both; all if not given.
    storey : str, optional
        The storey whose spaces are taken, where no space is named.
    extent : {"space", "storey", "building"}, optional
        What is there of the building: what bounds the chosen spaces or is in them, what is in their
        storeys, or all. Around chosen spaces or storeys it is these, else the building.
    weather : str or os.PathLike, optional
        A weather file (EPW or WEA), for a project of a year.
    workplane_m : float, default 0.75
        Height of workplanes above the floor in m.
    wall_zone_m : float, default 0.5
        Width in m along walls that workplanes leave out; in narrow spaces less.
    keep_bodies : bool, default False
        Whether the bodies of light fixtures stay; they would stand in their own light.

    Returns
    -------
    Imported
        With `text`, `files`, `findings` and `write`.

    Raises
    ------
    InputError
        For files that are missing, no IFC, cut short or too large, for names of no space, and for
        mappings with keys that there are not.
    ImportError
        Without the extra ``quasilux[ifc]``.
    """
    keywords = {
        "mapping": mapping,
        "space": space if isinstance(space, str) else tuple(space),
        "storey": storey,
        "extent": extent,
        "weather": weather,
        "workplane_m": workplane_m,
        "wall_zone_m": wall_zone_m,
        "keep_bodies": keep_bodies,
    }
    return isolated("load", (os.fsdecode(path),), keywords, os.fsdecode(path))


def survey(path: str | os.PathLike[str]) -> Survey:
    """List what a model has that `load` and a mapping may name.

    Parameters
    ----------
    path : str or os.PathLike
        The model, in clear text (``.ifc``).

    Returns
    -------
    Survey
        With spaces, types of fixtures and styles; ``print`` shows them as a table.

    Raises
    ------
    InputError
        For files that are missing, no IFC, cut short or too large.
    ImportError
        Without the extra ``quasilux[ifc]``.
    """
    return isolated("survey", (os.fsdecode(path),), {}, os.fsdecode(path))
