"""Runs of grainreel as xarray datasets, and the program from Python.

    import grainreel
    run = grainreel.run("scene.toml", out="output/mine", drive__g_level=3)
    run.measures.kinetic_J.plot(x="time")
    run.trajectory.coordinates.isel(frame=-1)          # m, one row a grain
    picture = grainreel.render(run, at=0.1)            # rows x columns x 3, of 0 to 255

Needs numpy and xarray with a reader of NetCDF (Debian: python3-xarray, python3-netcdf4), and the program itself: the
argument `program`, else $GRAINREEL, else the one in the wheel that this module came in, else `grainreel` on the PATH. SI units; every variable says its own in
attrs["units"]. What goes wrong is a GrainreelError with one line that says what to do.
"""
import csv
import json
import os
import shutil
import signal
import struct
import subprocess
import tempfile
import zlib
from pathlib import Path

import numpy
import xarray

__all__ = ["GrainreelError", "Run", "Running", "open", "render", "run", "start"]
__version__ = "1.0.0"

# Ends of columns in measures.csv that are units, and the one whose name does not end with its unit. All others are pure
# numbers.
_UNITS = {"s": "s", "m": "m", "J": "J", "N": "N", "W": "W", "Hz": "Hz", "kg": "kg", "Pa": "Pa", "degree": "degree",
          "turns": "turn", "N.m": "N.m"}
_UNITS_OF_COLUMNS = {"outflow_rate": "kg/s"}


class GrainreelError(Exception):
    """What the program, or a file of a run, says is wrong: one line."""


class Run:
    """A folder that a run has filled. Files are read when they are first asked for."""

    def __init__(self, folder):
        self.path = Path(folder)
        if not (self.path / "scene.toml").is_file():
            raise GrainreelError(f"{self.path}: is no folder of a run; it has no scene.toml")
        self._read = {}

    def __repr__(self):
        return f"<grainreel.Run {self.path} ({self.record.get('status', 'without a record')})>"

    def __fspath__(self):
        return str(self.path)

    @property
    def record(self):
        """run.json: status, program, command, times, warnings."""
        try:
            return json.loads((self.path / "run.json").read_text(encoding="utf-8"))
        except FileNotFoundError:
            return {}
        except ValueError as error:
            raise GrainreelError(f"{self.path / 'run.json'}: is damaged: {error}") from None

    @property
    def measures(self):
        """measures.csv: one variable a column, over `time` (s)."""
        return self._once("measures", lambda: _read_measures(self.path / "measures.csv"))

    @property
    def trajectory(self):
        """trajectory.nc: place, velocity and size of each grain (`atom`) at each kept moment (`frame`)."""
        return self._once("trajectory", lambda: self._dataset("trajectory.nc", "output.trajectory = true"))

    @property
    def contacts(self):
        """contacts.nc: one contact a `row`, with the time of its frame; `second` below 0 is a wall."""

        def read():
            contacts = self._dataset("contacts.nc", "output.contacts = true")
            times = self.trajectory.time.values[contacts.frame.values]
            return contacts.assign_coords(time=("row", times, {"units": "s"}))

        return self._once("contacts", read)

    @property
    def fields(self):
        """fields.nc: density, flow and stress on a grid, over time."""
        return self._once("fields", lambda: self._dataset("fields.nc", 'output.fields.grid = "yz"'))

    def close(self):
        """Closes the files; what is asked for afterwards is read again."""
        for data in self._read.values():
            data.close()
        self._read.clear()

    def _once(self, name, read):
        if name not in self._read:
            self._read[name] = read()
        return self._read[name]

    def _dataset(self, name, setting):
        file = self.path / name
        if not file.is_file():
            raise GrainreelError(f"{file}: is not there; run the scene with {setting}")
        try:
            data = xarray.open_dataset(file, decode_times=False)
        except Exception as error:  # whatever the reader of NetCDF throws
            why = (str(error).splitlines() or [""])[0]
            if "match in any of xarray" in why:  # the readers of NetCDF are there, but none takes this file
                why = "it is no whole NetCDF file, or python3-netcdf4 is not installed"
            raise GrainreelError(f"{file}: cannot be read: {why}") from error
        data = data.drop_vars([each for each in data.variables if "checksum" in each])
        for each, variable in list(data.variables.items()):
            if variable.dtype.kind == "S":
                words = [word.decode("utf-8").strip() for word in variable.values.ravel()]
                data[each] = (variable.dims, numpy.array(words).reshape(variable.shape), variable.attrs)
            elif variable.attrs.get("units") in ("second", "meter"):
                data[each].attrs["units"] = variable.attrs["units"][0]
        return data.set_coords([each for each in ("time", "step", "cycles", "phase") if each in data.variables])


