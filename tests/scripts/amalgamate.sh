#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$here/../program/support.bash"

# Writes what is a new or a regular file, wherever it is called from, and nothing else.
amalgamate=$here/../../scripts/amalgamate
"$amalgamate" --help | grep -q '^ *scripts/amalgamate \[FILE\]' || fail "amalgamate --help: expected how it is called"
ln -s "$(readlink -f "$amalgamate")" linked
CDPATH=/ ./linked first.hpp || fail "amalgamate: called by a link"
echo old >second.hpp
"$amalgamate" second.hpp
cmp first.hpp second.hpp || fail "amalgamate: expected the same in place of a file as in a new one"
mkfifo pipe
mkdir folder
ln -s first.hpp link
for file in pipe folder link; do
    refused_in_a_line "$file: expected a new or a regular file" "$amalgamate" "$file"
done
[[ -p pipe && -L link && -z $(ls -A folder) ]] || fail "amalgamate: replaced what is no file: $(ls -lR)"
refused_in_a_line "nowhere/one.hpp: expected to be in a folder" "$amalgamate" nowhere/one.hpp
refused_in_a_line "expected FILE or --help first, got '-o'" "$amalgamate" -o
! compgen -G '*.hpp.*' >/dev/null || fail "amalgamate: left $(echo *.hpp.*)"
