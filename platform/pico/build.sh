#!/bin/sh
# SPDX-License-Identifier: MIT
# build.sh FOLDER PROGRAM BOARD [MODEL.h]
# Builds PROGRAM (demo, game or model) for a row of boards.h with the pico-sdk: FOLDER/PROGRAM.uf2 and .elf. The SDK is that of
# PICO_SDK_PATH, or an archive beside the repository, which is unpacked into build/pico/sdk. Version 2 of it writes a UF2 by
# picotool; where that is not installed, uf2.c does. Says what is missing, and what does not fit.
set -u
folder=$1 program=$2 board=$3 model=${4:-}
archive=${PICO_SDK_ARCHIVE:-../shared/third-party/pico-sdk-1.5.1.tar.xz}

for tool in cmake arm-none-eabi-gcc arm-none-eabi-g++ g++; do
    command -v $tool >/dev/null || {
        echo "$tool is missing: apt-get install --no-install-recommends gcc-arm-none-eabi libnewlib-arm-none-eabi" \
            "libstdc++-arm-none-eabi-newlib cmake g++" >&2
        exit 1
    }
done
[ -e "$(arm-none-eabi-gcc -print-file-name=nosys.specs)" ] || {
    echo "newlib is missing: apt-get install --no-install-recommends libnewlib-arm-none-eabi libstdc++-arm-none-eabi-newlib" >&2
    exit 1
}

# Two programs at once: one unpacks and builds after the other, with all cores each.
mkdir -p build/pico
exec 9>build/pico/lock
! command -v flock >/dev/null || flock 9

sdk=${PICO_SDK_PATH:-}
if [ -z "$sdk" ] && [ -f "$archive" ]; then
    sdk=$PWD/build/pico/sdk
    if [ ! -f "$sdk/unpacked" ]; then
        rm -rf "$sdk" && mkdir -p "$sdk" && tar -xJf "$archive" -C "$sdk" --strip-components=1 || exit 1
        mkdir -p "$sdk/docs" && : >>"$sdk/docs/CMakeLists.txt"          # which the archive leaves out
        : >"$sdk/unpacked"
    fi
fi
if [ ! -f "$sdk/pico_sdk_init.cmake" ]; then
    echo "no pico-sdk in PICO_SDK_PATH='${PICO_SDK_PATH:-}': git clone --depth 1 -b 1.5.1 https://github.com/raspberrypi/pico-sdk" \
        "and say PICO_SDK_PATH=\$PWD/pico-sdk" >&2
    exit 1
fi

# A folder is of one SDK.
[ "$(cat "$folder/sdk" 2>/dev/null)" = "$sdk" ] || rm -rf "$folder/CMakeCache.txt" "$folder/CMakeFiles" "$folder/elf2uf2"
mkdir -p "$folder"
echo "$sdk" >"$folder/sdk"
log=$folder/$program.log
without_picotool=
[ ! -d "$sdk/src/rp2350" ] || command -v picotool >/dev/null || without_picotool=-DPICO_NO_PICOTOOL=1
if ! cmake -S platform/pico -B "$folder" -DPICO_SDK_PATH="$sdk" -DSMEAR_BOARD="$board" -DSMEAR_MODEL="$model" \
    ${PICO_HOT:+-DSMEAR_HOT="$PICO_HOT"} $without_picotool >"$log" 2>&1; then
    sed -n '/CMake Error/,/^$/p' "$log" >&2
    exit 1
fi
if cmake --build "$folder" --target "$program" -j"$(getconf _NPROCESSORS_ONLN)" >>"$log" 2>&1; then
    [ -z "$without_picotool" ] || {
        arm-none-eabi-objcopy -O binary "$folder/$program.elf" "$folder/$program.bin" && g++ -x c++ -o "$folder/uf2" platform/pico/uf2.c &&
            "$folder/uf2" "$folder/$program.bin" "$folder/$program.uf2" || exit 1
    }
    echo "$folder/$program.uf2: hold BOOTSEL, plug the board in, copy it there"
    exit 0
fi
grep -E 'error|Error 1|overflowed' "$log" | head -n 12 >&2
if grep -q "region .FLASH. overflowed" "$log"; then
    echo "$program does not fit into the board's 2 MB of flash: smear convert with fewer clips (--clip), a smaller mesh or" \
        "smaller textures" >&2
elif grep -q "region .*RAM.* overflowed" "$log"; then
    echo "$program does not fit into 256 kB of RAM: fewer joints or vertices that move, or less in platform/pico/hot.ld" >&2
fi
echo "all that the tools said: $log" >&2
exit 1
