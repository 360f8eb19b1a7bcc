#!/bin/sh
# SPDX-License-Identifier: MIT
# limits.sh - files that ask for all the memory and time they can get (hostile.c), given to every command of the
# program smear: each ends within 1 GB of addresses and 10 seconds of a core, done, or refused in one line.
#
#     sh tests/shell/limits.sh build/smear build/host/hostile [BYTES...]

. "$(dirname "$0")/lib.sh"
of_program "$1"
hostile=$(absolute "$2")
shift 2
in_passing limits
cd "$base" || exit 1

within_limits() { # ARGUMENTS...
    (ulimit -v 1048576 && ulimit -t 10 && exec "$smear" "$@") >out 2>err </dev/null
    rc=$?
    [ $rc -eq 0 ] || { [ $rc -eq 1 ] && [ "$(grep -vc '^smear: [^:]*: warning: ' err)" -eq 1 ] && has err '^smear: '; } ||
        { echo "exit $rc: $(head -n 3 err)"; return 1; }
}

for size in ${*:-10000000 1000000}; do
    for file in $("$hostile"); do
        kind=${file%.*}
        "$hostile" "$kind" "$size" >"$file" || exit 1
        case $file in
        *.png | *.ppm) claim "$kind of $size bytes: compare" within_limits compare "$file" "$file" --diff x.png ;;
        *.play) claim "$kind of $size bytes: view" within_limits view builtin:demo/drone --size 32x24 --out null --frames 1 --play "$file" ;;
        *.check) claim "$kind of $size bytes: view" within_limits view builtin:demo/drone --size 32x24 --out null --frames 1 --check "$file" ;;
        *)
            claim "$kind of $size bytes: info" within_limits info "$file"
            claim "$kind of $size bytes: render" within_limits render "$file" -o x.png --depth x.pfm
            [ "$size" -lt 10000000 ] ||     # draws what render draws
                claim "$kind of $size bytes: view" within_limits view "$file" --out null --frames 1
            claim "$kind of $size bytes: convert" within_limits convert "$file" -o x.smr
            ;;
        esac
        rm -f "$file"
    done
done

finish
