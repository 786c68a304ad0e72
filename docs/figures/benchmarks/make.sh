#!/usr/bin/env bash
# Draws this folder's charts and pictures from runs of tests/bench/eight_codes.py, which it makes where they are not there.
#   docs/figures/benchmarks/make.sh DATA [GRAINREEL] [FOLDER FOR RUNS] [CASE...]
# DATA: the benchmark's inputs and published results. Cases are impact, drum_soft and silo_soft if none are named (half an hour
# of one processor). Needs gnuplot.
set -euo pipefail
root=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../../.." && pwd)
data=$1 grainreel=${2:-$root/build/release/grainreel} work=${3:-$root/output/eight_codes}
shift $(($# < 3 ? $# : 3))
here=$root/docs/figures/benchmarks
still() { # CASE OPTIONS...
    local name=$1
    shift
    "$grainreel" render "$work/$name/run" --quiet --force --out "$here/$name.png" --set film.plot=[] "$@" > /dev/null
}
for case in ${*:-impact drum_soft silo_soft}; do
    python3 "$root/tests/bench/eight_codes.py" "$grainreel" "$data" "$case" --threads 1 --out "$work" || [ $? = 1 ]
    cp "$work/$case/$case.svg" "$here"
    case $case in
        impact) still impact --at 0.0235 --size 560x640 --set film.cut.normal=[1,0,0] --set film.camera.azimuth=0 \
            --set film.camera.elevation=5 --set film.camera.reach=0.09 --set species.ball.colour=grey \
            --set film.colour.by=speed ;;
        drum*) still "$case" --at 0.5 --size 640x640 --set film.camera.azimuth=-90 --set film.camera.elevation=8 ;;
        silo*) still "$case" --at 0.5 --size 560x720 --set film.cut.normal=[1,0,0] --set film.camera.azimuth=0 \
            --set film.colour.by=speed ;;
    esac
done
