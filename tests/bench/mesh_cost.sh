#!/usr/bin/env bash
# What walls of triangles cost: instructions of a step in a box of planes, and in the same box as a mesh of 12, 1,200 and
# 10,092 triangles; 10,000 grains at rest and shaken with Gamma = 2.
#   tests/bench/mesh_cost.sh [GRAINREEL] [STEPS]
# Counts instructions (valgrind, Debian's package), so a busy machine does not matter much; all runs go on from one bed.
# The step chooses how long its lists last by the clock, so two runs of the same scene differ by up to 3 %.
set -euo pipefail
root=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.." && pwd)
grainreel=${1:-$root/build/release/grainreel} steps=${2:-400}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
step=1e-5
scene() { # CONTAINER
    cat << END
[[species]]
name = "grain"
count = 10000
diameter = { min = "2.8 mm", max = "3.2 mm" }
density = 2500
[contact]
stiffness = 5000
restitution = 0.6
friction = 0.5
$1
[drive]
frequency = 20
g_level = 2
ramp = 0
[run]
step = $step
duration = 1
[output]
trajectory = false
END
}
planes='[container]
shape = "box"
width = 0.08
depth = 0.08
height = 0.12'
scene "$planes" > "$work/planes.toml"
for cells in 1 10 29; do
    python3 "$root/scenes/meshes/make_meshes.py" box "$work/box$cells.stl" width=0.08 depth=0.08 height=0.12 cells=$cells
    scene "[container]
shape = \"mesh\"
mesh = \"box\"
[[mesh]]
name = \"box\"
file = \"box$cells.stl\"" > "$work/mesh$cells.toml"
done
"$grainreel" movie "$work/planes.toml" --no-film --no-report --quiet --duration 0.0001 --out "$work/bed" > /dev/null
cp "$work/bed/final.csv" "$work/bed.csv"

instructions() { # SCENE OPTIONS...
    local scene=$1
    shift
    rm -rf "$work/run"
    valgrind --tool=callgrind --callgrind-out-file="$work/calls" "$grainreel" movie "$work/$scene.toml" --no-film \
        --no-report --quiet --threads 1 --set start.method=file --set start.file=bed.csv \
        --duration "$(awk "BEGIN { print $steps * $step }")" --out "$work/run" "$@" > /dev/null 2> "$work/said" ||
        { cat "$work/said" >&2; exit 1; }
    callgrind_annotate --inclusive=yes --threshold=100 "$work/calls" |
        awk '/grainreel::SimulatedBed::advance\(/ && !found++ { gsub(",", "", $1); print $1 }'
}
echo "| bed | planes, instructions a grain-step | 12 triangles | 1,200 | 10,092 |"
echo "|---|---|---|---|---|"
row() { # NAME OPTIONS...
    local name=$1 base
    shift
    base=$(instructions planes "$@")
    printf '| %s | %.0f' "$name" "$(awk "BEGIN { print $base / $steps / 10000 }")"
    for cells in 1 10 29; do
        printf ' | %s' "$(awk "BEGIN { printf \"%+.1f %%\", 100 * ($(instructions "mesh$cells" "$@") / $base - 1) }")"
    done
    echo " |"
}
row "at rest" --set drive.g_level=0.001
row "shaken, Γ = 2"
