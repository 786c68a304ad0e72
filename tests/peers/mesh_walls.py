#!/usr/bin/env python3
"""grainreel and LIGGGHTS with walls from the same STL file, from one state, with the same law and the same step.

    tests/peers/mesh_walls.py PROGRAM FOLDER [drum|hopper] [--facets N] [--grains N] [--until SECONDS] [--only liggghts]

drum    a drum, 100 mm across and 30 mm long, turns with 2 rad/s: mean height and place of the grains, torque
hopper  a round hopper with a cone of 45 degrees empties through its orifice: mass flow

The state is that of grainreel's grains at rest (drum still, a gate below the orifice). Both programs then have linear
springs and dashpots with friction, without pull and without tangential dashpot (LIGGGHTS: hooke/stiffness, tangential
history). Printed are means over blocks of time with their standard errors, the difference over its error, and
grain-steps a second of processor time (user time) on one thread each. A run that is there already is used again. Needs `liggghts` (Debian:
liggghts). With --only liggghts the grains begin on a lattice, to try the deck where there is no PROGRAM.
Exit status: 0 alike within three standard errors, 1 not, 2 a mistake, 77 no liggghts.
"""
import argparse
import csv
import math
import re
import resource
import shutil
import statistics
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from runs import numbers, texts  # noqa: E402

MAKER = Path(__file__).resolve().parents[2] / "scenes" / "meshes" / "make_meshes.py"
D, SOLID = 0.003, 2500.0  # m, kg/m3
STIFFNESS, DAMPING, FRICTION = 2000.0, 4250.0, 0.5  # N/m; 1/s, times the effective mass
STEP, EVERY = 1e-5, 100  # s; steps between two looks
RATE = 2.0  # rad/s
NUDGE = 0.3  # m/s, downwards, of one grain: a bed that moves is taken as it is, and one at rest would settle once more
BELOW = -0.02  # m; grains are counted as flowed out there

SCENE = """[[species]]
name = "grain"
count = {count}
diameter = {d}
density = {solid}
[contact]
law = "spring-dashpot"
stiffness = {stiffness}
normal_damping = {damping}
tangential_damping = 0
friction = {friction}
[container]
shape = "mesh"
mesh = "vessel"
[[mesh]]
name = "vessel"
file = "vessel.stl"
{more}
[start]
{start}
[run]
duration = {duration}
step = {step}
[output]
trajectory = false
measures_interval = {interval}
instruments = ["walls"{instruments}]
"""

DECK = """units si
atom_style granular
atom_modify map array
boundary f f f
newton off
communicate single vel yes
read_data state.data
neighbor 0.0006 bin
neigh_modify delay 0
fix kn all property/global kn peratomtypepair 1 {stiffness}
fix kt all property/global kt peratomtypepair 1 {tangential}
fix gn all property/global gamman peratomtypepair 1 {damping}
fix gt all property/global gammat peratomtypepair 1 0
fix mu all property/global coefficientFriction peratomtypepair 1 {friction}
pair_style gran model hooke/stiffness tangential history absolute_damping off limitForce on tangential_damping off
pair_coeff * *
timestep {step}
fix g all gravity 9.81 vector 0 0 -1
fix vessel all mesh/surface/stress file vessel.stl type 1 curvature 10 curvature_tolerant yes reference_point 0 0 0
fix wall all wall/gran model hooke/stiffness tangential history mesh n_meshes 1 meshes vessel absolute_damping off limitForce on tangential_damping off
{move}
fix i all nve/sphere
compute y all reduce ave y
compute z all reduce ave z
variable below atom "mass * (z < {below})"
compute below all reduce sum v_below
thermo_style custom step atoms ke c_y c_z c_below f_vessel[4]
thermo_modify lost ignore norm no  # what falls through the bottom of the box is gone
thermo {thermo}
fix out all print {every} "$(step*dt) $(c_y) $(c_z) $(c_below) $(f_vessel[4]) $(atoms)" file looks.txt screen no
run {steps}
"""


def make_mesh(name, file, *numbers):
    subprocess.run([sys.executable, MAKER, name, file, *numbers], check=True)


