#!/usr/bin/env python3
"""Do the verdicts of docs/phenomena.md say what the tables beside them have?

Each row must fill all columns, must not rest on memory, and must tell its seeds and an interval, or that there is none. The
numbers below are computed again from docs/figures/phenomena: mean ± t s / √n of the seeds, t for 95 %.
"""
import csv
import math
import re
import statistics
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs/phenomena.md"
STUDENT = {1: 12.706, 2: 4.303, 3: 3.182, 4: 2.776, 21: 2.080, 29: 2.045, 37: 2.026}  # by degrees of freedom

# (name of the row, how it stands there, table, which rows of it, column, factor, digits)
NUMBERS = [
    ("the default film", "{} of the big grains in the top quarter", "wedge_segregation",
     {"study": "controls/wedge_segregation", "variant": "seeds"}, "big_in_top", 1, 3),
    ("the default film", "{} in the bottom quarter", "wedge_segregation",
     {"study": "controls/wedge_segregation", "variant": "seeds"}, "big_in_bottom", 1, 3),
    ("the default film", "height difference {} in place", "wedge_segregation",
     {"study": "wedge_walls", "contact.wall.friction": "0"}, "height_difference", 1, 2),
    ("the default film", "in place of {} (draft)", "wedge_segregation",
     {"study": "wedge_walls", "contact.wall.friction": "0.8"}, "height_difference", 1, 3),
    ("convection in a box", "{} diameters a period along the walls at Γ = 5", "convection_box",
     {"study": "convection_box", "drive.g_level": "5"}, ("flow_left", "flow_right"), 500, 3),
    ("convection in a box", "{} at Γ = 0.9", "convection_box",
     {"study": "convection_box", "drive.g_level": "0.9"}, ("roll_left", "roll_right"), 500, 4),
    ("convection in a box", "{} at 1.1", "convection_box",
     {"study": "convection_box", "drive.g_level": "1.1"}, ("roll_left", "roll_right"), 500, 4),
    ("convection in a box", "{} at 1.3", "convection_box",
     {"study": "convection_box", "drive.g_level": "1.3"}, ("roll_left", "roll_right"), 500, 4),
    ("convection in a box", "friction 0: {} at Γ = 3", "convection_box",
     {"variant": "seeds, no friction"}, ("flow_left", "flow_right"), 500, 3),
    ("convection in a wedge", "+{} up along the slants at 25°", "convection_wedge",
     {"study": "convection_wedge", "container.half_angle [deg]": "25"}, ("flow_left", "flow_right"), 200, 3),
    ("convection in a wedge", "{} at 5°", "convection_wedge",
     {"study": "convection_wedge", "container.half_angle [deg]": "5"}, ("flow_left", "flow_right"), 200, 3),
    ("convection in a wedge", "smooth walls {}", "convection_wedge",
     {"variant": "seeds, no friction"}, ("flow_left", "flow_right"), 200, 3),
    ("a low heap", "{} diameters high at Γ = 1.2", "heaping", {"study": "heaping", "drive.g_level": "1.2"}, "mound", 500, 2),
    ("a low heap", "friction 0: {}", "heaping", {"variant": "seeds, no friction"}, "mound_height", 500, 2),
    ("arching", "surface {} mm at Γ = 8", "arching", {"study": "arching", "drive.g_level": "8"}, "rms", 1000, 2),
    ("arching", "Γ = 2.5: {} mm", "arching", {"study": "arching", "drive.g_level": "2.5"}, "rms", 1000, 2),
    ("waves at f/2 and f/4", "f/2 share {} at 15 Hz", "surface_waves",
     {"study": "surface_waves_240", "drive.frequency [Hz]": "15"}, "inverted", 1, 3),
    ("waves at f/2 and f/4", "{} mm at 15 Hz", "surface_waves",
     {"study": "surface_waves_240", "drive.frequency [Hz]": "15"}, "wavelength", 1000, 1),
    ("waves at f/2 and f/4", "f/4 share {} at Γ = 6", "quarter_waves",
     {"study": "quarter_waves", "drive.g_level": "6"}, "quarter", 1, 3),
    ("waves at f/2 and f/4", "and {} at 5 (by chance 0.25)", "quarter_waves",
     {"study": "quarter_waves", "drive.g_level": "5"}, "quarter", 1, 3),
    ("waves at f/2 and f/4", "Γ = 1.5: share {}", "surface_waves", {"variant": "seeds, Γ = 1.5"}, "surface_half", 1, 3),
    ("waves at f/2 and f/4", "{} mm without friction", "surface_waves_floor",
     {"contact.wall.friction": "0", "drive.frequency [Hz]": "15"}, "median_wavelength", 1000, 1),
    ("patterns of a wide thin layer", "small tray: 5 ({} mm)", "layer_patterns_small", {"study": "five seeds"},
     "wavelength_mm", 1, 1),
    ("one large grain", "in {} to", "intruder", {"study": "intruder_shaking", "drive.g_level": "2.5"}, "rise_time", 1, 1),
    ("one large grain", "to {} s; Γ = 2", "intruder", {"study": "intruder_shaking", "drive.g_level": "4"}, "rise_time", 1, 1),
    ("one large grain", "{} s at 3,", "intruder", {"study": "intruder_size", "species.big.diameter [mm]": "9"},
     "rise_time", 1, 1),
    ("one large grain", "{} s at 4", "intruder", {"study": "intruder_size", "species.big.diameter [mm]": "12"},
     "rise_time", 1, 1),
    ("void filling and convection", "{} s (rough)", "void_filling", {"variant": "rough"}, "level_time", 1, 1),
    ("void filling and convection", "{} s (glued)", "void_filling", {"variant": "glued"}, "level_time", 1, 2),
    ("a mixture in a sealed wedge", "height difference {} at 15 Hz", "wedge_mixture",
     {"study": "controls/wedge_mixture", "variant": "seeds"}, "height_difference", 1, 3),
    ("a mixture in a sealed wedge", "Γ = 1.2: {}", "wedge_mixture", {"variant": "seeds, Γ = 1.2"}, "height_difference", 1, 3),
    ("sorted, and stirred again", "height difference {}, then", "frequency_reversal", {"variant": "seeds"}, "sorted", 1, 2),
    ("sorted, and stirred again", ", then {}, then", "frequency_reversal", {"variant": "seeds"}, "mixed_again", 1, 2),
    ("sorted, and stirred again", ", then {}; 0.51", "frequency_reversal", {"variant": "seeds"}, "sorted_again", 1, 2),
    ("sorted, and stirred again", "{} of the big grains stay", "frequency_reversal", {"variant": "seeds"}, "top_mixed", 1, 2),
    ("a mixture runs out of a hopper", "30°: {} kg/s at rest", "hopper_mixture",
     {"study": "hopper_shaking", "drive.g_level": "0.01", "container.half_angle [deg]": "30"}, "rate", 1, 3),
    ("a mixture runs out of a hopper", "{} at 0.42 m/s", "hopper_mixture",
     {"study": "hopper_shaking", "drive.g_level": "8", "container.half_angle [deg]": "30"}, "rate", 1, 3),
    ("a mixture runs out of a hopper", "15°: {} and", "hopper_mixture",
     {"study": "hopper_shaking", "drive.g_level": "0.01", "container.half_angle [deg]": "15"}, "rate", 1, 3),
    ("a mixture runs out of a hopper", "and {}; no separation", "hopper_mixture",
     {"study": "hopper_shaking", "drive.g_level": "8", "container.half_angle [deg]": "15"}, "rate", 1, 3),
    ("a silo's filling", "the floor carries {} at", "janssen",
     {"study": "janssen", "species.grains.count": "1600", "contact.wall.friction": "0.2"}, "floor_carries", 1, 3),
]

