#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$here/support.bash"

# Photographs with masks as people have them: a folder a class, Pascal VOC, YOLO, labelme. The same is learnt of each.
need_data
"$(dirname "$ism")/other_formats" "$data/four-class/train.json" sets 3
sets=(folders labelme yolo)
mkdir pictures
cp sets/folders/car/car-1.jpg pictures/
if "$ism" train --data sets/voc -o model-voc --no-templates >voc.txt 2>err.txt; then
    sets+=(voc)
else
    says "expected a program built with pugixml (libpugixml-dev) to read Pascal VOC, got one without" err.txt
fi
for set in "${sets[@]}"; do
    "$ism" train --data sets/$set -o model-$set --no-templates --threads 2 >$set.txt || fail "train: $set"
    says "classes      car, cow, horse, motorbike" $set.txt
    says "images       12" $set.txt
    says "objects      12" $set.txt
    "$ism" detect --model model-folders --data sets/$set -o found-$set >/dev/null
    cmp found-folders found-$set || fail "$set: other images than in the folders"
    "$ism" evaluate --data sets/$set --detections found-$set >figures.txt
    says "accuracy 100.0 %" figures.txt
done
same() { grep -E '^(features|words|occurrences)' "$1"; }
for set in "${sets[@]}"; do
    [[ $set == yolo ]] || cmp <(same folders.txt) <(same $set.txt) || fail "$set: another model than of the folders"
done
! cmp -s <(same folders.txt) <(same yolo.txt) || fail "yolo has boxes alone, but its model is that of the masks"

# Images without labels, for detection alone; a class that no label of a data set names.
"$ism" detect --model model-folders --data pictures -o found-pictures >/dev/null
says '"image_id":1,' found-pictures
refused_in_a_line "'pictures': expected labels to learn from, got images without (labels are folders named as classes" "$ism" train --data pictures -o out
"$ism" inspect --data pictures >without.txt
says "no labels: there is nothing to learn from these images" without.txt
mkdir cows
cp -r sets/folders/cow cows/
mkdir cows/background
cp sets/folders/car/car-1.jpg cows/background/
"$ism" detect --model model-folders --data cows -o found-cows >/dev/null
"$ism" evaluate --data cows --detections found-cows >figures.txt 2>err.txt
says "cow " figures.txt
sed 's/"class":"cow"/"class":"bull"/' found-cows >found-bulls
"$ism" evaluate --data cows --detections found-bulls >/dev/null 2>err.txt
says "results are left out: no label names bull" err.txt
says "(labels name cow)" err.txt
! grep -q "^car" figures.txt || fail "a class without labels: $(cat figures.txt)"

# What makes no sense is said in a line, by file and place, or left out.
sed -i '1s/.*/7 .5 .5 .1 .1/' sets/yolo/labels/train/car-1.txt
refused_in_a_line "labels/train/car-1.txt', line 1: class: expected a whole number below 4, got 7" \
    "$ism" train --data sets/yolo -o out
"$ism" train --data sets/yolo/data.yaml -o fewer --skip-bad --no-templates >fewer.txt 2>err.txt
says "objects      11" fewer.txt
says "images       12" fewer.txt
(($(wc -l <err.txt) == 1)) || fail "expected one label, got: $(cat err.txt)"
for i in {1..30}; do echo "9 .5 .5 .1 .1"; done >sets/yolo/labels/train/car-2.txt
"$ism" train --data sets/yolo -o fewer --skip-bad --no-templates >fewer.txt 2>err.txt
says "ism: ... and 11 more" err.txt
(($(wc -l <err.txt) == 21)) || fail "expected 20 labels and a count, got: $(cat err.txt)"
refused "31 labels and images cannot be used; nothing was written" "$ism" train --data sets/yolo -o out
echo "no picture" >sets/folders/car/car-1.jpg
refused_in_a_line "car/car-1.jpg': expected a PNG, JPEG, BMP or PNM image, got something else" "$ism" train --data sets/folders -o out
refused_in_a_line "expected a file or folder of labels, got an image" "$ism" train --data pictures/car-1.jpg -o out
mkdir empty
refused_in_a_line "folder 'empty': expected a data set, got no image" "$ism" train --data empty -o out

if [[ -e model-voc ]]; then
    mkdir -p sets/voc/ImageSets/Main
    printf 'car-1 1\ncow-2 -1\n' >sets/voc/ImageSets/Main/train.txt
    sed -i 's/<difficult>0/<difficult>1/' sets/voc/Annotations/cow-1.xml
    "$ism" train --data sets/voc/ImageSets/Main/train.txt -o fewer --no-templates >fewer.txt
    says "classes      car, cow" fewer.txt
    "$ism" train --data sets/voc -o fewer --no-templates >fewer.txt
    says "images       12" fewer.txt
    says "objects      11" fewer.txt
    xml=sets/voc/Annotations/car-1.xml
    cp $xml whole.xml
    head -c 150 whole.xml >$xml
    refused_in_a_line "car-1.xml': expected well-formed XML, got, at byte" "$ism" train --data sets/voc -o out
    echo '<other/>' >$xml
    refused_in_a_line "car-1.xml': expected Pascal VOC's <annotation>, got another XML" "$ism" train --data sets/voc -o out
    sed 's/<xmin>[^<]*/<xmin>ten/' whole.xml >$xml
    refused_in_a_line "car-1.xml', object 1: xmin: expected a number, got 'ten'" "$ism" train --data sets/voc -o out
    sed 's/<width>[^<]*/<width>77/' whole.xml >$xml
    refused_in_a_line "pixels as its labels say, got" "$ism" train --data sets/voc -o out
    rm sets/voc/JPEGImages/car-1.*
    refused_in_a_line "car-1.xml': filename: expected an image in" "$ism" train --data sets/voc -o out
fi

# WebP and TIFF where the program was built with them: the same pixels, the same detections.
"$ism" detect --model model-folders sets/first.png -o found-png >/dev/null
for ending in webp tif; do
    if [[ -e sets/first.$ending ]]; then
        "$ism" detect --model model-folders sets/first.$ending -o found-$ending >/dev/null
        cmp found-png found-$ending || fail "$ending: other pixels"
        head -c 3000 sets/first.$ending >cut.$ending
        refused_in_a_line "cut.$ending': expected a whole image" "$ism" detect --model model-folders cut.$ending -o out
    else
        printf 'II*\0RIFF' >first.tif
        printf 'RIFF1234WEBPVP8 ' >first.webp
        refused_in_a_line "expected a program built with" "$ism" detect --model model-folders first.$ending -o out
    fi
done
