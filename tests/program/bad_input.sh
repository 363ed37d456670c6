#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT
source "$(dirname "${BASH_SOURCE[0]}")/support.bash"

# What is wrong is said in a line, with exit code 2, and no file is left.
make_toys
model=toys/model.safetensors
line=refused_in_a_line

$line "expected a command (train, detect, evaluate, demo, inspect, info) first, got 'detct': did you mean detect?" "$ism" detct
$line "to find objects in it: ism detect --model MODEL toys/test.json" "$ism" toys/test.json
$line "bogus" "$ism" bogus
$line "--data" "$ism" train -o out
$line "bogus" "$ism" train --data toys/train.json -o out --detector bogus
$line "bogus" "$ism" detect --model $model --data toys/test.json -o out --space bogus
$line "--keep" "$ism" detect --model $model --data toys/test.json -o out --keep 2
$line "--similarity" "$ism" train --data toys/train.json -o out --similarity much
$line "--threads" "$ism" train --data toys/train.json -o out --threads 1000000
$line "--threads: expected a whole number, from 0 to 1024, got '-1'" \
    "$ism" detect --model $model --data toys/test.json -o out --threads -1

# An option, a class or a word that is mistyped is named with the nearest; numbers have ranges that people read.
$line "unknown option --modle: did you mean --model?" "$ism" detect --modle $model toys/test/test-0000.png
$line "unknown option -model: did you mean --model?" "$ism" detect -model $model toys/test/test-0000.png
$line "unknown option --min_score: did you mean --min-score?" "$ism" detect --model $model --min_score=0.1 toys/test
$line "unknown option --camera" "$ism" train --data toys/train.json -o out --camera 1,2,3,4
$line "got 'rodot': did you mean robot?" "$ism" train --data toys/train.json -o out --class rodot
$line "--detector: expected one of dog, harris-laplace, hessian-laplace, dense, got 'harris': did you mean harris-laplace?" \
    "$ism" train --data toys/train.json -o out --detector harris
$line "--max-words: expected a whole number, 0 or more, got '-3'" "$ism" train --data toys/train.json -o out --max-words -3
$line "--max-words: expected a whole number, 0 or more, got '2.5'" "$ism" train --data toys/train.json -o out --max-words=2.5
$line "0 or more, got 99999999999999999999, too large a number" \
    "$ism" train --data toys/train.json -o out --max-words 99999999999999999999
for bad in nan inf -1 '' 1e400 0x1; do
    $line "--min-information-gain: expected a number, 0 or more, got " \
        "$ism" train --data toys/train.json -o out --min-information-gain "$bad"
done
$line "--min-score: expected a number, from 0 to 1, got '30'" "$ism" detect --model $model --min-score 30 toys/test
$line "train: expected --data, got none" "$ism" train -o out
$line "--model: expected a value, got none" "$ism" detect --model
$line "expected no further argument, got 'more'" "$ism" info $model more

# Files that are not what they should be.
$line "'none.json': expected a file to read, got none of this name" "$ism" train --data none.json -o out
echo '{"images": [' >broken.json
$line "'broken.json': expected well-formed JSON" "$ism" train --data broken.json -o out
$line "'none': expected a file to read" "$ism" detect --model none --data toys/test.json -o out
head -c 5000 $model >cut
$line "file 'cut'" "$ism" detect --model cut --data toys/test.json -o out
$line "file 'toys/test.json'" "$ism" info toys/test.json
$line "info --data: expected the data set that the model was learnt from, got one that shows none of its objects" \
    "$ism" info $model --report out --data toys/test.json
sed 's/"name":"duck"/"name":"goose"/' toys/test.json >toys/goose.json
$line "class 'duck' of the model: expected a class of 'toys/goose.json' (car, mug, goose, robot)" \
    "$ism" detect --model $model --data toys/goose.json -o out
$line "class to select: expected one of: car, mug, duck, robot, got 'goose'" \
    "$ism" train --data toys/train.json -o out --class goose
$line "similarity" "$ism" train --data toys/train.json -o out --similarity -1
$line "codebook" "$ism" train --data toys/train.json -o out --class car --min-cluster-size 1000000
$line "least information gain" "$ism" train --data toys/train.json -o out --class car --min-information-gain 5

