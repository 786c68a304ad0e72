#!/usr/bin/env python3
"""Makes the meshes of scenes/, binary STL in metres, and others of the same shapes.

    make_meshes.py                         # all that lie in this folder
    make_meshes.py --check                 # are they what would be made? exit status 1 if not
    make_meshes.py SHAPE FILE [KEY=VALUE]  # one of any size, as in: drum big.stl radius=0.2 facets=360
    make_meshes.py --list                  # shapes with their numbers

Lengths are in metres, angles in degrees. Walls are sheets without thickness, but for lifters and screws. A corner that
several triangles share has the same bits in all of them.
"""
import argparse
import inspect
import struct
import sys
from math import cos, pi, radians, sin, sqrt, tan
from pathlib import Path

HERE = Path(__file__).resolve().parent


# ---- Triangles: lists of three points, counter-clockwise for an eye outside --------------------------------------

def quad(a, b, c, d):
    """The flat or slightly warped face a b c d."""
    return [(a, b, c), (a, c, d)]


def fan(centre, ring):
    """A face with a middle: ring runs round it and closes by itself."""
    return [(centre, ring[i - 1], ring[i]) for i in range(len(ring))]


def turned(triangles):
    return [(a, c, b) for a, b, c in triangles]


def along_x(triangles):
    """From the axis z to the axis x."""
    return [tuple((z, x, y) for x, y, z in triangle) for triangle in triangles]


def along_y(triangles):
    """From the axis z to the axis y."""
    return [tuple((y, z, x) for x, y, z in triangle) for triangle in triangles]


def circle(radius, facets, z):
    return [(radius * cos(2 * pi * i / facets), radius * sin(2 * pi * i / facets), z) for i in range(facets)]


def between(low, high):
    """The side between two closed rings of equally many points, the one above the other."""
    n = len(low)
    return [t for i in range(n) for t in quad(low[i], low[(i + 1) % n], high[(i + 1) % n], high[i])]


def revolved(profile, facets):
    """About z; profile is a list of (radius, z) from below upwards."""
    rings = [circle(radius, facets, z) for radius, z in profile]
    return [t for low, high in zip(rings, rings[1:]) for t in between(low, high)]


def prism(ring, half_length, rings=1):
    """A closed body from z = -half_length to half_length; every point of the ring sees the axis.

    Its ends are cut into so many rings of triangles, so that wear on them shows where it is.
    """
    def end(z):
        nested = [[(x * k / rings, y * k / rings, z) for x, y in ring] for k in range(1, rings + 1)]
        return fan((0.0, 0.0, z), nested[0]) + turned([t for a, b in zip(nested, nested[1:]) for t in between(a, b)])
    low, high = ([(x, y, z) for x, y in ring] for z in (-half_length, half_length))
    return between(low, high) + end(half_length) + turned(end(-half_length))


def channel(section, start, end, wall):
    """A section, a list of (x, z), drawn along y; with `wall` a wall closes it at its start."""
    near, far = ([(x, y, z) for x, z in section] for y in (start, end))
    sides = [t for i in range(len(section) - 1) for t in quad(near[i], far[i], far[i + 1], near[i + 1])]
    if not wall:
        return sides
    height = max(z for _, z in section)
    middle = ((section[0][0] + section[-1][0]) / 2, start, height)
    return sides + [(middle, near[i], near[i + 1]) for i in range(len(near) - 1)]


# ---- Shapes ------------------------------------------------------------------------------------------------------

def hopper(radius=0.045, orifice=0.036, angle=45.0, height=0.1, facets=72):
    """A round silo that ends below in a cone, open at both ends; z = 0 is the orifice.

    `orifice` is its diameter and `angle` that of the cone against the axis; 90 is a flat bottom with a hole.
    """
    hole = orifice / 2
    rise = (radius - hole) / tan(radians(angle)) if angle < 90 else 0.0
    return revolved([(hole, 0.0), (radius, rise), (radius, height)], facets)


def plate(width=0.044, depth=0.044, cells=1):
    """A level sheet about the origin, depth along x and width along y, in cells x cells squares."""
    def at(i, j):
        return (depth * (i / cells - 0.5), width * (j / cells - 0.5), 0.0)
    return [t for i in range(cells) for j in range(cells)
            for t in quad(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1))]


