"""What shines from outside: skies of the CIE, of weather files and of scenes, and the sun.

Directions are those of the compass: altitudes in degrees above the horizon, azimuths in degrees
clockwise from north. Times are those of the clock of a site.

>>> from quasilux import sky
>>> overcast = sky.cie(16, horizontal_lx=10_000)
>>> round(overcast.zenith_luminance_cd_m2)
4093
>>> overcast.luminance_cd_m2([90, 30, 0], 180).round()
array([4093., 2728., 1364.])
"""

from __future__ import annotations

import dataclasses
import datetime
import json
from collections.abc import Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any, Union

import numpy as np

from quasilux import _native
from quasilux._errors import input_error
from quasilux.photometry import _arrays, _files
from quasilux.photometry._diagram import Diagram

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from quasilux._scene import Scene

__all__ = ["Site", "Sky", "SolarDay", "Sun", "cie", "of_scene", "of_weather"]

Time = Union[str, datetime.datetime, "np.datetime64"]
Times = Union["ArrayLike", Time, Sequence[datetime.datetime]]


@dataclasses.dataclass(frozen=True)
class Sun:
    """The sun of a sky.

    Attributes
    ----------
    altitude_deg, azimuth_deg : float
        Where its centre is, without refraction.
    normal_illuminance_lx : float or None
        What its disk gives across its rays, in lx; None where it does not shine.
    disk_luminance_cd_m2 : float or None
        The luminance of the disk in cd/m2; None where it does not shine.
    """

    altitude_deg: float
    azimuth_deg: float
    normal_illuminance_lx: float | None
    disk_luminance_cd_m2: float | None


class Sky:
    """A sky at one moment, with the sun where its disk shines.

    `cie`, `of_weather` and `of_scene` make them. In a notebook a sky shows itself in false colours.
    """

    def __init__(self, native: _native.Sky, recipe: tuple[Any, tuple[Any, ...]]) -> None:
        self._native = native
        self._recipe = recipe

    def __reduce__(self) -> tuple[Any, tuple[Any, ...]]:
        """Tell pickle how to make it again."""
        return self._recipe

    @cached_property
    def _entry(self) -> dict[str, Any]:
        return self.to_dict()["sky"]

    def luminance_cd_m2(
        self, altitude_deg: ArrayLike, azimuth_deg: ArrayLike = 0.0
    ) -> NDArray[np.float64]:
        """Return the luminance of the sky in directions, without the sun's disk.

        Parameters
        ----------
        altitude_deg, azimuth_deg : array_like of float
            Directions, broadcast against each other.

        Returns
        -------
        ndarray of float64
            Luminances in cd/m2, in their common shape; 0 below the horizon, which itself is sky,
            and not a number where a direction is none.

        Raises
        ------
        ValueError
            For shapes that do not go together.

        Examples
        --------
        >>> cie(1).luminance_cd_m2(np.array([[0], [90]]), [0, 120, 240]).shape
        (2, 3)
        """
        altitudes = _arrays.real(altitude_deg, "altitude_deg")
        azimuths = _arrays.real(azimuth_deg, "azimuth_deg")
        directions = np.stack(np.broadcast_arrays(altitudes, azimuths), axis=-1)
        found = self._native.luminance_cd_m2(directions.reshape(-1))
        return _arrays.shaped(found, directions.shape[:-1])

    @property
    def model(self) -> str:
        """``"uniform"``, ``"cie"``, ``"perez"``, ``"weather"`` or ``"panorama"``."""
        return self._entry["model"]

    @property
    def type(self) -> int | None:
        """The number of a CIE sky; None of others."""
        return self._entry["type"]

    @property
    def time(self) -> datetime.datetime | None:
        """The time that the sun's place is of, by the clock of the site; None where none gave it.

        Of an interval of a weather file it is the middle, and its year means nothing.
        """
        time = self._entry["time"]
        return None if time is None else datetime.datetime.fromisoformat(time)

    @property
    def sun(self) -> Sun | None:
        """Where the sun is; None where the sky has none."""
        entry = self._entry["sun"]
        return None if entry is None else Sun(**entry)

    @property
    def site(self) -> Site | None:
        """Where on the earth it is; None where nobody said."""
        entry = self.to_dict()["site"]
        return None if entry is None else Site(**entry)

    @property
    def sky_horizontal_lx(self) -> float:
        """What the sky alone gives on a horizontal plane, in lx."""
        return self._entry["horizontal_illuminance_lx"]["sky"]

    @property
    def sun_horizontal_lx(self) -> float:
        """What the sun alone gives there, in lx."""
        return self._entry["horizontal_illuminance_lx"]["sun"]

    @property
    def horizontal_lx(self) -> float:
        """What both give there, in lx."""
        return self._entry["horizontal_illuminance_lx"]["total"]

    @property
    def zenith_luminance_cd_m2(self) -> float:
        """Luminance of the zenith in cd/m2."""
        return self._entry["zenith_luminance_cd_m2"]

    @property
    def ground_luminance_cd_m2(self) -> float:
        """Luminance of the ground in cd/m2, of its reflectance, or 0.2 where nothing is said."""
        return self._entry["ground_luminance_cd_m2"]

    @property
    def warnings(self) -> tuple[str, ...]:
        """Oddities of the files that were lived with."""
        return tuple(self.to_dict()["warnings"])

    def to_dict(self) -> dict[str, Any]:
        """Return the document that ``quasilux sky --json`` prints."""
        return json.loads(self._native.document())

    def diagram(self) -> Diagram:
        """Draw luminances in false colours, as on a map, the zenith in the middle."""
        return Diagram(self._native.drawing(), "sky")

    def __str__(self) -> str:
        return self._native.text()

    def __repr__(self) -> str:
        name = self.model if self.type is None else f"{self.model} {self.type}"
        return f"<quasilux.sky.Sky {name}: {self.horizontal_lx:.4g} lx>"

    def _repr_png_(self) -> tuple[bytes, dict[str, Any]]:
        return self.diagram()._repr_png_()


