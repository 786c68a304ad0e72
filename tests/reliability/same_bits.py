#!/usr/bin/env python3
"""Are the files of a run the same, byte for byte, however it was made?

    tests/reliability/same_bits.py PROGRAM [OTHER PROGRAM ...] [--out FOLDER] [--scenes NAME ...] [--quick] [--instructions]

Each scene runs once with PROGRAM on one thread. Then it runs on 2 and on 3 threads, once more with a stop on its way (Ctrl-C
after 85 % of the time that the first run took, then `resume` goes on), once while the C library believes that the processor
has neither FMA nor AVX2 (it then takes other sines and powers; other C libraries differ likewise), and once with each OTHER
PROGRAM: another compiler's, an installed one. With --instructions it also runs as on processors that have AVX2, SSE4, or nothing beyond plain x86-64
(instructions.cpp, which is loaded before the program, tells Highway so, and the C library leaves out its own code for AVX and
FMA); that needs a compiler and Highway's headers. --quick, for .ci/run,
takes three scenes with few grains, which have what differs: contacts in a file, glued grains, and a mesh with an outflow. final.csv, measures.csv, outflow.csv, contacts.nc and trajectory.nc are
compared with the first run's; the last two only for PROGRAM itself, because they name the build. Prints a table.
Exit status: 0 all alike, 1 a file differs, 2 a mistake. Processors without FMA may differ from those with it, but not from
each other.
"""
import argparse
import os
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from program import call  # noqa: E402
from runs import differing  # noqa: E402

TABLES = ("final.csv", "measures.csv", "outflow.csv")
FILES = (*TABLES, "contacts.nc", "trajectory.nc")
# Name of a shipped scene, seconds of it, and settings that keep it small.
SCENES = {
    "wedge_segregation": (0.4, ["species.small.count=400", "species.big.count=100", "output.contacts=true"]),
    "rough_walls": (0.3, []),
    "hourglass": (0.5, []),
    "poured_heap": (0.8, []),
    "cone_hopper": (0.3, []),
    "drum_lifters": (0.2, []),
}
HURRY = ["run.accuracy=draft", "start.settle_limit=0.1 s"]
QUICK = {
    "wedge_segregation": (0.8, ["species.small.count=120", "species.big.count=30", "output.contacts=true", *HURRY]),
    "rough_walls": (0.5, ["species.grains.count=350", "container.width=20 mm", *HURRY]),
    "cone_hopper": (0.3, ["species.grains.count=800", *HURRY]),
}


# What a processor has: what --version says of it, Highway's targets, and what the C library must do without.
OLDER = "AVX512F,-AVX512VL,-AVX512DQ,-AVX512BW,-AVX512CD"
INSTRUCTIONS = {
    "AVX2": ("AVX2", OLDER),
    "SSE4": ("SSE4", OLDER + ",-AVX2,-AVX,-FMA,-FMA4"),
    "plain x86-64": ("plain", OLDER + ",-AVX2,-AVX,-FMA,-FMA4,-SSE4_2,-SSE4_1,-SSSE3"),
}


# The C library without its code for FMA and AVX2. Names that it does not know it passes over.
OTHER_LIBRARY = {"GLIBC_TUNABLES": "glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2,-AVX2_Usable,-FMA_Usable,-AVX512F"}


def processor(name, folder):
    """The environment in which the program believes that it runs on such a processor."""
    shim = folder / "instructions.so"
    if not shim.exists():
        source = Path(__file__).with_name("instructions.cpp")
        subprocess.run(["g++", "-shared", "-fPIC", "-O1", source, "-o", shim], check=True)
    targets, missing = INSTRUCTIONS[name]
    return {**os.environ, "LD_PRELOAD": str(shim), "GRAINREEL_TEST_TARGETS": targets,
            "GLIBC_TUNABLES": "glibc.cpu.hwcaps=-" + missing}


