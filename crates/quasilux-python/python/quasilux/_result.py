"""The results of a run."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator, Mapping
from functools import cached_property
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from quasilux import _native
from quasilux._camera_result import CameraResult
from quasilux._caveat import Caveat
from quasilux._finding import Finding
from quasilux._sensor_result import SensorResult
from quasilux._stored import Stored

if TYPE_CHECKING:
    import pandas
    import xarray
    from matplotlib.axes import Axes

    from quasilux._origins import Origins


class Result(Mapping[str, SensorResult]):
    """The results of a run: a mapping of the names of sensors to what is known of them.

    Results can be pickled, arrays and files with them. In a notebook they show themselves.

    Examples
    --------
    >>> import quasilux
    >>> result = quasilux.simulate("examples/cube/cube.toml", rel_tol=0.05)
    >>> list(result)
    ['probes', 'wall']
    >>> result.tolerance_reached, result.stopped
    (True, None)
    >>> result["wall"].illuminance_lx.shape
    (10, 10)
    """

    def __init__(self, outcome: _native.Outcome | Stored, origins: Origins) -> None:
        self._outcome = outcome
        self._origins = origins

    def __reduce__(self) -> tuple[Any, ...]:
        return Result, (Stored.of(self._outcome), self._origins)

    # Sensors and cameras.

    @cached_property
    def sensors(self) -> Mapping[str, SensorResult]:
        """The results of each sensor, by name."""
        entries = enumerate(self._document["sensors"])
        return MappingProxyType(
            {entry["name"]: SensorResult(self, index, entry) for index, entry in entries}
        )

    @cached_property
    def cameras(self) -> Mapping[str, CameraResult]:
        """The picture of each camera, by name."""
        entries = enumerate(self._document["cameras"])
        return MappingProxyType(
            {entry["name"]: CameraResult(self, index, entry) for index, entry in entries}
        )

    def __getitem__(self, name: str) -> SensorResult:
        try:
            return self.sensors[name]
        except KeyError:
            known = ", ".join(map(repr, self.sensors)) or "none, but cameras"
            raise KeyError(f"no sensor {name!r}; there are {known}") from None

    def __iter__(self) -> Iterator[str]:
        return iter(self.sensors)

    def __len__(self) -> int:
        return len(self.sensors)

    def __contains__(self, name: object) -> bool:
        return name in self.sensors

    def __eq__(self, other: object) -> bool:
        return self is other

    def __hash__(self) -> int:
        return id(self)

    # How the results were made.

    @property
    def tolerance_reached(self) -> bool:
        """Whether every sensor point, or every average, and every picture is what was wanted."""
        return self._document["run"]["tolerance_reached"]

    @property
    def stopped(self) -> str | None:
        """Why the run ended before that: ``"limit"``, ``"time"`` or ``"callback"``.

        None where it did not.
        """
        return self._outcome.stopped

    @property
    def biased(self) -> bool:
        """Whether values may be biased beyond their intervals; a warning says why."""
        return self._document["biased"]

    @property
    def cannot_see(self) -> tuple[str, ...]:
        """Classes of light paths in the scene that the estimator cannot make.

        Each has a light first and then what it meets, as in ``"lamp, mirror, point"``.
        """
        return tuple(self._document["run"]["cannot_see"])

    @property
    def horizontal_illuminance_lx(self) -> float | None:
        """What sky and sun give outside on a horizontal plane, in lx; None where nothing shines."""
        outside = self._document.get("outside")
        return None if outside is None else outside["horizontal_illuminance_lx"]

    @property
    def samples(self) -> int:
        """Indices that each replicate used: photons, and paths for each sensor point."""
        return self._document["run"]["samples"]

    @property
    def rays(self) -> int:
        """Rays that were traced."""
        return self._document["run"]["rays"]

    @property
    def seconds(self) -> float:
        """What the run took in s, before it was gone on with, too."""
        return self._document["run"]["seconds"]

    @property
    def replicates(self) -> int:
        """Independent repetitions behind each interval."""
        return self._document["run"]["replicates"]

    @cached_property
    def settings(self) -> dict[str, Any]:
        """All settings of the run, by the names that the project file has for them."""
        return json.loads(self._outcome.settings())

    @property
    def warnings(self) -> tuple[str, ...]:
        """What a reader of the results must know, in words: caveats and findings, too."""
        return tuple(map(self._origins.text, self._document["warnings"]))

    @property
    def caveats(self) -> tuple[Caveat, ...]:
        """What a reader of the values must know, for programs."""
        return tuple(map(Caveat._from_entry, self._document["caveats"]))

    @property
    def findings(self) -> tuple[Finding, ...]:
        """What is probably wrong with the scene."""
        found = map(Finding._from_entry, self._document["findings"])
        return tuple(map(self._origins.finding, found))

    # Other forms.

    @cached_property
    def _json(self) -> str:
        return self._outcome.document()

    @cached_property
    def _document(self) -> dict[str, Any]:
        return json.loads(self._json)

    def to_json(self) -> str:
        """Return the result document, format ``"quasilux-result/1"``: the text of result.json."""
        return self._json

    def to_dict(self) -> dict[str, Any]:
        """Return the result document as nested dicts, lists, numbers and text."""
        return json.loads(self._json)

    def to_xarray(self) -> xarray.Dataset:
        """Return the values of all sensors as one dataset of xarray.

        Returns
        -------
        xarray.Dataset
            For a sensor ``desk`` the variables ``desk`` (illuminance), ``desk_half_width``,
            ``desk_unseen``, ``desk_direct``, ``desk_merged`` and ``desk_replicates``, in lx; over
            ``desk_v`` and ``desk_u``, lengths in m along the edges of a grid, or over
            ``desk_point``; with ``desk_x``, ``desk_y`` and ``desk_z``, positions in m.

        Raises
        ------
        ImportError
            Where xarray is not installed.

        See Also
        --------
        SensorResult.to_xarray : one sensor, in shorter names.
        """
        from quasilux import _tables

        return _tables.dataset(self.sensors, self._document["run"])

    def to_pandas(self) -> pandas.DataFrame:
        """Return the values of all sensors as one table of pandas.

        Returns
        -------
        pandas.DataFrame
            One row a point: ``sensor``; ``i`` and ``j``, indices along u and v in a grid;
            ``x_m``, ``y_m``, ``z_m``; ``nx``, ``ny``, ``nz``; ``illuminance_lx``,
            ``half_width_lx``, ``unseen_lx``, ``direct_lx``, ``merged_lx``; ``samples``.

        Raises
        ------
        ImportError
            Where pandas is not installed.
        """
        from quasilux import _tables

        return _tables.frame(self.sensors.values())

    def to_csv(self, folder: str | os.PathLike[str]) -> tuple[str, ...]:
        """Write a file NAME.csv for each sensor, as ``quasilux run`` does, and nothing else.

        Parameters
        ----------
        folder : path-like
            It is made where there is none. Each file appears whole or not at all.

        Returns
        -------
        tuple of str
            The paths of the files.

        Raises
        ------
        OSError
            When a file cannot be written.

        See Also
        --------
        SensorResult.to_csv : the text of one of them.
        """
        os.makedirs(folder, exist_ok=True)
        paths = {name: os.path.join(folder, f"{name}.csv") for name in self.sensors}
        for name, path in paths.items():
            self.sensors[name].to_csv(path)
        return tuple(paths.values())

    def plot(self, sensor: str | None = None, ax: Axes | None = None, **options: Any) -> Axes:
        """Plot a sensor in false colours with matplotlib.

        Parameters
        ----------
        sensor : str, default the first grid, or else the first sensor
            Its name.
        ax : matplotlib.axes.Axes, default those of a new figure
            Where to.
        **options
            See `SensorResult.plot`.

        Returns
        -------
        matplotlib.axes.Axes
            The axes.

        Raises
        ------
        ImportError
            Where matplotlib is not installed.
        """
        if sensor is not None:
            return self[sensor].plot(ax, **options)
        if not self.sensors and self.cameras:
            return next(iter(self.cameras.values())).plot(ax, **options)
        return self._first_sensor().plot(ax, **options)

    def _first_sensor(self) -> SensorResult:
        grids = (found for found in self.sensors.values() if found.grid is not None)
        return next(grids, None) or next(iter(self.sensors.values()))

    def save(self, folder: str | os.PathLike[str]) -> None:
        """Write the files that ``quasilux run`` writes: result.json, tables and pictures.

        Parameters
        ----------
        folder : path-like
            It is made where there is none. Each file appears whole or not at all.

        Raises
        ------
        OSError
            When a file cannot be written.
        """
        self._outcome.write(os.fspath(folder))

    def __str__(self) -> str:
        return self._outcome.table()

    def __repr__(self) -> str:
        names = ", ".join([*self.sensors, *self.cameras])
        verdict = "tolerance reached" if self.tolerance_reached else f"stopped by {self.stopped}"
        return f"<quasilux.Result of {names}: {self.samples} samples, {verdict}>"

    def _repr_html_(self) -> str:
        from quasilux import _html

        return _html.result(self, self._repr_png_())

    def _repr_png_(self) -> bytes | None:
        first = [found.name for found in self.sensors.values() if found.grid is not None]
        first += [name for name, found in self.cameras.items() if found.samples]
        return self._outcome.file(f"{first[0]}.png") if first else None
