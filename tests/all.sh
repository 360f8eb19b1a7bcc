#!/bin/sh
# SPDX-License-Identifier: MIT
# all.sh - every suite, one after the other; `make test` calls it. Each suite's output goes to build/test/NAME.log and is
# shown when it fails. The last line adds up: N passed, N failed.
#
# A suite whose tools are missing is named together with the command that installs them. With CI=true that is a
# failure: there, everything runs.
set -u
make=${MAKE:-make}
log=build/test
mkdir -p "$log"
passed=0
failed=0
missing=0
started=$(date +%s)

# suite NAME COMMAND...: a suite counts its tests in a last line "N passed, N failed"; else it is one test.
suite() {
    name=$1
    shift
    before=$(date +%s)
    "$@" >"$log/$name.log" 2>&1
    status=$?
    line=$(grep -E '^[0-9]+ passed, [0-9]+ failed$' "$log/$name.log" | tail -n 1)
    if [ -n "$line" ]; then
        good=$(echo "$line" | cut -d' ' -f1)
        bad=$(echo "$line" | cut -d' ' -f3)
        [ $status -eq 0 ] || [ "$bad" -gt 0 ] || bad=1
    else
        good=0
        bad=0
        if [ $status -eq 0 ]; then good=1; else bad=1; fi
    fi
    passed=$((passed + good))
    failed=$((failed + bad))
    printf '%-28s %4d passed, %d failed  (%d s)\n' "$name" "$good" "$bad" $(($(date +%s) - before))
    if [ "$bad" -gt 0 ]; then
        echo "--- $log/$name.log"
        tail -n 60 "$log/$name.log"
        echo "---"
    fi
}

# needs TOOL PACKAGES: true when the tool is there.
needs() {
    command -v "$1" >/dev/null 2>&1 && return 0
    if [ "${CI:-}" = true ]; then
        echo "$1 is missing: apt-get install --no-install-recommends $2"
        failed=$((failed + 1))
    else
        echo "not run without $1: apt-get install --no-install-recommends $2"
        missing=$((missing + 1))
    fi
    return 1
}

exr() {
    command -v pkg-config >/dev/null 2>&1 && pkg-config --exists OpenEXR
}

[ -n "${SMEAR_ASSETS:-}" ] || [ -d ../shared/assets ] ||
    echo "SMEAR_ASSETS names no folder of sample models: tests of these are left out"
suite layers $make -s layers
jobs=-j$(getconf _NPROCESSORS_ONLN)
suite build $make -s $jobs all build/host/run
suite demo sh tests/shell/demo.sh build/test/demo
suite headers $make -s test-headers
suite tables $make -s test-tables
suite readme $make -s test-readme
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
if needs wasm-ld-14 "clang-14 lld-14" && needs xz "xz-utils" && needs chromedriver "chromium chromium-driver" && needs node "nodejs"; then
    suite build-web $make -s web build/web/libc_test
    suite web-libc build/web/libc_test
    suite web node tests/shell/web.js build/web/index.html build/smear
fi
suite golden-host $make -s TARGET=host target-test
suite switches $make -s switches-test
needs cmake "cmake" || true            # dist.sh builds packages with it
needs pkg-config "pkg-config" || true
suite dist $make -s dist-test
suite template $make -s template-test
suite demo-host $make -s TARGET=host demo-test
suite device-chart sh tests/shell/device_chart.sh build/test/device-chart
suite build-sanitized $make -s $jobs SAN=1 CHECK=1 all build/host-san-check/run
for name in $($make -s print-san-suites); do
    suite "sanitized-$name" $make -s run-suite SUITE="$name" SAN=1 CHECK=1
done
suite view-sanitized sh tests/shell/view.sh build/host-san-check/smear
if needs qemu-system-x86_64 "qemu-system-x86"; then
    suite build-linux $make -s build/host/smear-static build/host/view_linux_init build/host/mkcpio
    suite view-linux sh tests/shell/view_linux.sh build/smear build/kernel build/host/smear-static \
        build/host/view_linux_init build/host/mkcpio
    suite demo-linux $make -s TARGET=linux demo-test
fi
if needs arm-none-eabi-gcc "gcc-arm-none-eabi qemu-system-arm" && needs qemu-system-arm "qemu-system-arm"; then
    for target in cortex-m0plus cortex-m3 cortex-m4 cortex-m7 cortex-m33; do
        suite "target-$target" $make -s TARGET=$target target-test
        suite "demo-$target" $make -s TARGET=$target demo-test
    done
    for target in cortex-m0plus cortex-m3 cortex-m4 cortex-m7 cortex-m33 lm3s6965evb rp2040 microbit gba; do
        suite "symbols-$target" $make -s TARGET=$target symbols-test
    done
    suite tiny $make -s TARGET=microbit tiny-test
    suite footprint $make -s footprint FOOTPRINT=cortex-m3:-O2
    suite demo-lm3s6965evb $make -s TARGET=lm3s6965evb demo-test
    suite demo-rp2040 $make -s TARGET=rp2040 demo-test
    suite model sh tests/shell/target_model.sh build/smear tests/data/arm.gltf
    if [ -e /usr/include/mgba/flags.h ] || needs libmgba "libmgba-dev"; then
        suite target-gba $make -s TARGET=gba target-test
        suite demo-gba $make -s TARGET=gba demo-test
    fi
    suite objects-cortex-m0plus sh tests/shell/target_objects.sh build/objects
    # 40 kB of code for the renderer and its filter: all surfaces and formats, SMEAR_RECONSTRUCT and SMEAR_ACCUMULATE.
    suite objects-core env CODE_LIMIT=40960 \
        SWITCHES="$(sh tests/shell/core_switches.sh)" sh tests/shell/target_objects.sh build/objects-core
fi
if needs riscv64-unknown-elf-gcc "gcc-riscv64-unknown-elf" && needs qemu-system-riscv32 "qemu-system-misc"; then
    suite target-rv32imc $make -s TARGET=rv32imc target-test
    suite symbols-rv32imc $make -s TARGET=rv32imc symbols-test
    suite demo-rv32imc $make -s TARGET=rv32imc demo-test
fi
if needs s390x-linux-gnu-gcc "gcc-s390x-linux-gnu libc6-dev-s390x-cross" \
    && needs qemu-s390x-static "qemu-user-static"; then
    suite target-s390x $make -s TARGET=s390x target-test
    suite demo-s390x $make -s TARGET=s390x demo-test
fi
if needs clang-14 "clang-14 libclang-rt-14-dev"; then
    suite fuzz-corpus $make -s $jobs fuzz-corpus
fi

echo "in $(($(date +%s) - started)) s"
[ $missing -eq 0 ] || echo "$missing suites were not run; the lines above say what they need"
echo "$passed passed, $failed failed"
[ $failed -eq 0 ]
