#!/bin/sh
# SPDX-License-Identifier: MIT
# dist.sh SINGLE-TOOL OUT ROOM...
# Writes the forms in which people take a library: OUT/single (smear.c, smear.h and three small headers), and
# OUT/FORM/smear for CMake, PlatformIO, Arduino, ESP-IDF, Zephyr and pico-sdk, each with its manifests. ROOM... are the
# folders of src/, src/ itself last, the lowest first.
set -eu
tool=$1 out=$2
shift 2
from=tools/dist
rm -rf "$out"
version=$(sh "$from/version.sh")

headers=$(sh tests/shell/layers.sh --order "$@" | grep '\.h$')
sources=$(sh tests/shell/layers.sh --order "$@" | grep '\.c$')
names=$(echo "$sources" | sed 's|^src/||')
switches=$(sed -n 's/^#ifndef \(SMEAR_WITH_[A-Z0-9_]*\).*/\1/p' include/smear_config.h | grep -v _ALL)

# fill TEMPLATE FILE PREFIX-OF-SOURCES: version, list of sources, definitions from Kconfig
fill() {
    for name in $names; do
        printf '    %s%s\n' "$3" "$name"
    done >"$out/sources"
    sed -e "s/@VERSION@/$version/g" -e "/@SOURCES@/{
r $out/sources
d
}" -e "/@DEFINITIONS@/{
r $out/definitions
d
}" "$1" >"$2"
}

# sources of many files: FORM
tree() {
    mkdir -p "$out/$1/smear/include" "$out/$1/smear/src"
    cp include/*.h* "$out/$1/smear/include"
    # shellcheck disable=SC2086
    for file in $headers $sources; do
        mkdir -p "$out/$1/smear/${file%/*}"
        cp "$file" "$out/$1/smear/$file"
    done
    cp LICENSE "$out/$1/smear"
}

# Kconfig of all switches: FILE HEAD TAIL
kconfig() {
    {
        echo "$2"
        for switch in $switches; do
            printf '\nconfig %s\n\tbool "%s"\n\tdefault y\n' "$switch" "$switch"
            case $switch in
            *_TIMEMASK | *_DAMAGE) printf '\tdepends on SMEAR_WITH_SUBFRAMES\n' ;;
            *_FILTERS | *_LAYERS) printf '\tdepends on SMEAR_WITH_RECONSTRUCT\n' ;;
            *_BLUE_DITHER) printf '\tdepends on SMEAR_WITH_DITHER\n' ;;
            esac
        done
        printf '\n%s\n' "$3"
    } >"$1"
}

mkdir -p "$out/single"
# shellcheck disable=SC2086
"$tool" SOURCE "$out/single/smear.c" $headers $sources
"$tool" HEADER "$out/single/smear.h" include/smear_config.h include/smear.h include/smear_overlay.h include/smear_model.h
cp include/smear_memory.h include/smear_math.h include/smear.hpp LICENSE "$out/single"

tree cmake
: >"$out/definitions"
fill $from/cmake/CMakeLists.txt "$out/cmake/smear/CMakeLists.txt" src/

tree platformio
fill $from/platformio/library.json "$out/platformio/smear/library.json" ""
mkdir -p "$out/platformio/smear/examples/cube"
awk '/^```c$/ { on = 1; next } /^```$/ { on = 0 } on' README.md >"$out/platformio/smear/examples/cube/main.c"

# One file: Arduino compiles all that lies in src/, with every library's folder in the path of all others.
mkdir -p "$out/arduino/smear/src" "$out/arduino/smear/examples/cube"
cp "$out/single/smear.c" "$out"/single/*.h* "$out/arduino/smear/src"
cp LICENSE "$out/arduino/smear"
fill $from/arduino/library.properties "$out/arduino/smear/library.properties" ""
cp $from/arduino/cube.ino "$out/arduino/smear/examples/cube/cube.ino"

# Only what is switched off is defined: the others default to 1.
for switch in $switches; do
    printf 'if(NOT CONFIG_%s)\n    target_compile_definitions(${COMPONENT_LIB} PUBLIC %s=0)\nendif()\n' "$switch" "$switch"
done >"$out/definitions"
tree esp-idf
fill $from/esp-idf/CMakeLists.txt "$out/esp-idf/smear/CMakeLists.txt" src/
fill $from/esp-idf/idf_component.yml "$out/esp-idf/smear/idf_component.yml" ""
kconfig "$out/esp-idf/smear/Kconfig" 'menu "smear"' endmenu

for switch in $switches; do
    printf '    if(NOT CONFIG_%s)\n        zephyr_compile_definitions(%s=0)\n    endif()\n' "$switch" "$switch"
done >"$out/definitions"
tree zephyr
mkdir -p "$out/zephyr/smear/zephyr"
fill $from/zephyr/CMakeLists.txt "$out/zephyr/smear/zephyr/CMakeLists.txt" '    ${smear_root}/src/'
fill $from/zephyr/module.yml "$out/zephyr/smear/zephyr/module.yml" ""
kconfig "$out/zephyr/smear/zephyr/Kconfig" "$(printf 'config SMEAR\n\tbool "smear: motion-blurred 3D"\n\nif SMEAR')" endif

tree pico-sdk
fill $from/pico-sdk/CMakeLists.txt "$out/pico-sdk/smear/CMakeLists.txt" '        ${CMAKE_CURRENT_LIST_DIR}/src/'

rm -f "$out/sources" "$out/definitions"
echo "smear $version in $out: single, cmake, platformio, arduino, esp-idf, zephyr, pico-sdk"
