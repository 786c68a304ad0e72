#!/usr/bin/env python3
"""Runs the command lines of docs/guide/other-programs.md on small files of ours, and compares its table of formats.

usage: guide_test.py GRAINREEL [--table | --pictures FOLDER | --list]

Each command of a block that begins with ```sh is run in a folder that has small files under the page's names. It must
end with 0, and what it names as made must be there. Words behind sh name what a block needs: python3:MODULE, or a
program. Blocks whose program is missing, or opens a window, are listed and not run. To be quick, films are made small;
nothing else is changed.

--table prints the table as it must be. --pictures draws the page's pictures. --list tells what would be run.
"""
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import guide_files  # noqa: E402
from guide_blocks import PYTHON, blocks, check, missing, run  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs/guide/other-programs.md"
SMALL = {"render": "--size 160x90", "compare": "--size 640x360"}

# Which writer's files a reader takes: of its formats the ones that are the same.
SAME = {"lammps-dump": "lammps-dump", "lammps-data": "lammps-data", "vtk-xml": "vtk", "gsd": "gsd", "amber": "netcdf", "surface": "stl", "xyz": "xyz",
        "table": "csv"}
OF_OURS = {"grain-table"}  # read as a table of a run of ours


# ---- the table of formats


def readers():
    """Name and words of each format that is read, in the program's own order."""
    folder = ROOT / "engine/files/foreign"
    order = re.findall(r"one\((\w+)\)", (folder / "raw_file.cpp").read_text().split("namespace")[0])
    found = {}
    for file in folder.rglob("*.cpp"):
        for key, name, about in re.findall(r'RawFormat (\w+)_format\(\) \{\s*return \{"([^"]+)",\s*"([^"]+)"', file.read_text()):
            found[key] = (name, about)
    check(order and set(order) == set(found), f"the list of formats {order} is not that of the files, {sorted(found)}")
    return [found[key] for key in order]


def writers(program):
    text = subprocess.run([program, "export", "--help"], capture_output=True, text=True, check=True).stdout
    return re.findall(r"^  ([a-z-]+)  +(.+)$", text.split("\nFormats:\n")[1].split("\nExit status")[0], re.MULTILINE)


def table(program):
    ours = dict(writers(program))
    rows = ["| files | read | written by `export --to` |", "|---|---|---|"]
    for name, about in readers():
        rows.append(f"| {about} | yes | `{SAME[name]}` |" if name in SAME else f"| {about} | yes | |")
    for name, about in ours.items():
        if name not in SAME.values():
            rows.append(f"| {about} | {'yes ' if name in OF_OURS else ''}| `{name}` |")
    return "\n".join(rows) + "\n"


def check_table(program, folder):
    check(table(program) in PAGE.read_text(), f"{PAGE}: its table of formats is not the program's; it must be\n{table(program)}")
    read = set(SAME.values()) | OF_OURS
    for name, _ in writers(program):
        made = run([program, "export", "output/wedge_segregation", "--to", name, "--out", f"table-{name}"], folder)
        check(made.returncode == 0, f"export --to {name}: {made.stderr}")
        if name in ("gltf", "blender", "vtkhdf"):
            back = run([program, "inspect", f"table-{name}"], folder)
            check(back.returncode == 2, f"{name} is read, but the table says that it is not")
        elif name in read:
            at = f"table-{name}/grains.pvd" if name == "vtk" else f"table-{name}"
            back = run([program, "inspect", at], folder)
            check(back.returncode == 0, f"{name} is not read, but the table says that it is: {back.stderr}")


# ---- the commands


def check_commands(folder):
    count = 0
    for first, needs, lines in blocks(PAGE):
        why = next(filter(None, map(missing, needs)), None)
        for line in lines:
            if why:
                print(f"not run, {why}: {line}")
                continue
            done = run(line, folder, script=True)
            check(done.returncode == 0, f"{PAGE}:{first}: {line}\nended with {done.returncode}\n{done.stdout}{done.stderr}")
            count += 1
            words = shlex.split(line, comments=True)
            if words[:1] == ["./movie"] and words[1] != "inspect":
                made = folder / done.stdout.splitlines()[-1]
                check(made.exists(), f"{PAGE}:{first}: {line}\nsays that it made {made}, which is not there")
                remove(made)
            elif words[0] in ("./movie", "python3") and "write" not in line:
                check(done.stdout.strip(), f"{PAGE}:{first}: {line}\nprints nothing")
    print(f"ran {count} commands")


def remove(made):
    """Films and pages, so that the next command may take the name; exports stay for the commands behind them."""
    if made.suffix in (".png", ".html"):
        made.unlink()
    elif (made / "movie.mp4").exists() and made.name != "wedge_segregation":
        shutil.rmtree(made)


# ---- the files


