#!/usr/bin/env bash
# What measuring costs: instructions of a run with each instrument over those of a run without any measures.
#   tests/bench/instruments.sh [GRAINREEL] [PERIODS]
# Counts instructions (valgrind, Debian's package), so a busy machine does not matter much. Each run goes on from
# one bed, and only what happens after packing counts. Half a minute a run on a quiet machine. The step chooses how
# long its lists last by the clock, so two runs of the same scene differ by 3 %; the rows of fields therefore say
# besides what the fields alone took over all else in the same run.
set -euo pipefail
root=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.." && pwd)
grainreel=${1:-$root/build/release/grainreel} periods=${2:-1}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
scene=$root/scenes/wedge_mixing.toml
duration=$(awk "BEGIN { printf \"%.9f\", $periods / 12 + 1e-6 }")
common=(--no-film --quiet --force --threads 1 --set drive.ramp=0 --set output.trajectory=false)

"$grainreel" movie "$scene" "${common[@]}" --duration 0.5 --out "$work/bed" > /dev/null

# Instructions of steps, of what instruments gather between them, and of rows and fields. Checkpoints are left
# out, which come by the clock.
instructions() {
    local out=$work/run
    rm -rf "$out"
    valgrind --tool=callgrind --callgrind-out-file="$work/calls" "$grainreel" movie "$scene" "${common[@]}" \
        --set start.method=file --set "start.file=$work/bed/checkpoint.grs" --duration "$duration" \
        --out "$out" "$@" > /dev/null 2> "$work/said" || { cat "$work/said" >&2; exit 1; }
    callgrind_annotate --inclusive=yes --threshold=100 "$work/calls" >"$work/inclusive"
    awk '/grainreel::(SimulatedBed::advance|LiveShots::serve)\(/ && !($3 in seen) {
                 seen[$3] = 1; gsub(",", "", $1); sum += $1 }
             END { printf "%.0f\n", sum }' "$work/inclusive"
}

# Of the last run, the instructions of fields over those of all else.
fields_alone() {
    awk 'match($0, /grainreel::(SimulatedBed::advance|LiveShots::serve|FieldRecord::(start|gather))\(/) {
             name = substr($0, RSTART, RLENGTH)
             if (name in seen) next
             seen[name] = 1
             gsub(",", "", $1)
             if (name ~ /FieldRecord/) fields += $1; else all += $1
         }
         END { printf "%.1f %%\n", 100 * fields / (all - fields) }' "$work/inclusive"
}

none=$(instructions --set output.measures_interval="$duration")
row() {
    local name=$1 count
    shift
    count=$(instructions "$@")
    awk "BEGIN { printf \"| %s | %.1f %% |\\n\", \"$name\", 100 * ($count / $none - 1) }"
}
echo "| measured | more instructions |"
echo "|---|---|"
row "default columns"
row "default columns and fields, \`yz\`" --set output.fields.grid=yz --set output.fields.periods=1
echo "| fields alone, \`yz\` | $(fields_alone) |"
row "default columns and fields, \`xyz\`" --set output.fields.grid=xyz --set output.fields.periods=1
echo "| fields alone, \`xyz\` | $(fields_alone) |"
for instrument in walls bed convection surface intruder outflow energy_balance; do
    row "default columns and \`$instrument\`" --set "output.instruments=[\"$instrument\"]"
done
