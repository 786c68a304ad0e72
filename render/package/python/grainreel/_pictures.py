"""Pictures, drawn by a program that stays.

The first picture of a run starts `grainreel render RUN --asked`, which keeps the run open and its OpenGL context alive,
so that the next picture takes some tens of ms. A shared library in this process, with a small C face for ctypes, was
measured too: 10,000 grains at 640x480 took 20 ms, and 24 ms through the pipes of the process (50 grains: 7 and 11 ms). The
4 ms are not worth a library that brings NetCDF, HDF5 and LLVM beside those that netCDF4 and others have loaded here, that
ends the notebook with it when it ends, and that the wheel must carry beside the program.
"""
from __future__ import annotations

import atexit
import glob
import json
import math
import os
import struct
import subprocess
import tempfile
import threading
import zlib
from collections import OrderedDict
from collections.abc import Mapping, Sequence
from typing import Any, Dict, List, Optional, Tuple

import numpy

from ._messages import GrainreelError, in_python, wrong
from ._program import end_of, popen, program_of
from ._words import number_of, reading_words, seconds_of, settings_of, size_of, text_of, whole_of


class Picture(numpy.ndarray[Any, numpy.dtype[numpy.uint8]]):
    """Rows x columns x 3 (4 where it is transparent) numbers of 0 to 255, which a notebook shows as a picture."""

    def png(self) -> bytes:
        """The picture as a PNG file (W3C 2003)."""
        if self.dtype != numpy.uint8 or self.ndim != 3 or self.shape[2] not in (3, 4) or not self.size:
            raise GrainreelError("only rows x columns x 3 or 4 numbers of 0 to 255 are a picture")
        height, width, channels = self.shape
        rows = numpy.zeros((height, 1 + width * channels), numpy.uint8)
        rows[:, 1:] = numpy.asarray(self).reshape(height, -1)
        rows[1:, 1:] -= numpy.asarray(self).reshape(height, -1)[:-1]  # filter 2: less what is above
        rows[1:, 0] = 2
        head = struct.pack(">IIBBBBB", width, height, 8, {3: 2, 4: 6}[channels], 0, 0, 0)
        parts = ((b"IHDR", head), (b"IDAT", zlib.compress(rows.tobytes(), 6)), (b"IEND", b""))
        return b"\x89PNG\r\n\x1a\n" + b"".join(
            struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
            for kind, body in parts)

    def _repr_png_(self) -> Optional[bytes]:
        try:
            return self.png()
        except GrainreelError:  # a part of a picture, or numbers made of it
            return None

    def save(self, file: "str | os.PathLike[str]") -> None:
        """Writes the picture to a PNG file."""
        with open(file, "wb") as png:
            png.write(self.png())


