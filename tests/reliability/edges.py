#!/usr/bin/env python3
"""What does a user see at the edges of what the program can do: meshes, few grains, sizes far apart, crushing?

    tests/reliability/edges.py PROGRAM [NAME ...] [--list] [--page FILE]

Provokes each edge by a scene of a few grains (a second or less each): `check` and, where that accepts it, a run. Prints a
line an edge: how it ended and what was said. Exit status: 0 if each edge ends as it should and says what it should, 1 if
not. --page: the page must quote each of these texts.
"""
import argparse
import math
import re
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from runs import texts  # noqa: E402

BALL = """[[species]]
name = "ball"
diameter = "4 mm"
density = 2500
[contact]
restitution = 0.5
{contact}
[container]
shape = "box"
width = "100 mm"
depth = "100 mm"
height = "100 mm"
{mesh}
[[grain]]
species = "ball"
position = [0, 0, "{height} mm"]
velocity = [0, 0, {speed}]
[run]
duration = {duration}
{run}
[output]
trajectory = false
"""
BED = """[[species]]
name = "glass"
count = {count}
diameter = "4 mm"
density = 2500
{more}[contact]
restitution = 0.5
[container]
{container}
[run]
duration = {duration}
[output]
trajectory = false
"""
PRESSED = """[[species]]
name = "big"
diameter = "{big} mm"
density = 2500
[[species]]
name = "small"
diameter = "1 mm"
density = 2500
[contact]
restitution = 0.5
[container]
shape = "box"
width = "100 mm"
depth = "100 mm"
height = "200 mm"
[[grain]]
species = "small"
position = [0, 0, "0.5 mm"]
[[grain]]
species = "big"
position = [0, 0, "{height} mm"]
velocity = [0, 0, -0.3]
[run]
duration = 0.02
[output]
trajectory = false
"""
BOX = 'shape = "box"\nwidth = "24 mm"\ndepth = "24 mm"\nheight = "60 mm"'


def plate(height=30, more=""):
    return f'[[mesh]]\nname = "plate"\nfile = "plate.stl"\nposition = [0, 0, "{height} mm"]\n{more}'


def ball(contact="", mesh="", height=50, speed=0, duration=0.05, run=""):
    return BALL.format(contact=contact, mesh=mesh, height=height, speed=speed, duration=duration, run=run)


def bed(count=60, container=BOX, duration=0.01, more=""):
    return BED.format(count=count, container=container, duration=duration, more=more)


def drum(more=""):
    return bed(40, f'shape = "mesh"\nmesh = "drum"\n[[mesh]]\nname = "drum"\nfile = "drum.stl"\n{more}', 0.005)


def pressed(big):
    return PRESSED.format(big=big, height=1.02 + big / 2)


def pressed_to(gap):
    return ball(mesh=plate(10, 'velocity = [0, 0, "-10 mm/s"]'), height=2.001, duration=(10 - gap) / 10)


def ring(facets, without=0, radius=0.03, half=0.015, scale=1):
    """The triangles of a drum that lies along x; `without` leaves out the first of them."""
    def corner(k, x):
        turn = 2 * math.pi * (k + 0.5) / facets
        return x, radius * math.cos(turn), radius * math.sin(turn)
    triangles = []
    for k in range(facets):
        a, b, c, d = corner(k, -half), corner(k, half), corner(k + 1, half), corner(k + 1, -half)
        triangles += [(a, b, c), (a, c, d), ((-half, 0, 0), a, d), ((half, 0, 0), c, b)]
    return [[[scale * x for x in place] for place in triangle] for triangle in triangles[without:]]


def write_stl(file, triangles):
    lines = ["solid s"]
    for triangle in triangles:
        lines += ["facet normal 0 0 0", "outer loop", *(f"vertex {x:.9g} {y:.9g} {z:.9g}" for x, y, z in triangle),
                  "endloop", "endfacet"]
    file.write_text("\n".join([*lines, "endsolid s", ""]))


@dataclass
class Edge:
    name: str
    scene: str
    ends: str  # refused (2 by check), stopped (1 by the run), told (0, with a text), quiet (0, without any)
    says: tuple = ()
    drum: list = None   # triangles of drum.stl
    above: float = None  # m, where the first grain is at the end, at least


