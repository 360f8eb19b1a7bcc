#!/bin/sh
# SPDX-License-Identifier: MIT
# dist.sh SINGLE-TOOL OUT ROOM...
# Writes the forms in which people take a library: OUT/single (smear.c, smear.h and two small headers), and
# OUT/FORM/smear for CMake, PlatformIO, Arduino, ESP-IDF, Zephyr and pico-sdk, each with its manifests and examples, and
# an archive of each, OUT/smear-VERSION-FORM.tar.gz or .zip, the same bytes from the same sources. ROOM... are the
# folders of src/ and src/ itself, the lowest first. URL: where the project lives, for manifests. FORMS=single: only that one.
set -eu
tool=$1 out=$2
shift 2
from=tools/dist
rm -rf "$out"
version=$(sh "$from/version.sh")
url=${URL:-https://example.com/smear}

headers=$(sh tests/shell/layers.sh --order "$@" | grep '\.h$')
sources=$(sh tests/shell/layers.sh --order "$@" | grep '\.c$')
names=$(echo "$sources" | sed 's|^src/||')
switches=$(sed -n 's/^#ifndef \(SMEAR_WITH_[A-Z0-9_]*\).*/\1/p' include/smear_config.h | grep -v _ALL)

# fill TEMPLATE FILE PREFIX-OF-SOURCES: version, list of sources, definitions from Kconfig
fill() {
    for name in $names; do
        printf '    %s%s\n' "$3" "$name"
    done >"$out/sources"
    sed -e "s/@VERSION@/$version/g" -e "s|@URL@|$url|g" -e "/@SOURCES@/{
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

# example FOLDER DISPLAY: the cube and the display it draws on
example() {
    mkdir -p "$1"
    cp platform/examples/cube.h "$1/cube.h"
    cp "platform/examples/$2.h" "$1/display.h"
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
            esac
        done
        printf '\n%s\n' "$3"
    } >"$1"
}

mkdir -p "$out/single"
# shellcheck disable=SC2086
"$tool" SOURCE "$out/single/smear.c" $headers $sources
"$tool" HEADER "$out/single/smear.h" include/smear.h include/smear_overlay.h include/smear_model.h \
    include/smear_config.h include/smear_methods.h include/smear_stats.h include/smear_memory.h
cp include/smear_math.h include/smear.hpp LICENSE "$out/single"
[ "${FORMS:-}" != single ] || exit 0

tree cmake
: >"$out/definitions"
fill $from/cmake/CMakeLists.txt "$out/cmake/smear/CMakeLists.txt" src/

tree platformio
fill $from/platformio/library.json "$out/platformio/smear/library.json" ""
plain=$out/platformio/smear/examples/plain
mkdir -p "$plain/src"
awk '/^```c$/ { on = 1; next } /^```$/ { on = 0 } on' README.md >"$plain/src/main.c"
cp $from/platformio/plain.ini "$plain/platformio.ini"
example "$out/platformio/smear/examples/arduino/src" tft_espi
cp $from/platformio/arduino.ini "$out/platformio/smear/examples/arduino/platformio.ini"
sed 's/^#include <smear.h>/#include <Arduino.h>\n&/' $from/arduino/example.ino >"$out/platformio/smear/examples/arduino/src/main.cpp"

# One file: Arduino compiles all that lies in src/, with every library's folder in the path of all others.
mkdir -p "$out/arduino/smear/src"
cp "$out/single/smear.c" "$out"/single/*.h* "$out/arduino/smear/src"
cp LICENSE "$out/arduino/smear"
fill $from/arduino/library.properties "$out/arduino/smear/library.properties" ""
for display in TFT_eSPI LovyanGFX Adafruit_GFX Arduino_GFX U8g2; do
    example "$out/arduino/smear/examples/$display" "$(echo $display | tr '[:upper:]' '[:lower:]')"
    cp $from/arduino/example.ino "$out/arduino/smear/examples/$display/$display.ino"
done

# Only what is switched off is defined: the others default to 1.
for switch in $switches; do
    printf 'if(NOT CONFIG_%s)\n    target_compile_definitions(${COMPONENT_LIB} PUBLIC %s=0)\nendif()\n' "$switch" "$switch"
done >"$out/definitions"
tree esp-idf
fill $from/esp-idf/CMakeLists.txt "$out/esp-idf/smear/CMakeLists.txt" src/
fill $from/esp-idf/idf_component.yml "$out/esp-idf/smear/idf_component.yml" ""
kconfig "$out/esp-idf/smear/Kconfig" 'menu "smear"' endmenu
cp $from/esp-idf/README.md "$out/esp-idf/smear"
mkdir -p "$out/esp-idf/smear/examples"
cp -r $from/esp-idf/example "$out/esp-idf/smear/examples/cube"
example "$out/esp-idf/smear/examples/cube/main" esp_lcd

for switch in $switches; do
    printf '    if(NOT CONFIG_%s)\n        zephyr_compile_definitions(%s=0)\n    endif()\n' "$switch" "$switch"
done >"$out/definitions"
tree zephyr
mkdir -p "$out/zephyr/smear/zephyr"
fill $from/zephyr/CMakeLists.txt "$out/zephyr/smear/zephyr/CMakeLists.txt" '    ${smear_root}/src/'
fill $from/zephyr/module.yml "$out/zephyr/smear/zephyr/module.yml" ""
kconfig "$out/zephyr/smear/zephyr/Kconfig" "$(printf 'config SMEAR\n\tbool "smear: motion-blurred 3D"\n\nif SMEAR')" endif

sample=$out/zephyr/smear/samples/cube
example "$sample/src" zephyr_display
cp $from/zephyr/sample/main.c "$sample/src"
cp $from/zephyr/sample/CMakeLists.txt $from/zephyr/sample/prj.conf $from/zephyr/sample/sample.yaml "$sample"

tree pico-sdk
fill $from/pico-sdk/CMakeLists.txt "$out/pico-sdk/smear/CMakeLists.txt" '        ${CMAKE_CURRENT_LIST_DIR}/src/'

example "$out/pico-sdk/smear/examples/cube" pico_spi
cp $from/pico-sdk/example/* "$out/pico-sdk/smear/examples/cube"

rm -f "$out/sources" "$out/definitions"
mkdir -p "$out/packed/single/smear"
cp "$out"/single/* "$out/packed/single/smear"
for form in cmake platformio arduino esp-idf zephyr pico-sdk single; do
    folder=$out/$form
    [ $form != single ] || folder=$out/packed/single
    find "$folder/smear" -exec touch -h -d '1980-01-01 00:00:00 UTC' {} +
    find "$folder/smear" -type f -exec chmod 644 {} +
    find "$folder/smear" -type d -exec chmod 755 {} +
    if [ $form != arduino ]; then
        tar -C "$folder" --sort=name --owner=0 --group=0 --numeric-owner --format=ustar -cf - smear | gzip -9n >"$out/smear-$version-$form.tar.gz"
    elif command -v zip >/dev/null 2>&1; then
        archive=$(cd "$out" && pwd)/smear-$version-$form.zip
        (cd "$folder" && find smear | LC_ALL=C sort | TZ=UTC zip -X -q -9 -@ "$archive")
    else
        echo "no $form.zip without zip: apt-get install zip"
    fi
done
rm -rf "$out/packed"
[ -n "${URL:-}" ] || echo "manifests name $url: make dist URL=https://... names the project's home"
echo "smear $version in $out: single, cmake, platformio, arduino, esp-idf, zephyr, pico-sdk, each with its archive"
