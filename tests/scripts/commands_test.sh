#!/usr/bin/env bash
# ./movie and ./test in a copy of the tree whose path has spaces, with stand-ins for apt, CMake, Ninja and the
# program: what is installed, when it is configured, and which words reach the program.
# shellcheck disable=SC2016
set -uo pipefail
repository=$(cd "$(dirname "$0")/../.." && pwd)
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT
chmod 755 "$work"
tree="$work/a tree" stubs="$work/stubs" calls="$work/calls" failures=0
mkdir -p "$tree/scenes" "$stubs" "$work/elsewhere"
cp -r "$repository/.ci" "$repository/movie" "$repository/test" "$tree/"
touch "$tree/scenes/one.toml" "$work/elsewhere/two.toml"

stub() { printf '#!/bin/bash\n%s\n' "$2" >"$stubs/$1" && chmod 755 "$stubs/$1"; }
stub apt-get 'echo "apt-get $*" >>"$CALLS"; [[ $* != *install* || -z ${APT_FAILS-} ]]'
# As the real ones: dpkg-query fails where it does not know a package, apt-cache passes over it.
stub dpkg-query 'lacks=0
for p; do if [[ " ${ABSENT-} " == *" $p "* ]]; then lacks=1; elif [[ $p != -* && $p != \$* ]]; then echo "installed $p"; fi; done
exit $lacks'
stub apt-cache 'if [[ $LC_ALL == C && $LANGUAGE == C ]]; then word=Candidate; else word=Installationskandidat; fi
for p in "${@:2}"; do if [[ " ${NOWHERE-} " != *" $p "* ]]; then printf "%s:\n  $word: 1\n" "$p"; fi; done'
stub sudo 'exit 1'
stub cmake 'echo "cmake $*" >>"$CALLS"; mkdir -p build/release; touch build/release/build.ninja
{ echo "CMAKE_HOME_DIRECTORY:INTERNAL=$PWD"; for o; do echo "${o#-D}" | sed "s/=/:BOOL=/"; done; } >build/release/CMakeCache.txt'
stub ninja 'echo "ninja ${*: -1}" >>"$CALLS"; while [[ $1 != -C ]]; do shift; done
printf "%s\n" "#!/bin/bash" "echo \"\$GRAINREEL_CALLED\" >>\$CALLS.name" "printf \"[%s]\" \"\$PWD\" \"\$@\"" >"$2/grainreel"; chmod 755 "$2/grainreel"; echo "[0/1] Re-checking globbed directories..."; echo "-- Configuring done"
if [[ -z ${STEPS-} ]]; then echo "ninja: no work to do."; fi
for ((i = 1; i <= ${STEPS-0}; ++i)); do echo "[$i/$STEPS] Building CXX object some.o"; done
if [[ -n ${ERROR-} ]]; then printf "FAILED: some.o\n%s\nninja: build stopped.\n" "$ERROR"; exit 1; fi'
stub ctest 'echo "ctest $*" >>"$CALLS"'

run() {  # words of a command; leaves $out, $said (stderr), $status, $did (calls of the stand-ins)
    : >"$calls" && chmod 666 "$calls"
    out=$(cd "$work/elsewhere" && CALLS=$calls PATH="$stubs:$PATH" "$@" 2>"$work/said" </dev/null)
    status=$? said=$(<"$work/said") did=$(<"$calls")
}
expect() {  # what, wanted, got
    [[ $2 == "$3" ]] || { printf 'FAILED %s\n  wanted: %s\n  got:    %s\n' "$1" "$2" "$3"; failures=$((failures + 1)); }
}
contains() {  # what, piece, text
    [[ $3 == *"$2"* ]] || { printf 'FAILED %s\n  no "%s" in: %s\n' "$1" "$2" "$3"; failures=$((failures + 1)); }
}
here="[$work/elsewhere]"

run "$tree/movie"
expect "default scene" "${here}[movie][$tree/scenes/wedge_segregation.toml]" "$out"
expect "first call" $'cmake --preset release --fresh -DGRAINREEL_TESTS=OFF\nninja grainreel' "$did"
run "$tree/movie" two.toml --title "a b"
expect "the caller's folder first" "${here}[movie][two.toml][--title][a b]" "$out"
expect "second call does not configure" "ninja grainreel" "$did"
expect "nothing to say" "" "$said"
run env STEPS=240 "$tree/movie" two.toml
expect "a build is told in two lines" 2 "$(wc -l <<<"$said")"
contains "the first line: what and how long" "Building in 240 steps; takes about $((240 * 5 / $(nproc) / 60 + 1)) min" "$said"
contains "the last line" "Built in " "$said"
run env STEPS=1 ERROR="some.cpp:1: error: no such thing" "$tree/movie" two.toml
expect "a build that fails" 1 "$status"
contains "its error" "some.cpp:1: error: no such thing" "$said"
[[ $said != *"Built in"* ]] || contains "a build that failed is not done" "nothing of the kind" "$said"
run "$tree/movie" scenes/one.toml --no-install --no-film
expect "then the tree" "${here}[movie][$tree/scenes/one.toml][--no-film]" "$out"
run "$tree/movie" --duration 1s two.toml --set start.file=x.toml
expect "scene after options" "${here}[movie][two.toml][--duration][1s][--set][start.file=x.toml]" "$out"
run "$tree/movie" missing.toml
expect "a missing scene is the program's to report" "${here}[movie][missing.toml]" "$out"

