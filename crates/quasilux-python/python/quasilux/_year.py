"""The results of a year."""

from __future__ import annotations

import dataclasses
import json
import os
from collections.abc import Iterator, Mapping
from functools import cached_property
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np

from quasilux._figure import Figure
from quasilux._sensor_year import SensorYear
from quasilux._stored import read_only
from quasilux._whole_file import write_whole

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from quasilux._native import BlindsEntry, YearEntry
    from quasilux._origins import Origins

# What stands before the text of a file's header: a magic string, the version and a length.
_NPY_PREFIX = 10


@dataclasses.dataclass(frozen=True, eq=False)
class Calendar:
    """The intervals of a weather file, most often hours: when they are, and what shines in them.

    All arrays have the shape (h,), h being the number of intervals, and are read-only. What shines
    is not a number at night and where the file says nothing.

    Attributes
    ----------
    month, day : ndarray of uint32
        The date, counted from 1.
    middle_h : ndarray of float64
        The middle, in h from midnight by the clock of the site.
    is_known : ndarray of bool
        Whether the file says what shines, or the sun is far below the horizon.
    is_occupied : ndarray of bool
        Whether people are there.
    is_daylit : ndarray of bool
        Whether it is in the brighter half of the year, which EN 17037 counts.
    sun_altitude_deg, sun_azimuth_deg : ndarray of float64
        Where the sun is, in degrees above the horizon and clockwise from north.
    sky_horizontal_lx : ndarray of float64
        What the sky alone gives on a horizontal plane, in lx.
    sun_normal_lx : ndarray of float64
        What the sun gives across its rays, in lx.
    """

    month: NDArray[np.uint32]
    day: NDArray[np.uint32]
    middle_h: NDArray[np.float64]
    is_known: NDArray[np.bool_]
    is_occupied: NDArray[np.bool_]
    is_daylit: NDArray[np.bool_]
    sun_altitude_deg: NDArray[np.float64]
    sun_azimuth_deg: NDArray[np.float64]
    sky_horizontal_lx: NDArray[np.float64]
    sun_normal_lx: NDArray[np.float64]

    def __len__(self) -> int:
        return len(self.month)


@dataclasses.dataclass(frozen=True, eq=False)
class BlindsOfYear:
    """Where a group of blinds is.

    Attributes
    ----------
    name : str
        The group's name.
    positions : tuple of str
        The names of its positions, the first of which is open.
    position : ndarray of int64, shape (h,)
        The number of its position in each interval; -1 where nothing shines. Read-only.
    """

    name: str
    positions: tuple[str, ...]
    position: NDArray[np.int64]

    @classmethod
    def _from_entry(cls, entry: BlindsEntry) -> BlindsOfYear:
        return cls(entry["name"], tuple(entry["positions"]), read_only(entry["position"]))


@dataclasses.dataclass(frozen=True)
class LampZone:
    """Lamps that fill up daylight to a target, and their energy.

    Attributes
    ----------
    name, sensor : str
        The zone's name, and the sensor whose average is filled up.
    target_lx : float
        To this, in lx.
    power_w, min_power_w : float
        Power without daylight and where daylight is enough, in W.
    energy_kwh : Figure
        In a year, in kWh.
    full_power_kwh : float
        At full power in all occupied hours, in kWh.
    """

    name: str
    sensor: str
    target_lx: float
    power_w: float
    min_power_w: float
    energy_kwh: Figure
    full_power_kwh: float

    @classmethod
    def _from_entry(cls, entry: dict[str, Any]) -> LampZone:
        names = ("name", "sensor", "target_lx", "power_w", "min_power_w", "full_power_kwh")
        return cls(**{name: entry[name] for name in names}, energy_kwh=_energy(entry))


