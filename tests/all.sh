#!/bin/sh
# SPDX-License-Identifier: MIT
# all.sh check|test|all [GROUP...] - the suites; make check, make test and make test-all call it. Of named groups only the suites run.
#
#   check   what a change needs, in under three minutes of two cores: the host's suites but the three longest, golden frames and
#           units under sanitizers with every promise checked (BRIEF in the Makefile says with what less than in `test`)
#   test    what a person runs after a change, in under ten: all of the host's suites, suites of wild input under sanitizers, golden
#           frames by portable C and on three other machines, the command line, packages
#   all     all there is
#
# Suites are in groups, of which up to four run beside each other, as many as there are cores. The last line adds up: N passed, N failed.
set -u
. "$(dirname "$0")/shell/suites.sh"
level=$1
shift
# stack-test reads the call graphs of the objects that the other suites build.
calls="env CALLS=1"

m32() {
    echo 'int main(void) { return 0; }' | gcc -m32 -x c -o build/test/m32 - 2>/dev/null || lacks gcc-m32 "libc6-dev-i386 lib32gcc-12-dev"
}

sanitizers() {
    echo 'int main(void) { return 0; }' | ${CC:-cc} -fsanitize=address,undefined -x c -o build/test/sanitizers - 2>/dev/null ||
        lacks libasan "libgcc-12-dev"
}

# What firmware for a Pico is built with and run on. SDK and boot ROM are other people's: without them the suites are not run.
pico_tools() {
    needs arm-none-eabi-g++ "libnewlib-arm-none-eabi libstdc++-arm-none-eabi-newlib" cmake "cmake" g++ "g++" node "nodejs" || return 1
    if [ ! -d "${RP2040JS:-build/tools/node_modules/rp2040js}" ]; then
        without rp2040js "npm install --prefix build/tools rp2040js@1.4.1, or RP2040JS=FOLDER"
        return 1
    fi
    if [ -z "${PICO_SDK_PATH:-}" ] && [ ! -f "${PICO_SDK_ARCHIVE:-../shared/third-party/pico-sdk-1.5.1.tar.xz}" ]; then
        without pico-sdk "git clone --depth 1 -b 1.5.1 https://github.com/raspberrypi/pico-sdk; PICO_SDK_PATH=\$PWD/pico-sdk make test-all"
        return 1
    fi
    [ -f "${PICO_BOOTROM:-../shared/target-probes/rp2040/bootrom.mjs}" ] && return 0
    without "the RP2040's boot ROM" "PICO_BOOTROM=bootrom.bin make test-all"
    return 1
}

arm() {
    needs arm-none-eabi-gcc "gcc-arm-none-eabi" qemu-system-arm "qemu-system-arm"
}

# on TARGET SUITE...: each SUITE-TARGET is what `make TARGET=... SUITE-test` does
on() {
    target=$1
    shift
    for what; do
        suite "$what-$target" $calls $make -s TARGET="$target" "$what-test"
    done
}

# ---------------------------------------------------------------------- check

format() {
    if needs clang-format-14 "clang-format-14"; then
        suite format $make -s format-check
    fi
}

# What documents and headers promise of this machine's build; without a compiler of C++, of C alone.
documents() {
    needs "${CXX:-g++}" "g++" || true
    suite headers $make -s test-headers
    suite table-file $make -s test-tables
    suite readme $make -s test-readme
    suite manual $make -s test-manual
    suite examples $make -s test-examples
    suite flush $make -s test-flush
    suite lessons $make -s test-lessons
}

host() {
    suite "$1" env SMEAR_ASSETS="$assets" build/host/run --suite "$1"
}

# Units are suites of the host's.
golden() {
    suite golden-host $make -s TARGET=host TARGET_TESTS=golden target-test
}

sanitized_briefly() {
    if sanitizers; then
        suite golden-sanitized $make -s SAN=1 CHECK=1 BRIEF=1 target-test
    fi
}

# Frames of the generator: what other workers, room, bands, caches and displays that keep their picture draw is the same.
frames() {
    suite frames-valid build/host/frames valid 1 2000
    suite frames-parts build/host/frames parts 1 600
    suite frames-threads build/host/frames threads 1 250
    suite frames-many build/host/frames many 1 150
    suite frames-wild build/host/frames wild 1 1500
}

