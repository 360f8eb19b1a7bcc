#!/bin/sh
# SPDX-License-Identifier: MIT
# links.sh FILE.md... - every link to a file of the repository, and to a heading, leads somewhere.
set -u
status=0

# The name that a heading is linked by.
anchors() {
    sed -n 's/^##* //p' "$1" | tr 'A-Z' 'a-z' | sed 's/[^a-z0-9 _-]//g; s/ /-/g'
}

for page; do
    folder=$(dirname "$page")
    for link in $(awk '/^```/ { code = !code } !code' "$page" | grep -o '](\([^) ]*\))\|src="[^"]*"' | sed 's/^](//; s/)$//; s/^src="//; s/"$//'); do
        case $link in
        *://*) continue ;;
        esac
        file=${link%%#*} heading=${link#*#}
        target=$page
        [ -z "$file" ] || target=$folder/$file
        if [ ! -e "$target" ]; then
            echo "$page: no file $link" >&2
            status=1
        elif [ "$heading" != "$link" ] && ! anchors "$target" | grep -qx -- "$heading"; then
            echo "$page: no heading $link" >&2
            status=1
        fi
    done
done
exit $status
