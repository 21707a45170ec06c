#!/usr/bin/env bash
# Draws packaging/icon.png, 256x256, with the program: the built-in terrain for red and cyan glasses, corners rounded.
# Needs ImageMagick. The program is build/release/bin/stereonav, or the one that STEREONAV names.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
scratch="$(mktemp -d)"
trap 'rm -rf "$scratch"' EXIT
# Twice the size, to be smooth; eyes far apart, so that two colours are seen at 48 pixels too.
"${STEREONAV:-build/release/bin/stereonav}" render terrain --pose 0,-6000,2600,0,-16,0 --fov 42 --size 512x512 \
    --separation 500 --zero-parallax 3800 --mode arcc --out "$scratch/picture.png"
convert "$scratch/picture.png" -modulate 112,150 \
    \( -size 512x512 xc:black -fill white -draw "roundrectangle 8,8 503,503 96,96" \) \
    -alpha off -compose CopyOpacity -composite -resize 256x256 -strip +dither -colors 255 \
    -define png:exclude-chunks=date,time PNG32:"$scratch/icon.png"
convert "$scratch/icon.png" -strip -define png:compression-level=9 -define png:exclude-chunks=date,time packaging/icon.png
