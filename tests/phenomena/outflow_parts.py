#!/usr/bin/env python3
"""Does what runs out first hold more of one species than what runs out last?

    tests/phenomena/outflow_parts.py [--parts N] [--type TYPE] RUN ...

RUN is a finished run with an outlet; of several, such as the seeds of one setting, the means are printed with their 95 %
intervals. The outflow is cut into parts of equal mass in the order in which the grains left. Printed is the share of a
species in the mass of each part, and its share in all.
"""
import argparse
import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from runs import numbers  # noqa: E402

STUDENT = {2: 12.706, 3: 4.303, 4: 3.182, 5: 2.776, 6: 2.571, 7: 2.447, 8: 2.365, 9: 2.306, 10: 2.262}  # by runs
LARGE = 2.23  # from 11 runs on, where it falls from 2.228 to 1.96


def shares(run, parts, kind):
    """Of each part, and of all: the densities of the species are equal, so the cube of the radius stands for the mass."""
    grains = [(int(row["type"]), row["radius"]**3) for row in numbers(run / "outflow.csv")]
    if len(grains) < parts:
        raise SystemExit(f"{run}: has {len(grains)} grains in its outflow.csv, less than one for each part")
    total, gone = sum(mass for _, mass in grains), 0.0
    of_kind, of_all = [0.0] * (parts + 1), [0.0] * (parts + 1)
    for type_, mass in grains:
        for place in (min(parts - 1, int(parts * gone / total)), parts):
            of_all[place] += mass
            of_kind[place] += mass * (type_ == kind)
        gone += mass
    return [one / all_ for one, all_ in zip(of_kind, of_all)]


def mean_and_interval(values):
    n, mean = len(values), sum(values) / len(values)
    if n < 2:
        return f"{mean:.3f}"
    deviation = math.sqrt(sum((value - mean)**2 for value in values) / (n - 1))
    return f"{mean:.3f} ± {STUDENT.get(n, LARGE) * deviation / math.sqrt(n):.3f}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("runs", type=Path, nargs="+", metavar="RUN")
    parser.add_argument("--parts", type=int, default=5, help="how many [5]")
    parser.add_argument("--type", type=int, default=2, help="of the species, as outflow.csv counts them [2]")
    options = parser.parse_args()
    of_runs = [shares(run, options.parts, options.type) for run in options.runs]
    columns = [mean_and_interval(column) for column in zip(*of_runs)]
    print(f"{len(of_runs)} runs: " + ", ".join(columns[:-1]) + f"; of all {columns[-1]}")


if __name__ == "__main__":
    main()