# That nothing is called that a small core lacks shows at any level of optimization.
symbols() {
    if needs arm-none-eabi-gcc "gcc-arm-none-eabi"; then
        suite symbols-unoptimized $make -s TARGET=cortex-m0plus OPT=-O0 BUILD=build/cortex-m0plus-O0 symbols-test
    fi
}

# ---------------------------------------------------------------------- test

demo() {
    suite demo sh tests/shell/demo.sh build/test/demo
}

firmware_here() {
    suite demo-host $make -s TARGET=host demo-test
    suite game-host $make -s TARGET=host game-test
    suite device-chart sh tests/shell/device_chart.sh build/test/device-chart
    suite template $make -s template-test
}

# Programs as a user starts them.
programs() {
    needs python3 "python3" || true        # cli.sh reads statistics with it
    suite command-line sh tests/shell/cli.sh build/smear
    suite did-you-mean sh tests/shell/did_you_mean.sh build/smear
    if needs "${CXX:-g++}" "g++"; then
        suite build-kit $make -s kit
        suite sketch-compiled sh tests/shell/sketch.sh build/smear build/kit/kit.tar
    fi
    suite show sh tests/shell/show.sh build/smear
    suite outputs sh tests/shell/outputs.sh build/smear
    suite strangers sh tests/shell/strangers.sh build/smear
    suite jpeg-textures sh tests/shell/jpeg.sh build/smear build/host/jpeg-files textures
    suite view sh tests/shell/view.sh build/smear
    suite build-stalled $make -s build/host/stalled
    suite view-stalled build/host/stalled build/smear
    suite build-demo-screen $make -s build/host/demo-screen
    suite view-display sh tests/shell/view_display.sh build/host/demo-screen
}

sanitized() {
    sanitizers || return 0
    suite build-sanitized $make -s SAN=1 CHECK=1 build/host-san-check/smear build/host-san-check/run build/host-san-check/frames
    suite frames-valid-sanitized build/host-san-check/frames valid 1 600
    suite frames-wild-sanitized build/host-san-check/frames wild 1 1000
    for name in $($make -s print-san-suites); do
        suite "sanitized-$name" env SMEAR_ASSETS="$assets" build/host-san-check/run --suite "$name"
    done
    suite golden-sanitized $make -s SAN=1 CHECK=1 TARGET_TESTS=golden target-test
    suite view-sanitized sh tests/shell/view.sh build/host-san-check/smear
}

cortex_m0plus() { ! arm || on cortex-m0plus target demo symbols stack game lessons; }

gba() {
    needs arm-none-eabi-gcc "gcc-arm-none-eabi" || return 0
    on gba symbols
    if [ -e /usr/include/mgba/flags.h ] || lacks libmgba "libmgba-dev"; then
        on gba target demo game stack lessons
        suite gba-cartridge $calls sh tests/shell/gba_cartridge.sh
    fi
}

s390x() {
    if needs s390x-linux-gnu-gcc "gcc-s390x-linux-gnu libc6-dev-s390x-cross" qemu-s390x-static "qemu-user-static"; then
        on s390x target demo lessons
    fi
}

# The library as one file without a compiler's extensions and vectors: C as the standard has it.
portable() {
    suite portable-c sh tests/shell/dist_single.sh build/one-file/single plain
}

# What others build the library from.
packages() {
    needs "${CXX:-g++}" "g++" python3 "python3" || return 0
    needs cmake "cmake" || true            # dist.sh goes without some of what follows
    needs pkg-config "pkg-config" || true
    needs arduino-builder "arduino-builder arduino-ctags" || true
    needs zip "zip" || true
    suite dist $make -s dist-test
    suite dist-rules sh tests/shell/dist_rules.sh
}

objects() {
    needs arm-none-eabi-gcc "gcc-arm-none-eabi" || return 0
    # 45.8 kB of code for the renderer and its filter: all surfaces and formats, SMEAR_RECONSTRUCT and SMEAR_ACCUMULATE. (40 kB
    # is the aim; small textured triangles, rows drawn from several fills, fields told apart, poses that are copied take the rest.)
    suite objects-core env CODE_LIMIT=47104 NOT_CALLED="smear_filter_begin smear_filter_row" \
        SWITCHES="$(sh tests/shell/core_switches.sh)" sh tests/shell/target_objects.sh build/objects-core
}

