"""A run as Python sees it."""
from __future__ import annotations

import operator
import os
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, Dict, List, Optional, TypeVar, Union, overload

import numpy
import xarray

from . import _data, _verbs
from ._messages import GrainreelError, wrong
from ._pictures import painter_of
from ._results import Film
from ._words import path_of, seconds_of

T = TypeVar("T")


class Run:
    """A run: a folder that the program has filled, or files of another program (see `grainreel.open`).

    It is a sequence of its kept moments, its frames: `len(run)`, `run[-1]`, `for frame in run`. Each is a dataset in
    which a grain is a row: `id`, `species`, `radius`, `x`, `y`, `z` (m), `vx`, `vy`, `vz` (m/s), `wx`, `wy`, `wz`
    (rad/s). Its rows are in the order of `id`, which is an index: `run[-1].sel(id=12)`, and `run[-1].z - run[0].z` takes
    the same grains from both. Files are read when they are first asked for. `with grainreel.open(...) as run` closes them
    at its end.
    """

    def __init__(self, folder: object, *, program: object = None, **reading: object) -> None:
        #: The folder of the run, or the files of another program.
        self.path = Path(path_of(folder, "run"))
        self._program, self._reading = program, reading
        self._folder = self.path
        self._read: Dict[str, Any] = {}
        if not self._is_foreign() and reading:
            raise GrainreelError(f"{next(iter(reading))}: is for files of other programs, and {self.path} is a run of ours")
        if self._is_foreign():
            self._folder = self._imported()

    # ---- as a value

    def __repr__(self) -> str:
        state = "of another program" if self._is_foreign() else self.record.get("status", "without a record")
        return f"<grainreel.Run {self.path} ({state})>"

    def __fspath__(self) -> str:
        return str(self.path)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Run):
            return NotImplemented
        return bool(self._key() == other._key())

    def __hash__(self) -> int:
        return hash(self._key())

    def __reduce__(self) -> Any:
        return _reopened, (os.path.abspath(self.path), self._program, self._reading)

    def __enter__(self) -> "Run":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Closes the files; what is asked for afterwards is read again."""
        for data in self._read.values():
            data.close()
        self._read.clear()

    def _key(self) -> Any:
        return os.path.realpath(self.path), tuple(sorted((name, repr(value)) for name, value in self._reading.items()))

    def _is_foreign(self) -> bool:
        return not (self.path / "scene.toml").is_file()

    def _imported(self) -> Path:
        return Path(painter_of(str(self.path), self._program, self._reading).folder)

    # ---- its frames

    def __len__(self) -> int:
        """The number of its frames."""
        return self.trajectory.sizes["frame"]

    @overload
    def __getitem__(self, number: int) -> xarray.Dataset: ...

    @overload
    def __getitem__(self, number: slice) -> List[xarray.Dataset]: ...

    def __getitem__(self, number: Any) -> Any:
        """The frame of that number, from the end where it is below 0; of a slice a list of frames."""
        if isinstance(number, slice):
            return [self[each] for each in range(*number.indices(len(self)))]
        try:
            place = operator.index(number)
        except TypeError:
            raise wrong("a frame", "a whole number or a slice", number) from None
        if not -len(self) <= place < len(self):
            raise IndexError(f"there is no frame {place}; {self.path} has {len(self)}")
        return _data.one_frame(self.trajectory, place % len(self))

    def __iter__(self) -> Iterator[xarray.Dataset]:
        """All frames, each read when its turn comes."""
        for place in range(len(self)):
            yield self[place]

    @overload
    def sel(self, time: slice, method: Optional[str] = "nearest") -> List[xarray.Dataset]: ...

    @overload
    def sel(self, time: Union[float, str, xarray.DataArray], method: Optional[str] = "nearest") -> xarray.Dataset: ...

    def sel(self, time: Any, method: Optional[str] = "nearest") -> Any:
        """The frame at a time (s), as `run[...]` gives it: the nearest one, or with method=None only just that one. Of a
        slice of times a list of the frames in it, both ends included."""
        if isinstance(time, slice):
            first, last = (None if end is None else seconds_of(end, "time") for end in (time.start, time.stop))
            places = numpy.arange(len(self))[self.trajectory.indexes["time"].slice_indexer(first, last, time.step)]
            return [self[place] for place in places]
        seconds = seconds_of(time, "time")
        number = int(self.trajectory.indexes["time"].get_indexer([seconds], method=method)[0])
        if number < 0:
            raise GrainreelError(f"time: no frame is at {seconds:.6g} s; with method=\"nearest\" the nearest one is taken")
        return _data.one_frame(self.trajectory, number)

    @property
    def time(self) -> xarray.DataArray:
        """The times of its frames, s."""
        return self.trajectory["time"]

    @property
    def species(self) -> List[str]:
        """The names of its species, in the order of `trajectory.type`, which counts from 1."""
        return _data.species_of(self.trajectory)

    # ---- its files

    @property
    def record(self) -> Dict[str, Any]:
        """run.json: status, program, command, times, warnings. Files of another program have none: {}."""
        return _data.read_record(self._folder / "run.json")

    @property
    def scene(self) -> Dict[str, Any]:
        """scene.toml, with every value as it was used, in SI units. Needs Python 3.11 or newer."""
        try:
            import tomllib
        except ImportError:
            raise GrainreelError("scene: Python 3.11 is the first that reads TOML") from None
        file = self._folder / "scene.toml"
        try:
            return tomllib.loads(file.read_text(encoding="utf-8"))
        except OSError as error:
            raise GrainreelError(f"{file}: cannot be read: {error.strerror}") from None
        except ValueError as error:
            raise GrainreelError(f"{file}: is damaged: {error}") from None

    @property
    def measures(self) -> xarray.Dataset:
        """measures.csv: one variable a column, over `time` (s)."""
        return self._once("measures", lambda: _data.read_measures(self._folder / "measures.csv"))

    @property
    def trajectory(self) -> xarray.Dataset:
        """trajectory.nc: place, velocity and size of each grain (`atom`) at each kept moment (`frame`). `time` is a second
        index of the frames, `sel(time=0.1, method="nearest")`; `species` has the names."""
        return self._once("trajectory", lambda: _data.read_trajectory(self._folder / "trajectory.nc"))

    @property
    def contacts(self) -> xarray.Dataset:
        """contacts.nc: one contact a `row`, with the time of its frame; `second` below 0 is a wall."""
        return self._once("contacts", lambda: _data.read_contacts(self._folder / "contacts.nc",
                                                                   lambda: self.trajectory.time.values))

    @property
    def fields(self) -> xarray.Dataset:
        """fields.nc: density, flow and stress on a grid, over time."""
        return self._once("fields", lambda: _data.read_netcdf(self._folder / "fields.nc", 'output.fields.grid = "yz"'))

    def to_dataframe(self, what: str = "grains") -> Any:
        """A tidy data frame of pandas. what: "grains", a row for each grain in each frame; "contacts", a row for each
        contact; "measures", a row for each time; "fields", a row for each point of the grid at each time."""
        if what == "grains":
            return _data.table_of_grains(self.trajectory)
        if what == "contacts":
            return _data.table_of_rows(self.contacts, "row")
        if what == "measures":
            return self.measures.to_dataframe().reset_index()
        if what == "fields":
            return self.fields.drop_dims("two", errors="ignore").to_dataframe().reset_index()
        raise wrong("what", '"grains", "contacts", "measures" or "fields"', what)

    def _once(self, name: str, read: Callable[[], T]) -> T:
        if name not in self._read:
            if self._is_foreign() and not self._folder.is_dir():  # the cache of imports is tidied now and then
                self._folder = self._imported()
            self._read[name] = read()
        held: T = self._read[name]
        return held

    # ---- what the program makes of it

    render = _verbs.render
    film = _verbs.film
    inspect = _verbs.inspect
    report = _verbs.report
    export = _verbs.export

    # ---- in a notebook

    def _repr_html_(self) -> str:
        from html import escape
        head = f"<p>{escape(repr(self))}</p>"
        films = sorted(self._folder.glob("movie.*"))
        return head + (Film(films[0])._repr_html_() if films else "")

    def _repr_png_(self) -> Optional[bytes]:
        poster = self._folder / "poster.png"
        return poster.read_bytes() if poster.is_file() and not list(self._folder.glob("movie.*")) else None


def _reopened(path: str, program: object, reading: Dict[str, object]) -> Run:
    return Run(path, program=program, **reading)

