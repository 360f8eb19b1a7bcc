#!/bin/sh
# SPDX-License-Identifier: MIT
# all.sh - every suite; `make test` calls it. Those of other machines run beside those of this one. The last line adds up: N
# passed, N failed.
set -u
. "$(dirname "$0")/shell/suites.sh"

# CMake's projects, of which many compile the library and pico-sdk, share objects.
SMEAR_OBJECTS=$PWD/build/test/objects
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

# Other machines and other builds: what they share with this one's suites is built before.
others() {
    targets
    forms
}

targets() {
    CALLS=1         # stack-test reads the call graphs of the objects that the other suites build
    export CALLS
    if needs arm-none-eabi-gcc "gcc-arm-none-eabi qemu-system-arm" && needs qemu-system-arm "qemu-system-arm"; then
        for target in cortex-m0plus cortex-m3 cortex-m4 cortex-m7 cortex-m33; do
            suite "target-$target" $make -s TARGET=$target target-test
            suite "demo-$target" $make -s TARGET=$target demo-test
        done
        for target in cortex-m0plus cortex-m3 cortex-m4 cortex-m7 cortex-m33 lm3s6965evb microbit gba raspi0; do
            suite "symbols-$target" $make -s TARGET=$target symbols-test
        done
        for target in cortex-m0plus cortex-m3 lm3s6965evb raspi0; do
            suite "stack-$target" $make -s TARGET=$target stack-test
        done
        suite game-cortex-m0plus $make -s TARGET=cortex-m0plus game-test
        suite tiny $make -s TARGET=microbit tiny-test
        # Of the switches some: that each can be off is what the suite `switches` shows.
        suite footprint env SWITCHES="SMEAR_WITH_SUBFRAMES SMEAR_WITH_TEXTURE" \
            $make -s footprint FOOTPRINT=cortex-m3:-O2
        suite demo-lm3s6965evb $make -s TARGET=lm3s6965evb demo-test
        suite target-raspi0 $make -s TARGET=raspi0 target-test
        if needs python3 "python3"; then
            suite demo-raspi0 $make -s TARGET=raspi0 demo-test
            suite raspi0-320 $make -s TARGET=raspi0 SCREEN=pi-320 demo-test
        fi
        if pico; then
            suite demo-pico $make -s TARGET=pico demo-test
            suite game-pico $make -s TARGET=pico game-test
            suite stack-pico $make -s TARGET=pico stack-test
            suite pico sh tests/shell/target_pico.sh build/smear tests/data/arm.gltf
            suite pico-stranger sh tests/shell/pico_stranger.sh tests/data/arm.gltf
        fi
        suite model sh tests/shell/target_model.sh build/smear tests/data/arm.gltf
        if [ -e /usr/include/mgba/flags.h ] || needs libmgba "libmgba-dev"; then
            suite target-gba $make -s TARGET=gba target-test
            suite demo-gba $make -s TARGET=gba demo-test
            suite game-gba $make -s TARGET=gba game-test
            suite stack-gba $make -s TARGET=gba stack-test
            suite gba-cartridge sh tests/shell/gba_cartridge.sh
        fi
        suite objects-cortex-m0plus sh tests/shell/target_objects.sh build/objects
        # 47.5 kB of code for the renderer and its filter: all surfaces and formats, SMEAR_RECONSTRUCT and SMEAR_ACCUMULATE. (40 kB
        # is the aim; small textured triangles, rows drawn from several fills, fields told apart, poses that are copied take the rest.)
        suite objects-core env CODE_LIMIT=48640 NOT_CALLED="smear_filter_begin smear_filter_row" \
            SWITCHES="$(sh tests/shell/core_switches.sh)" sh tests/shell/target_objects.sh build/objects-core
    fi
    if needs riscv64-unknown-elf-gcc "gcc-riscv64-unknown-elf" && needs qemu-system-riscv32 "qemu-system-misc"; then
        suite target-rv32imc $make -s TARGET=rv32imc target-test
        suite symbols-rv32imc $make -s TARGET=rv32imc symbols-test
        suite demo-rv32imc $make -s TARGET=rv32imc demo-test
        suite stack-rv32imc $make -s TARGET=rv32imc stack-test
    fi
    if needs arm-linux-gnueabi-gcc "gcc-arm-linux-gnueabi libc6-dev-armel-cross" && needs qemu-arm-static "qemu-user-static"; then
        suite target-linux-armel $make -s TARGET=linux-armel target-test
        suite demo-linux-armel $make -s TARGET=linux-armel demo-test
    fi
    if needs arm-linux-gnueabihf-gcc "gcc-arm-linux-gnueabihf libc6-dev-armhf-cross" && needs qemu-arm-static "qemu-user-static"; then
        suite target-linux-armhf $make -s TARGET=linux-armhf target-test
        suite demo-linux-armhf $make -s TARGET=linux-armhf demo-test
        suite game-linux-armhf $make -s TARGET=linux-armhf game-test
    fi
    if needs aarch64-linux-gnu-gcc "gcc-aarch64-linux-gnu libc6-dev-arm64-cross" && needs qemu-aarch64-static "qemu-user-static"; then
        suite target-linux-aarch64 $make -s TARGET=linux-aarch64 target-test
        suite demo-linux-aarch64 $make -s TARGET=linux-aarch64 demo-test
    fi
    if needs s390x-linux-gnu-gcc "gcc-s390x-linux-gnu libc6-dev-s390x-cross" \
        && needs qemu-s390x-static "qemu-user-static"; then
        suite target-s390x $make -s TARGET=s390x target-test
        suite demo-s390x $make -s TARGET=s390x demo-test
    fi
    unset CALLS
}

