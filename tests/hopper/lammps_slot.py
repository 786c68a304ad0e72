#!/usr/bin/env python3
"""The same hopper, emptied by grainreel and by LAMMPS from the same places, with the same law and the same step.

    tests/hopper/lammps_slot.py [--friction MU] PROGRAM FOLDER [B/d]

A box (B + 30 d wide, filled to 1.2 times its width, six grains deep and periodic in depth) is filled and comes to
rest in grainreel. Its final.csv is the start of both programs, which then open a slot of width B in the floor. Both
have linear springs and dashpots with friction (LAMMPS: gran/hooke/history, walls by regions). Printed are both mass
flows between 10 % and 35 % of the mass, by least squares of the mass that has fallen below the floor, and their
ratio. It should be 1 within 5 %. Needs `lmp` (Debian: lammps).
"""
import argparse
import math
import os
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from program import call  # noqa: E402
from rates import rate_of_slot, slope  # noqa: E402
from runs import numbers, texts  # noqa: E402
from slot_rate import D, SOLID  # noqa: E402

STIFFNESS = 2000.0  # N/m
DAMPING = 1555.0  # 1/s, times the effective mass: a restitution of 0.7 for two grains of diameter D
STEP = 1.5e-5  # s, a thirtieth of a contact

SCENE = """[[species]]
name = "grain"
count = {count}
diameter = {{ min = {low}, max = {high} }}
density = {solid}
[contact]
law = "spring-dashpot"
stiffness = {stiffness}
normal_damping = {damping}
tangential_damping = {tangential}
friction = {friction}
[container]
shape = "box"
width = {width}
depth = {depth}
height = {height}
periodic_depth = true
top = "open"
{outlet}
[start]
{start}
[run]
duration = {duration}
step = {step}
accuracy = "draft"
[output]
trajectory = false
measures_interval = "0.05 s"
"""

LAMMPS = """units si
atom_style sphere
boundary p f f
newton off
comm_modify vel yes
read_data {data}
neighbor 0.0006 bin
neigh_modify delay 0 every 5 check yes
pair_style gran/hooke/history {law}
pair_coeff * *
timestep {step}
fix gravity all gravity 9.81 vector 0 0 -1
region left block INF INF -1 -{half_slot} -0.05 0 side out
region right block INF INF {half_slot} 1 -0.05 0 side out
fix left all wall/gran/region hooke/history {law} region left
fix right all wall/gran/region hooke/history {law} region right
fix sides all wall/gran hooke/history {law} yplane -{half_width} {half_width}
fix move all nve/sphere
variable fallen atom "mass * (z < 0)"
compute fallen all reduce sum v_fallen
thermo_style custom step c_fallen
thermo_modify lost ignore
fix out all print {every} "$(step*dt) $(c_fallen)" file {out} screen no
thermo {every}
run {steps}
"""


def law(friction):
    return f"{STIFFNESS} {2 / 7 * STIFFNESS} {DAMPING} {DAMPING / 2} {friction} 1"


def geometry(ratio):
    width, depth = (ratio + 30) * D, 6 * D
    count = int(0.6 * width * depth * 1.2 * width / (math.pi / 6 * D**3))
    mass = count * math.pi / 6 * D**3 * SOLID
    expected = rate_of_slot(1.03, 0.6 * SOLID, depth, ratio * D, D)
    return width, depth, count, 0.1 + 0.45 * mass / expected


def grainreel(program, folder, name, ratio, friction, outlet, start, duration):
    width, depth, count, _ = geometry(ratio)
    out = os.path.join(folder, name)
    if os.path.exists(os.path.join(out, "final.csv")):
        return out
    with open(out + ".toml", "w") as file:
        file.write(SCENE.format(
            count=count, low=0.9 * D, high=1.1 * D, solid=SOLID, stiffness=STIFFNESS, damping=DAMPING,
            tangential=DAMPING / 2, friction=friction, width=width, depth=depth, height=2.2 * width,
            outlet=outlet, start=start, duration=duration, step=STEP))
    call(program, "movie", out + ".toml", "--no-film", "--quiet", "--threads", "1", "--out", out, "--force")
    return out


