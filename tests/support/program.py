"""Starting a program from a test."""
import os
import subprocess
import sys


def plain_environment(folder, **more):
    """Without the tester's own settings. A value of None takes the variable away."""
    plain = {"PATH": os.environ["PATH"], "HOME": str(folder), "XDG_CACHE_HOME": str(folder / "cache"),
             "GRAINREEL_PACKINGS": "off", "LC_ALL": "C.UTF-8", "TMPDIR": "/tmp", **more}
    return {name: value for name, value in plain.items() if value is not None}


def call(*command, env=None, cwd=None):
    """Runs a program and returns what it printed. Ends with one line, and what it said, where it is missing or fails."""
    words = [str(word) for word in command]
    try:
        done = subprocess.run(words, capture_output=True, text=True, env=env, cwd=cwd, check=False)
    except OSError as problem:
        sys.exit(f"{words[0]}: {problem.strerror}; give the path of a program that runs")
    if done.returncode != 0:
        sys.exit(f"`{' '.join(words)}` ended with {done.returncode}\n{done.stderr}")
    return done.stdout
