#!/usr/bin/python3
"""The page of `grainreel report` in Chromium.   report_test.py GRAINREEL FOLDER [AXE]

Runs a small scene, makes its page and looks at it: nothing on the console, the film plays, charts, film and bed go
together, a click finds the grain that is there, places are those of the trajectory, text never becomes markup, and
without WebGL or DecompressionStream the page says so. FOLDER gets run, page and pictures of it. AXE: axe.min.js of
axe-core, which looks for barriers to people with disabilities.
"""
import math
import pathlib
import shutil
import subprocess
import sys

import netCDF4
import numpy

from browser import KEPT, MOST_BLOCKS, MOST_MEAN, Browser

TITLE = "Fifty <b>grains</b> & \"</script><script>document.title='no'</script>"
SCENE = """title = '''%s'''
[[species]]
name = "small"
count = 40
diameter = "4 mm"
density = "2.5 g/cm3"
colour = "sky-blue"
[[species]]
name = "big"
count = 10
diameter = "6 mm"
density = "2.5 g/cm3"
colour = "vermilion"
[contact]
restitution = 0.7
friction = 0.4
[container]
shape = "box"
width = "30 mm"
depth = "20 mm"
height = "40 mm"
[drive]
frequency = "20 Hz"
g_level = 2
[run]
duration = "1 s"
overlap = 0.05
[output]
trajectory_interval = "12.5 ms"
contacts = true
[output.fields]
grid = "yz"
periods = 2
[film]
size = "640x360"
rate = 30
[[film.caption]]
from = "0.5 s"
to = "0.8 s"
text = "Half <i>time</i>"
[[film.segment]]
playback = 0.5
""" % TITLE


def make_page(program, folder):
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    (folder / "fifty.toml").write_text(SCENE)
    for words in [["movie", "fifty.toml", "--out", "run", "--threads", "1"], ["report", "run"]]:
        subprocess.run([program, *words], cwd=folder, check=True, stderr=subprocess.DEVNULL)
    return folder / "run" / "report.html"


def close(a, b, tolerance):
    return abs(a - b) <= tolerance


# ---- What is asked of the page; each function is one test ----

def text_is_no_markup(browser, run):
    assert browser.run("return document.title") == TITLE, browser.run("return document.title")
    assert browser.run("return document.querySelectorAll('h1 b, h1 script, li i').length") == 0
    assert "Half <i>time</i>" in browser.run("return document.querySelector('ol').textContent")


def all_begins_at_one_moment(browser, run):
    """The film's first frame, not the poster, which is of another moment."""
    browser.wait("const f = grainreelReport.film; return f.frame === 0 && !f.video.seeking && f.video.currentTime > 0", "the film's first frame")
    assert browser.run("const r = grainreelReport; return [r.runTime.now, r.film.film.times[0], r.bed.frames.times[r.bed.viewer.frame]]") == [0, 0, 0]


def film_plays(browser, run):
    browser.run("document.getElementById('film').play()")
    browser.wait("return document.getElementById('film').currentTime > 0.3", "the film to play")
    browser.run("document.getElementById('film').pause()")
    browser.wait("return grainreelReport.film.frame >= 9", "the frames to be told")
    browser.wait("return Math.abs(grainreelReport.runTime.now - grainreelReport.film.film.times["
                 "grainreelReport.film.frame]) < 1e-9", "the run's time to be the film's")


def film_frames_are_half_slow_motion(browser, run):
    times = browser.run("return grainreelReport.film.film.times")
    assert len(times) == 61, len(times)  # 1 s at half speed and 30 frames a second, both ends
    step = 0.5 / 30
    assert all(close(time, k * step, 1e-4) for k, time in enumerate(times))


