#!/bin/sh
# SPDX-License-Identifier: MIT
# format.sh [--fix] FILE... - whether the lines of C sources are indented as clang-format has them (.clang-format), have no
# tabs and no spaces at their ends, and are not longer than 140 columns. Where lines break, and columns of comments and
# tables, are the author's: the formatter's answer counts for lines that it leaves as they are but for white space, and
# neither for comments, strings and tables nor for macros. --fix indents them.
set -u
fix=0
[ "${1:-}" != --fix ] || { fix=1; shift; }
LC_ALL=C
export LC_ALL
format=$(command -v clang-format-14 || command -v clang-format) || { echo "format: no clang-format"; exit 1; }
work=$(mktemp -d "${TMPDIR:-/tmp}/smear-format.XXXXXX") || exit 1
trap 'rm -rf "$work"' EXIT
files=0
bad=0
for file in "$@"; do
    files=$((files + 1))
    "$format" "$file" >"$work/formatted" || exit 1
    # Lines that both have: those of the file with their numbers, and the formatter's.
    diff -w --old-line-format= --new-line-format= --unchanged-line-format='%dn:%L' "$file" "$work/formatted" >"$work/mine"
    diff -w --old-line-format= --new-line-format= --unchanged-line-format='%L' "$work/formatted" "$file" >"$work/its"
    awk 'function indent(text) { match(text, /^ */); return RLENGTH }
        NR == FNR { want[FNR] = indent($0); next }
        {
            number = $0
            sub(/:.*/, "", number)
            sub(/^[0-9]*:/, "")
            if (indent($0) != want[FNR] && $0 !~ /^ *([*"{}0-9\\].*)?$/ && $0 !~ /\\$/)
                print number, want[FNR]
        }' "$work/its" "$work/mine" >"$work/wrong"
    if [ $fix -eq 1 ] && [ -s "$work/wrong" ]; then
        awk 'NR == FNR { want[$1] = $2; next }
            FNR in want { sub(/^ */, ""); $0 = sprintf("%" want[FNR] "s", "") $0 }
            { print }' "$work/wrong" "$file" >"$work/fixed" && cat "$work/fixed" >"$file"
        : >"$work/wrong"
    fi
    while read -r number want; do
        echo "format: $file:$number: clang-format indents it by $want"
    done <"$work/wrong"
    bad=$((bad + $(wc -l <"$work/wrong")))
    awk -v file="$file" '
        /\t/ { print "format: " file ":" FNR ": a tab"; bad++ }
        / $/ { print "format: " file ":" FNR ": spaces at its end"; bad++ }
        length > 140 { print "format: " file ":" FNR ": " length " columns"; bad++ }
        END { exit bad != 0 }' "$file" || bad=$((bad + 1))
done
echo "format: $files files, $bad lines to change"
[ $bad -eq 0 ]
