#!/bin/sh
# SPDX-License-Identifier: MIT
# run.sh [OPTION VALUE]... PROGRAM.elf [ARGUMENT...]
# Runs a program for a Pico in the emulator; options are those of run.mjs.
set -u
options="--board ${BOARD:-breakout}"
while [ $# -gt 1 ]; do
    case $1 in
    --*)
        options="$options $1 $2"
        shift 2
        ;;
    *) break ;;
    esac
done
program=$1
shift
command -v node >/dev/null || { echo "node is missing: apt-get install --no-install-recommends nodejs npm" >&2; exit 2; }
# shellcheck disable=SC2086
exec timeout "${LIMIT:-1800}" node platform/pico/run.mjs $options "${program%.elf}.uf2" "$@"
