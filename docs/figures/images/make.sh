#!/usr/bin/env bash
# Draws the pictures of this folder (all but renderers.jpg, which tests/bench/renderers.sh makes).
#   docs/figures/images/make.sh [GRAINREEL] [FOLDER FOR RUNS]
# Takes five minutes on two processors. Needs no other program: grainreel writes the GIF, beside.py joins pictures.
set -euo pipefail
root=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../../.." && pwd)
grainreel=${1:-$root/build/release/grainreel} work=${2:-$root/output/images}
here=$root/docs/figures/images
wedge=$root/scenes/wedge_segregation.toml nut=$root/scenes/teaching_brazil_nut.toml
mkdir -p "$work"
plain=(--set 'film.ghost=[]' --set 'film.trails={}' --set 'film.caption=[]')  # without what the scene's film explains

run() { echo "grainreel $*"; "$grainreel" "$@" --quiet --force > /dev/null; }
beside() { "$here/../beside.py" "$here/$1" "${@:2}"; }

# The front page's moving picture.
run movie "$wedge" --out "$work/wedge" --no-film
run render "$work/wedge" --every 1 --format gif --size 480x360 --set film.rate=10 --max-size 1500kB --out "$work/gif"
cp "$work/gif/movie.gif" "$here/wedge.gif"

# Colours and marks: rise, arrows, plots.
run render "$work/wedge" --at 5 --size 1120x630 --set film.colour.by=rise --set film.arrows.grid=12 "${plain[@]}" \
    --out "$here/convection.png"

# The forces on a grain.
rm -f "$here/inspect.png"
"$grainreel" inspect "$work/wedge" --at 4.21s --grain 234 --size 1280x720 --png "$here/inspect.png" --quiet > /dev/null

# Three drives side by side.
for g in 0.9 2 4; do run movie "$wedge" --duration 2s --no-film --set drive.g_level=$g --out "$work/g$g"; done
run compare "$work/g0.9" "$work/g2" "$work/g4" --size 960x540 --format png --set "film.caption=[]" --out "$work/compare"
cp "$(ls "$work"/compare/frames/*.png | tail -1)" "$here/compare.png"

# A bed exposed for a second, and the mean of two periods.
for span in 'exposure="1 s"' average=2; do
    run movie "$wedge" --duration 3 --size 480x540 --format png --set "film.segment=[{kind=\"locked\", $span}]" \
        --set 'film.plot=[]' --out "$work/${span%%=*}"
    cp "$(ls "$work/${span%%=*}"/frames/*.png | tail -1)" "$work/${span%%=*}.png"
done
beside spans.png "$work/exposure.png" "$work/average.png"

# Four moments of an orbit.
run movie "$nut" --no-film --duration 2s --out "$work/nut"
for quarter in 0 1 2 3; do
    run render "$work/nut" --at 2 --size 360x330 --set film.camera.azimuth=$((20 + 90 * quarter)) --set film.plot=[] \
        --set 'film.caption=[]' --set film.axes=true --out "$work/orbit$quarter.png"
done
beside orbit.png "$work"/orbit[0-3].png

# Both ends of the stroke, with the outline at rest.
for moment in 1.017 1.05; do  # a quarter and three quarters of a period of 15 Hz
    run render "$work/nut" --at $moment --size 480x420 --set film.wall_ghost=true --set film.exaggerate=2 \
        --set 'film.plot=[]' --set 'film.caption=[]' --out "$work/ghost$moment.png"
done
beside wall_ghost.png "$work"/ghost*.png

# The front page's drum.
run movie "$root/scenes/drum_mixing.toml" --no-film --out "$work/drum"
run render "$work/drum" --at 1.9 --size 800x500 --out "$here/drum.png"

# One bed in three styles.
for style in studio flat dark; do
    run bench render --grains 1500 --zoom 0.88 --size 400x450 --style $style --out "$work/$style"
done
beside styles.png "$work"/{studio,flat,dark}/*.png