def open(run):  # as netCDF4 and xarray have it
    """The run in a folder. Throws GrainreelError where there is none."""
    return run if isinstance(run, Run) else Run(run)


def _unit_of(column):
    if column in _UNITS_OF_COLUMNS:
        return _UNITS_OF_COLUMNS[column]
    parts = column.split("_")
    return _UNITS.get(parts[-1], "1") if len(parts) > 1 else "1"


def _read_measures(file):
    try:
        with file.open(newline="", encoding="utf-8") as text:
            rows = list(csv.reader(text))
        names, rows = rows[0], rows[1:]
        if rows and len(rows[-1]) < len(names):  # of a run that was killed, or is still writing
            rows.pop()
        values = numpy.array([[float(cell or "nan") for cell in row] for row in rows]).reshape(len(rows), len(names))
    except FileNotFoundError:
        raise GrainreelError(f"{file}: is not there") from None
    except (IndexError, ValueError) as error:
        raise GrainreelError(f"{file}: is damaged: {error}") from None
    columns = {name: ("time", values[:, k], {"units": _unit_of(name)}) for k, name in enumerate(names)}
    if "time_s" not in columns:
        raise GrainreelError(f"{file}: has no column time_s")
    columns["time"] = columns.pop("time_s")
    return xarray.Dataset(columns)


# ---- the program


_OF_WHEEL = Path(__file__).with_name("grainreel_program") / "bin" / "grainreel"


def _program(given):
    name = given or os.environ.get("GRAINREEL") or (_OF_WHEEL if _OF_WHEEL.exists() else "grainreel")
    found = shutil.which(os.fspath(name))
    if not found:
        raise GrainreelError(f"{name}: is not found; install grainreel, or give program= or $GRAINREEL")
    return found


def _toml(value, inside=False):
    if isinstance(value, (bool, numpy.bool_)):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False) if inside else value
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {_toml(each, True)}" for key, each in value.items()) + " }"
    if isinstance(value, (list, tuple, numpy.ndarray)):
        return "[" + ", ".join(_toml(each, True) for each in value) + "]"
    return repr(value.item() if hasattr(value, "item") else value)


def _sets(settings, more):
    """--set of each key: film__size="640x360" is film.size, for Python has no dots in names."""
    words = []
    for key, value in {**{key.replace("__", "."): each for key, each in settings.items()}, **(more or {})}.items():
        words += ["--set", f"{key}={_toml(value)}"]
    return words


def _path(value, what):
    try:
        return os.fspath(value)
    except TypeError:
        raise GrainreelError(f"{what}: must be a path, but is {value!r}") from None


class Running:
    """The program at work. Iterating gives its progress, a dict each: stage, done from 0 to 1, time_s, and more."""

    def __init__(self, words):
        # In a session of its own, so that Ctrl-C reaches it through stop() alone, and once.
        self._words = [os.fspath(word) for word in words] + ["--progress", "json"]
        self._process = subprocess.Popen(self._words, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                         stdin=subprocess.DEVNULL, text=True, encoding="utf-8", errors="replace",
                                         start_new_session=True)
        self._stopped = False
        self.messages = []  # what it has said, a dict each: event and text

    def __iter__(self):
        for line in self._process.stderr:
            try:
                said = json.loads(line)
            except ValueError:
                said = {"event": "error", "text": line.strip().removeprefix("error: ")}
            if said.get("event") == "progress":
                yield said
            elif said.get("text"):
                self.messages.append(said)

    def stop(self):
        """Ends it in good order, as Ctrl-C in a terminal does: what there is stays and is whole, and result() has it."""
        self._stopped = True
        if self._process.poll() is None:
            self._process.send_signal(signal.SIGINT)

    def wait(self, progress=None):
        """Waits for its end and gives what it printed. progress: called with each dict; Ctrl-C stops the program."""
        try:
            for each in self:
                if progress:
                    progress(each)
            printed = self._process.stdout.read()
            status = self._process.wait()
        except BaseException:
            self.stop()
            for _ in self:
                pass
            self._process.wait()
            raise
        finally:
            if self._process.poll() is not None:
                self._process.stdout.close()
                self._process.stderr.close()
        if status != 0 and not (self._stopped and status == 128 + signal.SIGINT):
            raise GrainreelError(self._why(status))
        return printed

    def result(self, progress=None):
        """Waits for the end as wait() does, and gives the run."""
        return Run(self.wait(progress).strip())

    def _why(self, status):
        errors = [said["text"] for said in self.messages if said.get("event") == "error"]
        last = errors or [said["text"] for said in self.messages]
        return last[-1] if last else f"{self._words[0]}: ended with status {status}"


