#!/usr/bin/env python3
"""Are the files of a run the same, byte for byte, however it was made?

    tests/reliability/same_bits.py PROGRAM [OTHER PROGRAM ...] [--out FOLDER] [--scenes NAME ...]

Each scene runs once with PROGRAM on one thread. Then it runs on 2 and on 3 threads, once more with a stop on its way (the
run is made up to half of its time, then `resume` goes on), and once with each OTHER PROGRAM: another compiler's, an installed
one. final.csv, measures.csv, outflow.csv, contacts.nc and trajectory.nc are compared with the first run's. Prints a table.
Exit status: 0 all alike, 1 a file differs, 2 a mistake.
"""
import argparse
import subprocess
import sys
import tempfile
from pathlib import Path

FILES = ("final.csv", "measures.csv", "outflow.csv", "contacts.nc", "trajectory.nc")
# Name of a shipped scene, seconds of it, and settings that keep it small.
SCENES = {
    "wedge_segregation": (0.4, ["species.small.count=400", "species.big.count=100", "output.contacts=true"]),
    "rough_walls": (0.3, []),
    "hourglass": (0.5, []),
    "poured_heap": (0.4, []),
    "cone_hopper": (0.3, []),
    "drum_lifters": (0.2, []),
}


def call(program, *words):
    command = [str(program), *map(str, words), "--quiet"]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)}\n{done.stderr}")


def run(program, scene, out, threads=1, stop=False):
    seconds, settings = SCENES[scene]
    sets = [word for setting in settings for word in ("--set", setting)]
    end = 0.5 * seconds if stop else seconds
    call(program, "movie", scene, "--no-film", "--no-report", "--threads", threads, "--out", out, "--duration", f"{end:g} s",
         *sets)
    if stop:
        call(program, "resume", out, "--until", f"{seconds:g} s", "--threads", threads, "--no-film", "--no-report")
    return out


def differing(first, second):
    """Names of the files that one of two runs has not, or has otherwise."""
    def content(folder, name):
        return (folder / name).read_bytes() if (folder / name).exists() else None
    return [name for name in FILES if content(first, name) != content(second, name)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path)
    parser.add_argument("others", type=Path, nargs="*")
    parser.add_argument("--out", type=Path, help="keep the runs here [a temporary folder]")
    parser.add_argument("--scenes", nargs="+", choices=SCENES, default=list(SCENES))
    job = parser.parse_args()
    folder = job.out or Path(tempfile.mkdtemp(prefix="same_bits."))
    folder.mkdir(parents=True, exist_ok=True)
    variants = [("2 threads", job.program, {"threads": 2}), ("3 threads", job.program, {"threads": 3}),
                ("resumed", job.program, {"stop": True})]
    variants += [(str(other), other, {}) for other in job.others]
    print("| scene | " + " | ".join(name for name, _, _ in variants) + " |")
    print("|---|" + "---|" * len(variants))
    alike = True
    for scene in job.scenes:
        first = run(job.program, scene, folder / scene)
        cells = []
        for i, (_, program, how) in enumerate(variants):
            differ = differing(first, run(program, scene, folder / f"{scene}_{i}", **how))
            cells.append(", ".join(differ) + " differ" if differ else "alike")
            alike = alike and not differ
        print(f"| {scene} | " + " | ".join(cells) + " |", flush=True)
    sys.exit(0 if alike else 1)


if __name__ == "__main__":
    main()
