#!/bin/sh
# SPDX-License-Identifier: MIT
# target_model.sh SMEAR MODEL - the way of the README from a file to a board: `smear convert`, the firmware, its frames
# against this machine's, and a screenshot of the board's panel.
set -u
smear=$1 model=$2
. "$(dirname "$0")/lib.sh"
base=build/test/model
header=$base/model.h
rm -rf "$base"
mkdir -p "$base"

board() { $make -s TARGET=lm3s6965evb MODEL="$1" "$2"; }
# The panel's 128x64 pixels, 4x4 each: is anything there, and does it change with time?
shot() { sh platform/lm3s6965evb/shot.sh build/lm3s6965evb/model.elf "$1" "$base/$1.ppm"; }
is_lit() { tail -c +16 "$1" | od -An -v -tu1 | tr -s ' ' '\n' | sort -u | awk 'NF' | wc -l | grep -qv '^ *[012]$'; }

claim "a missing header is told, and how to make it" fails_with "smear convert FILE --name model" board "$header" model-firmware
claim "a header" "$smear" convert "$model" --name other -o "$header"
claim "of another name is told" fails_with "with --name model" board "$header" model-firmware
claim "a header of the name that is wanted" "$smear" convert "$model" --name model -o "$header"
claim "the firmware" board "$header" model-firmware
claim "its frames are this machine's" board "$header" model-test
claim "what they cost" board "$header" model-cost
claim "a screenshot" shot 6
claim "shows something" is_lit "$base/6.ppm"
claim "another" shot 12
claim "is another picture" differ "$base/6.ppm" "$base/12.ppm"
cp build/lm3s6965evb/model.want "$base/want"
claim "a model without motion" "$smear" convert "$model" --clip none --name model -o "$base/rest.h"
touch -d '2020-01-01' "$base/rest.h"
claim "is compiled though its header is older" board "$base/rest.h" model-test
claim "and is another" differ build/lm3s6965evb/model.want "$base/want"
finish
