"""Files of a run as datasets of xarray, with units."""
from __future__ import annotations

import csv
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any, Dict, List, Tuple

import numpy
import xarray
from xarray.backends import BackendArray
from xarray.core import indexing

from ._frames import Frame, Measures, as_frame, as_measures
from ._messages import GrainreelError
from ._whole import whole_records

# Ends of columns in measures.csv that are units, and the one whose name does not end with its unit. All others are pure
# numbers.
_UNITS = {"s": "s", "m": "m", "J": "J", "N": "N", "W": "W", "Hz": "Hz", "kg": "kg", "Pa": "Pa", "degree": "degree",
          "turns": "turn", "N.m": "N.m"}
_UNITS_OF_COLUMNS = {"outflow_rate": "kg/s"}

# Variables with a place for each axis, and the names of their parts.
_PARTS = {"coordinates": ("x", "y", "z"), "velocities": ("vx", "vy", "vz"), "spin": ("wx", "wy", "wz"),
          "point": ("x", "y", "z"), "tangential": ("tangential_x", "tangential_y", "tangential_z")}


def unit_of(column: str) -> str:
    """The unit of a column of measures.csv."""
    if column in _UNITS_OF_COLUMNS:
        return _UNITS_OF_COLUMNS[column]
    parts = column.split("_")
    return _UNITS.get(parts[-1], "1") if len(parts) > 1 else "1"


def read_record(file: Path) -> Dict[str, Any]:
    """run.json; empty where there is none."""
    try:
        record = json.loads(file.read_text(encoding="utf-8"))
    except FileNotFoundError:
        return {}
    except OSError as error:
        raise GrainreelError(f"{file}: cannot be read: {error.strerror}") from None
    except ValueError as error:
        raise GrainreelError(f"{file}: is damaged: {error}") from None
    if not isinstance(record, dict):
        raise GrainreelError(f"{file}: is damaged: it holds no table of names and values")
    return record


def read_measures(file: Path) -> Measures:
    """measures.csv, a variable for each column."""
    try:
        with file.open(newline="", encoding="utf-8") as text:
            rows = list(csv.reader(text))
        names, rows = rows[0], rows[1:]
        if rows and len(rows[-1]) < len(names):  # of a run that was killed, or is still writing
            rows.pop()
        values = numpy.array([[float(cell or "nan") for cell in row] for row in rows]).reshape(len(rows), len(names))
    except FileNotFoundError:
        raise GrainreelError(f"{file}: is not there") from None
    except OSError as error:
        raise GrainreelError(f"{file}: cannot be read: {error.strerror}") from None
    except (IndexError, ValueError, csv.Error) as error:
        raise GrainreelError(f"{file}: is damaged: {error}") from None
    columns: Dict[str, Any] = {name: ("time", values[:, k], {"units": unit_of(name)}) for k, name in enumerate(names)}
    if "time_s" not in columns:
        raise GrainreelError(f"{file}: has no column time_s")
    columns["time"] = columns.pop("time_s")
    return as_measures(xarray.Dataset(columns))


def read_netcdf(file: Path, setting: str) -> xarray.Dataset:
    """A NetCDF file of a run, without the checksums, with short units and words as text. setting: what a scene says so
    that there is one."""
    if not file.is_file():
        raise GrainreelError(f"{file}: is not there; run the scene with {setting}")
    whole = whole_records(file)
    try:
        data = xarray.open_dataset(file, decode_times=False)
    except Exception as error:  # whatever the reader of NetCDF throws
        why = (str(error).splitlines() or [""])[0]
        if "match in any of xarray" in why:  # the readers of NetCDF are there, but none takes this file
            why = "it is no whole NetCDF file, or python3-netcdf4 is not installed"
        raise GrainreelError(f"{file}: cannot be read: {why}") from error
    if whole and data.sizes.get(whole[0], 0) > whole[1]:
        data = data.isel({whole[0]: slice(whole[1])})
    data = data.drop_vars([each for each in data.variables if "checksum" in str(each)])
    for each, variable in list(data.variables.items()):
        if variable.dtype.kind == "S":
            words = [word.decode("utf-8").strip() for word in variable.values.ravel()]
            data[each] = (variable.dims, numpy.array(words).reshape(variable.shape), variable.attrs)
        elif variable.attrs.get("units") in ("second", "meter"):
            data[each].attrs["units"] = variable.attrs["units"][0]
    return data.set_coords([each for each in ("time", "step", "cycles", "phase") if each in data.variables])


def with_parts(data: xarray.Dataset) -> xarray.Dataset:
    """x, y, z and so on as variables of their own, which are read when they are asked for."""
    for name, parts in _PARTS.items():
        if name not in data.variables:
            continue
        vector = data.variables[name]
        for k, part in enumerate(parts):
            piece = vector.isel(spatial=k)
            piece.attrs = {**vector.attrs, "long_name": f"{vector.attrs.get('long_name', name)}, along {'xyz'[k]}"}
            data[part] = piece
    return data


class _Names(BackendArray):
    """The name of each grain's species, made of its number when it is asked for."""

    def __init__(self, numbers: xarray.Variable, names: List[str]) -> None:
        self._numbers = numbers
        self._words = numpy.array(["", *names])
        self.shape: Tuple[int, ...] = numbers.shape
        self.dtype = self._words.dtype

    def __getitem__(self, key: Any) -> Any:
        return indexing.explicit_indexing_adapter(key, self.shape, indexing.IndexingSupport.OUTER, self._get)

    def _get(self, key: Any) -> Any:
        numbers = numpy.asarray(self._numbers[key].values)
        return self._words[numpy.clip(numbers, 0, len(self._words) - 1)]


