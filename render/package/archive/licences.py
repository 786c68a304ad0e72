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

    def _ask(self, *words):
        done = subprocess.run([*self.dpkg, *words], capture_output=True, text=True)
        return done.stdout if done.returncode == 0 else ""

    def owner(self, file):
        """The package that a file belongs to, as dpkg names it (with its architecture), or an empty word."""
        path = "/" + str(Path(file).relative_to(self.loader.inside("/")))
        for name in (path, path.removeprefix("/usr"), "/usr" + path):  # /lib may be a link to /usr/lib
            said = self._ask("-S", name)
            if said:
                return said.splitlines()[0].split(": ")[0].split(",")[0]
        return ""

    def source(self, package):
        """The package's source and its version: ("x264", "2:0.164.3095+gitbaee400-3"); empty words for no package."""
        said = self._ask("-W", "-f", "${source:Package} ${source:Version}\n", package).split()
        return (said[0], said[1]) if len(said) == 2 else ("", "")

    def copyright(self, package):
        return self.loader.inside(f"/usr/share/doc/{package.split(':')[0]}/copyright")


def write(folder, files, ffmpeg, packages):
    """Writes the list and the licences. files: {name in the archive: file that it was copied from}; ffmpeg: the folder
    of an FFmpeg that was built from Debian's source, or None."""
    (folder / "common").mkdir(parents=True)
    rows, owners = [], set()
    for name, file in sorted(files.items()):
        if ffmpeg and file.is_relative_to(ffmpeg):
            origin, version = (ffmpeg / "source").read_text().split()
            rows.append((name, "built for this archive, see ffmpeg.txt", origin, version))
            continue
        package = packages.owner(file)
        if not package:
            raise SystemExit(f"archive: {file} belongs to no package of Debian, so its licence is not known; "
                             "make the archive where all libraries are Debian's")
        owners.add(package)
        rows.append((name, package, *packages.source(package)))
    for package in COMPILED_IN:
        source, version = packages.source(package)
        if source:
            owners.add(package)
            rows.append(("(compiled in)", package, source, version))
    for package in owners:
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
