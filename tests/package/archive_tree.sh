#!/usr/bin/env bash
# Makes the folder of an archive for the tests Archive and Wheel: archive_tree.sh LEAN TREE MAKE_TREE...
# LEAN is the FFmpeg that the target `archive` builds; the system's is taken where it is not there.
set -euo pipefail
lean=$1 tree=$2
shift 2
command -v patchelf >/dev/null || { echo "patchelf is not installed"; exit 77; }
# An archive draws with OSMesa, which Debian 12 has, where archives are made, and releases after 13 have not.
/sbin/ldconfig -p | grep -q 'libOSMesa\.so\.8' || { echo "this system has no libOSMesa.so.8"; exit 77; }
[[ -s $lean/source ]] || lean=system
rm -rf "$tree"
mkdir -p "$(dirname "$tree")"
"$@" --ffmpeg "$lean" "$tree"
echo "FFmpeg: $lean; $(du -sm "$tree" | cut -f1) MB"
