#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT
source "$(dirname "${BASH_SOURCE[0]}")/support.bash"

# What the other tests of the program learn from and search, made once.
make_toys
for file in train.json test.json model.safetensors report.html; do [[ -s toys/$file ]] || fail "no toys/$file"; done
make_plain_model plain.new
mv plain.new plain # whole when it has its name
