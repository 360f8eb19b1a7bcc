#!/bin/sh
# SPDX-License-Identifier: MIT
# dist.sh: the forms that `make dist` and `make install` wrote into build/dist and build/dist-install
# unpack, build by their own tools, and draw one picture (the one file: dist_single.sh). What is not installed here (ESP-IDF,
# Zephyr) is stood in for by its few CMake functions, so that lists of sources, folders and switches are tried all the same,
# and manifests are held against what their specifications say.
set -u
made=$PWD/build/dist installed=$PWD/build/dist-install
. "$(dirname "$0")/lib.sh"
base=$PWD/build/dist-test
version=$(sh tools/dist/version.sh)
rm -rf "$base"
mkdir -p "$base"
# The library is compiled once for all projects that want it alike. Those of boards, which have flags and a standard in common
# therefore, do without what boards do not have; a build of fuzz-builds has the same (tests/fuzz/fuzz.mk).
file_flags="-O2 -Wall -Wextra -Werror"
board_flags="-O2 -Wall -Wextra -Werror -funsigned-char"
SMEAR_OBJECTS=${SMEAR_OBJECTS:-$base/objects}
CMAKE_C_COMPILER_LAUNCHER="sh;$PWD/tests/shell/launch_cached.sh"
export SMEAR_OBJECTS CMAKE_C_COMPILER_LAUNCHER
stand_ins=$PWD/tests/examples/stand_ins

# Everything below comes out of the archives.
dist=$base/forms
unpack() {
    mkdir -p "$dist/$1"
    case $1 in
    arduino) python3 -m zipfile -e "$made/smear-$version-arduino.zip" "$dist/arduino" ;;
    *) tar -C "$dist/$1" -xzf "$made/smear-$version-$1.tar.gz" ;;
    esac
}
for form in cmake platformio arduino esp-idf zephyr pico-sdk single; do
    claim "archive of $form" unpack $form
done
again() { (cd "$made" && sha256sum smear-*) >"$base/sums" && $make -s dist && (cd "$made" && sha256sum -c "$base/sums"); }
claim "archives are the same bytes again" again

# ---------------------------------------------------------------------- versions

states() {
    grep -qF "$2" "$1" || { grep -n -i version "$1"; return 1; }
}
claim "version of cmake" states "$dist/cmake/smear/CMakeLists.txt" "project(smear VERSION $version "
claim "version of platformio" states "$dist/platformio/smear/library.json" "\"version\": \"$version\""
claim "version of arduino" states "$dist/arduino/smear/library.properties" "version=$version"
claim "version of esp-idf" states "$dist/esp-idf/smear/idf_component.yml" "version: \"$version\""
claim "version of zephyr" states "$dist/zephyr/smear/zephyr/CMakeLists.txt" "version $version:"
claim "version of pico-sdk" states "$dist/pico-sdk/smear/CMakeLists.txt" "Version $version."
claim "version of smear.pc" states "$installed/usr/lib/pkgconfig/smear.pc" "Version: $version"
claim "Arduino: for all cores" states "$dist/arduino/smear/library.properties" "architectures=*"
claim "no other version is stated" sh -c "! grep -rnE 'VERSION [0-9]|ersion[\": =]+[0-9]+\\.[0-9]+\\.[0-9]' '$dist' \
    --include=CMakeLists.txt --include=*.json --include=*.properties --include=*.yml | grep -vF '$version' | grep -v cmake_minimum | grep ."

# ---------------------------------------------------------------------- manifests

