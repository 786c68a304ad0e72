#!/usr/bin/env bash
# A bed that is packed by another engine, on this machine's ranks for a time, and drawn back in four parts:
#   tests/bench/million.sh [FOLDER] [GRAINS] [SECONDS] [RANKS] [ENGINE]
# FOLDER [output/million] is made anew. GRAINS [1000000] fall from a lattice and are shaken, as far as ENGINE
# [lammps] comes in SECONDS [600]; the job is then ended as a cluster would, by SIGTERM. Prints time and largest
# memory of each stage, the size of the files, and the engine's rate. RATE in the environment is the rate that is
# expected of all ranks together, in grain-steps a second; steps and pictures are chosen by it. Exit status 77 without
# the engine.
set -euo pipefail
root=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.." && pwd)
folder=${1:-$root/output/million} grains=${2:-1000000} seconds=${3:-600} ranks=${4:-2} engine=${5:-lammps}
movie=${BUILD:-$root/build/release}/grainreel
program=${engine/lammps/lmp}
for needed in "$program" mpirun; do
    command -v "$needed" > /dev/null || { echo "million: no $needed here (./test --peers installs it)" >&2; exit 77; }
done
[[ ! -e $folder || -e $folder/stages.txt ]] || { echo "million: $folder is something else" >&2; exit 2; }
rm -rf "$folder"
mkdir -p "$folder"
cd "$folder"
: > stages.txt

# The rates with which `check` counts (engine/handover/handover_folder.cpp), less a fifth on several ranks. Half of
# the steps are for packing, and 20 pictures for the rest. A part needs four.
one=4e6
[[ $engine == lammps ]] || one=7e6
rate=${RATE:-$(awk -v one="$one" -v r="$ranks" 'BEGIN { print r * (r > 1 ? 0.8 : 1) * one }')}
awk -v n="$grains" -v s="$seconds" -v rate="$rate" '
BEGIN {
    step = 1e-5; d = 0.003
    steps = s * rate / n
    every = int(steps / 40); if (every < 1) every = 1
    side = d * sqrt(n * 0.87 / (50 * (n / 1e6) ^ (1 / 3)) / 2)  # a bed of 50 (n/10^6)^(1/3) grains, twice as wide as deep
    printf "title = \"%d grains\"\n[[species]]\nname = \"small\"\ncount = %d\ndiameter = \"3 mm\"\ndensity = 2500\n", n, n * 0.9
    printf "[[species]]\nname = \"big\"\ncount = %d\ndiameter = \"4.5 mm\"\ndensity = 2500\n", n - int(n * 0.9)
    printf "[contact]\nlaw = \"spring-dashpot\"\nfriction_law = \"linear-spring\"\nstiffness = 2000\nrestitution = 0.7\nfriction = 0.4\n"
    printf "[container]\nshape = \"box\"\nwidth = %.6f\ndepth = %.6f\nheight = %.6f\n", 2 * side, side, 250 * d * (n / 1e6) ^ (1 / 3)
    printf "[start]\nsettle_limit = %.6g\n[drive]\nfrequency = \"20 Hz\"\ng_level = 3\n", 20 * every * step
    printf "[output]\ntrajectory_interval = %.6g\n[run]\nduration = %.6g\nstep = %.6g\n", every * step, 400 * every * step, step
    printf "[film]\nsize = \"1280x720\"\nrate = 25\n[[film.segment]]\nplayback = %.9g\n", 25 * every * step
}' > scene.toml

stage() { # NAME COMMAND...: runs it, and notes time and largest memory
    local name=$1 status=0
    shift
    /usr/bin/time -f "%e %M" -o time.txt "$@" > /dev/null 2> "$name.txt" || status=$?
    tail -n 1 time.txt | awk -v name="$name" -v status="$status" \
        '{ printf "%-10s %8.1f s %8.0f MB%s\n", name, $1, $2 / 1024, status ? "  (exit status " status ")" : "" }' | tee -a stages.txt
    return "$status"
}

# The largest memory of each of the engine's processes, while they run.
watch_ranks() {
    local process
    while sleep 1; do
        for process in $(pgrep -x "$program"); do
            [[ $(readlink "/proc/$process/cwd") != "$folder/job" ]] ||
                awk -v process="$process" '/VmHWM/ { print process, $2 / 1024 }' "/proc/$process/status"
        done
    done 2> /dev/null >> ranks.txt
}

folder=$PWD
stage handover "$movie" handover scene.toml --to "$engine" --ranks "$ranks" --pack-there $((grains - 1)) --out job
watch_ranks &
watch=$!
trap 'kill "$watch"' EXIT
stage run timeout -s TERM "$seconds" sh job/run.sh || (($? == 124))
awk '{ most[$1] = $2 } END { for (rank in most) printf "  a process: %.0f MB\n", most[rank] }' ranks.txt | tee -a stages.txt
grep -E "Lost|ERROR" job/out.* >&2 || true
moments=$(grep -c TIMESTEP job/*.dump) || { echo "million: it never came past the packing; more SECONDS or a lower RATE" >&2; exit 1; }
((moments > 16)) || { echo "million: $moments moments are too few for four parts; more SECONDS or a lower RATE" >&2; exit 1; }
for part in 1 2 3 4; do stage "part-$part" "$movie" render job --part "$part/4" --out "part-$part"; done
stage join "$movie" join part-1 part-2 part-3 part-4 --out film.mp4

{
    echo "job.status $(cat job/job.status)"
    du -m --apparent-size job/*.dump job/trajectory.nc film.mp4 | sed 's/\t/ MB /'
    # thermo_style custom step atoms ke cpu: the last row counts, and cpu begins anew with each run of the deck.
    awk -v n="$grains" '/^ *[0-9]+ +[0-9]+ +[-+.e0-9]+ +[.0-9]+ *$/ {
            if ($4 < cpu) { from = $1; all += cpu; steps += last - begin; begin = $1 }
            cpu = $4; last = $1
        }
        END {
            steps += last - begin; all += cpu
            printf "%d steps in %.1f s: %.2f M grain-steps/s\n", steps, all, (all > 0 ? steps * n / all / 1e6 : 0)
        }' job/log.*
    grep -h '^took' part-*.txt
} | tee -a stages.txt