# Nowhere to write to.
$line "'nowhere/out': expected an existing folder" "$ism" train --data toys/train.json -o nowhere/out
$line "'toys': expected a file to write, got a folder" "$ism" train --data toys/train.json -o toys
cp toys/train.json copy.json
$line "expected another file than an input" "$ism" train --data copy.json -o copy.json
cmp toys/train.json copy.json || fail "an input was written over"
$line "'/dev/full'" "$ism" train --data toys/train.json -o /dev/full --class car --no-templates
$line "'nowhere/report.html'" "$ism" detect --model $model --data toys/test.json -o out --report nowhere/report.html
$line "folder 'copy.json': expected a folder, got a file" \
    "$ism" detect --model $model --data toys/test.json -o out --overlay copy.json
mkdir same
cp toys/test/test-0000.png same/a.png
$line "expected another folder for overlays" "$ism" detect --model $model same/a.png -o out --overlay same

# Photos, masks and labels are never written over.
mkdir -p owned/images owned/labels
cp same/a.png owned/images/a.png && cp same/a.png owned/images/b.png
echo "0 .5 .5 .4 .4" >owned/labels/a.txt
printf '%s\n' car mug duck robot >owned/classes.txt
cp -r owned kept
for output in owned/images/a.png owned/images/b.png; do
    $line "expected a file to write that is no picture" "$ism" train --data owned -o $output
    $line "expected a file to write that is no picture" "$ism" detect --model $model same/a.png -o $output
    $line "expected a file to write that is no picture" "$ism" inspect --data owned --report $output
done
$line "expected another file than the labels" "$ism" train --data owned -o owned/labels/a.txt
$line "expected another file than the labels" "$ism" inspect --data owned --report owned/labels/a.txt
$line "expected another file than the labels" "$ism" detect --model $model --data owned --json owned/labels/a.txt
"$ism" inspect --data owned >inspect.txt
! grep -q "^part " inspect.txt || fail "a part of a set that has none: $(cat inspect.txt)"
mkdir -p parted/train/images
cp owned/images/a.png parted/train/images
printf 'train: train/images\nval: valid/images\nnames: [car, mug, duck, robot]\n' >parted/data.yaml
"$ism" inspect --data parted >inspect.txt
says "part            train, which ism train reads" inspect.txt
diff -r owned kept || fail "inputs were written over"

# Images and depth.
sed -E 's/"depth_file_name":"[^"]*",//; s/"depth_scale":[0-9.]*,//' toys/test.json >toys/colour.json
$line "vote space ji3sm1: expected depth_file_name" "$ism" detect --model $model --data toys/colour.json -o out --space ji3sm1
"$ism" detect --model $model --data toys/colour.json -o colour >/dev/null || fail "detection without depth"
! grep -q depth_m colour || fail "depth where there is none: $(cat colour)"
$line "expected --data or images" "$ism" detect --model $model -o out
$line "image" "$ism" detect --model $model --data toys/test.json toys/test/test-0000.png -o out
$line "--depth-scale" "$ism" detect --model $model toys/test/test-0000.png --depth toys/test/test-0000-depth.png -o out
for bad in 1,2 1,2,3,4,5 a,b,c,d 1,,2,3 ""; do
    $line "--camera: expected four numbers, FX,FY,CX,CY in pixels, got '$bad'" \
        "$ism" detect --model $model toys/test/test-0000.png --camera "$bad" -o out
done
$line "camera focal lengths" "$ism" detect --model $model toys/test/test-0000.png --camera nan,500,1,1 -o out
$line "--data: expected once, got several times" "$ism" train --data toys/train.json --data toys/test.json -o out
code=0
"$ism" detect --model $model toys/test/test-0000.png >/dev/full 2>full.txt || code=$?
((code == 2)) || fail "a full disk: expected exit code 2, got $code"
says "standard output: expected to write it whole" full.txt
$line "camera focal lengths" "$ism" detect --model $model toys/test/test-0000.png --camera 0,1,2,3 -o out
$line "none.png" "$ism" detect --model $model none.png -o out
$line "test-0000.png" "$ism" detect --model $model toys/test/test-0000.png --depth toys/test/test-0000.png --depth-scale 1 -o out
depth="toys/test/test-0000.png --depth toys/test/test-0000-depth.png"
for kind in 'a JPEG image;\xff\xd8\xff' 'a TIFF image;II*\x00' 'a PNM image;P5 1 1 255 ' 'something else;{}' 'an empty file;'; do
    printf "${kind#*;}" >depth.bad
    $line "depth.bad': expected depth as a 16-bit PNG, got ${kind%%;*}" \
        "$ism" detect --model $model toys/test/test-0000.png --depth depth.bad --depth-scale 0.001 -o out
