#!/usr/bin/env bash
# Makes the Debian packages of a build and uses what is in them from an empty folder: package_test.sh BUILD MAJORS
# MAJORS: FFmpeg's libraries and their major versions, avutil=57,avcodec=59
# The packages are unpacked, not installed, so that the test needs no root.
set -euo pipefail
build=$1 majors=$2
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT

fail() { echo "FAILED: $*" >&2; exit 1; }

# It begins as after ./movie, which builds the program alone: what else the packages hold is not there yet. (The objects of the
# two libraries stay, because they take long to compile.)
cd "$build"
rm -f engine/libgrainreel_engine_library.a render/libgrainreel_picture_library.a
cpack -B "$here/made" >"$here/cpack.log" 2>&1 || { cat "$here/cpack.log"; fail "cpack made no packages"; }
package=$(echo "$here"/made/grainreel_*.deb)
(($(stat -c %s "$package") < 10000000)) || fail "$package is larger than 10 MB"
# FFmpeg's packages are called by the major version of their library: libavutil57.
for needed in 'libosmesa6 \| libegl1' $(tr ',' '\n' <<<"$majors" | sed 's/^/lib/; s/=//') 'libnetcdf[0-9]+' libudunits2-0 fonts-dejavu-core
do
    dpkg-deb -f "$package" Depends | grep -qE "(^|, )$needed( |,|$)" || fail "it does not depend on $needed"
done
dpkg-deb -x "$package" "$here/root"

for file in bin/grainreel share/man/man1/grainreel.1.gz share/man/man1/grainreel-render.1.gz share/doc/grainreel/copyright \
            share/doc/grainreel/changelog.gz share/bash-completion/completions/grainreel \
            share/zsh/vendor-completions/_grainreel share/fish/vendor_completions.d/grainreel.fish \
            share/grainreel/scenes/wedge_segregation.toml share/doc/grainreel/docs/reference/scenes.md; do
    [[ -s $here/root/usr/$file ]] || fail "$file is missing"
done
zcat "$here/root/usr/share/man/man1/grainreel-movie.1.gz" | grep -q '^.SH SYNOPSIS' || fail "no man page"

# The library is a package of its own; library_test.py tries it.
library=$(echo "$here"/made/libgrainreel-dev_*.deb)
(($(stat -c %s "$library") < 10000000)) || fail "$library is larger than 10 MB"
dpkg-deb -x "$library" "$here/library"
for file in include/grainreel/simulation.hpp lib/libgrainreel_engine.a lib/libgrainreel_picture.a \
            lib/cmake/grainreel/grainreelConfig.cmake share/doc/libgrainreel-dev/copyright \
            share/doc/libgrainreel-dev/examples/shake.cpp share/doc/libgrainreel-dev/reference/scenes.md; do
    [[ -s $here/library/usr/$file ]] || fail "$file is missing"
    [[ ! -e $here/root/usr/$file ]] || fail "$file is in the program's package"
done

# So is the Python module, which must need Python and the program.
module=$(echo "$here"/made/python3-grainreel_*_all.deb)
for needed in python3 python3-xarray python3-netcdf4 grainreel; do
    dpkg-deb -f "$module" Depends | grep -qE "(^|, )$needed( |,|$)" || fail "$module does not depend on $needed"
done
dpkg-deb -x "$module" "$here/module"
[[ -s $here/module/usr/lib/python3/dist-packages/grainreel/__init__.py ]] || fail "the Python module is missing"
[[ ! -e $here/root/usr/lib/python3 ]] || fail "the program's package has files for Python"
for name in grainreel libgrainreel-dev python3-grainreel; do
    changes=$(find "$here"/{root,library,module} -path "*/doc/$name/changelog.gz")
    zcat "$changes" | grep -q "^grainreel (" || fail "$name has no changelog for Debian's tools"
done
if command -v lintian >/dev/null; then
    lintian --tag-display-limit 0 "$here"/made/*.deb >"$here/lintian" 2>/dev/null || true
    ! grep '^E:' "$here/lintian" || fail "lintian finds errors"
fi

# Another working folder, and nothing in the environment.
mkdir "$here/work"
cd "$here/work"
run() { env -i PATH=/usr/bin:/bin HOME="$here/work" "$here/root/usr/bin/grainreel" "$@"; }
run --version | grep -q "installed in $here/root/usr/bin" || fail "--version does not say that it is installed"
run movie wedge_segregation --set species.small.count=60 --set species.big.count=6 --duration 0.05s --set film.size=320x240 \
    --out run --quiet || fail "no film"
[[ -s run/movie.mp4 && -s run/report.html ]] || fail "film or page is missing: $(ls run)"
run inspect run | grep -q 66 || fail "inspect does not count the grains"
echo "ok: $(basename "$package"), $(stat -c %s "$package") bytes; $(basename "$library"), $(stat -c %s "$library") bytes"
