#!/usr/bin/env bash
# Draws the pictures of this folder that show films (all but renderers.jpg and styles.png, which rendering.md makes).
#   docs/figures/images/make.sh [GRAINREEL] [FOLDER FOR RUNS]
# Takes four minutes on two processors. Needs the command ffmpeg, to put pictures side by side.
set -euo pipefail
root=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../../.." && pwd)
grainreel=${1:-$root/build/release/grainreel} work=${2:-$root/output/images}
here=$root/docs/figures/images
wedge=$root/scenes/wedge_segregation.toml nut=$root/scenes/teaching_brazil_nut.toml
mkdir -p "$work"
plain=(--set 'film.ghost=[]' --set 'film.trails={}' --set 'film.caption=[]')  # without what the scene's film explains

run() { echo "grainreel $*"; "$grainreel" "$@" --quiet --force > /dev/null; }
beside() { ffmpeg -v error -y -i "$work/$2" -i "$work/$3" -filter_complex hstack "$here/$1"; }

# The front page's moving picture.
run movie "$wedge" --out "$work/wedge" --no-film
run render "$work/wedge" --every 1 --format gif --size 560x420 --set film.rate=12 --out "$work/gif"
cp "$work/gif/movie.gif" "$here/wedge.gif"

# Colours and marks: rise, arrows, plots.
run render "$work/wedge" --at 5 --size 1120x630 --set film.colour.by=rise --set film.arrows.grid=12 "${plain[@]}" \
    --out "$here/convection.png"

# The forces on a grain.
rm -f "$here/inspect.png"
"$grainreel" inspect "$work/wedge" --at 4.21s --grain 234 --size 1280x720 --png "$here/inspect.png" --quiet > /dev/null

# Three drives side by side.
for g in 0.9 2 4; do run movie "$wedge" --duration 2s --no-film --set drive.g_level=$g --out "$work/g$g"; done
run compare "$work/g0.9" "$work/g2" "$work/g4" --size 960x540 --format png --out "$work/compare"
cp "$(ls "$work"/compare/frames/*.png | tail -1)" "$here/compare.png"

# A bed exposed for a second, and the mean of two periods.
for span in 'exposure="1 s"' average=2; do
    run movie "$wedge" --duration 3 --size 480x540 --format png --set "film.segment=[{kind=\"locked\", $span}]" \
        --set 'film.plot=[]' --out "$work/${span%%=*}"
    cp "$(ls "$work/${span%%=*}"/frames/*.png | tail -1)" "$work/${span%%=*}.png"
done
beside spans.png exposure.png average.png

# Four moments of an orbit.
run movie "$nut" --no-film --duration 2s --out "$work/nut"
for quarter in 0 1 2 3; do
    run render "$work/nut" --at 2 --size 360x330 --set film.camera.azimuth=$((20 + 90 * quarter)) --set film.plot=[] \
        --set 'film.caption=[]' --set film.axes=true --out "$work/orbit$quarter.png"
done
ffmpeg -v error -y -i "$work/orbit0.png" -i "$work/orbit1.png" -i "$work/orbit2.png" -i "$work/orbit3.png" \
    -filter_complex hstack=inputs=4 "$here/orbit.png"
