#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT
source "$(dirname "${BASH_SOURCE[0]}")/support.bash"

# What ism detect tells of pictures: a line an object, JSON, pictures beside them, and that nothing was found.
make_toys
mkdir temporary
export TMPDIR=$PWD/temporary
# The training file has numbers of its own.
sed -E 's/"category_id":([1-4])/"category_id":\10/g; s/\{"id":([1-4]),"name"/{"id":\10,"name"/g' toys/train.json >toys/tens.json
"$ism" train --data toys/tens.json -o model --class car --class mug >/dev/null
# A class that is listed and not shown is left out.
sed 's/"categories": *\[/&{"id":99,"name":"tin"},/' toys/tens.json >toys/tin.json
"$ism" train --data toys/tin.json -o with-tin --no-templates >/dev/null 2>tin.txt || fail "a class that nothing shows"
says "left out, since no label is of this class: tin" tin.txt
"$ism" train --data toys/tens.json -o without-tin --no-templates >/dev/null
cmp with-tin without-tin || fail "a class that nothing shows changes the model"
mkdir photos
for i in 0 1; do cp toys/test/test-000$i.png photos/$i.png; done
detect=("$ism" detect --model model)
"$ism" info model >info.txt
says "category ids    10, 20" info.txt

# A line an object on standard output, twelve fields; how long it took elsewhere.
"${detect[@]}" photos/0.png photos/1.png >lines.txt 2>timing.txt
(($(wc -l <lines.txt) > 1)) || fail "expected objects, got: $(cat lines.txt)"
awk -F '\t' 'NF != 12 || $1 !~ /^photos\/[01]\.png$/ || $2 !~ /^(car|mug)$/ || $3 < .2 || $3 > 1 ||
             $4 < 0 || $5 < 0 || $4 + $6 > 320.05 || $5 + $7 > 240.05 || $8 != "-" || $9 != "-" {print; bad = 1} END {exit bad}' lines.txt ||
    fail "lines: $(cat lines.txt)"
grep -qE "^$(wc -l <lines.txt) objects in 2 images, .* ms an image" timing.txt || fail "timing: $(cat timing.txt)"

# Folders, patterns, standard input, and overlays that are left out.
"${detect[@]}" photos >folder.txt 2>/dev/null
cmp lines.txt folder.txt || fail "a folder is other than its pictures"
"${detect[@]}" 'photos/?.png' >pattern.txt 2>/dev/null
cmp lines.txt pattern.txt || fail "a pattern is other than its pictures"
"${detect[@]}" - <photos/0.png >stdin.txt 2>/dev/null
cmp <(grep '^photos/0' lines.txt | cut -f 2-) <(cut -f 2- stdin.txt) || fail "standard input is other than its file"
grep -qvP '^-\t' stdin.txt && fail "standard input is not named -"
"${detect[@]}" - --overlay drawn <photos/0.png >/dev/null 2>&1
[[ -s drawn/stdin.png ]] || fail "overlays of standard input: $(ls drawn)"
# What is kept beside the best is as it was without.
"${detect[@]}" photos/0.png --min-score 0 >all.txt 2>/dev/null
(($(wc -l <all.txt) > 1)) || fail "--min-score 0: $(cat all.txt)"
for keep in .5 1; do
    "${detect[@]}" photos/0.png --min-score 0 --keep $keep >kept.txt 2>/dev/null
    cmp <(head -1 all.txt) <(head -1 kept.txt) || fail "--keep $keep: $(cat kept.txt)"
    (($(wc -l <kept.txt) < $(wc -l <all.txt))) || fail "--keep $keep keeps all"
done
"${detect[@]}" photos --show >/dev/null 2>shown.txt
says "shown in photos/0.ism.png and 1 more" shown.txt
[[ -s photos/0.ism.png && -s photos/1.ism.png ]] || fail "--show: $(ls photos)"
cmp photos/0.png toys/test/test-0000.png || fail "--show wrote over its input"
for again in photos 'photos/*' "photos/0.png photos/0.ism.png photos/1.png"; do
    "${detect[@]}" $again --show >again.txt 2>/dev/null || fail "--show once more: $again"
    cmp lines.txt again.txt || fail "$again: overlays are looked at"
done
cp toys/test/test-0000-depth.png photos/0-depth.png
"${detect[@]}" photos >again.txt 2>left-out.txt
cmp lines.txt again.txt || fail "depth images are looked at"
says "left out as depth: 1 of the images" left-out.txt
rm photos/0-depth.png

# Depth and camera give places in metres and what they may be off by; depth alone the depth.
shot=(toys/test/test-0000.png --depth toys/test/test-0000-depth.png --depth-scale 0.001)
"${detect[@]}" "${shot[@]}" --camera 262.5,262.5,159.5,119.5 >metres.txt 2>/dev/null
awk -F '\t' '$8 < .3 || $8 > 3 || $11 < .3 || $11 > 3 {bad = 1} $12 != "-" {known = 1} END {exit bad || !known}' metres.txt ||
    fail "places: $(cat metres.txt)"
