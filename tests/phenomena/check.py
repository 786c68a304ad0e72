#!/usr/bin/env python3
"""Is an effect there, and gone when its cause is switched off?

    tests/phenomena/check.py PROGRAM [NAME ...] [--jobs N] [--out FOLDER] [--list]

Runs the quick form of each check in checks.py, or of those named, N at a time on one thread each. A check is one
number of a run, and a range in which the number must lie. The control is the same run with the cause of the effect
switched off, and its number must lie outside of that range. So a check that cannot fail does not pass. Exit status: 0
all hold, 1 one does not, 2 a mistake.
"""
import argparse
import os
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))

from checks import CHECKS  # noqa: E402
from runs import Measures  # noqa: E402

SCENES = Path(__file__).resolve().parents[2] / "scenes"


def processor_seconds(command):
    """Runs a command; the time that processors gave it, whatever else ran beside it."""
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        raise subprocess.CalledProcessError(process.returncode, command)
    return usage.ru_utime + usage.ru_stime


class Run(Measures):
    """A scene that was run here, and what it cost."""

    def __init__(self, program, scene, settings, folder):
        command = [program, "movie", str(SCENES / f"{scene}.toml"), "--no-film", "--quiet", "--threads", "1",
                   "--out", str(folder), "--set", "output.trajectory=false"]
        for setting in settings:
            command += ["--set", setting]
        self.seconds = processor_seconds(command)
        super().__init__(folder)


def measured(check, program, folder, control):
    """The check's number, or that of its control."""
    runs = []
    for i, settings in enumerate(check.runs):
        settings = list(settings) + (list(check.control) if control else [])
        runs.append(Run(program, check.scene, settings, folder / f"{check.name}-{'control' if control else 'run'}-{i}"))
    return check.number(*runs), sum(run.seconds for run in runs)


def holds(check, program, folder):
    """Whether the check holds, and the processor time of its runs."""
    try:
        number, seconds = measured(check, program, folder, control=False)
        off, more_seconds = measured(check, program, folder, control=True)
    except subprocess.CalledProcessError as error:
        print(f"{check.name}: NOT SO, a run ended with exit status {error.returncode}: {' '.join(error.cmd)}", flush=True)
        return False, 0.0
    there, gone = check.accepts(number), not check.accepts(off)
    print(f"{check.name}: {check.claim}\n"
          f"  {check.what}: {number:.4g}, expected {check.expected()}: {'ok' if there else 'NOT SO'}\n"
          f"  with {', '.join(check.control)}: {off:.4g}, expected outside of that: {'ok' if gone else 'NOT SO'}\n"
          f"  {seconds + more_seconds:.0f} s of one processor",
          flush=True)
    return there and gone, seconds + more_seconds


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("program")
    parser.add_argument("names", nargs="*")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="checks at a time")
    parser.add_argument("--out", type=Path, help="keep the runs there")
    parser.add_argument("--list", action="store_true", help="print the names and end")
    options = parser.parse_intermixed_args()
    unknown = set(options.names) - {check.name for check in CHECKS}
    if unknown:
        print(f"no such check: {', '.join(sorted(unknown))}; --list prints their names", file=sys.stderr)
        return 2
    chosen = [check for check in CHECKS if check.name in options.names or not options.names]
    if options.list:
        print("\n".join(check.name for check in chosen))
        return 0
    with tempfile.TemporaryDirectory(prefix="phenomena-") as temporary:
        folder = options.out or Path(temporary)
        with ThreadPoolExecutor(max(1, options.jobs)) as pool:
            results = list(pool.map(lambda check: holds(check, options.program, folder), chosen))
    held = [there for there, _ in results]
    print(f"{sum(held)} of {len(held)} hold; {sum(seconds for _, seconds in results):.0f} s of one processor")
    return 0 if all(held) else 1


if __name__ == "__main__":
    sys.exit(main())
