#!/bin/sh
# SPDX-License-Identifier: MIT
# all.sh - every suite; `make test` calls it. They are in groups, of which two run beside each other. The last line adds up: N
# passed, N failed.
set -u
. "$(dirname "$0")/shell/suites.sh"

# CMake's projects, of which many compile the library and pico-sdk, share objects; so do builds of the one file, and this
# machine's with that of a clone.
SMEAR_OBJECTS=$PWD/build/test/objects
launcher="sh $PWD/tests/shell/launch_cached.sh"
CMAKE_C_COMPILER_LAUNCHER="sh;$PWD/tests/shell/launch_cached.sh"
export SMEAR_OBJECTS CMAKE_C_COMPILER_LAUNCHER
rm -rf "$SMEAR_OBJECTS"

exr() {
    command -v pkg-config >/dev/null 2>&1 && pkg-config --exists OpenEXR
}

m32() {
    echo 'int main(void) { return 0; }' | gcc -m32 -x c -o build/test/m32 - 2>/dev/null && return 0
    lacks gcc-m32 "apt-get install --no-install-recommends libc6-dev-i386 lib32gcc-12-dev"
}

# What firmware for a Pico is built with and run on. SDK and boot ROM are other people's: without them the suites are not run.
pico() {
    needs arm-none-eabi-g++ "libnewlib-arm-none-eabi libstdc++-arm-none-eabi-newlib" && needs cmake "cmake g++" &&
        needs node "nodejs npm" || return 1
    [ -d "${RP2040JS:-build/tools/node_modules/rp2040js}" ] ||
        lacks rp2040js "npm install --prefix build/tools rp2040js@1.4.1, or RP2040JS=FOLDER" || return 1
    if [ -z "${PICO_SDK_PATH:-}" ] && [ ! -f "${PICO_SDK_ARCHIVE:-../shared/third-party/pico-sdk-1.5.1.tar.xz}" ]; then
        without pico-sdk "git clone --depth 1 -b 1.5.1 https://github.com/raspberrypi/pico-sdk; PICO_SDK_PATH=\$PWD/pico-sdk make test"
        return 1
    fi
    [ -f "${PICO_BOOTROM:-../shared/target-probes/rp2040/bootrom.mjs}" ] && return 0
    without "the RP2040's boot ROM" "PICO_BOOTROM=bootrom.bin make test"
    return 1
}

# ---------------------------------------------------------------------- groups of this machine

# The host's own suites.
host() {
    if needs clang-format-14 "clang-format-14"; then
        suite format $make -s format-check
    fi
    suite demo sh tests/shell/demo.sh build/test/demo
    documents
    for name in $($make -s print-suites); do
        suite "$name" env SMEAR_ASSETS="$assets" build/host/run --suite "$name"
    done
    if exr; then
        suite exr $make -s run-suite SUITE=exr EXR=1
        suite assets-as-exr $make -s run-suite SUITE=assets EXR=1
    else
        needs openexr-through-pkg-config "libopenexr-dev pkg-config" || true
    fi
}

# Programs as a user starts them.
programs() {
    needs python3 "python3" || true        # cli.sh reads statistics with it
    suite command-line sh tests/shell/cli.sh build/smear
    suite outputs sh tests/shell/outputs.sh build/smear
    suite arenas sh tests/shell/arenas.sh build/smear
    suite strangers sh tests/shell/strangers.sh build/smear
    suite build-jpeg-files $make -s build/host/jpeg-files
    suite jpeg-textures sh tests/shell/jpeg.sh build/smear build/host/jpeg-files textures
    if needs djpeg "libjpeg-turbo-progs"; then
        suite jpeg-libjpeg sh tests/shell/jpeg.sh build/smear build/host/jpeg-files libjpeg
    fi
    suite build-hostile $make -s build/host/hostile
    suite limits sh tests/shell/limits.sh build/smear build/host/hostile
    suite build-faults-injected $make -s build/host/faults-injected
    suite faults-injected build/host/faults-injected .
}

views() {
    suite view sh tests/shell/view.sh build/smear
    suite build-stalled $make -s build/host/stalled
    suite view-stalled build/host/stalled build/smear
    suite build-demo-screen $make -s build/host/demo-screen
    suite view-display sh tests/shell/view_display.sh build/host/demo-screen
    if needs tmux "tmux"; then
        suite view-terminal sh tests/shell/view_term.sh build/smear
    fi
    if needs Xvfb "xvfb xauth" && needs xauth "xauth"; then
        suite build-x11-user $make -s build/host/view_x11_user
        suite view-x11 sh tests/shell/view_x11.sh build/smear build/host/view_x11_user
    fi
}