# Those of Arduino and ESP-IDF: dist_rules.sh.
# PlatformIO's schema of library.json: fields, types, lengths.
library_json() { (cd "$1" && python3 - <<'END'
import json, os, re
m = json.load(open('library.json'))
known = '$schema name version description keywords homepage repository authors license frameworks platforms headers examples build'.split()
assert set(m) == set(known), set(m) ^ set(known)
assert re.fullmatch(r'[a-z0-9-]{1,50}', m['name']) and len(m['version']) <= 20 and len(m['description']) <= 255
assert set(m['repository']) <= {'type', 'url', 'branch'} and m['repository']['type'] in ('git', 'hg', 'svn')
assert all(set(a) <= {'name', 'email', 'url', 'maintainer'} and len(a['name']) <= 50 for a in m['authors'])
assert all(os.path.isfile(m['build']['includeDir'] + '/' + name) for name in m['headers'])
assert all(os.path.isfile(e['base'] + '/' + name) for e in m['examples'] for name in e['files'])
assert os.path.isdir(m['build']['srcDir']) and os.path.isdir(m['build']['includeDir'])
END
    )
}
claim "library.json" library_json "$dist/platformio/smear"
claim "library.json of the tree" library_json "$made/tree"
# ---------------------------------------------------------------------- Arduino, PlatformIO

# The pictures that the cube and the fox make on a panel in 12 frames (tests/shell/flush.sh).
mkdir -p "$base/plain"
cp tests/examples/stand_ins/plain.h "$base/plain/display.h"
cp "$dist/single/smear/examples/fox/model.h" "$dist/single/smear/examples/fox/coin.h" "$base/plain"
one_file() {
    # shellcheck disable=SC2086
    sh tests/shell/launch_cached.sh ${CC:-cc} -std=gnu11 $file_flags -I"$dist/single/smear" -o "$base/plain/smear.o" -c \
        "$dist/single/smear/smear.c"
}
claim "one file" one_file
plain_panel() { # EXAMPLE OPTIONS...
    plain=$1
    shift
    # shellcheck disable=SC2086
    ${CC:-cc} -std=c11 $file_flags "$@" -I"$dist/single/smear" -I"$base/plain" -I"$stand_ins" -Iplatform/examples \
        -o "$base/plain/program" tests/examples/flush.c "$base/plain/smear.o" && "$base/plain/program" >"$base/plain/$plain" &&
        is_true "$(od -An -v -tx2 -w2 "$base/plain/$plain" | sort -u | wc -l) > 100"
}
claim "one file, on a panel" plain_panel cube
claim "a model and a sprite, on a panel" plain_panel fox -DEXAMPLE_FOX
claim "on a tall one" plain_panel cube-tall -DTALL_PANEL
claim "a model on a tall one" plain_panel fox-tall -DTALL_PANEL -DEXAMPLE_FOX
claim "it is the one that dist_single.sh tries" same "$dist/single/smear/smear.c" build/one-file/single/smear.c

