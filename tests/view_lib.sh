# SPDX-License-Identifier: MIT
# view_lib.sh - what the suites of `smear view` share; sourced with the program as the first argument.
case ${1:-} in
'') echo "usage: sh $0 PROGRAM" >&2; exit 2 ;;
/*) smear=$1 ;;
*) smear=$PWD/$1 ;;
esac
base=$(mktemp -d "${TMPDIR:-/tmp}/smear-view.XXXXXX") || exit 1
here=$PWD
passed=0
failed=0
unset DISPLAY XAUTHORITY

# claim NAME COMMAND...: the command succeeds
claim() {
    claim_name=$1
    shift
    if "$@" >"$base/claim" 2>&1; then
        passed=$((passed + 1))
        [ -z "${VERBOSE:-}" ] || echo "$(date +%T) $claim_name"
    else
        failed=$((failed + 1))
        echo "FAIL: $claim_name"
        sed 's/^/    /' "$base/claim" | head -8
    fi
}

# run ARGUMENTS...: the program; afterwards $rc, $base/out, $base/err
run() {
    "$smear" "$@" >"$base/out" 2>"$base/err" </dev/null
    rc=$?
}

# Quietly succeeds, or says why not.
works() {
    run "$@"
    [ "$rc" -eq 0 ] && [ ! -s "$base/err" ] && return 0
    echo "exit $rc: $(cat "$base/err")"
    return 1
}

fails() { # STATUS SUBJECT ARGUMENTS...: that status, and one line about the subject
    status=$1
    subject=$2
    shift 2
    run "$@"
    [ "$rc" -eq "$status" ] || { echo "exit $rc: $(cat "$base/err")"; return 1; }
    [ "$(wc -l <"$base/err")" -eq 1 ] || { echo "not one line: $(cat "$base/err")"; return 1; }
    case $(cat "$base/err") in "smear: "$subject": "*) ;; *) cat "$base/err"; return 1 ;; esac
}

equals() { [ "$1" = "$2" ] || { echo "$1, not $2"; return 1; }; }
differ() { ! cmp -s "$1" "$2" || { echo "$1 and $2 are equal"; return 1; }; }
exists() { [ -f "$1" ] || { echo "no $1"; return 1; }; }
missing() { [ ! -e "$1" ] || { echo "$1 is there"; return 1; }; }
is_true() { awk "BEGIN { exit !($1) }" || { echo "not true: $1"; return 1; }; }
has() { grep -e "$2" "$1" >/dev/null || { head -5 "$1"; return 1; }; }

# wait_for SECONDS COMMAND...: until the command succeeds
wait_for() {
    tries=$(($1 * 10))
    shift
    while ! "$@" >/dev/null 2>&1; do
        tries=$((tries - 1))
        [ "$tries" -gt 0 ] || { echo "in vain: $*"; return 1; }
        sleep 0.1
    done
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

finish() {
    echo "$passed passed, $failed failed"
    [ "$failed" -eq 0 ]
    exit
}
