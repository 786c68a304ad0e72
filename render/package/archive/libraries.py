"""Which shared libraries a program needs, and where they lie: as the dynamic loader would find them, but for any
processor, and below a sysroot where there is one."""
import re
import struct
import subprocess
from pathlib import Path

# The C library's own parts stay out: they must fit the loader and the kernel of the machine that runs the program.
OF_GLIBC = re.compile(r"(ld-linux.*|libc|libm|libmvec|libdl|librt|libpthread|libresolv|libutil|libanl|libnss_\w+|"
                      r"libBrokenLocale|libthread_db|libnsl)\.so(\.\d+)?")


class Missing(Exception):
    """A library that is not there: one line."""


def machine_of(file):
    """Word size and processor of an ELF file; None for any other file."""
    with open(file, "rb") as binary:
        head = binary.read(20)
    if head[:4] != b"\x7fELF":
        return None
    return head[4], struct.unpack("<H" if head[5] == 1 else ">H", head[18:20])[0]


class Loader:
    """Finds libraries for the processor of one program."""

    def __init__(self, program, sysroot, readelf, more_folders=()):
        self.sysroot, self.readelf, self.machine = Path(sysroot or "/"), readelf, machine_of(program)
        self.folders = [Path(folder) for folder in more_folders] + [
            folder for folder in map(self.inside, self._configured()) if folder.is_dir()]

    def inside(self, path):
        """A path of the target system, below the sysroot."""
        return self.sysroot / str(path).lstrip("/")

    def real(self, path):
        """The file itself; links of the target system that begin at its root are followed below the sysroot."""
        path = Path(path)
        while path.is_symlink():
            goal = path.readlink()
            path = self.inside(goal) if goal.is_absolute() else path.parent / goal
        return path

    def _configured(self, name="/etc/ld.so.conf"):
        folders = []
        file = self.inside(name)
        for line in file.read_text().splitlines() if file.is_file() else []:
            line = line.split("#")[0].strip()
            if line.startswith("include "):
                for part in sorted(self.inside("/").glob(line.split(None, 1)[1].lstrip("/"))):
                    folders += self._configured("/" + str(part.relative_to(self.inside("/"))))
            elif line:
                folders.append(line)
        return folders + (["/lib64", "/usr/lib64", "/lib", "/usr/lib"] if name == "/etc/ld.so.conf" else [])

    def _read(self, option, *files):
        return subprocess.run([self.readelf, "-W", option, *map(str, files)], capture_output=True, text=True, check=True,
                              env={"PATH": "/usr/bin:/bin", "LC_ALL": "C"}).stdout

    def needs(self, file):
        """Names of the libraries that a file asks for."""
        return re.findall(r"\(NEEDED\).*\[(.*)\]", self._read("-d", file))

    def glibc(self, files):
        """The newest version of glibc whose symbols the files ask for, as (2, 36)."""
        versions = re.findall(r"Name: GLIBC_(\d+)\.(\d+)", self._read("-V", *files))
        return max(((int(major), int(minor)) for major, minor in versions), default=(0, 0))

    def find(self, name):
        """The file of a library, with its links followed."""
        for folder in self.folders:
            file = self.real(folder / name)
            if file.is_file() and machine_of(file) == self.machine:
                return file
        raise Missing(f"{name} is not found for this processor; install the package that has it")

    def closure(self, files):
        """{name: file} of all libraries that the files need, and their libraries need, but glibc's."""
        found, waiting = {}, [name for file in files for name in self.needs(file)]
        while waiting:
            name = waiting.pop()
            if name in found or OF_GLIBC.fullmatch(name):
                continue
            found[name] = self.find(name)
            waiting += self.needs(found[name])
        return found
