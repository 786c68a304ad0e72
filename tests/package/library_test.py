#!/usr/bin/env python3
"""Installs the library of a build into an empty folder, builds the programs of docs/examples against it, runs them,
and compares what they give with what it must be.

usage: library_test.py BUILD SOURCE GRAINREEL
"""
import collections
import math
import pathlib
import re
import struct
import subprocess
import sys
import tempfile
import zlib

GRAVITY = 9.81
RADIUS = 0.005  # m, of the balls of own_law.cpp
RESTITUTION = 0.8


def check(holds, words):
    if not holds:
        sys.exit(f"FAILED: {words}")


def output_of(*command, status=0):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True)
    check(done.returncode == status,
          f"{' '.join(map(str, command))} ended with {done.returncode}, not {status}:\n{done.stdout}{done.stderr}")
    return done.stdout + done.stderr


def check_installed(prefix):
    """Headers, two archives, and the files for CMake: nothing else of the sources."""
    headers = sorted(path for path in (prefix / "include").rglob("*") if path.is_file())
    check(headers and all(path.parent == prefix / "include/grainreel" for path in headers), f"headers: {headers}")
    for header in headers:
        text = header.read_text()
        for included in re.findall(r'#\s*include\s+["<]([^">]+)[">]', text):
            check(included.startswith("grainreel/") or "/" not in included and not included.endswith(".hpp"),
                  f"{header.name} includes {included}, which is not installed")
        alone = header.with_suffix(".alone.cpp")
        alone.write_text(f'#include "grainreel/{header.name}"\n')
        output_of("g++", "-std=c++20", "-Wall", "-Wextra", "-Wshadow", "-Wconversion", "-Werror", "-fsyntax-only",
                  f"-I{prefix / 'include'}", alone)
        alone.unlink()
    archives = sorted(path.name for path in prefix.rglob("*.a"))
    check(archives == ["libgrainreel_engine.a", "libgrainreel_picture.a"], f"archives: {archives}")


def build_examples(prefix, source, folder):
    output_of("cmake", "-S", source / "docs/examples", "-B", folder, f"-DCMAKE_PREFIX_PATH={prefix}",
              "-DCMAKE_CXX_FLAGS=-Wall -Wextra -Wshadow -Werror")
    output_of("cmake", "--build", folder, "--parallel", "2")
    for version, fits in (("1", True), ("2", False)):
        text = f"cmake_minimum_required(VERSION 3.25)\nproject(p LANGUAGES CXX)\nfind_package(grainreel {version} REQUIRED)\n"
        (folder / "version").mkdir(exist_ok=True)
        (folder / "version/CMakeLists.txt").write_text(text)
        done = subprocess.run(["cmake", "-S", folder / "version", "-B", folder / f"version{version}",
                               f"-DCMAKE_PREFIX_PATH={prefix}"], capture_output=True, text=True)
        installed = re.search(r'PACKAGE_VERSION "(\d+)', next(prefix.rglob("*ConfigVersion.cmake")).read_text()).group(1)
        check((done.returncode == 0) == (installed == version), f"find_package(grainreel {version}) with {installed}.x")


def check_guide(prefix, source, folder):
    """The guide's program, built by the guide's CMakeLists.txt: a ball on a plate."""
    blocks = re.findall(r"^```(\w+)\n(.*?)^```", (source / "docs/guide/library.md").read_text(), re.M | re.S)
    folder.mkdir()
    (folder / "CMakeLists.txt").write_text(next(text for kind, text in blocks if kind == "cmake"))
    (folder / "mine.cpp").write_text(next(text for kind, text in blocks if kind == "cpp" and "int main" in text))
    output_of("cmake", "-S", folder, "-B", folder / "build", f"-DCMAKE_PREFIX_PATH={prefix}")
    output_of("cmake", "--build", folder / "build")
    rows = re.findall(r"^(\S+) s: highest (\S+) mm, (\d+) contacts, (\S+) J$", output_of(folder / "build/mine"), re.M)
    check(len(rows) == 10, f"10 moments in 0.5 s were expected: {rows}")
    for k, (time, height, contacts, energy) in enumerate(rows, 1):
        check(abs(float(time) - 0.05 * k) < 0.001, f"moment {k} is at {time} s")
        check(0 < float(height) < 100 and int(contacts) < 2 and float(energy) >= 0, f"moment {k}: {rows[k - 1]}")


