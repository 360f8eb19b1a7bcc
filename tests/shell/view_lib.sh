# SPDX-License-Identifier: MIT
# view_lib.sh - what the suites of `smear view` share; sourced with the program as the first argument.
. "$(dirname "$0")/lib.sh"
of_program "$@"
in_passing view
unset DISPLAY XAUTHORITY
race=builtin:demo/race

fails() { # STATUS SUBJECT ARGUMENTS...: that status, and one line about the subject
    status=$1
    subject=$2
    shift 2
    run "$@"
    has_failed "$status" "$subject"
}

# CRCs as view prints them
crcs() { sed -n 's/^frame=.* crc32=//p' "$base/out"; }
# CRCs of render's frames A-B with further options
render_crcs() { # SCENE A-B OPTIONS...
    scene=$1
    range=$2
    shift 2
    "$smear" render "$scene" --frames "$range" --stats "$base/stats.json" "$@" || return 1
    sed -n 's/.*"crc32":"\([0-9a-f]*\)".*/\1/p' "$base/stats.json"
}
