#!/usr/bin/env python3
"""Runs the program of an unpacked archive where nothing but glibc and fonts may come from the system.

usage: archive_test.py TREE GRAINREEL
    TREE         a folder that render/package/archive/make_tree.py has made; it is copied, and the copy is broken
    GRAINREEL    the program of the same build: both must give the same bytes
"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

SETTINGS = ["wedge_segregation", "--set", "species.small.count=60", "--set", "species.big.count=6", "--duration", "0.2s",
            "--set", "film.size=320x240", "--threads", "1"]
FORMATS = {"gif": "gif", "webm": "webm", "av1": "mp4", "ffv1": "mkv", "y4m": "y4m"}  # and the ends of their names
GLIBC = re.compile(r"(ld-linux.*|libc|libm|libmvec|libdl|librt|libpthread|libresolv)\.so\.\d+")
OPENED = ["libOSMesa.so", "libLLVM", "libavcodec.so", "libavfilter.so", "libx264.so"]  # while it runs, not at its start


def check(holds, words):
    if not holds:
        sys.exit(f"FAILED: {words}")


class Place:
    """A folder to work in, whose environment has a path to libraries that must not be taken."""

    def __init__(self, folder, names):
        self.folder, self.wrong = folder / "work", folder / "wrong"
        self.folder.mkdir()
        self.wrong.mkdir()
        for name in names:
            (self.wrong / name).write_text("no library\n")

    def run(self, *words, status=0, **environment):
        done = subprocess.run([str(word) for word in words], cwd=self.folder, capture_output=True, text=True,
                              env={"PATH": "/usr/bin:/bin", "HOME": str(self.folder), "GRAINREEL_PACKINGS": "off",
                                   **environment})
        check(done.returncode == status,
              f"{' '.join(map(str, words))} ended with {done.returncode}, not {status}:\n{done.stdout}{done.stderr}")
        return done.stdout + done.stderr


def check_film(place, program, tree, grainreel):
    """A film, what is left of its run, and films of every format, bit by bit as the build's own program makes them."""
    watched = {"LD_LIBRARY_PATH": str(place.wrong), "LD_DEBUG": "libs", "LD_DEBUG_OUTPUT": str(place.folder / "loaded")}
    for one, folder, environment in ((program, "run", watched), (grainreel, "own", {})):
        place.run(one, "movie", *SETTINGS, "--out", folder, "--quiet", **environment)
        for kind in FORMATS:
            place.run(one, "render", "run", "--format", kind, "--out", f"{folder}/{kind}", "--quiet", **environment)
    made = ["final.csv", "movie.mp4", "poster.png", "measures.csv", *(f"{kind}/movie.{end}" for kind, end in FORMATS.items())]
    for name in made:
        check((place.folder / "run" / name).read_bytes() == (place.folder / "own" / name).read_bytes(),
              f"{name} differs from the build's own")
    text = "".join(file.read_text() for file in place.folder.glob("loaded.*"))
    loaded = {Path(name) for name in re.findall(r"calling init: (.*)$", text, re.M)}
    for name in OPENED:
        check(any(file.name.startswith(name) for file in loaded),
              f"{name} was not loaded, but {', '.join(sorted(file.name for file in loaded))}")
    for file in loaded:
        check(tree in file.parents or GLIBC.fullmatch(file.name), f"{file} was loaded from the system")


def check_verbs(place, program, tree):
    said = place.run(program, "report", "run")
    check("warning" not in said, f"the page lacks something:\n{said}")
    check((place.folder / "run/report.html").is_file(), "report made no page")
    check("66" in place.run(program, "inspect", "run"), "inspect does not count the grains")
    check("wedge_segregation" in place.run(program, "scenes"), "scenes does not list the shipped ones")
    place.run(program, "check", "wedge_segregation")
    said = place.run(program, "doctor")
    check(f"unpacked in {tree}" in said, f"doctor does not say where the archive is:\n{said}")
    check(re.search(r"ok +OpenGL by OSMesa +OSMesa: .*llvmpipe", said), f"doctor does not name the driver:\n{said}")


