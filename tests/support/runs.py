"""What a run leaves behind: its tables in numbers, and whether two runs are alike. tests/support/fields.py reads NetCDF."""
import csv
import math
from pathlib import Path

SCENES = Path(__file__).resolve().parent.parent / "data" / "scenes"
UNITS = ("_m", "_J", "_s", "_kg", "_kg/s", "_N", "_N.m", "_Hz")


def shared_scene(name, *changes):
    """A scene of tests/data/scenes as text; changes: pairs of a text that stands in it and what stands there instead."""
    text = (SCENES / f"{name}.toml").read_text(encoding="utf-8")
    for old, new in changes:
        if old not in text:
            raise ValueError(f"{name}.toml has no {old!r}")
        text = text.replace(old, new)
    return text


def name_of(head):
    """The name of a column, without its unit."""
    return next((head[: -len(unit)] for unit in UNITS if head.endswith(unit)), head)


def texts(file):
    """The rows of a table by their heads, as they stand there."""
    with open(file, newline="", encoding="utf-8") as rows:
        return list(csv.DictReader(rows))


def numbers(file):
    return [{head: float(value) for head, value in row.items()} for row in texts(file)]


class Measures:
    """The rows of a run's measures.csv, with names without units, and its folder."""

    def __init__(self, folder):
        self.folder = folder
        self.rows = [{name_of(head): value for head, value in row.items()} for row in numbers(folder / "measures.csv")]

    def values(self, column, after=0.0, until=math.inf):
        """The numbers of a column from `after` to `until` seconds, without gaps."""
        values = [row[column] for row in self.rows if after <= row["time"] <= until]
        return [value for value in values if not math.isnan(value)]

    def mean(self, column, after=0.0, until=math.inf):
        values = self.values(column, after, until)
        return sum(values) / len(values) if values else math.nan

    def end(self, column):
        return self.rows[-1][column]


def content(file):
    """The bytes of a file; None where there is none."""
    try:
        return Path(file).read_bytes()
    except OSError:
        return None


def differing(first, second, names):
    """Names of the files that one of two runs has not, or has otherwise."""
    return [name for name in names if content(Path(first) / name) != content(Path(second) / name)]
