"""The command lines of a page of the guide, for tests that run them as they stand.

A block that begins with ```sh has commands. Words behind sh name what a block needs: python3:MODULE, or a program.
"""
import os
import shlex
import shutil
import subprocess
import sys

WINDOWS = {"paraview", "blender", "ovito", "yade"}
PYTHON = "/usr/bin/python3"


def check(holds, words):
    if not holds:
        sys.exit(words)


def run(command, folder, script=False):
    done = subprocess.run(["bash", "-e", "-o", "pipefail", "-c", command] if script else [str(c) for c in command],
                          cwd=folder, capture_output=True, text=True, env=environment(folder), check=False)
    return done


def environment(folder):
    of_sanitizers = {name: value for name, value in os.environ.items() if name.endswith("SAN_OPTIONS")}
    return {**of_sanitizers, "PATH": f"{folder}/bin:/usr/bin:/bin", "HOME": str(folder), "XDG_CACHE_HOME": str(folder / "cache"),
            "LC_ALL": "C.UTF-8"}


def blocks(page):
    """Of each ```sh block its first line's number, what it needs, and its commands."""
    needs, lines, found = None, [], []
    for number, line in enumerate(page.read_text().splitlines(), 1):
        if needs is None and line.startswith("```"):
            words = line[3:].split()
            needs, lines, first = words, [], number + 1
        elif needs is not None and line == "```":
            check(needs[:1] == ["sh"] or not any(x.startswith("./movie") for x in lines),
                  f"{page}:{first}: commands stand in a block that begins with ```sh")
            if needs[:1] == ["sh"]:
                found.append((first, needs[1:], commands(page, lines)))
            needs = None
        elif needs is not None:
            lines.append(line)
    return found


def commands(page, lines):
    """Lines, those that go on joined."""
    all_, now = [], ""
    for line in lines:
        now += ("\n" if now else "") + line
        if line.endswith("\\"):
            continue
        try:
            shlex.split(now, comments=True)
        except ValueError:
            continue  # a quote is open
        all_.append(now)
        now = ""
    check(not now, f"{page}: ends within a quote: {now}")
    return all_


def missing(need):
    if need in WINDOWS:
        return f"{need} opens a window" if shutil.which(need) else f"{need} is not installed"
    if need.startswith("python3:"):
        there = subprocess.run([PYTHON, "-c", f"import {need[8:]}"], capture_output=True, check=False).returncode == 0
        return None if there else f"Python has no {need[8:]}"
    return None if shutil.which(need, path="/usr/bin:/bin") else f"{need} is not installed"
