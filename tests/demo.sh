#!/bin/sh
# SPDX-License-Identifier: MIT
# demo.sh FOLDER - `make demo` as in a fresh clone, without models: it ends well, and every picture it names is there and is
# one.
set -u
folder=$1
make=${MAKE:-make}
passed=0
failed=0
rm -rf "$folder"
mkdir -p "$folder"

claim() {
    if [ "$2" -eq 0 ]; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAILED: $1"
    fi
}

$make -s build/smear-demo && build/smear-demo - "$folder/pictures" >"$folder/out" 2>"$folder/err"
claim "make demo" $?
pictures=$(sed -n 's/^\([^ ]*\.[a-z]*\) .*/\1/p' "$folder/out")
[ "$(echo "$pictures" | grep -c .)" -ge 8 ]
claim "it names its pictures: $(head -3 "$folder/out")" $?
for picture in $pictures; do
    start=$(od -An -tx1 -N4 "$picture" | tr -d ' ')
    [ "$start" = 89504e47 ] || [ "$start" = 47494638 ]      # PNG, GIF
    claim "$picture is a picture" $?
done
[ -z "$(ls "$folder/pictures" | grep -F .tmp)" ]
claim "nothing unfinished" $?
! build/smear-demo - /dev/null/x >/dev/null 2>"$folder/err" && grep -q '^smear' "$folder/err"
claim "a folder that cannot be made is told" $?
echo "$passed passed, $failed failed"
[ $failed -eq 0 ]
