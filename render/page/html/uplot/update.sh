#!/usr/bin/env bash
# Fetches uPlot (MIT, its licence is LICENSE) from npm and puts its built files here: update.sh [VERSION].
# Needs npm. Nothing else in the repository does: the build takes the files as they lie here.
set -euo pipefail
version=${1:-1.6.32}
here=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
npm pack --silent "uplot@$version"
tar xf "uplot-$version.tgz"
cp package/dist/uPlot.iife.min.js "$here/uplot.min.js"
cp package/dist/uPlot.min.css "$here/uplot.min.css"
cp package/LICENSE "$here/LICENSE"