# Arduino's builder, on a board that is this machine, with stand-ins of the displays' libraries.
board=$base/hardware/tests/here
mkdir -p "$board/cores/here" "$board/variants" "$base/arduino-libraries" "$base/arduino-build" "$base/no-tools"
cat >"$board/boards.txt" <<END
here.name=This machine
here.build.core=here
here.build.board=HERE
END
cat >"$board/platform.txt" <<END
name=This machine
version=1.0.0
compiler.flags=$file_flags -DARDUINO={runtime.ide.version}
recipe.c.o.pattern=sh "$PWD/tests/shell/launch_cached.sh" ${CC:-cc} -std=gnu11 -c {compiler.flags} {includes} "{source_file}" -o "{object_file}"
recipe.cpp.o.pattern=${CXX:-c++} -std=gnu++11 -c {compiler.flags} {includes} "{source_file}" -o "{object_file}"
recipe.ar.pattern=ar rcs "{archive_file_path}" "{object_file}"
recipe.c.combine.pattern=${CXX:-c++} -o "{build.path}/{build.project_name}.elf" {object_files} "{build.path}/{archive_file}"
recipe.preproc.macros=${CXX:-c++} -std=gnu++11 -w -x c++ -E -CC {includes} "{source_file}" -o "{preprocessed_file_path}"
recipe.preproc.includes=${CXX:-c++} -std=gnu++11 -M -MG -MP -w {includes} "{source_file}"
END
cp "$stand_ins/Arduino.h" "$board/cores/here"
cp "$stand_ins/arduino_main.h" "$board/cores/here/main.cpp"
# library NAME HEADER...: a library of Arduino's, of stand-ins whose panel is written when the program ends
library() {
    mkdir -p "$base/arduino-libraries/$1/src"
    printf 'name=%s\nversion=1.0.0\nauthor=-\nmaintainer=-\nsentence=-\nparagraph=-\ncategory=Display\nurl=-\narchitectures=*\n' "$1" \
        >"$base/arduino-libraries/$1/library.properties"
    name=$1
    shift
    cp "$stand_ins/panel.h" "$base/arduino-libraries/$name/src/panel_of_$name.h"
    for header in "$@"; do
        sed "s/#include \"panel.h\"/#include \"panel_of_$name.h\"\nstatic struct panel_saver { ~panel_saver() { panel_save(); } } saver;/" \
            "$stand_ins/$header" >"$base/arduino-libraries/$name/src/$header"
    done
}
library TFT_eSPI TFT_eSPI.h
library LovyanGFX LovyanGFX.hpp LGFX_AUTODETECT.hpp
library Adafruit_ST7789 Adafruit_ST7789.h
library GFX_Library_for_Arduino Arduino_GFX_Library.h
library U8g2 U8x8lib.h
library ILI9341_T4 ILI9341_T4.h
# builder SKETCH.ino PANEL
builder() {
    arduino-builder -compile -quiet -hardware "$base/hardware" -hardware /usr/share/arduino-builder -tools "$base/no-tools" -libraries "$base/arduino-libraries" \
        -fqbn tests:here:here -build-path "$base/arduino-build" "$1" && "$base/arduino-build/${1##*/}.elf" >"$2"
}
# sketch EXAMPLE DISPLAY LIBRARY: the library is that of the archive, or the tree
sketch() {
    rm -rf "$base/sketch" "$base/arduino-libraries/smear"
    mkdir -p "$base/sketch" && cp -r "$3" "$base/arduino-libraries/smear" && cp -r "$3/examples/$1" "$base/sketch/$1" &&
        { printf '#define DISPLAY_%s\n' "$2"
          [ "$2" != ILI9341_T4 ] || echo '#define TALL_PANEL'
          cat "$3/examples/$1/display.h"; } >"$base/sketch/$1/display.h" && builder "$base/sketch/$1/$1.ino" "$base/$1.panel"
}
# A sketch of `smear convert`, with no library but its own.
made_sketch() {
    rm -rf "$base/sketch" "$base/arduino-libraries/smear"
    build/smear convert tests/data/arm.gltf --kit build/kit/kit.tar -o "$base/made.zip" && python3 -m zipfile -e "$base/made.zip" "$base/sketch" &&
        builder "$base/sketch/made/made.ino" "$base/made.panel" && is_true "$(od -An -v -tx2 -w2 "$base/made.panel" | sort -u | wc -l) > 20"
}
drawn_by() { # EXAMPLE DISPLAY LIBRARY
    sketch "$@" || return 1
    case $2 in
    U8G2) ;;
    ILI9341_T4) same "$base/plain/$1-tall" "$base/$1.panel" ;;
    *) same "$base/plain/$1" "$base/$1.panel" ;;
    esac
}
if command -v arduino-builder >/dev/null 2>&1 && command -v arduino-ctags >/dev/null 2>&1; then
    for display in LOVYANGFX ARDUINO_GFX TFT_ESPI ADAFRUIT_GFX U8G2 ILI9341_T4; do
        claim "cube for $display by arduino-builder" drawn_by cube $display "$dist/arduino/smear"
        claim "fox for $display by arduino-builder" drawn_by fox $display "$dist/arduino/smear"
    done
    claim "a sketch of smear convert by arduino-builder" made_sketch
    claim "fox by arduino-builder, from the tree" drawn_by fox LOVYANGFX "$made/tree"
else
    echo "not run without arduino-builder and arduino-ctags"
fi

# ---------------------------------------------------------------------- all examples, by their cores' own flags

