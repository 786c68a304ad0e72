#!/usr/bin/python3
"""Several runs on one page in Chromium.   side_by_side_test.py GRAINREEL FOLDER [AXE]

Two runs that differ in their drive: both films and both beds show the time of the charts, each chart has a line for
each run, a bed that is turned turns the other, and the table has what differs.
"""
import pathlib
import shutil
import subprocess
import sys

import numpy

from browser import Browser
from report_test import SCENE, close, no_barriers

RUNS = ["calm", "wild"]
NAMES = ["Γ = 2", "Γ = 3.5"]  # their titles are the same


def make_page(program, folder):
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    (folder / "fifty.toml").write_text(SCENE)
    for name, level in zip(RUNS, ["2", "3.5"]):
        subprocess.run([program, "movie", "fifty.toml", "--out", name, "--threads", "1", "--no-report",
                        "--set", f"drive.g_level={level}"], cwd=folder, check=True, stderr=subprocess.DEVNULL)
    subprocess.run([program, "report", *RUNS, "--out", "both.html"], cwd=folder, check=True, stderr=subprocess.DEVNULL)
    return folder / "both.html"


def both_are_there(browser):
    assert browser.run("return [...document.querySelectorAll('.variant > h2')].map((h) => h.textContent)") == NAMES
    assert browser.run("return document.querySelectorAll('video').length") == 2
    ids = browser.run("return [...document.querySelectorAll('[id]')].map((e) => e.id)")
    assert len(ids) == len(set(ids)), sorted(name for name in ids if ids.count(name) > 1)


def charts_have_a_line_each(browser):
    for labels in browser.run("return [...grainreelReport.charts.plots.values()].map((p) => p.series.map((s) => s.label))"):
        assert labels[1:] == NAMES, labels
    # The values are those of each run's own table.
    for k, run in enumerate(RUNS):
        rows = numpy.genfromtxt(FOLDER / run / "measures.csv", delimiter=",", names=True)
        shown = browser.run("const r = grainreelReport.charts.runs[arguments[0]].measures;"
                            "return r.values[r.columns.findIndex((c) => c.name === 'centre_z_m')]", k)
        assert len(shown) == len(rows) and numpy.allclose(numpy.array(shown, float), rows["centre_z_m"], rtol=1e-5)


def a_chart_moves_all(browser):
    left, top, width, height = browser.place_of(".u-over")
    for share in [0.3, 0.7]:
        x, y = left + share * width, top + height / 2
        browser.pointer("mousePressed", x, y)
        browser.pointer("mouseReleased", x, y, 0)
        now = browser.run("return grainreelReport.runTime.now")
        assert now > 0
        for k in range(2):
            bed = browser.run("const b = grainreelReport.beds[arguments[0]]; return b.frames.times[b.viewer.frame]", k)
            assert close(bed, now, 0.0125 / 2 + 1e-6), (k, bed, now)
            browser.wait(f"const f = grainreelReport.films[{k}]; return !f.video.seeking && f.wanted === null",
                         "the film to seek")
            at = browser.run("return grainreelReport.films[arguments[0]].video.currentTime", k)
            times = numpy.array(browser.run("return grainreelReport.films[arguments[0]].film.times", k))
            assert int(at * 30 + 0.01) == abs(times - now).argmin()


def films_play_together(browser):
    browser.run("grainreelReport.runTime.set(0, 'test')")
    browser.wait("return grainreelReport.films.every((f) => !f.video.seeking && f.wanted === null)", "the films to seek")
    browser.run("document.getElementById('play').click()")
    browser.wait("return grainreelReport.films.every((f) => f.video.currentTime > 0.4)", "both films to play")
    browser.run("document.getElementById('play').click()")
    browser.wait("return grainreelReport.films.every((f) => f.video.paused)", "both films to stop")


def a_bed_turns_the_other(browser):
    left, top, width, height = browser.place_of("#bed-0")
    x, y = left + width / 2, top + height / 2
    browser.pointer("mousePressed", x, y)
    browser.pointer("mouseMoved", x + 40, y + 10)
    browser.pointer("mouseReleased", x + 40, y + 10, 0)
    angles = browser.run("return grainreelReport.beds.map((b) => [b.viewer.camera.azimuth, b.viewer.camera.elevation])")
    start = browser.run("return grainreelReport.beds[0].facts.view.azimuth")
    assert angles[0] == angles[1] and angles[0][0] != start, angles


def colours_mean_the_same(browser):
    browser.run("const s = document.getElementById('colour-by-1'); s.value = 1; s.dispatchEvent(new Event('change'))")
    ends = browser.run("return [...document.querySelectorAll('#legend-0, #legend-1')].map((l) => l.textContent)")
    assert ends[0] == ends[1] and "m/s" in ends[0], ends
    # The same speed has the same place on the scale of each run.
    shares = browser.run("return grainreelReport.beds.map((b) => {"
                         "  const {lowest, highest} = b.frames.speed, [low, high] = b.viewer.range;"
                         "  return (Math.log(0.05 / lowest) / Math.log(highest / lowest) - low) / (high - low); })")
    assert close(shares[0], shares[1], 1e-6), shares


def what_differs_is_told(browser):
    rows = browser.run("return [...document.querySelectorAll('tbody tr')].map((r) => [...r.cells].map((c) => c.textContent))")
    keys = [row[0] for row in rows]
    assert any(key.startswith("drive.") for key in keys), keys
    assert not any(key.startswith(("species.", "container.", "film.", "output.")) for key in keys), keys


def looks_as_before(browser):
    browser.run("grainreelReport.runTime.set(0.4, 'test')")
    settled = "return grainreelReport.films.every((f) => !f.video.seeking && f.wanted === null)"
    browser.looks_as_kept("side_by_side", FOLDER, settled)


TESTS = [looks_as_before, both_are_there, charts_have_a_line_each, a_chart_moves_all, films_play_together, a_bed_turns_the_other,
         colours_mean_the_same, what_differs_is_told]


def main():
    global FOLDER
    program, FOLDER = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    axe = pathlib.Path(sys.argv[3]) if len(sys.argv) > 3 else None
    page = make_page(program, FOLDER)
    for width in (1280, 390):
        with Browser(width=width) as browser:
            browser.open(page)
            if width == 1280:
                for test in TESTS:
                    test(browser)
                    print(f"passed: {test.__name__}", flush=True)
            wide = browser.run("return document.documentElement.scrollWidth")
            assert wide <= width, (width, wide)
            browser.picture(FOLDER / f"side_by_side_{width}.png")
            console = browser.console()
            assert console == [], console
            if axe:
                no_barriers(browser, axe)
    print("passed: nothing on the console")


if __name__ == "__main__":
    main()
