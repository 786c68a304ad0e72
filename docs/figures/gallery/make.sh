#!/usr/bin/env bash
# Draws the pictures of docs/guide/gallery.md: two runs, of the default scene and of a hopper, drawn again and
# again.
#   docs/figures/gallery/make.sh [GRAINREEL] [FOLDER FOR RUNS]
# Takes a minute. Each picture's command is printed before it runs.
set -euo pipefail
root=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../../.." && pwd)
grainreel=${1:-$root/build/release/grainreel} work=${2:-$root/output/gallery}
here=$root/docs/figures/gallery
mkdir -p "$work"

run() { echo "grainreel $*"; "$grainreel" "$@" --quiet --force > /dev/null; }
# NAME then options of `render`, at 5 s of the wedge's run or at 0.5 s of the hopper's.
picture() {
    local name=$1
    shift
    run render "$work/${of:-wedge}" --at "${at:-5}" --size "${size:-640x480}" "${view[@]}" --out "$here/$name.png" "$@"
}

run movie "$root/scenes/wedge_segregation.toml" --no-film --duration 6 --set output.contacts=true \
    --set 'output.instruments=["walls"]' --set film.rotation=true --out "$work/wedge"
run movie "$root/scenes/hopper_discharge.toml" --no-film --duration 0.6 --set output.trajectory_interval=0.02 \
    --out "$work/hopper"
still=(--set film.rotation=false)
plain=(--set 'film.ghost=[]' --set 'film.trails={}' --set 'film.caption=[]')  # without what the scene's film explains
view=("${plain[@]}" --set film.camera.azimuth=20 --set film.camera.elevation=10 --set 'film.plot=[]')

picture studio "${still[@]}"
picture flat "${still[@]}" --set film.style=flat
picture dark "${still[@]}" --set film.style=dark
picture cut "${still[@]}" --set film.cut.at=0 --set film.camera.azimuth=40
picture slab "${still[@]}" --set film.cut.at='5 mm' --set film.cut.thickness='10 mm'
picture rotation
picture ghost "${still[@]}" --set 'film.ghost=["small"]'
picture hide "${still[@]}" --set 'film.hide=["small"]'
picture highlight "${still[@]}" --set 'film.highlight=[1600, 1610, 1620]'
picture above "${still[@]}" --set film.camera.elevation=50 --set film.camera.azimuth=-35 --set film.axes=true
picture close "${still[@]}" --set film.camera.zoom=2.2
size=480x640 picture portrait "${still[@]}" --set film.colour.by=speed
picture wall_ghost "${still[@]}" --set film.wall_ghost=true --set film.exaggerate=4
for by in speed vertical-velocity start-height displacement rise spin kinetic-energy coordination contact-force; do
    picture "$by" "${still[@]}" --set film.colour.by=$by
done
picture arrows "${still[@]}" --set film.arrows.grid=10
picture streamlines "${still[@]}" --set film.streamlines.grid=10 --set film.periods=4
picture wall_forces "${still[@]}" --set film.wall_forces=true --set 'film.wall_force_scale="3 N"'
picture profiles "${still[@]}" --set film.periods=4 \
    --set 'film.plot=[{profile="share"}, {profile="vertical-velocity", over="width"}]'
of=hopper at=0.5 picture outflow --set 'film.arrows={grid=12, of="now"}' --set 'film.plot=[{profile="solid-fraction"}]'
picture force_chains "${still[@]}" --set film.force_chains=true --set 'film.ghost=["small", "big"]'
picture text "${still[@]}" --set 'film.text="big above small {big_above_small}\nkinetic energy {kinetic:mJ}"'
picture plots "${still[@]}" --set 'film.plot=[{y="height_difference"}, {y="big_above_small"}]'

# What wants more than one frame.
run render "$work/wedge" --every 1 --from 4 --to 5 --no-film --frames --size 640x480 "${still[@]}" "${view[@]}" \
    --set 'film.trails={species=["big"], duration="1 s"}' --out "$work/trails"
cp "$(find "$work/trails/frames" -name '*.png' | sort | tail -1)" "$here/trails.png"
