"""What all groups need: scenes, the program with its surroundings, and the comparison of two runs."""
import json
import shutil
import signal
import subprocess
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "support"))
from program import plain_environment  # noqa: E402
from runs import content, differing, shared_scene  # noqa: E402

LONGEST = 240  # s, after which a program that has not ended counts as hanging

# All that a checkpoint has to carry, for more grains than the tests in C++ take; and fifty grains in a closed box, which
# packs long enough to be caught at it.
BUSY = shared_scene("busy", ("count = 4\n", "count = 10\n"), ("count = 12\n", "count = 60\n"), ('"7 ms"', '"3 ms"'),
                    ("playback = 0.5", "playback = 0.2"))
PLAIN = shared_scene("fifty", ('duration = "0.2 s"\noverlap = 0.05\n', 'duration = "0.1 s"\noverlap = 0.05\nthreads = 1\n'))

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
        return plain_environment(self.folder, **more)

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


def difference(whole, run, names=FILES):
    """The first thing in which two runs differ, in words; empty if they are alike."""
    first, second = record_of(whole), record_of(run)
    if not first or not second:
        return "a run.json is missing"
    if second.get("status") != first.get("status"):
        return f"run.json says {second.get('status')}"
    if first["engine"]["state_hash"] != second["engine"]["state_hash"]:
        return "another end state"
    for name in differing(whole, run, names):
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
