#!/bin/sh
# SPDX-License-Identifier: MIT
# launch_cached.sh COMPILER FLAGS... -o OBJECT -c SOURCE
# What other people's build tools call in the compiler's place (CMAKE_C_COMPILER_LAUNCHER): compiles a source only if nobody
# did before with the same compiler, flags and text after the preprocessor, whatever project it belongs to. Objects are kept in
# the folder SMEAR_OBJECTS.
set -u
cache=$SMEAR_OBJECTS
object= source= flags= before= compiles= rules=
# CMake calls cc by its whole name.
compiler=$(command -v "$1") || exit 1
shift
for word; do
    case $before in
    -o) object=$word ;;
    -I | -isystem | -include | -MF | -MT | -MQ) ;;                # names of files, which change nothing
    *)
        case $word in
        -c) compiles=yes ;;
        -MMD) rules=yes ;;
        esac
        case $word in
        *.c) source=$word ;;
        -o | -I* | -isystem | -include | -D* | -M*) ;;           # what they do is in the text
        *) flags="$flags $word" ;;
        esac
        ;;
    esac
    before=$word
done
[ -n "$source" ] && [ -n "$object" ] && [ -n "$compiles" ] || exec "$compiler" "$@"
mkdir -p "$cache"
# The preprocessor alone would take the object's name for that of the file of rules.
[ -z "$rules" ] || set -- "$@" -MF "${object%.o}.d" -MT "$object"
# The text lies where the object will. Headers of the compiler's own vectors would be most of it, and are always the same.
"$compiler" "$@" -E -P -D_IMMINTRIN_H_INCLUDED -D_EMMINTRIN_H_INCLUDED || exit 1
# Sketches of `smear convert` are the one file without its indentation, and ask in it for what their boards need (sketch.sh compiles that).
kept=$cache/$({ printf '%s\n' "$compiler" $flags | sort -u; sed '/^#pragma GCC optimize/d; s/^ *//' "$object"; } | cksum | tr ' ' -).o    # levels of optimization come alone
if [ -e "$kept" ]; then
    cp "$kept" "$object"
else
    rm "$object"
    "$compiler" "$@" && cp "$object" "$cache/part.$$" && mv "$cache/part.$$" "$kept"
fi
