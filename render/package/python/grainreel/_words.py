"""Arguments of Python as the words that the program takes."""
from __future__ import annotations

import json
import math
import os
import re
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, Callable, List, Optional, Union

import numpy

from ._messages import GrainreelError, wrong

Path = Union[str, "os.PathLike[str]"]
Time = Union[float, str, Any]  # s, text with a unit, or anything of one number, as an element of run.time
Progress = Union[None, bool, Callable[[Any], object]]


def text_of(value: object, what: str) -> str:
    """The text, once it is known that a program can be given it."""
    if not isinstance(value, str):
        raise wrong(what, "text", value)
    if "\0" in value:
        raise GrainreelError(f"{what}: has a NUL character; leave it out")
    try:
        value.encode("utf-8")
    except UnicodeEncodeError:
        raise GrainreelError(f"{what}: has a lone surrogate, which is no text; leave it out") from None
    return value


def path_of(value: object, what: str) -> str:
    """A path that a program can be given. Names that are not UTF-8 come from os.fsdecode()."""
    try:
        path = os.fsdecode(os.fspath(value))  # type: ignore[call-overload]
        os.fsencode(path)
    except TypeError:
        raise wrong(what, "a path", value) from None
    except UnicodeError:
        raise GrainreelError(f"{what}: has a lone surrogate, which no name of a file has; leave it out") from None
    if "\0" in path:
        raise GrainreelError(f"{what}: has a NUL character, which no name of a file has; leave it out")
    if not path:
        raise GrainreelError(f"{what}: is empty; give a path")
    return str(path)


def number_of(value: object, what: str) -> float:
    """One number, also of an array that has only one."""
    if isinstance(value, (str, bytes, bool, numpy.bool_)):
        raise wrong(what, "a number", value)
    try:
        return float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError, OverflowError):
        raise wrong(what, "a number", value) from None


def whole_of(value: object, what: str) -> int:
    """One whole number."""
    number = number_of(value, what)
    if not math.isfinite(number) or number != int(number):
        raise wrong(what, "a whole number", value)
    if abs(number) >= 2 ** 31:
        raise wrong(what, "a whole number below 2,147,483,648", value)
    return int(number)


def whole_or_none(value: object, what: str) -> Optional[int]:
    """One whole number; None for None."""
    return None if value is None else whole_of(value, what)


_SECONDS = {"s": 1.0, "ms": 1e-3, "us": 1e-6, "min": 60.0}


def seconds_of(value: object, what: str) -> float:
    """A time, s: a number, an array that has only one, or text as "100 ms"."""
    if isinstance(value, str):
        match = re.fullmatch(r"\s*([-+\d.eE]+?)\s*(s|ms|us|min|)\s*", text_of(value, what))
        try:
            seconds = float(match[1]) * _SECONDS[match[2] or "s"] if match else math.nan
        except ValueError:
            seconds = math.nan
    else:
        seconds = number_of(value, what)
    if not math.isfinite(seconds):
        raise wrong(what, 'a time, as in 0.1 or "100 ms"', value)
    return seconds


def time_of(value: object, what: str) -> Optional[str]:
    """A time for an option; None for None."""
    return None if value is None else f"{seconds_of(value, what)!r} s"


def columns_of(value: object, what: str) -> Optional[str]:
    """Names with commas between them, of a name or a list of names; None gives None."""
    if value is None or isinstance(value, str):
        return None if value is None else text_of(value, what)
    if not isinstance(value, (list, tuple)) or not value:
        raise wrong(what, "a name or a list of names", value)
    return ",".join(text_of(each, what) for each in value)


def window_of(value: object, what: str) -> Optional[str]:
    """Two times as the program has them, "0.2s..0.8s"; text stays, None gives None."""
    if value is None or isinstance(value, str):
        return None if value is None else text_of(value, what)
    ends = [value.start, value.stop] if isinstance(value, slice) else list(value) if isinstance(value, (list, tuple)) else []
    if len(ends) != 2:
        raise wrong(what, 'two times, as in (0.2, 0.8), with None for an open end', value)
    return "..".join("" if end is None else f"{seconds_of(end, what)!r}s" for end in ends)


def size_of(value: object) -> str:
    """"640x480" of (640, 480)."""
    if isinstance(value, str):
        return text_of(value, "size")
    try:
        sides = [whole_of(side, "size") for side in value]  # type: ignore[attr-defined]
    except (TypeError, GrainreelError):
        sides = []
    if len(sides) != 2:
        raise wrong("size", 'as "640x480" or (640, 480)', value)
    return f"{sides[0]}x{sides[1]}"


def toml(value: object, what: str) -> str:
    """A value as TOML."""
    try:
        return _toml(value, what)
    except RecursionError:
        raise GrainreelError(f"{what.split('.')[0]}: holds itself, or is nested too deeply") from None


