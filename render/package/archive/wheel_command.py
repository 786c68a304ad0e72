"""The program of this wheel: the command `grainreel` starts it."""
import os
import sys
from pathlib import Path

PROGRAM = Path(__file__).resolve().parent / "bin" / "grainreel"


def main():
    try:
        os.execv(PROGRAM, ["grainreel", *sys.argv[1:]])
    except OSError as error:
        sys.exit(f"error: {PROGRAM}: cannot be started: {error.strerror}; install the wheel again")
