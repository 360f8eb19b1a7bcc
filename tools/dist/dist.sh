#!/bin/sh
# SPDX-License-Identifier: MIT
# dist.sh SINGLE-TOOL OUT ROOM...
# Writes the forms in which people take a library: OUT/single (smear.c, its headers, a page and examples), and OUT/FORM/smear
# for CMake, PlatformIO, Arduino, ESP-IDF, Zephyr and pico-sdk, each with its manifests, a page and two examples, and an archive of
# each, OUT/smear-VERSION-FORM.tar.gz or .zip, the same bytes from the same sources; and OUT/tree, which all of these install from
# git as it is. ROOM... are the folders of src/ and src/ itself, the lowest first. URL: where the project lives, for manifests.
# SMEAR: the program that converts the examples' model, MODEL (a file; without one that of the tests). FORMS=single: only smear.c
# and headers. FORMS=kit: only OUT/kit.tar, of which `smear convert` makes sketches.
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

# ---------------------------------------------------------------------- the one file

# Headers that are merged into smear.h: what includes one by its name gets that.
merged="smear_overlay smear_scene smear_model smear_config smear_methods smear_stats smear_memory"
mkdir -p "$out/single"
# shellcheck disable=SC2086
"$tool" SOURCE "$out/single/smear.c" $headers $sources
# shellcheck disable=SC2046
"$tool" HEADER "$out/single/smear.h" include/smear.h $(printf 'include/%s.h ' $merged)
for name in $merged; do
    printf '/* SPDX-License-Identifier: MIT */\n/* %s.h - is a part of smear.h here. */\n#include "smear.h"\n' "$name" >"$out/single/$name.h"
done
cp include/smear_math.h include/smear_matcap.h include/smear_ribbon.h include/smear.hpp LICENSE "$out/single"
[ "${FORMS:-}" != single ] || exit 0

# ---------------------------------------------------------------------- what forms are made of

# fill TEMPLATE FILE PREFIX-OF-SOURCES: version, list of sources, definitions from Kconfig, what examples are called, and what pages
# have in common. $name, $what, $root, $examples, $include say what belongs to this file.
name='' what='' root=../.. examples=examples include=include
fill() {
    for source in $names; do
        printf '    %s%s\n' "$3" "$source"
    done >"$out/sources"
    sed -e "/@SOURCES@/{
r $out/sources
d
}" -e "/@DEFINITIONS@/{
r $out/definitions
d
}" -e "/@COMMON@/{
r $from/common.md
d
}" "$1" | sed -e "/@CREDIT@/{
r $out/credit
d
}" -e "s/@VERSION@/$version/g; s|@URL@|$url|g; s/@NAME@/$name/g; s|@WHAT@|$what|g; s|@ROOT@|$root|g; s|@EXAMPLES@|$examples|g" \
        -e "s|@HEADERS@|$include|g" >"$2"
}

# page FORM FOLDER
page() { fill "$from/$1/README.md" "$2/README.md" ""; }

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
    page "$1" "$out/$1/smear"
}

# ---------------------------------------------------------------------- the kit

