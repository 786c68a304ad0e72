#!/usr/bin/python3
"""Walls of any shape on the page in Chromium.   mesh_test.py GRAINREEL FOLDER [AXE]

A drum from a file that turns one way and a paddle in it that turns the other: both are where the run had them, the grains
are seen through the drum's near side, a click still finds a grain, and the live page has them too.
"""
import math
import pathlib
import re
import shutil
import subprocess
import sys

import numpy

from browser import Browser
from report_test import close, no_barriers

FACETS, RADIUS, LENGTH = 48, 0.03, 0.03  # m
DRUM_RATE, PADDLE_RATE = 60, -90  # rpm
SCENE = f"""title = "A drum and a paddle"
[[species]]
name = "left"
count = 60
diameter = "4 mm"
density = "2.5 g/cm3"
colour = "sky-blue"
[[species]]
name = "right"
count = 60
diameter = "4 mm"
density = "2.5 g/cm3"
colour = "vermilion"
[contact]
restitution = 0.5
friction = 0.5
[container]
shape = "mesh"
mesh = "drum"
[[mesh]]
name = "drum"
file = "drum.stl"
turn = {{ axis = [1, 0, 0], through = [0, 0, 0], rate = "{DRUM_RATE} rpm" }}
[[mesh]]
name = "paddle"
file = "paddle.stl"
turn = {{ axis = [1, 0, 0], through = [0, 0, 0], rate = "{PADDLE_RATE} rpm" }}
[start]
region = {{ low = ["-13 mm", "-20 mm", "-18 mm"], high = ["13 mm", "20 mm", "-5 mm"] }}
[run]
duration = "0.5 s"
overlap = 0.05
[output]
trajectory_interval = "20 ms"
[film]
size = "640x360"
"""


def stl(name, triangles):
    lines = [f"solid {name}"]
    for triangle in triangles:
        lines += ["facet normal 0 0 0", "outer loop", *(f"vertex {x:.9g} {y:.9g} {z:.9g}" for x, y, z in triangle),
                  "endloop", "endfacet"]
    return "\n".join(lines + [f"endsolid {name}", ""])


def drum():
    """Closed, about the x axis."""
    rim = [(math.cos(2 * math.pi * k / FACETS) * RADIUS, math.sin(2 * math.pi * k / FACETS) * RADIUS) for k in range(FACETS)]
    triangles = []
    for k, (a, b) in enumerate(zip(rim, rim[1:] + rim[:1])):
        near, far = LENGTH / 2, -LENGTH / 2
        triangles += [((near, *a), (near, *b), (far, *b)), ((near, *a), (far, *b), (far, *a)),
                      ((near, 0, 0), (near, *b), (near, *a)), ((far, 0, 0), (far, *a), (far, *b))]
    return triangles


def box(low, high):
    corner = lambda *which: tuple((low, high)[w][axis] for axis, w in enumerate(which))
    triangles = []
    for axis in range(3):
        for side in (0, 1):
            around = []
            for pair in [(0, 0), (0, 1), (1, 1), (1, 0)]:
                which = list(pair)
                which.insert(axis, side)
                around.append(corner(*which))
            if (side == 1) == (axis == 1):
                around.reverse()
            triangles += [tuple(around[:3]), (around[0], around[2], around[3])]
    return triangles


PADDLE = box((-0.012, -0.016, -0.002), (0.012, 0.016, 0.002))


def make_run(program, folder):
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    (folder / "drum.stl").write_text(stl("drum", drum()))
    (folder / "paddle.stl").write_text(stl("paddle", PADDLE))
    (folder / "drum.toml").write_text(SCENE)
    for words in [["movie", "drum.toml", "--out", "run", "--threads", "1"], ["report", "run"]]:
        subprocess.run([program, *words], cwd=folder, check=True)
    return folder / "run" / "report.html"


def go_to(browser, time):
    browser.run("grainreelReport.runTime.set(arguments[0], 'test')", time)
    return browser.run("return grainreelReport.bed.frames.times[grainreelReport.bed.viewer.frame]")


PICTURE = "const v = grainreelReport.bed.viewer; v.draw(); return v.canvas.toDataURL();"


# ---- What is asked of the page; each function is one test ----

def shapes_are_those_of_the_files(browser):
    facts = browser.run("return grainreelReport.bed.facts.meshes")
    assert [(one["name"], one["body"], one["triangles"]) for one in facts] == [("drum", 2, 4 * FACETS), ("paddle", 3, 12)], facts
    assert [one["sided"] for one in facts] == [4 * FACETS, 0], "the drum is glass from outside, the paddle solid all round"
    assert [one["edges"] for one in facts] == [2 * FACETS, 12], "the drum's rims, and no seams between its facets"
    for one, triangles in zip(facts, [drum(), PADDLE]):
        vertices = numpy.array(triangles).reshape(-1, 3)
        assert numpy.allclose(one["low"], vertices.min(axis=0)) and numpy.allclose(one["high"], vertices.max(axis=0))