def instructions_of(program, env):
    """The vector instructions that the program uses, in its own words."""
    said = subprocess.run([program, "--version"], capture_output=True, text=True, env=env).stdout
    return next((line.split(None, 1)[1] for line in said.splitlines() if line.startswith("vectors")), "?")


def run(program, scene, how_much, out, threads=1, stop_after=None, env=None):
    """Runs a scene into a folder; stop_after: seconds until Ctrl-C, after which it is resumed."""
    seconds, settings = how_much
    bare = ["--quiet", "--no-report", "--threads", str(threads)]
    command = [str(program), "movie", scene, "--no-film", "--out", str(out), "--force", "--duration", f"{seconds:g} s", *bare]
    command += [word for setting in settings for word in ("--set", setting)]
    if stop_after is None:
        call(*command, env=env)
        return out
    for _ in range(5):
        if stopped(command, out, stop_after):
            call(program, "resume", out, *bare)
            return out
    sys.exit(f"{scene} always ended before it could be stopped")


def stopped(command, out, stop_after):
    """Starts a run and stops it. Returns whether it was still going on."""
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    time.sleep(stop_after)
    while process.poll() is None and not is_past_packing(out):  # a machine with other work may be slower this time
        time.sleep(0.02)
    process.send_signal(signal.SIGINT)
    return process.wait() != 0


def is_past_packing(folder):
    """Whether a run has a row of measures, and so can be stopped and resumed."""
    measures = folder / "measures.csv"
    return measures.exists() and measures.read_bytes().count(b"\n") > 1


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path)
    parser.add_argument("others", type=Path, nargs="*")
    parser.add_argument("--out", type=Path, help="keep the runs here [a temporary folder]")
    parser.add_argument("--scenes", nargs="+", choices=SCENES)
    parser.add_argument("--quick", action="store_true", help="three scenes with few grains")
    parser.add_argument("--instructions", action="store_true", help="also as on processors with less")
    job = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="same_bits.") as temporary:
        folder = job.out or Path(temporary)
        folder.mkdir(parents=True, exist_ok=True)
        sys.exit(0 if all_alike(job, folder) else 1)


def all_alike(job, folder):
    """Makes the runs in a folder and prints the table."""
    variants = [("2 threads", job.program, {"threads": 2}), ("3 threads", job.program, {"threads": 3}),
                ("resumed", job.program, {"stop_after": 0}),
                ("C library without FMA", job.program, {"env": {**os.environ, **OTHER_LIBRARY}})]
    variants += [(str(other), other, {}) for other in job.others]
    if job.instructions:
        for name in INSTRUCTIONS:
            env = processor(name, folder.resolve())
            variants.append((f"{name} ({instructions_of(job.program, env)})", job.program, {"env": env}))
    print("| scene | " + " | ".join(name for name, _, _ in variants) + " |")
    print("|---|" + "---|" * len(variants))
    alike = True
    scenes = QUICK if job.quick else SCENES
    for scene in [name for name in scenes if name in (job.scenes or scenes)]:
        begun = time.monotonic()
        first = run(job.program, scene, scenes[scene], folder / scene)
        # Packing is over by then. A quick run is stopped as soon as it can be.
        late = 0.0 if job.quick else 0.85 * (time.monotonic() - begun)
        cells = []
        before = None  # the run of the column before
        for i, (name, program, how) in enumerate(variants):
            how = {"stop_after": late} if "stop_after" in how else how
            made = run(program, scene, scenes[scene], folder / f"{scene}_{i}", **how)
            names = FILES if program == job.program else TABLES
            differ = differing(first, made, names)
            as_before = differ and "env" in how and before is not None and not differing(before, made, names)
            cells.append(f"as {variants[i - 1][0]}" if as_before else
                         ", ".join(differ) + " differ" if differ else "alike")
            # Without FMA the last bits of a product and a sum are others; between such processors they are the same.
            alike = alike and (not differ or as_before or name.startswith("SSE4"))
            before = made
        print(f"| {scene} | " + " | ".join(cells) + " |", flush=True)
    return alike


if __name__ == "__main__":
    main()
