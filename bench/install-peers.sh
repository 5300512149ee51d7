#!/bin/sh
# Installs the renderers that compare_peers.py puts beside facet: those of Debian 12's packages that are missing (which
# needs root), and with FOLDER what model-viewer and three.js need from npm; give that folder to compare_peers.py as --npm.
#   bench/install-peers.sh [FOLDER]
# FACET_PEERS names the folder of the peers' scripts (beside the project by default).
set -eu
peers=${FACET_PEERS:-$(cd "$(dirname "$0")/../.." && pwd)/shared/peers}

missing=
needs() {  # PACKAGE COMMAND: the package, if the command does not run
  command -v "$2" >/dev/null || missing="$missing $1"
}
needs f3d f3d
needs xvfb Xvfb
needs xauth xauth
/usr/bin/python3 -c 'import vtk, numpy' 2>/dev/null || missing="$missing python3-vtk9 python3-numpy"
if [ $# -ge 1 ]; then
  needs chromium chromium
  needs nodejs node
  needs npm npm
fi
# shellcheck disable=SC2086
[ -z "$missing" ] || apt-get install -y --no-install-recommends $missing
[ $# -ge 1 ] || exit 0
mkdir -p "$1"
cp "$peers/package.json" "$1/"
chmod u+w "$1/package.json"
npm install --ignore-scripts --prefix "$1"
