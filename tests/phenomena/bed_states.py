#!/usr/bin/env python3
"""Which state is a shallow shaken bed in? Two numbers of measures.csv over whole cycles of the drive.

With growing depth (Thomas et al. 1989, in the words of the thesis that this program grew from): Newtonian-I, grains fly
at random; Newtonian-II, a dilute layer above a dense one during a part of the cycle; coherent-expanded, the bed moves as
one mass but expands and contracts; coherent-condensed, it moves as one mass and stays dense.
"""
import math


def coherence(run, after):
    """Share of the grains' kinetic energy that is in the motion of their centre of mass: 1 for a block, 0 for a gas."""
    rows = [row for row in run.rows if row["time"] >= after]
    centre, all_grains = 0.0, 0.0
    for before, row, behind in zip(rows, rows[1:], rows[2:]):
        mass = row["gravitational"] / (9.81 * row["centre_z"])
        rise = (behind["centre_z"] - before["centre_z"]) / (behind["time"] - before["time"])
        centre += 0.5 * mass * rise * rise
        all_grains += row["kinetic"]
    return centre / all_grains


def over_the_cycle(run, column, after, phases=16):
    """The mean of a column at each of so many phases of the drive."""
    sums = [[0.0, 0] for _ in range(phases)]
    for row in run.rows:
        if row["time"] >= after and not math.isnan(row[column]):
            phase = sums[int(row["phase_turns"] * phases) % phases]
            phase[0] += row[column]
            phase[1] += 1
    return [total / count for total, count in sums if count]


def profiles(trajectory, diameter, room, after, phases=16, most=30):
    """Solid fraction at each phase, in slices one diameter high above the floor: a sphere counts where its parts are."""
    times, cycles = trajectory.values("time"), trajectory.values("cycles")
    floor, places = trajectory.values("floor_offset"), trajectory.values("coordinates")
    radii = trajectory.values("radius")
    grains = trajectory.shape("radius")[1]
    sums, moments = [[0.0] * most for _ in range(phases)], [0] * phases
    for frame, time in enumerate(times):
        if time < after:
            continue
        phase = round(cycles[frame] * phases) % phases
        moments[phase] += 1
        for i in range(frame * grains, (frame + 1) * grains):
            height, radius = places[3 * i + 2] - floor[3 * frame + 2], radii[i]
            lowest = max(0, int((height - radius) / diameter))
            for slice_ in range(lowest, min(most, int((height + radius) / diameter) + 1)):
                sums[phase][slice_] += cap(radius, (slice_ + 1) * diameter - height) - cap(radius, slice_ * diameter - height)
    return [[v / (count * room * diameter) for v in row] for row, count in zip(sums, moments) if count]


def cap(radius, height):
    """Volume of a sphere below a height over its centre."""
    h = min(max(height + radius, 0.0), 2 * radius)
    return math.pi * h * h * (3 * radius - h) / 3


def state(coherent, solid, densest):
    """By the share of coherent motion, the bed's solid fraction over the cycle, and the largest one of any slice."""
    if coherent < 0.5:
        return "Newtonian-I" if densest < DENSE else "Newtonian-II"
    return "coherent-expanded" if min(solid) < CONDENSED else "coherent-condensed"


DENSE = 0.3  # half of random packing: grains of a layer as dense as that touch again and again
CONDENSED = 0.4  # two thirds of random packing


def main():
    import argparse
    import sys
    from pathlib import Path

    sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
    from fields import Fields
    from runs import Measures

    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("runs", type=Path, nargs="+", metavar="RUN")
    parser.add_argument("--profiles", action="store_true", help="write shallow_N.dat of each run, of N grains, for gnuplot")
    options = parser.parse_args()
    print("grains,coherence,least_expansion,most_expansion,least_solid,most_solid,densest_slice,state")
    for folder in options.runs:
        run, trajectory = Measures(folder), Fields(folder / "trajectory.nc")
        coherent = coherence(run, 1)
        expansion, solid = over_the_cycle(run, "bed_expansion", 1), over_the_cycle(run, "bed_solid_fraction", 1)
        cycle = profiles(trajectory, 0.002, floor_area(folder), 1)
        densest = max(max(row) for row in cycle)
        count = trajectory.shape("radius")[1]
        print(f"{count},{coherent:.3f},{min(expansion):.2f},{max(expansion):.2f},{min(solid):.3f},{max(solid):.3f},"
              f"{densest:.3f},{state(coherent, solid, densest)}", flush=True)
        if options.profiles:
            write_profiles(f"shallow_{count}.dat", cycle)


def floor_area(run):
    """Of a run in a box, m2."""
    import tomllib

    container = tomllib.loads((run / "scene.toml").read_text(encoding="utf-8"))["container"]
    return container["width"] * container["depth"]


def write_profiles(name, cycle):
    with open(name, "w") as file:
        for phase, row in enumerate(cycle + cycle[:1]):
            for slice_, value in enumerate(row):
                file.write(f"{phase / len(cycle):.4f} {slice_ + 0.5} {value:.4f}\n")
            file.write("\n")


if __name__ == "__main__":
    main()
