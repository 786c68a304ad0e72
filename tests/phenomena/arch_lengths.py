#!/usr/bin/env python3
"""How long are the arches on which a shaken layer stands?

    tests/phenomena/arch_lengths.py [--from SECONDS] [--column METRES] RUN ...

Each RUN is a finished run in a box, with a trajectory of one frame a period. The lower face of the layer is the lowest
point of the grains over the floor, in columns across the width. Its shape is a sum of cosines with 2 W/m as wavelength, W
being the width: side walls allow these. Prints for the frames from that time on, with P the power of a mode:
  rms         root mean square of the lower face about its mean
  mean        wavelength of the mean wave number, 2 W sum(P)/sum(m P)
  most        wavelength that has the largest power
  arches      mean number in a frame, of stretches of four columns or more that are more than 1 mm above the floor
Waves shorter than two columns are left out.
"""
import argparse
import math
import sys
import tomllib
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from fields import Fields  # noqa: E402


def lower_face(places, radii, floor, width, columns):
    face = [math.inf] * columns
    for i, radius in enumerate(radii):
        column = min(columns - 1, max(0, int((places[3 * i + 1] / width + 0.5) * columns)))
        face[column] = min(face[column], places[3 * i + 2] - radius - floor)
    if math.inf in face:  # a column without grains is as high as the nearest one that has some
        known = [column for column, height in enumerate(face) if height < math.inf]
        face = [face[min(known, key=lambda other: abs(other - column))] for column in range(columns)]
    return face


def powers(face, most):
    """Of the modes 1 to `most`: half of the square of the amplitude."""
    n, mean = len(face), sum(face) / len(face)
    amplitude = [2 / n * sum((h - mean) * math.cos(math.pi * m * (i + 0.5) / n) for i, h in enumerate(face))
                 for m in range(1, most + 1)]
    return [0.5 * a * a for a in amplitude]


def arches(face):
    """Stretches that the floor does not carry; the layer as a whole may be in the air, and is one then."""
    count, length = 0, 0
    for height in [*face, 0.0]:
        if height > 0.001:
            length += 1
        else:
            count += length >= 4
            length = 0
    return count


def look_at(run, start, column):
    """The width, the mean power of each mode and the mean number of arches."""
    container = tomllib.loads((run / "scene.toml").read_text(encoding="utf-8"))["container"]
    width = container["width"]
    columns = round(width / column)
    trajectory = Fields(run / "trajectory.nc")
    grains, times = trajectory.shape("radius")[1], trajectory.values("time")
    places, radii, floor = (trajectory.values(name) for name in ("coordinates", "radius", "floor_offset"))
    sums, count, frames = [0.0] * columns, 0, 0
    for k, time in enumerate(times):
        if time < start:
            continue
        face = lower_face(places[3 * k * grains:3 * (k + 1) * grains], radii[k * grains:(k + 1) * grains],
                          floor[3 * k + 2], width, columns)
        sums = [one + more for one, more in zip(sums, powers(face, len(sums)))]
        count += arches(face)
        frames += 1
    if frames == 0:
        raise SystemExit(f"{run}: has no frame from {start} s on")
    return width, [one / frames for one in sums], count / frames


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("runs", type=Path, nargs="+", metavar="RUN")
    parser.add_argument("--from", dest="start", type=float, default=0.7, help="frames from this time on, s [0.7]")
    parser.add_argument("--column", type=float, default=0.003, help="width of a column, m [0.003]")
    options = parser.parse_args()
    print("run,rms_mm,mean_mm,most_mm,arches")
    for run in options.runs:
        width, power, count = look_at(run, options.start, options.column)
        total = sum(power)
        mean = 2 * width * total / sum(m * p for m, p in enumerate(power, 1))
        most = 2 * width / (1 + power.index(max(power)))
        print(f"{run.name},{1000 * math.sqrt(total):.2f},{1000 * mean:.0f},{1000 * most:.0f},{count:.1f}", flush=True)


if __name__ == "__main__":
    main()