def bodies_are_where_the_run_had_them(browser):
    for time in (0, 0.13, 0.5):
        now = go_to(browser, time)
        poses = browser.run("const b = grainreelReport.bed; return b.frames.bodies[b.viewer.frame]")
        for pose, rate in zip(poses[2:], (DRUM_RATE, PADDLE_RATE)):
            half = rate * 2 * math.pi / 60 * now / 2
            x, y, z, *turn = pose
            assert all(close(value, 0, 1e-9) for value in (x, y, z)), pose
            expected = numpy.array([math.cos(half), math.sin(half), 0, 0])
            given = numpy.array(turn or [1, 0, 0, 0])
            assert close(abs(given @ expected), 1, 1e-6), (now, given, expected)


def the_picture_turns(browser):
    """By a twelfth of a turn, the drum looks alike but for its facets; the paddle does not."""
    pictures = []
    for time in (0.1, 0.3):
        go_to(browser, time)
        pictures.append(browser.run(PICTURE))
    assert pictures[0] != pictures[1]
    without = browser.run("const v = grainreelReport.bed.viewer, m = v.meshes; v.meshes = null; v.draw();"
                          "const p = v.canvas.toDataURL(); v.meshes = m; return p;")
    assert without != pictures[1]


def grains_are_seen_through_the_drum(browser):
    """Most pixels of a grain keep its colour behind the glass."""
    count = """
        const v = grainreelReport.bed.viewer, gl = v.gl, width = v.canvas.width, height = v.canvas.height;
        const all = v.meshes.meshes;
        v.meshes.meshes = arguments[0] ? all.filter((m) => m.name === 'drum') : [];
        v.draw();
        const bytes = new Uint8Array(4 * width * height);
        gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
        v.meshes.meshes = all;
        let coloured = 0;
        for (let at = 0; at < bytes.length; at += 4)
            if (Math.max(...bytes.subarray(at, at + 3)) - Math.min(...bytes.subarray(at, at + 3)) > 60) ++coloured;
        return coloured;"""
    go_to(browser, 0.2)
    bare, behind = browser.run(count, False), browser.run(count, True)
    assert bare > 1000 and behind > 0.9 * bare, (bare, behind)


def a_click_still_finds_a_grain(browser):
    go_to(browser, 0.2)
    left, top, _, _ = browser.place_of("#bed")
    found = browser.run("""
        const v = grainreelReport.bed.viewer, seen = [];
        for (let grain = 0; grain < v.frames.grains; ++grain) {
            const [x, y] = v.pixelOf(grain);
            if (v.pick(x, y) === grain) seen.push([grain, x + v.canvas.clientLeft, y + v.canvas.clientTop]);
        }
        return seen;""")
    assert len(found) > 10, found
    grain, x, y = found[len(found) // 2]
    browser.pointer("mousePressed", left + x, top + y)
    browser.pointer("mouseReleased", left + x, top + y, 0)
    assert browser.run("return grainreelReport.bed.viewer.chosen") == grain
    browser.run("grainreelReport.bed.choose(-1)")


def words_name_them(browser):
    assert "in the vessel “drum” with “paddle”" in browser.run("return document.querySelector('p.lead').textContent")
    text = browser.run("return document.body.textContent")
    for words in ("drum: drum.stl, ASCII STL", "paddle: paddle.stl", "turns at 60 rpm", "Walls from triangle meshes: drum"):
        assert words in text, words


TESTS = [shapes_are_those_of_the_files, bodies_are_where_the_run_had_them, the_picture_turns,
         grains_are_seen_through_the_drum, a_click_still_finds_a_grain, words_name_them]


def looks_as_before(browser, folder):
    go_to(browser, 0.2)
    settled = "const f = grainreelReport.film; return !f.video.seeking && f.wanted === null"
    browser.looks_as_kept("meshes", folder, settled, "#bed")


def live(program, folder):
    watch = subprocess.Popen([program, "watch", "run", "--port", "0"], cwd=folder, stderr=subprocess.PIPE, text=True)
    try:
        address = next(found[0] for line in watch.stderr if (found := re.search(r"http://127\.0\.0\.1:\d+/", line)))
        with Browser() as browser:
            browser.driver.get(address)
            browser.wait("return window.grainreelReport?.bed != null", "the bed")
            shapes_are_those_of_the_files(browser)
            assert browser.run("return grainreelReport.bed.viewer.meshes.meshes.map((m) => m.name)") == ["drum", "paddle"]
            assert browser.console() == []
    finally:
        watch.kill()
        watch.wait()


def main():
    program, folder = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    axe = pathlib.Path(sys.argv[3]) if len(sys.argv) > 3 else None
    page = make_run(program, folder)
    with Browser() as browser:
        browser.open(page)
        for test in TESTS:
            test(browser)
            print(f"passed: {test.__name__}", flush=True)
        looks_as_before(browser, folder)
        print("passed: looks_as_before")
        if axe:
            no_barriers(browser, axe)
        console = browser.console()
        assert console == [], console
        print("passed: nothing on the console")
        for width in (1400, 400):
            browser.resize(width, 1000)
            browser.picture(folder / f"meshes_{width}.png")
    live(program, folder)
    print("passed: live")


if __name__ == "__main__":
    main()
