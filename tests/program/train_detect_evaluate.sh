#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT
source "$(dirname "${BASH_SOURCE[0]}")/support.bash"

# Train, detect, evaluate on a few toys; the same files for any number of threads.
make_toys
for threads in 1 3; do
    "$ism" train --data toys/train.json -o model-$threads --threads $threads >train.txt
    "$ism" detect --model model-$threads --data toys/test.json -o found-$threads --space ji3sm3 \
        --report report-$threads.html --overlay overlay-$threads --threads $threads >detect.txt 2>timing.txt
done
cmp model-1 model-3 || fail "another model with 3 threads"
cmp found-1 found-3 || fail "other detections with 3 threads"
diff -r overlay-1 overlay-3 || fail "other overlays with 3 threads"
# (the report names the model, so only its size is compared)
(($(wc -c <report-1.html) == $(wc -c <report-3.html))) || fail "another report with 3 threads"
for line in "images       24" "objects      24" "words        " "occurrences  " "upsampling   " "orientation  upright (" \
    "templates    yes" "seconds      "; do
    says "$line" train.txt
done
for line in "images      2" "detections  "; do says "$line" detect.txt; done
for line in "seconds     " "ms/image    "; do says "$line" timing.txt; done
says "Learnt car (6 objects), mug (6 objects), duck (6 objects), robot (6 objects). Next:" train.txt
says " detect --model model-3 photo.jpg" train.txt
for key in '"image_id":1,' '"category_id":' '"bbox":[' '"segmentation":{' '"position_m":[' '"depth_m":' '"scale":'; do
    says "$key" found-1
done
[[ -s overlay-1/test-0000.png && -s overlay-1/test-0000_1.png && -s overlay-1/test-0001.png ]] || fail "overlays: $(ls overlay-1)"

"$ism" evaluate --data toys/test.json --detections found-1 --json figures.json --plot pr.svg >figures.txt
says "mean " figures.txt
says '"best_f1"' figures.json
says "<svg" pr.svg
"$ism" evaluate --data toys/test.json --detections found-1 --rule uiuc >uiuc.txt 2>note.txt
says "ism: note: no result is less probable than 0." note.txt
says " AP and EER are too low" note.txt
"$ism" detect --model model-1 --data toys/test.json -o all-1 --min-score 0 >/dev/null 2>&1
"$ism" evaluate --data toys/test.json --detections all-1 >/dev/null 2>note.txt
[[ ! -s note.txt ]] || fail "all is told, and yet: $(cat note.txt)"
"$ism" evaluate --data toys/test.json --detections found-1 --iou 0.99 >strict.txt
"$ism" evaluate --data toys/test.json --detections found-1 --rule coco --json coco.json >coco.txt
says "AP50 %" coco.txt
"$ism" evaluate --data toys/test.json --detections found-1 --rule coco-masks --json masks.json >masks.txt
says '"rule": "coco-masks"' masks.json
! cmp -s coco.txt masks.txt || fail "masks are measured as boxes: $(cat masks.txt)"
says '"ap75"' coco.json
refused_in_a_line "--rule coco: expected no --iou, got one" \
    "$ism" evaluate --data toys/test.json --detections found-1 --rule coco --iou 0.9
! cmp -s figures.txt strict.txt || fail "--iou changes nothing"

"$ism" info model-1 >info.txt
says "hessian-laplace" info.txt
says "car, mug, duck, robot" info.txt
says "exemplars       24" info.txt

says "templates       yes" info.txt

# What is missed is said beside the image that shows it.
"$ism" detect --model model-1 --data toys/test.json -o none --min-score 1 --report missed.html >/dev/null
says "test-0000.png: missed: " missed.html

# How much a report shows of how much, in words that are true.
"$ism" detect --model model-1 --data toys/test.json -o some --report some.html --report-most 1 >/dev/null
says "1 of 2 images: " some.html
says "explained here" some.html
"$ism" detect --model model-1 toys/test --report some.html --report-most 1 >/dev/null 2>&1
says "1 of 2 images: the first" some.html
refused_in_a_line "--report-most: expected a whole number, 1 or more, got '0'" \
    "$ism" detect --model model-1 --data toys/test.json -o out --report out.html --report-most 0
refused_in_a_line "--report" "$ism" detect --model model-1 --data toys/test.json -o out --report-most 3