done
$line "got 1, by which the median of the depth is" "$ism" detect --model $model $depth --depth-scale 1 -o out
says "; 0.001 would make it" stderr.txt
sed 's/"depth_scale":[0-9.]*/"depth_scale":1/' toys/train.json >toys/units.json
refused "0.001 would make it" "$ism" train --data toys/units.json -o out
"$ism" detect --model $model $depth --depth-scale 0.03 >/dev/null 2>doubt.txt || fail "a doubtful depth scale: $(cat doubt.txt)"
says "note: file 'toys/test/test-0000-depth.png': depth scale 0.03" doubt.txt
$line "--depth-scale: expected a number, above 0" "$ism" detect --model $model $depth --depth-scale -0.001 -o out
$line "--depth: expected one image, got 2" \
    "$ism" detect --model $model toys/test/test-0001.png $depth --depth-scale 0.001 -o out
mkdir two
cp toys/test/test-000[01].png two
for images in two 'two/*.png'; do
    $line "--depth: expected one image, got 2" \
        "$ism" detect --model $model "$images" --depth toys/test/test-0000-depth.png --depth-scale 0.001 -o out
done
rm two/test-0001.png
"$ism" detect --model $model two --depth toys/test/test-0000-depth.png --depth-scale 0.001 >/dev/null || fail "a folder of one image"

# Results that do not fit the data.
sed 's/"image_id":1,/"image_id":77,/' toys/detections-jism.json >other.json
$line "file 'other.json': result 0: image_id: expected an image of data set 'toys/test.json', got 77" \
    "$ism" evaluate --data toys/test.json --detections other.json
$line "expected an array of results, as ism detect -o writes it, got labels" \
    "$ism" evaluate --data toys/test.json --detections toys/test.json
refused "file 'toys/test': expected labels or a list of classes, got none" \
    "$ism" evaluate --data toys/test --detections toys/detections-jism.json
"$ism" detect --model $model toys/test/test-0000.png --json lines.json 2>/dev/null
$line "file 'lines.json': expected an array of results, as ism detect -o writes it, got an object" \
    "$ism" evaluate --data toys/test.json --detections lines.json
figures=(evaluate --data toys/test.json --detections toys/detections-jism.json)
$line "--rule uiuc: expected no --iou, got one" "$ism" "${figures[@]}" --rule uiuc --iou 0.3
$line "--plot: expected another file than --json, got the same" "$ism" "${figures[@]}" --json out --plot ./out
$line "--plot: expected a file, got standard output" "$ism" "${figures[@]}" --plot -
cat toys/detections-jism.json | "$ism" evaluate --data toys/test.json --detections /dev/stdin | grep -q "^mean " ||
    fail "evaluate: no figures of results that come through a pipe"
"$ism" "${figures[@]}" --json - | grep -q '^  "classes": {' || fail "evaluate --json -: no JSON on standard output"
[[ ! -e - ]] || fail "evaluate --json -: a file of this name"
"$ism" "${figures[@]}" --json /dev/stdout >figures.json
! grep -q "^mean " figures.json || fail "evaluate --json /dev/stdout: a table, too"
for text in '"version": "' '"images": 2,' '"rule": "iou",' '"iou": 0.5,'; do says "$text" figures.json; done
"$ism" "${figures[@]}" --rule coco --json - | grep -q '"rule": "coco",' || fail "evaluate --json: no rule"

# What is write-protected is not replaced, and permissions stay.
echo kept >protected.json
chmod 400 protected.json
$line "file 'protected.json': expected a file that may be replaced, got a write-protected one" \
    "$ism" detect --model $model toys/test/test-0000.png -o protected.json
[[ $(cat protected.json) == kept ]] || fail "a write-protected file was replaced"
chmod 600 protected.json
"$ism" detect --model $model toys/test/test-0000.png -o protected.json >/dev/null 2>&1
[[ $(stat -c %a protected.json) == 600 ]] || fail "a private file has other permissions than before"
$line "--iou: expected a number, above 0, at most 1, got '0'" "$ism" evaluate --data toys/test.json --detections toys/detections-jism.json --iou 0

# What --show would write through a link to a photo, and what would lie among the pictures of a page.
mkdir linked
cp toys/test/test-0000.png linked/a.png
cp toys/test/test-0001.png linked/photo.png
ln -s photo.png linked/a.ism.png
refused_in_a_line "--show: expected no link to an image as 'linked/a.ism.png', got one" \
    "$ism" detect --model $model linked/a.png linked/photo.png --show
cmp linked/photo.png toys/test/test-0001.png || fail "--show wrote over a photo"
refused_in_a_line "--report-images link: expected other outputs elsewhere" \
    "$ism" detect --model $model linked/a.png --report out.html --report-images link --overlay out-images
