#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$here/../program/support.bash"

# Words that it does not know are refused, and all that it knows are in its help. Stand-ins: all is installed but two.
install=$here/../../scripts/install_dependencies
refused_in_a_line "expected program, clang, formats, benchmarks, bridges, bridge-tests, pages, packages or nothing, got 'bridge'" \
    "$install" bridge
refused_in_a_line "expected one word, got 'formats pages'" "$install" formats pages
"$install" --help >help.txt
mkdir tools
cat >tools/dpkg-query <<'EOF'
#!/bin/sh
case "$*" in *" dpkg-dev" | *" file") ;; *) echo installed ;; esac
EOF
printf '#!/bin/sh\necho "$@" >>"%s/apt.txt"\n' "$PWD" >tools/apt-get
printf '#!/bin/sh\nexec "$@"\n' >tools/sudo
chmod +x tools/*
export PATH="$PWD/tools:$PATH"
for word in program clang formats benchmarks bridges bridge-tests pages; do
    says "scripts/install_dependencies $word " help.txt
    [[ $word == bridge-tests ]] || "$install" "$word" || fail "install_dependencies $word"
done
[[ ! -e apt.txt ]] || fail "install_dependencies: expected all to be installed, got: $(cat apt.txt)"
says "scripts/install_dependencies packages " help.txt
"$install" packages >packages.txt
says "installing dpkg-dev file" packages.txt
grep -q 'install .* dpkg-dev file$' apt.txt || fail "install_dependencies packages: expected to install them, got: $(cat apt.txt)"
