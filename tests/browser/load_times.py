#!/usr/bin/python3
"""How soon a page shows something in Chromium with graphics by software.   load_times.py PAGE [TIMES]

Each time in a new browser, since the navigation began: when the first words and the poster are painted, and when the bed can
be turned. The best of several tells about the page; the others tell how busy the machine is.
"""
import pathlib
import sys

from browser import Browser

WATCH = """
    window.paints = {};
    new PerformanceObserver((list) => {
        for (const entry of list.getEntries()) paints[entry.name] = entry.startTime;
    }).observe({type: 'paint', buffered: true});
"""


def look(page):
    """s: first paint, bed."""
    with Browser(at_start=WATCH) as browser:
        browser.open(page)
        browser.wait("return paints['first-contentful-paint'] !== undefined", "the first paint")
        first = browser.run("return paints['first-contentful-paint']")
        bed = browser.run("return performance.getEntriesByName('beds')[0].startTime")
        return first / 1000, bed / 1000


def main():
    page, times = pathlib.Path(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 5
    looks = [look(page) for _ in range(times)]
    for first, bed in looks:
        print(f"first words and poster {first:.2f} s, bed {bed:.2f} s")
    print(f"best: {min(first for first, _ in looks):.2f} s and {min(bed for _, bed in looks):.2f} s")


if __name__ == "__main__":
    main()
