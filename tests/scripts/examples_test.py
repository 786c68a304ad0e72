#!/usr/bin/env python3
"""Runs the two programs of docs/examples and compares what they give with what it must be.

usage: examples_test.py READ_GRAINS DRAW_FRAME GRAINREEL
"""
import collections
import pathlib
import re
import struct
import subprocess
import sys
import tempfile
import zlib

GRAVITY = 9.81
SCENE = """
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
"""


def check(holds, words):
    if not holds:
        sys.exit(words)


def output_of(*command):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True)
    check(done.returncode == 0, f"{command} ended with {done.returncode}:\n{done.stdout}{done.stderr}")
    return done.stdout


def check_flight(text):
    """Free flight: y = y0 + v t, z = 1 m + w t - g t^2 / 2; velocity Verlet has it but for rounding."""
    starts = [(0, 0, 0), (0.05, 2, 3)]  # y0, v, w
    rows = re.findall(r"^(\S+) s: grain (\d) at (\S+) (\S+) (\S+) m$", text, re.MULTILINE)
    check(len(rows) == 2 * 5, f"5 moments of 2 grains were expected:\n{text}")
    for time, grain, x, y, z in rows:
        t, (y0, v, w) = float(time), starts[int(grain) % 2]
        place = (0, y0 + v * t, 1 + w * t - GRAVITY * t * t / 2)
        for is_, should in zip((x, y, z), place):
            check(abs(float(is_) - should) < 1e-9, f"grain {grain} at {t} s: {is_}, not {should}")
    check(abs(float(rows[-1][0]) - 0.2) < 1e-3, f"the last moment is at {rows[-1][0]} s")


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


def check_picture(path):
    width, height, rows = pixels_of(path)
    check((width, height) == (480, 360), f"the picture has {width} x {height} pixels")
    counts = collections.Counter(row[i:i + 4] for row in rows for i in range(0, len(row), 4))
    check(len(counts) > 200, f"{path.name} has {len(counts)} colours")
    background = counts.most_common(1)[0][1] / (width * height)
    check(background < 0.98, f"{path.name} is empty: {background:.3f} of it has one colour")
    # Grains are lit from above: the orange of the first species, from bright to dark.
    orange = sum(n for (r, g, b, _), n in counts.items() if r > g + 40 and g > b + 20)
    check(orange > 0.01 * width * height, f"{path.name} shows grains on {orange} pixels only")


def main():
    read_grains, draw_frame, grainreel = sys.argv[1:4]
    check_flight(output_of(read_grains))
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "box.toml").write_text(SCENE)
        output_of(grainreel, "movie", folder / "box.toml", "--no-film", "--no-report", "--threads", "1", "--out", folder / "run")
        for frames in ("run", "run/trajectory.nc", "run/final.csv", "run/checkpoint.grs"):
            picture = folder / "picture.png"
            output_of(draw_frame, folder / frames, picture)
            check_picture(picture)
            print(f"{frames}: drawn")
            picture.unlink()
        failed = subprocess.run([draw_frame, str(folder / "box.toml"), str(folder / "none.png")], capture_output=True,
                                text=True)
        check(failed.returncode == 1 and "holds no frames" in failed.stderr, f"box.toml was drawn: {failed.stderr}")


if __name__ == "__main__":
    main()
