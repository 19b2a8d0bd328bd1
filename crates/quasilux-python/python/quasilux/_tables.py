"""Values as datasets of xarray and tables of pandas, which are imported here only."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from quasilux._errors import optional

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    import pandas
    import xarray

    from quasilux._shapes import SensorValues

_VARIABLES = {
    "": ("illuminance_lx", "illuminance"),
    "half_width": ("half_width_lx", "half the width of the confidence interval"),
    "unseen": ("unseen_lx", "light at most that no sample met"),
    "direct": ("direct_lx", "direct illuminance"),
    "merged": ("merged_lx", "illuminance that is known as a mean over a disc"),
    "replicates": ("replicates_lx", "illuminance of each replicate"),
}


def sensor_dataset(sensor: SensorValues, run: dict[str, Any]) -> xarray.Dataset:
    """Return one sensor, in names of its own."""
    xarray = optional("xarray", "tables")
    variables, coordinates = _parts(sensor, "", "illuminance")
    attributes = {"sensor": sensor.name, **_attributes(run)}
    return xarray.Dataset(variables, coordinates, attributes)


def dataset(sensors: Mapping[str, SensorValues], run: dict[str, Any]) -> xarray.Dataset:
    """Return all sensors, each in names that begin with its own."""
    xarray = optional("xarray", "tables")
    variables: dict[str, Any] = {}
    coordinates: dict[str, Any] = {}
    for name, sensor in sensors.items():
        more, places = _parts(sensor, f"{name}_", name)
        twice = (variables.keys() | coordinates.keys()) & (more.keys() | places.keys())
        if twice:
            raise ValueError(
                f"two sensors would both have {min(twice)!r}; take them one by one, as in "
                f"result[{name!r}].to_xarray()"
            )
        variables.update(more)
        coordinates.update(places)
    return xarray.Dataset(variables, coordinates, _attributes(run))


def _attributes(run: dict[str, Any]) -> dict[str, Any]:
    """What NetCDF can hold of how the results were made."""
    names = ["version", "scene_sha256", "estimator", "sequence", "randomization", "confidence"]
    names += ["replicates", "seed", "samples", "rays", "rel_tol"]
    attributes = {name: run[name] for name in names}
    attributes["tolerance_reached"] = int(run["tolerance_reached"])
    return attributes


def _parts(sensor: SensorValues, prefix: str, name: str) -> tuple[dict[str, Any], dict[str, Any]]:
    """Return variables and coordinates of a sensor."""
    dims = [f"{prefix}{axis}" for axis in (["point"] if sensor.grid is None else ["v", "u"])]
    variables = {}
    for key, (array, long_name) in _VARIABLES.items():
        over = ["replicate", *dims] if key == "replicates" else dims
        attributes = {"units": "lx", "long_name": long_name}
        called = f"{prefix}{key}" if key else name
        variables[called] = (over, getattr(sensor, array), attributes)
    coordinates: dict[str, Any] = _lengths(sensor, dims)
    for axis, letter in enumerate("xyz"):
        attributes = {"units": "m", "long_name": f"{letter} of the position"}
        coordinates[f"{prefix}{letter}"] = (dims, sensor.positions_m[..., axis], attributes)
    return variables, coordinates


def _lengths(sensor: SensorValues, dims: list[str]) -> dict[str, Any]:
    """Return lengths along the edges of a grid, or numbers of points."""
    if sensor.grid is None:
        return {dims[0]: np.arange(len(sensor.illuminance_lx))}
    found = {}
    for dim, edge_m, letter in zip(dims, (sensor.grid.v_m, sensor.grid.u_m), "vu", strict=True):
        count = sensor.grid.counts["uv".index(letter)]
        length_m = float(np.linalg.norm(edge_m))
        centres_m = (np.arange(count) + 0.5) * (length_m / count)
        found[dim] = (dim, centres_m, {"units": "m", "long_name": f"length along {letter}"})
    return found


def frame(sensors: Iterable[SensorValues]) -> pandas.DataFrame:
    """Return sensors one below the other, one row a point."""
    pandas = optional("pandas", "tables")
    frames = [pandas.DataFrame(_columns(sensor, pandas)) for sensor in sensors]
    return pandas.concat(frames, ignore_index=True) if frames else pandas.DataFrame()


def _columns(sensor: SensorValues, pandas: Any) -> dict[str, Any]:
    points = sensor.illuminance_lx.size
    if sensor.grid is None:
        i = j = pandas.array([pandas.NA] * points, dtype="Int64")
    else:
        rows, columns = np.indices(sensor.shape)
        i, j = (pandas.array(index.ravel(), dtype="Int64") for index in (columns, rows))
    columns = {"sensor": sensor.name, "i": i, "j": j}
    for names, vectors in (
        (("x_m", "y_m", "z_m"), sensor.positions_m),
        (("nx", "ny", "nz"), sensor.normals),
    ):
        columns.update(zip(names, vectors.reshape(-1, 3).T, strict=True))
    of_points = ("illuminance_lx", "half_width_lx", "unseen_lx", "direct_lx", "merged_lx")
    for name in (*of_points, "samples"):
        columns[name] = getattr(sensor, name).ravel()
    return columns
