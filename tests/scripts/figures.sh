#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$here/../program/support.bash"

# Where nothing is built yet it says what to build.
mkdir -p tree/scripts data
cp "$here/../../scripts/figures" tree/scripts
refused_in_a_line "expected a folder of data, got 'nowhere'" tree/scripts/figures nowhere
refused_in_a_line "cmake --build build/release --target ism_program figure_sets" tree/scripts/figures data
tree/scripts/figures --help | grep -q "scripts/figures DATA_FOLDER" || fail "figures --help: expected how it is called"
