"""Misuse of the Python module: whatever is wrong is a GrainreelError of one line, in Python's words."""
import gc
import json
import multiprocessing
import os
import pickle
import shutil
import time
import warnings
from pathlib import Path

import grainreel
import numpy


def _fork_draws(expected):
    os._exit(0 if (grainreel.render("line", size="160x120") == expected).all() else 1)


class Odd:
    """A value whose words fail too."""

    def __repr__(self):
        raise RuntimeError("no words")


def calls(run):
    """Each with the words that its message must have."""
    start, render, inspect = grainreel.start, grainreel.render, grainreel.inspect
    nul, half = "a\0b", "a\ud800b"
    return [
        # arguments that no program can be given
        ("scene: has a NUL", lambda: start(nul)), ("scene: has a lone surrogate", lambda: start(half)),
        ("text: has a NUL", lambda: start(text=nul)), ("text: has a lone surrogate", lambda: start(text=half)),
        ("out: has a NUL", lambda: start("scene.toml", out=nul)), ("out: is empty", lambda: start("scene.toml", out="")),
        ("drive.frequency: has a NUL", lambda: start("scene.toml", drive__frequency=nul)),
        ("film.title: has a lone surrogate", lambda: render(run, title=half)),
        ("where: has a NUL", lambda: inspect(run, where=nul)), ("run: has a NUL", lambda: grainreel.open(nul)),
        ("program: has a NUL", lambda: start("scene.toml", program=nul)),
        ("a key of set: has a NUL", lambda: start("scene.toml", set={nul: 1})),
        # of another type
        ("scene: must be a path, but is 3", lambda: start(3)), ("scene: must be a path", lambda: start(Odd())),
        ("or be given as text=", lambda: start()), ("leave one out", lambda: start("scene.toml", text="")),
        ("text: must be text", lambda: start(text=b"x")), ("out: must be a path", lambda: start("scene.toml", out=3)),
        ("set: must be a dict", lambda: start("scene.toml", set=["drive.g_level=3"])),
        ("a key of set: must be text", lambda: start("scene.toml", set={3: 3})),
        ("drive.frequency: must be text, a number", lambda: start("scene.toml", drive__frequency=None)),
        ("drive.frequency: must be text, a number", lambda: start("scene.toml", drive__frequency=Odd())),
        ("drive.frequency: must be text, a number", lambda: start("scene.toml", drive__frequency=1j)),
        ("threads: must be a number", lambda: start("scene.toml", threads="two")),
        ("threads: must be a whole number", lambda: start("scene.toml", threads=1.5)),
        ("progress: must be True or a function", lambda: grainreel.run("scene.toml", progress=3)),
        ("at: must be a number", lambda: render(run, at=[1, 2])), ("at: must be a time", lambda: render(run, at="soon")),
        ("at: must be a time", lambda: render(run, at=float("nan"))),
        ("at: must be a number", lambda: inspect(run, at=run.time)),
        ("frame: must be a whole number", lambda: render(run, frame=0.5)),
        ("both name a moment", lambda: render(run, at=0, frame=0)),
        ("both name a moment", lambda: render(run, frame=0, cycle=1)), ("give its cycle", lambda: render(run, phase=0.5)),
        ("phase: must be a number from 0 to 1", lambda: render(run, cycle=1, phase=2)),
        ("cycle", lambda: render(run, cycle=float("nan"))), ("cycle", lambda: render(run, cycle=1e9)),
        ("size: must be as", lambda: render(run, size=3)), ("size: must be as", lambda: render(run, size=(3, 4, 5))),
        ("size: must be as", lambda: render(run, size=(3, "x"))), ("film.size", lambda: render(run, size=(0, 0))),
        ("sped", lambda: render(run, colour="sped")), ("sped", lambda: grainreel.film(run, "never", colour="sped")),
        ("leave one of them out", lambda: render(run, colour="speed", colour__by="speed")),
        ("colour: must be text", lambda: grainreel.film(run, "never", colour=[1] * 50)),
        ("measure: must be a name", lambda: inspect(run, measure=3)), ("measure: must be text", lambda: inspect(run, measure=[3])),
        ("window: must be two times", lambda: inspect(run, measure="kinetic_J", window=0.1)),
        ("slope: must be a time", lambda: inspect(run, measure="kinetic_J", slope=("soon", 1))),
        ("period", lambda: inspect(run, measure="kinetic_J", by="hour")),
        ("a caption: must be text", lambda: grainreel.compare({1: run, 2: run})),
        ("has the shape (2, 2)", lambda: render(run, colour=numpy.zeros((2, 2)))),
        ("3 values for the colours of 50 grains", lambda: render(run, colour=[1, 2, 3])),
        ("no value that can be shown", lambda: render(run, colour=[float("nan")] * 50)),
        ("leave one of them out", lambda: render(run, colour=[1] * 50, colour__by="speed")),
        ("colour__range: must be two numbers", lambda: render(run, colour=[1] * 50, colour__range=3)),
        ("colour__range: must be two numbers", lambda: render(run, colour=[1] * 50, colour__range=(0, float("inf")))),
        ("film.colour.range: needs", lambda: render(run, colour=[1] * 50, colour__range=(2, 1))),
        ("colour__scale: must be linear or", lambda: render(run, colour=[1] * 50, colour__scale="root")),
        ("there is no map", lambda: render(run, colour=[1] * 50, colour__map="jet")),
        ("a frame: must be a whole number or a slice", lambda: run["kinetic_J"]),
        ("time: must be a number", lambda: run.sel(time=[0, 1])),
        ("no frame is at", lambda: run.sel(time=0.01, method=None)),
        ("its frames are from 0 s to 0.2 s", lambda: run.sel(time=99)), ("no frame at -1 s", lambda: run.sel(time=-1)),
        ("does not look for a frame", lambda: 3 in run), ("nope is not there", lambda: grainreel.Film("nope")),
        ("film: must be a path", lambda: grainreel.Film(3)), ("is an empty list", lambda: grainreel.compare([])),
        ("holds itself", lambda: start(ring())), ("below 2,147,483,648", lambda: render(run, frame=10 ** 30)),
        ("below 2,147,483,648", lambda: inspect(run, grain=10 ** 20)),
        ("colour: must be a number for each", lambda: render(run, colour=numpy.ones(50) * 1j)),
        ("time_step: must be one value", lambda: grainreel.open("two.xyz", time_step=[1])),
        ("species: must be a dict of names", lambda: grainreel.open("two.xyz", species={"x": 1})),
        ('joined by "and"', lambda: run[-1].where("species == big or z > 1")),
        ("no specis; did you mean species", lambda: run[-1].where("specis == big")),
        ("must be a number, with a unit", lambda: run[-1].where("z > 3 parsec")),
        ("species is a word", lambda: run[-1].where("species > big")),
        ("what: must be", lambda: run.to_dataframe("grain")),
        ("no such argument", lambda: grainreel.open("two.xyz", radii=3)),
        ("is for files of other programs", lambda: grainreel.open("line", radius="2 mm")),
        ("runs: must be a path or a list", lambda: grainreel.compare(3)),
        ("vary: must be one key", lambda: grainreel.compare("scene.toml", vary={"a": 1, "b": 2})),
        ("captions", lambda: grainreel.compare([run, run], captions=["one"])),
        # what the program refuses, in Python's words
        ("drive.frequencie: unknown key", lambda: start("scene.toml", drive__frequencie=3).result()),
        ("force=True", lambda: grainreel.run("scene.toml", out="line")),
        ("text:1:1: there are no grains", lambda: grainreel.run(text="title = 'x'")),
        ("text:2:1", lambda: grainreel.run(text="title = 'x'\ncolour = 3")),
        ("scene", lambda: grainreel.run({"title": "x", "colour": 3})),
        ("is not found", lambda: grainreel.run("scene.toml", program="no-such-program")),
        ("is no folder of a run", lambda: grainreel.open("/")), ("no such", lambda: grainreel.open("nothing.xyz")),
        ("no-such-column", lambda: inspect(run, steady="no-such-column")),
        ("to", lambda: run.export("paper")), ("study:", lambda: grainreel.study({"scene": 3}, out="odd"))]


