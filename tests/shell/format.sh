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
bad=0
# A program for all files at once: to start one takes longer than to read a source. So they are copied, by number.
mkdir "$work/mine" "$work/its"
awk -v work="$work" '
    FNR == 1 {
        if (mine != "") { close(mine); close(its) }
        match(FILENAME, /\.[a-z]*$/)
        copy = ++files substr(FILENAME, RSTART)
        mine = work "/mine/" copy
        its = work "/its/" copy
        print copy, FILENAME >(work "/names")
    }
    { print >mine; print >its }
    /\t/ { print "format: " FILENAME ":" FNR ": a tab"; bad++ }
    / $/ { print "format: " FILENAME ":" FNR ": spaces at its end"; bad++ }
    length > 140 { print "format: " FILENAME ":" FNR ": " length " columns"; bad++ }
    END { print files + 0, bad + 0 >(work "/count") }' "$@" || exit 1
read -r files bad <"$work/count"
[ "$files" -eq $# ] || { echo "format: of $# files $((($# - files))) are empty"; exit 1; }
find "$work/its" -type f -exec "$format" -i -style="file:$PWD/.clang-format" {} + || exit 1

# Lines that both have, one after the other: which they have not is in the hunks.
diff -rw "$work/mine" "$work/its" >"$work/hunks"
[ $? -le 1 ] || exit 1
awk -v work="$work" '
    function indent(text) { match(text, /^ */); return RLENGTH }
    function set(of, range,    ends) {
        ends[2] = ""
        if (split(range, ends, ",") < 2)
            ends[2] = ends[1]
        for (; ends[1] + 0 <= ends[2] + 0; ends[1]++)
            of[copy, ends[1] + 0]
    }
    FILENAME ~ /hunks$/ && /^diff / { copy = $NF; sub(/.*\//, "", copy); next }
    FILENAME ~ /hunks$/ {
        if ($0 !~ /^[0-9]+(,[0-9]+)?[acd][0-9]+(,[0-9]+)?$/)
            next
        split($0, side, /[acd]/)
        if ($0 !~ /a/)
            set(old, side[1])
        if ($0 !~ /d/)
            set(new, side[2])
        next
    }
    {
        copy = $1
        mine = work "/mine/" copy
        its = work "/its/" copy
        name = substr($0, length(copy) + 2)
        at = 0
        for (number = 1; (getline line <mine) > 0; number++) {
            if ((copy, number) in old)
                continue
            do at++; while ((more = (getline answer <its) > 0) && (copy, at) in new)
            if (!more) { print "format: lost in " name >"/dev/stderr"; exit 1 }
            want = indent(answer)
            if (indent(line) != want && line !~ /^ *([*"{}0-9\\].*)?$/ && line !~ /\\$/)
                print number, want, name
        }
        close(mine)
        close(its)
    }' "$work/hunks" "$work/names" >"$work/wrong" || exit 1
if [ $fix -eq 1 ]; then
    cut -d' ' -f3- "$work/wrong" | uniq | while read -r file; do
        awk -v file="$file" 'NR == FNR { if (substr($0, length($1 $2) + 3) == file) want[$1] = $2; next }
            FNR in want { sub(/^ */, ""); $0 = sprintf("%" want[FNR] "s", "") $0 }
            { print }' "$work/wrong" "$file" >"$work/fixed" && cat "$work/fixed" >"$file"
    done
    : >"$work/wrong"
fi
while read -r number want file; do
    echo "format: $file:$number: clang-format indents it by $want"
done <"$work/wrong"
bad=$((bad + $(wc -l <"$work/wrong")))
echo "format: $files files, $bad lines to change"
[ $bad -eq 0 ]
