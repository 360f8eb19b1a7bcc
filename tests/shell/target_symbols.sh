#!/bin/sh
# SPDX-License-Identifier: MIT
# target_symbols.sh NM ARCHIVE|- PROGRAM...
# What the library and firmware made of it call, told from symbols: the archive leaves nothing undefined but memcpy,
# memset, and what a compiler calls for 32-bit division, 64-bit products, shifts and comparisons; no program holds floating
# point, 64-bit division, malloc or anything else of a C library. A core with an FPU would hide floating point from
# this: targets are built without. HOOKS: what smear_config.h was told to call.
set -u
nm=$1 archive=$2
shift 2
status=0

helpers='__aeabi_(u?idiv(mod)?|lmul|llsl|llsr|lasr|u?lcmp|mem(cpy|set|clr)[48]?)|__gnu_thumb1_case_[a-z]+'
helpers="$helpers|__u?(div|mod)si3|__umulsidi3|__(ashl|ashr|lshr|mul)di3|__c[lt]z[sd]i2|__sync_synchronize${HOOKS:+|$HOOKS}"
[ "$archive" = - ] || "$nm" "$archive" 2>/dev/null | awk -v allowed="^($helpers|memcpy|memset)\$" '
    NF == 3 && $2 ~ /[TtDdRrBbVvWw]/ { defined[$3] = 1 }
    $1 == "U" { wanted[$2] = 1 }
    NF == 3 && $2 ~ /[DdBb]/ { print "writable data: " $3; bad = 1 }
    END {
        for (symbol in wanted) {
            if (symbol in defined) continue
            if (symbol !~ allowed) { print "the library calls " symbol; bad = 1 }
            else count++
        }
        if (length(defined) < 50) { print "no symbols of the library"; bad = 1 }
        exit bad
    }' || { echo "target_symbols.sh: $archive"; status=1; }

floats='__aeabi_([fd][a-z0-9_]*|c[fd]cmp[a-z]*|u?[il]2[fd])|__[a-z]*[sd]f[a-z0-9]*'
division='__u?(div|mod|divmod)di[34]|__aeabi_u?ldivmod'
libc='malloc|calloc|realloc|free|_?sbrk|printf|sprintf|snprintf|puts|memmove|memcmp|strlen|strcmp|strcpy|abort|exit|errno|__errno|_impure_ptr|qsort|rand|sqrt|sin|cos|pow'
for program; do
    "$nm" "$program" | awk -v bad_ones="^($floats|$division|$libc)\$" '
        $NF ~ bad_ones { print "holds " $NF; bad = 1 }
        $1 == "U" { print "undefined: " $NF; bad = 1 }
        END { if (NR < 50) { print "no symbols"; bad = 1 } exit bad }' ||
        { echo "target_symbols.sh: $program"; status=1; }
done
[ $status -eq 0 ] && echo "symbols of $archive and $# programs: nothing that must not be there"
exit $status
