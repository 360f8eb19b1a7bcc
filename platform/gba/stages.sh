#!/bin/sh
# SPDX-License-Identifier: MIT
# stages.sh LIBRARY.a
# Prints "NAME STAGE" for every function of the library, by its relocations: "assemble" where only functions that enter that stage
# lead to it, or those called there, "draw" where these do not, "both". The application calls some in either stage; what smear_begin
# and smear_submit call is of the first, which smear_begin enters. NAME is without what the compiler puts behind a dot; functions of
# one name are one.
set -u
cat include/*.h | grep -o 'smear_[a-z_0-9]*(' | tr -d '(' | sort -u | sed 's/^/R /' >"$1.roots"
arm-none-eabi-objdump -t "$1" | awk '/^[0-9a-f]+ / && $NF != "" && / \.(text|rodata|data)/ { print "S", $NF, $(NF - 2) }' >"$1.symbols"
arm-none-eabi-objdump -r "$1" | cat "$1.roots" "$1.symbols" - | awk '
    function node(section) {
        if (section ~ /^\.text\./) {
            sub(/^\.text\./, "", section)
            sub(/\..*/, "", section)
        }
        return section
    }
    BEGIN { assembles["assemble_rows"]; assembles["assemble_fill"]; assembles["smear_draws_find_ranges"]; assembles["smear_draws_find_damage"]; assembles["smear_frame_prepare"]
            assembles["smear_draws_find_changes"]; assembles["smear_draws_place_points"]; assembles["find_layers"]
            assembles["smear_begin"]; assembles["smear_submit"]
            draws["smear_render"]; draws["smear_work"]; draws["smear_filter_begin"]; draws["smear_filter_row"] }
    function walk(from, mark, seen,    stack, top, n, i, next_one) {
        stack[top = 1] = from
        while (top > 0) {
            from = stack[top--]
            if (from in seen || (mark == "draw" && from in assembles))
                continue
            seen[from] = 1
            n = edges[from]
            for (i = 1; i <= n; i++)
                stack[++top] = edge[from, i]
        }
    }
    $1 == "R" { root[$2] = 1; next }
    $1 == "S" && NF == 3 { if ($3 ~ /^\./) home[$2] = node($3); next }
    /^RELOCATION RECORDS FOR/ { from = node(substr($4, 2, length($4) - 3)); all[from] = 1; next }
    $2 ~ /^R_ARM/ { names++; source[names] = from; target[names] = $3 }
    END {
        for (i = 1; i <= names; i++) {
            name = target[i]
            sub(/[+-]0x.*/, "", name)
            to = name ~ /^\./ ? node(name) : name in home ? home[name] : name
            edge[source[i], ++edges[source[i]]] = to
        }
        for (name in home)
            all[home[name]] = 1
        for (name in assembles)
            walk(name, "assemble", in_assemble)
        for (name in root) {
            walk(name, "draw", in_draw)
            if (!(name in draws) && !(name in assembles))
                walk(name, "assemble", in_assemble)
            in_draw[name] = in_assemble[name] = 1
        }
        for (name in in_draw)           # goes on in either stage
            for (i = 1; i <= edges[name]; i++)
                if (edge[name, i] in assembles)
                    in_assemble[name] = 1
        for (name in all)
            if (name !~ /^\./ || name ~ /^\.rodata/)
                print name, name in in_assemble ? name in in_draw ? "both" : "assemble" : "draw"
    }' | sort
rm -f "$1.roots" "$1.symbols"
