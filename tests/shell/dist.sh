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
file_flags="-O1 -Wall -Wextra -Werror"
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
claim "no other version is stated" sh -c "! grep -rnE 'VERSION [0-9]|ersion[\": =]+[0-9]+\\.[0-9]+\\.[0-9]' '$dist' \
    --include=CMakeLists.txt --include=*.json --include=*.properties --include=*.yml | grep -vF '$version' | grep -v cmake_minimum | grep ."

# ---------------------------------------------------------------------- manifests

# What Arduino's library specification asks of library.properties (1.5 format, rev. 2.2).
claim "library.properties" sh -c "cd '$dist/arduino/smear' && python3 - <<'END'
import os, re
fields = dict(line.rstrip('\n').split('=', 1) for line in open('library.properties'))
known = 'name version author maintainer sentence paragraph category url architectures depends dot_a_linkage includes precompiled ldflags'.split()
assert set(fields) <= set(known), set(fields) - set(known)
for field in known[:9]:
    assert fields[field], field
assert re.fullmatch(r'[A-Za-z0-9][A-Za-z0-9_.\- ]{0,62}', fields['name'])
assert re.fullmatch(r'\d+\.\d+\.\d+', fields['version'])
assert fields['category'] in ['Display', 'Communication', 'Signal Input/Output', 'Sensors', 'Device Control', 'Timing', 'Data Storage',
    'Data Processing', 'Other']
assert fields['url'].startswith('https://') and 'avr' not in fields['architectures'] and '*' not in fields['architectures']
assert all(os.path.isfile('src/' + name) for name in fields['includes'].split(','))
assert all(os.path.isfile('examples/%s/%s.ino' % (name, name)) for name in os.listdir('examples'))
END"
# PlatformIO's schema of library.json: fields, types, lengths.
claim "library.json" sh -c "cd '$dist/platformio/smear' && python3 - <<'END'
import json, os, re
m = json.load(open('library.json'))
known = '\$schema name version description keywords homepage repository authors license frameworks platforms headers examples build'.split()
assert set(m) == set(known), set(m) ^ set(known)
assert re.fullmatch(r'[a-z0-9-]{1,50}', m['name']) and len(m['version']) <= 20 and len(m['description']) <= 255
assert set(m['repository']) <= {'type', 'url', 'branch'} and m['repository']['type'] in ('git', 'hg', 'svn')
assert all(set(a) <= {'name', 'email', 'url', 'maintainer'} and len(a['name']) <= 50 for a in m['authors'])
assert all(os.path.isfile('include/' + name) for name in m['headers'])
assert all(os.path.isfile(e['base'] + '/' + name) for e in m['examples'] for name in e['files'])
assert os.path.isdir(m['build']['srcDir']) and os.path.isdir(m['build']['includeDir'])
END"
# Fields that the component manager knows in idf_component.yml, and what a registry demands.
idf_manifest() {
    file=$dist/esp-idf/smear/idf_component.yml
    sed -n 's/^\([a-z_]*\):.*/\1/p' "$file" | while read -r field; do
        case $field in
        version | description | url | repository | license | tags | targets | examples | dependencies) ;;
        *) echo "$field is no field of a manifest"; return 1 ;;
        esac
    done && has "$file" '^url: "https://' && has "$file" '^license: MIT$' && has "$file" '^targets: \[esp32, [esp0-9a-z, ]*\]$' &&
        exists "$dist/esp-idf/smear/README.md" && exists "$dist/esp-idf/smear/examples/cube/main/main.c"
}
claim "idf_component.yml" idf_manifest

# ---------------------------------------------------------------------- Arduino, PlatformIO

