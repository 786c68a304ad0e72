#!/usr/bin/env python3
"""What can go wrong around a run: does the program end in good order, lose nothing and invent nothing?

    python3 tests/reliability/faults PROGRAM [GROUP ...] [--long] [--turn N] [--keep FOLDER]
    python3 tests/reliability/faults --list

Each group makes small runs of its own, disturbs them, and compares what they leave and what `resume` makes of it with an
undisturbed run, byte for byte. --long takes more moments of each kind: the figures of docs/reliability.md. Needs root, or a
machine where users have user namespaces, because small disks are mounted (only these programs see them).
Exit status: 0 no problem, 1 problems, 2 a mistake.
"""
import argparse
import os
import sys
import tempfile
import time
from pathlib import Path

sys.dont_write_bytecode = True  # the source folder stays as it is

import disks
import markup
import places
import signals
import surroundings
import visitors
from tools import Bench

# Groups of one turn take about a third of the time of all: markup opens a browser many times.
TURNS = 3
GROUPS = {**disks.GROUPS, **places.GROUPS, **signals.GROUPS, **surroundings.GROUPS, **visitors.GROUPS, **markup.GROUPS}


def with_mounts_of_our_own():
    """Starts this program again where it may mount."""
    if os.environ.get("GRAINREEL_FAULTS_MOUNTS"):
        return
    os.environ["GRAINREEL_FAULTS_MOUNTS"] = "yes"
    namespace = ["unshare", "-m"] if os.geteuid() == 0 else ["unshare", "-r", "-m"]
    os.execvp(namespace[0], [*namespace, sys.executable, *sys.argv])


def run_group(name, job, folder):
    folder.mkdir()
    folder.chmod(0o755)
    bench = Bench(job.program.resolve(), folder, job.long)
    begun = time.monotonic()
    try:
        GROUPS[name](bench)
    except Exception as problem:  # the next groups still say something
        bench.problem(f"the test itself failed: {type(problem).__name__}: {problem}")
    counts = ", ".join(f"{number} {what}" for what, number in sorted(bench.counts.items()))
    print(f"{name}: {counts}; {len(bench.problems)} problems ({time.monotonic() - begun:.0f} s)", flush=True)
    return len(bench.problems)


def groups_of_turn(number):
    """Half of the groups without markup, or markup alone."""
    others = [name for name in GROUPS if name not in markup.GROUPS]
    return list(markup.GROUPS) if number % TURNS == 2 else others[number % TURNS :: TURNS - 1]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path, nargs="?")
    parser.add_argument("groups", nargs="*", metavar="GROUP", help=", ".join(GROUPS))
    parser.add_argument("--long", action="store_true", help="more moments of each kind")
    parser.add_argument("--turn", type=int, metavar="N", help="a third of the groups, the next one for the next number")
    parser.add_argument("--keep", type=Path, help="a new folder, in which all runs stay")
    parser.add_argument("--list", action="store_true", help="only print the names of the groups")
    job = parser.parse_args()
    if job.list:
        print("\n".join(GROUPS))
        return 0
    if job.program is None:
        parser.error("name the program: build/release/grainreel")
    for name in job.groups:
        if name not in GROUPS:
            parser.error(f"{name}: is no group; there are {', '.join(GROUPS)}")
    names = job.groups or (GROUPS if job.turn is None else groups_of_turn(job.turn))
    with_mounts_of_our_own()
    with tempfile.TemporaryDirectory(prefix="faults.", ignore_cleanup_errors=True) as temporary:
        folder = job.keep or Path(temporary)
        folder.mkdir(parents=True, exist_ok=bool(not job.keep))
        folder.chmod(0o755)
        problems = sum(run_group(name, job, folder / name.replace(" ", "_")) for name in names)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
