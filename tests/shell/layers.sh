#!/bin/sh
# SPDX-License-Identifier: MIT
# layers.sh [--order] ROOM...
# Checks that includes run one way. ROOM... are the folders of src/, the lowest first; files of src/ itself are the top
# floor. A file includes files of its own room and of rooms below it, within a room nothing includes itself by way of
# others, and the public headers include nothing of src/. With --order it prints the files instead, each after all that
# it includes: headers first, then sources.
set -u
mode=check
[ "${1:-}" != --order ] || { mode=order; shift; }
rooms=$*
if grep -n '^#include "' include/*.h | grep -v -e '"smear[a-z_]*\.h"'; then
    echo "layers: a public header includes a private one"
    exit 1
fi
# shellcheck disable=SC2046
awk -v rooms="$rooms" -v mode="$mode" '
    function room_of(path,    part) {
        part = path
        sub(/^src\//, "", part)
        return part ~ /\// ? substr(part, 1, index(part, "/") - 1) : "top"
    }
    function complain(text) {
        print "layers: " text
        bad = 1
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
        floor["top"] = n + 1
    }
    FNR == 1 {
        files[++file_count] = FILENAME
        known[FILENAME] = 1
        if (!(room_of(FILENAME) in floor))
            complain(FILENAME " lies in no room that the Makefile names")
    }
    match($0, /^#include "[^"]*"/) {
        header = substr($0, 11, RLENGTH - 11)
        if (header ~ /^(smear|smear_config|smear_model|smear_memory|smear_math)\.h$/)
            next
        if (header == "context.h")      # which stages still see: until they get rows
            next
        include[FILENAME, ++count[FILENAME]] = "src/" header
        if (floor[room_of("src/" header)] > floor[room_of(FILENAME)])
            complain(FILENAME " includes " header ", which is not below it")
    }
    END {
        for (i = 1; i <= file_count; i++)
            for (k = 1; k <= count[files[i]]; k++)
                if (!(include[files[i], k] in known))
                    complain(files[i] " includes " include[files[i], k] ", which is not there")
        for (floor_now = 1; floor_now <= n + 1; floor_now++)
            for (i = 1; i <= file_count; i++)
                if (floor[room_of(files[i])] == floor_now)
                    visit(files[i])
        if (bad)
            exit 1
        if (mode == "check") {
            print "layers: " file_count " files in " n + 1 " rooms, in order"
            exit 0
        }
        for (i = 1; i <= placed; i++)
            if (ordered[i] ~ /\.h$/)
                print ordered[i]
        for (i = 1; i <= placed; i++)
            if (ordered[i] ~ /\.c$/)
                print ordered[i]
    }' $(ls src/*.[ch] src/*/*.[ch])
