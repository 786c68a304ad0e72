"""What goes wrong, in Python's words."""
from __future__ import annotations

import os
import re
import sys
import warnings
from pathlib import Path


class GrainreelError(Exception):
    """What the program, a file of a run, or an argument says is wrong: one line that says what to do."""


class GrainreelWarning(UserWarning):
    """What the program had to guess or to leave out, in one line."""


_OWN = os.path.dirname(os.path.abspath(__file__)) + os.sep


def tell(text: str) -> None:
    """A warning at the line of the user that called the module."""
    frame, level = sys._getframe(1), 2
    while frame.f_back is not None and frame.f_code.co_filename.startswith(_OWN):
        frame, level = frame.f_back, level + 1
    warnings.warn(text, GrainreelWarning, stacklevel=level)


class Placed:
    """Something on disk. A path that was given relative to the working folder holds after os.chdir() too."""

    def __init__(self, path: str) -> None:
        self._given, self._absolute = path, os.path.abspath(path)

    @property
    def path(self) -> Path:
        """Where it is: as it was given, or absolute once the working folder is another."""
        return Path(self._given if os.path.abspath(self._given) == self._absolute else self._absolute)

    def __fspath__(self) -> str:
        return str(self.path)


# Options whose arguments have another name, or that an argument turns off or on.
_ARGUMENTS = {"force": "force=True", "no-film": "film=False", "no-report": "report=False", "no-cache": "cache=False",
              "no-replay": "replay=False", "from": "start", "to": "end", "until": "end", "retry": "retry=True",
              "films": "films=True", "one": "one=True", "over-time": "over_time=True", "through": "through=True",
              "largest-overlap": "largest_overlap=True", "transparent": "transparent=True",
              "pair-distribution": "pair_distribution=True", "duration": "run__duration", "seed": "run__seed",
              "title": "title"}


def in_python(text: str, verb: str = "") -> str:
    """The program's message with arguments in place of options: "--time-step 1us" is time_step="1us"."""
    text = re.sub(r"--set ([\w.]+)", r"\1", text)
    text = re.sub(r"--units mm\b", 'units="mm"', text)
    text = re.sub(r"see \S*grainreel (\w+) --help", r"see help(grainreel.\1)", text)

    def argument(match: re.Match[str]) -> str:
        option, value = match.groups()
        if option == "to" and verb == "export":
            return "to" + (f' "{value}"' if value else "")
        name = _ARGUMENTS.get(option, option.replace("-", "_"))
        return name + (f'="{value}"' if value else "")

    return re.sub(r"(?<![\w-])--([a-z][a-z-]*)(?: (\d[\w.]*(?:(?<=e)-\d+)?))?", argument, text)


def wrong(what: str, wanted: str, value: object) -> GrainreelError:
    """The error for an argument of another kind than is wanted."""
    return GrainreelError(f"{what}: must be {wanted}, but is {_short(value)}")


def _short(value: object) -> str:
    try:
        text = " ".join(repr(value).split())
    except Exception:  # a __repr__ of the user's that fails
        text = f"a {type(value).__name__}"
    return text if len(text) <= 80 else text[:77] + "..."