# compiles NAME COMPILER FLAGS... -- FILE: the example against stand-ins
compiles() {
    claim_of=$1
    shift
    claim "$claim_of" "$@" -Wall -Werror -I"$stand_ins" -fsyntax-only
}
cxx=${CXX:-c++} cc=${CC:-cc}
esp="-Os -Werror=all -Wno-error=unused-function -Wno-error=unused-variable -Wextra -Wno-unused-parameter -Wno-sign-compare -Wno-enum-conversion
 -ffunction-sections -fdata-sections -fstrict-volatile-bitfields -gdwarf-4"
for forms in "$dist/arduino/smear src" "$made/tree src"; do
    folder=${forms% *} include="$folder/src"
    for example in cube fox; do
        for display in LOVYANGFX ARDUINO_GFX TFT_ESPI ADAFRUIT_GFX U8G2 ILI9341_T4; do
            option=-DDISPLAY_$display
            [ $display != ILI9341_T4 ] || option="$option -DTALL_PANEL"
            [ $display != U8G2 ] || option="$option -DSMALL_PANEL"
            for core in "-std=c++11 -Os" "-std=gnu++11 -Os -fno-exceptions -fno-rtti -fpermissive -felide-constructors -fno-threadsafe-statics" \
                "-std=gnu++17 -Os -fno-exceptions -Wextra" "-std=gnu++20 $esp -fno-exceptions"; do
                # shellcheck disable=SC2086
                compiles "${folder##*/} $example $display: $core" $cxx $core $option -x c++ -include "$board/cores/here/Arduino.h" -I"$include" \
                    "$folder/examples/$example/$example.ino"
            done
        done
    done
done
refuses() { ! $cxx -std=c++11 -D"$1" -DDISPLAY_TFT_ESPI -I"$made/tree/src" -I"$stand_ins" -fsyntax-only -x c++ "$dist/arduino/smear/examples/cube/cube.ino" \
    -include "$board/cores/here/Arduino.h" 2>"$base/said" && has "$base/said" 'take LovyanGFX or Arduino_GFX'; }
for chip in CONFIG_IDF_TARGET_ESP32P4 CONFIG_IDF_TARGET_ESP32C6 PICO_RP2350; do
    claim "TFT_eSPI is refused with $chip" refuses $chip
done
zephyr_flags="-Os -std=c11 -fno-strict-aliasing -Wformat -Wformat-security -Wno-format-zero-length -Wdouble-promotion -Wno-pointer-sign -Wpointer-arith
 -Wexpansion-to-defined -Wno-address-of-packed-member -Wno-unused-but-set-variable -fno-common -ffreestanding"
# A form's folder, its examples, where its headers are.
for places in "$dist/platformio/smear examples include pio" "$made/tree examples/platformio src pio" \
    "$dist/esp-idf/smear examples include idf" "$made/tree examples/esp-idf src idf" "$dist/zephyr/smear samples include zephyr" \
    "$made/tree samples src zephyr" "$dist/pico-sdk/smear examples include pico" "$made/tree examples/pico-sdk src pico" \
    "$dist/cmake/smear examples include c" "$made/tree examples/cmake src c" "$dist/single/smear examples . c"; do
    # shellcheck disable=SC2086
    set -- $places
    for example in cube fox; do
        folder=$1/$2/$example name="${1#"$base/"} $2/$example"
        name=${name#"$made/"}
        case $4 in
        pio)
            for display in LOVYANGFX ARDUINO_GFX TFT_ESPI; do
                compiles "$name $display" $cxx -std=gnu++11 -Os -fno-exceptions -DDISPLAY_$display -I"$1/$3" -I"$board/cores/here" "$folder/src/main.cpp"
            done
            compiles "$name on Teensy" $cxx -std=gnu++17 -O2 -fno-exceptions -fno-rtti -fpermissive -felide-constructors -D__IMXRT1062__ -DTALL_PANEL \
                -I"$1/$3" -I"$board/cores/here" "$folder/src/main.cpp"
            ;;
        idf)
            compiles "$name" $cc -std=gnu17 $esp -I"$1/$3" "$folder/main/main.c"
            compiles "$name as C++" $cxx -std=gnu++11 $esp -Wno-missing-field-initializers -fno-exceptions -fno-rtti -I"$1/$3" -x c++ "$folder/main/main.c"
            bsp=$1/$2/board/main
            [ $example = cube ] || for display in "" -DBOARD_DSI "-DBOARD_DSI -DCONFIG_FREERTOS_UNICORE"; do
                compiles "${name%fox}board $display" $cc -std=gnu17 $esp $display -I"$1/$3" "$bsp/main.c"
                compiles "${name%fox}board as C++ $display" $cxx -std=gnu++11 $esp $display -Wno-missing-field-initializers -fno-exceptions -fno-rtti \
                    -I"$1/$3" -x c++ "$bsp/main.c"
            done
            ;;
        zephyr) compiles "$name" $cc $zephyr_flags -I"$1/$3" "$folder/src/main.c" ;;
        pico)
            compiles "$name" $cc -std=gnu11 -Os -Wextra -I"$1/$3" "$folder/main.c"
            compiles "$name as C++" $cxx -std=c++11 -Os -fno-exceptions -fno-rtti -Wno-missing-field-initializers -I"$1/$3" -x c++ "$folder/main.c"
            ;;
        c)
            compiles "$name" $cc -std=c99 -Os -Wextra -Wpedantic -I"$1/$3" "$folder/main.c"
            compiles "$name as C++" $cxx -std=c++11 -Os -fno-exceptions -Wextra -Wpedantic -I"$1/$3" -x c++ "$folder/main.c"
            ;;
        esac
    done