run "$tree/movie" render "$work/a run" --at 1
expect "a verb" "${here}[render][$work/a run][--at][1]" "$out"
run "$tree/movie" --no-install compare two.toml scenes/one.toml
expect "a verb's scenes are looked for likewise" "${here}[compare][two.toml][$tree/scenes/one.toml]" "$out"
expect "a verb builds too" "ninja grainreel" "$did"
rm -f "$calls.name"
run env -C "$tree" ./movie movie scenes/one.toml
expect "the program is told how it was called" "./movie" "$(<"$calls.name")"
expect "the verb movie, where the script lies" "[$tree][movie][scenes/one.toml]" "$out"
run "$tree/movie" rendr x
expect "an unknown verb is the program's to report" "${here}[rendr][x]" "$out"
touch "$work/elsewhere/check"
run "$tree/movie" check
expect "a file with a verb's name is a scene" "${here}[movie][check]" "$out"
run "$tree/movie" --help
contains "--help: the two ways" "./movie VERB ..." "$out"
contains "--help: the verbs" "${here}[--help]" "$out"
contains "--help: the film's options" "${here}[movie][--help]" "$out"
run "$tree/movie" --version
expect "--version" "${here}[--version]" "$out"
run "$tree/movie" two.toml --help
expect "--help after a scene" "${here}[movie][two.toml][--help]" "$out"

run env ABSENT="libpng-dev ninja-build" "$tree/movie"
if ((EUID == 0)); then
    contains "names what it installs" "Installing with apt: libpng-dev ninja-build" "$said"
    contains "installs only that" "install --no-install-recommends libpng-dev ninja-build" "$did"
    run env ABSENT="libosmesa6 libegl-mesa0" NOWHERE=libosmesa6 "$tree/movie"
    contains "takes the second name" "install --no-install-recommends libegl-mesa0" "$did"
    run env ABSENT=libosmesa6 "$tree/movie"
    expect "one of two names is enough" "ninja grainreel" "$did"
    run env ABSENT="libpng-dev libfmt-dev ninja-build" NOWHERE="libpng-dev libfmt-dev" "$tree/movie"
    expect "packages that are nowhere" 2 "$status"
    contains "all of them are named" "This system's package sources have none of: libfmt-dev libpng-dev" "$said"
    contains "the way out" "the archive, which needs no packages" "$said"
    expect "nothing is installed then" "" "$(grep install <<<"$did")"
    run env ABSENT=libpng-dev APT_FAILS=1 "$tree/movie"
    expect "apt fails" 2 "$status"
    contains "apt fails: the list" "libpng-dev           libpng" "$said"
    chmod -R a+rX "$work"
    run setpriv --reuid=65534 --regid=65534 --clear-groups env ABSENT=libpng-dev "$tree/movie"
fi
expect "without root" 2 "$status"
contains "without root: whom to ask for what" "apt-get install --no-install-recommends libpng-dev" "$said"
run env ABSENT=libpng-dev "$tree/movie" --no-install
expect "--no-install" "ninja grainreel" "$did"

run "$tree/test"
expect "tests are configured once" $'cmake --preset release -DGRAINREEL_TESTS=ON\nninja all\nctest --preset quick' "$did"
run "$tree/test" --all -R Name
expect "--all" $'ninja all\nctest --preset all -R Name' "$did"
run "$tree/movie"
expect "./movie keeps the tests configured" "ninja grainreel" "$did"
mv "$tree" "$tree moved"
run "$tree moved/movie"
contains "a tree that moved is configured anew" "cmake --preset release --fresh" "$did"

# What the documentation tells to type is ./movie VERB, but on the page on installed programs.
verbs=$(grep -oE 'verb\([a-z]+\)' "$repository/render/app/verbs/verbs.cpp" | sed 's/verb(\(.*\))/\1/' | paste -sd '|')
contains "the table of verbs" "movie|resume|render" "$verbs"
expect "one spelling of commands" "" \
    "$(grep -rnwE "grainreel ($verbs)" "$repository/README.md" "$repository/docs" --include=*.md --exclude=install.md)"

((failures == 0)) && echo "commands: ok"
exit $((failures > 0))