# A sketch for Arduino and a project of ESP-IDF but for model.h and settings.h, which `smear convert` writes (tools/convert/sketch.c); smear/
# goes into both. All lies beside what includes it, where angle brackets would not find it.
screens="lovyangfx arduino_gfx tft_espi adafruit_gfx u8g2 ili9341_t4"
if [ "${FORMS:-}" = kit ]; then
    kit=$out/kit name=show what="A converted model, animated and blurred; settings.h says how."
    mkdir -p "$kit/smear" "$kit/arduino" "$kit/esp-idf/main" "$kit/esp-idf/components/smear"
    "$tool" BARE "$kit/smear/smear.c" "$out/single/smear.c"
    # Arduino's cores compile for size, which takes up to twice as many instructions. GCC would lack high registers with 16-bit Thumb alone.
    sed -i '0,/^#include "smear.h"$/s//#if defined(__GNUC__) \&\& !defined(__clang__) \&\& (!defined(__thumb__) || defined(__thumb2__))\n#pragma GCC optimize ("O2")\n#endif\n&/' \
        "$kit/smear/smear.c"
    cp "$out"/single/*.h LICENSE "$kit/smear"
    fill $from/arduino/sketch.ino "$kit/arduino/show.ino" ""
    sed -i 's|^void setup|/* On an RP2040, or another Cortex-M0+: Tools, Optimize, -O2. It draws twice as fast. */\n&|' "$kit/arduino/show.ino"
    cp $from/arduino/display.h "$kit/arduino"
    for display in $screens; do
        cp platform/examples/$display.h "$kit/arduino"
    done
    for file in CMakeLists.txt main/CMakeLists.txt main/main.c; do
        fill $from/esp-idf/example/$file "$kit/esp-idf/$file" ""
    done
    cp $from/esp-idf/board/sdkconfig.defaults "$kit/esp-idf"
    cp platform/examples/esp_lcd.h "$kit/esp-idf/main/display.h"
    printf 'idf_component_register(SRCS smear.c INCLUDE_DIRS .)\ntarget_compile_options(${COMPONENT_LIB} PRIVATE -O2 -std=gnu11)\n' \
        >"$kit/esp-idf/components/smear/CMakeLists.txt"
    cp platform/examples/show.h "$kit/arduino"
    cp platform/examples/show.h "$kit/esp-idf/main"
    sed -i 's/#include <\(smear[a-z_]*\.h\)>/#include "\1"/; s/^#include "show.h"$/#include "settings.h"\n&/' "$kit"/arduino/* "$kit"/esp-idf/main/*
    tar -C "$kit" --sort=name --owner=0 --group=0 --numeric-owner --mode=644 --mtime=@0 --format=ustar -cf "$out/kit.tar" arduino esp-idf smear
    exit
fi

# What the examples draw: a model and a sprite sheet, converted.
drawn=$out/drawn
mkdir -p "$drawn"
awk -f $from/coin.awk >"$drawn/coin.ppm"
"$SMEAR" convert "$drawn/coin.ppm" --cell 16x16 --key ff00ff --name coin -o "$drawn/coin.h" >/dev/null
if [ -n "${MODEL:-}" ]; then
    "$SMEAR" convert "$MODEL" --clip Run --texture-size 64 --name model -o "$drawn/model.h" >/dev/null
    credit="(c) 2014 PixelMannen (CC0); rigging and animation (c) 2014 tomkranis, glTF (c) 2017 @AsoboStudio and @scurest (CC BY 4.0)"
    printf '\nThe fox: %s; converted.\n' "$credit" >"$out/credit"
    sed -i "1a\\ * The fox: $credit; converted." "$drawn/model.h"
else
    "$SMEAR" convert tests/data/arm.gltf --name model -o "$drawn/model.h" >/dev/null
    : >"$out/credit"
fi

# each COMMAND: for both examples, with $name and $what
each() {
    name=cube what="A cube that flies past, blurred."
    "$@"
    name=fox what="A converted model, animated and blurred, a sprite and text."
    "$@"
    name='' what=''
}

# drawing FOLDER DISPLAY...: what an example draws and the display it draws on
drawing() {
    mkdir -p "$1"
    cp "platform/examples/$name.h" "$1"
    [ $name = cube ] || cp platform/examples/show.h "$drawn/model.h" "$drawn/coin.h" "$1"
    [ -z "${2:-}" ] || cp "platform/examples/$2.h" "$1/display.h"
}

# A sketch, whose display is chosen in it.
sketch() { # FOLDER FILE
    drawing "$1"
    cp $from/arduino/display.h "$1"
    for display in $screens; do
        cp platform/examples/$display.h "$1"
    done
    fill $from/arduino/sketch.ino "$1/$2" ""
}

arduino_examples() { sketch "$1/$name" $name.ino; }

platformio_examples() {
    sketch "$1/$name/src" main.cpp
    sed -i 's/^#include <smear.h>/#include <Arduino.h>\n&/' "$1/$name/src/main.cpp"
    fill $from/platformio/sketch.ini "$1/$name/platformio.ini" ""
}

plain_example() {
    mkdir -p "$1/plain/src"
    awk '/^```c$/ { on = 1; next } /^```$/ { on = 0 } on' README.md >"$1/plain/src/main.c"
    fill $from/platformio/plain.ini "$1/plain/platformio.ini" ""
}

esp_examples() {
    drawing "$1/$name/main" esp_lcd
    fill $from/esp-idf/example/CMakeLists.txt "$1/$name/CMakeLists.txt" ""
    for file in CMakeLists.txt idf_component.yml main.c; do
        fill $from/esp-idf/example/main/$file "$1/$name/main/$file" ""
    done
}

# The fox on a board with a support package.
esp_board() {
    name=fox what="A converted model, animated and blurred, a sprite and text, on a board's display, by both cores."
    drawing "$1/board/main" esp_bsp
    fill $from/esp-idf/example/CMakeLists.txt "$1/board/CMakeLists.txt" ""
    for file in CMakeLists.txt main.c; do
        fill $from/esp-idf/example/main/$file "$1/board/main/$file" ""
    done
    fill $from/esp-idf/board/idf_component.yml "$1/board/main/idf_component.yml" ""
    cp $from/esp-idf/board/sdkconfig.defaults* "$1/board"
    name='' what=''
}

zephyr_examples() {
    drawing "$1/$name/src" zephyr_display
    fill $from/zephyr/sample/main.c "$1/$name/src/main.c" ""
    for file in CMakeLists.txt prj.conf sample.yaml; do
        fill $from/zephyr/sample/$file "$1/$name/$file" ""
    done
}

pico_examples() {
    drawing "$1/$name" pico_spi
    for file in CMakeLists.txt main.c; do
        fill $from/pico-sdk/example/$file "$1/$name/$file" ""
    done
}

cmake_examples() {
    drawing "$1/$name" terminal
    for file in CMakeLists.txt main.c; do
        fill $from/cmake/example/$file "$1/$name/$file" ""
    done
}

single_examples() {
    drawing "$1/$name" terminal
    fill $from/cmake/example/main.c "$1/$name/main.c" ""
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
esp_kconfig() { kconfig "$1" 'menu "smear"' endmenu; }
zephyr_kconfig() { kconfig "$1" "$(printf 'config SMEAR\n\tbool "smear: motion-blurred 3D"\n\nif SMEAR')" endif; }

# Only what is switched off is defined: the others default to 1.
esp_definitions() {
    for switch in $switches; do
        printf 'if(NOT CONFIG_%s)\n    target_compile_definitions(${COMPONENT_LIB} PUBLIC %s=0)\nendif()\n' "$switch" "$switch"
    done >"$out/definitions"
}
zephyr_definitions() {
    for switch in $switches; do
        printf '    if(NOT CONFIG_%s)\n        zephyr_compile_definitions(%s=0)\n    endif()\n' "$switch" "$switch"
    done >"$out/definitions"
}
: >"$out/definitions"

# ---------------------------------------------------------------------- forms

include=.
page single "$out/single"
include=include
each single_examples "$out/single/examples"
name=fox drawing "$out/single/examples/playdate" playdate
cp $from/single/playdate.c "$out/single/examples/playdate/main.c"

tree cmake
fill $from/cmake/CMakeLists.txt "$out/cmake/smear/CMakeLists.txt" src/
each cmake_examples "$out/cmake/smear/examples"

tree platformio
fill $from/platformio/library.json "$out/platformio/smear/library.json" ""
each platformio_examples "$out/platformio/smear/examples"
plain_example "$out/platformio/smear/examples"

# One file: Arduino compiles all that lies in src/, with every library's folder in the path of all others.
mkdir -p "$out/arduino/smear/src"
cp "$out"/single/smear.c "$out"/single/*.h* "$out/arduino/smear/src"
cp LICENSE "$out/arduino/smear"
include=src
page arduino "$out/arduino/smear"
include=include
fill $from/arduino/library.properties "$out/arduino/smear/library.properties" ""
each arduino_examples "$out/arduino/smear/examples"

esp_definitions
tree esp-idf
fill $from/esp-idf/CMakeLists.txt "$out/esp-idf/smear/CMakeLists.txt" src/
fill $from/esp-idf/idf_component.yml "$out/esp-idf/smear/idf_component.yml" ""
esp_kconfig "$out/esp-idf/smear/Kconfig"
each esp_examples "$out/esp-idf/smear/examples"
esp_board "$out/esp-idf/smear/examples"

zephyr_definitions
tree zephyr
mkdir -p "$out/zephyr/smear/zephyr"
fill $from/zephyr/CMakeLists.txt "$out/zephyr/smear/zephyr/CMakeLists.txt" '    ${smear_root}/src/'
fill $from/zephyr/module.yml "$out/zephyr/smear/zephyr/module.yml" ""
zephyr_kconfig "$out/zephyr/smear/zephyr/Kconfig"
each zephyr_examples "$out/zephyr/smear/samples"

tree pico-sdk
fill $from/pico-sdk/CMakeLists.txt "$out/pico-sdk/smear/CMakeLists.txt" '        ${CMAKE_CURRENT_LIST_DIR}/src/'
each pico_examples "$out/pico-sdk/smear/examples"

# ---------------------------------------------------------------------- one tree for all, from git

all=$out/tree
mkdir -p "$all/zephyr"
cp -r "$out/arduino/smear/." "$all"
include=src root=../../.. names=smear.c
page tree "$all"
esp_definitions
fill $from/tree/CMakeLists.txt "$all/CMakeLists.txt" ""
esp_kconfig "$all/Kconfig"
zephyr_definitions
fill $from/zephyr/CMakeLists.txt "$all/zephyr/CMakeLists.txt" '    ${smear_root}/src/'
cp "$out/zephyr/smear/zephyr/module.yml" "$all/zephyr"
zephyr_kconfig "$all/zephyr/Kconfig"
examples=examples/esp-idf
fill $from/esp-idf/idf_component.yml "$all/idf_component.yml" ""
examples=examples/platformio
fill $from/platformio/library.json "$all/library.json" ""
each platformio_examples "$all/examples/platformio"
plain_example "$all/examples/platformio"
each esp_examples "$all/examples/esp-idf"
esp_board "$all/examples/esp-idf"
each pico_examples "$all/examples/pico-sdk"
each cmake_examples "$all/examples/cmake"
root=../..
each zephyr_examples "$all/samples"

# ---------------------------------------------------------------------- archives

rm -rf "$out/sources" "$out/definitions" "$out/credit" "$drawn"
mkdir -p "$out/packed/single/smear"
cp -r "$out"/single/* "$out/packed/single/smear"
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
echo "smear $version in $out: single, cmake, platformio, arduino, esp-idf, zephyr, pico-sdk, each with its archive, and tree for git"