class Drum:
    grains, until, after, block = 2500, 1.5, 0.5, 0.125  # s
    names = ("mean y, mm", "mean z, mm", "torque, mN m")

    def mesh(self, folder, facets):
        make_mesh("drum", folder / "vessel.stl", "radius=0.05", "length=0.03", f"facets={facets}")

    still = ""
    turn = f"turn = {{ axis = [1, 0, 0], through = [0, 0, 0], rate = {RATE} }}\n"
    flow = turn
    move = f"fix turn all move/mesh mesh vessel rotate origin 0 0 0 axis 1 0 0 period {2 * math.pi / RATE:.12g}"

    def lattice(self, count):
        return lattice(count, 0.012, 0.04, -0.038, lambda x, y, z: y * y + z * z < 0.047**2)

    def ours(self, rows):
        return [(r["time_s"], 1e3 * r["centre_y_m"], 1e3 * r["centre_z_m"], 1e3 * r["vessel_moment_x_N.m"])
                for r in rows]

    def theirs(self, rows):
        return [(t, 1e3 * y, 1e3 * z, 1e3 * moment) for t, y, z, _, moment, _ in rows]


class Hopper:
    grains, until, after, block = 6000, 0.5, 0.1, 0.05  # s
    names = ("mass flow, kg/s",)

    def mesh(self, folder, facets):
        make_mesh("hopper", folder / "vessel.stl", "radius=0.04", "orifice=0.03", f"facets={facets}")
        make_mesh("plate", folder / "gate.stl")

    exit = f"[[exit]]\nlow = [-0.1, -0.1, -0.5]\nhigh = [0.1, 0.1, {BELOW}]\n"
    still = exit + "[[mesh]]\nname = \"gate\"\nfile = \"gate.stl\"\nposition = [0, 0, -0.0002]\n"
    flow = exit
    move = ""

    def lattice(self, count):
        return lattice(count, 0.036, 0.036, 0.03, lambda x, y, z: x * x + y * y < 0.037**2)

    def ours(self, rows):
        return rates([(r["time_s"], r["outflow_kg"]) for r in rows])

    def theirs(self, rows):
        return rates([(t, below + grain_mass() * (rows[0][5] - atoms)) for t, _, _, below, _, atoms in rows])


def grain_mass():
    return SOLID * math.pi / 6 * D**3


def rates(rows):
    return [(t1, (m1 - m0) / (t1 - t0)) for (t0, m0), (t1, m1) in zip(rows, rows[1:])]


def lattice(count, half_x, half_y, bottom, holds):
    """Places on a square lattice from a height on, those that are inside."""
    gap, places, level = 1.05 * D, [], 0
    nx, ny = int(half_x / gap), int(half_y / gap)
    while len(places) < count:
        z = bottom + level * gap
        shift = 0.1 * D * (level % 2)
        layer = [(i * gap + shift, j * gap, z) for i in range(-nx, nx + 1) for j in range(-ny, ny + 1)]
        inside = [place for place in layer if holds(*place)]
        if not inside:
            raise SystemExit(f"the lattice has no room for {count} grains; ask for fewer")
        places += inside
        level += 1
    return [{"x": x, "y": y, "z": z, "radius": D / 2} for x, y, z in places[:count]]


def write_data(path, grains):
    """LIGGGHTS' data file, in a box not much larger than what there is: its bins fill it."""
    low, high = -0.06, max(0.16, max(float(g["z"]) for g in grains) + 0.02)
    velocities = ("vx", "vy", "vz", "wx", "wy", "wz")
    with open(path, "w") as file:
        file.write(f"grains\n\n{len(grains)} atoms\n1 atom types\n\n-0.06 0.06 xlo xhi\n-0.06 0.06 ylo yhi\n{low} {high} zlo zhi\n\n"
                   "Atoms\n\n")
        for i, g in enumerate(grains, 1):
            file.write(f"{i} 1 {2 * float(g['radius'])!r} {SOLID} {g['x']} {g['y']} {g['z']}\n")
        file.write("\nVelocities\n\n")
        for i, g in enumerate(grains, 1):
            file.write(" ".join([str(i)] + [str(g.get(k, 0)) for k in velocities]) + "\n")