class Year(Mapping[str, SensorYear]):
    """The daylight of a year: a mapping of the names of sensors to what they have of it.

    Years can be pickled, hours and files with them.

    See Also
    --------
    annual : simulates one; with an example.
    """

    def __init__(
        self, entry: YearEntry, shapes: Mapping[str, tuple[int, ...]], origins: Origins
    ) -> None:
        self._entry = entry
        self._shapes = dict(shapes)
        self._origins = origins

    def __reduce__(self) -> tuple[Any, ...]:
        return Year, (self._entry, self._shapes, self._origins)

    @cached_property
    def _sensors(self) -> Mapping[str, SensorYear]:
        found: dict[str, SensorYear] = {}
        first = 0
        for entry in self._document["sensors"]:
            shape = self._shapes[entry["name"]]
            # Of a year that was stopped some points are missing.
            end = first + int(np.prod(shape))
            found[entry["name"]] = SensorYear(
                entry, shape, self._hours[first:end], self._file(f"{entry['name']}.annual.csv")
            )
            first = end
        return MappingProxyType(found)

    @cached_property
    def _hours(self) -> NDArray[np.float32]:
        content = self._entry["files"]["hours.npy"]
        start = _NPY_PREFIX + int.from_bytes(content[_NPY_PREFIX - 2 : _NPY_PREFIX], "little")
        intervals = len(self.calendar)
        return np.frombuffer(content, "<f4", offset=start).reshape(-1, 2, intervals)

    def _file(self, name: str) -> str:
        return self._entry["files"][name].decode()

    def __getitem__(self, name: str) -> SensorYear:
        try:
            return self._sensors[name]
        except KeyError:
            known = ", ".join(map(repr, self._sensors))
            raise KeyError(f"no sensor {name!r}; there are {known}") from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._sensors)

    def __len__(self) -> int:
        return len(self._sensors)

    def __eq__(self, other: object) -> bool:
        return self is other

    def __hash__(self) -> int:
        return id(self)

    # What the year is of.

    @cached_property
    def calendar(self) -> Calendar:
        """The hours, and what shines in them."""
        arrays = self._entry["intervals"]
        return Calendar(**{name: read_only(array) for name, array in arrays.items()})

    @property
    def interval_h(self) -> float:
        """How long an interval is, in h."""
        return self._document["hours"]["interval_h"]

    @property
    def site(self) -> dict[str, Any]:
        """``place``, ``latitude_deg``, ``longitude_deg`` and ``time_zone_h``."""
        return dict(self._document["site"])

    @property
    def thresholds(self) -> dict[str, Any]:
        """What illuminances were compared with: ``enough_lx``, ``useful_lx``, ``sunlight_lx``."""
        return dict(self._document["thresholds"])

    @cached_property
    def blinds(self) -> Mapping[str, BlindsOfYear]:
        """Where each group of blinds is, by its name."""
        groups = map(BlindsOfYear._from_entry, self._entry["blinds"])
        return MappingProxyType({group.name: group for group in groups})

    @property
    def lamps(self) -> Mapping[str, LampZone]:
        """Zones of lamps that daylight dims, by name."""
        entry = self._document.get("electric_light")
        entries = [] if entry is None else entry.get("zones", [entry])
        return MappingProxyType({zone["name"]: LampZone._from_entry(zone) for zone in entries})

    @property
    def energy_kwh(self) -> Figure | None:
        """What all of these take in a year, in kWh; None without lamps."""
        entry = self._document.get("electric_light")
        return None if entry is None else _energy(entry)

    # How it was made.

    @property
    def tolerance_reached(self) -> bool:
        """Whether all points are over and known as well as was wanted."""
        return self._document["tolerance_reached"]

    @property
    def complete(self) -> bool:
        """Whether all points are over: not so where a callback stopped the year."""
        return self._document["complete"]

    @property
    def rays(self) -> int:
        """Rays that were traced."""
        return self._document["run"]["rays"]

    @property
    def seconds(self) -> float:
        """What the year took in s."""
        return self._document["run"]["seconds"]

    @property
    def warnings(self) -> tuple[str, ...]:
        """What a reader of the results must know."""
        return tuple(map(self._origins.text, self._document["warnings"]))

    # Other forms.

    @cached_property
    def _document(self) -> dict[str, Any]:
        return json.loads(self.to_json())

    def to_json(self) -> str:
        """Return the document, format ``"quasilux-annual/1"``: the text of annual.json."""
        return self._file("annual.json")

    def to_dict(self) -> dict[str, Any]:
        """Return the document as nested dicts, lists, numbers and text."""
        return json.loads(self.to_json())

    def to_csv(self) -> str:
        """Return a line an interval: when, what shines, means of sensors: hours.csv."""
        return self._file("hours.csv")

    def save(self, folder: str | os.PathLike[str]) -> None:
        """Write the files that ``quasilux annual`` writes: documents, tables, hours and pictures.

        Parameters
        ----------
        folder : path-like
            It is made where there is none. Each file appears whole or not at all.

        Raises
        ------
        OSError
            When a file cannot be written.
        """
        os.makedirs(folder, exist_ok=True)
        for name, content in self._entry["files"].items():
            write_whole(os.path.join(folder, name), content)

    def __str__(self) -> str:
        return self._entry["table"]

    def __repr__(self) -> str:
        verdict = "tolerance reached" if self.tolerance_reached else "tolerance not reached"
        verdict = verdict if self.complete else "stopped"
        return f"<quasilux.Year of {', '.join(self)}: {len(self.calendar)} hours, {verdict}>"

    def _repr_png_(self) -> bytes | None:
        pictures = (self._entry["files"].get(f"{name}.hours.png") for name in self)
        return next((png for png in pictures if png is not None), None)


def _energy(entry: dict[str, Any]) -> Figure:
    numbers = {"value": entry["energy_kwh"], "half_width": entry["energy_kwh_half_width"]}
    return Figure._from_entry(numbers)
