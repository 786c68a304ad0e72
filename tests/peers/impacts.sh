#!/usr/bin/env bash
# How far LAMMPS (Debian's package lammps) is off in one head-on impact, and what a contact costs it, for the
# chart of accuracy against cost:
#   tests/peers/impacts.sh [FOLDER]
# Writes peers.csv into FOLDER [docs/accuracy], in the columns of contacts.csv: of the spring-dashpot the
# largest error of the restitution over 200 phases of the first touch, where exp(-gamma t / 2) is exact, and ns
# of one thread for a contact's forces: of 8,000 spheres with friction in a cubic lattice, six contacts each.
# Exit status 77 without lmp.
set -euo pipefail
root=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.." && pwd)
folder=${1:-$root/docs/accuracy}
command -v lmp > /dev/null || { echo "impacts: no lmp here (apt-get install lammps)" >&2; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
pairs=200 diameter=0.004 density=2500 speed=0.1 duration=1e-4 # s, of a contact

lammps() { # INPUT: runs it, shows what went wrong
    (cd "$work" && lmp -log none -in "$1" > "$1.out" 2>&1) || { tail -5 "$work/$1.out" >&2; exit 1; }
}

# kn and gamma of a pair whose contact lasts `duration` and keeps e; a step's length.
law() { # E FORCES
    awk -v e="$1" -v n="$2" -v d=$diameter -v rho=$density -v t=$duration 'BEGIN {
        pi = atan2(0, -1); m = rho * pi * d ^ 3 / 6 / 2; half = -log(e) / t
        printf "%.17g %.17g %.17g\n", m * ((pi / t) ^ 2 + half ^ 2), 2 * half, t / n }'
}

cost() { # ns of a contact's forces
    cat > "$work/lattice.in" << END
units si
atom_style sphere
boundary p p p
newton off
comm_modify vel yes
lattice sc 0.0039996
region all block 0 20 0 20 0 20
create_box 1 all
create_atoms 1 box
set atom * diameter $diameter density $density
neighbor 0.0004 bin
pair_style gran/hooke/history 1e5 285.7 2634 1317 0.5 1
pair_coeff * *
timestep 1e-7
fix i all nve/sphere
run 100
run 1000
END
    lammps lattice.in
    awk '/^Loop time of/ { ns = $4 / $9 / (3 * $12) * 1e9 } END { print ns }' "$work/lattice.in.out"
}

error() { # E FORCES: the largest over all pairs
    read -r stiffness damping step < <(law "$1" "$2")
    awk -v n=$pairs -v d=$diameter -v rho=$density -v v=$speed -v dt="$step" 'BEGIN {
        printf "pairs\n\n%d atoms\n1 atom types\n\n-0.02 0.02 xlo xhi\n-0.01 %.17g ylo yhi\n-0.01 0.01 zlo zhi\n\nAtoms\n\n", 2 * n, n * 3 * d + 0.01
        for (k = 0; k < n; ++k) {  # between one and two steps before they touch
            x = d / 2 + v * dt * (1 + k / n) / 2
            printf "%d 1 %.17g %.17g %.17g %.17g 0\n%d 1 %.17g %.17g %.17g %.17g 0\n", 2 * k + 1, d, rho, -x, k * 3 * d, 2 * k + 2, d, rho, x, k * 3 * d
        }
        printf "\nVelocities\n\n"
        for (k = 1; k <= 2 * n; ++k) printf "%d %.17g 0 0 0 0 0\n", k, k % 2 ? v / 2 : -v / 2
    }' > "$work/pairs.data"
    cat > "$work/pairs.in" << END
units si
atom_style sphere
boundary f f f
newton off
comm_modify vel yes
read_data pairs.data
neighbor 0.0005 bin
pair_style gran/hooke/history $stiffness 0 $damping 0 0 0
pair_coeff * *
timestep $step
fix i all nve/sphere
run $(($2 * 2 + 6))
dump end all custom 1 end.txt id vx x
dump_modify end sort id format float %.17g
run 0
END
    lammps pairs.in
    awk -v e="$1" -v v=$speed -v d=$diameter '
        seen && $1 % 2 { left = $2; from = $3 }
        seen && $1 % 2 == 0 {
            if ($3 - from < d) { print "impacts: a pair has not parted" > "/dev/stderr"; exit 1 }
            off = ($2 - left) / v - e; if (off < 0) off = -off
            if (off > most) most = off; ++count
        }
        /^ITEM: ATOMS/ { seen = 1 }
        END { if (count != '$pairs') { print "impacts: " count " pairs of '$pairs'" > "/dev/stderr"; exit 1 } print most }' "$work/end.txt"
}

ns=$(cost)
echo "method,error,e,forces,ns,value" > "$work/peers.csv"
for e in 0.9 0.3; do
    for forces in 6 8 12 16 24 32 48 64 96; do
        printf 'LAMMPS,restitution,%s,%s,%s,%s\n' "$e" "$forces" "$(awk -v a="$ns" -v b="$forces" 'BEGIN { print a * b }')" \
            "$(error "$e" "$forces")" >> "$work/peers.csv"
    done
done
mkdir -p "$folder"
cp "$work/peers.csv" "$folder/peers.csv"
cat "$folder/peers.csv"