def start(scene, *, out=None, force=False, film=False, report=False, threads=None, cache=True, program=None, set=None,
          **settings):
    """Starts a run of a scene file and gives it as it goes, see Running.

    out: the folder, which must be new, or `force`; else the program chooses one in output/. film, report: whether
    they are made. cache: whether a packing of an earlier run is taken. settings: other values for keys of the scene,
    drive__frequency="20 Hz" for drive.frequency; set={"drive.frequency": "20 Hz"} is the same.
    """
    words = [_program(program), "movie", _path(scene, "scene")]
    words += [] if film else ["--no-film"]
    words += [] if report else ["--no-report"]
    words += [] if cache else ["--no-cache"]
    words += ["--out", _path(out, "out")] if out is not None else []
    words += ["--force"] if force and out is not None else []
    words += ["--threads", str(threads)] if threads is not None else []
    return Running(words + _sets(settings, set))


def run(scene, *, progress=None, **how):
    """Runs a scene file to its end and gives its Run. progress: called with each dict of progress; Ctrl-C ends the
    run in good order and raises KeyboardInterrupt. The rest: see start()."""
    return start(scene, **how).result(progress)


def render(run, *, at=None, frame=None, size=None, program=None, set=None, **settings):
    """A picture of a moment of a run, or of another program's file, as an array: rows x columns x 3 (4 where it is
    transparent) numbers of 0 to 255. at: s; frame: number of a frame of the film, whose run was made with film=True;
    neither: the last moment. size: "640x480" or (640, 480). settings: keys of [film], as in colour__by="speed"."""
    if at is not None and frame is not None:
        raise GrainreelError("at and frame: both name a moment; leave one out")
    run = _path(run, "run")
    settings = {f"film__{key}": value for key, value in settings.items()}
    with tempfile.TemporaryDirectory(prefix="grainreel-") as folder:
        words = [_program(program), "render", run, "--out", Path(folder) / "picture.png"]
        if at is None and frame is None:
            at = _last_moment(run, program)
        words += ["--at", f"{at!r} s" if not isinstance(at, str) else at] if frame is None else ["--frame", str(frame)]
        words += ["--size", _size(size)] if size is not None else []
        Running(words + _sets(settings, set)).wait()
        return _read_png((Path(folder) / "picture.png").read_bytes())


def _size(size):
    if isinstance(size, str):
        return size
    try:
        width, height = size
    except (TypeError, ValueError):
        raise GrainreelError(f"size: must be as \"640x480\" or (640, 480), but is {size!r}") from None
    return f"{width}x{height}"


def _last_moment(run, program):
    """The time (s) of the last moment that a run, or a file of another program, has."""
    said = Running([_program(program), "inspect", run, "--json", "--no-replay"]).wait()
    return json.loads(said)["moment"]["time"]


def _read_png(data):
    """Of 8 bits a channel, not interlaced: as the program writes them (PNG, W3C 2003)."""
    at, packed, head = 8, b"", None
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        if kind == b"IHDR":
            head = struct.unpack(">IIBBBBB", body)
        elif kind == b"IDAT":
            packed += body
        at += length + 12
    width, height, bits, colour, _, _, interlaced = head
    channels = {0: 1, 2: 3, 6: 4}.get(colour)
    if bits != 8 or interlaced or channels is None:
        raise GrainreelError("this picture is of a kind that is not read: give it 8 bits a channel")
    rows = numpy.frombuffer(zlib.decompress(packed), numpy.uint8).reshape(height, 1 + width * channels)
    picture = numpy.zeros((height, width * channels), numpy.uint8)
    above = numpy.zeros(width * channels, numpy.uint8)
    for y in range(height):
        above = picture[y] = _unfiltered(int(rows[y, 0]), rows[y, 1:], above, channels)
    return picture.reshape(height, width, channels)


def _unfiltered(kind, row, above, channels):
    if kind == 0:
        return row
    if kind == 1:  # what is left of it, added up
        return numpy.cumsum(row.reshape(-1, channels), axis=0, dtype=numpy.uint8).ravel()
    if kind == 2:
        return row + above
    line, up, done = row.tolist(), above.tolist(), [0] * channels + [0] * len(row)
    corner = [0] * channels + up
    for i, value in enumerate(line):
        left = done[i]
        if kind == 3:
            guess = (left + up[i]) // 2
        else:
            base = left + up[i] - corner[i]
            near_left, near_up, near_corner = abs(base - left), abs(base - up[i]), abs(base - corner[i])
            guess = (left if near_left <= near_up and near_left <= near_corner else
                     up[i] if near_up <= near_corner else corner[i])
        done[i + channels] = (value + guess) & 255
    return numpy.array(done[channels:], numpy.uint8)
