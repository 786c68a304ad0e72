#!/usr/bin/env python3
"""That mypy --strict passes on the Python module and on code that uses it, and finds wrong uses.

usage: python_types_test.py CACHE        CACHE: a folder in which mypy keeps what it has read

Exit status 77: mypy, xarray or numpy is missing.
"""
import importlib.util
import os
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
MODULE = ROOT / "render/package/python"
CONFIG = """[mypy]
strict = True
[mypy-pandas.*]
ignore_missing_imports = True
"""
# Right uses, and wrong ones, which end with # wrong.
USES = """import grainreel
import xarray

run: grainreel.Run = grainreel.run("scene.toml", drive__g_level=3, progress=True)
frames: int = len(run)
names: list[str] = run.species
times: xarray.DataArray = run.time
picture: grainreel.Picture = run.render(at=run.time[-1], colour=[1.0, 2.0], colour__map="vik")
film: grainreel.Film = grainreel.film(run, size=(320, 240), progress=lambda now: print(now["done"]))
print(run.inspect(where="species == big")["grains"], run.export("vtk").name, picture.png()[:4])
for frame in run:
    print(float(frame.z.max()))
grainreel.run(text=3)  # wrong
run.render(frame="first")  # wrong
run.inspect(were="species == big")  # wrong
run.export()  # wrong
size: int = run.species  # wrong
"""


def main(cache):
    lacking = [name for name in ("mypy", "numpy", "xarray") if not importlib.util.find_spec(name)]
    if lacking:
        print(f"python_types_test: skipped, missing are {', '.join(lacking)}; on Debian: apt-get install mypy python3-xarray")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "config").write_text(CONFIG)
        Path(folder, "uses.py").write_text(USES)
        done = subprocess.run([sys.executable, "-m", "mypy", "--config-file", "config", "--cache-dir", cache,
                               str(MODULE / "grainreel"), "uses.py"], cwd=folder,
                              env={**os.environ, "MYPYPATH": str(MODULE)}, capture_output=True, text=True, check=False)
    wrong = {number for number, line in enumerate(USES.splitlines(), 1) if line.endswith("# wrong")}
    errors = [line for line in done.stdout.splitlines() if ": error: " in line]
    unexpected = [line for line in errors if not (line.startswith("uses.py:") and int(line.split(":")[1]) in wrong)]
    missed = wrong - {int(line.split(":")[1]) for line in errors if line.startswith("uses.py:")}
    if unexpected or missed or done.stderr:
        print("\n".join(unexpected) + done.stderr)
        sys.exit(f"python_types_test: {len(unexpected)} errors that should not be; not found: lines {sorted(missed)}")


main(os.path.abspath(sys.argv[1]))
