"""From which packages of Debian the files of an archive come, and under which licences these stand."""
import shutil
import subprocess
from pathlib import Path

# Headers that are compiled into the program, and the C library in its starter.
COMPILED_IN = ["libeigen3-dev", "libhwy-dev", "libcli11-dev", "nlohmann-json3-dev", "libfmt-dev", "libspdlog-dev",
               "libtomlplusplus-dev", "libc6-dev"]

HEAD = """What this archive holds of other projects, by file. Each comes from the named package of Debian, unchanged but
for the path on which it looks for the others. Its licence lies beside this list, by the package's name, and the texts that
licences refer to in common/. The source of each package, with Debian's changes and the way it was built:

    apt-get source SOURCE=VERSION
    https://snapshot.debian.org/package/SOURCE/VERSION/

x264, and FFmpeg built with it, are under the GNU General Public License, version 2 or later, and so is the archive as a
whole. grainreel's own sources are under the MIT licence.

"""


class Packages:
    """Asks dpkg of the system, or of a sysroot."""

    def __init__(self, loader):
        self.loader = loader
        self.dpkg = ["dpkg-query", f"--admindir={loader.inside('/var/lib/dpkg')}"]

    # dpkg-query reads its whole list of files for each call, so one call asks for all. It ends with 1 if it does not know
    # one of them, and tells the others all the same.
    def _ask(self, *words):
        return subprocess.run([*self.dpkg, *words], capture_output=True, text=True).stdout.splitlines()

    def owners(self, files):
        """{file: package that it belongs to, as dpkg names it (with its architecture)}, without files of no package."""
        names = {}  # a path as dpkg may know it: the file. /lib may be a link to /usr/lib.
        for file in files:
            path = "/" + str(Path(file).relative_to(self.loader.inside("/")))
            for name in ("/usr" + path, path.removeprefix("/usr"), path):
                names[name] = file
        owners = {}
        for line in self._ask("-S", *names) if names else []:
            packages, _, path = line.rpartition(": ")
            if path in names:
                owners.setdefault(names[path], packages.split(",")[0])
        return owners

    def sources(self, packages):
        """{package: (its source, the version)}, as in ("x264", "2:0.164.3095+gitbaee400-3"), without unknown packages."""
        form = "${binary:Package} ${Package} ${source:Package} ${source:Version}\n"
        sources = {}
        for line in self._ask("-W", "-f", form, *packages):
            words = line.split()
            if len(words) == 4:
                sources[words[0]] = sources[words[1]] = (words[2], words[3])
        return {package: sources[package] for package in packages if package in sources}

    def copyright(self, package):
        return self.loader.inside(f"/usr/share/doc/{package.split(':')[0]}/copyright")


def write(folder, files, ffmpeg, packages):
    """Writes the list and the licences. files: {name in the archive: file that it was copied from}; ffmpeg: the folder
    of an FFmpeg that was built from Debian's source, or None."""
    (folder / "common").mkdir(parents=True)
    built = {file for file in files.values() if ffmpeg and file.is_relative_to(ffmpeg)}
    owners = packages.owners([file for file in files.values() if file not in built])
    sources = packages.sources([*sorted(set(owners.values())), *COMPILED_IN])
    rows = []
    for name, file in sorted(files.items()):
        if file in built:
            origin, version = (ffmpeg / "source").read_text().split()
            rows.append((name, "built for this archive, see ffmpeg.txt", origin, version))
            continue
        if file not in owners:
            raise SystemExit(f"archive: {file} belongs to no package of Debian, so its licence is not known; "
                             "make the archive where all libraries are Debian's")
        rows.append((name, owners[file], *sources.get(owners[file], ("", ""))))
    for package in COMPILED_IN:
        if package in sources:
            rows.append(("(compiled in)", package, *sources[package]))
    for package in {*owners.values(), *(name for name in COMPILED_IN if name in sources)}:
        shutil.copy(packages.copyright(package), folder / package.split(":")[0])
    if ffmpeg:
        shutil.copy(ffmpeg / "licence", folder / "ffmpeg")
        shutil.copy(ffmpeg / "configured", folder / "ffmpeg.txt")
    for text in sorted(packages.loader.inside("/usr/share/common-licenses").iterdir()):
        if not text.is_symlink():
            shutil.copy(text, folder / "common" / text.name)
    head = ("file", "package", "source", "version")
    widths = [max(len(row[k]) for row in [head, *rows]) for k in range(3)]
    lines = ["  ".join([*(word.ljust(width) for word, width in zip(row, widths)), row[3]]) for row in [head, *rows]]
    (folder / "LIST").write_text(HEAD + "\n".join(lines) + "\n")
