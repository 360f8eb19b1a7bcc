#!/bin/sh
# SPDX-License-Identifier: MIT
# pico_stranger.sh MODEL - the way of platform/README.md from a clean clone to the UF2 with a model of one's own, in at most
# four commands, which are taken from there. Packages are only looked for, and the SDK is the one that is here. What other
# suites compiled of the same text is not compiled again.
set -u
model=$PWD/$1
. "$(dirname "$0")/lib.sh"
base=$PWD/build/test/pico-stranger
archive=${PICO_SDK_ARCHIVE:-$PWD/../shared/third-party/pico-sdk-1.5.1.tar.xz}
rm -rf "$base"
mkdir -p "$base"
git clone -q . "$base/clone" || exit 1
cd "$base/clone" || exit 1
awk '/^## A Raspberry Pi Pico/ { on = 1 } on && /^    / { print substr($0, 5); some = 1; next } on && some { exit }' \
    platform/README.md >"$base/commands"

is_installed() {
    for package in $(sed -n 's/^sudo apt-get install //p' "$base/commands"); do
        dpkg -s "$package" >/dev/null 2>&1 || { echo "$package is not installed"; return 1; }
    done
}
bring_sdk() {
    if [ -n "${PICO_SDK_PATH:-}" ]; then
        cp -r "$PICO_SDK_PATH" pico-sdk
    else
        mkdir pico-sdk && tar -C pico-sdk --strip-components=1 -xJf "$archive" && mkdir -p pico-sdk/docs && : >>pico-sdk/docs/CMakeLists.txt
    fi
}
SMEAR_OBJECTS=${SMEAR_OBJECTS:-$base/objects}
export SMEAR_OBJECTS
cc="sh $here/tests/shell/launch_cached.sh ${CC:-cc} -Werror"
# The model's name and clip are the reader's.
run_line() {
    (unset MAKEFLAGS PICO_SDK_PATH PICO_SDK_ARCHIVE TARGET BOARD; sh -ec "$(sed -n "$1p" "$base/commands" | sed "s|Fox.glb --clip Run|'$model'|; s|^make |make -j2 |; s|^make -j2 build/smear|& CC='$cc'|")")
}

claim "four commands at most" is_true "$(wc -l <"$base/commands") == 4"
claim "1: packages" is_installed
claim "2: the SDK" eval 'has "$base/commands" "^git clone .*pico-sdk$" && bring_sdk'
claim "3: the program and the model's header" run_line 3
claim "4: the firmware" run_line 4
claim "a UF2" equals "$(head -c 4 build/pico/picosystem/model.uf2 | od -An -tx1 | tr -d ' \n')" 5546320a
finish