def chart_moves_film_and_bed(browser, run):
    left, top, width, height = browser.place_of(".u-over")
    for share in [0.2, 0.65, 0.4]:
        x, y = left + share * width, top + height / 2
        browser.pointer("mousePressed", x - 5, y)
        browser.pointer("mouseMoved", x, y)
        browser.pointer("mouseReleased", x, y, 0)
        low, high = browser.run("const s = [...grainreelReport.charts.plots.values()][0].scales.x;"
                                "return [s.min, s.max];")
        expected = low + share * (high - low)
        now = browser.run("return grainreelReport.runTime.now")
        assert close(now, expected, 2 * (high - low) / width), (now, expected)
        follows(browser, now)


def follows(browser, now):
    """Whether film and bed show the moments nearest to that time."""
    bed = browser.run("return grainreelReport.bed.frames.times[grainreelReport.bed.viewer.frame]")
    assert close(bed, now, 0.0125 / 2 + 1e-6), (bed, now)
    browser.wait("const f = grainreelReport.film; return !f.video.seeking && f.wanted === null", "the film to seek")
    times = numpy.array(browser.run("return grainreelReport.film.film.times"))
    frame = math.floor(browser.run("return grainreelReport.film.video.currentTime") * 30 + 0.01)
    assert frame == abs(times - now).argmin(), (frame, times[frame], now)


def buttons_and_story_move_all(browser, run):
    browser.run("document.querySelector('button[data-time]').click()")
    follows(browser, 0.5)
    before = browser.run("return grainreelReport.film.film.times.findIndex((t) => t >= grainreelReport.runTime.now)")
    browser.run("document.getElementById('on').click()")
    now = browser.run("return grainreelReport.runTime.now")
    follows(browser, now)
    assert close(now, browser.run("return grainreelReport.film.film.times[arguments[0]]", before + 1), 1e-9)