# The picture that the cube makes on a panel in 12 frames (tests/shell/flush.sh).
mkdir -p "$base/plain"
cp tests/examples/stand_ins/plain.h "$base/plain/display.h"
plain_panel() {
    # shellcheck disable=SC2086
    sh tests/shell/launch_cached.sh ${CC:-cc} -std=gnu11 $file_flags -I"$dist/single/smear" -o "$base/plain/smear.o" -c \
        "$dist/single/smear/smear.c" &&
        ${CC:-cc} -std=c11 $file_flags -I"$dist/single/smear" -I"$base/plain" -I"$stand_ins" -Iplatform/examples \
            -o "$base/plain/program" tests/examples/flush.c "$base/plain/smear.o" && "$base/plain/program" >"$base/plain/panel"
}
claim "one file, on a panel" plain_panel
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
cat >"$board/cores/here/Arduino.h" <<END
#include <stdint.h>
struct stand_in_serial { void begin(long) {} void println(const char *) {} };
extern stand_in_serial Serial;
void setup();
void loop();
END
cat >"$board/cores/here/main.cpp" <<END
#include "Arduino.h"
stand_in_serial Serial;
int main() { setup(); for (int i = 0; i < 12; i++) loop(); }
END
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
cp -r "$dist/arduino/smear" "$base/arduino-libraries/"
sketch() { # EXAMPLE
    arduino-builder -compile -quiet -hardware "$base/hardware" -hardware /usr/share/arduino-builder -tools "$base/no-tools" -libraries "$base/arduino-libraries" \
        -fqbn tests:here:here -build-path "$base/arduino-build" "$dist/arduino/smear/examples/$1/$1.ino" &&
        "$base/arduino-build/$1.ino.elf" >"$base/$1.panel"
}
if command -v arduino-builder >/dev/null 2>&1 && command -v arduino-ctags >/dev/null 2>&1; then
    for example in TFT_eSPI LovyanGFX Adafruit_GFX Arduino_GFX U8g2; do
        claim "sketch for $example by arduino-builder" sketch $example
        [ $example = U8g2 ] || claim "its panel" same "$base/plain/panel" "$base/$example.panel"
    done
else
    echo "not run without arduino-builder and arduino-ctags"
fi

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
claim "arduino example of platformio" ${CXX:-c++} -std=gnu++11 -Wall -Wextra -Werror -fsyntax-only -I"$dist/platformio/smear/include" \
    -I"$board/cores/here" -I"$stand_ins" "$dist/platformio/smear/examples/arduino/src/main.cpp"
claim "example of esp-idf" ${CC:-cc} -std=gnu11 -Wall -Wextra -Werror -fsyntax-only -I"$dist/esp-idf/smear/include" -I"$stand_ins" \
    "$dist/esp-idf/smear/examples/cube/main/main.c"
claim "sample of zephyr" ${CC:-cc} -std=gnu11 -Wall -Wextra -Werror -fsyntax-only -I"$dist/zephyr/smear/include" -I"$stand_ins" \
    "$dist/zephyr/smear/samples/cube/src/main.c"

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
    # is enough here.
    debug="-DCMAKE_BUILD_TYPE=Debug -DCMAKE_C_FLAGS_DEBUG=-O0"
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
    cat >"$base/esp-idf/CMakeLists.txt" <<END
cmake_minimum_required(VERSION 3.13)
project(program C)
set(CMAKE_C_STANDARD 11)
add_compile_options($board_flags)
function(idf_component_register)
    cmake_parse_arguments(c "" "" "SRCS;INCLUDE_DIRS;PRIV_INCLUDE_DIRS" \${ARGN})
    list(TRANSFORM c_SRCS PREPEND $dist/esp-idf/smear/)
    list(TRANSFORM c_INCLUDE_DIRS PREPEND $dist/esp-idf/smear/)
    list(TRANSFORM c_PRIV_INCLUDE_DIRS PREPEND $dist/esp-idf/smear/)
    add_library(component STATIC \${c_SRCS})
    target_include_directories(component PUBLIC \${c_INCLUDE_DIRS} PRIVATE \${c_PRIV_INCLUDE_DIRS})
    set(COMPONENT_LIB component PARENT_SCOPE)
endfunction()
$switches
include($dist/esp-idf/smear/CMakeLists.txt)
add_executable(program main.c)
target_link_libraries(program component)
END
    claim "esp-idf's functions" project esp-idf
    claim "esp-idf: a switch that is off leaves code out" switched_off esp-idf libcomponent.a
    cat >"$base/zephyr/CMakeLists.txt" <<END
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
include($dist/zephyr/smear/zephyr/CMakeLists.txt)
add_executable(program main.c)
target_link_libraries(program smear)
END
    claim "zephyr's functions" project zephyr
    claim "zephyr: a switch that is off leaves code out" switched_off zephyr libsmear.a
    cat >"$base/pico-sdk/CMakeLists.txt" <<END
cmake_minimum_required(VERSION 3.13)
project(program C)
set(CMAKE_C_STANDARD 11)
add_compile_options($board_flags)
add_subdirectory($dist/pico-sdk/smear smear)
add_executable(program main.c)
target_link_libraries(program smear)
END
    claim "pico-sdk's functions" project pico-sdk
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
        cube_uf2() {
            cmake -S "$dist/pico-sdk/smear/examples/cube" -B "$base/cube" -DPICO_SDK_PATH="$sdk" && cmake --build "$base/cube" -j2 &&
                [ -s "$base/cube/cube.uf2" ]
        }
        claim "example of pico-sdk, by pico-sdk" cube_uf2
    else
        echo "not run without pico-sdk"
    fi
else
    echo "not run without cmake"
fi
finish