done
compiles "single, on a Playdate" $cc -std=gnu11 -Os -Wstrict-prototypes -Wno-unknown-pragmas -Wdouble-promotion -DWIDE_PANEL -DTARGET_PLAYDATE=1 \
    -I"$dist/single/smear" "$dist/single/smear/examples/playdate/main.c"
if command -v arm-none-eabi-g++ >/dev/null 2>&1; then
    for example in cube fox; do
        compiles "fits a Cortex-M0+'s compiler: $example" arm-none-eabi-g++ -std=gnu++17 -mcpu=cortex-m0plus -mthumb -Os -fno-exceptions -fno-rtti \
            -DDISPLAY_LOVYANGFX -x c++ -include "$board/cores/here/Arduino.h" -I"$made/tree/src" "$made/tree/examples/$example/$example.ino"
    done
fi
# A page and two examples each.
complete() { exists "$1/README.md" && exists "$1/LICENSE" && [ "$(find "$1" -name cube.h | wc -l)" -ge 1 ] && [ "$(find "$1" -name model.h | wc -l)" -ge 1 ] &&
    ! grep -rn '@[A-Z]*@' "$1"; }
for form in cmake platformio arduino esp-idf zephyr pico-sdk single; do
    claim "$form has a page and two examples, nothing left to fill" complete "$dist/$form/smear"
