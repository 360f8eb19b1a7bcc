#!/bin/sh
# SPDX-License-Identifier: MIT
# launch_cached.sh COMPILER FLAGS... -o OBJECT -c SOURCE
# For CMAKE_C_COMPILER_LAUNCHER: compiles a source only if nobody did before with the same compiler, flags and text after the
# preprocessor, whatever project it belongs to. Objects are kept in the folder SMEAR_OBJECTS.
set -u
cache=$SMEAR_OBJECTS
object= source= flags= before=
for word; do
    case $before in
    -o) object=$word ;;
    -c) source=$word ;;
    -I | -isystem | -include | -MF | -MT | -MQ) ;;
    *)
        case $word in
        -o | -c | -I* | -isystem | -include | -D* | -M*) ;;      # these are in the text, or say where files are
        *) flags="$flags $word" ;;
        esac
        ;;
    esac
    before=$word
done
case $source in *.c) [ -n "$object" ] || exec "$@" ;; *) exec "$@" ;; esac
mkdir -p "$cache"
"$@" -E -P || exit 1         # the text lies where the object will
kept=$cache/$({ echo "$flags"; cat "$object"; } | cksum | tr ' ' -).o
if [ -e "$kept" ]; then
    cp "$kept" "$object"
else
    rm "$object"
    "$@" && cp "$object" "$cache/part.$$" && mv "$cache/part.$$" "$kept"
fi