def ring():
    """A scene that holds itself."""
    scene = {"title": "x"}
    scene["start"] = {"inside": scene}
    return scene


def told(call):
    """The message; what else comes through is a fault of the module."""
    try:
        call()
    except grainreel.GrainreelError as error:
        return str(error)
    except Exception as error:
        return f"{type(error).__name__}: {error}"
    return "no mistake"


def check_messages(run):
    wrong = []
    for words, call in calls(run):
        said = told(call)
        if words not in said or "\n" in said or said.startswith(("error", "TypeError", "ValueError")) or " --" in said:
            wrong.append(f"'{words}' is expected in one line, it says: {said}")
    if Path(".").glob(".grainreel-*") and list(Path(".").glob(".grainreel-*")):
        wrong.append("files of scenes that were texts are left behind")
    return wrong


def check_damage():
    """Files of a run that are not what they were."""
    wrong, folder = [], Path("damaged")
    folder.mkdir(exist_ok=True)
    (folder / "scene.toml").write_text("title = ")
    for file, data, words, read in (
            ("measures.csv", b"step,time_s\n1,x\n", "is damaged", lambda run: run.measures),
            ("measures.csv", b"\xff\xfe", "is damaged", lambda run: run.measures),
            ("measures.csv", b"step\n1\n", "no column time_s", lambda run: run.measures),
            ("run.json", b"{", "is damaged", lambda run: run.record), ("run.json", b"[1]", "is damaged", repr),
            ("run.json", b"\xff", "is damaged", lambda run: run.record),
            ("trajectory.nc", b"\x89HDF no more", "cannot be read", len),
            ("scene.toml", b"title = ", "is damaged", lambda run: run.scene)):
        (folder / file).write_bytes(data)
        said = told(lambda: read(grainreel.open(folder)))
        if words not in said or file not in said or "\n" in said:
            wrong.append(f"of a damaged {file} it says: {said}")
    return wrong


