# shellcheck shell=bash
# Sourced by ./movie and ./test: packages, configuration, build. Everything it says goes to stderr.
root=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.." && pwd)
build="$root/build/release"

# Debian's package, and the pkg-config module or plain words that stand for it elsewhere. Where releases of Debian
# differ, a row has several packages with | between them: the first that the release offers is taken.
program_packages="
g++                  a C++20 compiler (GCC 12 or clang 14, or newer)
cmake                CMake 3.25
ninja-build          Ninja
pkgconf              pkg-config
libeigen3-dev        eigen3 3.4
libfmt-dev           fmt
libspdlog-dev        spdlog
libcli11-dev         CLI11
nlohmann-json3-dev   nlohmann_json
libtomlplusplus-dev  tomlplusplus
libudunits2-dev      udunits2, with its XML database
libxxhash-dev        libxxhash
libhwy-dev           libhwy (Highway)
libnetcdf-dev        netcdf
libhdf5-dev          hdf5
libpng-dev           libpng
libdeflate-dev       libdeflate
zlib1g-dev           zlib
libzstd-dev          libzstd
liblz4-dev           liblz4
libexpat1-dev        expat
libmicrohttpd-dev    libmicrohttpd
libpango1.0-dev      pangocairo, pangoft2, cairo
fonts-dejavu-core    the DejaVu fonts
libosmesa6|libegl-mesa0  software OpenGL: libOSMesa.so.8 of Mesa before 25.1, else Mesa's driver for EGL
libgl-dev            GL/glcorearb.h
libegl-dev           EGL/eglext.h, and libEGL.so.1
libavformat-dev      libavformat
libavcodec-dev       libavcodec, with libx264
libswscale-dev       libswscale
libavfilter-dev      libavfilter
gnuplot-nox          gnuplot, for ./movie chart
dpkg-dev             dpkg-shlibdeps, for cpack
file                 file, for cpack
"
test_packages="
libgtest-dev         gtest
libgmock-dev         gmock
patchelf             patchelf, for the test of the archive
python3-pip          pip for Python, which installs the wheel in a test
python3-venv         venv for Python
libmpfr-dev          mpfr, to which a test compares sines, powers and so on
python3-xarray       xarray for Python, which reads fields.nc in a test
python3-netcdf4      netCDF4 for Python
python3-vtk9         VTK for Python, which reads fields.nc in a test
python3-jsonschema   jsonschema for Python, which judges scenes by our schema in a test
mypy                 mypy, which checks the types of the Python module in a test
"
browser_packages="
chromium             a browser, for ./test --browser
chromium-driver      ChromeDriver of the same version
python3-selenium     Selenium for Python
python3-netcdf4      netCDF4 for Python
"

peers_packages="
lammps               LAMMPS, for ./test --peers
liggghts             LIGGGHTS
openmpi-bin          mpirun
python3-ase          ASE for Python, which reads exports in a test
python3-gsd          gsd for Python, likewise
python3-mdanalysis   MDAnalysis for Python, likewise
"

archive_words="docs/guide/install.md: machines without root"

say() { printf '%s\n' "$*" >&2; }

list_libraries() {  # $1: a package table
    say "What the build needs; the names are Debian's and then pkg-config's or plain words:"
    sed '/^$/d; s/^/  /' <<<"$1" >&2
}

# (dpkg-query and apt-cache fail where they do not know one of the names.)
installed() {  # $@: packages. Prints those that are installed.
    { dpkg-query -W -f '${db:Status-Status} ${Package}\n' "$@" 2>/dev/null || true; } | sed -n 's/^installed //p'
}

offered() {  # $@: packages. Prints those that apt can install. (apt translates what it prints.)
    { LC_ALL=C LANGUAGE=C apt-cache policy "$@" 2>/dev/null || true; } |
        awk '/^[^ ]/ { name = $1; sub(/(:[a-z0-9]+)?:$/, "", name) } $1 == "Candidate:" && $2 != "(none)" { print name }'
}

