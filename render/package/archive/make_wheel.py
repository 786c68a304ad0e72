#!/usr/bin/env python3
"""Makes a wheel for pip of the Python module and of a folder that make_tree.py has made: PEP 427, with Python's own
library alone.

usage: make_wheel.py --version 1.0.0 --processor x86_64 --module grainreel --level 6 TREE FOLDER

The wheel goes to FOLDER; its name says for which glibc and processor it is, and pip refuses it elsewhere.
"""
import argparse
import base64
import hashlib
import stat
import zipfile
from pathlib import Path

PACKED = "grainreel_program"  # the package that holds the folder; render/package/python/grainreel/_program.py looks for it

METADATA = """Metadata-Version: 2.1
Name: grainreel
Version: {version}
Summary: Films of vibrated grains and the numbers behind them
License: GPL-2.0-or-later
Requires-Python: >=3.9
Requires-Dist: numpy
Requires-Dist: xarray>=2023.1
Requires-Dist: netCDF4
Description-Content-Type: text/markdown

The module `grainreel` starts runs of grainreel and reads them as datasets of xarray. The program and the libraries that
it needs are in this wheel, and the command `grainreel` starts it. The module and the program's own sources are under the
MIT licence. x264 and FFmpeg, which come along, are under the GNU General Public License; `licences/LIST` in this wheel
says what else it holds, under which licences, and where the sources are.
"""
WHEEL = """Wheel-Version: 1.0
Generator: grainreel
Root-Is-Purelib: false
Tag: {tag}
"""
ENTRY_POINTS = f"[console_scripts]\ngrainreel = {PACKED}:main\n"


class Wheel:
    """A zip file that lists its own files with their hashes."""

    def __init__(self, file, level):
        self.zip = zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED, compresslevel=level)
        self.record = []

    def add(self, name, data, executable=False):
        entry = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))  # the same bytes each time
        entry.compress_type = zipfile.ZIP_DEFLATED
        entry.external_attr = (stat.S_IFREG | (0o755 if executable else 0o644)) << 16  # pip sets x by this
        self.zip.writestr(entry, data)
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        self.record.append(f"{name},sha256={digest},{len(data)}")

    def close(self, folder):
        name = f"{folder}/RECORD"
        self.add(name, "\n".join([*self.record, f"{name},,", ""]).encode())
        self.zip.close()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name in ("version", "processor"):
        parser.add_argument(f"--{name}", required=True)
    parser.add_argument("--module", type=Path, required=True)
    parser.add_argument("--level", type=int, default=6)
    parser.add_argument("tree", type=Path)
    parser.add_argument("folder", type=Path)
    how = parser.parse_args()
    glibc = how.tree.with_name(how.tree.name + ".glibc").read_text().strip()
    tag = f"py3-none-manylinux_{glibc}_{how.processor}"
    file = how.folder / f"grainreel-{how.version}-{tag}.whl"
    half = file.with_suffix(".half")
    wheel = Wheel(half, how.level)
    for path in sorted([*how.module.glob("*.py"), how.module / "py.typed"]):
        wheel.add(f"grainreel/{path.name}", path.read_bytes())
    wheel.add(f"{PACKED}/__init__.py", Path(__file__).with_name("wheel_command.py").read_bytes())
    for path in sorted(path for path in how.tree.rglob("*") if path.is_file()):
        wheel.add(f"{PACKED}/{path.relative_to(how.tree)}", path.read_bytes(), bool(path.stat().st_mode & 0o111))
    info = f"grainreel-{how.version}.dist-info"
    wheel.add(f"{info}/METADATA", METADATA.format(version=how.version).encode())
    wheel.add(f"{info}/WHEEL", WHEEL.format(tag=tag).encode())
    wheel.add(f"{info}/entry_points.txt", ENTRY_POINTS.encode())
    wheel.close(info)
    half.rename(file)
    print(file)


if __name__ == "__main__":
    main()
