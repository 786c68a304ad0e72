"""What all groups need: scenes, the program with its surroundings, and the comparison of two runs."""
import json
import os
import shutil
import signal
import subprocess
import time
from dataclasses import dataclass, field
from pathlib import Path

LONGEST = 240  # s, after which a program that has not ended counts as hanging

# Grains that come and leave, two drives, fields, contacts, a film: all that a checkpoint has to carry.
BUSY = """title = "Busy"
[[species]]
name = "big"
count = 10
diameter = "6 mm"
density = "2.5 g/cm3"
[[species]]
name = "small"
count = 60
diameter = { min = "3 mm", max = "4 mm" }
density = "2.5 g/cm3"
[contact]
restitution = 0.6
friction = 0.4
[container]
shape = "box"
width = "30 mm"
depth = "15 mm"
height = "60 mm"
periodic_depth = false
outlet = { width = "14 mm", opens = "0.03 s", exit_depth = "10 mm" }
[[feed]]
species = "small"
rate = 300
[drive]
frequency = "40 Hz"
g_level = 2
ramp = 0
[[drive.stage]]
from = "0.025 s"
frequency = "60 Hz"
over = 3
[start]
settle_limit = "0.01 s"
[run]
duration = "0.1 s"
overlap = 0.05
accuracy = "draft"
threads = 1
[output]
contacts = true
orientation = true
instruments = ["walls", "outflow"]
trajectory_interval = "3 ms"
measures_interval = "3 ms"
[output.fields]
grid = "yz"
periods = 1
samples = 4
width = "4 mm"
cell = "8 mm"
[film]
size = "160x90"
rate = 25
preset = "ultrafast"
[[film.segment]]
playback = 0.2
"""

# Fifty grains in a closed box; it packs long enough to be caught at it.
PLAIN = """title = "Fifty grains"
[[species]]
name = "small"
count = 40
diameter = "4 mm"
density = "2.5 g/cm3"
[[species]]
name = "big"
count = 10
diameter = "6 mm"
density = "2.5 g/cm3"
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
duration = "0.1 s"
overlap = 0.05
threads = 1
[film]
size = "160x120"
rate = 30
[[film.segment]]
playback = 0.5
"""

FILES = ("final.csv", "measures.csv", "outflow.csv", "trajectory.nc", "contacts.nc", "fields.nc", "film_moments.nc",
         "key_moments.nc", "key_contacts.nc", "scene.toml", "movie.mp4", "poster.png")


@dataclass
class Ended:
    status: int  # as a shell says it: 128 + signal
    out: bytes
    err: bytes
    seconds: float

    @property
    def errors(self):
        """The lines that begin with "error: "."""
        return [line for line in self.err.decode(errors="replace").splitlines() if line.startswith("error: ")]

    def said(self):
        text = self.errors[-1] if self.errors else self.err.decode(errors="replace")[-200:].strip()
        return text[:300]


def shell_status(code):
    return 128 - code if code < 0 else code


@dataclass
class Bench:
    """A program, a folder to work in, and the problems found so far."""
    program: Path
    folder: Path
    long: bool = False
    problems: list = field(default_factory=list)
    counts: dict = field(default_factory=dict)

    def environment(self, **more):
        """Without the tester's own settings. A value of None takes the variable away."""
        plain = {"PATH": os.environ["PATH"], "HOME": str(self.folder), "XDG_CACHE_HOME": str(self.folder / "cache"),
                 "GRAINREEL_PACKINGS": "off", "LC_ALL": "C.UTF-8", "TMPDIR": "/tmp", **more}
        return {name: value for name, value in plain.items() if value is not None}

    def start(self, *words, cwd=None, env=None, **how):
        how.setdefault("stdout", subprocess.PIPE)
        how.setdefault("stderr", subprocess.PIPE)
        return subprocess.Popen([self.program, *words], cwd=cwd or self.folder, env=env or self.environment(),
                                stdin=subprocess.DEVNULL, **how)

    def end(self, process):
        begun = time.monotonic()
        try:
            out, err = process.communicate(timeout=LONGEST)
        except subprocess.TimeoutExpired:
            process.kill()
            out, err = process.communicate()
            self.problem("hangs: " + " ".join(map(str, process.args))[:300])
        return Ended(shell_status(process.returncode), out or b"", err or b"", time.monotonic() - begun)

    def run(self, *words, **how):
        return self.end(self.start(*words, **how))

    def must(self, *words, **how):
        ended = self.run(*words, **how)
        if ended.status != 0:
            raise RuntimeError(f"{' '.join(map(str, words))}: {ended.status}: {ended.said()}")
        return ended

    def problem(self, text):
        self.problems.append(text)
        print("    problem: " + text, flush=True)

    def check(self, holds, text):
        if not holds:
            self.problem(text)
        return holds

    def count(self, what):
        self.counts[what] = self.counts.get(what, 0) + 1

    def fresh(self, name):
        """An empty folder with that name."""
        path = self.folder / name
        shutil.rmtree(path, ignore_errors=True)
        path.mkdir(parents=True)
        return path

    def crashed(self, ended, what):
        """Notes an end that no run may have: by a signal of its own, or as the program never ends."""
        bad = ended.status > 2 and ended.status not in (128 + s for s in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP))
        if bad:
            self.problem(f"{what}: exit status {ended.status}: {ended.said()}")
        return bad


def scene_in(folder, text=BUSY, name="scene.toml"):
    path = Path(folder) / name
    path.write_text(text)
    return path


def record_of(run):
    try:
        return json.loads((Path(run) / "run.json").read_text())
    except (OSError, ValueError):
        return {}


def content(path):
    try:
        return path.read_bytes()
    except OSError:
        return None


def difference(whole, run, names=FILES):
    """The first thing in which two runs differ, in words; empty if they are alike."""
    first, second = record_of(whole), record_of(run)
    if not first or not second:
        return "a run.json is missing"
    if second.get("status") != first.get("status"):
        return f"run.json says {second.get('status')}"
    if first["engine"]["state_hash"] != second["engine"]["state_hash"]:
        return "another end state"
    for name in names:
        if content(Path(whole) / name) != content(Path(run) / name):
            return name + (" differs" if (Path(run) / name).exists() else " is missing")
    frames = Path(whole) / "frames"
    for picture in sorted(frames.iterdir()) if frames.is_dir() else []:
        if content(picture) != content(Path(run) / "frames" / picture.name):
            return f"picture {picture.name} differs"
    return ""


def wait_for(process, condition, longest=LONGEST):
    """Until the condition holds or the process has ended. Returns whether it holds."""
    end = time.monotonic() + longest
    while not condition():
        if process.poll() is not None or time.monotonic() > end:
            return condition()
        time.sleep(0.002)
    return True


def compiled(source, target, *options):
    """A shim as a library; None where there is no compiler."""
    compiler = shutil.which("g++") if source.suffix == ".cpp" else shutil.which("gcc") or shutil.which("cc")
    if compiler is None:
        return None
    subprocess.run([compiler, "-shared", "-fPIC", "-O1", source, "-o", target, *options], check=True)
    return target


class SmallDisk:
    """A disk over a folder, which this process and its children see. Made in a mount namespace of our own."""

    def __init__(self, folder, options):
        self.folder = Path(folder)
        self.folder.mkdir(parents=True, exist_ok=True)
        subprocess.run(["mount", "-t", "tmpfs", "-o", options, "faults", self.folder], check=True)

    def change(self, options):
        subprocess.run(["mount", "-o", "remount," + options, self.folder], check=True)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        subprocess.run(["umount", "-l", self.folder], check=False)
