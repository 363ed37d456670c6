#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT
readme=$(dirname "${BASH_SOURCE[0]}")/../../README.md
source "$(dirname "${BASH_SOURCE[0]}")/support.bash"

# The README's commands for one's own labelled images, run one after another as they stand there, on toys.
make_toys
cd toys
mkdir -p build/release/bin
ln -s "$ism" build/release/bin/ism
grep -E '^    build/release/bin/ism ' "$readme" >commands.txt || fail "README: no command of the program"
for command in train detect evaluate; do
    grep -qE "^    build/release/bin/ism $command " commands.txt || fail "README: no line that runs $command"
done
while IFS= read -r line; do
    rm -f printed.txt
    bash -euo pipefail -c "$line" >printed.txt </dev/null || fail "README: $line"
    [[ -s printed.txt ]] || fail "README: $line: printed nothing"
done <commands.txt
for file in model.safetensors found.json report.html; do [[ -s $file ]] || fail "README: no $file"; done

# Every option that the README names is one of the program's.
for command in train detect evaluate demo inspect info; do "$ism" "$command" --help; done >help.txt
sed -n '/^## The program/,/^## Vote spaces/p' "$readme" | grep -oE '`[^`]*`' | grep -oE -- '--[a-z][a-z-]+' | sort -u >options.txt
(($(wc -l <options.txt) > 10)) || fail "README: expected the program's options, got $(cat options.txt)"
while IFS= read -r option; do
    grep -qE -- "$option( |,|$)" help.txt || [[ $option == --help ]] || fail "README: there is no option $option"
done <options.txt