def timed(folder, name, command, **options):
    """Runs a command to its end, and writes the seconds of processor time that it took."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    done = subprocess.run(command, **options)
    if done.returncode:
        sys.exit(f"`{' '.join(map(str, command))}` ended with {done.returncode}; see {folder}")
    (folder / f"{name}.user").write_text(str(resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before))


def speed(folder, name, rows, steps):
    """Grain-steps a second of processor time; rows end with the number of grains."""
    return statistics.fmean(row[-1] for row in rows) * steps / float((folder / f"{name}.user").read_text())


def grainreel(program, folder, name, case, count, start, more, until):
    out = folder / name
    if not (out / "final.csv").exists():
        outflow = ", \"outflow\"" if isinstance(case, Hopper) and "[[exit]]" in more else ""
        (folder / f"{name}.toml").write_text(SCENE.format(
            count=count, d=D, solid=SOLID, stiffness=STIFFNESS, damping=DAMPING, friction=FRICTION, step=STEP,
            more=more, start=start, duration=until, interval=STEP * EVERY, instruments=outflow))
        timed(folder, name, [program, "movie", folder / f"{name}.toml", "--no-film", "--no-report", "--threads", "1",
                             "--quiet", "--out", out, "--force"], stdout=subprocess.DEVNULL)
    return out


def liggghts(folder, case, until):
    """The looks, and grain-steps a second."""
    if not (folder / "liggghts.out").exists():
        steps = round(until / STEP)
        (folder / "in.liggghts").write_text(DECK.format(
            stiffness=STIFFNESS, tangential=2 / 7 * STIFFNESS, damping=DAMPING, friction=FRICTION, step=STEP,
            move=case.move, below=BELOW, every=EVERY, thermo=max(1, steps // 20), steps=steps))
        with open(folder / "liggghts.part", "w") as out:
            timed(folder, "liggghts", ["stdbuf", "-oL", "liggghts", "-log", "none", "-in", "in.liggghts"], cwd=folder,
                  stdout=out, stderr=subprocess.STDOUT)
        (folder / "liggghts.part").rename(folder / "liggghts.out")
    rows = [list(map(float, line.split())) for line in (folder / "looks.txt").read_text().splitlines()
            if not line.startswith("#")]
    return rows, speed(folder, "liggghts", rows, round(until / STEP))


def blocks(rows, case, column):
    """Mean over blocks of time, and its standard error."""
    by_block, after = {}, case.after
    for row in rows:
        if row[0] > after and math.isfinite(row[column]):
            by_block.setdefault(int((row[0] - after) / case.block), []).append(row[column])
    full = max(map(len, by_block.values()))
    means = [statistics.fmean(values) for values in by_block.values() if len(values) > full / 2]
    return statistics.fmean(means), statistics.stdev(means) / math.sqrt(len(means)) if len(means) > 1 else math.nan


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path)
    parser.add_argument("folder", type=Path)
    parser.add_argument("case", nargs="?", choices=("drum", "hopper"), default="drum")
    parser.add_argument("--facets", type=int, default=72)
    parser.add_argument("--grains", type=int)
    parser.add_argument("--until", type=float)
    parser.add_argument("--only", choices=("liggghts",))
    options = parser.parse_args()
    if not shutil.which("liggghts"):
        print("mesh_walls: no liggghts here; apt-get install liggghts", file=sys.stderr)
        return 77
    case = Drum() if options.case == "drum" else Hopper()
    folder = (options.folder / f"{options.case}_{options.facets}").resolve()
    folder.mkdir(parents=True, exist_ok=True)
    count, until = options.grains or case.grains, options.until or case.until
    case.mesh(folder, options.facets)
    if options.only:
        state = case.lattice(count)
    else:
        rest = grainreel(options.program.resolve(), folder, "rest", case, count, "settle_limit = 2", case.still, 0.2)
        state = texts(rest / "final.csv")
        state[0]["vz"] = str(-NUDGE)
        with open(folder / "state.csv", "w", newline="") as file:
            table = csv.DictWriter(file, state[0])
            table.writeheader()
            table.writerows(state)
    write_data(folder / "state.data", state)
    looks, their_speed = liggghts(folder, case, until)
    theirs = case.theirs(looks)
    if options.only:
        for i, name in enumerate(case.names, 1):
            print(f"{name}: LIGGGHTS {'%.5g +- %.2g' % blocks(theirs, case, i)}")
        print(f"{their_speed / 1e6:.2f} million grain-steps a second")
        return 0
    start = "method = \"file\"\nfile = \"state.csv\""
    run = grainreel(options.program.resolve(), folder, "run", case, count, start, case.flow, until)
    ours, alike = case.ours(numbers(run / "measures.csv")), True
    for i, name in enumerate(case.names, 1):
        (a, a_error), (b, b_error) = blocks(ours, case, i), blocks(theirs, case, i)
        off = (a - b) / math.hypot(a_error, b_error)
        alike &= abs(off) <= 3
        print(f"{name}: grainreel {a:.5g} +- {a_error:.2g}, LIGGGHTS {b:.5g} +- {b_error:.2g}; {off:+.1f} standard errors")
    grains = [(count - row.get("outflow_kg", 0) / grain_mass(),) for row in numbers(run / "measures.csv")]
    our_speed = speed(folder, "run", grains, round(until / STEP))
    print(f"grain-steps a second of processor time: grainreel {our_speed / 1e6:.2f} million, "
          f"LIGGGHTS {their_speed / 1e6:.2f} million; {our_speed / their_speed:.1f} times")
    return 0 if alike else 1


if __name__ == "__main__":
    sys.exit(main())