# ---------------------------------------------------------------------- all

# Compilers of the one file; dist_single.sh goes without those that are not here. Builds of fuzz-builds draw with the same objects.
one_file() {
    needs tcc "tcc" || true
    suite dist-single $make -s dist-single-test
    if needs clang-14 "clang-14 libclang-rt-14-dev" g++ "g++" qemu-arm-static "qemu-user-static" \
        arm-linux-gnueabihf-gcc "gcc-arm-linux-gnueabihf libc6-dev-armhf-cross" && m32; then
        suite fuzz-builds $make -s fuzz-builds CASES=300
    fi
}

files() {
    suite build-hostile $make -s build/host/hostile
    suite limits sh tests/shell/limits.sh build/smear build/host/hostile
    suite build-faults-injected $make -s build/host/faults-injected
    suite faults-injected build/host/faults-injected .
    if needs djpeg "libjpeg-turbo-progs"; then
        suite jpeg-libjpeg sh tests/shell/jpeg.sh build/smear build/host/jpeg-files libjpeg
    fi
}

screens() {
    if needs tmux "tmux"; then
        suite view-terminal sh tests/shell/view_term.sh build/smear
    fi
    if needs Xvfb "xvfb xauth" xauth "xauth"; then
        suite build-x11-user $make -s build/host/view_x11_user
        suite view-x11 sh tests/shell/view_x11.sh build/smear build/host/view_x11_user
    fi
}

web() {
    if needs wasm-ld-14 "clang-14 lld-14" llvm-ar-14 "llvm-14" xz "xz-utils" chromedriver "chromium chromium-driver" node "nodejs" \
        python3 "python3" "${CXX:-g++}" "g++"; then
        suite build-web $make -s web build/web/libc_test
        suite web-libc build/web/libc_test
        suite web node tests/shell/web.js build/web/index.html build/smear
        suite web-game node tests/shell/web_game.js build/web/game.html
        suite game-wasm $make -s TARGET=wasm game-test
        suite target-wasm $make -s TARGET=wasm target-test
    fi
}

switches() {
    suite switches $make -s switches-test
}

# Files and frames of generators, under sanitizers.
generated() {
    needs clang-14 "clang-14 libclang-rt-14-dev" || return 0
    suite fuzz-corpus $make -s fuzz-corpus
    suite fuzz-frames $make -s fuzz MINUTES=1
}

proofs() {
    if needs frama-c "frama-c-base"; then
        suite proofs $make -s proofs STEP=7
    fi
}

coverage() {
    suite coverage $make -s coverage
}

linux() {
    if needs qemu-system-x86_64 "qemu-system-x86"; then
        suite build-linux $make -s build/host/smear-static build/host/view_linux_init build/host/mkcpio
        suite view-linux sh tests/shell/view_linux.sh build/smear build/kernel build/host/smear-static \
            build/host/view_linux_init build/host/mkcpio
        suite demo-linux $make -s TARGET=linux demo-test
    fi
}

cortex_m3() {
    arm || return 0
    on cortex-m3 target demo symbols stack
    # Of the switches some: that each can be off is what the suite `switches` shows. Sets are measured by what compiles faster:
    # no number is held against another.
    suite footprint $calls SWITCHES="SMEAR_WITH_SUBFRAMES SMEAR_WITH_TEXTURE" \
        $make -s footprint FOOTPRINT=cortex-m3:-O2 FOOTPRINT_SETS=cortex-m3:-O1
}
cortex_m4() { ! arm || on cortex-m4 target demo symbols; }
cortex_m7() { ! arm || on cortex-m7 target demo symbols; }
cortex_m33() {
    arm || return 0
    on cortex-m33 target demo symbols
    # As an RP2350 has the library.
    suite target-cortex-m33-dsp $calls $make -s TARGET=cortex-m33 OPT="-O2 -DSMEAR_ASM_ARMV7EM=1" BUILD=build/cortex-m33-dsp target-test
}