def rows_of(table, which):
    with open(ROOT / f"docs/figures/phenomena/{table}.csv", encoding="utf-8", newline="") as file:
        rows = [row for row in csv.DictReader(file) if all(row[key] == value for key, value in which.items())]
    if not rows:
        sys.exit(f"{table}.csv has no rows with {which}")
    return rows


def with_interval(table, which, columns, factor, digits):
    """Mean ± half the interval, of the columns' mean in each row."""
    columns = (columns,) if isinstance(columns, str) else columns
    values = [factor * statistics.fmean(float(row[column]) for column in columns) for row in rows_of(table, which)]
    half = STUDENT[len(values) - 1] * statistics.stdev(values) / math.sqrt(len(values))
    return f"{statistics.fmean(values):.{digits}f} ± {half:.{digits}f}".replace("-", "−")


def came_up(table, which, column):
    rows = rows_of(table, which)
    return sum(row[column] != "" for row in rows), len(rows)


def verdicts():
    """The table's rows: the name without its link, and all cells."""
    lines = [line for line in PAGE.read_text(encoding="utf-8").split("## Checks")[0].splitlines() if line.startswith("| [")]
    return {re.match(r"\| \[(.*?)\]", line)[1]: [cell.strip() for cell in line.strip("|").split("|")] for line in lines}