class Painter:
    """One process that draws pictures of one run."""

    def __init__(self, path: str, program: str, reading: Sequence[str]) -> None:
        self._said = tempfile.TemporaryFile()
        self._lock = threading.Lock()
        self._path = path
        words = [program, "render", path, "--asked", "--progress", "json", *reading]
        self._process = popen(words, stdin=subprocess.PIPE, stderr=self._said)
        greeting = self._line()
        #: The folder of the run; of other programs' files that of their import.
        self.folder = str(greeting["run"])
        #: What it had to guess about other programs' files.
        self.told = [self._told(said["text"]) for said in self._messages() if said.get("event") in ("info", "warning")]

    def draw(self, asked: Mapping[str, Any]) -> Tuple[Picture, List[str]]:
        """The picture that a question asks for (render/app/asked/asked_pictures.hpp), and warnings about it."""
        line = json.dumps(asked, allow_nan=False).encode() + b"\n"
        with self._lock:
            try:
                return self._draw(line)
            except BaseException as error:
                if not isinstance(error, GrainreelError):
                    self.close()  # a half-read answer
                raise

    def _draw(self, line: bytes) -> Tuple[Picture, List[str]]:
        pipe = self._process.stdin
        try:
            assert pipe is not None
            pipe.write(line)
            pipe.flush()
        except OSError:
            pass  # it has ended; it says why
        except ValueError:
            raise GrainreelError("the program that draws was closed; ask again") from None
        head = self._line()
        if "error" in head:
            raise GrainreelError(self._told(head["error"]))
        size = head["width"] * head["height"] * 4
        data = self._process.stdout.read(size) if self._process.stdout else b""
        if len(data) < size:
            raise self._why()
        pixels = numpy.frombuffer(data, numpy.uint8).reshape(head["height"], head["width"], 4)
        pixels = pixels.copy() if head["transparent"] else pixels[:, :, :3].copy()
        return pixels.view(Picture), [self._told(note) for note in head["notes"]]

    def _told(self, text: object) -> str:
        """A message in Python's words, which names the files that the user has given in place of their import."""
        return in_python(str(text).replace(self.folder, self._path))

    def alive(self) -> bool:
        """Whether it still draws."""
        return self._process.poll() is None

    def close(self) -> None:
        """Ends the process."""
        for pipe in (self._process.stdin, self._process.stdout):
            if pipe and not pipe.closed:
                try:
                    pipe.close()
                except OSError:
                    pass
        self._process.terminate()
        self._process.wait()
        self._said.close()

    def _line(self) -> Dict[str, Any]:
        line = self._process.stdout.readline() if self._process.stdout else b""
        if not line:
            raise self._why()
        answer: Dict[str, Any] = json.loads(line)
        return answer

    def _why(self) -> GrainreelError:
        status = self._process.wait()
        errors = [str(said["text"]) for said in self._messages() if said.get("event") == "error"]
        self.close()
        return GrainreelError(in_python(errors[-1]) if errors else f"the program that draws {end_of(status)}")

    def _messages(self) -> List[Dict[str, Any]]:
        """What it has said so far."""
        size = os.fstat(self._said.fileno()).st_size  # read without a seek, as the program writes at the same place
        messages: List[Dict[str, Any]] = []
        for line in os.pread(self._said.fileno(), size, 0).decode("utf-8", "replace").splitlines():
            try:
                said = json.loads(line)
            except ValueError:
                said = {"event": "error", "text": line.removeprefix("error: ")}
            if isinstance(said, dict) and said.get("text"):
                messages.append(said)
        return messages


_MOST = 4  # processes that stay
_painters: "OrderedDict[Tuple[Any, ...], Painter]" = OrderedDict()
_owner = os.getpid()
_all_lock = threading.Lock()


def painter_of(path: str, program: object = None, reading: Optional[Mapping[str, object]] = None) -> Painter:
    """The painter of a run, or of another program's files. One that has drawn before is taken as long as the files are
    the same."""
    global _owner
    words = reading_words(reading or {})
    found = program_of(program)
    same = (os.path.abspath(path), found, *words)
    key = (*same, *_stamps(path))
    with _all_lock:
        if _owner != os.getpid():  # a forked process: the painters are those of its parent
            _painters.clear()
            _owner = os.getpid()
        painter = _painters.pop(key, None)
        if painter is None or not painter.alive():
            for other in [each for each in _painters if each[:len(same)] == same]:  # of files that have changed
                _painters.pop(other).close()
            painter = Painter(path, found, words)
        _painters[key] = painter
        while len(_painters) > _MOST:
            _painters.popitem(last=False)[1].close()
        return painter


def _stamps(path: str) -> List[Tuple[int, int]]:
    """What tells whether files have changed."""
    names = [os.path.join(path, name) for name in ("run.json", "trajectory.nc")] if os.path.isdir(path) else \
        [path] if os.path.exists(path) else sorted(glob.glob(path))
    stamps = []
    for name in names:
        try:
            state = os.stat(name)
            stamps.append((state.st_mtime_ns, state.st_size))
        except OSError:
            stamps.append((0, 0))
    return stamps


@atexit.register
def _close_all() -> None:
    while _painters and _owner == os.getpid():
        _painters.popitem()[1].close()


