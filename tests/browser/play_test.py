#!/usr/bin/python3
"""The page of `grainreel play` in Chromium.   play_test.py GRAINREEL FOLDER [AXE]

Needs the engine for browsers (build/web), without which it says so and does nothing. Five scenes are packed and run by the
page and by the program with the plain instruction set: the hashes of their states must be the same. Then one page is played
with: knobs, tap, tilt, chains, a followed grain, the scene that is taken along, and what it says where the browser lacks
something.
"""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import time

from browser import Browser

SCENES = ["teaching_brazil_nut", "teaching_restitution", "teaching_gas_cooling", "teaching_sorting", "teaching_hourglass"]
STEPS = 4000
MOST_BYTES = 4_000_000
WAIT = """const [act, is] = arguments, done = arguments[arguments.length - 1];
grainreelPlay.next(is).then(done);
(new Function(act))();"""


def page_of(program, folder, scene, *words):
    page = folder / f"{pathlib.Path(scene).stem}.html"
    subprocess.run([program, "play", scene, "--out", page, "--quiet", *words], check=True, stdout=subprocess.DEVNULL)
    assert page.stat().st_size < MOST_BYTES, page.stat().st_size
    return page


def answer(browser, act, message):
    """What the worker sends after an act of the page."""
    return browser.driver.execute_async_script(WAIT, act, message)


def pause(browser):
    browser.wait("return grainreelPlay.isPacked === true", "the bed to be packed")
    browser.run("grainreelPlay.go(false)")


def facts_of(page):
    text = page.read_text()
    begin = text.index('id="facts">') + len('id="facts">')
    return json.loads(text[begin:text.index("</script>", begin)])


def hash_of_page(browser, page):
    """After so many steps from the packed bed, which the page is kept from making by itself."""
    browser.driver.get(page.resolve().as_uri())
    browser.wait("return grainreelPlay.isPacked === true", "the bed to be packed")
    told = answer(browser, f"grainreelPlay.tell({{does: 'steps', count: {STEPS}}})", "hash")
    assert told["step"] == STEPS, told
    return told["hash"]


def hash_of_program(program, folder, page):
    """Of the scene that the page has, run by the program in plain code."""
    facts = facts_of(page)
    scene = folder / f"{facts['name']}_played.toml"
    scene.write_text(facts["planned"])
    step = next(float(line.split("=")[1]) for line in facts["planned"].splitlines() if line.startswith("step ="))
    run = folder / f"run_{facts['name']}"
    subprocess.run([program, "movie", scene, "--out", run, "--force", "--no-film", "--quiet", "--no-cache", "--threads", "1",
                    "--duration", f"{STEPS * step!r} s"],
                   check=True, env={**os.environ, "GRAINREEL_INSTRUCTIONS": "plain"}, stdout=subprocess.DEVNULL,
                   stderr=subprocess.DEVNULL)
    return json.loads((run / "run.json").read_text())["result"]["state_hash"]


def same_bits(program, folder):
    with Browser(at_start="window.grainreelWaits = true;") as browser:
        for scene in SCENES:
            page = page_of(program, folder, scene)
            there, here = hash_of_page(browser, page), hash_of_program(program, folder, page)
            assert there == here, (scene, there, here)
            print(f"  {scene}: {there} after {STEPS} steps")
            assert browser.console() == [], scene


# ---- What is asked of one page; each function is one test ----

def it_moves(browser, _folder):
    browser.wait("return grainreelPlay.time > 0.1", "the bed to move")
    browser.wait("return grainreelPlay.pictures > 5", "pictures")
    browser.wait("return grainreelPlay.rows.values[0].length > 3", "measures")
    assert browser.run("return document.querySelectorAll('#charts figure').length") >= 3


def space_stops_it(browser, _folder):
    browser.run("document.activeElement.blur(); document.body.dispatchEvent(new KeyboardEvent('keydown', {key: ' ', bubbles: true}))")
    browser.wait("return !grainreelPlay.isGoing", "it to stop")
    time.sleep(0.3)
    before = browser.run("return grainreelPlay.time")
    time.sleep(0.3)
    assert browser.run("return grainreelPlay.time") == before
    browser.run("document.getElementById('go').click()")
    browser.wait(f"return grainreelPlay.time > {before}", "it to go on")


