#!/usr/bin/env python3
"""The heap that stays on a plate when what lay beside it runs off: its angle of repose.

    tests/bench/heap_on_plate.py PROGRAM [--depth METRES] [--threads N] [--out FOLDER]

52,000 grains of 10 mm lie in a box 1 m wide and 0.2 m deep on a plate 0.9 m wide, 0.4 m above the floor. Flaps in the
gaps beside the plate swing open, and what is not held runs off and leaves the run 0.15 m lower: grains so soft would
sink into the floor below. Published: Zhou, Xu, Yu & Zulli 2002, Powder Technol. 125, 45, as Lethe's examples have it
(E 1 MPa, nu 0.3, e 0.9, friction 0.2, rolling friction 0.1): 19.7 degrees. A box of another depth has as many grains
for its depth. A run that is there already is measured again.
Exit status: 0 within 2 degrees of that, 1 not.
"""
import argparse
import csv
import json
import math
import shutil
import subprocess
import sys
from pathlib import Path

PUBLISHED, ALLOWED = 19.7, 2.0  # degrees
DIAMETER, PLATE, GAP, HEIGHT = 0.01, 0.9, 0.05, 0.4  # m
MODULUS = 1e6 / (2 * (1 - 0.3**2))  # Pa, E* of two grains and of a grain and a wall
MAKER = Path(__file__).resolve().parents[2] / "scenes" / "meshes" / "make_meshes.py"

SCENE = """title = "A heap on a plate"
[[species]]
name = "grains"
count = {count}
diameter = {diameter}
density = 2400
[contact]
law = "hertz"
attraction = true
modulus = {modulus:.9g}
tangential_ratio = {ratio:.9g}
restitution = 0.9
friction = 0.2
rolling_friction = 0.1
[container]
shape = "box"
width = 1
depth = {depth}
height = 1
top = "open"
[[mesh]]
name = "plate"
file = "plate.stl"
position = [0, 0, {height}]
[[mesh]]
name = "right_flap"
file = "flap.stl"
position = [0, 0.4745, {height}]
turn = {{ axis = [1, 0, 0], through = [0, 0.499, {height}], rate = 6.2831853, over = 0.05, until = 0.25 }}
[[mesh]]
name = "left_flap"
file = "flap.stl"
position = [0, -0.4745, {height}]
turn = {{ axis = [1, 0, 0], through = [0, -0.499, {height}], rate = -6.2831853, over = 0.05, until = 0.25 }}
[[exit]]
low = [-1, -1, -1]
high = [1, 1, {gone}]
[start]
region = {{ low = [{back}, -0.5, {above}], high = [{front}, 0.5, 1] }}
[run]
duration = 3
step = 1e-4
[output]
trajectory = false
measures_interval = 0.05
"""


def highest(file):
    """In bins of two diameters across the plate: place, and height of the highest centre above the plate."""
    bins = {}
    with open(file, newline="") as rows:
        for row in csv.DictReader(rows):
            y, z = float(row["y"]), float(row["z"]) - HEIGHT
            if z > 0 and abs(y) < PLATE / 2:
                k = math.floor(y / (2 * DIAMETER))
                bins[k] = max(bins.get(k, 0.0), z)
    return [((k + 0.5) * 2 * DIAMETER, z) for k, z in sorted(bins.items())]


def angle(points):
    """Degrees, of the line of least squares."""
    n, sy, sz = len(points), sum(y for y, _ in points), sum(z for _, z in points)
    slope = (n * sum(y * z for y, z in points) - sy * sz) / (n * sum(y * y for y, _ in points) - sy * sy)
    return math.degrees(math.atan(abs(slope)))


def is_complete(run):
    record = run / "run.json"
    return record.exists() and json.loads(record.read_text())["status"] == "complete"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path)
    parser.add_argument("--depth", type=float, default=0.2)
    parser.add_argument("--threads", type=int)
    parser.add_argument("--out", type=Path, default=Path("output/heap_on_plate"))
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    run, depth = options.out / "run", options.depth
    if not is_complete(run):
        for name, width in (("plate", PLATE), ("flap", GAP - 0.001)):
            subprocess.run([sys.executable, MAKER, "plate", options.out / f"{name}.stl", f"width={width}",
                            f"depth={depth - 0.0002}"], check=True)
        scene = options.out / "scene.toml"
        scene.write_text(SCENE.format(
            count=round(52000 * depth / 0.2), diameter=DIAMETER, modulus=MODULUS, ratio=2 * 0.7 / 1.7, depth=depth,
            height=HEIGHT, gone=HEIGHT - 0.15, above=HEIGHT + 0.001, back=-depth / 2, front=depth / 2))
        shutil.rmtree(run, ignore_errors=True)
        done = subprocess.run([options.program, "movie", scene, "--no-film", "--no-report", "--out", run,
                               *(["--threads", str(options.threads)] if options.threads else [])],
                              stdout=subprocess.DEVNULL)
        if done.returncode:
            sys.exit(f"the run ended with {done.returncode}")
    # The flanks without the tip and without the rim.
    points = [point for point in highest(run / "final.csv") if 0.08 < abs(point[0]) < 0.4]
    sides = [angle([point for point in points if side * point[0] > 0]) for side in (-1, 1)]
    mean = sum(sides) / 2
    print(f"angle of repose: {mean:.1f} degrees (left {sides[0]:.1f}, right {sides[1]:.1f}); published {PUBLISHED}")
    return 0 if abs(mean - PUBLISHED) <= ALLOWED else 1


if __name__ == "__main__":
    sys.exit(main())
