#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT
source "$(dirname "${BASH_SOURCE[0]}")/support.bash"

# Depth is learnt where images have it, and used where model, image and camera know of it.
make_toys
make_plain_model model
says "depth        of 24 images: " train.txt
"$ism" info model >info.txt
says "depth           " info.txt
for threads in 1 3; do
    "$ism" detect --model model --data toys/test.json -o found-$threads --threads $threads >detect.txt
done
says "space       metric" detect.txt
cmp found-1 found-3 || fail "other detections with 3 threads"
says '"position_m":[' found-1
! grep -F '"position_m":null' found-1 || fail "a detection in metres without a position"
"$ism" detect --model model --data toys/test.json -o found-metric --space metric --report report.html >detect.txt
cmp found-1 found-metric || fail "--space auto is not metric"
! grep "^space" detect.txt || fail "a space that was asked for is told"
says "metric" report.html
"$ism" detect --model model toys/test/test-0000.png --depth toys/test/test-0000-depth.png --depth-scale 0.001 \
    --camera 262.5,262.5,159.5,119.5 -o single >lines.txt 2>detect.txt
says "space metric" detect.txt
cmp <(grep -F '"image_id":1,' found-1 | sed 's/,$//') <(grep -F '"image_id":1,' single | sed 's/,$//') ||
    fail "one image is not detected as the same image of a data set"
"$ism" detect --model model --data toys/test.json -o sure --min-score 0.9 >/dev/null
"$ism" detect --model model --data toys/test.json -o all --min-score 0 >/dev/null
(($(grep -c image_id sure) < $(grep -c image_id all))) || fail "--min-score changes nothing"
"$ism" detect --model model --data toys/test.json -o votes --space metric --rescore none >/dev/null
says '"position_m":[' votes
! cmp -s votes all || fail "--rescore changes nothing"

# What is asked for and is not of the space metric is not passed over.
for option in "--rescore boxes" "--verify nms" "--segment patches"; do
    refused_in_a_line "${option% *} in the space metric: expected" \
        "$ism" detect --model model --data toys/test.json -o out --space metric $option
    "$ism" detect --model model --data toys/test.json -o asked $option >detect.txt
    grep -qx "space       jism" detect.txt || fail "$option: $(cat detect.txt)"
done

# Colours alone: found with the other model, and what is lost is said.
sed -E 's/"depth_file_name":"[^"]*",//; s/"depth_scale":[0-9.]*,//' toys/test.json >toys/colour.json
"$ism" detect --model model --data toys/colour.json -o colour >detect.txt
says "space       jism, for want of depth: no positions, and less is found" detect.txt
says '"image_id":1,' colour
! grep -q depth_m colour || fail "depth where there is none: $(cat colour)"
sed '0,/"depth_file_name":"[^"]*",/s///; 0,/"depth_scale":[0-9.]*,/s///' toys/test.json >toys/mixed.json
"$ism" detect --model model --data toys/mixed.json -o mixed >detect.txt
says "space       metric; jism for 1 image without depth" detect.txt
cmp <(grep -F '"image_id":1,' mixed | sed 's/,$//') <(grep -F '"image_id":1,' colour | sed 's/,$//') ||
    fail "an image without depth among others is detected otherwise"
cmp <(grep -F '"image_id":2,' mixed | sed 's/,$//') <(grep -F '"image_id":2,' found-1 | sed 's/,$//') ||
    fail "an image with depth among others is detected otherwise"
refused_in_a_line "vote space metric: expected depth_file_name in 'toys/colour.json'" \
    "$ism" detect --model model --data toys/colour.json -o out --space metric
refused "test-0000.png': expected a depth image (depth_file_name), got none" \
    "$ism" detect --model model --data toys/mixed.json -o out --space metric
sed -E 's/"camera":\{[^}]*\},//' toys/test.json >toys/no-camera.json
refused "test-0000.png': expected its camera, got none" \
    "$ism" detect --model model --data toys/no-camera.json -o out --space metric
"$ism" detect --model model --data toys/no-camera.json -o no-camera >detect.txt
says "space       jism, for want of a camera" detect.txt
"$ism" inspect --data toys/no-camera.json >inspect.txt
says "2 images have depth but no camera: the space metric needs both" inspect.txt