"${detect[@]}" "${shot[@]}" --camera ' 262.5, 262.5,159.5 , 119.5' >blanks.txt 2>/dev/null
cmp metres.txt blanks.txt || fail "blanks in --camera"
"${detect[@]}" "${shot[@]}" --camera 262.5,262.5,459.5,119.5 >/dev/null 2>note.txt
says "note: file 'toys/test/test-0000.png': the camera's principal point (459.5, 119.5) is outside of the image" note.txt
"${detect[@]}" "${shot[@]}" >depth.txt 2>/dev/null
awk -F '\t' '$8 != "-" {known = 1} $9 != "-" {bad = 1} END {exit bad || !known}' depth.txt || fail "depth: $(cat depth.txt)"

# People on a terminal get a table, which is looked at where a terminal can be made.
if script -qec true /dev/null </dev/null >/dev/null 2>&1; then
    script -qec "'$ism' detect --model model '${shot[0]}'" /dev/null </dev/null >table.txt 2>&1
    grep -qE 'class +probability +x, y, width, height' table.txt || fail "table: $(cat table.txt)"
else
    echo "found: no terminal can be made here: the table is left out"
fi

# Where the image is turned, too, what stands upright is still found, and what lies there has an angle.
"${detect[@]}" photos/0.png --min-score 0 --json - >upright.txt 2>/dev/null
"${detect[@]}" photos/0.png --min-score 0 --turns 4 --json - >turned.txt 2>/dev/null
! grep -q '"angle_rad":' upright.txt || fail "angles of what is upright: $(cat upright.txt)"
says '"angle_rad":' turned.txt
says "$(grep -oE '"bbox":[^]]*\]' upright.txt | head -1)" turned.txt
! "${detect[@]}" photos/0.png --turns 0 2>said.txt || fail "--turns 0 is taken"
says "--turns: expected a whole number, from 1 to 360, got '0'" said.txt
! "${detect[@]}" photos/0.png --turns 4 --space metric 2>said.txt || fail "--turns 4 --space metric is taken"
says "--turns: expected 1 in the space metric, which finds what is turned, got 4" said.txt

# JSON, a line an image, with the numbers of the training file; the same as COCO results.
"${detect[@]}" photos/0.png photos/1.png --json - >json.txt 2>/dev/null
(($(wc -l <json.txt) == 2)) || fail "--json: expected two lines, got: $(cat json.txt)"
says '"file":"photos/1.png"' json.txt
says '"class":"car"' json.txt
says '"category_id":10,' json.txt
says '"segmentation":{' json.txt
! grep -qE 'null|depth_m|position_m|image_id' json.txt || fail "--json tells what is not known: $(cat json.txt)"
"${detect[@]}" photos/0.png photos/1.png --json file.json -o found.json >both.txt 2>/dev/null
cmp json.txt file.json || fail "--json FILE is other than --json -"
cmp lines.txt both.txt || fail "files take the lines away"
(($(grep -o '"class":' json.txt | wc -l) == $(grep -c '"class":' found.json))) || fail "-o has other objects"
"${detect[@]}" photos/0.png photos/1.png -o - 2>/dev/null | cmp - found.json || fail "-o - is other than a file"

# A line of JSON goes out as soon as its image is done, in the order of the images. More is told here than a pipe holds, so
# that until it is read on after the first line the program cannot come to its end, where it writes the file of -o.
deep=deep
for _ in {1..12}; do deep+=/$(printf '%0.sx' {1..250}); done
mkdir -p "$deep"
for i in {10..33}; do cp photos/$((i % 2)).png "$deep/$i.png"; done
mkfifo told
"${detect[@]}" "$deep" --threads 2 --json - -o last.json >told 2>/dev/null &
exec 3<told
read -r first <&3
[[ ! -e last.json ]] || fail "--json - waits until all images are done"
{ echo "$first" && cat <&3; } >streamed.txt
exec 3<&-
wait $! || fail "--json - into a pipe: $?"
(($(wc -c <streamed.txt) > 70000)) || fail "too little is told to fill a pipe: $(wc -c <streamed.txt)"
"${detect[@]}" "$deep" --threads 1 --json whole.json >/dev/null 2>&1
cmp streamed.txt whole.json || fail "--json - is other than --json FILE"
rm -r deep

"${detect[@]}" --data toys/test.json --json data.json >/dev/null 2>&1
says '"image_id":2' data.json
says '"position_m":[' data.json
"${detect[@]}" --data toys/test.json >data.txt 2>/dev/null
(($(wc -l <data.txt) == $(grep -o '"class":' data.json | wc -l))) || fail "--data without files: $(cat data.txt)"

