#!/usr/bin/env python3
"""Puts a folder together that runs grainreel on any Linux with a glibc as new as this one's: the program, every library
that it needs but glibc's, two fonts, the table of units, and the licences of all of it.

usage: make_tree.py --build BUILD --launcher FILE --ffmpeg FOLDER|system --majors avutil=57,avcodec=59,... OUT

--build      a build folder, whose component `program` is installed
--launcher   what becomes bin/grainreel: it looks whether the archive is whole and starts lib/grainreel/grainreel
--ffmpeg     the folder that ffmpeg.sh has filled; system: the FFmpeg that is installed, with all of its libraries
--majors     the major versions of FFmpeg's libraries that the program opens
--sysroot    where the target's files lie [/]
--readelf, --strip, --patchelf, --cmake   the tools

OUT must not be there. A second output is OUT.glibc: the version of glibc that the files ask for, as 2_36.
"""
import argparse
import shutil
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import libraries  # noqa: E402
import licences  # noqa: E402

OWN = Path("lib/grainreel")  # libraries, and the program itself
SHARE = Path("share/grainreel")
FONTS = ["DejaVuSans.ttf", "DejaVuSans-Bold.ttf"]  # as in render/picture/base/cairo_text.cpp
FONT_FOLDERS = ["/usr/share/fonts/truetype/dejavu", "/usr/share/fonts/dejavu-sans-fonts", "/usr/share/fonts/TTF",
                "/usr/share/fonts/dejavu"]
UNIT_FOLDERS = ["/usr/share/xml/udunits", "/usr/share/udunits"]
OSMESA = "libOSMesa.so.8"

README = """grainreel {version} for Linux on {processor}, with all that it needs but glibc {glibc} or newer (Debian 12).

    bin/grainreel movie wedge_segregation

Nothing is to be installed. The folder may lie anywhere, be moved, and be read-only; a link to bin/grainreel on the PATH
makes `grainreel` a command. Man pages are in share/man, the guide in share/doc/grainreel/docs, licences in
share/doc/grainreel/licences. Charts are drawn where gnuplot is installed.
"""


def run(*words):
    subprocess.run([str(word) for word in words], check=True, stdout=subprocess.DEVNULL)


def first_folder(loader, folders, name, package):
    for folder in map(loader.inside, folders):
        if (folder / name).is_file():
            return folder
    raise libraries.Missing(f"{name} is not found; install {package}")


def copy(file, to):
    to.parent.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(file, to)
    to.chmod(0o644)


def install_program(how, out):
    """The program as `cmake --install` places it; it then makes room for its starter."""
    run(how.cmake, "--install", how.build, "--component", "program", "--prefix", out)
    (out / OWN).mkdir(parents=True)
    (out / "bin/grainreel").rename(out / OWN / "grainreel")
    shutil.copy(how.launcher, out / "bin/grainreel")
    for file in (out / "bin/grainreel", out / OWN / "grainreel"):
        run(how.strip, file)
        file.chmod(0o755)


def copy_libraries(how, loader, out):
    """Copies the libraries, each under the name by which it is asked for, and lets each find the others beside itself.
    An RPATH goes before LD_LIBRARY_PATH, which clusters and conda fill with libraries of other versions. Gives
    {name in the archive: file}."""
    opened = [f"lib{name}.so.{major}" for name, major in (pair.split("=") for pair in how.majors.split(","))]
    opened = {name: loader.find(name) for name in [*opened, OSMESA]}
    program = out / OWN / "grainreel"
    found = {**opened, **loader.closure([program, *opened.values()])}
    for name, file in found.items():
        copy(file, out / OWN / name)
        (out / OWN / name).chmod(0o755)
    run(how.patchelf, "--force-rpath", "--set-rpath", "$ORIGIN", program, *(out / OWN / name for name in found))
    return {str(OWN / name): file for name, file in found.items()}


def copy_data(loader, out):
    fonts = first_folder(loader, FONT_FOLDERS, FONTS[0], "fonts-dejavu-core")
    units = first_folder(loader, UNIT_FOLDERS, "udunits2.xml", "libudunits2-data")
    found = {str(SHARE / "fonts" / name): fonts / name for name in FONTS}
    found.update({str(SHARE / "units" / file.name): file for file in sorted(units.glob("*.xml"))})
    for name, file in found.items():
        copy(file, out / name)
    copy(Path(__file__).with_name("fonts.conf"), out / SHARE / "fonts.conf")
    return found


def write_list(out):
    """What the starter looks for: every file that the program cannot do without, with its size."""
    files = sorted(file for part in (OWN, SHARE / "fonts", SHARE / "units", SHARE / "fonts.conf")
                   for file in ([out / part] if (out / part).is_file() else (out / part).iterdir()))
    lines = [f"{file.stat().st_size} {file.relative_to(out)}" for file in files]
    (out / SHARE / "files").write_text("\n".join([*lines, "end"]) + "\n")


def make(how):
    out = how.out.resolve()
    install_program(how, out)
    ffmpeg = None if how.ffmpeg == "system" else Path(how.ffmpeg).resolve()
    loader = libraries.Loader(out / OWN / "grainreel", how.sysroot, how.readelf, [ffmpeg / "lib"] if ffmpeg else [])
    files = {**copy_libraries(how, loader, out), **copy_data(loader, out)}
    licences.write(out / "share/doc/grainreel/licences", files, ffmpeg, licences.Packages(loader))
    write_list(out)
    glibc = loader.glibc((out / OWN).iterdir())
    (out / "README").write_text(README.format(version=how.version, processor=how.processor,
                                              glibc=".".join(map(str, glibc))))
    out.with_name(out.name + ".glibc").write_text("_".join(map(str, glibc)) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name in ("build", "launcher", "ffmpeg", "majors", "version", "processor"):
        parser.add_argument(f"--{name}", required=True)
    parser.add_argument("--sysroot", default="/")
    for tool in ("readelf", "strip", "patchelf", "cmake"):
        parser.add_argument(f"--{tool}", default=tool)
    parser.add_argument("out", type=Path)
    how = parser.parse_args()
    if not shutil.which(how.patchelf):
        sys.exit("archive: patchelf is missing; install it (Debian: apt-get install patchelf)")
    try:
        make(how)
    except libraries.Missing as missing:
        shutil.rmtree(how.out, ignore_errors=True)
        sys.exit(f"archive: {missing}")


if __name__ == "__main__":
    main()