def species_of(trajectory: xarray.Dataset) -> List[str]:
    """The names of the species, in the order of their numbers."""
    words = str(trajectory.variables["type"].attrs.get("species", "")) if "type" in trajectory.variables else ""
    return words.split("\n") if words else []


def read_trajectory(file: Path) -> xarray.Dataset:
    """trajectory.nc, with x, y, z, the species' names, and `time` as a second index of the frames. A place (`atom`) has
    the same grain in all frames (engine/files/trajectory/trajectory.hpp), so `id` is an index of the places."""
    data = with_parts(read_netcdf(file, "output.trajectory = true"))
    some = data.sizes.get("frame", 0) > 0
    if "type" in data.variables:
        types = data.variables["type"]
        if some:
            types = types.isel(frame=-1)
        lazy = indexing.LazilyIndexedArray(_Names(types, species_of(data)))  # type: ignore[no-untyped-call]
        data = data.assign_coords(species=(types.dims, lazy, {"long_name": "name of the grain's species"}))
    if "id" in data.variables:
        if some:
            data["id"] = data.variables["id"].isel(frame=-1)
        data = data.set_coords("id")
        if some and len(numpy.unique(data.id.values)) == data.sizes["atom"]:
            data = data.set_xindex("id")
    if "time" in data.coords and some:
        data = data.set_xindex("time")
    return data


def read_contacts(file: Path, times: Callable[[], Any]) -> xarray.Dataset:
    """contacts.nc, with x, y, z and the time of each row's frame."""
    contacts = with_parts(read_netcdf(file, "output.contacts = true"))
    return contacts.assign_coords(time=("row", times()[contacts.frame.values], {"units": "s"}))


def one_frame(trajectory: xarray.Dataset, number: int, weighed: bool = True) -> Frame:
    """A frame as a table: the grains that are there then, one a row, in the order of their ids, which are its index.
    weighed: whether the density that the file says is more than a guess."""
    return as_frame(_with_derived(_rows(trajectory, number), weighed))


def _with_derived(frame: xarray.Dataset, weighed: bool) -> xarray.Dataset:
    """With speed, and with mass where the density is known and the grains are spheres."""
    if all(name in frame.variables for name in ("vx", "vy", "vz")):
        speed = numpy.sqrt(frame.vx ** 2 + frame.vy ** 2 + frame.vz ** 2)
        frame = frame.assign(speed=speed.assign_attrs(units="m/s", long_name="magnitude of the velocity"))
    if not weighed or "mass" in frame.variables or "type" not in frame.variables or "half_lengths" in frame.variables:
        return frame
    words = str(frame["type"].attrs.get("density", "")).split()
    densities = numpy.array([numpy.nan, *(float(word) for word in words if word[:1].isdigit())])
    numbers = frame["type"].values
    if len(densities) < 2 or numbers.size and int(numbers.max()) >= len(densities):
        return frame
    mass = frame.radius.astype(float) ** 3 * (4 / 3 * numpy.pi) * densities[numbers]
    return frame.assign(mass=mass.assign_attrs(units="kg", long_name="mass"))


def _rows(trajectory: xarray.Dataset, number: int) -> xarray.Dataset:
    frame = trajectory.isel(frame=number)
    frame = frame.drop_vars([name for name, variable in frame.variables.items() if variable.dims not in ((), ("atom",))])
    frame = frame.load()  # netCDF4 gives arrays of another shape where no grain is asked for
    if "present" in frame.variables:
        held = frame.variables["present"].values > 0
    elif "grains" in frame.variables:
        held = numpy.arange(frame.sizes["atom"]) < int(frame.variables["grains"].values)
    else:
        held = numpy.ones(frame.sizes["atom"], bool)
    places = numpy.flatnonzero(held)
    if "id" not in frame.variables:
        return frame.isel(atom=places).set_coords([name for name in ("species",) if name in frame.variables])
    ids = frame.variables["id"].values[places]
    frame = frame.isel(atom=places[numpy.argsort(ids, kind="stable")])
    frame = frame.set_coords([name for name in ("id", "species") if name in frame.variables])
    return frame if "id" in frame.xindexes else frame.set_xindex("id")


def table_of_grains(trajectory: xarray.Dataset, weighed: bool = True) -> Any:
    """A data frame of pandas: one row for each grain in each frame."""
    import pandas

    frames = []
    for number in range(trajectory.sizes["frame"]):
        table = one_frame(trajectory, number, weighed).to_dataframe()
        table.insert(0, "frame", number)
        frames.append(table)
    return pandas.concat(frames, ignore_index=True) if frames else pandas.DataFrame()


def room_beside(trajectory: xarray.Dataset) -> "numpy.ndarray[Any, Any]":
    """How far (s) a typed time may lie from each frame and still mean it, as the program has it
    (engine/base/typed_time.hpp): half a step, or a hundredth of the way to the next frame."""
    times = trajectory["time"].values.astype(float)
    gaps = numpy.diff(times)
    gap = numpy.minimum(numpy.append(gaps, numpy.inf), numpy.insert(gaps, 0, numpy.inf))
    steps = trajectory["step"].values.astype(float) if "step" in trajectory.variables else numpy.zeros(len(times))
    done = steps[-1] - steps[0] if len(times) > 1 else 0
    half = 0.5 * (times[-1] - times[0]) / done if done > 0 else 0
    room = numpy.minimum(0.25 * gap, numpy.maximum(0.01 * gap, 5e-6 * abs(times)))
    return numpy.maximum(half, numpy.where(numpy.isfinite(room), room, 0)) * (1 + 1e-9) + 1e-9 * abs(times)


def table_of_rows(data: xarray.Dataset, dimension: str) -> Any:
    """A data frame of what has one value for each `dimension`."""
    names = [name for name, variable in data.variables.items() if variable.dims == (dimension,)]
    return data[names].to_dataframe().reset_index(drop=True)
