# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT
# Read by the tests beside it: <program ism> <empty folder>.
set -euo pipefail
ism=$1
cd "$2"

fail() {
    echo "FAILED: $*" >&2
    exit 1
}

# A toy set of a few small pictures in toys/: train.json, test.json, model.safetensors. Where the test program/toys ran
# before, it has made them for all.
make_toys() {
    if [[ -e ../toys/toys/report.html ]]; then
        cp -r ../toys/toys toys
    else
        "$ism" demo --small -o toys --threads 2 >/dev/null 2>demo.err || fail "demo: $(cat demo.err)"
    fi
}

# The model `$1` of these toys, without templates, and in train.txt what its training told.
make_plain_model() {
    if [[ -e ../toys/plain ]]; then
        cp ../toys/train.txt train.txt
        cp ../toys/plain "$1"
    else
        "$ism" train --data toys/train.json -o "$1" --no-templates --threads 2 >train.txt
    fi
}

# Sets `data` to the folder of the real images. Where they are missing the test is skipped, with CI set it fails.
need_data() {
    data=${ISM_DATA:-$here/../../../shared/data}
    [[ ! -f $data/four-class/train.json ]] || return 0
    [[ -z ${CI:-} ]] || fail "no data in $data; set ISM_DATA to the folder of the data"
    exit 77
}

# refused <text> <command...>: ends with 2, says `text` on stderr, nothing on stdout, and leaves no file out*.
refused() {
    local text=$1 code=0
    shift
    "$@" >stdout.txt 2>stderr.txt || code=$?
    ((code == 2)) || fail "$*: expected exit code 2, got $code: $(cat stderr.txt)"
    grep -qF -- "$text" stderr.txt || fail "$*: expected '$text', got: $(cat stderr.txt)"
    [[ ! -s stdout.txt ]] || fail "$*: expected nothing on stdout, got: $(cat stdout.txt)"
    ! compgen -G 'out*' >/dev/null || fail "$*: left $(echo out*)"
}

# refused_in_a_line: the same, and stderr is one line.
refused_in_a_line() {
    refused "$@"
    (($(wc -l <stderr.txt) == 1)) || fail "$*: expected one line, got: $(cat stderr.txt)"
}

# says <text> <file>
says() {
    grep -qF -- "$1" "$2" || fail "$2: expected '$1', got: $(cat "$2")"
}

# covered_depth <file>: writes depth of 320 x 240 pixels without a reading, as of a covered lens.
covered_depth() {
    base64 -d >"$1" <<'EOF'
iVBORw0KGgoAAAANSUhEUgAAAUAAAADwEAAAAAAE1j70AAAArElEQVR42u3BMQEAAADCoPVPbQlPoAAAAAAAAAAAAAAAAAAAAAAA
AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA
AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAPgZZDgABUiiYNAAAAABJRU5E
rkJggg==
EOF
}
