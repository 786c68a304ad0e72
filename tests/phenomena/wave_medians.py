#!/usr/bin/env python3
"""How long are the waves of a shaken layer, as the median over many periods?

    tests/phenomena/wave_medians.py STUDY [--from SECONDS] [--phase TURNS]

STUDY is the folder of a finished study with the instrument `surface`, whose members have rows of measures at that phase
(eight rows a period do, as they are by default). Prints its study.csv with two more columns: the median of
`surface_wavelength` over the rows at that phase [0] from that time [1.5 s] on, and how many they are. The `wavelength` of
study.csv itself is of one picture only, the last.
"""
import argparse
import csv
import statistics
import sys
from pathlib import Path


def at_phase(rows, start, phase):
    """The wavelengths in those rows, in metres."""
    return [float(row["surface_wavelength_m"]) for row in rows
            if float(row["time_s"]) >= start - 1e-9
            and abs((float(row["phase_turns"]) - phase + 0.5) % 1 - 0.5) < 0.02
            and row["surface_wavelength_m"] not in ("", "nan")]


def measures(folder):
    with open(folder / "measures.csv", encoding="utf-8", newline="") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("study", type=Path)
    parser.add_argument("--from", dest="start", type=float, default=1.5, help="s [1.5]")
    parser.add_argument("--phase", type=float, default=0.0, help="of the drive, turns [0]")
    options = parser.parse_args()
    with open(options.study / "study.csv", encoding="utf-8", newline="") as file:
        members = list(csv.DictReader(file))
    out = csv.writer(sys.stdout, lineterminator="\n")
    out.writerow([*members[0], "median_wavelength", "periods"])
    for member in members:
        lengths = at_phase(measures(options.study / member["folder"]), options.start, options.phase) \
            if member["state"] == "complete" else []
        out.writerow([*member.values(), f"{statistics.median(lengths):.6g}" if lengths else "", len(lengths)])


if __name__ == "__main__":
    sys.exit(main())