def drum(radius=0.1, length=0.03, facets=72):
    """A closed drum about the axis x."""
    ring = [(x, y) for x, y, _ in circle(radius, facets, 0.0)]
    return along_x(prism(ring, length / 2))


def drum_with_lifters(radius=0.1, length=0.03, facets=72, lifters=8, lifter=0.015, base=10.0, tip=5.0,
                      rings=8):
    """The same with bars along its wall, `lifter` high, so many degrees wide at base and tip, and ends in `rings`."""
    step, ring = 360 / facets, []
    for k in range(lifters):
        middle = 360 * k / lifters
        corners = [(radius, middle - base / 2), (radius - lifter, middle - tip / 2),
                   (radius - lifter, middle + tip / 2)]
        free, count = 360 / lifters - base, round((360 / lifters - base) / step)
        corners += [(radius, middle + base / 2 + free * i / count) for i in range(count)]
        ring += [(r * cos(radians(angle)), r * sin(radians(angle))) for r, angle in corners]
    return along_x(prism(ring, length / 2, rings))


def screw(radius=0.0235, shaft=0.005, pitch=0.04, turns=5.0, thickness=0.002, facets=40):
    """A right-handed blade about a shaft, along y, from y = 0 on.

    Between blade and trough there is room for less than half a grain, or for one and a half: what lies between nips grains.
    """
    steps, rings = round(turns * facets), 6
    inner = 0.95 * shaft  # the blade begins inside the shaft
    # Rings by equal ratios, so that neighbours on the blade, which is steeper at the shaft, turn by less than 10 degrees.
    radii = [inner * (radius / inner) ** (k / rings) for k in range(rings + 1)]
    section = [(r, -1) for r in radii] + [(r, 1) for r in reversed(radii)]
    rows = []
    for i in range(steps + 1):
        angle, z = 2 * pi * i / facets, pitch * i / facets
        rows.append([(r * cos(angle), r * sin(angle), z + side * thickness / 2) for r, side in section])
    n = len(section)
    blade = [t for here, there in zip(rows, rows[1:]) for k in range(n)
             for t in quad(here[k], there[k], there[(k + 1) % n], here[(k + 1) % n])]
    for row, face in ((rows[0], list), (rows[-1], turned)):
        for k in range(rings):
            blade += face(quad(row[k], row[k + 1], row[n - 2 - k], row[n - 1 - k]))
    length = pitch * turns
    axle = prism([(x, y) for x, y, _ in circle(shaft, facets, 0.0)], length / 2 + 0.75 * thickness)
    axle = [tuple((x, y, z + length / 2) for x, y, z in t) for t in axle]
    return along_y(blade + axle)


def screw_trough(radius=0.025, rim=0.035, over=45.0, start=-0.0025, end=0.205, facets=30):
    """A trough along y that is round about the axis up to `over` degrees above it, with upright walls from there to
    z = rim, and an end wall at its start.

    Between a screw and a wall that stands upright beside its axis grains are nipped, where the blade goes down: there the
    gap narrows by a small angle. The round wall reaches so far up that the gap narrows by more than friction can hold.
    """
    def at(angle):
        return (-radius * cos(radians(angle)), -radius * sin(radians(angle)))
    arc = [at(-over + (180 + 2 * over) * i / facets) for i in range(facets + 1)]
    return channel([(arc[0][0], rim), *arc, (arc[-1][0], rim)], start, end, wall=True)


def trough(width=0.06, rim=0.025, start=-0.18, end=0.18):
    """A level trough along y, open at its end; z = 0 is its bottom."""
    half = width / 2
    return channel([(-half, rim), (-half, 0.0), (half, 0.0), (half, rim)], start, end, wall=True)


def impeller(blades=4, length=0.04, width=0.01, pitch=45.0, hub=0.004):
    """Plates about the axis z that stand on a hub's radius, pitched against it: they push upwards as they turn
    to the left."""
    triangles, tilt = [], radians(pitch)
    for k in range(blades):
        angle = 2 * pi * k / blades
        out, side = (cos(angle), sin(angle)), (-sin(angle), cos(angle))
        def corner(along, across):
            w = across * width / 2
            return (out[0] * along + side[0] * w * cos(tilt), out[1] * along + side[1] * w * cos(tilt), w * sin(tilt))
        triangles += quad(corner(hub, -1), corner(length, -1), corner(length, 1), corner(hub, 1))
    return triangles


