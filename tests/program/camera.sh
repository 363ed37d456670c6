#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT
source "$(dirname "${BASH_SOURCE[0]}")/support.bash"

# The example 07_camera looks through OpenCV; numbered images stand for a camera.
camera=$(dirname "$ism")/07_camera
[[ -x $camera ]] || { echo "skipped: $camera is not built"; exit 77; }
make_toys
number=0
for image in toys/test/*.png; do
    [[ $image == *-depth.png ]] || cp "$image" "frame_$((number++)).png"
done
"$camera" toys/model.safetensors frame_%d.png out.avi >seen.txt
(($(grep -cE '^[0-9]+: [0-9]+ ms' seen.txt) == number)) || fail "not a line a frame: $(cat seen.txt)"
grep -qE ' (car|duck|mug|robot) (0\.[3-9]|1)' seen.txt || fail "nothing is found: $(cat seen.txt)"
[[ $(head -c 4 out.avi) == RIFF ]] || fail "no video"
rm out.avi
# OpenCV prints a line of its own.
refused "none.mp4: expected a video or numbered images, got none" "$camera" toys/model.safetensors none.mp4
refused_in_a_line "none.safetensors" "$camera" none.safetensors frame_%d.png
refused "usage: " "$camera"
