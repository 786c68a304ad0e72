#!/usr/bin/env bash
# How far LAMMPS (`lmp`) and LIGGGHTS (`liggghts`) are off in the restitution of a normal impact, and what a contact
# costs them, for the chart of docs/accuracy.md:
#   tests/peers/impacts.sh [CSV]
# Two hundred pairs of spheres meet head on, at as many phases of the step; linear spring and dashpot, as the peers' bed
# has it. The cost is that of a lattice of 8,000 spheres with six contacts each, best of five: `chart accuracy` measures
# ours alike. Writes engine,error,e,forces,ns,value; exit status 77 without lmp and liggghts.
set -euo pipefail
csv=$(readlink -f "${1:-/dev/stdout}")
work=$(mktemp -d)
trap 'rm -r "$work"' EXIT
cd "$work"
radius=0.002 density=2500 stiffness=1e5 speed=0.1 phases=200

# The pairs, or the lattice, as a data file that both read.
pairs() { # STEP
    awk -v r=$radius -v rho=$density -v v=$speed -v n=$phases -v dt="$1" 'BEGIN {
        print "pairs\n\n" 2 * n " atoms\n1 atom types\n-1 1 xlo xhi\n-1 " 20 * r * n " ylo yhi\n-1 1 zlo zhi\n\nAtoms\n"
        for (k = 0; k < n; ++k) for (s = -1; s < 2; s += 2)
            printf "%d 1 %.17g %g %.17g %.17g 0\n", 2 * k + (s + 3) / 2, 2 * r, rho,
                   s * (r + 0.5 * v * dt * (k + 0.5) / n), 20 * r * k
        print "\nVelocities\n"
        for (k = 0; k < n; ++k) for (s = -1; s < 2; s += 2)
            printf "%d %.17g 0 0 0 0 0\n", 2 * k + (s + 3) / 2, -s * v / 2 }'
}
lattice() {
    awk -v r=$radius -v rho=$density 'BEGIN {
        a = 2 * r * (1 - 1e-4); n = 20
        print "lattice\n\n" n ^ 3 " atoms\n1 atom types\n-1 1 xlo xhi\n-1 1 ylo yhi\n-1 1 zlo zhi\n\nAtoms\n"
        for (x = 0; x < n; ++x) for (y = 0; y < n; ++y) for (z = 0; z < n; ++z)
            printf "%d 1 %.17g %g %.17g %.17g %.17g\n", ++id, 2 * r, rho, a * x, a * y, a * z }'
}
deck() { # ENGINE DATA STEP DAMPING FRICTION
    local same="boundary f f f
newton off
read_data $2
neighbor 0.0004 bin
neigh_modify delay 0 every 10 check yes"
    if [[ $1 == lmp ]]; then
        echo "units si
atom_style sphere
comm_modify vel yes
$same
pair_style gran/hooke/history $stiffness $stiffness $4 $4 $5 1"
    else
        echo "units si
atom_style granular
atom_modify map array
communicate single vel yes
$same
fix m1 all property/global kn peratomtypepair 1 $stiffness
fix m2 all property/global kt peratomtypepair 1 $stiffness
fix m3 all property/global gamman peratomtypepair 1 $4
fix m4 all property/global gammat peratomtypepair 1 $4
fix m5 all property/global coefficientFriction peratomtypepair 1 $5
pair_style gran model hooke/stiffness tangential history absolute_damping off"
    fi
    echo "pair_coeff * *
timestep $3
fix i all nve/sphere"
}
cost() { # ENGINE: ns
    lattice > lattice.data
    { deck "$1" lattice.data 1e-9 100 0.5; for run in 1 2 3 4 5; do echo "run 200"; done; } > "cost.$1"
    "$1" -log none -in "cost.$1" | awk '/^Loop time of/ { ns = $4 * 1e9 / $9 / (3 * 20 * 20 * 19)
        if (best == 0 || ns < best) best = ns } END { printf "%.2f", best }'
}
# Of e with the damping that gives it: gamma = 2 b w, b the share of critical damping, w = sqrt(k / m_eff).
restitution() { # ENGINE E FORCES: largest error
    read -r step damping < <(awk -v e="$2" -v f="$3" -v r=$radius -v rho=$density -v k=$stiffness 'BEGIN {
        pi = atan2(0, -1); m = rho * 4 / 3 * pi * r ^ 3 / 2; w = sqrt(k / m)
        b = -log(e) / sqrt(pi ^ 2 + log(e) ^ 2)
        printf "%.17g %.17g\n", pi / (w * sqrt(1 - b ^ 2)) / f, 2 * b * w }')
    pairs "$step" > pairs.data
    local steps=$((2 * $3 + 10))
    { deck "$1" pairs.data "$step" "$damping" 0
      echo "dump d all custom $steps end.txt id vx"
      [[ $1 == lmp ]] && echo "dump_modify d format float %.15g"
      echo "run $steps"; } > "impact.$1"
    rm -f end.txt
    "$1" -log none -in "impact.$1" > impact.out
    awk -v e="$2" -v v=$speed '/^ITEM: TIMESTEP/ { on = 0; worst = 0 } on { x = $2 < 0 ? -$2 : $2; d = 2 * x / v - e
        if (d < 0) d = -d; if (d > worst) worst = d } /^ITEM: ATOMS/ { on = 1 } END { printf "%.6g", worst }' end.txt
}

{
    echo "engine,error,e,forces,ns,value"
    found=0
    for engine in lmp liggghts; do
        command -v $engine > /dev/null || { echo "impacts: no $engine here" >&2; continue; }
        found=1
        name=LAMMPS
        [[ $engine == liggghts ]] && name=LIGGGHTS
        ns=$(cost $engine)
        for e in 0.3 0.9; do
            for forces in 8 12 20 40 80; do
                echo "$name,restitution,$e,$forces,$(awk "BEGIN { print $ns * $forces }"),$(restitution $engine $e $forces)"
            done
        done
    done
    ((found)) || exit 77
} > peers.csv
cat peers.csv > "$csv"