raspi0() {
    arm || return 0
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
    arm || return 0
    on lm3s6965evb symbols stack demo
    on microbit symbols
    suite tiny $calls $make -s TARGET=microbit tiny-test
    suite model $calls sh tests/shell/target_model.sh build/smear tests/data/arm.gltf
    pico_tools || return 0
    on pico demo game stack
    suite pico $calls sh tests/shell/target_pico.sh build/smear tests/data/arm.gltf
    suite pico-stranger $calls sh tests/shell/pico_stranger.sh tests/data/arm.gltf
}

# An RP2350 by a compiler alone; by version 2 of the SDK, too, where it is.
pico2() {
    arm || return 0
    on pico2 symbols stack demo game
    suite pico2 $calls sh tests/shell/target_pico2.sh ${PICO2_SDK_PATH:+"$PICO2_SDK_PATH"}
}

all_objects() {
    ! needs arm-none-eabi-gcc "gcc-arm-none-eabi" || suite objects-cortex-m0plus sh tests/shell/target_objects.sh build/objects
}

rv32imc() {
    if needs riscv64-unknown-elf-gcc "gcc-riscv64-unknown-elf" qemu-system-riscv32 "qemu-system-misc"; then
        on rv32imc target symbols demo stack lessons
    fi
}

lx106() {
    if needs xtensa-lx106-elf-gcc "gcc-xtensa-lx106" qemu-system-xtensa "qemu-system-misc"; then
        on lx106 target symbols demo
    fi
}

linux_arm() {
    needs qemu-arm-static "qemu-user-static" || return 0
    ! needs arm-linux-gnueabi-gcc "gcc-arm-linux-gnueabi libc6-dev-armel-cross" || on linux-armel target demo
    ! needs arm-linux-gnueabihf-gcc "gcc-arm-linux-gnueabihf libc6-dev-armhf-cross" || on linux-armhf target demo game
    ! needs aarch64-linux-gnu-gcc "gcc-aarch64-linux-gnu libc6-dev-arm64-cross" || on linux-aarch64 target demo
}

# ---------------------------------------------------------------------- what runs

alone
find_assets
suite includes $make -s layers
suite house $make -s house
suite core-alone $make -s core-alone

# What groups share is built before. In `all`, CMake's projects, of which many compile the library and pico-sdk, share objects; so
# do builds of the one file, and this machine's with that of a clone.
SMEAR_OBJECTS=$PWD/build/test/objects
CMAKE_C_COMPILER_LAUNCHER="sh;$PWD/tests/shell/launch_cached.sh"
export SMEAR_OBJECTS CMAKE_C_COMPILER_LAUNCHER
rm -rf "$SMEAR_OBJECTS"
one_file=build/one-file/single/smear.c
built="all build/host/run build/host/frames build/smear-demo build/host/target_golden build/demo/props.c"
[ "$level" = check ] || built="$built build/host/demo build/host/game build/tapes/small.c build/demo/target_screen build/host/jpeg-files $one_file"
case $level in
# Warnings of the optimizer are errors here.
all) suite build $make -s CC="sh $PWD/tests/shell/launch_cached.sh ${CC:-cc} -Werror" $built build/host/tiny ;;
*) suite build $make -s $built ;;
esac
suites=
for name in $($make -s print-suites); do
    case $level:$name in
    check:accuracy | check:blur | check:failures) ;;
    test:* | all:* | check:*) suites="$suites host=$name" ;;
    esac
done
# The longest first, by what suites print.
tests="sanitized packages cortex_m0plus gba s390x objects programs documents firmware_here demo format golden frames $suites"
case $level in
check) groups="sanitized_briefly documents symbols format golden frames $suites" ;;
test) groups="portable $tests" ;;
all)
    groups="one_file coverage boards pico2 generated switches web files linux_arm cortex_m3 linux raspi0 cortex_m7 cortex_m4 cortex_m33"
    groups="$groups $tests rv32imc lx106 screens all_objects proofs symbols"
    ;;
esac
[ $# -gt 0 ] || eval "set -- $groups"
lanes "$@"
add_up