# What is found on a crowd is neither right nor wrong, and drawn as what it is.
sed -E '/"image_id":1,/s/"iscrowd":0/"iscrowd":1/' toys/test.json >toys/crowd.json
grep -q '"iscrowd":1' toys/crowd.json || sed -E '/"image_id":1,/s/"category_id"/"iscrowd":1,&/' toys/test.json >toys/crowd.json
"$ism" detect --model model-1 --data toys/crowd.json -o crowd --report crowd.html >/dev/null
for text in "ignored: a crowd, or difficult" 'class="truth ignored"' ", ignored</span>"; do says "$text" crowd.html; done
! grep -qF "ignored: a crowd" report-1.html || fail "crowds in the legend of a set without any"

# Only what is probable; and the paper's way, votes alone, of a model without templates.
"$ism" detect --model model-1 --data toys/test.json -o probable --space ji3sm3 --min-score 0.5 >/dev/null
(($(grep -c image_id probable) <= $(grep -c image_id found-1))) || fail "--min-score tells more"
make_plain_model plain
"$ism" info plain >plain.txt
says "templates       no" plain.txt
"$ism" detect --model plain --data toys/test.json -o found-plain --rescore none --verify mdl >/dev/null
refused_in_a_line "--rescore template: expected a model with templates, got one without" \
    "$ism" detect --model plain --data toys/test.json -o out --rescore template
refused_in_a_line "--segment exemplars: expected a model with exemplars, got one without" \
    "$ism" detect --model plain --data toys/test.json -o out --segment exemplars
"$ism" detect --model model-1 --data toys/test.json -o found-patches --space ji3sm3 --segment patches >/dev/null
! cmp -s found-patches found-1 || fail "--segment changes nothing"
# What was cut out by exemplars changes how probable objects are, not which are found.
for segmenter in exemplars patches; do
    "$ism" detect --model model-1 --data toys/test.json -o all-$segmenter --space ji3sm3 --segment $segmenter --min-score 0 >/dev/null
done
(($(grep -c image_id all-exemplars) == $(grep -c image_id all-patches))) || fail "--segment changes what is found"
! cmp -s <(grep -o '"probability":[^,]*' all-patches) <(grep -o '"probability":[^,]*' all-exemplars) || fail "masks do not judge"
! cmp -s <(grep -o '"bbox":[^]]*' found-patches) <(grep -o '"bbox":[^]]*' found-1) || fail "boxes do not follow what was cut out"
! cmp -s found-plain found-1 || fail "templates change nothing"

# One class alone, and a class's own words.
"$ism" train --data toys/train.json -o cars --class car --detector dog --descriptor sift --no-templates >cars.txt
says "classes      car" cars.txt
says "objects      6" cars.txt
"$ism" detect --model cars --data toys/test.json -o found-cars --space ism --verify nms --keep 0.5 >/dev/null
! grep -v '"category_id":1,' found-cars | grep -q category_id || fail "detections of classes that were not learnt"
"$ism" train --data toys/train.json -o own --codebook per-class --no-templates --class robot --class duck --similarity 0.85 \
    --min-cluster-size 3 --min-information-gain 1e-6 --seed 4 >own.txt
says "classes      robot, duck" own.txt
"$ism" detect --model own --data toys/test.json -o found-own >/dev/null

# Objects that are turned in the image, learnt from upright ones: by votes and words, which turn.
"$ism" train --data toys/train.json -o free --orientation free --class car --class mug >free.txt
says "orientation  free (" free.txt
says "templates    no" free.txt
"$ism" info free >info.txt
says "orientation     free" info.txt
"$ism" detect --model free --data toys/test.json -o found-free >/dev/null
says '"bbox"' found-free
"$ism" train --data toys/train.json -o told --orientation upright --class car --no-templates >told.txt
grep -qx "orientation  upright" told.txt || fail "--orientation upright: $(cat told.txt)"

# One image without a data set: number 1, classes numbered as in the training file.
"$ism" detect --model model-1 toys/test/test-0000.png --depth toys/test/test-0000-depth.png --depth-scale 0.001 \
    --camera 262.5,262.5,159.5,119.5 --space ji3sm3 -o found-single >/dev/null
grep -F '"image_id":1,' found-1 | sed 's/,$//' >expected
grep -F '"image_id":1,' found-single | sed 's/,$//' >single
cmp expected single || fail "one image is not detected as the same image of a data set"

# A model written to what is no file.
"$ism" train --data toys/train.json -o /dev/null --class car --no-templates >/dev/null
