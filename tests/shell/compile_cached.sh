#!/bin/sh
# SPDX-License-Identifier: MIT
# compile_cached.sh CACHE-FOLDER OBJECT-LIST COMPILER FLAGS... -- SOURCE...
# Compiles sources, each only if nobody did before with the same compiler, flags and text after the
# preprocessor: builds that differ in a switch share most objects. Writes the objects' names, one a
# line. Two at once.
set -u
cache=$1 list=$2
shift 2
command=
while [ "$1" != -- ]; do
    command="$command '$1'"
    shift
done
shift
mkdir -p "$cache"
CACHE=$cache COMMAND=$command
export CACHE COMMAND
printf '%s\n' "$@" | xargs -P 2 -n 6 sh -c '
    for source; do
        text=$(mktemp "$CACHE/text.XXXXXX") || exit 1
        eval "$COMMAND -E -P -o $text $source" || exit 1
        name=$(basename "$source" .c)
        key=$( { printf "%s\n" "$COMMAND" | sed "s/-DSMEAR_WITH_[A-Z0-9_]*=[01]//g; s/ //g; s/'\''//g"; cat "$text"; } | cksum | tr -d " ")
        rm -f "$text"
        object=$CACHE/$name-$key.o
        if [ ! -e "$object" ]; then
            eval "$COMMAND -c -o $object.part.o $source" || exit 1
            [ ! -e "$object.part.ci" ] || mv "$object.part.ci" "$CACHE/$name-$key.ci"
            mv "$object.part.o" "$object"
        fi
        printf "%s %s\n" "$source" "$object"
    done' sh >"$list.part" || exit 1
# in the order given: the linker may care
for source; do
    awk -v source="$source" '$1 == source { print $2 }' "$list.part"
done >"$list"
rm -f "$list.part"
