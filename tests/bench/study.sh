#!/usr/bin/env bash
# What a study's members reach side by side against as many `bench` processes, in turns on the hopper of the default
# film, one thread each:
#   tests/bench/study.sh [FOLDER [TURNS]]        default: output/study-speed, 5 turns of a quarter of a minute
# A turn: two benches at a time; then a study of two members of the bench's scene for as many steps as the bench
# vibrates. Prints million particle-steps/s of both and their ratio, and the median of the ratios. A member's speed is
# that of its whole time after packing, files and measures included, and is multiplied by the share of the study's time
# that its longer member fills: starting processes, tables, charts and the page count. That one of the two members has
# a shorter packing and leaves its processor idle does not.
set -euo pipefail
root=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.." && pwd)
program=${PROGRAM:-$root/build/release/grainreel}
folder=${1:-$root/output/study-speed} turns=${2:-5}
mkdir -p "$folder" && cd "$folder"

sed -n '/R"(title/,/^)";/p' "$root/engine/lab/bench/bench_case.cpp" | sed '1s/.*R"(//; $d' >wedge.toml
step=$("$program" check wedge.toml 2>/dev/null | awk '$1 == "step" { print $2 * ($3 ~ /^us|^µs/ ? 1e-6 : $3 ~ /^ns/ ? 1e-9 : 1e-3) }')
cat >study.toml <<STUDY
scene = "wedge.toml"
seeds = 2
set = ["run.duration=$(awk "BEGIN { print 40000 * $step }") s"]
[[measure]]
column = "kinetic"
reduce = "mean"
STUDY

benches() {  # million particle-steps/s, both together
    "$program" bench wedge --threads 1 --json >one.json 2>/dev/null &
    "$program" bench wedge --threads 1 --json >two.json 2>/dev/null
    wait
    cat one.json two.json | awk -F'[:,]' '/"name"/ { name = $2 } /"particle_steps_per_s"/ && name ~ /vibrated/ { sum += $2 }
        END { print sum / 1e6 }'
}

study() {  # likewise
    rm -rf run
    local begin end
    begin=$(date +%s.%N)
    "$program" study study.toml --out run --jobs 2 --no-posters --quiet >/dev/null
    end=$(date +%s.%N)
    python3 - "$begin" "$end" <<'SPEED'
import glob, json, sys
wall, speed, filled = float(sys.argv[2]) - float(sys.argv[1]), 0, 0
for path in glob.glob("run/members/*/run.json"):
    run = json.load(open(path))
    engine, times = run["engine"], run["wall_s"]
    speed += engine["grains"] * engine["steps"] / (times["total"] - times["packing"])
    filled = max(filled, times["total"])
print(speed * filled / wall / 1e6)
SPEED
}

for ((turn = 1; turn <= turns; ++turn)); do
    b=$(benches) s=$(study)
    awk "BEGIN { printf \"turn %d: benches %.2f, study %.2f, ratio %.3f\n\", $turn, $b, $s, $s / $b }"
done | tee turns.txt
awk '{ r[NR] = $NF } END { for (i = 2; i <= NR; ++i) for (j = i; j > 1 && r[j] < r[j - 1]; --j) { t = r[j]; r[j] = r[j - 1]; r[j - 1] = t }
    printf "median of the ratios %.3f\n", (r[int((NR + 1) / 2)] + r[int(NR / 2) + 1]) / 2 }' turns.txt
