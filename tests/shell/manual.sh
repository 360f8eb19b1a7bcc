#!/bin/sh
# SPDX-License-Identifier: MIT
# manual.sh SMEAR LIB FOLDER - the manual, include/README.md: what is in its blocks of C is compiled as C99 and as C++11
# and run, in order; its block of C++ is compiled; and every public function, field, constant and macro is named in it, functions and
# fields of smear.h, smear_methods.h, smear_stats.h, smear_math.h and smear_overlay.h, and functions of smear_model.h, in a block.
# That a field is set to 0 shows nothing of it. Its table of names is what manual_names.awk prints.
#
# A block ```c file stands outside of functions; a block ```c is the inside of one, after which `result` must be SMEAR_OK, and what
# tests/data/manual_checks.txt says must be true: a line has words of a block, =>, and an expression.
set -eu
smear=$1 lib=$2 base=$3
page=include/README.md
cc=${CC:-cc} cxx=$CXX            # none: what is in C++ is left out
mkdir -p "$base"
"$smear" convert tests/data/arm.gltf --name arm -o "$base/arm.h" >/dev/null
"$smear" convert tests/data/arm.gltf --name arm -o "$base/arm.smr" >/dev/null

{
    echo '#include <stdio.h>'
    echo '#include <stdint.h>'
    printf 'union blob { unsigned char bytes[%s]; uint32_t word; };\n' "$(wc -c <"$base/arm.smr")"
    echo 'static const union blob arm_blob = { {'
    od -An -v -tu1 "$base/arm.smr" | sed 's/  */,/g; s/^,//; s/$/,/'
    echo '} };'
    echo '#define arm_file (arm_blob.bytes)'
    awk -v page=$page -v checks=tests/data/manual_checks.txt '
        BEGIN { while ((getline line <checks) > 0) {
            at = index(line, " => ")
            words[++known] = substr(line, 1, at - 1)
            check[known] = substr(line, at + 4)
        } }
        /^```c file$/ { on = 1; printf "#line %d \"%s\"\n", NR + 1, page; next }
        /^```c$/ { on = 2; names[++count] = NR + 1; printf "static void lines_%d(void)\n{\n#line %d \"%s\"\n", NR + 1, NR + 1, page; next }
        /^```/ {
            for (i = 1; on == 2 && i <= known; i++)
                if (i in due) {
                    printf "if (result == SMEAR_OK && !(%s)) {\nfprintf(stderr, \"%%s\\n\", \"%s\");\nresult = -1;\n}\n", check[i], words[i]
                    delete due[i]
                    used[i]++
                }
            if (on == 2) print "}"
            on = 0
            next
        }
        on {
            print
            for (i = 1; on == 2 && i <= known; i++)
                if (index($0, words[i])) due[i] = 1
        }
        END {
            for (i = 1; i <= known; i++)
                if (used[i] != 1) printf "#error %s: in no block, or in two\n", words[i]
            printf "int main(void)\n{\n"
            for (i = 1; i <= count; i++)
                printf "    lines_%d();\n    if (result != SMEAR_OK)\n        return fprintf(stderr, \"%s:%d: %%s\\n\", smear_error_text(result)), 1;\n", \
                    names[i], page, names[i]
            printf "    return 0;\n}\n"
        }' $page
} >"$base/manual.c"
awk '/^```cpp$/ { on = 1; next } /^```/ { on = 0 } on' $page >"$base/manual.cpp"

strict="-O1 -Wall -Wextra -Werror -Wno-unused -Iinclude -I$base"
# shellcheck disable=SC2086
{
    $cc -std=c99 -Wno-missing-field-initializers $strict -o "$base/manual" "$base/manual.c" "$lib"
    [ -z "$cxx" ] || $cxx -x c++ -std=c++11 -Wno-missing-field-initializers $strict -c -o "$base/manual_cxx.o" "$base/manual.c"
    [ -z "$cxx" ] || $cxx -std=c++11 $strict -c -o "$base/manual_cpp.o" "$base/manual.cpp"
}
"$base/manual"

awk '/^```c/ { on = 1; next } /^```/ { on = 0 } on { gsub(/[a-z_]+ = 0[,;]/, ""); print }' $page >"$base/code"
# Words of a header, one a line, their kind first.
names() { sed 's://.*::' "$1" | awk -f tests/shell/header_names.awk; }

missing=0
check() { # KIND NAME PATTERN FILE
    grep -q -- "$3" "$4" || { echo "$page: no $1 $2" >&2; missing=$((missing + 1)); }
}
known=0
headers="include/smear.h include/smear_math.h include/smear_overlay.h include/smear_ribbon.h include/smear_matcap.h include/smear_scene.h include/smear_model.h include/smear_memory.h
    include/smear_methods.h include/smear_stats.h"
for header in $headers; do
    names "$header" >"$base/names"
    known=$((known + $(wc -l <"$base/names")))
    while read -r kind name; do
        case $kind:$name:$header in
        # Fields of smear_point_place are the library's own.
        field:length:*overlay.h | field:gain:*overlay.h | field:along_[xy]:*overlay.h | field:[xy][01]:*overlay.h) ;;
        field:depth:*overlay.h | field:next:*overlay.h) ;;
        *_ | function:*_:* | *smear_math_* | field:smear_* | macro:SMEAR_H:* | macro:SMEAR_*_H:*) ;;
        function:*) check "$kind" "$name" "\\b$name(" "$base/code" ;;
        field:*_model.h | field:*_memory.h) ;;
        field:*) check "$kind" "$name" "\\(\\.\\|->\\)$name\\b" "$base/code" ;;
        *_math.h | *_model.h | *_memory.h) ;;
        *) check "$kind" "$name" "\\b$name\\b" $page ;;
        esac
    done <"$base/names"
done
for header in $headers; do names "$header"; done >"$base/names"
awk -f tests/shell/manual_names.awk "$base/names" $page >build/names.md
awk '/^<!-- .names -->/ { on = 0 } on; /^<!-- names -->/ { on = 1 }' $page | cmp - build/names.md ||
    { echo "$page: the table of names is another: make manual-names" >&2; missing=$((missing + 1)); }
[ $known -gt 400 ] || { echo "manual.sh: only $known names found in the headers" >&2; exit 1; }
[ $missing = 0 ] || { echo "$page: $missing names are missing, or the table of them" >&2; exit 1; }
