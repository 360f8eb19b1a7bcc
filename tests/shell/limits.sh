#!/bin/sh
# SPDX-License-Identifier: MIT
# limits.sh - files that ask for all the memory and time they can get (hostile.c), given to every command of the
# program smear: each ends within 1 GB of addresses and 20 seconds of a core, done, or refused in one line. The slowest
# takes 3 on a quiet machine: what the limit is for is work that grows with the square of a file.
#
#     sh tests/shell/limits.sh build/smear build/host/hostile [BYTES...]

. "$(dirname "$0")/lib.sh"
of_program "$1"
hostile=$(absolute "$2")
shift 2
in_passing limits
cd "$base" || exit 1

within_limits() { # ARGUMENTS...
    (ulimit -v 1048576 && ulimit -t 20 && exec "$smear" "$@") >out 2>err </dev/null
    rc=$?
    [ $rc -eq 0 ] || { [ $rc -eq 1 ] && [ "$(wc -l <err)" -eq 1 ] && has err '^smear: '; } ||
        { echo "exit $rc: $(head -n 3 err)"; return 1; }
}

# of_file KIND ENDING BYTES: what the program does with the file
of_file() {
    file=$1.$2
    "$hostile" "$1" "$3" >"$file" || exit 1
    case $2 in
    png | ppm) claim "$1 of $3 bytes: compare" within_limits compare "$file" "$file" --diff x.png ;;
    play) claim "$1 of $3 bytes: view" within_limits view builtin:demo/drone --size 32x24 --out null --frames 1 --play "$file" ;;
    check) claim "$1 of $3 bytes: view" within_limits view builtin:demo/drone --size 32x24 --out null --frames 1 --check "$file" ;;
    *)
        claim "$1 of $3 bytes: info" within_limits info "$file"
        claim "$1 of $3 bytes: render" within_limits render "$file" -o x.png --depth x.pfm
        [ "$3" -lt 10000000 ] ||        # draws what render draws
            claim "$1 of $3 bytes: view" within_limits view "$file" --out null --frames 1
        claim "$1 of $3 bytes: convert" within_limits convert "$file" -o x.smr
        ;;
    esac
    rm -f "$file"
}

# half NUMBER BYTES...: every second file, in a folder of its own; what was claimed is in its file "count"
half() {
    base=$base/$1
    turn=$1
    mkdir "$base" && cd "$base" || exit 1
    shift
    for size; do
        for name in $("$hostile"); do
            turn=$((1 - turn))
            [ "$turn" -eq 0 ] || of_file "${name%.*}" "${name##*.}" "$size"
        done
    done
    echo "$passed $failed" >count
}

# Side by side, since one core is not all there is; limits are of a command's own time.
[ $# -gt 0 ] || set -- 10000000 1000000
(half 0 "$@") &
first=$!
(half 1 "$@") &
wait "$first" && wait $! || failed=1
for count in 0/count 1/count; do
    read -r more lost <"$count" || { echo "FAIL: a half has not come to its end"; more=0 lost=1; }
    passed=$((passed + more))
    failed=$((failed + lost))
done

finish