def places_are_those_of_the_trajectory(browser, run):
    trajectory = netCDF4.Dataset(run / "trajectory.nc")
    trajectory.set_auto_mask(False)
    places, times = trajectory["coordinates"][:], trajectory["time"][:]
    speeds = numpy.linalg.norm(trajectory["velocities"][:], axis=2)
    frames = numpy.array(browser.run("return grainreelReport.bed.frames.times"))
    film, keys = (netCDF4.Dataset(run / f"{name}_moments.nc")["time"][:] for name in ("film", "key"))
    assert len(frames) == len({round(time, 9) for time in [*times, *film, *keys]}), "the trajectory's, the film's, and key moments"
    low, high = (numpy.array(browser.run(f"return grainreelReport.bed.frames.{end}")) for end in ("low", "high"))
    stated = (high - low) / (2 * 65535) * (1 + 1e-6)
    fastest = speeds.max()
    for frame in range(0, len(times), len(times) // 10):
        moment = int(abs(frames - times[frame]).argmin())
        assert close(frames[moment], times[frame], 1e-9)
        shown = numpy.array(browser.run(
            "const f = grainreelReport.bed.frames; return [...f.ids.keys()].map((g) => f.place(arguments[0], g));",
            moment))
        assert (abs(shown - places[frame]) <= stated).all(), abs(shown - places[frame]).max(axis=0)
        told = numpy.array(browser.run(
            "const f = grainreelReport.bed.frames; return [...f.ids.keys()].map((g) => f.speedAt(arguments[0], g));",
            moment))
        seen = speeds[frame] > 1.001e-5 * fastest
        assert (abs(told[seen] / speeds[frame][seen] - 1) < 0.0235).all()


def contact_numbers_are_those_of_the_run(browser, run):
    contacts = netCDF4.Dataset(run / "contacts.nc")
    contacts.set_auto_mask(False)
    times = netCDF4.Dataset(run / "trajectory.nc")["time"][:]
    frame = len(times) // 2
    moment = browser.run("return grainreelReport.bed.frames.indexAt(arguments[0])", float(times[frame]))
    rows = (contacts["frame"][:] == frame) & (contacts["normal"][:] > 0)
    ids = list(contacts["first"][:][rows]) + list(contacts["second"][:][rows])
    told = browser.run("const f = grainreelReport.bed.frames;"
                       "return [...f.ids.keys()].map((g) => [f.ids[g], f.contactsAt(arguments[0], g)]);", moment)
    assert told == [[grain, ids.count(grain)] for grain, _ in told]
    assert not browser.run("const f = grainreelReport.bed.frames; return f.times.some((_, k) => f.contactsAt(k, 0) === null)")


def a_click_finds_the_grain(browser, run):
    """The first sphere on the ray through a pixel, by the camera's angles and the trajectory's places."""
    trajectory = netCDF4.Dataset(run / "trajectory.nc")
    trajectory.set_auto_mask(False)
    camera = browser.run("const c = grainreelReport.bed.viewer.camera;"
                         "return {eye: c.eye(), azimuth: c.azimuth, elevation: c.elevation, fov: c.start.fov};")
    browser.run("grainreelReport.runTime.set(arguments[0], 'test')", float(trajectory["time"][32]))
    frame = int(abs(trajectory["time"][:] - browser.run(
        "return grainreelReport.bed.frames.times[grainreelReport.bed.viewer.frame]")).argmin())
    places, radii, ids = trajectory["coordinates"][frame], trajectory["radius"][frame], trajectory["id"][frame]
    left, top, _, _ = browser.place_of("#bed")
    border, width, height = browser.run("const c = document.getElementById('bed');"
                                        "return [c.clientLeft, c.clientWidth, c.clientHeight]")
    left, top = left + border, top + border
    found = 0
    for across in numpy.linspace(0.25, 0.75, 11):
        for down in numpy.linspace(0.55, 0.92, 11):
            column, row = round(across * width), round(down * height)
            expected = first_on_ray(camera, (column + 0.5) / width, (row + 0.5) / height, width / height, places, radii)
            x, y = left + column, top + row
            browser.run("grainreelReport.bed.choose(-1)")
            browser.pointer("mousePressed", x, y)
            browser.pointer("mouseReleased", x, y, 0)
            chosen = browser.run("return grainreelReport.bed.viewer.chosen")
            said = browser.run("return document.getElementById('grain-says').textContent")
            if expected is None:
                continue  # too near a rim to tell
            if expected < 0:
                assert chosen == -1, (across, down, said)
                continue
            found += 1
            assert said.startswith(f"Grain {ids[expected]}, "), (across, down, ids[expected], said)
    assert found >= 12, found


def first_on_ray(camera, across, down, aspect, places, radii):
    """An index; -1 for none; None where the ray passes within a tenth of a radius of a rim."""
    a, e = math.radians(camera["azimuth"]), math.radians(camera["elevation"])
    forward = numpy.array([-math.cos(e) * math.cos(a), -math.cos(e) * math.sin(a), -math.sin(e)])
    right = numpy.array([-math.sin(a), math.cos(a), 0])
    up = numpy.cross(right, forward)
    half = math.tan(math.radians(camera["fov"]) / 2)
    ray = forward + half * ((1 - 2 * down) * up + (2 * across - 1) * aspect * right)
    ray /= numpy.linalg.norm(ray)
    to_centres = places - numpy.array(camera["eye"])
    along = to_centres @ ray
    aside = numpy.linalg.norm(to_centres - along[:, None] * ray, axis=1)
    if (abs(aside / radii - 1) < 0.1).any():
        return None
    hit = aside < radii
    if not hit.any():
        return -1
    depth = numpy.where(hit, along - numpy.sqrt(numpy.maximum(0, radii**2 - aside**2)), numpy.inf)
    return int(depth.argmin())


def has_forces(browser, time):
    return browser.run("const b = grainreelReport.bed; return b.forces.at.has(b.frames.indexAt(arguments[0]))", float(time))


def forces_are_those_of_the_run(browser, run):
    """At each key moment: the pairs of key_contacts.nc and their forces to 2.3 %; who pushes a grain; the sums."""
    moments, contacts = (netCDF4.Dataset(run / name) for name in ("key_moments.nc", "key_contacts.nc"))
    for file in (moments, contacts):
        file.set_auto_mask(False)
    times = moments["time"][:]
    assert len(times) > 20 and times[0] == 0 and close(times[-1], 1, 1e-3), times
    for k in range(16):  # two periods of 50 ms before the end
        assert abs(times - (0.9 + 0.1 * k / 16)).min() < 1e-4, (k, times)
    frames, first, second, normal = (contacts[name][:] for name in ("frame", "first", "second", "normal"))
    for key in range(len(times)):
        browser.run("grainreelReport.runTime.set(arguments[0], 'test')", float(times[key]))
        shown = browser.run("const b = grainreelReport.bed, p = b.forces.at.get(b.viewer.frame);"
                            "const id = (g) => g < 1000 ? b.frames.ids[g] : -1 - (0xffffff - g);"
                            "return [...p.force].map((f, i) => [id(p.first[i]), id(p.second[i]), f])")
        rows = frames == key
        kept = {(int(a), int(b)): float(f) for a, b, f in zip(first[rows], second[rows], normal[rows])}
        told = {(a, b): f for a, b, f in shown}
        assert set(told) == set(kept), key
        assert all(close(told[pair] / kept[pair], 1, 0.0235) for pair in kept if kept[pair] > 1.1e-5 * normal.max())
    grain = int(first[rows][0])
    browser.run("grainreelReport.bed.choose(grainreelReport.bed.frames.ids.indexOf(arguments[0]))", grain)
    said = browser.run("return document.getElementById('grain-says').textContent").split("Pushed by: ")[1]
    pushers = sorted(((f, a if b == grain else b) for (a, b), f in kept.items() if grain in (a, b)), reverse=True)
    assert said.count(" N") == len(pushers), (said, pushers)
    assert said.startswith(f"{'a wall' if pushers[0][1] < 0 else pushers[0][1]} with "), (said, pushers)
    browser.run("grainreelReport.bed.choose(-1)")


def chains_are_shown_at_key_moments_alone(browser, run):
    picture = "const v = grainreelReport.bed.viewer; v.draw(); return v.canvas.toDataURL();"
    browser.run("document.getElementById('forces-back').click()")
    browser.run("document.getElementById('forces-on').click()")
    say = "return document.getElementById('forces-say').textContent"
    assert browser.run(say) == "The forces of this moment are known.", browser.run(say)
    without = browser.run(picture)
    browser.run("document.getElementById('chains').click()")
    chains = browser.run("return grainreelReport.bed.viewer.chains.length")
    assert chains > 5 and browser.run(picture) != without
    assert "join grains that push each other" in browser.run(say)
    browser.run("const s = document.getElementById('species-0'); s.value = 0; s.dispatchEvent(new Event('change'))")
    assert browser.run("return grainreelReport.bed.viewer.chains.length") < chains, "none to hidden grains"
    browser.run("const s = document.getElementById('species-0'); s.value = 255; s.dispatchEvent(new Event('change'))")
    time = browser.run("const b = grainreelReport.bed; return b.frames.times.find((t, k) => !b.forces.at.has(k))")
    browser.run("grainreelReport.runTime.set(arguments[0], 'test')", time)
    assert browser.run("return grainreelReport.bed.viewer.chains.length") == 0
    assert "At this one they are not" in browser.run(say)
    browser.run("document.getElementById('chains').click(); document.getElementById('chains').click()")
    assert browser.run("return grainreelReport.bed.viewer.chains.length") > 0, "it goes to the nearest key moment"
    browser.run("document.getElementById('chains').click()")


def a_picture_takes_three_calls_and_little_traffic(browser, run):
    """With chains and the way of a grain."""
    browser.run("document.getElementById('chains').click(); grainreelReport.bed.choose(3)")
    calls, bytes_sent = browser.run("""
        const viewer = grainreelReport.bed.viewer, gl = viewer.gl, count = {calls: 0, bytes: 0}, own = {};
        for (const name of ['drawArrays', 'drawArraysInstanced', 'bufferData', 'bufferSubData', 'texImage2D']) {
            own[name] = gl[name];
            gl[name] = (...words) => {
                if (name.startsWith('draw')) ++count.calls;
                else count.bytes += words.find((word) => ArrayBuffer.isView(word)).byteLength;
                return own[name].call(gl, ...words);
            };
        }
        viewer.draw();
        for (const name in own) delete gl[name];
        return [count.calls, count.bytes];""")
    assert calls <= 3 and 0 < bytes_sent <= 200_000, (calls, bytes_sent)
    browser.run("document.getElementById('chains').click(); grainreelReport.bed.choose(-1)")


def near_neighbours_are_told(browser, run):
    trajectory = netCDF4.Dataset(run / "trajectory.nc")
    trajectory.set_auto_mask(False)
    frame = next(k for k in range(10, 81) if not has_forces(browser, trajectory["time"][k]))
    browser.run("grainreelReport.runTime.set(arguments[0], 'test')", float(trajectory["time"][frame]))
    places, radii, ids = trajectory["coordinates"][frame], trajectory["radius"][frame], trajectory["id"][frame]
    for grain in (0, 17, 45):
        gaps = numpy.linalg.norm(places - places[grain], axis=1) - radii - radii[grain]
        sure = {int(ids[k]) for k in range(len(ids)) if k != grain and gaps[k] < 0.099 * radii[grain]}
        may = {int(ids[k]) for k in range(len(ids)) if k != grain and gaps[k] < 0.101 * radii[grain]}
        browser.run("grainreelReport.bed.choose(grainreelReport.bed.frames.ids.indexOf(arguments[0]))", int(ids[grain]))
        said = browser.run("return document.getElementById('grain-says').textContent")
        told = said.split("Near neighbours: ")[1].rstrip(".")
        told = set() if told == "none" else {int(word) for word in told.split(", ")}
        assert sure <= told <= may, (said, sure, may)
    browser.run("grainreelReport.bed.choose(-1)")


def controls_change_the_picture(browser, run):
    """Colours, a hidden species, a slice: each gives another picture, and taking it back the first again."""
    picture = ("const v = grainreelReport.bed.viewer; v.draw(); return v.canvas.toDataURL();")
    browser.run("grainreelReport.runTime.set(0, 'test')")  # a moment with forces
    first = browser.run(picture)
    assert browser.run(picture) == first
    for selector, value in [("#colour-by", "1"), ("#colour-by", "4"), ("#colour-by", "5"), ("#species-0", "0"), ("#species-1", "128"),
                            ("#slice", "x")]:
        change = ("const s = document.querySelector(arguments[0]), old = s.value; s.value = arguments[1];"
                  "s.dispatchEvent(new Event('change')); return old;")
        old = browser.run(change, selector, value)
        assert browser.run(picture) != first, selector
        browser.run(change, selector, old)
        assert browser.run(picture) == first, selector


def fields_are_those_of_the_run(browser, run):
    """Each value within half of the 1/254 that the page rounds to, and the profile over height as xarray has it."""
    fields = netCDF4.Dataset(run / "fields.nc")
    fields.set_auto_mask(False)
    bounds = browser.run("return grainreelReport.fields[0].facts.records")
    assert numpy.allclose(bounds, fields["time_bounds"][:])
    record = len(bounds) // 2
    browser.run("grainreelReport.runTime.set(arguments[0], 'test')", sum(bounds[record]) / 2)
    names = browser.run("return grainreelReport.fields[0].facts.quantities.map((q) => q.name)")
    assert {"solid_fraction_small", "solid_fraction_big", "speed", "pressure"} <= set(names), names
    room = fields["free_volume"][record]
    for index, name in enumerate(names):
        if name in ("speed", "pressure"):
            continue
        all_records = fields[name][:]
        step = (numpy.nanmax(all_records) - numpy.nanmin(all_records)) / 254
        browser.run("const s = document.getElementById('field'); s.value = arguments[0];"
                    "s.dispatchEvent(new Event('change'))", index)
        told = numpy.array(browser.run("const f = grainreelReport.fields[0];"
                                       "return [...Array(f.cells).keys()].map((c) => f.value(c))"), float)
        exact = all_records[record].ravel()
        assert (numpy.isnan(told) == ~numpy.isfinite(exact)).all(), name
        assert numpy.nanmax(abs(told - exact)) <= 0.5001 * step, (name, numpy.nanmax(abs(told - exact)) / step)
        if name.startswith("solid"):
            profile = numpy.array(browser.run("return grainreelReport.fields[0].profile('z')"), float)
            expected = (all_records[record] * room).sum(axis=1) / numpy.maximum(room.sum(axis=1), 1e-30)
            inside = room.sum(axis=1) > 0
            assert numpy.allclose(profile[inside, 1], expected[inside], atol=step + 0.005), name
            assert numpy.allclose(profile[:, 0], fields["z"][:])
    assert "mean from" in browser.run("return document.getElementById('field-says').textContent")


FILM_SETTLED = "const f = grainreelReport.film; return !f.video.seeking && f.wanted === null"


def looks_as_before(browser, run):
    """A bed that is not there must not pass."""
    browser.run("grainreelReport.runTime.set(0.4, 'test')")
    browser.looks_as_kept("report", run.parent, FILM_SETTLED)
    browser.run("document.getElementById('bed').style.visibility = 'hidden'")
    _, blocks = browser.difference((KEPT / "report_1280.webp").read_bytes(), browser.view())
    browser.run("document.getElementById('bed').style.visibility = ''")
    assert blocks > MOST_BLOCKS, blocks


def chains_look_as_before(browser, run):
    browser.run("grainreelReport.runTime.set(0, 'test'); document.getElementById('chains').click()")
    browser.looks_as_kept("chains", run.parent, FILM_SETTLED, "#forces-say")
    browser.run("document.getElementById('chains').click()")


def everything_is_labelled(browser, run):
    assert browser.run("""
        const named = (e) => e.labels?.length || e.getAttribute('aria-label') || e.textContent.trim();
        return [...document.querySelectorAll('input, select, button, video, canvas#bed')].filter((e) => !named(e))
            .map((e) => e.outerHTML.slice(0, 120));""") == []
    assert browser.run("return [...document.images].filter((i) => !i.alt).length") == 0
    levels = browser.run("return [...document.querySelectorAll('h1, h2, h3')].map((h) => Number(h.tagName[1]))")
    assert levels[0] == 1 and levels.count(1) == 1
    assert all(b - a <= 1 for a, b in zip(levels, levels[1:])), levels


def the_story_goes_along(browser, run):
    for time, text in [(0.6, "Half <i>time</i>"), (0.9, ""), (0.5, "Half <i>time</i>"), (0.45, "")]:
        browser.run("grainreelReport.runTime.set(arguments[0], 'test')", time)
        assert browser.run("return document.getElementById('caption-now').textContent") == text, time
        assert browser.run("return document.querySelectorAll('li[aria-current]').length") == (1 if text else 0)


def large_print_is_large_and_fits(browser, run):
    before = browser.run("return parseFloat(getComputedStyle(document.querySelector('p.lead')).fontSize)")
    for width in (1280, 390):
        browser.resize(width, 1000)
        browser.run("document.getElementById('large-print').click()")
        assert close(browser.run("return parseFloat(getComputedStyle(document.querySelector('p.lead')).fontSize)"),
                     1.5 * before, 0.1)
        wide = browser.run("return document.documentElement.scrollWidth")
        assert wide <= width, (width, wide)
        browser.run("document.getElementById('large-print').click()")


def words_fit(browser, run):
    for width in (1280, 390):
        browser.resize(width, 1000)
        wide = browser.run("return document.documentElement.scrollWidth")
        assert wide <= width, (width, wide)
        browser.picture(run.parent / f"report_{width}.png")


TESTS = [text_is_no_markup, all_begins_at_one_moment, film_frames_are_half_slow_motion, film_plays, chart_moves_film_and_bed,
         buttons_and_story_move_all, places_are_those_of_the_trajectory, contact_numbers_are_those_of_the_run,
         a_click_finds_the_grain, forces_are_those_of_the_run, chains_are_shown_at_key_moments_alone,
         a_picture_takes_three_calls_and_little_traffic, near_neighbours_are_told, controls_change_the_picture,
         fields_are_those_of_the_run, looks_as_before, chains_look_as_before, everything_is_labelled, the_story_goes_along,
         large_print_is_large_and_fits, words_fit]


def without(page, reason, **browser_options):
    """Without something that the bed needs: the page says so, and film and charts are there."""
    with Browser(**browser_options) as browser:
        browser.open(page)
        said = browser.run("return document.getElementById('bed-says').textContent")
        assert reason in said and "is not shown" in said, said
        assert browser.run("return document.getElementById('bed').hidden")
        assert browser.run("return document.querySelectorAll('.chart canvas').length") >= 2
        browser.run("document.getElementById('film').play()")
        browser.wait("return document.getElementById('film').currentTime > 0.1", "the film to play")
        return browser.console()


def of_a_failed_run(program, folder):
    """The page says why, shows no empty controls, and is as legible as any other."""
    (folder / "blown.toml").write_text(SCENE.replace("overlap = 0.05", 'step = "1.2e-3 s"'))  # far too large a step
    ended = subprocess.run([program, "movie", "blown.toml", "--out", "blown", "--threads", "1"], cwd=folder,
                           stderr=subprocess.DEVNULL)
    assert ended.returncode == 1
    with Browser() as browser:
        browser.open(folder / "blown" / "report.html")
        said = browser.run("return document.querySelector('.ended').textContent")
        assert said.startswith("The run failed at 0 of 1 s: ") and "take a smaller run.step" in said, said
        seen = browser.run("return [...document.querySelectorAll('button, select, input')].filter((e) => e.checkVisibility())"
                           ".map((e) => e.textContent)")
        assert not {"Play", "Zoom in", "Reset the view"} & set(seen), seen
        browser.looks_as_kept("failed", folder)
        assert browser.console() == []


def no_barriers(browser, axe):
    browser.run(axe.read_text())
    found = browser.driver.execute_async_script(
        "const done = arguments[0];"
        "axe.run(document, {}).then((all) => done(all.violations.map((v) => [v.id, v.nodes.map((n) => n.html)])));")
    assert found == [], found


def main():
    program, folder = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
    axe = pathlib.Path(sys.argv[3]) if len(sys.argv) > 3 else None
    page = make_page(program, folder)
    with Browser() as browser:
        browser.open(page)
        for test in TESTS:
            test(browser, page.parent)
            print(f"passed: {test.__name__}", flush=True)
        console = browser.console()
        assert console == [], console
        print("passed: nothing on the console")
    without(page, "no WebGL 2", options=["--disable-3d-apis"])
    print("passed: without WebGL")
    console = without(page, "no DecompressionStream", at_start="delete window.DecompressionStream")
    assert console == [], console
    print("passed: without DecompressionStream")
    of_a_failed_run(program, folder)
    print("passed: of_a_failed_run")
    for dark in (False, True):
        with Browser(dark=dark) as browser:
            browser.open(page)
            browser.picture(folder / f"report_{'dark' if dark else 'light'}.png")
            if axe:
                no_barriers(browser, axe)
                print(f"passed: axe-core, {'dark' if dark else 'light'}")
    if not axe:
        print("left out: axe-core, which needs npm")


if __name__ == "__main__":
    main()
