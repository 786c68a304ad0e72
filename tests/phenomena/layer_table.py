#!/usr/bin/env python3
"""The patterns of all members of a study of layers, as one table.

    tests/phenomena/layer_table.py STUDY [--periods N]

STUDY is the folder of a finished study whose members have a trajectory in a square tray, one frame a period. Prints its
study.csv with what layer_pattern.py tells of each member, `--every-second` for drives of 3.5 g and more: there the layer
lands in every second period. `waves` is the strongest whole number of waves to the tray, as the pictures of figure 1 of
Bizon et al. 1998 were measured (docs/phenomena/layer_patterns.md).
"""
import argparse
import csv
import math
import sys
import tomllib
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from fields import Fields  # noqa: E402
from layer_pattern import Pattern  # noqa: E402

COLUMNS = ("share", "rms_mm", "wavelength_mm", "waves", "skewness", "M2", "M4", "M6")


def looked_at(folder, periods):
    """The values of COLUMNS of one run."""
    scene = tomllib.loads((folder / "scene.toml").read_text(encoding="utf-8"))
    tray, drive = scene["container"], scene["drive"]
    g_level = drive["amplitude"] * (2 * math.pi * drive["frequency"])**2 / 9.81
    pattern = Pattern(Fields(folder / "trajectory.nc"), tray["width"], tray["depth"], periods,
                      every_second=g_level >= 3.5)
    return [f"{pattern.share:.3f}", f"{1000 * pattern.rms:.3f}", f"{1000 * pattern.wavelength:.2f}", pattern.waves,
            f"{pattern.skewness:.2f}", *(f"{order:.2f}" for order in pattern.orders)]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("study", type=Path)
    parser.add_argument("--periods", type=int, default=8, help="how many [8]")
    options = parser.parse_args()
    with open(options.study / "study.csv", encoding="utf-8", newline="") as file:
        members = list(csv.DictReader(file))
    out = csv.writer(sys.stdout, lineterminator="\n")
    out.writerow([*members[0], *COLUMNS])
    for member in members:
        complete = member["state"] == "complete"
        out.writerow([*member.values(), *(looked_at(options.study / member["folder"], options.periods) if complete
                                          else [""] * len(COLUMNS))])


if __name__ == "__main__":
    sys.exit(main())
