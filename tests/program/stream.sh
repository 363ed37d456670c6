#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT
source "$(dirname "${BASH_SOURCE[0]}")/support.bash"

# The example 06_stream follows toys over frames; images of a data set and of a folder are the same frames.
stream=$(dirname "$ism")/06_stream
[[ -x $stream ]] || { echo "skipped: $stream is not built"; exit 77; }
make_toys
make_plain_model model
objects() { grep -E '^[0-9]+:' "$1"; }

"$stream" model 8 2 >toys.txt
(($(objects toys.txt | wc -l) == 8)) || fail "not a line a frame: $(cat toys.txt)"
says "latency   p50 " toys.txt
says "reading " toys.txt
# Of the toys that are followed each keeps its identity, and positions scatter less than in single frames.
read -r followed identities < <(sed -nE 's/^toys .* followed ([0-9]+) by ([0-9]+) identities$/\1 \2/p' toys.txt)
((followed >= 4 && identities == followed)) || fail "identities: $(grep ^toys toys.txt)"
ids() { grep "^$1:" toys.txt | grep -oE '#[0-9]+ [a-z]+' | sort; }
[[ -n $(ids 4) && -z $(comm -23 <(ids 4) <(ids 8)) ]] || fail "an identity is lost: $(cat toys.txt)"
sed -nE 's/^scatter .* ([0-9.]+) mm, smoothed ([0-9.]+) mm$/\1 \2/p' toys.txt >scatter.txt
awk 'NF == 2 && $1 > 0 && $2 < 0.8 * $1 { fine = 1 } END { exit !fine }' scatter.txt ||
    fail "smoothing does not smooth: $(grep ^scatter toys.txt)"
"$stream" model 8 1 >one.txt
cmp <(objects toys.txt) <(objects one.txt) || fail "other objects on one thread"

mkdir frames
for depth in toys/test/*-depth.png; do
    name=$(basename "$depth" -depth.png)
    cp "$depth" frames/
    cp "toys/test/$name.png" "frames/$name-color.png"
done
echo '{"fx": 262.5, "fy": 262.5, "cx": 159.5, "cy": 119.5, "depth_scale": 0.001}' >frames/camera.json
"$stream" model toys/test.json 2 >coco.txt
"$stream" model frames 2 >folder.txt
cmp <(objects coco.txt) <(objects folder.txt) || fail "a folder is seen otherwise"
rm frames/*0000-depth.png # this frame by its colours alone
"$stream" model frames 2 >mixed.txt
(($(objects mixed.txt | wc -l) == $(objects folder.txt | wc -l))) || fail "a frame without depth: $(cat mixed.txt)"
# So is a frame whose depth has no reading, as of a covered lens.
covered_depth frames/test-0000-depth.png
"$stream" model frames 2 >covered.txt
cmp <(objects mixed.txt) <(objects covered.txt) || fail "a frame whose depth has no reading is seen otherwise"
cp toys/model.safetensors frames/test-0000-depth.png
refused_in_a_line "test-0000-depth.png': expected" "$stream" model frames
refused_in_a_line "toys/test: expected files NAME-color.png, got none" "$stream" model toys/test
for damaged in '{"fx": 262.5,' '[]' '{"fx": "262.5"}' '{"fx": 262.5}'; do
    echo "$damaged" >frames/camera.json
    refused_in_a_line "camera.json': expected JSON with the numbers fx, fy, cx, cy and depth_scale" "$stream" model frames
done
echo '{"fx": 0, "fy": 262.5, "cx": 159.5, "cy": 119.5, "depth_scale": 0.001}' >frames/camera.json
refused_in_a_line "camera.json': camera focal lengths" "$stream" model frames
rm frames/camera.json
refused_in_a_line "camera.json: expected a file, got none" "$stream" model frames
for number in -4 0 4.5 4x 2000000; do
    refused_in_a_line "FRAMES: expected a file, a folder, or a whole number from 1 to 1000000, got '$number'" \
        "$stream" model "$number"
done
refused_in_a_line "THREADS: expected a whole number from 0 to" "$stream" model 2 -1
refused "usage: " "$stream" model
