#!/usr/bin/env python3
"""How fast a flat-bottomed hopper empties through a slot, against the law of Beverloo for slots.

    tests/hopper/slot_rate.py [--depth L/d] [--friction MU] PROGRAM FOLDER [B/d ...]

The hopper is a box, B + 30 d wide, filled to 1.2 times its width, six grains deep (or L) and periodic in depth, so that
no front and back walls hold grains back. For each slot of width B the program runs one discharge into FOLDER and
writes outflow.csv; a run that is there already is used again. The rate is the slope of the mass that has left,
between 15 % and 45 % of all. Printed are the rates, C of

    W = C rho_b sqrt(g) L (B - k d)^(3/2),    k = 1.4

(Beverloo, Leniger & van de Velde 1961, Chem. Eng. Sci. 15, 260, with the exponent of a slot: Myers & Sellers 1978,
in Nedderman 1992, Statics and Kinematics of Granular Materials, ch. 10: C = 1.03), with the bulk density rho_b of
the bed at rest, the exponent of (B - k d) that fits the rates best, and the k with which it is 1.5.
"""
import argparse
import math
import os
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from program import call  # noqa: E402
from rates import K, rate_of_slot, slope  # noqa: E402
from runs import numbers  # noqa: E402

D = 0.004  # m, mean diameter
SOLID = 2500.0  # kg/m3
SCENE = """title = "Slot hopper, B = {ratio:g} d"
[[species]]
name = "grain"
count = {count}
diameter = {{ min = {low}, max = {high} }}
density = {solid}
[contact]
restitution = 0.7
friction = {friction}
[container]
shape = "box"
width = {width}
depth = {depth}
height = {height}
periodic_depth = true
top = "open"
outlet = {{ width = {slot}, exit_depth = {exit} }}
[start]
settle_limit = "2 s"
[run]
duration = {duration}
accuracy = "draft"
[output]
trajectory = false
measures_interval = "0.05 s"
"""


def scene_of(ratio, depth, friction):
    width = (ratio + 30) * D
    volume = math.pi / 6 * D**3
    count = int(0.6 * width * depth * 1.2 * width / volume)
    mass = count * volume * SOLID
    expected = rate_of_slot(1.03, 0.6 * SOLID, depth, ratio * D, D)
    return mass, SCENE.format(
        ratio=ratio, count=count, friction=friction, low=0.9 * D, high=1.1 * D, solid=SOLID, width=width, depth=depth,
        height=2.2 * width, slot=ratio * D, exit=4 * D, duration=0.1 + 0.55 * mass / expected)


def run(program, folder, ratio, depth, friction):
    mass, text = scene_of(ratio, depth, friction)
    out = os.path.join(folder, f"slot_{ratio:g}")
    if not os.path.exists(os.path.join(out, "final.csv")):
        path = out + ".toml"
        with open(path, "w") as file:
            file.write(text)
        call(program, "movie", path, "--no-film", "--quiet", "--threads", "1", "--out", out, "--force")
    rows = numbers(os.path.join(out, "outflow.csv"))
    return rate_of([(row["time_s"], 4 / 3 * math.pi * row["radius"] ** 3 * SOLID) for row in rows], mass)


def rate_of(left, mass):
    """kg/s, by least squares over the mass that has left."""
    sum_of, points = 0.0, []
    for time, one in left:
        sum_of += one
        if 0.15 * mass < sum_of < 0.45 * mass:
            points.append((time, sum_of))
    if len(points) < 100:
        raise SystemExit(f"only {len(points)} grains left within the window: the hopper has clogged, or the run is too short")
    return slope(points)


def exponent(points, k):
    """Of (B - k d), by least squares of logarithms. points: (B/d, rate)."""
    return slope([(math.log(b - k), math.log(w)) for b, w in points])


def best_k(points):
    """With which the exponent is 1.5, by bisection; it falls with k."""
    low, high = 0.0, min(b for b, _ in points) - 0.01
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if exponent(points, middle) > 1.5 else (low, middle)
    return (low + high) / 2


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--depth", type=float, default=6, help="of the hopper, in grain diameters [6]")
    parser.add_argument("--friction", type=float, default=0.5, help="of the grains and the walls [0.5]")
    parser.add_argument("program")
    parser.add_argument("folder")
    parser.add_argument("ratios", type=float, nargs="*", default=[6, 9, 14, 20], metavar="B/d")
    words = parser.parse_args()
    os.makedirs(words.folder, exist_ok=True)
    depth, points = words.depth * D, []
    print("  B/d   W in kg/s       C   W/L in kg/(s m)")
    for ratio in words.ratios:
        rate = run(words.program, words.folder, ratio, depth, words.friction)
        c = rate / rate_of_slot(1, 0.6 * SOLID, depth, ratio * D, D)
        points.append((ratio, rate))
        print(f"{ratio:5g}  {rate:10.4f}  {c:6.3f}  {rate / depth:10.3f}", flush=True)
    if len(points) > 1:
        print(f"exponent of (B - {K} d): {exponent(points, K):.3f}; it is 1.5 with k = {best_k(points):.2f}")


if __name__ == "__main__":
    main()
