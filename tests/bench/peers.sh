#!/usr/bin/env bash
# LAMMPS (`lmp`, Debian's package lammps), LIGGGHTS (`liggghts`) and this engine on the peers' bed, from one
# lattice, in turn on one thread, so that a machine's moods hit all alike:
#   tests/bench/peers.sh [FOLDER] [ROUNDS]
# Writes speeds.csv into FOLDER [output/peers], in million grain-steps a second, and ratios.txt: each ratio's
# median over ROUNDS [3] and its range.
# LIGGGHTS takes part in the first round alone, and the Walton-Braun case. A round takes about 5 minutes, the first 8.
# Exit status 77 without lmp and liggghts.
set -euo pipefail
root=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.." && pwd)
folder=${1:-$root/output/peers} rounds=${2:-3}
build=${BUILD:-$root/build/release}
source "$root/tests/peers/lammps_bed.sh"
settle=${SETTLE:-60000} rise=10000 shake=20000 # steps
peers=()
for peer in lmp liggghts; do
    if command -v "$peer" > /dev/null; then
        peers+=("$peer")
    else
        echo "peers: no $peer here (apt-get install ${peer/lmp/lammps}); going on without" >&2
    fi
done
((${#peers[@]})) || exit 77
cmake --build "$build" --target same_state grainreel > /dev/null
mkdir -p "$folder"
cd "$folder"
"$build/tests/same_state" lattice 7 lattice.data

{ lammps_bed lattice.data; cat << END; } > bed.lmp
run $settle
unfix zw
fix zw all wall/gran hooke/history 1000 285.7 2634 1317 0.5 1 zplane 0 NULL wiggle z 0.00119 0.04
run $rise
run $shake
END
wall() { echo "fix $1 all wall/gran model hooke/stiffness tangential history primitive type 1 $2"; }
same() { echo "fix $1 all property/global $2 peratomtypepair 2 $3 $3 $3 $3"; }
# LIGGGHTS moves meshes only: a floor of two triangles. Its A (cos(w t + pi) - cos(pi)) is LAMMPS' A (1 - cos(w t)).
facet() { printf 'facet normal 0 0 1\nouter loop\nvertex -0.001 -0.001 0\nvertex %s\nvertex %s\nendloop\nendfacet\n' "$1" "$2"; }
{ echo "solid floor"; facet '0.021 -0.001 0' '0.021 0.021 0'; facet '0.021 0.021 0' '-0.001 0.021 0'; echo "endsolid floor"; } > floor.stl
cat > bed.liggghts << END
units si
atom_style granular
atom_modify map array
boundary f f f
newton off
communicate single vel yes
read_data lattice.data
neighbor 0.0002 bin
neigh_modify delay 0 every 10 check yes
$(same m1 kn 1000)
$(same m2 kt 285.7)
$(same m3 gamman 2634)
$(same m4 gammat 1317)
$(same m5 coefficientFriction 0.5)
pair_style gran model hooke/stiffness tangential history absolute_damping off
pair_coeff * *
timestep 2e-6
fix g all gravity 9.81 vector 0 0 -1
$(wall x1 'xplane 0')
$(wall x2 'xplane 0.02')
$(wall y1 'yplane 0')
$(wall y2 'yplane 0.02')
fix floor all mesh/surface file floor.stl type 1 curvature 1e-5
fix z1 all wall/gran model hooke/stiffness tangential history mesh n_meshes 1 meshes floor
fix i all nve/sphere
run $settle
fix shake all move/mesh mesh floor viblin axis 0. 0. 1. order 1 amplitude 0.00119 phase 3.14159265358979 period 0.04
run $rise
run $shake
END

# Both print "Loop time of SECONDS on 1 procs for STEPS steps with ATOMS atoms" after each run.
peer() { # NAME ROUND
    local name=$1
    "$name" -log none -in "bed.$name" > "$name.out" 2>&1 ||
        { echo "peers: $name failed; see $folder/$name.out" >&2; exit 1; }
    awk -v name="$name" -v round="$2" 'BEGIN { split("settled rising vibrated", phase) }
        /^Loop time of/ { printf "%s,%s,%s,%.3f\n", round, name, phase[++n], $9 * $12 / $4 / 1e6 }' "$name.out"
}
ours() { # CASE PRECISION ROUND
    "$build/grainreel" bench "$1" --precision "$2" --threads 1 --json 2> /dev/null |
        awk -F'[:,]' -v name="$1 $2" -v round="$3" '
            /"name"/ { gsub(/[ "]/, "", $2); phase = $2 }
            /"particle_steps_per_s"/ { printf "%s,%s,%s,%.3f\n", round, name, phase, $2 / 1e6 }'
}

echo "round,engine,phase,million_grain_steps_per_s" > speeds.csv
for ((round = 1; round <= rounds; ++round)); do
    {
        for peer in "${peers[@]}"; do
            if [[ $peer == lmp ]] || ((round == 1)); then peer "$peer" "$round"; fi
        done
        ours bed10k double "$round"
        ours bed10k mixed "$round"
        if ((round == 1)); then ours bed10k-walton-braun double "$round"; fi
    } | tee -a speeds.csv
done

# Every engine against every peer, phase by phase, from the rounds' own pairs.
awk -F, 'NR > 1 { speed[$2, $3, $1] = $4; if (!($2 in seen)) { seen[$2] = 1; engine[++engines] = $2 }
                  if ($1 > rounds) rounds = $1 }
    END {
        split("settled rising vibrated", phase, " ")
        for (e = 1; e <= engines; ++e) for (p = 1; p <= engines; ++p) {
            if (engine[e] ~ /^(lmp|liggghts)$/ || engine[p] !~ /^(lmp|liggghts)$/) continue
            for (f = 1; f <= 3; ++f) {
                n = 0
                for (r = 1; r <= rounds; ++r)
                    if (((engine[e], phase[f], r) in speed) && ((engine[p], phase[f], r) in speed))
                        ratio[++n] = speed[engine[e], phase[f], r] / speed[engine[p], phase[f], r]
                for (i = 2; i <= n; ++i) for (j = i; j > 1 && ratio[j] < ratio[j - 1]; --j) {
                    t = ratio[j]; ratio[j] = ratio[j - 1]; ratio[j - 1] = t
                }
                median = (ratio[int((n + 1) / 2)] + ratio[int(n / 2) + 1]) / 2
                printf "%-28s / %-9s %-9s %5.2f  (%.2f to %.2f)\n", engine[e], engine[p], phase[f], median, ratio[1], ratio[n]
            }
        }
    }' speeds.csv | tee ratios.txt
