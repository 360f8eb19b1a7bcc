# SPDX-License-Identifier: MIT
# lib.sh - what suites of the shell share; sourced. A suite works in the folder $base, makes claims, and ends with finish.
make=${MAKE:-make}
LC_ALL=C
export LC_ALL
here=$PWD
passed=0
failed=0

# claim NAME COMMAND...: the command succeeds; what it says is shown where it does not
claim() {
    claim_name=$1
    shift
    if "$@" >"$base/claim" 2>&1; then
        passed=$((passed + 1))
        [ -z "${VERBOSE:-}" ] || echo "$(date +%T) $claim_name"
    else
        failed=$((failed + 1))
        echo "FAIL: $claim_name"
        sed 's/^/    /' "$base/claim" | head -n 20
    fi
}

# The last line, and the suite's status. One in which nothing was claimed has failed.
finish() {
    echo "$passed passed, $failed failed"
    [ "$failed" -eq 0 ] && [ "$passed" -gt 0 ]
    exit
}

# in_passing NAME: works in a new folder, which goes when the suite ends
in_passing() {
    base=$(mktemp -d "${TMPDIR:-/tmp}/smear-$1.XXXXXX") || exit 1
    trap 'rm -rf "$base"' EXIT
    trap 'exit 1' HUP INT TERM
}

absolute() { case $1 in /*) echo "$1" ;; *) echo "$here/$1" ;; esac; }

# ---------------------------------------------------------------------- what is claimed

same() { cmp "$1" "$2"; }
differ() { ! cmp -s "$1" "$2" || { echo "$1 and $2 are equal"; return 1; }; }
exists() { [ -f "$1" ] || { echo "no $1"; return 1; }; }
missing() { [ ! -e "$1" ] || { echo "$1 is there"; return 1; }; }
equals() { [ "$1" = "$2" ] || { echo "$1, not $2"; return 1; }; }
is_true() { awk "BEGIN { exit !($1) }" || { echo "not true: $1"; return 1; }; }
has() { grep -e "$2" "$1" >/dev/null || { head -n 5 "$1"; return 1; }; }

# fails_with TEXT COMMAND...: the command fails, and says the text
fails_with() {
    text=$1
    shift
    if "$@" >"$base/told" 2>&1; then
        echo "did not fail"
        return 1
    fi
    grep -q "$text" "$base/told" || { cat "$base/told"; return 1; }
}

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

# ---------------------------------------------------------------------- the program smear

# of_program [PROGRAM]: $smear is that program, from any folder
of_program() {
    [ -n "${1:-}" ] || { echo "usage: sh $0 PROGRAM" >&2; exit 2; }
    smear=$(absolute "$1")
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

# has_failed STATUS SUBJECT: the program has, with that status and one line about the subject
has_failed() {
    [ "$rc" -eq "$1" ] || { echo "exit $rc: $(cat "$base/err")"; return 1; }
    [ "$(wc -l <"$base/err")" -eq 1 ] || { echo "not one line: $(cat "$base/err")"; return 1; }
    case $(cat "$base/err") in "smear: "$2": "*) ;; *) cat "$base/err"; return 1 ;; esac
}

# fails STATUS SUBJECT ARGUMENTS...: the program does, in an empty folder, with that status, one line about the subject, and no file
fails() {
    status=$1
    subject=$2
    shift 2
    rm -rf "$base/empty" && mkdir "$base/empty" && cd "$base/empty" || return 1
    run "$@"
    left=$(ls -A "$base/empty")
    cd "$base/work" || return 1
    has_failed "$status" "$subject" || return 1
    [ ! -s "$base/out" ] || { echo "standard output: $(cat "$base/out")"; return 1; }
    [ -z "$left" ] || { echo "left behind: $left"; return 1; }
}

# ---------------------------------------------------------------------- the library

# Linker options that keep all functions of the interface.
interface() {
    sed -n 's/^[a-z].*[ *]\(smear_[a-z0-9_]*\)(.*/-u \1/p' include/smear.h include/smear_methods.h include/smear_stats.h \
        include/smear_model.h | grep -v '_fn$'
}

# Names of the switches of smear_config.h that leave one thing out.
switches() { sed -n 's/^#ifndef \(SMEAR_WITH_[A-Z0-9_]*\).*/\1/p' include/smear_config.h | grep -v _ALL; }

# without SWITCH: compiler options that leave it out, with what cannot be without it
without() {
    case $1 in
    SMEAR_WITH_SUBFRAMES) echo "-D$1=0 -DSMEAR_WITH_TIMEMASK=0 -DSMEAR_WITH_DAMAGE=0" ;;
    *) echo "-D$1=0" ;;
    esac
}
