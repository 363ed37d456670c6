#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT
source "$(dirname "${BASH_SOURCE[0]}")/support.bash"

# Where no font is installed pictures are without words, which one line says; mistakes are told alone.
without_fonts=()
if [[ -d /usr/share/fonts ]]; then
    without_fonts=(unshare --map-root-user --mount bash -c 'mount -t tmpfs none /usr/share/fonts && exec "$0" "$@"')
    if ! "${without_fonts[@]}" true 2>/dev/null; then
        echo "skipped: fonts cannot be hidden from a program here"
        exit 0
    fi
fi
make_toys
model=toys/model.safetensors
"${without_fonts[@]}" "$ism" detect --model $model --data toys/test.json -o found.json --overlay overlays >/dev/null 2>told.txt
(($(grep -c "no font was found: pictures are without words" told.txt) == 1)) || fail "expected a line, got: $(cat told.txt)"
[[ -s overlays/test-0000.png ]] || fail "no overlay"
touch file
refused_in_a_line "folder 'file': expected a folder, got a file" \
    "${without_fonts[@]}" "$ism" detect --model $model --data toys/test.json -o out --overlay file
