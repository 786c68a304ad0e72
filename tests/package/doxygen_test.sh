#!/usr/bin/env bash
# That Doxygen reads the public headers without a warning: doxygen_test.sh SOURCE. Skipped where it is not installed.
set -euo pipefail
command -v doxygen >/dev/null || { echo "doxygen is not installed"; exit 77; }
cd "$1"
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
(cat docs/examples/Doxyfile && echo "OUTPUT_DIRECTORY = $out") | doxygen - 2>&1 | tee "$out/said"
[[ ! -s $out/said && -s $out/html/index.html ]]
