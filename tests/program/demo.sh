#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT
source "$(dirname "${BASH_SOURCE[0]}")/support.bash"

# The demo on a small set writes all it says it writes, and may write over itself alone.
"$ism" demo --small -o toys --threads 2 >demo.txt 2>demo.err || fail "demo: $(cat demo.err)"
for space in ism jism ji3sm1 ji3sm2 ji3sm3; do
    grep -qE "^$space +[0-9.]+ +[0-9.]+ +[0-9.]+ +[0-9.]+ +0\.[0-9]+ +[0-9]+$" demo.txt ||
        fail "demo: expected a line of figures for $space, got: $(cat demo.txt)"
    [[ -s toys/detections-$space.json ]] || fail "demo: no detections of $space"
done
for file in model.safetensors report.html pr.svg train.json test.json overlays/test-0000.png overlays/test-0000_1.png; do
    [[ -s toys/$file ]] || fail "demo: no $file"
done
says synthetic demo.txt
says synthetic toys/report.html
! grep -qE '(src|href)="[^d#]' toys/report.html || fail "the report needs other files"
cp toys/detections-jism.json before.json
"$ism" demo --small -o toys --threads 1 >again.txt
cmp before.json toys/detections-jism.json || fail "demo: other detections on one thread"

# It ends with what opens its report, and three commands to try next, which work as they stand there.
grep -qE '^  (xdg-open toys/report.html|open toys/report.html|file:///.*/toys/report.html)$' demo.txt || fail "demo: how to see the report: $(cat demo.txt)"
tail -3 demo.txt | sed 's/^  //' >commands.txt
mkdir next
cp -r toys/train toys/test toys/train.json toys/test.json next
cp toys/test/test-0000.png next/photo.jpg
cd next
while IFS= read -r line; do
    bash -euo pipefail -c "$line" >printed.txt 2>&1 </dev/null || fail "demo: $line: $(cat printed.txt)"
done <../commands.txt
for file in model.safetensors photo.ism.png found.html; do [[ -s $file ]] || fail "demo: no $file after $(cat ../commands.txt)"; done
cd ..
mkdir mine
touch mine/train.json
refused_in_a_line "an empty one or one of an earlier demo" "$ism" demo --small -o mine
