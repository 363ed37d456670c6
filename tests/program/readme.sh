#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
source "$(dirname "${BASH_SOURCE[0]}")/support.bash"
readme=$root/README.md

# The README's commands for one's own labelled images, run one after another as they stand there, on toys.
make_toys
cd toys
mkdir -p build/release/bin
ln -s "$ism" build/release/bin/ism
grep -E '^    build/release/bin/ism ' "$readme" >commands.txt || fail "README: no command of the program"
for command in inspect train detect evaluate info; do
    grep -qE "^    build/release/bin/ism $command " commands.txt || fail "README: no line that runs $command"
done
while IFS= read -r line; do
    rm -f printed.txt
    bash -euo pipefail -c "$line" >printed.txt </dev/null || fail "README: $line"
    [[ -s printed.txt ]] || fail "README: $line: printed nothing"
done <commands.txt
for file in data.html model.safetensors found.json report.html model.html; do [[ -s $file ]] || fail "README: no $file"; done

# Its program, compiled by its line, finds toys.
sed -n '/^```cpp$/,/^```$/p' "$readme" | sed '/^```/d' >find.cpp
line=$(grep -E '^    g\+\+ .* find\.cpp ' "$readme") || fail "README: no line that compiles find.cpp"
ln -s "$root/include" include
bash -euo pipefail -c "$line" || fail "README:$line"
image=test/test-0000.png
./find train.json "$image" >printed.txt || fail "README: find train.json $image"
grep -qE '^[a-z]+ at \([0-9]+, [0-9]+\), by [0-9]+ votes$' printed.txt || fail "README: find told $(cat printed.txt)"

# What the README and the pages point to is there; a lambda in their code is no link.
for page in "$readme" "$root"/docs/*.md; do
    { sed '/^```/,/^```/d' "$page" | grep -oE '\]\([^)#]+' || true; } | sed 's/^](//' | while IFS= read -r target; do
        [[ $target == http* || -e $(dirname "$page")/$target ]] || fail "$page: there is no $target"
    done
done

# Every option that the guide names is one of the program's.
for command in train detect evaluate demo inspect info; do "$ism" "$command" --help; done >help.txt
sed -n '/^## The program/,/^## What is wrong/p' "$root/docs/guide.md" | grep -oE '`[^`]*`' | grep -oE -- '--[a-z][a-z-]+' | sort -u >options.txt
(($(wc -l <options.txt) > 10)) || fail "guide: expected the program's options, got $(cat options.txt)"
while IFS= read -r option; do
    grep -qE -- "$option( |,|$)" help.txt || [[ $option == --help ]] || fail "guide: there is no option $option"
done <options.txt
