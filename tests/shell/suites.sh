# SPDX-License-Identifier: MIT
# suites.sh - runs suites and adds up; sourced by all.sh. Each suite's output goes to build/test/NAME.log and is shown when it
# fails.
#
# A suite whose tools are missing is named together with the command that installs them. With CI=true that is a
# failure: there, everything runs.
set -u
make=${MAKE:-make}
log=build/test
mkdir -p "$log"
passed=0
failed=0
started=$(date +%s)
cores=$(getconf _NPROCESSORS_ONLN 2>/dev/null || echo 1)
lanes=$((cores < 4 ? cores : 4))

# alone: one run of suites at a time has the folder build; another waits for its end.
alone() {
    told=
    until mkdir "$log.lock" 2>/dev/null; do
        holder=$(cat "$log.lock/process" 2>/dev/null)
        if [ -n "$holder" ] && ! kill -0 "$holder" 2>/dev/null; then
            rm -rf "$log.lock"          # it was killed
            continue
        fi
        [ -n "$told" ] || [ -z "$holder" ] || { echo "waiting for process $holder, which runs suites here"; told=yes; }
        sleep 1
    done
    echo $$ >"$log.lock/process"
    trap 'rm -rf "$log.lock"' EXIT
    trap 'exit 1' HUP INT TERM
    rm -rf "$log/lanes" "$log/missing" "$log/without"
    started=$(date +%s)
}

# processors FILE: spent is how many seconds of processors what this shell waited for has taken. (A subshell would tell of itself.)
processors() {
    times >"$1"
    spent=$(awk -F '[ ms]+' 'NR == 2 { printf "%d", 60 * ($1 + $3) + $2 + $4 }' "$1")
    rm -f "$1"
}

# suite NAME COMMAND...: a suite counts its tests in a last line "N passed, N failed"; else it is one test.
suite() {
    name=$1
    shift
    before=$(date +%s)
    processors "$log/$name.times"
    spent_before=$spent
    "$@" >"$log/$name.log" 2>&1
    status=$?
    line=$(grep -E '^[0-9]+ passed, [0-9]+ failed$' "$log/$name.log" | tail -n 1)
    if [ -n "$line" ]; then
        good=$(echo "$line" | cut -d' ' -f1)
        bad=$(echo "$line" | cut -d' ' -f3)
        [ $status -eq 0 ] || [ "$bad" -gt 0 ] || bad=1
    else
        good=0
        bad=0
        if [ $status -eq 0 ]; then good=1; else bad=1; fi
    fi
    passed=$((passed + good))
    failed=$((failed + bad))
    # Printed in one piece, as another lane may print, too.
    processors "$log/$name.times"
    line=$(printf '%-28s %4d passed, %d failed  (%d s, %d of processors)' "$name" "$good" "$bad" $(($(date +%s) - before)) \
        $((spent - spent_before)))
    [ "$bad" -eq 0 ] || line="$line
--- $log/$name.log
$(tail -n 60 "$log/$name.log")
---"
    printf '%s\n' "$line"
}

# lanes GROUP...: up to four lanes take functions of suites, each the next that nobody took: where the longest come first, all end at
# about the same time. What they compile, they do with two processes for each core of theirs. A group writes no file that another uses; of one that is named FUNCTION=WORD the function has the
# word. Waits for all and adds up.
lanes() {
    mkdir -p "$log/lanes"
    for lane in $(seq "$lanes"); do
        (
            trap - EXIT
            CORES=$((2 * cores / lanes))
            export CORES
            passed=0 failed=0
            for group; do
                ! mkdir "$log/lanes/$group" 2>/dev/null || "${group%%=*}" "${group#*=}"
            done
            echo "$passed $failed" >"$log/lanes/$lane.count"
        ) &
    done
    wait
    for lane in $(seq "$lanes"); do
        lane_passed=0 lane_failed=1
        if ! read -r lane_passed lane_failed <"$log/lanes/$lane.count"; then
            echo "a lane of suites ended early"
        fi
        passed=$((passed + lane_passed))
        failed=$((failed + lane_failed))
    done
}

# needs TOOL PACKAGES [TOOL PACKAGES]...: true when all tools are there; names all that are not.
needs() {
    is_there=0
    while [ $# -gt 0 ]; do
        command -v "$1" >/dev/null 2>&1 || lacks "$1" "$2" || is_there=1
        shift 2
    done
    return $is_there
}

# lacks WHAT PACKAGES: something is missing that these packages bring; false.
lacks() {
    echo "not run without $1: apt-get install --no-install-recommends $2"
    echo "$1 $2" >>"$log/missing"
    return 1
}

# without WHAT COMMAND: suites are left out that need what nobody installs by the way.
without() {
    echo "not run without $1: $2"
    echo "$1" >>"$log/without"
}

# The last lines: what was left out, in a line with the command that installs it, and N passed, N failed.
add_up() {
    processors "$log/all.times"
    echo "in $(($(date +%s) - started)) s, $spent of processors"
    if [ -f "$log/missing" ]; then
        # shellcheck disable=SC2046
        echo "left out for want of" $(cut -d' ' -f1 "$log/missing" | sort -u)": apt-get install --no-install-recommends" \
            $(cut -d' ' -f2- "$log/missing" | tr ' ' '\n' | sort -u)
        [ "${CI:-}" != true ] || failed=$((failed + 1))
    fi
    # shellcheck disable=SC2046
    [ ! -f "$log/without" ] || echo "left out, as the lines above say:" $(sort -u "$log/without")
    echo "$passed passed, $failed failed"
    [ $failed -eq 0 ]
}

# Sets `assets` as `make run-suite` does, for programs that are called directly: make would look at every source again.
find_assets() {
    assets=${SMEAR_ASSETS-$([ ! -d ../shared/assets ] || echo ../shared/assets)}
    [ -n "$assets" ] || echo "SMEAR_ASSETS names no folder of sample models: tests of these are left out"
}
