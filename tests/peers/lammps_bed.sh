# shellcheck shell=bash
# Sourced: the peers' bed as input for LAMMPS, from data file $1, up to the first run. Floor "zw" at rest.
lammps_bed() {
    cat << END
units si
atom_style sphere
boundary f f f
newton off
comm_modify vel yes
read_data $1
neighbor 0.0002 bin
neigh_modify delay 0 every 10 check yes
pair_style gran/hooke/history 1000 285.7 2634 1317 0.5 1
pair_coeff * *
timestep 2e-6
fix g all gravity 9.81 vector 0 0 -1
fix xw all wall/gran hooke/history 1000 285.7 2634 1317 0.5 1 xplane 0 0.02
fix yw all wall/gran hooke/history 1000 285.7 2634 1317 0.5 1 yplane 0 0.02
fix zw all wall/gran hooke/history 1000 285.7 2634 1317 0.5 1 zplane 0 NULL
fix i all nve/sphere
END
}
