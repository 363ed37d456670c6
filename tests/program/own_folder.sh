#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT
source "$(dirname "${BASH_SOURCE[0]}")/support.bash"

# Every command from the folder of the data, with bare file names; the same as from outside.
make_toys
make_plain_model model
"$ism" detect --model model --data toys/test.json -o found.json --report report.html --overlay overlay >/dev/null
cd toys
"$ism" train --data train.json -o m.safetensors --no-templates >/dev/null
cmp m.safetensors ../model || fail "train: another model in the data's own folder"
"$ism" info m.safetensors >info.txt
says "car, mug, duck, robot" info.txt
"$ism" detect --model m.safetensors --data test.json -o f.json --report r.html --overlay o >/dev/null
cmp f.json ../found.json || fail "detect: other results in the data's own folder"
diff -r o ../overlay || fail "detect: other overlays in the data's own folder"
[[ -s r.html ]] || fail "detect: no report"
"$ism" evaluate --data test.json --detections f.json --json e.json --plot e.svg >figures.txt
says "mean " figures.txt
[[ -s e.json && -s e.svg ]] || fail "evaluate: no figures"
cp test/test-0000.png .
"$ism" detect --model m.safetensors test-0000.png -o one.json >/dev/null
"$ism" train --data train.json -o two.safetensors --class car --growable --no-templates >/dev/null
"$ism" train --data train.json -o three.safetensors --add-to two.safetensors --class mug >/dev/null
mkdir ../new
cd ../new
"$ism" demo --small -o . >/dev/null
[[ -s report.html && -s train.json ]] || fail "demo: nothing in its own folder"