def check_shaken(text):
    rows = re.findall(r"^(\S+) s: (\d+) beads, mean height (\S+) m, centre of mass (\S+) m, (\d+) contacts$", text, re.M)
    check(len(rows) == 6, f"6 periods of 1/30 s were expected in 0.2 s:\n{text}")
    for k, (time, beads, mean, centre, contacts) in enumerate(rows, 1):
        check(abs(float(time) - k / 30) < 1e-6, f"period {k} ended at {time} s")
        check(int(beads) == 60 and int(contacts) < 60 * 6, f"{beads} beads, {contacts} contacts")
        # Beads of one size: the mean of their centres is their centre of mass.
        check(abs(float(mean) - float(centre)) < 1e-9, f"mean {mean} m, centre of mass {centre} m")
        check(0.002 < float(mean) < 0.02, f"the beads are at {mean} m")


def check_law(text):
    rows = [[float(x) for x in line.split()] for line in text.splitlines()]
    check(len(rows) > 50, "few rows")
    for time, *numbers in rows:
        falling, left, right = (numbers[k:k + 5] for k in (0, 5, 10))  # y, z, vy, vz, spin
        fallen = 0.025 - GRAVITY * time * time / 2
        if fallen > RADIUS + 1e-6:
            check(abs(falling[1] - fallen) < 1e-9, f"at {time} s the ball is at {falling[1]} m, not {fallen}")
        # Two equal balls: momentum, and angular momentum about their centre (2/5 m r^2 each for the spin).
        check(abs(left[2] + right[2] - 0.5) < 1e-9, f"momentum along y is {left[2] + right[2]} m/s")
        check(abs(left[3] + right[3] + 2 * GRAVITY * time) < 1e-9, "momentum along z is not that of the fall")
        dy, dz, vy, vz = (right[k] - left[k] for k in range(4))
        turning = 0.5 * (dy * vz - dz * vy) + 0.4 * RADIUS**2 * (left[4] + right[4])
        check(abs(turning - 0.5 * 0.004 * 0.5) < 2e-7, f"angular momentum is {turning} m2/s a mass")
    bounced = [row for row in rows if row[2] > RADIUS + 1e-4 and row[4] > 0]
    check(bounced, "the ball did not bounce")
    _, _, z, _, vz, _ = bounced[0][:6]
    ratio = math.sqrt((vz * vz + 2 * GRAVITY * (z - RADIUS)) / (2 * GRAVITY * 0.02))
    check(abs(ratio - RESTITUTION) < 0.01, f"the ball came back with {ratio} of its speed, not {RESTITUTION}")
    left, right = rows[-1][6:11], rows[-1][11:16]
    cos = math.sqrt(1 - 0.4**2)  # they met 4 mm off centre, 10 mm apart
    apart = (right[2] - left[2]) * cos + (right[3] - left[3]) * 0.4
    check(abs(apart / (0.5 * cos) - RESTITUTION) < 0.02, f"the balls parted with {apart / (0.5 * cos)} of their speed")
    check(abs(left[4]) > 1, "friction did not turn the balls")


def paeth(a, b, c):
    p = a + b - c
    return min(((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c)))[2]