web() {
    if needs wasm-ld-14 "clang-14 lld-14" && needs llvm-ar-14 "llvm-14" && needs xz "xz-utils" &&
        needs chromedriver "chromium chromium-driver" && needs node "nodejs"; then
        suite build-web $make -s web build/web/libc_test
        suite web-libc build/web/libc_test
        suite web node tests/shell/web.js build/web/index.html build/smear
        suite web-game node tests/shell/web_game.js build/web/game.html
        suite game-wasm $make -s TARGET=wasm game-test
        suite target-wasm $make -s TARGET=wasm target-test
    fi
}

firmware_here() {
    # Units are suites of the host's already, and of those under sanitizers.
    suite golden-host $make -s TARGET=host TARGET_TESTS=golden target-test
    suite demo-host $make -s TARGET=host demo-test
    suite game-host $make -s TARGET=host game-test
    suite device-chart sh tests/shell/device_chart.sh build/test/device-chart
    suite template $make -s template-test
}

switches() {
    suite switches $make -s switches-test
}

# Files and frames of generators, under sanitizers.
generated() {
    needs clang-14 "clang-14 libclang-rt-14-dev" || return 0
    suite fuzz-corpus $make -s $jobs fuzz-corpus
    suite fuzz-frames $make -s $jobs fuzz MINUTES=1
}

proofs() {
    if needs frama-c "frama-c-base"; then
        suite proofs $make -s proofs STEP=7
    fi
}

coverage() {
    suite coverage $make -s $jobs coverage
}

sanitized() {
    suite build-sanitized $make -s $jobs SAN=1 CHECK=1 build/host-san-check/smear build/host-san-check/run
    for name in $($make -s print-san-suites); do
        suite "sanitized-$name" env SMEAR_ASSETS="$assets" build/host-san-check/run --suite "$name"
    done
    suite golden-sanitized $make -s $jobs SAN=1 CHECK=1 TARGET_TESTS=golden target-test
    suite view-sanitized sh tests/shell/view.sh build/host-san-check/smear
}

linux() {
    if needs qemu-system-x86_64 "qemu-system-x86"; then
        suite build-linux $make -s build/host/smear-static build/host/view_linux_init build/host/mkcpio
        suite view-linux sh tests/shell/view_linux.sh build/smear build/kernel build/host/smear-static \
            build/host/view_linux_init build/host/mkcpio
        suite demo-linux $make -s TARGET=linux demo-test
    fi
}

# What others build the library from: packages, the one file.
packages() {
    needs cmake "cmake" || true            # dist.sh builds packages with it
    needs pkg-config "pkg-config" || true
    needs arduino-builder "arduino-builder arduino-ctags" || true
    needs zip "zip" || true
    suite dist $make -s dist-test
}

# Both draw with the same objects of the one file.
one_file() {
    # Compilers of the one file; dist_single.sh goes without those that are not here.
    needs tcc "tcc" || true
    suite dist-single $make -s dist-single-test
    if needs clang-14 "clang-14 libclang-rt-14-dev" && m32 &&
        needs arm-linux-gnueabihf-gcc "gcc-arm-linux-gnueabihf libc6-dev-armhf-cross" && needs qemu-arm-static "qemu-user-static"; then
        suite fuzz-builds $make -s $jobs fuzz-builds CASES=300
    fi
}

# ---------------------------------------------------------------------- groups of other machines

# stack-test reads the call graphs of the objects that the other suites build.
calls="env CALLS=1"

# on TARGET SUITE...: each SUITE-TARGET is what `make TARGET=... SUITE-test` does
on() {
    target=$1
    shift
    for what; do
        suite "$what-$target" $calls $make -s TARGET="$target" "$what-test"
    done
}

cortex_m0plus() { on cortex-m0plus target demo symbols stack game; }
cortex_m3() {
    on cortex-m3 target demo symbols stack
    # Of the switches some: that each can be off is what the suite `switches` shows. Sets are measured by what compiles faster:
    # no number is held against another.
    suite footprint $calls SWITCHES="SMEAR_WITH_SUBFRAMES SMEAR_WITH_TEXTURE" \
        $make -s footprint FOOTPRINT=cortex-m3:-O2 FOOTPRINT_SETS=cortex-m3:-O1
}
cortex_m4() { on cortex-m4 target demo symbols; }
cortex_m7() { on cortex-m7 target demo symbols; }
cortex_m33() { on cortex-m33 target demo symbols; }