done
claim "the tree, too" complete "$made/tree"
pages() {
    for page in "$dist"/*/smear/README.md "$made/tree/README.md"; do
        sed -n 's/[^]]*](\([^)]*\))/\1\n/gp' "$page" | grep -v -e '^http' -e '^$' -e ' ' | while read -r to; do
            [ -e "${page%/*}/$to" ] || { echo "$page: $to"; exit 1; }
        done || return 1
    done
}
claim "what their pages point to is there" pages

# As PlatformIO builds: each source by itself.
example() {
    objects=$base/platformio
    mkdir -p "$objects" && find "$dist/platformio/smear/src" -name '*.c' | xargs -P 2 -I{} sh -c '
        object=$1/$(echo "$2" | cksum | tr " " -).o
        sh tests/shell/launch_cached.sh $3 -std=gnu11 $4 -I"$5/include" -I"$5/src" -o "$object" -c "$2"' \
        sh "$objects" {} "${CC:-cc}" "$board_flags" "$dist/platformio/smear" &&
        ${CC:-cc} -std=gnu11 -I"$dist/platformio/smear/include" -o "$base/example" "$dist/platformio/smear/examples/plain/src/main.c" \
            "$objects"/*.o && "$base/example" >"$base/example.ppm"
}
claim "plain example of platformio" example
# ---------------------------------------------------------------------- installed

if command -v pkg-config >/dev/null 2>&1; then
    installed_example() {
        flags=$(PKG_CONFIG_PATH="$installed/usr/lib/pkgconfig" pkg-config --define-variable=prefix="$installed/usr" --cflags --libs smear) &&
            # shellcheck disable=SC2086
            ${CC:-cc} -std=gnu11 -o "$base/pc" "$dist/platformio/smear/examples/plain/src/main.c" $flags && "$base/pc" >"$base/pc.ppm" &&
            cmp "$base/pc.ppm" "$base/example.ppm"
    }
    claim "program by pkg-config" installed_example
else
    echo "not run without pkg-config"
fi

# ---------------------------------------------------------------------- CMake, and what is built on it

if command -v cmake >/dev/null 2>&1; then
    # project NAME: configures and builds out/NAME, whose program draws the example's picture. That it is a release where nobody
    # says otherwise is shown by its commands, below: one build with all optimization is fuzz-builds' part. What compiles fastest
    # is enough here: no flags but a project's own.
    debug="-DCMAKE_BUILD_TYPE=Debug -DCMAKE_C_FLAGS_DEBUG="
    project() {
        cp "$dist/platformio/smear/examples/plain/src/main.c" "$base/$1/main.c"
        # shellcheck disable=SC2086
        cmake -S "$base/$1" -B "$base/$1/build" -DCMAKE_PREFIX_PATH="$base/prefix" $debug &&
            cmake --build "$base/$1/build" -j2 &&
            "$base/$1/build/program" >"$base/$1/picture.ppm" && cmp "$base/$1/picture.ppm" "$base/example.ppm"
    }
    mkdir -p "$base/subdirectory" "$base/package" "$base/esp-idf" "$base/zephyr" "$base/pico-sdk" "$base/fetch"
    cat >"$base/subdirectory/CMakeLists.txt" <<END
cmake_minimum_required(VERSION 3.13)
project(program C)
add_subdirectory($dist/cmake/smear smear)
add_executable(program main.c)
target_link_libraries(program smear::smear)
END
    claim "cmake: add_subdirectory" project subdirectory
    package() {
        # shellcheck disable=SC2086
        cmake -S "$dist/cmake/smear" -B "$base/cmake" -DCMAKE_INSTALL_PREFIX="$base/prefix" $debug &&
            cmake --build "$base/cmake" -j2 && cmake --install "$base/cmake" && project package
    }
    cat >"$base/package/CMakeLists.txt" <<END
cmake_minimum_required(VERSION 3.13)
project(program C)
find_package(smear $version EXACT REQUIRED)
add_executable(program main.c)
target_link_libraries(program smear::smear)
END
    claim "cmake: find_package" package
    release() {
        cmake -S "$dist/cmake/smear" -B "$base/release" -DCMAKE_EXPORT_COMPILE_COMMANDS=ON &&
            has "$base/release/compile_commands.json" '-O3 .*/crc32\.c'
    }
    claim "cmake: a release, where nobody says otherwise" release

    cat >"$base/fetch/CMakeLists.txt" <<END
