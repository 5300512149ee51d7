#!/usr/bin/env bash
# From a fresh checkout to a picture: installs what is missing, builds the program and renders the bundled gallery.
#   scripts/quickstart.sh [PICTURE]        PICTURE: gallery.png in the current folder if none is named
set -euo pipefail

picture=${1:-gallery.png}
case $picture in
  -h | --help) sed -n '2,3s/^# \{0,1\}//p' "$0"; exit 0 ;;
  /*) ;;
  *) picture=$PWD/$picture ;;
esac
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"

scripts/install-dependencies.sh
echo "building facet (a few minutes the first time) ..."
cmake --preset release -DFACET_BUILD_TESTS=OFF -DFACET_BUILD_BENCH=OFF >/dev/null
cmake --build --preset release --target facet facet_oiio
build/release/facet render assets/scenes/gallery.glb --camera gallery --size 1280x960 --samples 8 -o "$picture"
echo "the picture is $picture; next: build/release/facet --help"