def wrong_rows(table):
    for name, cells in table.items():
        if len(cells) != 5 or not all(cells):
            yield f"{name}: has {len(cells)} cells, and five are to be filled"
        elif "remember" in " ".join(cells):
            yield f"{name}: rests on memory"
        elif not re.match(r"\d", cells[2]):
            yield f"{name}: tells no number of seeds"
        elif "±" not in cells[1] and "no interval" not in cells[2] and " of 5" not in cells[1] + cells[2]:
            yield f"{name}: tells no interval, nor that there is none"


def wrong_numbers(table):
    for name, text, file, which, columns, factor, digits in NUMBERS:
        expected = text.format(with_interval(file, which, columns, factor, digits))
        row = next((cells for title, cells in table.items() if title.startswith(name)), None)
        if row is None or expected not in " ".join(row):
            yield f"{name}: '{expected}' by {file}.csv does not stand there"


def wrong_shares(table):
    sizes = [came_up("intruder", {"study": "intruder_size", "species.big.diameter [mm]": d}, "rise_time")[0]
             for d in ("3.3", "4.5", "6", "9", "12")]
    expected = f"{sizes[0]}, {sizes[1]}, {sizes[2]}, {sizes[3]} and {sizes[4]} of 5"
    if expected not in " ".join(table["one large grain"]):
        yield f"one large grain: '{expected}' by intruder.csv does not stand there"


def wrong_trend():
    """From friction 0 to 0.5, by a line through the logarithm of the wavelength, with an offset for each frequency."""
    across, up = [], []
    for frequency in ("15", "22"):
        rows = rows_of("surface_waves_floor", {"drive.frequency [Hz]": frequency})
        for values, column, scale in ((across, "contact.wall.friction", float),
                                      (up, "median_wavelength", lambda cell: math.log(float(cell)))):
            numbers = [scale(row[column]) for row in rows]
            values += [number - statistics.fmean(numbers) for number in numbers]
    squares = math.fsum(x * x for x in across)
    slope = math.fsum(x * y for x, y in zip(across, up)) / squares
    free = len(up) - 3
    half = math.sqrt(math.fsum((y - slope * x)**2 for x, y in zip(across, up)) / free / squares) * STUDENT[free]
    ends = [100 * math.expm1(0.5 * rise) for rise in (slope, slope - half, slope + half)]
    expected = "{:+.0f} % [{:+.0f}, {:+.0f}]".format(*ends).replace("-", "−")
    if expected not in " ".join(TABLE["waves at f/2 and f/4"]):
        yield f"waves at f/2 and f/4: '{expected}' by surface_waves_floor.csv does not stand there"


TABLE = verdicts()
WRONG = [*wrong_rows(TABLE), *wrong_numbers(TABLE), *wrong_shares(TABLE), *wrong_trend()]
print(*WRONG, sep="\n")
sys.exit(bool(WRONG))
