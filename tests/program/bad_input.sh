#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT
source "$(dirname "${BASH_SOURCE[0]}")/support.bash"

# What is wrong is said in a line, with exit code 2, and no file is left.
make_toys
model=toys/model.safetensors
line=refused_in_a_line

$line "expected a command (train, detect, evaluate, demo, info), got none" "$ism"
$line "bogus" "$ism" bogus
$line "--data" "$ism" train -o out
$line "bogus" "$ism" train --data toys/train.json -o out --detector bogus
$line "bogus" "$ism" detect --model $model --data toys/test.json -o out --space bogus
$line "--keep" "$ism" detect --model $model --data toys/test.json -o out --keep 2
$line "--similarity" "$ism" train --data toys/train.json -o out --similarity much
$line "--threads" "$ism" train --data toys/train.json -o out --threads 1000000
$line "--threads" "$ism" detect --model $model --data toys/test.json -o out --threads -1

# Files that are not what they should be.
$line "'none.json': expected a file to read, got none of this name" "$ism" train --data none.json -o out
echo '{"images": [' >broken.json
$line "'broken.json': expected well-formed JSON" "$ism" train --data broken.json -o out
$line "'none': expected a file to read" "$ism" detect --model none --data toys/test.json -o out
head -c 5000 $model >cut
$line "file 'cut'" "$ism" detect --model cut --data toys/test.json -o out
$line "file 'toys/test.json'" "$ism" info toys/test.json
sed 's/"name":"duck"/"name":"goose"/' toys/test.json >toys/goose.json
$line "class 'duck' of the model: expected a class of 'toys/goose.json' (car, mug, goose, robot)" \
    "$ism" detect --model $model --data toys/goose.json -o out
$line "class to select: expected one of: car, mug, duck, robot, got 'goose'" \
    "$ism" train --data toys/train.json -o out --class goose
$line "similarity" "$ism" train --data toys/train.json -o out --similarity -1
$line "codebook" "$ism" train --data toys/train.json -o out --min-cluster-size 1000000
$line "least information gain" "$ism" train --data toys/train.json -o out --min-information-gain 5

# Nowhere to write to.
$line "'nowhere/out': expected an existing folder" "$ism" train --data toys/train.json -o nowhere/out
$line "'toys': expected a file to write, got a folder" "$ism" train --data toys/train.json -o toys
cp toys/train.json copy.json
$line "expected another file than an input" "$ism" train --data copy.json -o copy.json
cmp toys/train.json copy.json || fail "an input was written over"
$line "'/dev/full'" "$ism" train --data toys/train.json -o /dev/full
$line "'nowhere/report.html'" "$ism" detect --model $model --data toys/test.json -o out --report nowhere/report.html
$line "folder 'copy.json': expected a folder, got a file" \
    "$ism" detect --model $model --data toys/test.json -o out --overlay copy.json
mkdir same
cp toys/test/test-0000.png same/a.png
$line "expected another folder for overlays" "$ism" detect --model $model same/a.png -o out --overlay same

# Images and depth.
sed -E 's/"depth_file_name":"[^"]*",//; s/"depth_scale":[0-9.]*,//' toys/test.json >toys/colour.json
$line "vote space ji3sm1: expected depth_file_name" "$ism" detect --model $model --data toys/colour.json -o out --space ji3sm1
"$ism" detect --model $model --data toys/colour.json -o colour >/dev/null || fail "detection without depth"
! grep -q depth_m colour || fail "depth where there is none: $(cat colour)"
$line "expected --data or an image" "$ism" detect --model $model -o out
$line "image" "$ism" detect --model $model --data toys/test.json toys/test/test-0000.png -o out
$line "--depth-scale" "$ism" detect --model $model toys/test/test-0000.png --depth toys/test/test-0000-depth.png -o out
$line "--camera" "$ism" detect --model $model toys/test/test-0000.png --camera 1,2 -o out
$line "camera focal lengths" "$ism" detect --model $model toys/test/test-0000.png --camera 0,1,2,3 -o out
$line "none.png" "$ism" detect --model $model none.png -o out
$line "test-0000.png" "$ism" detect --model $model toys/test/test-0000.png --depth toys/test/test-0000.png --depth-scale 1 -o out

# Results that do not fit the data.
sed 's/"image_id":1,/"image_id":77,/' toys/detections-jism.json >other.json
$line "file 'other.json': result 0: image_id: expected an image of data set 'toys/test.json', got 77" \
    "$ism" evaluate --data toys/test.json --detections other.json
$line "array of results" "$ism" evaluate --data toys/test.json --detections toys/test.json
$line "IoU threshold" "$ism" evaluate --data toys/test.json --detections toys/detections-jism.json --iou 0