def make_files(program, folder, scene):
    (folder / "bin").mkdir()
    (folder / "bin/python3").symlink_to(PYTHON)
    movie = folder / "movie"
    sizes = "".join(f"{verb}) small=({words});; " for verb, words in SMALL.items())
    movie.write_text(f'#!/bin/bash\nsmall=()\ncase $1 in {sizes}esac\nexec "{program}" "$@" "${{small[@]}}"\n')
    movie.chmod(0o755)
    (folder / "wedge.toml").write_text(guide_files.SCENE.format(**scene))
    ours = "output/wedge_segregation"

    def made(*words):
        done = run([program, *words, "--quiet"], folder)
        check(done.returncode == 0, f"{words}: {done.stderr}")

    made("movie", "wedge.toml", "--out", ours, "--no-film", "--no-report")
    for form, name in (("csv", "frames.csv"), ("lammps-dump", "run.dump"), ("lammps-dump", "dump.bed"), ("gsd", "bed.gsd"),
                       ("xyz", "bed.xyz"), ("lammps-data", "packed.data")):
        made("export", ours, "--to", form, "--out", name)
    shutil.copy(ROOT / "tests/fuzz/corpus/foreign/bed.h5", folder / "bed.h5")
    frames = guide_files.read_frames(folder / "frames.csv")
    guide_files.liggghts(folder / "post", frames)
    guide_files.lammps_local(folder, frames)
    guide_files.ellipsoids(folder / "ellipsoids.dump", frames)
    guide_files.pair_table(folder / "pairs.csv", frames)
    guide_files.mercury(folder, "Chute", frames)
    guide_files.yade(folder, frames)
    guide_files.lethe(folder, frames)
    guide_files.mfix(folder, frames)
    guide_files.paraview_table(folder / "saved.csv", frames)
    rows = frames[-1][1]
    (folder / "table.csv").write_text("x,y,z,r,mol\n" + "".join(
        ",".join("%.9g" % row[n] for n in ("x", "y", "z", "radius", "type")) + "\n" for row in rows))
    return frames


SMALL_SCENE = dict(small=40, big=10, width=30, height=40, duration=0.15, interval=0.05)
LARGE_SCENE = dict(small=400, big=60, width=50, height=70, duration=0.4, interval=0.05)


HEIGHTS = """
import sys, netCDF4, matplotlib
matplotlib.use("Agg")
from matplotlib import pyplot
file = netCDF4.Dataset("output/wedge_segregation/trajectory.nc")
heights, radii = file["coordinates"][-1, :, 2], file["radius"][:].reshape(-1)[:len(file.dimensions["atom"])]
pyplot.figure(figsize=(4.8, 3.2), dpi=100)
for name, which in (("small", radii < 2.5e-3), ("big", radii > 2.5e-3)):
    pyplot.hist(1e3 * heights[which], bins=20, range=(0, 60), alpha=0.6, label=name)
pyplot.xlabel("height (mm)"), pyplot.ylabel("grains"), pyplot.legend(), pyplot.tight_layout()
pyplot.savefig(sys.argv[1])
"""


def draw_pictures(program, folder, out):
    looks = {
        "lammps": ["dump.bed", "--time-step", "1e-6", "--at", "0.4"],
        "liggghts": ["post", "--time-step", "1e-5", "--at", "0.4"],
        "mercurydpm": ["Chute.data", "--set", "film.force_chains=true", "--at", "0"],
        "yade": ["spheres-*.vtu", "--walls", "facets-*.vtu", "--time-step", "1e-5", "--at", "0.4"],
        "lethe": ["out.pvd", "--set", "film.colour.by=speed", "--set", "film.colour.range=[0, 0.5]", "--at", "0.4"],
        "mfix": ["PARTICLES.pvd", "--set", "film.camera.elevation=60", "--at", "0.4"],
        "gsd": ["bed.gsd", "--set", "film.camera.azimuth=0", "--at", "0.4"],
        "ovito": ["bed.xyz", "--set", "film.style=flat", "--at", "0.4"],
    }
    for name, words in looks.items():
        made = run([program, "render", *words, "--size", "480x320", "--force", "--out", out / f"{name}.png"], folder)
        print(name, made.returncode, made.stderr.strip())
    made = run([PYTHON, "-c", HEIGHTS, out / "python.png"], folder)
    print("python", made.returncode, made.stderr)


def main():
    program = str(pathlib.Path(sys.argv[1]).resolve())
    option = sys.argv[2] if len(sys.argv) > 2 else ""
    if option == "--table":
        print(table(program), end="")
        return
    if option == "--list":
        for first, needs, lines in blocks(PAGE):
            for line in lines:
                print(f"{first} {' '.join(needs)}: {line}")
        return
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        make_files(program, folder, LARGE_SCENE if option == "--pictures" else SMALL_SCENE)
        if option == "--pictures":
            draw_pictures(program, folder, pathlib.Path(sys.argv[3]).resolve())
            return
        check_table(program, folder)
        check_commands(folder)


main()