# Where data and model number a class otherwise, this is said, and results are matched by name.
"${detect[@]}" --data toys/test.json -o other.json >/dev/null 2>note.txt
says "note: class 'car' has category id 1 in 'toys/test.json'; results have the model's, 10" note.txt
sed -E 's/"category_id":([1-4])0/"category_id":\1/; s/"class":"[a-z]+",//' other.json >same.json
"$ism" evaluate --data toys/test.json --detections other.json >other.txt
"$ism" evaluate --data toys/test.json --detections same.json >same.txt
cmp other.txt same.txt || fail "evaluation does not go by names"
"${detect[@]}" --data toys/test.json -o mistakes.json --report mistakes.html >/dev/null 2>&1 || fail "--report with other numbers"

# Nothing found is said, with the best guess; it comes with the score that is named.
"${detect[@]}" photos/0.png --min-score 1 >none.txt 2>guess.txt
[[ ! -s none.txt ]] || fail "--min-score 1: $(cat none.txt)"
grep -qE "^photos/0.png: nothing found; the best guess is [a-z]+, [0-9.]+ % before it is cut out, at [0-9, ]+ \(--min-score 0 tells it\)$" guess.txt ||
    fail "nothing found: $(cat guess.txt)"
# What was cut out to know is told by the limit that is named: one a little above what it has.
probability=$("${detect[@]}" photos/0.png --min-score 0 --json - 2>/dev/null | grep -oE '"probability":[0-9.]+' | head -1 | cut -d : -f 2)
"${detect[@]}" photos/0.png --min-score "$(awk "BEGIN {print $probability + .0005}")" >none.txt 2>guess.txt
[[ ! -s none.txt ]] || fail "a limit above $probability: $(cat none.txt)"
grep -qE "^photos/0.png: nothing found; the best guess is [a-z]+, [0-9.]+ %, at [0-9, ]+ \(told with --min-score 0\.[0-9]+\)$" guess.txt ||
    fail "nothing found, but something cut out: $(cat guess.txt)"
score=$(grep -oE 'min-score [0-9.]+' guess.txt | cut -d ' ' -f 2)
"${detect[@]}" photos/0.png --min-score "$score" 2>/dev/null | grep -q . || fail "--min-score $score tells nothing"
"${detect[@]}" photos/0.png --min-score 1 --json - 2>/dev/null | grep -q '"detections":\[\].*"next_best":{' || fail "--json: no best guess"

# What is wrong.
line=refused_in_a_line
$line "standard input: expected an image, got nothing" "${detect[@]}" - </dev/null
$line "standard input: expected a whole image, got a truncated PNG" "${detect[@]}" - < <(head -c 2000 photos/0.png)
$line "pattern 'none*.png': expected a file that is an image" "${detect[@]}" 'none*.png'
$line "file 'none.png': expected an image to read, got none of this name" "${detect[@]}" photos/0.png none.png
$line "file 'toys/test.json': expected an image, got JSON (a data set goes with --data)" "${detect[@]}" toys/test.json
mkdir empty
$line "folder 'empty': expected a file that is an image (PNG, JPEG, BMP, PNM), got none; folders in it are not looked into" "${detect[@]}" empty
$line "detect: expected --model, got none: did you mean --model toys/model.safetensors?" "$ism" detect toys/model.safetensors photos/0.png
$line "detect: expected --model, got none; ism detect --help tells more" "$ism" detect photos/0.png
$line "--show: expected files to write beside, got standard input" "${detect[@]}" - --show <photos/0.png
$line "--json: expected another file than -o, got the same" "${detect[@]}" photos/0.png -o - --json -
$line "'photos/1.png': expected another file than an input" "${detect[@]}" photos -o photos/1.png
$line "'nowhere/out.json': expected an existing folder" "${detect[@]}" photos/0.png --json nowhere/out.json
head -c 3000 photos/1.png >photos/cut.png
refused "1 of 3 images cannot be used" "${detect[@]}" photos -o out
"${detect[@]}" photos --skip-bad >skipped.txt 2>/dev/null
cmp lines.txt skipped.txt || fail "--skip-bad: $(cat skipped.txt)"
[[ -z $(ls temporary) ]] || fail "standard input was left: $(ls temporary)"

# Without a word: the four commands to type first.
code=0
"$ism" >stdout.txt 2>first.txt || code=$?
((code == 2)) || fail "without arguments: expected exit code 2, got $code"
for command in "demo" "train --data train.json -o model.safetensors" "detect --model model.safetensors photo.jpg" \
    "evaluate --data test.json --detections found.json"; do says " $command" first.txt; done
"$ism" help detect >help.txt
cmp help.txt <("$ism" detect --help) || fail "ism help detect"
