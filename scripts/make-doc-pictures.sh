#!/usr/bin/env bash
# Makes the pictures of docs/pictures with facet itself. Needs build/release/facet and Python with Pillow (to put pictures
# side by side).
#   scripts/make-doc-pictures.sh [PROGRAM]
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
facet=${1:-$root/build/release/facet}
scenes=$root/assets/scenes
out=$root/docs/pictures
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$out"

render() { # SCENE PICTURE OPTION...
  local scene=$1 picture=$2
  shift 2
  "$facet" render "$scenes/$scene.glb" -o "$picture" --quiet "$@"
}

# side_by_side OUT WIDTH IN...: scaled to WIDTH pixels each (0: as they are).
side_by_side() {
  /usr/bin/python3 - "$@" <<'PYTHON'
import sys
from PIL import Image

out, width, names = sys.argv[1], int(sys.argv[2]), sys.argv[3:]
pictures = [Image.open(name).convert("RGB") for name in names]
if width:
    pictures = [p.resize((width, round(p.height * width / p.width)), Image.LANCZOS) for p in pictures]
gap = 4
sheet = Image.new("RGB", (sum(p.width for p in pictures) + gap * (len(pictures) - 1), pictures[0].height), "white")
x = 0
for picture in pictures:
    sheet.paste(picture, (x, 0))
    x += picture.width + gap
sheet.save(out, quality=88, subsampling=0, optimize=True)
PYTHON
}

render showcase "$work/showcase.png" --camera "still life" --size 1280x960 --samples 8 \
  --background "#22262c" --exposure -0.3
side_by_side "$out/showcase.jpg" 640 "$work/showcase.png"

render gallery "$work/gallery.png" --camera gallery --size 1280x960 --samples 8
side_by_side "$out/gallery.jpg" 960 "$work/gallery.png"

render materials "$work/materials.png" --camera front --size 1920x1440 --samples 8
side_by_side "$out/materials.jpg" 1280 "$work/materials.png"

render material_grid "$work/grid.png" --camera front --size 720x720 --samples 8 --background white
side_by_side "$out/material_grid.jpg" 480 "$work/grid.png"

render room "$work/room.png" --camera front --environment none --size 720x720 --samples 8 --background black
side_by_side "$out/room.jpg" 400 "$work/room.png"

poses=()
for time in 0 0.5 1 1.5; do
  render animated "$work/pose$time.png" --camera "three quarters" --animation loop --time $time --size 480x300 \
    --samples 8 --background "#dde0e6"
  poses+=("$work/pose$time.png")
done
side_by_side "$out/pose.jpg" 240 "${poses[@]}"

edges=()
for samples in 1 2 4 8; do
  render material_grid "$work/edges$samples.png" --camera front --size 96x96 --samples $samples --background white
  /usr/bin/python3 - "$work/edges$samples.png" <<'PYTHON'
import sys
from PIL import Image

picture = Image.open(sys.argv[1]).convert("RGB").crop((0, 0, 14, 14))
picture.resize((168, 168), Image.NEAREST).save(sys.argv[1])
PYTHON
  edges+=("$work/edges$samples.png")
done
side_by_side "$out/samples.png" 0 "${edges[@]}"

curves=()
for curve in none reinhard aces agx neutral; do
  render showcase "$work/$curve.png" --camera "still life" --size 480x480 --samples 8 --exposure 0.5 --tonemap $curve \
    --background "#22262c"
  curves+=("$work/$curve.png")
done
side_by_side "$out/tone_curves.jpg" 200 "${curves[@]}"