# Files and frames of generators.
generated() {
    needs clang-14 "clang-14 libclang-rt-14-dev" || return 0
    suite fuzz-corpus $make -s $jobs fuzz-corpus
    suite fuzz-frames $make -s $jobs fuzz MINUTES=1
    if m32 && needs arm-linux-gnueabihf-gcc "gcc-arm-linux-gnueabihf libc6-dev-armhf-cross" && needs qemu-arm-static "qemu-user-static"; then
        suite fuzz-builds $make -s $jobs fuzz-builds CASES=300
    fi
}

# What others build the library from: packages, the one file.
forms() {
    needs cmake "cmake" || true            # dist.sh builds packages with it
    needs pkg-config "pkg-config" || true
    needs arduino-builder "arduino-builder arduino-ctags" || true
    needs zip "zip" || true
    suite dist $make -s dist-test
    # Compilers of the one file; dist_single.sh goes without those that are not here.
    needs tcc "tcc" || true
    needs arm-linux-gnueabihf-gcc "gcc-arm-linux-gnueabihf libc6-dev-armhf-cross" || true
    suite dist-single $make -s dist-single-test
    suite template $make -s template-test
}

[ -n "${SMEAR_ASSETS:-}" ] || [ -d ../shared/assets ] ||
    echo "SMEAR_ASSETS names no folder of sample models: tests of these are left out"
suite includes $make -s layers
suite house $make -s house
suite build $make -s $jobs all build/host/run build/host/frames build/host/demo build/host/game build/host/tiny build/tapes/golden.c \
    build/tapes/small.c build/demo/target_screen build/dist-single
beside others
if needs clang-format-14 "clang-format-14"; then
    suite format $make -s format-check
fi
suite demo sh tests/shell/demo.sh build/test/demo
suite headers $make -s test-headers
suite table-file $make -s test-tables
suite readme $make -s test-readme
suite manual $make -s test-manual
suite examples $make -s test-examples
suite flush $make -s test-flush
for name in $($make -s print-suites); do
    suite "$name" $make -s run-suite SUITE="$name"
done
if exr; then
    suite exr $make -s run-suite SUITE=exr EXR=1
    suite assets-as-exr $make -s run-suite SUITE=assets EXR=1
else
    needs openexr-through-pkg-config "libopenexr-dev pkg-config" || true
fi
needs python3 "python3" || true        # cli.sh reads statistics with it
suite command-line sh tests/shell/cli.sh build/smear
suite outputs sh tests/shell/outputs.sh build/smear
suite arenas sh tests/shell/arenas.sh build/smear
suite strangers sh tests/shell/strangers.sh build/smear
suite build-hostile $make -s build/host/hostile
suite limits sh tests/shell/limits.sh build/smear build/host/hostile
suite build-faults-injected $make -s build/host/faults-injected
suite faults-injected build/host/faults-injected .
suite view sh tests/shell/view.sh build/smear
suite build-demo-screen $make -s build/host/demo-screen
suite view-display sh tests/shell/view_display.sh build/host/demo-screen
if needs tmux "tmux"; then
    suite view-terminal sh tests/shell/view_term.sh build/smear
fi
if needs Xvfb "xvfb xauth" && needs xauth "xauth"; then
    suite build-x11-user $make -s build/host/view_x11_user
    suite view-x11 sh tests/shell/view_x11.sh build/smear build/host/view_x11_user
fi
if needs wasm-ld-14 "clang-14 lld-14" && needs llvm-ar-14 "llvm-14" && needs xz "xz-utils" && needs chromedriver "chromium chromium-driver" && needs node "nodejs"; then
    suite build-web $make -s web build/web/libc_test
    suite web-libc build/web/libc_test
    suite web node tests/shell/web.js build/web/index.html build/smear
    suite web-game node tests/shell/web_game.js build/web/game.html
    suite game-wasm $make -s TARGET=wasm game-test
    suite target-wasm $make -s TARGET=wasm target-test
fi
suite golden-host $make -s TARGET=host target-test
suite switches $make -s switches-test
generated
if needs frama-c "frama-c-base"; then
    suite proofs $make -s proofs STEP=7
fi
suite coverage $make -s $jobs coverage
suite demo-host $make -s TARGET=host demo-test
suite game-host $make -s TARGET=host game-test
suite device-chart sh tests/shell/device_chart.sh build/test/device-chart
suite build-sanitized $make -s $jobs SAN=1 CHECK=1 build/host-san-check/smear build/host-san-check/run
for name in $($make -s print-san-suites); do
    suite "sanitized-$name" $make -s run-suite SUITE="$name" SAN=1 CHECK=1
done
suite golden-sanitized $make -s $jobs SAN=1 CHECK=1 target-test
suite view-sanitized sh tests/shell/view.sh build/host-san-check/smear
if needs qemu-system-x86_64 "qemu-system-x86"; then
    suite build-linux $make -s build/host/smear-static build/host/view_linux_init build/host/mkcpio
    suite view-linux sh tests/shell/view_linux.sh build/smear build/kernel build/host/smear-static \
        build/host/view_linux_init build/host/mkcpio
    suite demo-linux $make -s TARGET=linux demo-test
fi

join
add_up
