#!/usr/bin/env bash
# The peers' bed on one thread and on two, in turn, and how far apart the two processors are before and after
# each run (ns until one sees what the other wrote), which decides what two threads gain:
#   tests/bench/threads.sh [FOLDER] [ROUNDS] [PARTICLES]
# Writes speeds.csv into FOLDER [output/threads], in million grain-steps a second, and ratios.txt: for each phase
# the medians over ROUNDS [7], with that of the rounds' own ratios and its range, over all rounds and over those
# whose processors were near, less than 100 ns apart before and after the run on two. A round of 10,125 grains
# takes half a minute.
set -euo pipefail
root=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.." && pwd)
folder=${1:-$root/output/threads} rounds=${2:-7} particles=${3:-}
build=${BUILD:-$root/build/release}
cmake --build "$build" --target apart grainreel > /dev/null
mkdir -p "$folder"
cd "$folder"

timed() { # THREADS ROUND
    local before after
    before=$("$build/tests/apart")
    "$build/grainreel" bench bed10k ${particles:+--particles "$particles"} --threads "$1" --json > run.json 2> /dev/null
    after=$("$build/tests/apart")
    awk -F'[:,]' -v threads="$1" -v round="$2" -v apart="$before,$after" '
        /"name"/ { gsub(/[ "]/, "", $2); phase = $2 }
        /"particle_steps_per_s"/ { printf "%s,%s,%s,%s,%.3f\n", round, threads, apart, phase, $2 / 1e6 }' run.json
}

echo "round,threads,ns_apart_before,ns_apart_after,phase,million_grain_steps_per_s" > speeds.csv
for ((round = 1; round <= rounds; ++round)); do
    for threads in 1 2; do timed "$threads" "$round"; done | tee -a speeds.csv
done
rm run.json

awk -F, 'function sort(a, n,   i, j, t) {
        for (i = 2; i <= n; ++i) for (j = i; j > 1 && a[j] < a[j - 1]; --j) { t = a[j]; a[j] = a[j - 1]; a[j - 1] = t }
    }
    function median(a, n) { return (a[int((n + 1) / 2)] + a[int(n / 2) + 1]) / 2 }
    NR > 1 { speed[$2, $5, $1] = $6; rounds = $1; if ($2 == 2 && ($3 >= 100 || $4 >= 100)) far[$1] = 1 }
    END {
        split("settled rising vibrated", phase, " ")
        for (near = 0; near <= 1; ++near) for (f = 1; f <= 3; ++f) {
            n = 0
            for (r = 1; r <= rounds; ++r) {
                if (near && (r in far)) continue
                one[++n] = speed[1, phase[f], r]; two[n] = speed[2, phase[f], r]; ratio[n] = two[n] / one[n]
            }
            if (n == 0) { print "near: no round"; break }
            sort(one, n); sort(two, n); sort(ratio, n)
            printf "%-5s %-9s %3d rounds  1: %6.1f  2: %6.1f  ratio %.2f (%.2f to %.2f)\n", near ? "near" : "all",
                phase[f], n, median(one, n), median(two, n), median(ratio, n), ratio[1], ratio[n]
        }
    }' speeds.csv | tee ratios.txt
