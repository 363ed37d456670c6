#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT
source "$(dirname "${BASH_SOURCE[0]}")/support.bash"

# Bad images are all named, and --skip-bad goes on without them.
make_toys
make_plain_model whole
cp -r toys bad
rm bad/train/train-0000.png
head -c 3000 toys/train/train-0001.png >bad/train/train-0001.png
echo "no picture" >bad/train/train-0002-depth.png
refused "3 of 24 images cannot be used; nothing was written" "$ism" train --data bad/train.json -o out
(($(wc -l <stderr.txt) == 4)) || fail "expected three images and a line, got: $(cat stderr.txt)"
for name in train-0000.png train-0001.png train-0002-depth.png; do says "$name" stderr.txt; done

"$ism" train --data bad/train.json -o skipped --skip-bad --no-templates >train.txt 2>train.err || fail "--skip-bad: $(cat train.err)"
says "images       21" train.txt
says "skipped      3" train.txt
(($(wc -l <train.err) == 3)) || fail "expected three images, got: $(cat train.err)"

# The model is that of the images left.
for number in 0000 0001 0002; do rm -f bad/train/train-$number.png; done
"$ism" train --data bad/train.json -o again --skip-bad --no-templates >/dev/null 2>&1
cmp skipped again || fail "--skip-bad: another model"
! cmp -s skipped whole || fail "--skip-bad: nothing was skipped"

# A long list is cut after 20, and nothing left is an error.
rm bad/train/*.png
refused "and 4 more" "$ism" train --data bad/train.json -o out
(($(wc -l <stderr.txt) == 22)) || fail "expected 20 images and two lines, got: $(cat stderr.txt)"
refused "images that can be used: expected 1 or more" "$ism" train --data bad/train.json -o out --skip-bad

rm bad/test/test-0000-depth.png
refused "1 of 2 images" "$ism" detect --model whole --data bad/test.json -o out
"$ism" detect --model whole --data bad/test.json -o found --skip-bad >detect.txt 2>/dev/null
says "skipped     1" detect.txt
says '"image_id":2,' found
! grep -qF '"image_id":1,' found || fail "detections in an image that was skipped"

# What detect skips is not measured either: figures are those of its report, whatever was found in the image before.
"$ism" evaluate --data bad/test.json --detections toys/detections-jism.json --skip-bad >figures.txt 2>evaluate.err
says "ism: note: 1 of 2 images are left out, and $(grep -c '"image_id":1,' toys/detections-jism.json) results in them" evaluate.err
grep '"image_id":2,' toys/detections-jism.json | sed '1s/^/[/; $s/,*$/]/' >second.json
"$ism" evaluate --data bad/test.json --detections second.json --skip-bad 2>/dev/null | cmp - figures.txt ||
    fail "results in an image that was left out are measured"
objects=$(grep '"image_id":2,' bad/test.json | grep -c '"category_id"')
(($(awk '$1 == "mean" {print $2}' figures.txt) == objects)) || fail "objects of an image that was left out count: $(cat figures.txt)"
mkdir labels
cp toys/test.json labels
"$ism" evaluate --data labels/test.json --detections toys/detections-jism.json --skip-bad >/dev/null 2>evaluate.err
! grep -q "left out" evaluate.err || fail "labels without any image: $(cat evaluate.err)"

# An image without depth among others with it.
sed '0,/"depth_file_name":"[^"]*",/s///' toys/test.json >toys/part.json
refused "expected a depth image (depth_file_name)" "$ism" detect --model whole --data toys/part.json -o out --space ji3sm2

# Of labels that make no sense, a box without area and an outline without a pixel, these alone are left out.
sed -E '0,/"bbox":\[[^]]*\]/s//"bbox":[5,5,0,9]/; /"image_id":2,/s/"segmentation":\{[^}]*\}/"segmentation":[[1,1,1,2,1,3]]/' \
    toys/train.json >toys/labels.json
refused "2 labels and images cannot be used; nothing was written" "$ism" train --data toys/labels.json -o out
says "bbox: expected a width and height above 0, got 0x9" stderr.txt
says "mask: expected at least one figure pixel, got none" stderr.txt
"$ism" train --data toys/labels.json -o fewer --skip-bad --no-templates --no-depth >train.txt 2>/dev/null
says "images       24" train.txt
says "objects      22" train.txt

# What goes missing while others are searched is left out as well; where all was searched before it could, again.
mkdir rolling
lost_one() {
    for number in $(seq 10 49); do ln -f toys/train/train-0023.png rolling/$number.png; done
    "$ism" detect --model whole rolling --threads 1 --skip-bad --min-score 0 --json - 2>lost.err |
        (head -1 >/dev/null; rm rolling/49.png; cat >/dev/null)
    grep -qF "skipped: file 'rolling/49.png'" lost.err
}
lost_one || lost_one || lost_one || lost_one || fail "an image that went missing: $(cat lost.err)"
says "in 39 images, 1 skipped" lost.err
