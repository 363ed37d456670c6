#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$here/support.bash"

# The experiments of the paper, on a few images of each set, end in a page that needs no other file.
reproduce=$(dirname "$ism")/reproduce
refused_in_a_line "expected a folder of data sets" "$reproduce" nowhere -o out
mkdir nothing
refused_in_a_line "nothing/osd/train.json: expected a file of the data, got none" "$reproduce" nothing -o out --depth
need_data
touch a_file
refused_in_a_line "folder 'a_file': expected a folder, got a file" "$reproduce" "$data" -o a_file --quick
"$reproduce" "$data" -o page --quick --threads 2 >figures.txt
for line in '^separate +2 .* 27[0-9]{2}$' '^joint +1 .* 45[0-9]{2}$' '^ji3sm3 .* 6[0-9] % ' '^votes and templates \(default\) +[0-9.]+ %'; do
    grep -qE "$line" figures.txt || fail "reproduce: expected a line like $line, got: $(cat figures.txt)"
done
for text in "<title>The experiments of the paper</title>" "separate, T_Q = 0" "joint, T_Q = 2" "uiuc-cars" "weizmann-horses" \
    "Depth in the vote space" "Toy cars (rendered)" "The car between two cars" "Worse pictures" "Seconds"; do
    says "$text" page/report.html
done
(($(grep -o '<svg xmlns' page/report.html | wc -l) == 16)) || fail "the page: expected 16 plots"
! grep -qE '(src|href)="[^d#]' page/report.html || fail "the page needs other files"