# Prints what apt must install for the rows of a package table, given the packages that apt offers, a line each.
# Rows of which apt offers nothing are printed with a ! before them.
choose_packages() {  # $1: rows, one word each; $2: packages on offer
    local row name chosen
    for row in $1; do
        chosen=
        for name in ${row//|/ }; do
            if grep -qxF -- "$name" <<<"$2"; then chosen=$name && break; fi
        done
        echo "${chosen:-!$row}"
    done
}

install_packages() {  # $1: a package table. Returns at once when all of it is installed.
    local row there missing='' offer chosen lacking as_root=()
    if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
        return 0  # another distribution: the configuration tells whether the libraries are there
    fi
    # shellcheck disable=SC2046  # one word a package
    there=$(installed $(awk '{print $1}' <<<"$1" | tr '|' ' '))
    for row in $(awk '{print $1}' <<<"$1"); do
        [[ $(choose_packages "$row" "$there") != !* ]] || missing+="$row "
    done
    [[ -n $missing ]] || return 0
    if ((EUID != 0)); then
        if sudo -n true 2>/dev/null || { [[ -t 0 ]] && command -v sudo >/dev/null; }; then
            as_root=(sudo)
        else
            # shellcheck disable=SC2086
            chosen=$(choose_packages "$missing" "$(offered ${missing//|/ })" | sed 's/^!//; s/|.*//' | sort | tr '\n' ' ')
            say "These packages are missing, and installing them needs root. Ask for:"
            say "  apt-get install --no-install-recommends $chosen"
            say "Without root: the archive needs no packages ($archive_words)."
            exit 2
        fi
    fi
    "${as_root[@]}" apt-get -q -o DPkg::Lock::Timeout=300 update >&2 ||
        say "apt-get update failed; going on with the lists that are there."
    # shellcheck disable=SC2086
    offer=$(offered ${missing//|/ })
    chosen=$(choose_packages "$missing" "$offer")
    lacking=$(sed -n 's/^!//p' <<<"$chosen" | tr '\n' ' ')
    chosen=$(sed '/^!/d' <<<"$chosen" | sort | tr '\n' ' ')
    if [[ -n $lacking ]]; then
        say "This system's package sources have none of: $lacking"
        say "Nothing was installed. Install what they stand for by other means and add --no-install,"
        say "or take the archive, which needs no packages ($archive_words)."
        list_libraries "$1"
        exit 2
    fi
    say "Installing with apt: $chosen"
    # shellcheck disable=SC2086
    if ! "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -y -o DPkg::Lock::Timeout=300 \
            install --no-install-recommends $chosen </dev/null >&2; then
        say "apt could not install: $chosen"
        list_libraries "$1"
        exit 2
    fi
}

configure() {  # $1: a package table; then options for cmake
    local table=$1 tool
    shift
    for tool in cmake ninja; do
        if ! command -v "$tool" >/dev/null; then
            say "$tool is missing."
            list_libraries "$table"
            exit 2
        fi
    done
    if ! (cd "$root" && cmake --preset release "$@" >&2); then
        list_libraries "$table"
        exit 2
    fi
}

cached() { grep -qsxF "$1" "$build/CMakeCache.txt"; }

# Configures only where ninja cannot know that it must: a first time, or a tree that has moved since.
prepare() {  # $1: ON with tests, OFF without them; then yes or no: may packages be installed
    local tests=$1 may_install=$2 table=$program_packages
    [[ $tests == OFF ]] || table+=$test_packages
    [[ $may_install == no ]] || install_packages "$table"
    if ! cached "CMAKE_HOME_DIRECTORY:INTERNAL=$root" || [[ ! -e $build/build.ninja ]]; then
        configure "$table" --fresh "-DGRAINREEL_TESTS=$tests"
    elif [[ $tests == ON ]] && ! cached "GRAINREEL_TESTS:BOOL=ON"; then
        configure "$table" -DGRAINREEL_TESTS=ON
    fi
}

seconds_a_step=5  # of one processor

# Reads what ninja says where no terminal is: tells in a line what there is to build and about how long it takes,
# in another that it is done, and passes on all that is no progress: warnings and errors.
tell_build() {
    local line steps='' failed='' began=$SECONDS processors
    processors=$(nproc)
    while IFS= read -r line; do
        case $line in
            *'] Re-checking '* | *'] Re-running '* | '-- '* | 'ninja: Entering '* | 'ninja: no work to do.') continue ;;
            FAILED:*) failed=yes ;;
        esac
        if [[ ! $line =~ ^\[[0-9]+/([0-9]+)\]\  ]]; then
            say "$line"
        elif [[ -z $steps ]]; then
            steps=${BASH_REMATCH[1]}
            say "Building in $steps $(((steps == 1)) && echo step || echo steps); takes about" \
                "$((steps * seconds_a_step / processors / 60 + 1)) min."
        fi
    done
    [[ -z $steps || -n $failed ]] || say "Built in $((SECONDS - began)) s."
}

compile() {  # ninja's targets. Two scripts at once take turns.
    [[ -x $build/grainreel ]] || say "Building; the first time takes a few minutes."
    if [[ -t 2 ]]; then
        flock "$build" ninja -C "$build" "$@" >&2 || exit 1
    else
        NINJA_STATUS='[%f/%t] ' flock "$build" ninja -C "$build" "$@" | tell_build || exit 1
    fi
}