def write_data(path, grains, width, depth, duration):
    bottom = -(9.81 / 2 * duration**2 + 1)  # farther than a grain falls
    top = max(float(g["z"]) for g in grains) + 0.05
    with open(path, "w") as file:
        file.write(f"slot hopper\n\n{len(grains)} atoms\n1 atom types\n\n"
                   f"{-depth / 2} {depth / 2} xlo xhi\n{-width / 2 - D} {width / 2 + D} ylo yhi\n{bottom} {top} zlo zhi\n\nAtoms\n\n")
        for i, g in enumerate(grains, 1):
            x = (float(g["x"]) + depth / 2) % depth - depth / 2
            file.write(f"{i} 1 {2 * float(g['radius'])!r} {SOLID} {x!r} {g['y']} {g['z']}\n")
        file.write("\nVelocities\n\n")
        for i, g in enumerate(grains, 1):
            file.write(" ".join([str(i)] + [g[k] for k in ("vx", "vy", "vz", "wx", "wy", "wz")]) + "\n")


def lammps(folder, ratio, friction, duration, grains):
    width, depth, _, _ = geometry(ratio)
    out = os.path.join(folder, "lammps.txt")
    if os.path.exists(out):
        return out
    write_data(os.path.join(folder, "start.data"), grains, width, depth, duration)
    script = os.path.join(folder, "slot.lammps")
    with open(script, "w") as file:
        file.write(LAMMPS.format(
            data=os.path.join(folder, "start.data"), law=law(friction), step=STEP, half_slot=ratio * D / 2,
            half_width=width / 2, every=100, steps=round(duration / STEP), out=out + ".part"))
    call("lmp", "-in", script, "-log", os.path.join(folder, "lammps.log"), "-screen", "none")
    os.rename(out + ".part", out)
    return out


def mass_of(radius):
    return 4 / 3 * math.pi * radius**3 * SOLID


def below_floor(out, times):
    """Mass that has passed the floor, from when and how fast each grain left at the exit's depth."""
    passed = []
    for row in numbers(os.path.join(out, "outflow.csv")):
        fall, speed = -row["z"], -row["vz"]
        passed.append((row["time_s"] - (speed - math.sqrt(max(0.0, speed**2 - 2 * 9.81 * fall))) / 9.81,
                       mass_of(row["radius"])))
    passed.sort()
    points, sum_of, at = [], 0.0, 0
    for time in times:
        while at < len(passed) and passed[at][0] <= time:
            sum_of += passed[at][1]
            at += 1
        points.append((time, sum_of))
    return points


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--friction", type=float, default=0.5, help="of the grains and the walls [0.5]")
    parser.add_argument("program")
    parser.add_argument("folder", type=os.path.abspath)
    parser.add_argument("ratio", type=float, nargs="?", default=12.0, metavar="B/d")
    words = parser.parse_args()
    program, folder, ratio, friction = words.program, words.folder, words.ratio, words.friction
    os.makedirs(folder, exist_ok=True)
    duration = geometry(ratio)[3]
    rest = grainreel(program, folder, "rest", ratio, friction, "", 'settle_limit = "3 s"', 0.05)
    start = f'method = "file"\nfile = "{rest}/final.csv"'
    ours = grainreel(program, folder, "slot", ratio, friction, f"outlet = {{ width = {ratio * D}, exit_depth = {4 * D} }}",
                     start, duration)
    grains = texts(os.path.join(rest, "final.csv"))
    theirs = lammps(folder, ratio, friction, duration, grains)
    mass = sum(mass_of(float(g["radius"])) for g in grains)
    with open(theirs) as file:
        rows = [tuple(map(float, line.split())) for line in file if not line.startswith("#")]
    window = [(t, m) for t, m in rows if 0.1 * mass < m < 0.35 * mass]
    mine = [(t, m) for t, m in below_floor(ours, [t for t, _ in rows]) if 0.1 * mass < m < 0.35 * mass]
    if min(len(window), len(mine)) < 20:
        raise SystemExit("too few rows within the window: a hopper has clogged, or the run is too short")
    a, b = slope(mine), slope(window)
    print(f"B/d {ratio:g}, {len(grains)} grains: grainreel {a:.4f} kg/s, LAMMPS {b:.4f} kg/s, ratio {a / b:.3f}")


if __name__ == "__main__":
    main()
