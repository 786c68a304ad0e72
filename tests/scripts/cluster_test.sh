#!/usr/bin/env bash
# The script and the commands of docs/guide/clusters.md, as they stand there: a study whose members run as an array
# of a stand-in for sbatch, or by GNU parallel where that is installed; and the script of render --slurm. $1: the program.
set -euo pipefail
program=$1
guide=$(cd "$(dirname "$0")/../.." && pwd)/docs/guide/clusters.md
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT
mkdir "$work/bin" "$work/a folder"
cd "$work/a folder"

# ./movie as the guide types it.
printf '#!/bin/bash\nexec %q "$@"\n' "$program" >movie && chmod 755 movie
# The tasks of --array=1-N one after another, each as Slurm starts it: with its number, in the folder of sbatch.
cat >"$work/bin/sbatch" <<'STAND_IN'
#!/bin/bash
while [[ ${1:-} == --* ]]; do
    [[ $1 == --array=1-* ]] && last=${1#--array=1-}
    [[ $1 == --parsable ]] && echo 4711
    shift
done
for ((task = 1; task <= ${last:-0}; ++task)); do SLURM_ARRAY_TASK_ID=$task bash "$@" >&2 || exit 1; done
[[ ${last:-} ]] || exec bash "$@"
echo "$last tasks" >>"$CALLS"
STAND_IN
chmod 755 "$work/bin/sbatch"

# The block of the guide that has this line.
block_with() {
    awk -v wanted="$1" '/^```sh/ { inside = 1; text = ""; next }
        /^```/ { if (inside && index(text, wanted)) printf "%s", text; inside = 0 }
        inside { text = text $0 "\n" }' "$guide"
}
# The study's folder of the guide is one of ours.
commands() { block_with "$1" | sed "s|/data/nut|$work/out $2|; s|--out \([^-]*[^- ]\)|--out '\1'|"; }

expect() {  # what, wanted, got
    [[ $2 == "$3" ]] && return
    printf 'FAILED %s\n  wanted: %s\n  got:    %s\n' "$1" "$2" "$3"
    exit 1
}
states() { cut -d, -f3 "$1/study.csv" | sort | uniq -c | tr -s ' \n' ' '; }

cat >scene.toml <<'SCENE'
[[species]]
name = "ball"
count = 30
diameter = "4 mm"
density = "2.5 g/cm3"
[contact]
restitution = 0.7
[container]
shape = "box"
width = "20 mm"
depth = "20 mm"
height = "30 mm"
[drive]
frequency = "20 Hz"
g_level = 2
[run]
duration = "0.05 s"
overlap = 0.05
SCENE
cat >study.toml <<'STUDY'
scene = "scene.toml"
seeds = 2
[[vary]]
key = "drive.g_level"
values = [2, 3]
[[measure]]
column = "kinetic"
reduce = "end"
STUDY

block_with SLURM_ARRAY_TASK_ID >member.sh
CALLS=$work/calls PATH=$work/bin:$PATH bash -euo pipefail <(commands "sbatch --wait" slurm) >/dev/null 2>"$work/said"
expect "the array's tasks" "4 tasks" "$(cat "$work/calls")"
expect "Slurm: all members" " 4 complete 1 state " "$(states "$work/out slurm")"

if command -v parallel >/dev/null; then
    bash -euo pipefail <(commands "| parallel" parallel) >/dev/null 2>"$work/said"
    expect "GNU parallel: all members" " 4 complete 1 state " "$(states "$work/out parallel")"
    expect "the same numbers" "$(cut -d, -f1-4 "$work/out slurm/study.csv")" "$(cut -d, -f1-4 "$work/out parallel/study.csv")"
else
    echo "GNU parallel is not installed and not tested"
fi
# A film in parts, by the script of the guide's section on that.
"$program" movie scene.toml --no-film --no-report --out "a run" >/dev/null 2>&1
drawn=("a run" --fps 240 --size 160x120 --title "Don't stop")
"$program" render "${drawn[@]}" --slurm 2 --out "two parts.mp4" >film.slurm.sh
"$program" render "${drawn[@]}" --parts 2 --out "in one go" >/dev/null 2>&1
CALLS=$work/calls PATH=$work/bin:$PATH bash film.slurm.sh >/dev/null 2>"$work/said"
expect "the parts' tasks" "2 tasks" "$(tail -1 "$work/calls")"
cmp "two parts.mp4" "in one go/movie.mp4" || exit 1
echo "clusters: ok"