def _toml(value: object, what: str) -> str:
    if isinstance(value, (bool, numpy.bool_)):
        return "true" if value else "false"
    if isinstance(value, os.PathLike):
        value = os.fspath(value)
    if isinstance(value, str):
        return json.dumps(text_of(value, what), ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, Mapping):
        pairs = [f"{_key(key, what)} = {_toml(each, f'{what}.{key}')}" for key, each in value.items()]
        return "{ " + ", ".join(pairs) + " }"
    if isinstance(value, (list, tuple)) or getattr(value, "ndim", 0) > 0:
        items: Iterable[object] = value  # type: ignore[assignment]
        return "[" + ", ".join(_toml(each, what) for each in items) + "]"
    if isinstance(value, (int, numpy.integer)):
        return str(int(value))
    if isinstance(value, (float, numpy.floating)) or getattr(value, "ndim", None) == 0:
        return repr(number_of(value, what))
    raise wrong(what, "text, a number, a list or a table", value)


def _key(key: object, what: str) -> str:
    name = text_of(key, f"a key of {what}")
    return name if re.fullmatch(r"[A-Za-z0-9_-]+", name) else json.dumps(name, ensure_ascii=False)


def toml_of_scene(scene: Mapping[str, object]) -> str:
    """A scene, or a study, as the text of its file: what has no table of its own comes first."""
    lines = []
    for key, value in sorted(scene.items(), key=lambda pair: isinstance(pair[1], Mapping)):
        if isinstance(value, Mapping):
            lines.append(f"[{_key(key, 'scene')}]")
            lines += [f"{_key(each, key)} = {toml(one, f'{key}.{each}')}" for each, one in value.items()]
        else:
            lines.append(f"{_key(key, 'scene')} = {toml(value, str(key))}")
    return "\n".join(lines) + "\n"


def settings_of(settings: Mapping[str, object], more: object) -> List[str]:
    """KEY=VALUE of each key: film__size="640x360" is film.size, for Python has no dots in names. `more` has the
    names as they are."""
    if more is not None and not isinstance(more, Mapping):
        raise wrong("set", 'a dict, as in {"drive.g_level": 3}', more)
    words = []
    for key, value in [(key.replace("__", "."), value) for key, value in settings.items()] + list((more or {}).items()):
        name = text_of(key, "a key of set")
        words.append(f"{name}={text_of(value, name) if isinstance(value, str) else toml(value, name)}")
    return words


def option(name: str, value: object) -> List[str]:
    """--name VALUE; nothing for None and False; --name alone for True; once for each of a list."""
    flag = "--" + name.replace("_", "-")
    if value is None or value is False:
        return []
    if value is True:
        return [flag]
    if isinstance(value, (list, tuple)):
        return [word for each in value for word in option(name, each)]
    if isinstance(value, os.PathLike):
        return [flag, path_of(value, name)]
    if isinstance(value, str):
        return [flag, text_of(value, name)]
    number = number_of(value, name)
    return [flag, str(int(number)) if number.is_integer() else repr(number)]


def options(**values: object) -> List[str]:
    """The words of several options."""
    return [word for name, value in values.items() for word in option(name, value)]


def sets(settings: Mapping[str, object], more: object) -> List[str]:
    """The words --set KEY=VALUE."""
    return [word for each in settings_of(settings, more) for word in ("--set", each)]


def reading_words(reading: Mapping[str, object]) -> List[str]:
    """Options for files of other programs, as in radius="2 mm" or columns={"radius": "c_rad"}."""
    known = ("columns", "radius", "time_step", "units", "species", "density", "contacts", "walls", "walls_scale",
             "container", "moves_with", "one")
    words = []
    for name, value in reading.items():
        if name not in known:
            raise GrainreelError(f"{name}: no such argument; files of other programs are read with {', '.join(known)}")
        _check_reading(name, value)
        if isinstance(value, Mapping):
            value = ",".join(f"{text_of(str(key), name)}={text_of(str(each), name)}" for key, each in value.items())
        words += option(name, value)
    return words


def _check_reading(name: str, value: object) -> None:
    if isinstance(value, (list, tuple)) and name not in ("columns", "contacts", "walls"):
        raise wrong(name, "one value", value)
    if name != "species" or value is None or isinstance(value, str):
        return
    if not isinstance(value, Mapping) or not all(isinstance(each, str) for each in value.values()):
        raise wrong(name, 'a dict of names by the types of the files, as in {1: "small", 2: "big"}', value)


def exclusive(**values: object) -> None:
    """Refuses that more than one is given."""
    given: Sequence[str] = [name for name, value in values.items() if value is not None]
    if len(given) > 1:
        raise GrainreelError(f"{given[0]} and {given[1]}: both name the same; leave one out")