EDGES = [
    Edge("36 facets", drum(), "told", ("turn by 10 degrees", "2.3 % of its energy"), ring(36)),
    Edge("24 facets", drum(), "told", ("turn by 15 degrees", "too far to be one wall (36 around are)"), ring(24)),
    Edge("a hole", drum(), "refused", ("which leaks near",), ring(36, without=1)),
    Edge("mm taken for m", drum(), "told", ("beside grains of 0.004 m; where its file is in mm, write scale = 0.001",),
         ring(36, scale=1000)),
    Edge("a vessel too small", drum("scale = 0.1"), "refused", ("does not fit in the container",), ring(36)),
    Edge("a wall at 200 m/s", ball(mesh=plate(20, "velocity = [0, 0, 200]"), duration=3e-4), "refused",
         ("so that grains may pass through it; make it at least",)),
    Edge("a wall into another", ball(mesh=plate(30, "velocity = [0, 0, -1]"), height=5, duration=0.1), "refused",
         ("moves into the floor",)),
    Edge("a plate 0.1 um thick", ball(mesh='[[mesh]]\nname = "slab"\nfile = "slab.stl"\n', speed=-10, duration=0.004),
         "quiet", above=0.032),
    Edge("a soft plate", ball("stiffness = 200", plate(), speed=-3), "stopped",
         ("may pass through each other, which happens from 3.09 m/s", 'take a larger stiffness of the contacts with "plate"')),
    Edge("a step too long", ball("", plate(), speed=-10, run='step = "100 us"'), "stopped",
         ("the run will blow up; shorten the step or leave it out", "is no longer a number; take a smaller run.step")),
    Edge("a fast wall hits a soft grain", ball("stiffness = 2000", plate(20, "velocity = [0, 0, 10]"), duration=0.006),
         "stopped", ('take a larger stiffness of the contacts with "plate"',)),
    Edge("pressed by 2 %", pressed_to(3.92), "quiet"),
    Edge("pressed by 12 %", pressed_to(3.5), "told", ("where 0.02 are planned at most", "moves on whatever is in its way")),
    Edge("pressed by half", pressed_to(2), "stopped", ("overlaps the floor by 0.33", "let it stop, or turn back")),
    Edge("no grain", bed(0), "refused", ("'count' must be a whole number from 1",)),
    Edge("one grain", bed(1, duration=0.1), "quiet"),
    Edge("more grains than room", bed(6000), "refused", ("more than the 55 % that can be packed",)),
    Edge("4 grains across a period", bed(20, BOX.replace('depth = "24 mm"', 'depth = "16 mm"\nperiodic_depth = true')),
         "told", ("the period is 4 diameters of the grains", "which orders the bed")),
    Edge("a big one 5 times the small", pressed(5), "told", ("overlaps of 0.064 of a diameter are expected in most contacts",)),
    Edge("a big one 50 times the small", pressed(50), "stopped",
         ("overlaps of 2 of a diameter are expected in most contacts", "the largest grain is 50 times the smallest",
          "of the smaller radius; take a larger contact.stiffness")),
]


def write_walls(folder, drum):
    def quad(a, b, c, d):
        return [(a, b, c), (a, c, d)]
    rim = [(-.025, -.025), (.025, -.025), (.025, .025), (-.025, .025)]
    flat, top, bottom = ([(x, y, z) for x, y in rim] for z in (0, 0.03, 0.03 - 1e-7))
    write_stl(folder / "plate.stl", quad(*flat))
    sides = [quad(bottom[k - 1], bottom[k], top[k], top[k - 1]) for k in range(4)]
    write_stl(folder / "slab.stl", [*quad(*top), *quad(*bottom[::-1]), *sum(sides, [])])
    if drum:
        write_stl(folder / "drum.stl", drum)


def provoked(edge, program, folder):
    """How it ended, and all that was said."""
    folder.mkdir()
    write_walls(folder, edge.drum)
    scene = folder / "scene.toml"
    scene.write_text(edge.scene)

    def call(*words):
        done = subprocess.run([program, *words], capture_output=True, text=True)
        said = [line for line in (done.stdout + done.stderr).splitlines() if re.match(r"\s*(warning|error)[: ]", line)]
        return done.returncode, said
    status, said = call("check", scene)
    if status:
        return ("refused" if status == 2 else f"exit status {status}"), said
    status, more = call("movie", scene, "--no-film", "--no-report", "--progress", "none", "--threads", "1", "--out",
                        folder / "run")
    said += more
    if status == 1:
        return "stopped", said
    if edge.above is not None and float(texts(folder / "run" / "final.csv")[0]["z"]) < edge.above:
        return "with the grain behind the wall", said
    return (f"exit status {status}" if status else "told" if said else "quiet"), said


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("program", type=Path)
    parser.add_argument("names", nargs="*")
    parser.add_argument("--list", action="store_true", help="print the names and end")
    parser.add_argument("--page", type=Path, help="must quote each text")
    options = parser.parse_intermixed_args()
    if options.list:
        print("\n".join(edge.name for edge in EDGES))
        return 0
    page = " ".join(options.page.read_text(encoding="utf-8").split()) if options.page else None
    wrong = 0
    with tempfile.TemporaryDirectory(prefix="edges-") as folder:
        for number, edge in enumerate(EDGES):
            if options.names and edge.name not in options.names:
                continue
            ended, said = provoked(edge, options.program, Path(folder) / str(number))
            faults = [] if ended == edge.ends else [f"ended {ended}, not {edge.ends}"]
            faults += [f"'{text}' was not said" for text in edge.says if not any(text in line for line in said)]
            if page is not None:
                faults += [f"'{text}' is not on the page" for text in edge.says if text not in page]
            wrong += bool(faults)
            print(f"{edge.name}: {'; '.join(faults) or ended}", *(dict.fromkeys(line.strip() for line in said)),
                  sep="\n  ", flush=True)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
