#!/bin/sh
# SPDX-License-Identifier: MIT
# flush.sh FOLDER LIBRARY NAME...: the examples of platform/examples compile without a warning against stand-ins of the
# headers they need, and put on the panel what bands that go straight to it put there. FLUSH_CXX names those in C++.
set -u
. "$(dirname "$0")/lib.sh"
base=$PWD/$1
library=$2
shift 2
rm -rf "$base"
mkdir -p "$base"

# shows NAME HEADER OPTIONS...: the program draws, and its panel lies in NAME/panel
shows() {
    name=$1 header=$2
    shift 2
    mkdir -p "$base/$name"
    cp "$header" "$base/$name/display.h"
    case " ${FLUSH_CXX:-} " in
    *" $name "*) compiler="${CXX:-c++} -x c++ -std=c++11" ;;
    *) compiler="${CC:-cc} -std=c99" ;;
    esac
    # shellcheck disable=SC2086
    $compiler -O1 -Wall -Wextra -Wpedantic -Werror "$@" -I"$base/$name" -Itests/examples/stand_ins -Iplatform/examples -Iinclude \
        -o "$base/$name/program" tests/examples/flush.c -x none "$library" && "$base/$name/program" >"$base/$name/panel"
}

# has_picture NAME LEAST: as many different pairs of bytes
has_picture() { is_true "$(od -An -v -tx2 -w2 "$base/$1/panel" | sort -u | wc -l) > $2"; }

claim "plain panel" shows plain tests/examples/stand_ins/plain.h
claim "plain panel shows something" has_picture plain 100
claim "plain small panel" shows small tests/examples/stand_ins/plain.h -DSMALL_PANEL
claim "plain small panel shows something" has_picture small 20
claim "plain tall panel" shows tall tests/examples/stand_ins/plain.h -DTALL_PANEL
claim "plain tall panel shows something" has_picture tall 100
claim "plain wide panel" shows wide tests/examples/stand_ins/plain.h -DWIDE_PANEL
claim "plain wide panel shows something" has_picture wide 20
for name in "$@"; do
    panel=plain option=
    case $name in
    u8g2) panel=small option=-DSMALL_PANEL ;;
    ili9341_t4) panel=tall option=-DTALL_PANEL ;;
    playdate) panel=wide option=-DWIDE_PANEL ;;
    esp_bsp) option=-pthread ;;
    esp_bsp_dsi) option="-pthread -DBOARD_DSI" ;;
    esac
    claim "$name" shows "$name" platform/examples/"${name%_dsi}".h $option
    claim "$name shows the picture" same "$base/$panel/panel" "$base/$name/panel"
    claim "$name in about 15 lines" is_true "$(awk '/^static int display_flush/ { on = 1 } on { n++ } /^}/ { on = 0 } END { print n + 0 }' \
        platform/examples/"${name%_dsi}".h) <= 15"
done
finish