def pixels_of(path):
    """Width, height and rows of RGBA of an 8-bit PNG."""
    data = path.read_bytes()
    check(data[:8] == b"\x89PNG\r\n\x1a\n", f"{path.name} is no PNG")
    at, packed, width, height = 8, b"", 0, 0
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + size]
        if kind == b"IHDR":
            width, height, depth, colours = struct.unpack(">IIBB", body[:10])
            check((depth, colours) == (8, 6), "the PNG has other than 8-bit RGBA")
        packed += body if kind == b"IDAT" else b""
        at += 12 + size
    raw, line = zlib.decompress(packed), 4 * width
    above, rows = bytes(line), []
    for y in range(height):
        kind, row = raw[y * (line + 1)], bytearray(raw[y * (line + 1) + 1:(y + 1) * (line + 1)])
        for i in range(line):
            left, corner = (row[i - 4], above[i - 4]) if i >= 4 else (0, 0)
            guess = (0, left, above[i], (left + above[i]) // 2, paeth(left, above[i], corner))[kind]
            row[i] = (row[i] + guess) & 255
        rows.append(bytes(row))
        above = row
    return width, height, rows


def colours_of(path, size):
    width, height, rows = pixels_of(path)
    check((width, height) == size, f"{path.name} has {width} x {height} pixels")
    return collections.Counter(row[i:i + 4] for row in rows for i in range(0, len(row), 4))


def check_pictures(build, folder, grainreel):
    (folder / "box.toml").write_text("""
        [[species]]
        name = "glass"
        count = 40
        diameter = "4 mm"
        density = "2.5 g/cm3"
        [container]
        shape = "box"
        width = "30 mm"
        depth = "20 mm"
        height = "40 mm"
        [run]
        duration = "0.02 s"
        accuracy = "draft"
        """)
    output_of(grainreel, "movie", folder / "box.toml", "--no-film", "--no-report", "--threads", "1", "--out", folder / "run")
    output_of(build / "draw", folder / "own.png", folder / "run", folder / "file.png")
    own = colours_of(folder / "own.png", (480, 360))
    blue = sum(n for (r, g, b, _), n in own.items() if b > r + 40 and b > g + 20)
    check(blue > 0.005 * 480 * 360, f"the big spheres, blue ones, have {blue} pixels")
    of_file = colours_of(folder / "file.png", (480, 360))
    orange = sum(n for (r, g, b, _), n in of_file.items() if r > g + 40 and g > b + 20)
    check(orange > 0.01 * 480 * 360, f"the grains of the run have {orange} pixels")
    text = output_of(build / "draw", folder / "own.png", folder / "box.toml", folder / "no.png", status=1)
    check("holds no frames" in text, f"box.toml was drawn: {text}")


def check_reader(build, folder):
    (folder / "some.beads").write_text("beads\n0 0 1.5 1\n5 0 2.5 1\n0 5 3.5 2\n")
    text = output_of(build / "own_reader", folder / "some.beads", folder / "beads.png", folder / "beads.xyz")
    rows = [line.split() for line in text.splitlines()]
    check(rows == [["0", "0.0015", "0.001"], ["1", "0.0025", "0.001"], ["2", "0.0035", "0.002"]], f"read: {text}")
    colours_of(folder / "beads.png", (320, 240))
    check((folder / "beads.xyz").read_text().split()[0] == "3", "the XYZ file has not 3 grains")
    (folder / "bad.beads").write_text("beads\n0 0 1.5 1\n5 0 x 1\n")
    text = output_of(build / "own_reader", folder / "bad.beads", folder / "no.png", folder / "no.xyz", status=3)
    check("bad.beads:3:1: " in text, f"the damaged file: {text}")
    (folder / "flat.beads").write_text("beads\n0 0 1.5 0\n")
    text = output_of(build / "own_reader", folder / "flat.beads", folder / "no.png", folder / "no.xyz", status=1)
    check("radius" in text, f"a radius of 0: {text}")


def main():
    build, source, grainreel = (pathlib.Path(word) for word in sys.argv[1:4])
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        prefix, programs = folder / "prefix", folder / "examples"
        output_of("cmake", "--install", build, "--prefix", prefix, "--component", "dev")
        check_installed(prefix)
        build_examples(prefix, source, programs)
        check_guide(prefix, source, folder / "guide")
        check_shaken(output_of(programs / "shake"))
        check_law(output_of(programs / "own_law"))
        check_pictures(programs, folder, grainreel)
        check_reader(programs, folder)
    print("ok")


if __name__ == "__main__":
    main()