raspi0() {
    on raspi0 symbols stack target
    if needs python3 "python3"; then
        on raspi0 demo
        # The library is the same.
        mkdir -p build/raspi0/pi-320
        [ ! -d build/raspi0/pi-640/src ] || cp -Rp build/raspi0/pi-640/src build/raspi0/pi-320/
        suite raspi0-320 $calls $make -s TARGET=raspi0 SCREEN=pi-320 demo-test
    fi
}

# Boards with firmware for a model of one's own.
boards() {
    on lm3s6965evb symbols stack demo
    on microbit symbols
    suite tiny $calls $make -s TARGET=microbit tiny-test
    if pico; then
        on pico demo game stack
        suite pico $calls sh tests/shell/target_pico.sh build/smear tests/data/arm.gltf
        suite pico-stranger $calls sh tests/shell/pico_stranger.sh tests/data/arm.gltf
    fi
    suite model $calls sh tests/shell/target_model.sh build/smear tests/data/arm.gltf
}

gba() {
    on gba symbols
    if [ -e /usr/include/mgba/flags.h ] || needs libmgba "libmgba-dev"; then
        on gba target demo game stack
        suite gba-cartridge $calls sh tests/shell/gba_cartridge.sh
    fi
}

objects() {
    suite objects-cortex-m0plus sh tests/shell/target_objects.sh build/objects
    # 47.5 kB of code for the renderer and its filter: all surfaces and formats, SMEAR_RECONSTRUCT and SMEAR_ACCUMULATE. (40 kB
    # is the aim; small textured triangles, rows drawn from several fills, fields told apart, poses that are copied take the rest.)
    suite objects-core env CODE_LIMIT=48640 NOT_CALLED="smear_filter_begin smear_filter_row" \
        SWITCHES="$(sh tests/shell/core_switches.sh)" sh tests/shell/target_objects.sh build/objects-core
}

rv32imc() {
    if needs riscv64-unknown-elf-gcc "gcc-riscv64-unknown-elf" && needs qemu-system-riscv32 "qemu-system-misc"; then
        on rv32imc target symbols demo stack
    fi
}

linux_arm() {
    if needs arm-linux-gnueabi-gcc "gcc-arm-linux-gnueabi libc6-dev-armel-cross" && needs qemu-arm-static "qemu-user-static"; then
        on linux-armel target demo
    fi
    if needs arm-linux-gnueabihf-gcc "gcc-arm-linux-gnueabihf libc6-dev-armhf-cross" && needs qemu-arm-static "qemu-user-static"; then
        on linux-armhf target demo game
    fi
    if needs aarch64-linux-gnu-gcc "gcc-aarch64-linux-gnu libc6-dev-arm64-cross" && needs qemu-aarch64-static "qemu-user-static"; then
        on linux-aarch64 target demo
    fi
}

s390x() {
    if needs s390x-linux-gnu-gcc "gcc-s390x-linux-gnu libc6-dev-s390x-cross" && needs qemu-s390x-static "qemu-user-static"; then
        on s390x target demo
    fi
}

# ---------------------------------------------------------------------- all of them

find_assets
suite includes $make -s layers
suite house $make -s house
suite core-alone $make -s core-alone
# What groups share is built before. Warnings of the optimizer are errors here.
suite build $make -s $jobs CC="$launcher ${CC:-cc} -Werror" all build/host/run build/host/frames build/host/demo build/host/game build/host/tiny \
    build/tapes/golden.c build/tapes/small.c build/demo/target_screen build/dist-single build/one-file/single/smear.c
long="boards gba cortex_m0plus cortex_m3"
short="cortex_m4 cortex_m7 cortex_m33 raspi0 objects"
needs arm-none-eabi-gcc "gcc-arm-none-eabi qemu-system-arm" && needs qemu-system-arm "qemu-system-arm" || long='' short=''
# The longest first, by what suites print.
# shellcheck disable=SC2086
lanes one_file host switches generated $long sanitized coverage packages linux_arm programs web views $short linux rv32imc s390x \
    firmware_here proofs
add_up
