#!/usr/bin/env bash
# What `check` promises of a run's time against what the run takes, each shipped scene at one thread and at two.
#   tests/bench/check_estimate.sh [FOLDER [TURNS [SCENE...]]]     default: output/check-estimate, 5 turns, scenes/*.toml
# The machine is measured afresh for it. Prints a line a scene and number of threads: promised and actual (median
# of the turns, with their range), and their ratio. Exit status 1 when one is not within a factor of 1.5.
set -euo pipefail

folder=${1:-output/check-estimate}
turns=${2:-5}
cd "$(dirname "$0")/../.."
program=$PWD/build/release/grainreel
scenes=("${@:3}")
[ ${#scenes[@]} -gt 0 ] || scenes=(scenes/*.toml)
mkdir -p "$folder"
folder=$(cd "$folder" && pwd)
export XDG_CACHE_HOME=$folder/cache
rm -rf "$XDG_CACHE_HOME"

# "12.3 s", "1.5 min" or "230 ms" in seconds.
seconds() {
    awk '{ unit["s"] = 1; unit["min"] = 60; unit["h"] = 3600; unit["ms"] = 1e-3; unit["us"] = 1e-6; print $1 * unit[$2] }'
}

status=0
printf '%-24s %7s %11s %11s %19s %6s\n' scene threads 'promised/s' 'actual/s' 'range' ratio
for scene in "${scenes[@]}"; do
    name=$(basename "$scene" .toml)
    for threads in 1 2; do
        promised=$("$program" check "$scene" --threads "$threads" |
            sed -n 's/.*together about \([0-9.e+-]* [a-z]*\) on .*/\1/p' | seconds)
        taken=()
        for ((turn = 0; turn < turns; turn++)); do
            begin=$(date +%s.%N)
            "$program" movie "$scene" --threads "$threads" --out "$folder/run" --force --quiet > "$folder/run.txt"
            taken+=("$(echo "$(date +%s.%N) $begin" | awk '{ print $1 - $2 }')")
        done
        printf '%s\n' "${taken[@]}" | sort -g |
            awk -v name="$name" -v threads="$threads" -v promised="$promised" '
                { t[NR] = $1 }
                END {
                    actual = NR % 2 ? t[(NR + 1) / 2] : (t[NR / 2] + t[NR / 2 + 1]) / 2
                    ratio = promised / actual
                    printf "%-24s %7d %11.2f %11.2f %8.2f to %7.2f %6.2f\n", name, threads, promised, actual, t[1], t[NR], ratio
                    exit !(ratio >= 1 / 1.5 && ratio <= 1.5)
                }' || status=1
    done
done
exit $status
