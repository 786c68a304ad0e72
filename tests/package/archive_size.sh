#!/usr/bin/env bash
# That an archive is small, in both forms, and holds what starts it at its end: archive_size.sh FILE
set -euo pipefail
file=$1 packed=100000000 unpacked=300000000
[[ -s $file ]] || { echo "$file is not there; build the target archive first"; exit 77; }
fail() { echo "FAILED: $*" >&2; exit 1; }

size=$(stat -c %s "$file")
((size < packed)) || fail "$file has $size bytes"
rows=$(tar --list --verbose --file "$file" | awk '{ print $1, $3, $6 }')
inside=$(awk '{ bytes += $2 } END { print bytes }' <<<"$rows")
((inside < unpacked)) || fail "it unpacks to $inside bytes"
last=$(tail -n 1 <<<"$rows")
[[ $last == -rwxr-xr-x*/bin/grainreel ]] || fail "the last file is: $last"
! grep -v '^[-d]' <<<"$rows" || fail "it holds links"
echo "ok: $size bytes packed, $inside unpacked"