cmake_minimum_required(VERSION 3.14)
project(program C)
include(FetchContent)
FetchContent_Declare(smear URL $made/smear-$version-cmake.tar.gz)
FetchContent_MakeAvailable(smear)
add_executable(program main.c)
target_link_libraries(program smear::smear)
END
    claim "cmake: FetchContent of the archive" project fetch

    switches=$(sed -n 's/^config \(SMEAR_WITH_[A-Z0-9_]*\)$/set(CONFIG_\1 y)/p' "$dist/esp-idf/smear/Kconfig")
    # switched_off NAME: the same project without models; of its library the one source is compiled that would have them
    switched_off() {
        mkdir -p "$base/$1-off"
        cp "$base/$1/main.c" "$base/$1-off"
        sed '/CONFIG_SMEAR_WITH_MODEL /d' "$base/$1/CMakeLists.txt" >"$base/$1-off/CMakeLists.txt"
        ! cmp -s "$base/$1/CMakeLists.txt" "$base/$1-off/CMakeLists.txt" &&
            cmake -S "$base/$1-off" -B "$base/$1-off/build" -DCMAKE_EXPORT_COMPILE_COMMANDS=ON &&
            command=$(sed -n 's|^ *"command": "\(.*\) -o [^ ]* -c \(.*/model/anim\.c\)",*$|\1 -c \2|p' "$base/$1-off/build/compile_commands.json") &&
            [ -n "$command" ] && sh -c "$command -o $base/$1-off/anim.o" && ! nm "$base/$1-off/anim.o" | grep smear_actor_init &&
            nm "$base/$1/build/$2" | grep -q smear_actor_init
    }
    # esp_project NAME ROOT [FLAGS], with the component's CMakeLists.txt in ROOT; likewise for the others
    esp_project() {
        mkdir -p "$base/$1"
        cat >"$base/$1/CMakeLists.txt" <<END
cmake_minimum_required(VERSION 3.13)
project(program C)
set(CMAKE_C_STANDARD 11)
add_compile_options(${3:-$board_flags})
function(idf_component_register)
    cmake_parse_arguments(c "" "" "SRCS;INCLUDE_DIRS;PRIV_INCLUDE_DIRS" \${ARGN})
    list(TRANSFORM c_SRCS PREPEND $2/)
    list(TRANSFORM c_INCLUDE_DIRS PREPEND $2/)
    list(TRANSFORM c_PRIV_INCLUDE_DIRS PREPEND $2/)
    add_library(component STATIC \${c_SRCS})
    target_include_directories(component PUBLIC \${c_INCLUDE_DIRS} PRIVATE \${c_PRIV_INCLUDE_DIRS})
    set(COMPONENT_LIB component PARENT_SCOPE)
endfunction()
$switches
set(ESP_PLATFORM 1)
include($2/CMakeLists.txt)
add_executable(program main.c)
target_link_libraries(program component)
END
    }
    esp_project esp-idf "$dist/esp-idf/smear"
    claim "esp-idf's functions" project esp-idf
    made_project() {
        build/smear convert tests/data/arm.gltf --kit build/kit/kit.tar --display esp_lcd -o "$base/made.zip" &&
            python3 -m zipfile -e "$base/made.zip" "$base/made" && esp_project made-idf "$base/made/made/components/smear" "$file_flags" && project made-idf
    }
    claim "esp-idf's functions, by the component that smear convert writes" made_project
    claim "esp-idf: a switch that is off leaves code out" switched_off esp-idf libcomponent.a
    zephyr_project() {
        mkdir -p "$base/$1"
        cat >"$base/$1/CMakeLists.txt" <<END
cmake_minimum_required(VERSION 3.13)
project(program C)
set(CMAKE_C_STANDARD 11)
add_compile_options($board_flags)
macro(zephyr_library_named name)
    add_library(\${name} STATIC)
    set(zephyr_library \${name})
endmacro()
macro(zephyr_library_sources)
    target_sources(\${zephyr_library} PRIVATE \${ARGN})
endmacro()
macro(zephyr_library_compile_options)
    target_compile_options(\${zephyr_library} PRIVATE \${ARGN})
endmacro()
macro(zephyr_library_include_directories)
    target_include_directories(\${zephyr_library} PRIVATE \${ARGN})
endmacro()
macro(zephyr_include_directories)
    target_include_directories(\${zephyr_library} PUBLIC \${ARGN})
endmacro()
macro(zephyr_compile_definitions)
    target_compile_definitions(\${zephyr_library} PUBLIC \${ARGN})
endmacro()
set(CONFIG_SMEAR y)
$switches
include($2/zephyr/CMakeLists.txt)
add_executable(program main.c)
target_link_libraries(program smear)
END
    }
    zephyr_project zephyr "$dist/zephyr/smear"
    claim "zephyr's functions" project zephyr
    claim "zephyr: a switch that is off leaves code out" switched_off zephyr libsmear.a
    pico_project() {
        mkdir -p "$base/$1"
        cat >"$base/$1/CMakeLists.txt" <<END
cmake_minimum_required(VERSION 3.13)
project(program C)
set(CMAKE_C_STANDARD 11)
add_compile_options($board_flags)
set(PICO_SDK_VERSION_STRING 1.5.1)
add_subdirectory($2 smear)
add_executable(program main.c)
target_link_libraries(program smear)
END
    }
    pico_project pico-sdk "$dist/pico-sdk/smear"
    claim "pico-sdk's functions" project pico-sdk

    # The tree, as a clone of a branch of some repository: what installs from git gets that.
    git_tree() {
        rm -rf "$base/repository" "$base/clone" && cp -r "$made/tree" "$base/repository" && git -C "$base/repository" init -q &&
            git -C "$base/repository" checkout -q -b dist && git -C "$base/repository" add -A &&
            git -C "$base/repository" -c user.name=- -c user.email=- commit -q -m tree && git clone -q -b dist "file://$base/repository" "$base/clone"
    }
    if command -v git >/dev/null 2>&1; then
        claim "the tree in a repository" git_tree
        mkdir -p "$base/fetch-git"
        cat >"$base/fetch-git/CMakeLists.txt" <<END
