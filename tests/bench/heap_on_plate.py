#!/usr/bin/env python3
"""The heap that stays on a plate when what lay beside it runs off: its angle of repose.

    tests/bench/heap_on_plate.py PROGRAM [--depth METRES] [--threads N] [--out FOLDER] [--liggghts MODEL]
                                         [--rolling-length MM]

52,000 grains of 10 mm lie in a box 1 m wide and 0.2 m deep on a plate 0.9 m wide, 0.4 m above the floor. Flaps in the
gaps beside the plate swing open, and what is not held runs off and leaves the run 0.15 m lower: grains so soft would
sink into the floor below. Published: Zhou, Xu, Yu & Zulli 2002, Powder Technol. 125, 45, as Lethe's examples have it
(E 1 MPa, nu 0.3, e 0.9, friction 0.2, rolling friction 0.1): 19.7 degrees. A box of another depth has as many grains
for its depth. A run that is there already is measured again. --liggghts gives the same packing to LIGGGHTS, on one rank
and with its model of rolling resistance: cdt, a torque of constant size (as Lethe has it), or epsd2, a spring (as ours).
There the flaps are gone at once. Zhou's fit takes rolling friction as a length: --rolling-length 1 gives all contacts that
of the 19.7 degrees, where 0.1 times the effective radius is 0.25 mm between grains and 0.5 mm at a wall.
Exit status: 0 within 2 degrees of the published angle or, with a length, of the fit's, 1 not.
"""
import argparse
import json
import math
import shutil
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from rates import slope  # noqa: E402
from runs import texts  # noqa: E402

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
rolling_friction = {rolling:.9g}
[contact.wall]
rolling_friction = {rolling_at_walls:.9g}
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


# From the same packing. The lower face of the box takes away what runs off.
DECK = """units si
atom_style granular
atom_modify map array
boundary f f f
newton off
communicate single vel yes
processors 1 1 1
read_data start.data
neighbor 0.002 bin
neigh_modify delay 0
soft_particles yes
fix m1 all property/global youngsModulus peratomtype 1e6
fix m2 all property/global poissonsRatio peratomtype 0.3
fix m3 all property/global coefficientRestitution peratomtypepair 1 0.9
fix m4 all property/global coefficientFriction peratomtypepair 1 0.2
fix m5 all property/global coefficientRollingFriction peratomtypepair 1 0.1
pair_style gran model hertz tangential history rolling_friction {rolling}
pair_coeff * *
timestep 1e-4
fix weight all gravity 9.81 vector 0 0 -1
fix plate all mesh/surface file plate.stl type 1 move 0 0 {height}
fix p0 all wall/gran model hertz tangential history rolling_friction {rolling} mesh n_meshes 1 meshes plate
fix p1 all wall/gran model hertz tangential history rolling_friction {rolling} primitive type 1 xplane {back}
fix p2 all wall/gran model hertz tangential history rolling_friction {rolling} primitive type 1 xplane {front}
fix p3 all wall/gran model hertz tangential history rolling_friction {rolling} primitive type 1 yplane -0.5
fix p4 all wall/gran model hertz tangential history rolling_friction {rolling} primitive type 1 yplane 0.5
fix motion all nve/sphere
thermo 1000
thermo_modify lost ignore
run 30000
write_dump all custom end.dump id x y z
"""


def highest(centres):
    """In bins of two diameters across the plate: place, and height of the highest centre above the plate."""
    bins = {}
    for y, z in centres:
        if z > HEIGHT and abs(y) < PLATE / 2:
            k = math.floor(y / (2 * DIAMETER))
            bins[k] = max(bins.get(k, 0.0), z - HEIGHT)
    return [((k + 0.5) * 2 * DIAMETER, z) for k, z in sorted(bins.items())]


def fitted(between, at_walls):
    """The angle of Zhou's fit, in degrees, for lengths of rolling friction in mm."""
    return 68.61 * 0.2**(0.27 + 0.22) * between**0.06 * at_walls**0.12 * (1000 * DIAMETER)**-0.2


def angle(points):
    """Degrees, of the line of least squares."""
    return math.degrees(math.atan(abs(slope(points))))


def is_complete(run):
    record = run / "run.json"
    return record.exists() and json.loads(record.read_text())["status"] == "complete"