def knobs_act(browser, _folder):
    for key, value, text in [("drive.g_level", 2, None), ("contact.friction", 0.1, None), ("drive.frequency", 12, None),
                             ("gravity", 1.62, None)]:
        plan = answer(browser, f"const k = grainreelPlay.knobs, o = k.knobs.find((o) => o.key === '{key}'); k.set(o, {value}, null)",
                      "turned")["plan"]
        assert plan["step"] > 0 and text is None
    now = browser.run("return grainreelPlay.time")
    browser.wait(f"return grainreelPlay.time > {now} + 0.6", "it to go on with other knobs")
    beyond = browser.run("const k = grainreelPlay.knobs, o = k.knobs.find((o) => o.key === 'contact.friction');"
                         "k.set(o, 1e9, null); return k.values.get(o.key) === o.high")
    assert beyond is True


def what_is_taken_along_has_the_knobs(browser, folder, program):
    text = answer(browser, "HTMLAnchorElement.prototype.click = () => {}; document.getElementById('take').click()", "scene")["text"]
    taken = folder / "taken.toml"
    taken.write_text(text)
    told = subprocess.run([program, "check", taken], check=True, capture_output=True, text=True).stdout
    assert "12 Hz" in told, told
    assert "friction = 1.5" in text, text


def tap_and_tilt(browser, _folder):
    browser.run("grainreelPlay.part('tap').click(); const t = grainreelPlay.part('tilt'); t.value = 20; t.dispatchEvent(new Event('input'))")
    now = browser.run("return grainreelPlay.time")
    browser.wait(f"return grainreelPlay.time > {now} + 1", "the tap to be over")
    assert browser.run("return document.getElementById('tilt-says').textContent") == "20°"


def chains_and_a_grain(browser, folder):
    browser.run("grainreelPlay.part('chains').click(); grainreelPlay.panel.choose(3); grainreelPlay.part('follow').click()")
    browser.wait("return grainreelPlay.panel.viewer.chains.length > 10", "force chains")
    browser.wait("return /Pushed by/.test(document.getElementById('grain-says').textContent)", "words about the grain")
    browser.picture(folder / "play_1280.png")


def packs_anew(browser, _folder):
    browser.run("const k = grainreelPlay.knobs, o = k.knobs.find((o) => o.key === 'species.nut.count'); k.set(o, 3, null);"
                "grainreelPlay.part('anew').click()")
    browser.wait("return grainreelPlay.isPacked && grainreelPlay.hasFrame && grainreelPlay.panel.frames.grains === 253", "a bed with three nuts")


def played(program, folder, axe):
    page = page_of(program, folder, "teaching_brazil_nut", "--set", "play.challenge=Bring it up")
    named = folder / "振动.html"
    shutil.copyfile(page, named)
    with Browser() as browser:
        began = time.monotonic()
        browser.open(named)
        print(f"  ready after {time.monotonic() - began:.1f} s")
        assert browser.run("return document.querySelector('.challenge').textContent") == "Bring it up"
        for test in [it_moves, space_stops_it, knobs_act]:
            test(browser, folder)
            print(f"passed: {test.__name__}", flush=True)
        what_is_taken_along_has_the_knobs(browser, folder, program)
        print("passed: what_is_taken_along_has_the_knobs")
        for test in [tap_and_tilt, chains_and_a_grain, packs_anew]:
            test(browser, folder)
            print(f"passed: {test.__name__}", flush=True)
        for width in (1400, 800, 400):
            browser.resize(width, 1000)
            assert browser.run("return document.documentElement.scrollWidth <= innerWidth"), width
            browser.picture(folder / f"play_{width}.png")
        if axe:
            browser.run(axe.read_text())
            found = browser.driver.execute_async_script("axe.run().then((r) => arguments[0](r.violations.map((v) => v.id + ' ' + v.nodes[0].html)))")
            assert found == [], found
        console = browser.console()
        assert console == [], console
    return page


def says_what_it_lacks(page):
    for script, word in [("delete window.WebAssembly;", "WebAssembly"),
                         ("HTMLCanvasElement.prototype.getContext = () => null;", "WebGL")]:
        with Browser(at_start=script) as browser:
            browser.driver.get(page.resolve().as_uri())
            browser.wait("return !!document.documentElement.dataset.ready", "an answer")
            said = browser.run("return document.getElementById('play-says').textContent + document.getElementById('bed-says').textContent")
            assert word in said, said


def main():
    program, folder = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    axe = pathlib.Path(sys.argv[3]) if len(sys.argv) > 3 else None
    if not (program.parent.parent / "web" / "page_engine.wasm").exists():
        print("skipped: play, since the engine for browsers was not built (Debian's emscripten is missing)")
        return
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    same_bits(program, folder)
    print("passed: same_bits")
    page = played(program, folder, axe)
    says_what_it_lacks(page)
    print("passed: says_what_it_lacks")


if __name__ == "__main__":
    main()
