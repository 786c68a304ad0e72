#!/usr/bin/env bash
# Builds the part of FFmpeg that grainreel calls, from the source of Debian's own package, for an archive:
#   ffmpeg.sh OUT CC [further options for configure]
# Debian's FFmpeg brings 150 libraries along, 200 MB. This one needs x264, libvpx, SVT-AV1 and dav1d, and films come out
# with the same bytes. OUT/lib gets the libraries, OUT/licence their licence, OUT/source the name and version of the source.
# GRAINREEL_FFMPEG_SOURCE names a folder with the unpacked source for machines without a network.
set -euo pipefail
out=$1 cc=$2
shift 2
pkg_config=${PKG_CONFIG:-pkg-config}

fail() { echo "archive: $*" >&2; exit 1; }

check_packages() {
    local pair lacking=()
    for pair in patchelf:patchelf make:make dpkg-source:dpkg-dev xz:xz-utils python3:python3; do
        command -v "${pair%:*}" >/dev/null || lacking+=("${pair#*:}")
    done
    for pair in x264:libx264-dev vpx:libvpx-dev SvtAv1Enc:libsvtav1enc-dev dav1d:libdav1d-dev; do
        "$pkg_config" --exists "${pair%:*}" || lacking+=("${pair#*:}")
    done
    [[ $("$cc" -dumpmachine) != x86* ]] || command -v nasm >/dev/null || lacking+=(nasm)
    ((${#lacking[@]} == 0)) || fail "packages are missing; as root: apt-get install ${lacking[*]}"
}
check_packages

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# apt's own way, with its signatures, but without a change to this machine's list of sources. Its repositories are asked.
fetch() {
    local wanted options keys
    wanted=$(dpkg-query -W -f '${source:Version}\n' libavcodec-dev | sed -n 1p) ||
        fail "libavcodec-dev is not installed; install it"
    mkdir -p "$work/lists/partial" "$work/archives/partial"
    keys=$(find /usr/share/keyrings -name 'debian-archive-keyring.[gp]*' | sed -n 1p)
    apt-get indextargets --format "deb-src [signed-by=$keys] \$(REPO_URI) \$(RELEASE) \$(COMPONENT)" 'Created-By: Packages' |
        sort -u >"$work/sources.list"
    options=(-q -o Dir::Etc::SourceList="$work/sources.list" -o Dir::Etc::SourceParts=/dev/null
             -o Dir::State::Lists="$work/lists" -o Dir::Cache="$work" -o Debug::NoLocking=1 -o APT::Sandbox::User=)
    apt-get "${options[@]}" update >"$work/log" 2>&1 &&
        (cd "$work" && apt-get "${options[@]}" source --only-source "ffmpeg=$wanted" >>"$work/log" 2>&1) || {
        cat "$work/log" >&2
        fail "the source of ffmpeg $wanted cannot be fetched; try again with a network, or set GRAINREEL_FFMPEG_SOURCE to its folder"
    }
    source=$(echo "$work"/ffmpeg-*/)
    origin="ffmpeg $wanted"
}

if [[ -n ${GRAINREEL_FFMPEG_SOURCE-} ]]; then
    source=$GRAINREEL_FFMPEG_SOURCE
    [[ -x $source/configure ]] || fail "$source: is no source of FFmpeg, it has no configure"
    origin="ffmpeg $(dpkg-parsechangelog -l "$source/debian/changelog" -S Version)"
else
    fetch
fi

joined() { local IFS=,; echo "$*"; }
encoders=(libx264 libvpx_vp9 libsvtav1 ffv1 gif wrapped_avframe mjpeg)
decoders=(h264 vp9 libdav1d ffv1 gif rawvideo wrapped_avframe mjpeg png)  # png: posters
options=(
    --prefix="$out" --cc="$cc" --pkg-config="$pkg_config"
    --disable-everything --disable-autodetect --disable-programs --disable-doc --disable-debug --disable-network
    --disable-avdevice --disable-swresample --disable-postproc --disable-static --enable-shared --enable-gpl
    --enable-libx264 --enable-libvpx --enable-libsvtav1 --enable-libdav1d --enable-zlib
    --enable-encoder="$(joined "${encoders[@]}")" --enable-decoder="$(joined "${decoders[@]}")"
    --enable-muxer=mp4,webm,matroska,gif,yuv4mpegpipe --enable-demuxer=mov,matroska,gif,yuv4mpegpipe,image2,image_png_pipe
    --enable-parser=h264,vp9,av1,gif,mjpeg,png
    --enable-bsf=h264_mp4toannexb,extract_extradata,vp9_superframe,vp9_superframe_split,av1_metadata,null
    --enable-filter=buffer,buffersink,scale,format,null,palettegen,paletteuse
    --enable-protocol=file,pipe "$@")
mkdir "$work/build"
cd "$work/build"
"$source/configure" "${options[@]}" >"$work/log" 2>&1 && make -j"$(nproc)" >>"$work/log" 2>&1 || {
    tail -n 20 "$work/log" >&2
    fail "FFmpeg cannot be built, see above"
}
rm -rf "$out"
make install-libs >>"$work/log" 2>&1
{
    echo "$origin, configured by:"
    printf '%s\n' configure "${options[@]}"
} >"$out/configured"
echo "$origin" >"$out/source"
cat "$source/debian/copyright" >"$out/licence" 2>/dev/null || cp "$source/LICENSE.md" "$out/licence"
