#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT
source "$(dirname "${BASH_SOURCE[0]}")/support.bash"

# The demo on a small set writes all it says it writes, and may write over itself alone.
make_toys
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
! grep -qE 'src="[^d]|href=' toys/report.html || fail "the report needs other files"
cp toys/detections-jism.json before.json
"$ism" demo --small -o toys --threads 1 >again.txt
cmp before.json toys/detections-jism.json || fail "demo: other detections on one thread"
mkdir mine
touch mine/train.json
refused_in_a_line "an empty one or one of an earlier demo" "$ism" demo --small -o mine