cmake_minimum_required(VERSION 3.14)
project(program C)
include(FetchContent)
FetchContent_Declare(smear GIT_REPOSITORY file://$base/repository GIT_TAG dist)
FetchContent_MakeAvailable(smear)
add_executable(program main.c)
target_link_libraries(program smear::smear)
END
        claim "the tree by FetchContent, from git" project fetch-git
        for form in esp-idf zephyr pico-sdk; do
            case $form in
            esp-idf) esp_project tree-$form "$base/clone" ;;
            zephyr) zephyr_project tree-$form "$base/clone" ;;
            pico-sdk) pico_project tree-$form "$base/clone" ;;
            esac
            claim "the tree by $form's functions" project tree-$form
        done
    else
        echo "not run without git"
    fi
    # Examples of CMake's form, in a terminal, and those of the one file.
    terminal() { # EXAMPLE FOLDER
        # shellcheck disable=SC2086
        cmake -S "$2" -B "$base/terminal-$1" $debug && cmake --build "$base/terminal-$1" -j2 && "$base/terminal-$1/$1" 3 >"$base/$1.text" &&
            is_true "$(grep -ao '8;2;[0-9;]*m' "$base/$1.text" | sort -u | wc -l) > 20"
    }
    for example in cube fox; do
        claim "$example of cmake, in a terminal" terminal $example "$dist/cmake/smear/examples/$example"
    done
    # The real one, where it lies beside the repository or was unpacked for firmware.
    archive=${PICO_SDK_ARCHIVE:-../shared/third-party/pico-sdk-1.5.1.tar.xz}
    sdk=${PICO_SDK_PATH:-}
    [ -n "$sdk" ] || [ ! -f build/pico/sdk/unpacked ] || sdk=$PWD/build/pico/sdk
    if [ -z "$sdk" ] && [ -f "$archive" ]; then
        sdk=$base/sdk
        mkdir -p "$sdk" && tar -C "$sdk" --strip-components=1 -xJf "$archive"
        mkdir -p "$sdk/docs" && : >>"$sdk/docs/CMakeLists.txt"          # which the archive leaves out
    fi
    if [ -n "$sdk" ] && command -v arm-none-eabi-g++ >/dev/null 2>&1; then
        uf2() { # EXAMPLE FOLDER
            rm -rf "$base/uf2"
            cmake -S "$2/$1" -B "$base/uf2" -DPICO_SDK_PATH="$sdk" && cmake --build "$base/uf2" -j2 && [ -s "$base/uf2/$1.uf2" ]
        }
        claim "cube of pico-sdk, by pico-sdk" uf2 cube "$dist/pico-sdk/smear/examples"
        claim "fox of pico-sdk, by pico-sdk" uf2 fox "$dist/pico-sdk/smear/examples"
    else
        echo "not run without pico-sdk"
    fi
else
    echo "not run without cmake"
fi
finish
