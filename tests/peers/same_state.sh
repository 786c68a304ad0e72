#!/usr/bin/env bash
# LAMMPS (`lmp`, Debian's package lammps) and this engine from one state of the peers' bed, written with %.17g:
#   tests/peers/same_state.sh [FOLDER] [SEEDS]
# 1. LAMMPS lets the bed fall for 0.03 s; from there both run on. With LAMMPS' conventions every grain must be
#    where LAMMPS has it within 1e-9 m at step 100; how far our own scheme has gone by then is charted.
# 2. Both let the bed settle, from SEEDS [3] lattices: mean height and contacts a grain with their scatter.
# Exit status: 0, 1 when step 100 differs by more, 77 without lmp.
set -euo pipefail
root=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.." && pwd)
folder=${1:-$root/output/same_state} seeds=${2:-3}
source "$root/tests/peers/lammps_bed.sh"
build=${BUILD:-$root/build/release}
command -v lmp > /dev/null || { echo "same_state: no lmp here; apt-get install lammps" >&2; exit 77; }
cmake --build "$build" --target same_state > /dev/null
ours=$build/tests/same_state
mkdir -p "$folder"
cd "$folder"

run() {
    lmp -log none -screen none -in "$1" ||
        { echo "same_state: lmp failed on $folder/$1; run it by hand to see why" >&2; exit 1; }
}
columns='id type x y z vx vy vz omegax omegay omegaz'

"$ours" lattice 7 lattice.data
{ lammps_bed lattice.data; echo "run 15000
write_dump all custom falling.dump $columns modify format float %.17g"; } > fall.lammps
run fall.lammps
"$ours" state falling.dump state.data
{ lammps_bed state.data; echo "dump d all custom 20 run.dump $columns
dump_modify d format float %.17g
run 400"; } > run.lammps
run run.lammps
"$ours" compare run.dump divergence.csv

cat > divergence.gp << 'END'
set datafile separator ','
set terminal svg size 760,420 font 'DejaVu Sans,14' background 'white'
set output 'divergence.svg'
set xlabel 'step of 2 µs'
set ylabel 'largest distance of a grain, m'
set logscale y
set format y '10^{%L}'
set grid
set key outside top center horizontal
plot 'divergence.csv' every ::1 using 1:2 with linespoints lw 2 title "with LAMMPS' conventions", \
     '' every ::1 using 1:3 with linespoints lw 2 title 'our own scheme'
END
gnuplot divergence.gp || echo "same_state: gnuplot is missing, so no picture" >&2

echo "seed,lammps_height_m,lammps_contacts,our_height_m,our_contacts" > settled.csv
for ((seed = 1; seed <= seeds; ++seed)); do
    "$ours" lattice "$seed" "lattice$seed.data"
    { lammps_bed "lattice$seed.data"; echo "compute one all contact/atom
compute contacts all reduce ave c_one
compute height all reduce ave z
fix mean all ave/time 1000 10 60000 c_height c_contacts file settled$seed.txt
run 60000"; } > settle.lammps
    run settle.lammps
    read -r _ height contacts < <(grep -v '^#' "settled$seed.txt" | tail -1)
    read -r our_height our_contacts < <("$ours" settle "$seed" 60000)
    echo "$seed,$height,$contacts,$our_height,$our_contacts" | tee -a settled.csv
done

awk -F, '$1 == 100 { found = 1; if ($2 > 1e-9) bad = 1 }
         END { if (!found || bad) { print "same_state: step 100 differs by more than 1e-9 m"; exit 1 } }' divergence.csv