# Depth without any reading, as of a covered lens, counts as none.
sed '0,/test-0000-depth.png/s//covered.png/' toys/test.json >toys/covered.json
covered_depth toys/test/covered.png
"$ism" detect --model model --data toys/covered.json -o covered >detect.txt
says "space       metric; jism for 1 image without a reading of depth" detect.txt
cmp covered mixed || fail "depth without a reading is not as none"
refused "test/covered.png': expected depth with a reading, got none" \
    "$ism" detect --model model --data toys/covered.json -o out --space metric
"$ism" detect --model model toys/test/test-0000.png --depth toys/test/covered.png --depth-scale 0.001 \
    --camera 262.5,262.5,159.5,119.5 >/dev/null 2>detect.txt
says "space jism, for want of a reading of depth" detect.txt
"$ism" inspect --data toys/covered.json >inspect.txt
says "with depth      1" inspect.txt
says "depth without a reading: 1" inspect.txt
sed '0,/train-0000-depth.png/s//covered.png/' toys/train.json >toys/covered.json
cp toys/test/covered.png toys/train
"$ism" train --data toys/covered.json -o covered --no-templates >train.txt
says "images       24" train.txt
says "depth        of 2" train.txt

# A depth scale that is wrong by ten is noticed where the model knows sizes.
sed 's/"depth_scale":0.001/"depth_scale":0.01/' toys/test.json >toys/far.json
"$ism" detect --model model --data toys/far.json -o far >/dev/null 2>note.txt
says "by depth scale 0.01 nothing is found, by 0.001 there would be: " note.txt

# Depth among the pictures of a folder is no picture, in a folder a class as in one of images alone.
mkdir -p kinds/toy
cp toys/test/test-000?.png toys/test/test-000?-depth.png kinds/toy
for data in kinds kinds/toy; do
    "$ism" inspect --data $data >inspect.txt 2>note.txt
    grep -qxE "images +2" inspect.txt || fail "$data: depth is a picture: $(cat inspect.txt)"
    says "left out as depth: 2 of the images, which are grey PNG of 16 bits" note.txt
done
rm kinds/toy/test-000?.png
"$ism" inspect --data kinds >inspect.txt 2>note.txt
grep -qxE "images +2" inspect.txt || fail "pictures of 16 bits are depth: $(cat inspect.txt)"
[[ ! -s note.txt ]] || fail "pictures of 16 bits: $(cat note.txt)"

# A model of colours alone; its part of the other model is the same.
"$ism" train --data toys/train.json -o flat --no-templates --no-depth >train.txt
! grep "^depth" train.txt || fail "--no-depth: $(cat train.txt)"
"$ism" info flat >info.txt
says "depth           no" info.txt
"$ism" detect --model flat --data toys/test.json -o flat-found >detect.txt
grep -qx "space       jism" detect.txt || fail "a model without depth: $(cat detect.txt)"
"$ism" detect --model model --data toys/test.json -o jism-found --space jism >/dev/null
cmp flat-found jism-found || fail "depth changes what jism finds"
refused_in_a_line "--space metric: expected a model learnt from images with depth and camera, got one without" \
    "$ism" detect --model flat --data toys/test.json -o out --space metric

# Depth without a camera cannot be learnt from, which is said.
sed -E 's/"camera":\{[^}]*\},//' toys/train.json >toys/train-no-camera.json
"$ism" train --data toys/train-no-camera.json -o flat --no-templates --class car >train.txt
grep -qx "depth        left out: [0-9]* images have depth, none has a camera" train.txt || fail "$(cat train.txt)"

# A class that no image with depth shows is named before it is learnt from.
sed -E '/train-000[0-5]\.png/s/"depth_file_name":"[^"]*","depth_scale":[0-9.]*,//' toys/train.json >toys/part.json
"$ism" train --data toys/part.json -o part --no-templates --class car --class mug >train.txt 2>note.txt
says "note: without the space metric, since no image with depth and camera shows car (" note.txt
says "depth        left out, the space metric is not there: " train.txt
"$ism" train --data toys/part.json -o part --no-templates --class mug >train.txt 2>note.txt
says "depth        of 6 images" train.txt
! grep "without the space metric" note.txt || fail "all classes have depth"

# More classes are taught to the colours alone, which is said, also where the new images have no depth.
sed -E 's/"depth_file_name":"[^"]*",//; s/"depth_scale":[0-9.]*,//' toys/train.json >toys/train-colour.json
"$ism" train --data toys/train.json -o two --no-templates --class car --growable >train.txt
says "depth        of " train.txt
for data in train train-colour; do
    "$ism" train --data toys/$data.json -o three --add-to two --class mug >train.txt
    says "depth        left out: what --add-to keeps has none; train anew for the space metric" train.txt
done