def cie(
    type: int,
    *,
    sun_deg: tuple[float, float] | None = None,
    horizontal_lx: float = 10_000.0,
) -> Sky:
    """Return a CIE standard general sky, without the sun's disk.

    Parameters
    ----------
    type : int
        Its number, 1 to 15, or 16 for the traditional overcast sky.
    sun_deg : tuple of float, optional
        Altitude and azimuth of the sun, which most types depend on.
    horizontal_lx : float, default 10 000
        What it gives on a horizontal plane, in lx.

    Returns
    -------
    Sky

    Raises
    ------
    InputError
        For other types, and where a sun is missing or makes no sense.

    Examples
    --------
    >>> clear = cie(12, sun_deg=(60, 180), horizontal_lx=20_000)
    >>> clear
    <quasilux.sky.Sky cie 12: 2e+04 lx>
    """
    if isinstance(type, bool) or not isinstance(type, (int, np.integer)):
        raise TypeError(f"type is {type!r}; expected a whole number")
    if not 1 <= type <= 16:
        raise input_error(f"type is {type}; expected 1 to 16")
    sun = None if sun_deg is None else [float(angle) for angle in sun_deg]
    native = _native.Sky.cie(int(type), sun, float(horizontal_lx))
    return Sky(native, (_cie, (int(type), sun_deg, horizontal_lx)))


def _cie(type: int, sun_deg: tuple[float, float] | None, horizontal_lx: float) -> Sky:
    return cie(type, sun_deg=sun_deg, horizontal_lx=horizontal_lx)


def of_weather(source: _files.Source, time: Time) -> Sky:
    """Return what a weather file says of a time, with the disk of the sun.

    Parameters
    ----------
    source : path-like, bytes or binary file
        An EPW or WEA file.
    time : str, datetime or datetime64
        By the clock of its site, as in ``"2026-03-20T12:30"``; the year does not matter.

    Returns
    -------
    Sky

    Raises
    ------
    InputError
        When it is no weather file, or does not have the time, or nothing shines then.
    FileNotFoundError
        When there is no such file: an `InputError`, too.

    Examples
    --------
    >>> noon = of_weather("examples/daylight-office/made-up.epw", "2026-03-20T12:30")
    >>> noon.sun.altitude_deg > 30
    True
    """
    contents = _files.contents(source, name=None, most_bytes=_native.MAX_WEATHER_BYTES)
    text = time if isinstance(time, str) else str(_times(time).astype("datetime64[s]"))
    return _of_weather(contents.file, contents.data, text)


def _of_weather(file: str, data: bytes, time: str) -> Sky:
    native = _native.Sky.of_weather(file, data, time)
    return Sky(native, (_of_weather, (file, data, time)))


