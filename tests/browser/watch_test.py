#!/usr/bin/python3
"""The live page in Chromium.   watch_test.py GRAINREEL FOLDER [AXE]

A run that shows itself: picture, bed, charts and progress come and change while it goes, nothing is on the console, and
the page says when the run is over.
"""
import pathlib
import re
import shutil
import signal
import subprocess
import sys

import netCDF4

from browser import Browser
from report_test import SCENE, no_barriers


def start(program, folder):
    """The run and the page's address."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    (folder / "fifty.toml").write_text(SCENE)
    run = subprocess.Popen([program, "movie", "fifty.toml", "--out", "run", "--threads", "1", "--duration", "10min",
                            "--no-report", "--watch", "0"], cwd=folder, stderr=subprocess.PIPE, text=True)
    for line in run.stderr:
        found = re.search(r"http://127\.0\.0\.1:\d+/", line)
        if found:
            return run, found[0]
    raise AssertionError("the run told no address")


def everything_comes(browser):
    browser.wait("return !document.getElementById('live-picture')?.hidden", "the picture")
    browser.wait("return window.grainreelReport?.bed !== null", "the bed")
    browser.wait("return grainreelReport.charts?.plots.size >= 2", "the charts")
    assert browser.run("return document.getElementById('live-picture').naturalWidth") == 640
    assert browser.run("return document.getElementById('bar').hidden")
    assert browser.run("return document.querySelector('#downloads a').getAttribute('href')") == "./measures.csv"


def everything_moves(browser):
    look = ("const r = grainreelReport, b = r.bed; return [document.getElementById('live-picture').src, b.frames.times.at(-1),"
            "r.charts.runs[0].measures.values[0].at(-1), document.getElementById('live-done').value]")
    before = browser.run(look)
    browser.wait("const r = grainreelReport; return document.getElementById('live-picture').src !== '%s' && "
                 "r.bed.frames.times.at(-1) > %r && r.charts.runs[0].measures.values[0].at(-1) > %r && "
                 "document.getElementById('live-done').value > %r" % tuple(before), "all of it to change")
    assert " of 600 s" in browser.run("return document.getElementById('live-says').textContent")


def a_chosen_grain_stays_chosen(browser):
    browser.run("grainreelReport.bed.choose(7)")
    time = browser.run("return grainreelReport.bed.frames.times.at(-1)")
    browser.wait(f"return grainreelReport.bed.frames.times.at(-1) > {time}", "the next moment")
    said = browser.run("return document.getElementById('grain-says').textContent")
    assert said.startswith(f"Grain {browser.run('return grainreelReport.bed.frames.ids[7]')}, "), said


def looks_as_before(program, folder, axe):
    """A run that is over, shown live: nothing moves."""
    subprocess.run([program, "movie", "fifty.toml", "--out", "whole", "--threads", "1", "--no-report"], cwd=folder, check=True,
                   stderr=subprocess.DEVNULL)
    watch = subprocess.Popen([program, "watch", "whole", "--port", "0"], cwd=folder, stderr=subprocess.PIPE, text=True)
    try:
        address = next(found[0] for line in watch.stderr if (found := re.search(r"http://127\.0\.0\.1:\d+/", line)))
        with Browser() as browser:
            browser.driver.get(address)
            everything_comes(browser)
            contact_numbers_are_those_of_the_run(browser, folder / "whole")
            browser.looks_as_kept("live", folder)
        with Browser(dark=True) as browser:
            browser.driver.get(address)
            everything_comes(browser)
            browser.picture(folder / "live_dark.png")
            if axe:
                no_barriers(browser, axe)
    finally:
        watch.kill()
        watch.wait()


def contact_numbers_are_those_of_the_run(browser, run):
    """Of the newest moment, against the last frame of contacts.nc."""
    contacts = netCDF4.Dataset(run / "contacts.nc")
    contacts.set_auto_mask(False)
    last = len(netCDF4.Dataset(run / "trajectory.nc")["time"]) - 1
    rows = (contacts["frame"][:] == last) & (contacts["normal"][:] > 0)
    ids = list(contacts["first"][:][rows]) + list(contacts["second"][:][rows])
    told = browser.run("const f = grainreelReport.bed.frames, last = f.times.length - 1;"
                       "return [...f.ids.keys()].map((g) => [f.ids[g], f.contactsAt(last, g)])")
    assert len(told) == 50 and told == [[grain, ids.count(grain)] for grain, _ in told], told
    assert browser.run("return [...document.querySelectorAll('#colour-by option')].some((o) => o.text === 'contact number')")


def main():
    program, folder = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    axe = pathlib.Path(sys.argv[3]) if len(sys.argv) > 3 else None
    run, address = start(program, folder)
    try:
        with Browser() as browser:
            browser.driver.get(address)
            for test in [everything_comes, everything_moves, a_chosen_grain_stays_chosen]:
                test(browser)
                print(f"passed: {test.__name__}", flush=True)
            browser.picture(folder / "watch_1280.png")
            console = browser.console()
            assert console == [], console
            print("passed: nothing on the console")
            if axe:
                no_barriers(browser, axe)
            run.send_signal(signal.SIGINT)
            browser.wait("return /stopped at/.test(document.getElementById('live-says').textContent)", "the end to be told")
            print("passed: the page says when the run is over")
    finally:
        run.kill()
        run.wait()
    looks_as_before(program, folder, axe)
    print("passed: looks_as_before")


if __name__ == "__main__":
    main()