def check_cut(run):
    """A trajectory that was cut off is refused, as the program refuses it; of a killed run one frame may be missing."""
    wrong, data = [], Path("line/trajectory.nc").read_bytes()
    shutil.copytree("line", "cut", dirs_exist_ok=True)
    for length, words in ((len(data) // 2, "of its 5 frames 1 are whole"), (len(data) - 10, "no mistake")):
        Path("cut/trajectory.nc").write_bytes(data[:length])
        os.utime("cut/trajectory.nc", (1, 1))  # else the reader waits for a program that still writes
        for read in (len, lambda run: run[-1], lambda run: run.to_dataframe(), lambda run: run.time):
            if words not in told(lambda: read(grainreel.open("cut"))):
                wrong.append(f"of a trajectory that was cut off it says: {told(lambda: read(grainreel.open('cut')))}")
    if len(grainreel.open("cut")) != len(run) - 1:
        wrong.append("a frame that is not whole is counted")
    return wrong


def check_names(run):
    """Names that are not there: which are meant."""
    wrong = []
    for words, call in (('run[-1].where("species', lambda: run.where), ("mean run.render()", lambda: run.picture),
                        ("did you mean time", lambda: run.tim), ("mean x, y and z", lambda: run[-1].positions),
                        ("mean kinetic_J", lambda: run.measures["kinetic_energy"]),
                        ("mean kinetic_J", lambda: run.measures.kinetic)):
        if words not in told(call):
            wrong.append(f"'{words}' is expected, it says: {told(call)}")
    return wrong


def check_places():
    """A run that was opened by a relative path holds after os.chdir(); one that is gone says so."""
    wrong, here = [], os.getcwd()
    shutil.copytree("line", "moved", dirs_exist_ok=True)
    run, film = grainreel.open("moved"), grainreel.film("line")
    os.chdir("/")
    try:
        if len(run) != 5 or run.inspect(grain=1) is None or not film.path.is_file() or run.path != Path(here, "moved"):
            wrong.append(f"after os.chdir() a run is at {run.path}")
    finally:
        os.chdir(here)
    if run.path != Path("moved"):
        wrong.append(f"back again a run is at {run.path}")
    shutil.rmtree("moved")
    for read in (lambda: run.record, lambda: run.measures, lambda: run.contacts):
        if "is not there any more" not in told(read):
            wrong.append(f"of a run that was removed it says: {told(read)}")
    return wrong if "not there any more" in repr(run) else [*wrong, f"a run that was removed is {run!r}"]


def check_guesses():
    """What the program guesses about other programs' files is a warning at the user's line, and in the record."""
    Path("untimed.xyz").write_text('1\nProperties=species:S:1:pos:R:3:radius:R:1\nA 2 3 2 0.5\n')
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        run = grainreel.open("untimed.xyz")
    words = [str(each.message) for each in said]
    if not (any("says no density" in each for each in words) and words == run.record["warnings"]
            and {each.filename for each in said} == {__file__} and said[0].category is grainreel.GrainreelWarning):
        return [f"guesses are {words} at {[each.filename for each in said]}, recorded {run.record}"]
    if "mass" in run[-1].variables or "mass" not in grainreel.open("untimed.xyz", density=2500)[-1].variables:
        return ["a guessed density gives masses, or a given one none"]
    return []


def check_killed(scene="scene.toml"):
    """A program that is killed, and one that is stopped before it does anything."""
    wrong = []
    running = grainreel.start(scene, out="killed", run__duration="1000 s")
    next(now for now in running if now["stage"] == "vibrating")
    running._process.kill()
    if "was killed by signal 9 (SIGKILL)" not in told(running.result):
        wrong.append(f"of a killed program it says: {told(running.result)}")
    if "(was killed)" not in repr(grainreel.open("killed")):
        wrong.append(f"a run whose program was killed is {grainreel.open('killed')!r}")
    running = grainreel.start(scene, out="early", run__duration="1000 s")
    running.stop()
    if "stopped before it had made anything" not in told(running.result):
        wrong.append(f"of a run that was stopped at once it says: {told(running.result)}")
    return wrong


def check_ends(scene="scene.toml"):
    """result() twice, stop() afterwards, a run that is dropped, and one that is pickled."""
    wrong = []
    running = grainreel.start(scene, out="twice", run__duration="0.02 s")
    run = running.result()
    if running.result() is not run or list(running) or running.wait() != running.wait():
        wrong.append("a second result() is another")
    running.stop()
    running = grainreel.start(scene, out="refused", drive__frequencie=3)
    if told(running.result) != told(running.result) or "frequencie" not in told(running.result):
        wrong.append(f"a second result() of a mistake says: {told(running.result)}")
    running = grainreel.start(scene, out="dropped", run__duration="1000 s")
    if "cannot be pickled" not in told(lambda: pickle.dumps(running)):
        wrong.append(f"a run that goes on is pickled: {told(lambda: pickle.dumps(running))}")
    next(now for now in running if now["stage"] == "vibrating")
    del running
    gc.collect()
    while json.loads(Path("dropped/run.json").read_text())["status"] == "running":  # the watchdog ends a test that hangs
        time.sleep(0.02)
    status = json.loads(Path("dropped/run.json").read_text())["status"]
    if status != "interrupted":
        wrong.append(f"a dropped run is {status}")
    return wrong


def check_fork():
    """A forked process draws too, with a program of its own, and its parent goes on drawing."""
    before = grainreel.render("line", size="160x120")
    process = multiprocessing.get_context("fork").Process(target=_fork_draws, args=(before,))
    process.start()
    process.join()
    after = grainreel.render("line", size="160x120")
    return [] if process.exitcode == 0 and (before == after).all() else ["after a fork pictures differ"]


def check():
    """Needs the folder in which python_lines.check() has run."""
    with grainreel.open("line") as run:
        return (check_messages(run) + check_names(run) + check_damage() + check_cut(run) + check_places() +
                check_guesses() + check_ends() + check_killed() + check_fork())
