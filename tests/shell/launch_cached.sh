#!/bin/sh
# SPDX-License-Identifier: MIT
# launch_cached.sh COMPILER FLAGS... -o OBJECT -c SOURCE
# What other people's build tools call in the compiler's place (CMAKE_C_COMPILER_LAUNCHER): compiles a source only if nobody
# did before with the same compiler, flags and text after the preprocessor, whatever project it belongs to. Objects are kept in
# the folder SMEAR_OBJECTS.
set -u
cache=$SMEAR_OBJECTS
object= source= flags= before= compiles= rules=
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
[ -n "$source" ] && [ -n "$object" ] && [ -n "$compiles" ] || exec "$@"
mkdir -p "$cache"
# The preprocessor alone would take the object's name for that of the file of rules.
[ -z "$rules" ] || set -- "$@" -MF "${object%.o}.d" -MT "$object"
# The text lies where the object will. Headers of the compiler's own vectors would be most of it, and are always the same.
"$@" -E -P -D_IMMINTRIN_H_INCLUDED -D_EMMINTRIN_H_INCLUDED || exit 1
kept=$cache/$({ printf '%s\n' $flags | sort -u; cat "$object"; } | cksum | tr ' ' -).o    # levels of optimization come alone
if [ -e "$kept" ]; then
    cp "$kept" "$object"
else
    rm "$object"
    "$@" && cp "$object" "$cache/part.$$" && mv "$cache/part.$$" "$kept"
fi
