#!/bin/sh
# SPDX-License-Identifier: MIT
# layers.sh [--order] FOLDER...
# Checks that includes run one way. FOLDER... are the rooms that hold sources, the lowest first. A file includes files of
# its own room and of rooms below it, and nothing includes itself by way of others. The public headers include nothing
# but each other. An include names a file from the root, from src/, from include/, or beside the file that includes it.
# src/kernels/bind.h lies below all rooms; no file of src/ but kernels asks the preprocessor for a CPU or for small code.
# What includes headers of other libraries (platform/examples, examples of tools/dist, and stand-ins for these) and what is made in build/
# is in no room.
# With --order it prints the files instead, each after all that it includes: headers first, then sources.
set -u
mode=check
[ "${1:-}" != --order ] || { mode=order; shift; }
if grep -n '^#include "' include/*.h | grep -v -e '"smear[a-z_]*\.h"'; then
    echo "layers: a public header includes a private one"
    exit 1
fi
if [ $mode = check ]; then
    machine="_ARM|SMEAR_ASM|__thumb|__wasm__|OPTIMIZE_SIZE|SMALL_(CODE|FILE)|SMEAR_ON_|__SSE|__NEON|__x86|__arm|UINTPTR_MAX|SMEAR_HAS_"
    machine="$machine|SMEAR_(VECTORS|PLACES|RANGES|DIRECT|ONE_COPY|RASTER_CACHE|FRONT_ORDER|FIND_FLAT|LIGHT_IS_DEAR|SHADES_FACES|SHARP_APART|ASSEMBLY_JOBS|[A-Z]+_ROWS|ROWS_AT_ONCE)"
    machine="$machine|(TEXEL|PACKED|GRADIENT|PATH|DIFFERENCES|PRODUCTS)[A-Z]*_"
    if grep -rnE "^ *# *(if|elif|ifdef|ifndef).*($machine)" src | grep -vE '^src/kernels/|_H$'; then
        echo "layers: above src/kernels a plain if asks for what bind.h says of the machine"
        exit 1
    fi
    for folder in $(find src tools platform tests -name '*.[ch]' ! -path 'platform/examples/*' ! -path 'tools/dist/*/*' ! -path '*/stand_ins/*' \
        -exec dirname {} + | sort -u); do
        case " $* " in
        *" $folder "*) ;;
        *) echo "layers: the Makefile names no room $folder"; exit 1 ;;
        esac
    done
fi
files=$(for folder in "$@"; do find "$folder" -maxdepth 1 -name '*.[ch]' | LC_ALL=C sort; done)
# shellcheck disable=SC2086
awk -v rooms="$*" -v mode="$mode" -v names="$(echo $files include/*.h)" '
    function room_of(path) {
        sub(/\/[^\/]*$/, "", path)
        return path
    }
    function floor_of(path) {
        return path ~ /^src\/kernels\/bind\.h$/ ? 0 : floor[room_of(path)]
    }
    function complain(text) {
        print "layers: " text
        bad = 1
    }
    function place_of(header, path) {
        if ((room_of(path) "/" header) in known)
            return room_of(path) "/" header
        if (header in known)
            return header
        if (("src/" header) in known)
            return "src/" header
        return ("include/" header) in known ? "include/" header : ""
    }
    # Depth first: a file after all that it includes.
    function visit(path,    i) {
        if (state[path] == 2)
            return
        if (state[path] == 1) {
            complain(path " includes itself by way of others")
            return
        }
        state[path] = 1
        for (i = 1; i <= count[path]; i++)
            visit(include[path, i])
        state[path] = 2
        ordered[++placed] = path
    }
    BEGIN {
        n = split(rooms, name, " ")
        for (i = 1; i <= n; i++)
            floor[name[i]] = i
        total = split(names, list, " ")
        for (i = 1; i <= total; i++)
            known[list[i]] = 1
    }
    FNR == 1 { files[++file_count] = FILENAME }
    match($0, /^#include "[^"]*"/) && !/"build\// {
        header = substr($0, 11, RLENGTH - 11)
        place = place_of(header, FILENAME)
        if (place == "")
            complain(FILENAME " includes " header ", which is not there")
        else if (place !~ /^include\//) {
            include[FILENAME, ++count[FILENAME]] = place
            if (floor_of(place) > floor_of(FILENAME))
                complain(FILENAME " includes " place ", which is not below it")
        }
    }
    END {
        for (i = 1; i <= file_count; i++)
            visit(files[i])
        if (bad)
            exit 1
        if (mode == "check") {
            print "layers: " file_count " files in " n " rooms, in order"
            exit 0
        }
        for (i = 1; i <= placed; i++)
            if (ordered[i] ~ /\.h$/)
                print ordered[i]
        for (i = 1; i <= placed; i++)
            if (ordered[i] ~ /\.c$/)
                print ordered[i]
    }' $files
