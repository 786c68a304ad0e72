#!/usr/bin/env python3
"""Makes a wheel of an archive's folder, installs it with pip into an environment of its own, and uses it there.

usage: wheel_test.py TREE MAKE_WHEEL...
    TREE          a folder that render/package/archive/make_tree.py has made
    MAKE_WHEEL    the command that makes a wheel, but for its last two words, TREE and the folder for the wheel

Exit status 77: there is no tree, or numpy, xarray, netCDF4, venv or pip is missing.
"""
import base64
import csv
import hashlib
import importlib.util
import io
import re
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

USE = """
import grainreel, sys
run = grainreel.run(sys.argv[1], out="run", film=True, film__size="320x240", run__duration="0.2 s",
                    species__small__count=60, species__big__count=6)
picture = grainreel.render(run, at=0.1, size=(320, 240))
print(run.record["status"], round(float(run.measures.time[-1]), 6), picture.shape, picture.std() > 1, grainreel.__file__)
"""


def check(holds, words):
    if not holds:
        sys.exit(f"FAILED: {words}")


def check_files(wheel):
    """RECORD has the hash and the size of each file, and the programs may be run."""
    with zipfile.ZipFile(wheel) as files:
        names = files.namelist()
        record = next(name for name in names if name.endswith(".dist-info/RECORD"))
        rows = {row[0]: row[1:] for row in csv.reader(io.StringIO(files.read(record).decode()))}
        check(sorted(rows) == sorted(names), f"RECORD and the wheel differ: {set(rows) ^ set(names)}")
        for name in names:
            if name == record:
                continue
            data = files.read(name)
            digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
            check(rows[name] == [f"sha256={digest}", str(len(data))], f"{name}: RECORD has {rows[name]}")
        for name in ("grainreel_program/bin/grainreel", "grainreel_program/lib/grainreel/grainreel"):
            check(files.getinfo(name).external_attr >> 16 & 0o111 == 0o111, f"{name} may not be run")
        about = files.read(record.replace("RECORD", "METADATA")).decode()
        needs = re.findall(r"^Requires-Dist: (.*)$", about, re.M)
        check(needs == ["numpy", "xarray>=2023.1", "netCDF4"], f"it needs {needs}")


def main():
    tree, make = Path(sys.argv[1]), sys.argv[2:]
    lacking = [name for name in ("numpy", "xarray", "netCDF4", "venv", "pip") if not importlib.util.find_spec(name)]
    if lacking or not tree.is_dir():
        print(f"skipped: missing are {', '.join(lacking)}" if lacking else "there is no tree, see the test ArchiveTree")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name).resolve()

        def run(*words):
            done = subprocess.run([str(word) for word in words], cwd=folder, capture_output=True, text=True,
                                  env={"PATH": "/usr/bin:/bin", "HOME": str(folder), "GRAINREEL_PACKINGS": "off"})
            check(done.returncode == 0, f"{words[0]} ended with {done.returncode}:\n{done.stdout}{done.stderr}")
            return done.stdout

        run(*make, tree, folder)
        wheel = next(folder.glob("*.whl"))
        check(re.fullmatch(r"grainreel-[\d.]+-py3-none-manylinux_2_\d+_\w+\.whl", wheel.name), f"it is called {wheel.name}")
        check_files(wheel)
        # The system's pip installs into it: one of its own takes longer to make than all else here.
        run(sys.executable, "-m", "venv", "--system-site-packages", "--without-pip", folder / "venv")
        pip = (folder / "venv/bin/python", "-m", "pip")
        run(*pip, "install", "--no-index", "--no-deps", wheel)
        said = run(folder / "venv/bin/grainreel", "--version")
        place = re.search(r"unpacked in (.*)$", said, re.M)
        check(place and Path(place.group(1)).is_relative_to(folder / "venv"), f"--version says: {said}")
        said = run(folder / "venv/bin/python", "-c", USE, "wedge_segregation")
        check(re.fullmatch(rf"complete 0\.2 \(240, 320, 3\) True {re.escape(str(folder))}/venv/.*/grainreel/__init__\.py\n", said),
              f"the module says: {said}")
        run(*pip, "uninstall", "--yes", "grainreel")
        check(not list((folder / "venv").rglob("*grainreel*")), "pip leaves files behind")
    print("ok")


if __name__ == "__main__":
    main()
