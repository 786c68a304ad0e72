"""A run as Python sees it."""
from __future__ import annotations

import fcntl
import operator
import os
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any, Dict, List, NoReturn, Optional, TypeVar, Union, overload

import numpy
import xarray

from . import _data, _verbs
from ._frames import Frame, no_member
from ._messages import GrainreelError, Placed, tell, wrong
from ._pictures import painter_of
from ._results import Film
from ._words import path_of, seconds_of

T = TypeVar("T")


class Run(Placed):
    """A run: a folder that the program has filled, or files of another program (see `grainreel.open`).

    It is a sequence of its kept moments, its frames: `len(run)`, `run[-1]`, `for frame in run`. Each is a dataset in
    which a grain is a row: `id`, `species`, `radius`, `x`, `y`, `z` (m), `vx`, `vy`, `vz`, `speed` (m/s), `wx`, `wy`,
    `wz` (rad/s), and `mass` (kg) where it is known. `run[-1].where("species == big and z > 2 cm")` has the grains for
    which that holds. Its rows are in the order of `id`, which is an index: `run[-1].sel(id=12)`, and
    `run[-1].z - run[0].z` takes the same grains from both. Files are read when they are first asked for.
    `with grainreel.open(...) as run` closes them at its end.
    """

    def __init__(self, folder: object, *, program: object = None, **reading: object) -> None:
        super().__init__(path_of(folder, "run"))
        self._program, self._reading = program, reading
        self._read: Dict[str, Any] = {}
        self._told: List[str] = []
        self._foreign = not (self.path / "scene.toml").is_file()
        if not self._foreign and reading:
            raise GrainreelError(f"{next(iter(reading))}: is for files of other programs, and {self.path} is a run of ours")
        if self._foreign:
            self._import = self._imported()
            for line in self._told:
                tell(line)

    # ---- as a value

    def __repr__(self) -> str:
        return f"<grainreel.Run {self.path} ({self._state()})>"

    def _state(self) -> str:
        if self._foreign:
            return "of another program"
        if not self.path.is_dir():
            return "not there any more"
        state = str(self.record.get("status", "without a record"))
        return "was killed" if state == "running" and not _is_held(self.path / ".lock") else state

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Run):
            return NotImplemented
        return bool(self._key() == other._key())

    def __hash__(self) -> int:
        return hash(self._key())

    def __reduce__(self) -> Any:
        return _reopened, (self._absolute, self._program, self._reading)

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

    def _imported(self) -> Path:
        painter = painter_of(str(self.path), self._program, self._reading)
        self._told = painter.told
        return Path(painter.folder)

    @property
    def _folder(self) -> Path:
        """Where its files lie."""
        if self._foreign:
            return self._import
        if not self.path.is_dir():
            raise GrainreelError(f"{self.path}: is not there any more; it was a run when it was opened")
        return self.path

    def _frame(self, number: int) -> Frame:
        return _data.one_frame(self.trajectory, number, self._weighed())

    def _weighed(self) -> bool:
        """Whether masses are known: the import of files without a density takes one, and says so."""
        return not any("says no density" in line for line in self._told)

    # ---- its frames

    def __len__(self) -> int:
        """The number of its frames."""
        return self.trajectory.sizes["frame"]

    @overload
    def __getitem__(self, number: int) -> Frame: ...

    @overload
    def __getitem__(self, number: slice) -> List[Frame]: ...

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
        return self._frame(place % len(self))

    def __contains__(self, frame: object) -> bool:
        # Python would compare all frames with it.
        raise GrainreelError("in: a run does not look for a frame; take it by its number, run[3], or by its time, "
                             "run.sel(time=0.1)")

    def __iter__(self) -> Iterator[Frame]:
        """All frames, each read when its turn comes."""
        for place in range(len(self)):
            yield self[place]

    @overload
    def sel(self, time: slice, method: Optional[str] = "nearest") -> List[Frame]: ...

    @overload
    def sel(self, time: Union[float, str, xarray.DataArray], method: Optional[str] = "nearest") -> Frame: ...

    def sel(self, time: Any, method: Optional[str] = "nearest") -> Any:
        """The frame at a time (s), as `run[...]` gives it: the nearest one, or with method=None only just that one. Of a
        slice of times a list of the frames in it, both ends included. A frame is at a time that is less than half a step
        away, as in the program's options, so that 0.1 finds 0.09999999999999999. There is none beyond the first and the
        last one."""
        times, room = self.trajectory["time"].values, _data.room_beside(self.trajectory)
        if isinstance(time, slice):
            first, last = (None if end is None else seconds_of(end, "time") for end in (time.start, time.stop))
            inside = numpy.ones(len(times), bool)
            if first is not None:
                inside &= times >= first - room
            if last is not None:
                inside &= times <= last + room
            return [self._frame(int(place)) for place in numpy.flatnonzero(inside)[::time.step]]
        seconds = seconds_of(time, "time")
        if not len(times) or not times[0] - room[0] <= seconds <= times[-1] + room[-1]:
            kept = f"its frames are from {times[0]:.6g} s to {times[-1]:.6g} s" if len(times) else "it has no frames"
            raise GrainreelError(f"time: {self.path} has no frame at {seconds:.6g} s; {kept}")
        number = int(numpy.argmin(abs(times - seconds)))
        if method is None and abs(times[number] - seconds) > room[number]:
            raise GrainreelError(f"time: no frame is at {seconds:.6g} s; with method=\"nearest\" the nearest one is taken")
        return self._frame(number)

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
        """run.json: status, program, command, times, warnings. Files of another program have none; of them it has
        `warnings`, what had to be guessed."""
        if self._foreign:
            return {"warnings": list(self._told)}
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
        index of the frames, `sel(time=0.1, method="nearest")`; `species` has the names. A grain has the same place in
        all frames, so `id` is an index too: `run.trajectory.sel(id=12).z`."""
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
            return _data.table_of_grains(self.trajectory, self._weighed())
        if what == "contacts":
            return _data.table_of_rows(self.contacts, "row")
        if what == "measures":
            return self.measures.to_dataframe().reset_index()
        if what == "fields":
            return self.fields.drop_dims("two", errors="ignore").to_dataframe().reset_index()
        raise wrong("what", '"grains", "contacts", "measures" or "fields"', what)

    def _once(self, name: str, read: Callable[[], T]) -> T:
        if name not in self._read:
            if self._foreign and not self._import.is_dir():  # the cache of imports is tidied now and then
                self._import = self._imported()
            self._read[name] = read()
        held: T = self._read[name]
        return held

    # ---- what the program makes of it

    render = _verbs.render
    film = _verbs.film
    inspect = _verbs.inspect
    report = _verbs.report
    export = _verbs.export

    if not TYPE_CHECKING:
        def __getattr__(self, name: str) -> NoReturn:
            no_member(name, [each for each in dir(type(self)) if not each.startswith("_")])

    # ---- in a notebook

    def _repr_html_(self) -> str:
        from html import escape
        head = f"<p>{escape(repr(self))}</p>"
        films = sorted(self._folder.glob("movie.*")) if self._foreign or self.path.is_dir() else []
        return head + (Film(films[0])._repr_html_() if films else "")

    def _repr_png_(self) -> Optional[bytes]:
        if not self._foreign and not self.path.is_dir():
            return None
        poster = self._folder / "poster.png"
        return poster.read_bytes() if poster.is_file() and not list(self._folder.glob("movie.*")) else None


def _is_held(lock: Path) -> bool:
    """Whether a program still works on the run (engine/files/folder_lock.hpp)."""
    try:
        with lock.open("rb") as file:
            fcntl.flock(file, fcntl.LOCK_SH | fcntl.LOCK_NB)
    except BlockingIOError:
        return True
    except FileNotFoundError:
        return False
    except OSError:  # of another user, or without locks
        return True
    return False


def _reopened(path: str, program: object, reading: Dict[str, object]) -> Run:
    return Run(path, program=program, **reading)
