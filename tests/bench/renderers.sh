#!/usr/bin/env bash
# The same grains drawn by grainreel and by others, in one run: seconds a frame and one picture of all. Needs the
# Debian packages lammps, povray and tachyon (what is absent is left out), imagemagick for the picture.
#
# usage: tests/bench/renderers.sh GRAINREEL OUT_DIR [ROUNDS] [grainreel's options, as --grains 10125 --size 1920x1080]
set -euo pipefail
grainreel=$1 out=$2 rounds=${3:-3}
shift $(($# < 3 ? $# : 3))
mkdir -p "$out"

"$grainreel" bench render --quiet --orthographic --json --repeat 5 --out "$out/ours" "$@" >"$out/ours.json"
read -r focal cx cy width height kx ky kz < <(tr -d '[:space:]{}"' <"$out/ours/camera.json" | sed 's/\[//g; s/\]//g; s/[a-z_]*://g' |
    tr , ' ' | awk '{print $2, $3, $4, $5, $6, $7, $8, $9}')

# Each scene is written from the same table. Colours as ours, linear or sRGB as each program takes them.
awk -F, -v f="$focal" -v cx="$cx" -v cy="$cy" -v w="$width" -v h="$height" -v kx="$kx" -v ky="$ky" -v kz="$kz" \
    -v pov="$out/bed.pov" -v tac="$out/bed.tachyon" -v dat="$out/bed.data" '
NR == 1 {
    x0 = -cx / f; x1 = (w - cx) / f; y0 = -(h - cy) / f; y1 = cy / f
    mx = (x0 + x1) / 2; my = (y0 + y1) / 2
    printf "global_settings { assumed_gamma 1 }\nbackground { rgb 1 }\n" > pov
    printf "camera { orthographic location <%g,%g,-1> direction <0,0,1> right <%g,0,0> up <0,%g,0> }\n", mx, my, x1 - x0, y1 - y0 > pov
    printf "light_source { <%g,%g,%g> rgb 0.78 parallel point_at <0,0,0> }\n", 10 * kx, 10 * ky, 10 * kz > pov
    printf "light_source { <0,2,-10> rgb 0.3 parallel point_at <0,0,0> shadowless }\n" > pov
    printf "#default { finish { ambient 0 emission 0.2 diffuse 0.8 specular 0.12 } }\n" > pov
    printf "BEGIN_SCENE\nRESOLUTION %d %d\nSHADER_MODE FULL\n", w, h > tac
    printf "  AMBIENT_OCCLUSION\n    AMBIENT_COLOR 1 1 1\n    RESCALE_DIRECT 0.6\n    SAMPLES 12\nEND_SHADER_MODE\n" > tac
    printf "CAMERA\n  PROJECTION ORTHOGRAPHIC\n  ZOOM %g\n  ASPECTRATIO 1\n  ANTIALIASING 3\n  RAYDEPTH 4\n  CENTER %g %g -1\n  VIEWDIR 0 0 1\n  UPDIR 0 1 0\nEND_CAMERA\n", 1 / (y1 - y0), mx, my > tac
    printf "BACKGROUND 1 1 1\nDIRECTIONAL_LIGHT DIRECTION %g %g %g COLOR 0.8 0.8 0.8\n", -kx, -ky, -kz > tac
    split("0.337 0.706 0.914", small, " "); split("0.902 0.624 0.0", big, " ")
    for (c = 1; c <= 3; ++c) { lin[0, c] = small[c] ^ 2.2; lin[1, c] = big[c] ^ 2.2; srgb[0, c] = small[c]; srgb[1, c] = big[c] }
    next
}
{
    s = $5
    printf "sphere { <%s,%s,%s>, %s pigment { rgb <%g,%g,%g> } }\n", $1, $2, $3, $4, lin[s, 1], lin[s, 2], lin[s, 3] > pov
    printf "SPHERE CENTER %s %s %s RAD %s TEXTURE AMBIENT 0.1 DIFFUSE 0.8 SPECULAR 0.0 OPACITY 1.0 COLOR %g %g %g TEXFUNC 0\n", $1, $2, $3, $4, srgb[s, 1], srgb[s, 2], srgb[s, 3] > tac
    atoms = atoms sprintf("%d %d %.9g 2500 %.9g %.9g %.9g\n", NR - 1, s + 1, 2 * $4, $1, $2, -$3)
    if (NR == 2 || -$3 < zl) zl = -$3; if (NR == 2 || -$3 > zh) zh = -$3
    n = NR - 1
}
END {
    print "END_SCENE" > tac
    # A cube about the middle of the picture, as wide as it is high: LAMMPS fits its box to the height.
    half = (y1 - y0) / 2; zm = (zl + zh) / 2
    printf "bed\n\n%d atoms\n2 atom types\n\n%.9g %.9g xlo xhi\n%.9g %.9g ylo yhi\n%.9g %.9g zlo zhi\n\nAtoms\n\n%s", n, mx - half, mx + half, my - half, my + half, zm - half, zm + half, atoms > dat
}' "$out/ours/grains.csv"

cat >"$out/bed.lammps" <<LAMMPS
units si
atom_style sphere
boundary f f f
read_data $out/bed.data
pair_style none
neighbor 0 bin
comm_modify cutoff 0.001
dump pic all image 1 $out/lammps.*.ppm type diameter size $width $height view 0 0 up 0 1 0 zoom 2.0 box no 0 &
    ssao yes 4539 0.7 shiny 0.3
dump_modify pic color small 0.337 0.706 0.914 color big 0.902 0.624 0.0 acolor 1 small acolor 2 big backcolor white
run 0
LAMMPS

now() { date +%s.%N; }
timed() { # name, command...: appends seconds to OUT/name.s
    local name=$1 begin
    shift
    begin=$(now)
    if ! "$@" >"$out/$name.log" 2>&1; then
        echo "$name failed; see $out/$name.log" >&2
        return 0
    fi
    awk -v a="$begin" -v b="$(now)" 'BEGIN { print b - a }' >>"$out/$name.s"
}
rm -f "$out"/*.s
for ((round = 0; round < rounds; ++round)); do
    "$grainreel" bench render --quiet --orthographic --json --repeat 5 "$@" |
        awk '/"total"/ { gsub(/[^0-9.]/, ""); print $0 / 1000 }' >>"$out/grainreel.s"
    if command -v lmp >/dev/null; then timed lammps lmp -in "$out/bed.lammps" -log none; else echo "lmp is not installed: LAMMPS left out"; fi
    if command -v povray >/dev/null; then
        timed povray povray "+I$out/bed.pov" "+O$out/povray.png" "+W$width" "+H$height" +A0.3 -D -V
    else echo "povray is not installed: left out"; fi
    if command -v tachyon >/dev/null; then
        timed tachyon tachyon "$out/bed.tachyon" -aasamples 3 -o "$out/tachyon.tga" -format TARGA
    else echo "tachyon is not installed: left out"; fi
done

echo "seconds a frame, of $rounds (whole processes but for grainreel, which settles its bed first):"
for file in "$out"/*.s; do
    sort -g "$file" | awk -v name="$(basename "$file" .s)" '{ v[NR] = $1 } END { printf "%-10s median %.3f  (%.3f to %.3f)\n", name, v[int((NR + 1) / 2)], v[1], v[NR] }'
done

# Half as large, cut to the grains, side by side.
command -v convert >/dev/null || { echo "imagemagick is not installed: no picture of all"; exit 0; }
panels=()
panel() { # name, file
    [[ -s $2 && -s $out/$1.s ]] || return 0
    local seconds width=$((height * 13 / 20)) from
    seconds=$(sort -g "$out/$1.s" | awk '{ v[NR] = $1 } END { printf v[int((NR + 1) / 2)] < 0.1 ? "%.3f s" : "%.1f s", v[int((NR + 1) / 2)] }')
    from=$(awk -v x="$cx" -v w="$width" 'BEGIN { printf "%d", x - w / 2 }')
    convert "$2" -crop "${width}x$height+$from+0" +repage -resize 50% -gravity south -background white -splice 0x34 \
        -font DejaVu-Sans -pointsize 20 -annotate +0+6 "$1, $seconds" "$out/panel-$1.png"
    panels+=("$out/panel-$1.png")
}
panel grainreel "$out/ours/picture.png"
panel lammps "$out/lammps.0.ppm"
panel povray "$out/povray.png"
panel tachyon "$out/tachyon.tga"
convert "${panels[@]}" +append "$out/renderers.png"
echo "wrote $out/renderers.png"