def box(width=0.04, depth=0.02, height=0.08, cells=1):
    """A closed box, depth along x and width along y; z = 0 is its floor; each face has cells x cells squares."""
    x, y, z = ([a * (i / cells - 0.5) + up for i in range(cells + 1)]
               for a, up in ((depth, 0.0), (width, 0.0), (height, height / 2)))
    triangles = []
    for i in range(cells):
        for j in range(cells):
            for side, face in ((0, turned), (cells, list)):
                triangles += face(quad(*((x[a], y[b], z[side]) for a, b in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)))))
                triangles += face(quad(*((x[side], y[a], z[b]) for a, b in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)))))
                triangles += face(quad(*((x[b], y[side], z[a]) for a, b in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)))))
    return triangles


def wedge(half_width=0.05, depth=0.03, height=0.12, half_angle=20.0, slant_height=0.04):
    """The closed wedge of [container]: upright walls above slanted ones, z = 0 is its floor."""
    floor = half_width - slant_height * tan(radians(half_angle))
    rings = [[(-depth / 2, -y, z), (depth / 2, -y, z), (depth / 2, y, z), (-depth / 2, y, z)]
             for y, z in ((floor, 0.0), (half_width, slant_height), (half_width, height))]
    sides = [t for low, high in zip(rings, rings[1:]) for t in between(low, high)]
    return sides + quad(*rings[-1]) + turned(quad(*rings[0]))


SHAPES = {shape.__name__: shape for shape in
          (hopper, plate, drum, drum_with_lifters, screw, screw_trough, trough, impeller, box, wedge)}
SHIPPED = {"cone_hopper.stl": hopper(), "gate.stl": plate(), "drum.stl": drum(), "long_drum.stl": drum(length=0.06),
           "drum_with_lifters.stl": drum_with_lifters(), "screw.stl": screw(), "screw_trough.stl": screw_trough(),
           "trough.stl": trough()}


# ---- Files -------------------------------------------------------------------------------------------------------

def normal(a, b, c):
    u, v = ([q - p for p, q in zip(a, other)] for other in (b, c))
    n = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
    size = sqrt(sum(x * x for x in n))
    return [x / size for x in n]


def stl(triangles, name):
    """The bytes of a binary STL file."""
    parts = [f"{name} by make_meshes.py, m".encode().ljust(80), struct.pack("<I", len(triangles))]
    for triangle in triangles:
        # Adding 0.0 takes the sign off a zero, so that shared corners have the same bits.
        numbers = [x + 0.0 for point in (normal(*triangle), *triangle) for x in point]
        parts.append(struct.pack("<12fH", *(round(x, 9) + 0.0 for x in numbers), 0))
    return b"".join(parts)


def numbers_of(shape):
    return {name: parameter.default for name, parameter in inspect.signature(shape).parameters.items()}


def made(name, settings):
    shape = SHAPES.get(name) or sys.exit(f"there is no shape {name}; there are {', '.join(SHAPES)}")
    known, given = numbers_of(shape), {}
    for setting in settings:
        key, _, value = setting.partition("=")
        if key not in known:
            sys.exit(f"{name} has no {key}; it has {', '.join(known)}")
        given[key] = type(known[key])(float(value))
    return shape(**given)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("shape", nargs="?")
    parser.add_argument("file", nargs="?", type=Path)
    parser.add_argument("settings", nargs="*", metavar="KEY=VALUE")
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--list", action="store_true")
    options = parser.parse_args()
    if options.list:
        for name, shape in SHAPES.items():
            print(name, *(f"{key}={value}" for key, value in numbers_of(shape).items()))
    elif options.shape:
        if not options.file:
            sys.exit("a shape needs a file to write it to")
        options.file.write_bytes(stl(made(options.shape, options.settings), options.shape))
    elif options.check:
        there = {file.name for file in HERE.glob("*.stl")}
        wrong = [name for name, triangles in SHIPPED.items()
                 if name not in there or (HERE / name).read_bytes() != stl(triangles, name)]
        wrong += sorted(there - set(SHIPPED))
        if wrong:
            sys.exit(f"not as make_meshes.py makes them: {', '.join(wrong)}; run it")
    else:
        for name, triangles in SHIPPED.items():
            (HERE / name).write_bytes(stl(triangles, name))
            print(f"{name}: {len(triangles)} triangles")


if __name__ == "__main__":
    main()
