# SPDX-License-Identifier: MIT
# suites.sh - runs suites and adds up; sourced by all.sh and check.sh. Each suite's output goes to
# build/test/NAME.log and is shown when it fails.
#
# A suite whose tools are missing is named together with the command that installs them. With CI=true that is a
# failure: there, everything runs.
set -u
make=${MAKE:-make}
log=build/test
mkdir -p "$log"
passed=0
failed=0
missing=0
started=$(date +%s)
jobs=-j$(getconf _NPROCESSORS_ONLN)

# processors: spent is how many seconds of processors what this shell waited for has taken. (A subshell would tell of itself.)
processors() {
    times >"$log/$name.times"
    spent=$(awk -F '[ ms]+' 'NR == 2 { printf "%d", 60 * ($1 + $3) + $2 + $4 }' "$log/$name.times")
    rm -f "$log/$name.times"
}

# suite NAME COMMAND...: a suite counts its tests in a last line "N passed, N failed"; else it is one test.
suite() {
    name=$1
    shift
    before=$(date +%s)
    processors
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
    processors
    line=$(printf '%-28s %4d passed, %d failed  (%d s, %d of processors)' "$name" "$good" "$bad" $(($(date +%s) - before)) \
        $((spent - spent_before)))
    [ "$bad" -eq 0 ] || line="$line
--- $log/$name.log
$(tail -n 60 "$log/$name.log")
---"
    printf '%s\n' "$line"
}

# lanes GROUP...: two lanes take functions of suites, each the next that nobody took: where the longest come first, both end at
# about the same time. A group writes no file that another uses; of one that is named FUNCTION=WORD the function has the word. Waits
# for both and adds up.
lanes() {
    rm -rf "$log/lanes"
    mkdir -p "$log/lanes"
    for lane in 1 2; do
        (
            passed=0 failed=0 missing=0
            for group; do
                ! mkdir "$log/lanes/$group" 2>/dev/null || "${group%%=*}" "${group#*=}"
            done
            echo "$passed $failed $missing" >"$log/lanes/$lane.count"
        ) &
    done
    wait
    for lane in 1 2; do
        if [ -f "$log/lanes/$lane.count" ]; then
            read -r lane_passed lane_failed lane_missing <"$log/lanes/$lane.count"
            passed=$((passed + lane_passed))
            failed=$((failed + lane_failed))
            missing=$((missing + lane_missing))
        else
            echo "a lane of suites ended early"
            failed=$((failed + 1))
        fi
    done
}

# needs TOOL PACKAGES: true when the tool is there.
needs() {
    command -v "$1" >/dev/null 2>&1 && return 0
    lacks "$1" "apt-get install --no-install-recommends $2"
}

# lacks WHAT COMMAND: something is missing that the command installs; false.
lacks() {
    if [ "${CI:-}" != true ]; then
        without "$1" "$2"
        return 1
    fi
    echo "$1 is missing: $2"
    failed=$((failed + 1))
    return 1
}

# without WHAT COMMAND: suites are left out that need what nobody installs by the way.
without() {
    echo "not run without $1: $2"
    missing=$((missing + 1))
}

# The last lines: N passed, N failed.
add_up() {
    echo "in $(($(date +%s) - started)) s"
    [ $missing -eq 0 ] || echo "$missing suites were not run; the lines above say what they need"
    echo "$passed passed, $failed failed"
    [ $failed -eq 0 ]
}

# What documents and headers promise of this machine's build.
documents() {
    suite headers $make -s test-headers
    suite table-file $make -s test-tables
    suite readme $make -s test-readme
    suite manual $make -s test-manual
    suite examples $make -s test-examples
    suite flush $make -s test-flush
}

# Sets `assets` as `make run-suite` does, for programs that are called directly: make would look at every source again.
find_assets() {
    assets=${SMEAR_ASSETS-$([ ! -d ../shared/assets ] || echo ../shared/assets)}
    [ -n "$assets" ] || echo "SMEAR_ASSETS names no folder of sample models: tests of these are left out"
}