def of_scene(scene: Scene) -> Sky:
    """Return what is outside of a scene.

    Parameters
    ----------
    scene : Scene
        A scene with a sky, and with a time where that is of a weather file.

    Returns
    -------
    Sky

    Raises
    ------
    InputError
        When nothing is outside, or the time is missing.
    """
    return Sky(_native.Sky.of_scene(scene._native), (of_scene, (scene,)))


@dataclasses.dataclass(frozen=True)
class SolarDay:
    """The way of the sun on a day, without refraction.

    Attributes
    ----------
    up_h : tuple of tuple of float
        From when to when its centre is above the horizon, in h from midnight; empty where it does
        not rise, and (0, 24) where it does not set.
    highest_h : float
        When it is highest, in h from midnight.
    altitude_deg, azimuth_deg : float
        Where it is then.
    """

    up_h: tuple[tuple[float, float], ...]
    highest_h: float
    altitude_deg: float
    azimuth_deg: float


@dataclasses.dataclass(frozen=True)
class Site:
    """A place on the earth, and its clock.

    Attributes
    ----------
    latitude_deg, longitude_deg : float
        Degrees north and east.
    time_zone_h : float
        Hours that the clock is ahead of Greenwich.

    Raises
    ------
    InputError
        For degrees and hours that no place has.

    Examples
    --------
    >>> berlin = Site(52.5, 13.4, 1)
    >>> berlin.sun("2026-06-21T12:00").round(1)
    array([ 60.9, 176.1])
    """

    latitude_deg: float
    longitude_deg: float
    time_zone_h: float

    def __post_init__(self) -> None:
        _native.check_site(self._place)

    @property
    def _place(self) -> list[float]:
        return [self.latitude_deg, self.longitude_deg, self.time_zone_h]

    def sun(self, times: Times) -> NDArray[np.float64]:
        """Return where the centre of the sun is at times, without refraction.

        Parameters
        ----------
        times : array_like of datetime64, datetime or str
            By the clock of the site, without a time zone, of years from 1583 to 3000.

        Returns
        -------
        ndarray of float64, shape (..., 2)
            Altitude and azimuth in degrees at each of the times.

        Raises
        ------
        InputError
            For other years.
        TypeError
            For times with a time zone of their own.

        Examples
        --------
        >>> hours = np.arange("2026-06-21", "2026-06-22", dtype="datetime64[h]")
        >>> Site(52.5, 13.4, 1).sun(hours).shape
        (24, 2)
        """
        found = _times(times)
        days = found.astype("datetime64[D]")
        months = days.astype("datetime64[M]")
        years = months.astype("datetime64[Y]")
        parts = (
            years.astype(np.int64) + 1970,
            months.astype(np.int64) % 12 + 1,
            (days - months).astype(np.int64) + 1,
            (found - days).astype(np.int64) / 1000.0,
        )
        rows = np.stack(parts, axis=-1).astype(np.float64).reshape(-1)
        return _native.sun_positions(self._place, rows).reshape(*found.shape, 2)

    def day(self, date: str | datetime.date) -> SolarDay:
        """Return when the sun is up on a day, and how high it rises.

        Parameters
        ----------
        date : str or date
            As in ``"2026-06-21"``.

        Returns
        -------
        SolarDay

        Raises
        ------
        InputError
            For years before 1583 and after 3000.

        Examples
        --------
        >>> day = Site(52.5, 13.4, 1).day("2026-06-21")
        >>> [round(hour, 1) for hour in day.up_h[0]]
        [3.8, 20.4]
        """
        day = datetime.date.fromisoformat(date) if isinstance(date, str) else date
        entry = _native.solar_day(self._place, day.year, day.month, day.day)
        up_h = tuple((start, end) for start, end in entry["up_h"])
        return SolarDay(up_h, entry["highest_h"], *entry["highest_deg"])


def _times(times: Times) -> NDArray[np.datetime64]:
    """Milliseconds in an array."""
    found = np.asarray(times)
    if found.dtype.kind == "O" and any(getattr(time, "tzinfo", None) for time in found.flat):
        raise TypeError("a time has a time zone; expected the clock of the site")
    if found.dtype.kind not in "OUM":
        raise TypeError(f"times have the type {found.dtype}; expected datetime64")
    found = found.astype("datetime64[ms]")
    if np.isnat(found).any():
        raise ValueError("a time is not a time; expected dates with a time of day")
    return found