def question(moment: Mapping[str, object], size: object, colour: object, settings: Dict[str, object],
             more: object) -> Dict[str, Any]:
    """The question that asks a painter for a picture. moment: at, frame, cycle and phase, None where not given."""
    given = [name for name in ("at", "frame", "cycle") if moment[name] is not None]
    if len(given) > 1:
        raise GrainreelError(f"{given[0]} and {given[1]}: both name a moment; leave one out")
    asked: Dict[str, Any] = {}
    at, frame = moment["at"], moment["frame"]
    if moment["phase"] is not None and moment["cycle"] is None:
        raise GrainreelError("phase: is a part of a period; give its cycle too")
    for name, most in (("cycle", math.inf), ("phase", 1)):
        if moment[name] is not None:
            asked[name] = number_of(moment[name], name)
            if not (0 <= asked[name] <= most and math.isfinite(asked[name])):
                raise wrong(name, "a number from 0" + (" to 1" if most == 1 else ""), moment[name])
    if at is not None:
        asked["at"] = seconds_of(at, "at")
    if frame is not None:
        asked["frame"] = whole_of(frame, "frame")
    if isinstance(colour, str):
        coloured_by(colour, settings)
    elif colour is not None:
        asked["colour"] = colours(colour, settings)
    words = settings_of({f"film.{key}": value for key, value in settings.items()}, more)
    if size is not None:
        words.append("film.size=" + size_of(size))
    if words:
        asked["set"] = words
    return asked


def coloured_by(quantity: str, settings: Dict[str, object]) -> None:
    """Adds a quantity of the program to the settings of a picture or a film."""
    if "colour__by" in settings:
        raise GrainreelError("colour__by: colour already says what the grains are coloured by; leave one of them out")
    settings["colour__by"] = quantity


def colours(values: object, settings: Dict[str, object]) -> Dict[str, Any]:
    """Own values for a question. Takes the keys of film.colour out of the settings."""
    how = {name: settings.pop(f"colour__{name}") for name in ("range", "map", "scale", "title")
           if f"colour__{name}" in settings}
    left = [key for key in settings if key.startswith("colour__")]
    if left:
        raise GrainreelError(f"{left[0]}: colour already says what the grains are coloured by; leave one of them out")
    numbers = _numbers(values)
    known = numbers[numpy.isfinite(numbers)]
    logarithmic = _word(how.get("scale", "linear"), "colour__scale", ("linear", "logarithmic")) == "logarithmic"
    if "range" in how:
        ends = list(how["range"]) if isinstance(how["range"], (list, tuple, numpy.ndarray)) else []
        if len(ends) != 2:
            raise wrong("colour__range", "two numbers, as in (0, 2)", how["range"])
        low, high = (number_of(each, "colour__range") for each in ends)
        if not (math.isfinite(low) and math.isfinite(high)):
            raise wrong("colour__range", "two numbers, as in (0, 2)", how["range"])
    else:
        shown = known[known > 0] if logarithmic else known
        if not shown.size:
            raise GrainreelError("colour: has no value that can be shown; give finite numbers")
        low, high = float(shown.min()), float(shown.max())
        if low == high:
            low, high = (low / 2, low * 2) if logarithmic else (low - 0.5, low + 0.5)
    asked: Dict[str, Any] = {
        "title": text_of(how.get("title", _title(values)), "colour__title"), "range": [low, high],
        "map": text_of(how.get("map", "viridis"), "colour__map"), "logarithmic": logarithmic,
        "value": [float(each) if math.isfinite(each) else None for each in numbers]}
    ids = _ids(values)
    if ids is not None:
        asked["id"] = ids
    return asked


def _word(value: object, what: str, words: Tuple[str, ...]) -> str:
    if value not in words:
        raise wrong(what, " or ".join(words), value)
    return str(value)


def _numbers(values: object) -> "numpy.ndarray[Any, numpy.dtype[numpy.float64]]":
    try:
        if numpy.iscomplexobj(values):  # type: ignore[arg-type]
            raise TypeError
        numbers = numpy.asarray(values, dtype=numpy.float64)
    except (TypeError, ValueError):
        raise wrong("colour", "a number for each grain", values) from None
    if numbers.ndim != 1:
        raise GrainreelError(f"colour: must have one number for each grain, but has the shape {numbers.shape}")
    return numbers


def _title(values: object) -> str:
    """The name of an array or a column, with its unit."""
    name = getattr(values, "name", None)
    unit = (getattr(values, "attrs", None) or {}).get("units", "")
    return f"{name or 'value'} ({unit})" if unit and unit != "1" else str(name or "value")


def _ids(values: Any) -> Optional[List[int]]:
    """The ids of an array that has them as a coordinate, or of a column that has them as its index."""
    coordinates: Any = getattr(values, "coords", None)
    if coordinates is not None:
        return [int(each) for each in coordinates["id"].values] if "id" in coordinates else None
    index: Any = getattr(values, "index", None)
    return [int(each) for each in index] if getattr(index, "name", None) == "id" else None