def check_own_files(place, program, tree):
    """Units and fonts are the archive's: without its table no unit is known, and its letters are drawn."""
    share = tree / "share/grainreel"
    files = (share / "files").read_text()
    kept = [line for line in files.splitlines() if "/units/" not in line and "/fonts/" not in line]
    (share / "files").write_text("\n".join(kept) + "\n")
    (share / "units").rename(share / "hidden")
    check("udunits2.xml is missing" in place.run(program, "check", "wedge_segregation", status=2), "units of the system")
    (share / "hidden").rename(share / "units")
    place.run(program, "check", "wedge_segregation", UDUNITS2_XML_PATH="/nowhere", FONTCONFIG_FILE="/nowhere")

    def picture(name):
        place.run(program, "render", "run", "--at", "0.1", "--out", name)
        return (place.folder / name).read_bytes()

    before = picture("before.png")
    plain = share / "fonts/DejaVuSans.ttf"
    letters = plain.read_bytes()
    shutil.copy(share / "fonts/DejaVuSans-Bold.ttf", plain)
    check(picture("bold.png") != before, "letters of the system")
    plain.write_bytes(letters)
    check(picture("after.png") == before, "a picture differs from the one before")
    (share / "files").write_text(files)


def check_broken(place, program, tree):
    """Of an archive that is not whole: one line that names the file."""

    def check_line(file, what):
        said = place.run(program, "--version", status=2)
        check(re.fullmatch(rf"error: .*: {re.escape(str(file.relative_to(tree)))} {what}; unpack the archive again\n", said),
              f"{file} {what}, but the program says: {said}")

    for name in ("libnetcdf.so.*", "libLLVM*", "grainreel"):
        file = next((tree / "lib/grainreel").glob(name))
        file.rename(tree / "away")
        check_line(file, "is missing")
        file.write_bytes((tree / "away").read_bytes()[:1000])
        check_line(file, "is not whole")
        (tree / "away").replace(file)
    program_file, fonts = tree / "lib/grainreel/grainreel", tree / "share/grainreel/fonts/DejaVuSans.ttf"
    for file, rights, what in ((program_file, 0o644, "may not be run"), (fonts, 0, "may not be read")):
        before = file.stat().st_mode & 0o777
        file.chmod(rights)
        check_line(file, what)
        file.chmod(before)
    files = tree / "share/grainreel/files"
    text = files.read_text()
    files.write_text(text[:len(text) // 2])
    check_line(files, "is not whole")
    files.unlink()
    check_line(files, "is missing")
    files.write_text(text)


def check_licences(tree):
    folder = tree / "share/doc/grainreel/licences"
    rows = [line.split() for line in (folder / "LIST").read_text().splitlines() if line.startswith("lib/grainreel/")]
    listed = {row[0].removeprefix("lib/grainreel/"): row for row in rows}
    libraries = {file.name for file in (tree / "lib/grainreel").iterdir()} - {"grainreel"}
    check(libraries == set(listed), f"the list of licences differs from the libraries: {libraries ^ set(listed)}")
    for name, row in listed.items():
        package = row[1].split(":")[0] if len(row) == 4 else "ffmpeg"
        check((folder / package).stat().st_size > 100, f"{name} has no licence, {package}")
    check("GNU GENERAL PUBLIC LICENSE" in (folder / "common/GPL-2").read_text(), "the text of the GPL is missing")


def main():
    made, grainreel = Path(sys.argv[1]), Path(sys.argv[2])
    if not made.is_dir():
        print("there is no folder of an archive, see the test ArchiveTree")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name).resolve()
        first = folder / "körner 粒"
        shutil.copytree(made, first)
        place = Place(folder, [file.name for file in (first / "lib/grainreel").glob("*.so*")])
        check(f"unpacked in {first}" in place.run(first / "bin/grainreel", "--version"), "--version, in the first folder")
        tree = folder / "moved, with a comma"
        first.rename(tree)
        for file in [tree, *tree.rglob("*")]:
            if file.is_dir():
                file.chmod(0o555)  # read-only, for who is not root
        program = folder / "grainreel"
        program.symlink_to(os.path.relpath(tree / "bin/grainreel", folder))
        check(f"unpacked in {tree}" in place.run(program, "--version"), "--version, after a move and by a link")
        check_film(place, program, tree, grainreel)
        check_verbs(place, program, tree)
        check_licences(tree)
        for file in [tree, *tree.rglob("*")]:
            if file.is_dir():
                file.chmod(0o755)
        check_own_files(place, program, tree)
        check_broken(place, program, tree)
    print("ok")


if __name__ == "__main__":
    main()
