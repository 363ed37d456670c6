#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT
source "$(dirname "${BASH_SOURCE[0]}")/support.bash"

# Classes one after another; the same model for any number of threads.
make_toys
"$ism" train --data toys/train.json -o two --class car --class mug --detector dog --growable --no-templates >/dev/null
for threads in 1 2; do
    "$ism" train --data toys/train.json -o four-$threads --add-to two --class robot --class duck \
        --threads $threads >add.txt
done
cmp four-1 four-2 || fail "another model with 2 threads"
says "classes      car, mug, robot, duck" add.txt
says "(dog, root-sift)" add.txt
says "images       24" add.txt
says "objects      24" add.txt
"$ism" info four-1 >info.txt
says "detector        dog" info.txt
"$ism" detect --model four-1 --data toys/test.json -o found >/dev/null
"$ism" evaluate --data toys/test.json --detections found >figures.txt
says "mean " figures.txt

# More examples of a class it has.
"$ism" train --data toys/train.json -o more --add-to two --class car >more.txt
says "classes      car, mug" more.txt
says "objects      18" more.txt

"$ism" train --data toys/train.json -o few --add-to two --class duck --max-words 40 >few.txt
says "words        40" few.txt

# A model without training features is smaller, and says what it lacks.
"$ism" train --data toys/train.json -o small --class car --class mug --detector dog --no-templates >/dev/null
(($(wc -c <small) < $(wc -c <two))) || fail "--growable keeps nothing"
"$ism" info two | grep -qx "growable        yes, by --add-to" || fail "info two: $("$ism" info two)"
"$ism" info small | grep -qx "growable        no" || fail "info small: $("$ism" info small)"
refused_in_a_line "train with --growable" "$ism" train --data toys/train.json -o out --add-to small --class duck

# Words of each class stay so.
"$ism" train --data toys/train.json -o own --codebook per-class --class car --class mug --growable >own.txt
"$ism" train --data toys/train.json -o own-more --add-to own --class duck >own-more.txt
says "classes      car, mug, duck" own-more.txt
"$ism" info own-more >own-info.txt
says "exemplars       18" own-info.txt

# What contradicts the model.
refused_in_a_line "expected --detector or --add-to, got both" "$ism" train --data toys/train.json -o out --add-to two --detector dog
refused_in_a_line "expected --similarity or --add-to, got both" "$ism" train --data toys/train.json -o out --add-to two --similarity .9
refused_in_a_line "another file than an input" "$ism" train --data toys/train.json -o two --add-to two
refused_in_a_line "none-there" "$ism" train --data toys/train.json -o out --add-to none-there
