#!/bin/sh
# SPDX-License-Identifier: MIT
# compile_cached.sh CACHE-FOLDER OBJECT-LIST COMPILER FLAGS... -- SOURCE...
# Compiles sources, each only if nobody did before with the same compiler, flags and text after the
# preprocessor: builds that differ in a switch share most objects. Writes the objects' names, one a
# line, in the order of the sources. Two at once; processes are few, as most of a build is found in the cache.
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
texts=$(mktemp -d "$cache/texts.XXXXXX") || exit 1
trap 'rm -rf "$texts"' EXIT
(cd "$texts" && printf '%s\n' "$@" | sed 's|[^/]*$||; s|^$|.|' | sort -u | xargs mkdir -p) || exit 1
COMMAND=$command TEXTS=$texts
export COMMAND TEXTS
# Headers of the compiler's own vectors change with no switch, and would be most of the text.
printf '%s\n' "$@" | xargs -P 2 -n 12 sh -c '
    for source; do
        eval "$COMMAND -D_IMMINTRIN_H_INCLUDED -D_EMMINTRIN_H_INCLUDED -E -P -o $TEXTS/$source $source" || exit 1
    done' sh || exit 1

# The switches are in the texts already.
flags=$(printf '%s\n' "$command" | sed "s/-DSMEAR_WITH_[A-Z0-9_]*=[01]//g; s/ //g; s/'//g" | cksum | tr ' ' -)
(cd "$texts" && cksum "$@") | while read -r sum size source; do
    name=${source##*/}
    echo "$source $cache/${name%.c}-$sum-$size-$flags"
done >"$list.part"
while read -r source object; do
    [ -e "$object.o" ] || echo "$source $object"
done <"$list.part" | xargs -P 2 -n 2 sh -c '
    [ $# -eq 2 ] || exit 0      # none is lacking
    eval "$COMMAND -c -o $2.part.o $1" || exit 1
    [ ! -e "$2.part.ci" ] || mv "$2.part.ci" "$2.ci"
    mv "$2.part.o" "$2.o"' sh || exit 1
while read -r source object; do
    echo "$object.o"
done <"$list.part" >"$list"
rm -f "$list.part"
