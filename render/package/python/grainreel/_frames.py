"""Tables of a run as datasets that know what is meant by other names, and frames that take conditions as text."""
from __future__ import annotations

import copy
import difflib
import operator
import re
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, NoReturn

import numpy
import xarray

from ._messages import GrainreelError

_OPERATORS = {"==": operator.eq, "!=": operator.ne, ">=": operator.ge, "<=": operator.le, ">": operator.gt,
              "<": operator.lt}
_UNITS = {"": 1.0, "m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6, "m/s": 1.0, "cm/s": 1e-2, "mm/s": 1e-3, "kg": 1.0,
          "g": 1e-3, "mg": 1e-6, "rad/s": 1.0}
# Names that others use, and where the numbers are.
_OF_FRAMES = {"positions": "x, y and z", "position": "x, y and z", "coordinates": "x, y and z",
              "velocities": "vx, vy and vz", "velocity": "vx, vy and vz", "spin": "wx, wy and wz",
              "diameter": "radius, half of it", "diameters": "radius, half of it", "type": "species",
              "height": "z, from the floor's place at rest, or run.inspect(...), which knows height"}
_OF_MEASURES = {"kinetic_energy": "kinetic_J (of translation) and rotational_J", "energy": "kinetic_J",
                "rotational_energy": "rotational_J", "time_s": "time", "times": "time"}


def meant(name: str, known: Iterable[str], others: "dict[str, str]") -> str:
    """; did you mean ... for a name that is not there, or nothing."""
    if name in others:
        return f"; did you mean {others[name]}"
    names = [str(each) for each in known]
    near = difflib.get_close_matches(name, names, 3, 0.6) or [each for each in names if name.lower() in each.lower()][:3]
    return f"; did you mean {' or '.join(near)}" if near else ""


class _Table(xarray.Dataset):  # type: ignore[no-untyped-call]
    """A dataset that says which name may be meant."""

    __slots__ = ()

    def _others(self) -> "dict[str, str]":
        return {}

    def __getitem__(self, key: Any) -> Any:
        try:
            return super().__getitem__(key)
        except KeyError:
            if not isinstance(key, str):
                raise
            names = [str(name) for name in self.variables]
            raise KeyError(f"there is no {key}{meant(key, names, self._others())}; there are {', '.join(names)}") from None

    if not TYPE_CHECKING:
        def __getattr__(self, name: str) -> Any:
            try:
                return super().__getattr__(name)
            except AttributeError:
                hint = "" if name.startswith("_") else meant(name, map(str, self.variables), self._others())
                raise AttributeError(f"there is no {name} here{hint}") from None


class Measures(_Table):  # type: ignore[no-untyped-call]
    """measures.csv."""

    __slots__ = ()

    def _others(self) -> "dict[str, str]":
        return _OF_MEASURES


class Frame(_Table):  # type: ignore[no-untyped-call]
    """One moment of a run: a dataset of xarray in which a grain is a row."""

    __slots__ = ()

    def _others(self) -> "dict[str, str]":
        return _OF_FRAMES

    def where(self, cond: Any, *more: Any, **how: Any) -> Any:
        """The grains for which a condition in text holds, `frame.where("species == big and z > 2 cm")`; of anything else
        as xarray has it."""
        if not isinstance(cond, str):
            return super().where(cond, *more, **how)
        held = numpy.ones(self.sizes["atom"], bool)
        for part in re.split(r"\s+and\s+", cond.strip()):
            held &= self._held(part, cond)
        return self.isel(atom=numpy.flatnonzero(held))

    def _held(self, part: str, whole: str) -> Any:
        match = re.fullmatch(r"\s*(\w+)\s*(==|!=|>=|<=|>|<)\s*(.+?)\s*", part)
        if not match or re.search(r"[()]|\bor\b|\bnot\b", part):
            raise GrainreelError(f'where: "{whole}": must be conditions as species == big or z > 2 cm, joined by "and"; '
                                 "run.inspect(where=...) takes more")
        name, sign, value = match.groups()
        value = value.strip("'\"")
        if name not in self.variables:
            raise GrainreelError(f"where: a frame has no {name}{meant(name, map(str, self.variables), _OF_FRAMES)}")
        column = self[name].values
        if column.dtype.kind in "US":
            if sign not in ("==", "!="):
                raise GrainreelError(f"where: {name} is a word; compare it with == or !=")
            return _OPERATORS[sign](column, value)
        number = re.fullmatch(r"([-+]?[\d.]+(?:[eE][-+]?\d+)?)\s*(\S*)", value)
        if not number or number[2] not in _UNITS:
            raise GrainreelError(f'where: "{value}": must be a number, with a unit as mm or m/s or without one (SI)')
        return _OPERATORS[sign](column, float(number[1]) * _UNITS[number[2]])


def as_measures(data: xarray.Dataset) -> Measures:
    """The same data."""
    table: Measures = _as(data, Measures)
    return table


def as_frame(data: xarray.Dataset) -> Frame:
    """The same data, with what follows from it: speed, and mass where the density is known."""
    frame: Frame = _as(data, Frame)
    return frame


def _as(data: xarray.Dataset, kind: type) -> Any:
    table = copy.copy(data)
    table.__class__ = kind  # xarray has no public way to make a dataset of another type without a copy
    return table


# Names that others use for what a run has.
OF_RUNS = {"where": 'run[-1].where("species == big"), or run.inspect(where="species == big")',
           "picture": "run.render()", "image": "run.render()", "show": "run.render()",
           "plot": "run.measures or run.render()",
           "movie": "run.film()", "at": "run.sel(time=...)", "frame": "run[number]", "frames": "run itself, as in run[-1]",
           "positions": "run[-1].x, y and z", "x": "run[-1].x", "y": "run[-1].y", "z": "run[-1].z",
           "velocities": "run[-1].vx, vy and vz", "speed": "run[-1].speed", "mass": "run[-1].mass",
           "radius": "run[-1].radius", "times": "run.time", "duration": "run.time[-1]", "df": "run.to_dataframe()",
           "kinetic_energy": "run.measures.kinetic_J", "kinetic_J": "run.measures.kinetic_J",
           "warnings": 'run.record["warnings"]', "log": "run.record", "status": 'run.record["status"]',
           "summary": "run.inspect()", "folder": "run.path", "save": "run.export(...)",
           "compare": "grainreel.compare(run, other)"}


def no_member(name: str, known: Iterable[str]) -> NoReturn:
    """Raises for a member that a run has not."""
    if name.startswith("_"):
        raise AttributeError(name)
    raise AttributeError(f"a run has no {name}{meant(name, known, OF_RUNS)}")
