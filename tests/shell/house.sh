#!/bin/sh
# SPDX-License-Identifier: MIT
# house.sh [-l] - how src/ is built, measured: longest functions and files, branches, switches and the whole context in
# the top floor, lines of the core: all rooms but OTHERS="FOLDER...". And what lies at the top of the repository, as git has it. Fails
# where one of the limits below is passed, or something lies there that is not in TOP; -l lists all that comes near a limit.
#
# A function runs from its first line to its closing brace; a branch is an if, for, while, case, ?, && or ||.
set -u
FUNCTION_LINES=60 FUNCTION_BRANCHES=25 FILE_LINES=700 FRAME_LINES=250 TOP_SWITCHES=30 CONTEXT_SOURCES=3 OTHER_SOURCES=7 SWITCHES=29
CORE_LINES=28360 RASTER_HEADERS=30
TOP="src include platform tests tools Makefile README.md LICENSE .ci .clang-format .editorconfig .gitignore"
list=0
[ "${1:-}" != -l ] || list=1

# shellcheck disable=SC2046
awk -v lines_most="$FUNCTION_LINES" -v branches_most="$FUNCTION_BRANCHES" -v file_most="$FILE_LINES" \
    -v frame_most="$FRAME_LINES" -v list="$list" '
    function branches_of(text,    n) {
        gsub(/"([^"\\]|\\.)*"|\x27([^\x27\\]|\\.)*\x27/, "", text)
        n = gsub(/&&|\|\||\?/, " ", text)
        n += gsub(/(^|[^A-Za-z0-9_])(if|for|while|case)([^A-Za-z0-9_]|$)/, " ", text)
        return n
    }
    function close_file() {
        if (path == "")
            return
        limit = path == "src/frame.c" ? frame_most : file_most
        longest_file = last > longest_file && path != "src/base/tables.c" ? last : longest_file
        if (last > limit && path != "src/base/tables.c") {
            print "house: " path " has " last " lines, more than " limit
            bad = 1
        }
    }
    FNR == 1 { close_file(); path = FILENAME; inside = 0; comment = 0; directive = 0 }
    { last = FNR; line = $0 }
    {   # without comments
        text = ""
        while (line != "") {
            if (comment) {
                at = index(line, "*/")
                if (!at) { line = ""; break }
                line = substr(line, at + 2); comment = 0
            } else {
                at = index(line, "/*")
                if (!at) { text = text line; break }
                text = text substr(line, 1, at - 1)
                line = substr(line, at + 2); comment = 1
            }
        }
    }
    text ~ /^#/ || directive { directive = text ~ /\\$/; next }
    !inside && text ~ /^[A-Za-z_].*\(/ && text !~ /;[ \t]*$/ { start = FNR; name = text; sub(/\(.*/, "", name); sub(/.*[ *]/, "", name) }
    !inside && text ~ /^\{/ { inside = 1; branches = 0; next }
    inside && text ~ /^\}/ {
        inside = 0
        if (name == "" || start == 0) next
        n = FNR - start + 1
        functions++
        longest = n > longest ? n : longest
        most = branches > most ? branches : most
        if (n > lines_most || branches > branches_most) {
            printf "house: %s:%d: %s has %d lines and %d branches, more than %d and %d\n", path, start, name, n, branches, lines_most, branches_most
            bad = 1
        } else if (list && (n > lines_most - 8 || branches > branches_most - 3)) {
            printf "  %s:%d: %s has %d lines and %d branches\n", path, start, name, n, branches
        }
        name = ""; start = 0
        next
    }
    inside { branches += branches_of(text) }
    END {
        close_file()
        printf "house: %d functions, longest %d lines, most branches %d, longest file %d lines\n", functions, longest, most, longest_file
        exit bad
    }' $(ls src/*.[ch] src/*/*.[ch])
status=$?
count() {
    [ "$2" -le "$3" ] && echo "house: $1: $2 of at most $3" || { echo "house: $1: $2, more than $3"; status=1; }
}
count "SMEAR_WITH_ in the top floor" "$(cat src/*.[ch] | grep -o 'SMEAR_WITH_' | wc -l)" "$TOP_SWITCHES"
core=$(ls src/*.[ch] src/*/*.[ch])
others=
for room in ${OTHERS:-}; do
    core=$(echo "$core" | grep -v "^$room/")
    others="$others $(ls "$room"/*.[ch])"
done
count "lines of the core" "$(echo "$core" | xargs cat | wc -l)" "$CORE_LINES"
count "sources of the core that see the whole context" "$(echo "$core" | xargs grep -l '^#include "context.h"' | wc -l)" "$CONTEXT_SOURCES"
count "sources of other methods that see it" "$(echo "$others" | xargs grep -lE '^#include "(context|draws|frame)\.h"' | wc -l)" "$OTHER_SOURCES"
count "files of tools/, tests/ and platform/ that see it" "$(grep -lr '^#include ".*context.h"' tools tests platform | wc -l)" 0
count "headers of raster.c, with those of these" "$(${CC:-cc} -std=c11 -Iinclude -Isrc -MM src/raster/raster.c | tr ' ' '\n' | sed 's|[a-z]*/\.\./||' |
    grep -E '^(src|include)/.*\.h$' | sort -u | wc -l)" "$RASTER_HEADERS"
count "lines of frame.c" "$(wc -l <src/frame.c)" "$FRAME_LINES"
count "switches" "$(grep "^#ifndef SMEAR_WITH_" include/smear_config.h | grep -vc _ALL)" "$SWITCHES"
# Without git, as in a package, there is nothing to ask.
top=$(git ls-files 2>/dev/null | cut -d/ -f1 | LC_ALL=C sort -u | tr '\n' ' ')
strange=
for name in $top; do case " $TOP " in *" $name "*) ;; *) strange="$strange $name" ;; esac; done
for name in ${top:+$TOP}; do case " $top" in *" $name "*) ;; *) strange="$strange -$name" ;; esac; done
if [ -z "$top" ]; then
    echo "house: top of the repository: skipped, there is no git"
elif [ -z "$strange" ]; then
    echo "house: top of the repository: $(echo $top | wc -w) entries, those of the list"
else
    echo "house: top of the repository: other than TOP (-: not there):$strange"
    status=1
fi
exit $status
