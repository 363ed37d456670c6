#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$here/../program/support.bash"

# The script builds in its own tree and runs the demo where it was called. Stand-ins install and build.
mkdir -p "tree/scripts" tree/build/release/bin tools caller
cp "$here/../../scripts/demo" tree/scripts
touch tree/build/release/build.ninja
printf '#!/bin/sh\ncase "$PWD" in */tree) ;; *) exit 1 ;; esac\n' | tee tree/scripts/install_dependencies >tools/cmake
printf '#!/bin/sh\necho "$PWD $*"\n' >tree/build/release/bin/ism
chmod +x tree/scripts/install_dependencies tools/cmake tree/build/release/bin/ism
ln -s ../tree/scripts/demo caller/demo
cd caller
for script in ../tree/scripts/demo ./demo; do
    told=$(PATH="$2/tools:$PATH" CDPATH=/ "$script" -o out)
    [[ $told == "$PWD demo -o out" ]] || fail "$script: expected the demo to run in $PWD, got '$told'"
done