def run(options, name, *settings):
    """A run of the scene, made where it is not there yet. Returns its last state: y and z of the grains."""
    folder = options.out / name
    if not is_complete(folder):
        shutil.rmtree(folder, ignore_errors=True)
        threads = ["--threads", str(options.threads)] if options.threads else []
        done = subprocess.run([options.program, "movie", options.out / "scene.toml", "--no-film", "--no-report", "--out",
                               folder, *threads, *settings], stdout=subprocess.DEVNULL)
        if done.returncode:
            sys.exit(f"the run ended with {done.returncode}")
    return texts(folder / "final.csv")


def run_of_liggghts(options, depth):
    folder = options.out / options.liggghts
    folder.mkdir(exist_ok=True)
    start = run(options, "start", "--duration", "1e-4 s")
    head = (f"from final.csv\n\n{len(start)} atoms\n1 atom types\n\n{-depth / 2 - 0.001} {depth / 2 + 0.001} xlo xhi\n"
            f"-0.501 0.501 ylo yhi\n{HEIGHT - 0.15} 1.5 zlo zhi\n\nAtoms\n\n")
    lines = [f"{k} 1 {DIAMETER} 2400 {row['x']} {row['y']} {row['z']}\n" for k, row in enumerate(start, 1)]
    (folder / "start.data").write_text(head + "".join(lines))
    shutil.copy(options.out / "plate.stl", folder)
    (folder / "in.heap").write_text(DECK.format(rolling=options.liggghts, height=HEIGHT, back=-depth / 2, front=depth / 2))
    with open(folder / "said", "w") as said:
        if subprocess.run(["liggghts", "-in", "in.heap"], cwd=folder, stdout=said, stderr=said).returncode:
            sys.exit(f"LIGGGHTS ended early: see {folder / 'said'}")
    lines = (folder / "end.dump").read_text().splitlines()
    return [dict(zip(("id", "x", "y", "z"), line.split())) for line in lines[9:]]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path)
    parser.add_argument("--depth", type=float, default=0.2)
    parser.add_argument("--threads", type=int)
    parser.add_argument("--out", type=Path, default=Path("output/heap_on_plate"))
    parser.add_argument("--liggghts", metavar="MODEL", choices=("cdt", "epsd2"))
    parser.add_argument("--rolling-length", metavar="MM", type=float, help="of rolling friction, in all contacts")
    options = parser.parse_args()
    if options.liggghts and options.rolling_length:
        parser.error("--rolling-length is for a run of grainreel")
    options.out.mkdir(parents=True, exist_ok=True)
    depth = options.depth
    for name, width in (("plate", PLATE), ("flap", GAP - 0.001)):
        subprocess.run([sys.executable, MAKER, "plate", options.out / f"{name}.stl", f"width={width}",
                        f"depth={depth - 0.0002}"], check=True)
    length = options.rolling_length
    rolling, rolling_at_walls = (length / (250 * DIAMETER), length / (500 * DIAMETER)) if length else (0.1, 0.1)
    (options.out / "scene.toml").write_text(SCENE.format(rolling=rolling, rolling_at_walls=rolling_at_walls,
        count=round(52000 * depth / 0.2), diameter=DIAMETER, modulus=MODULUS, ratio=2 * 0.7 / 1.7, depth=depth,
        height=HEIGHT, gone=HEIGHT - 0.15, above=HEIGHT + 0.001, back=-depth / 2, front=depth / 2))
    grains = run_of_liggghts(options, depth) if options.liggghts else run(options, "run")
    centres = [(float(grain["y"]), float(grain["z"])) for grain in grains]
    # The flanks without the tip and without the rim.
    points = [point for point in highest(centres) if 0.08 < abs(point[0]) < 0.4]
    sides = [angle([point for point in points if side * point[0] > 0]) for side in (-1, 1)]
    mean = sum(sides) / 2
    expected = fitted(length, length) if length else PUBLISHED
    print(f"angle of repose: {mean:.1f} degrees (left {sides[0]:.1f}, right {sides[1]:.1f}); "
          f"{'by the fit' if length else 'published'} {expected:.1f}")
    return 0 if abs(mean - expected) <= ALLOWED else 1


if __name__ == "__main__":
    sys.exit(main())
