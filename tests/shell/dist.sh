#!/bin/sh
# SPDX-License-Identifier: MIT
# dist.sh: the forms that `make dist` and `make install` wrote into build/dist and build/dist-install
# build, draw the example's picture, and state one version (the one file: dist_single.sh). What is not installed here (ESP-IDF, Zephyr, pico-sdk) is stood in for
# by its few CMake functions, so that lists of sources, folders and switches are tried all the same.
set -u
dist=$PWD/build/dist installed=$PWD/build/dist-install
. "$(dirname "$0")/lib.sh"
base=$PWD/build/dist-test
version=$(sh tools/dist/version.sh)
rm -rf "$base"
mkdir -p "$base"

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

# ---------------------------------------------------------------------- Arduino, PlatformIO

cat >"$base/sketch.cpp" <<END
#include "$dist/arduino/smear/examples/cube/cube.ino"
int main() { setup(); for (int i = 0; i < 40; i++) loop(); return bytes_seen == 40u * 128 * 64 * 2 ? 0 : 1; }
END
sketch() {
    ${CC:-cc} -std=gnu11 -O1 -c -I"$dist/arduino/smear/src" -o "$base/arduino.o" "$dist"/arduino/smear/src/*.c &&
        ${CXX:-c++} -std=gnu++11 -Wall -Wextra -Werror -I"$dist/arduino/smear/src" -o "$base/sketch" "$base/sketch.cpp" "$base/arduino.o" &&
        "$base/sketch"
}
claim "sketch of arduino" sketch

example() {
    # shellcheck disable=SC2046
    ${CC:-cc} -std=gnu11 -O1 -I"$dist/platformio/smear/include" -I"$dist/platformio/smear/src" -o "$base/example" \
        $(find "$dist/platformio/smear/src" -name '*.c') "$dist/platformio/smear/examples/cube/main.c" && "$base/example" >"$base/example.ppm"
}
claim "example of platformio" example

# ---------------------------------------------------------------------- installed

if command -v pkg-config >/dev/null 2>&1; then
    installed_example() {
        flags=$(PKG_CONFIG_PATH="$installed/usr/lib/pkgconfig" pkg-config --define-variable=prefix="$installed/usr" --cflags --libs smear) &&
            # shellcheck disable=SC2086
            ${CC:-cc} -std=gnu11 -o "$base/pc" "$dist/platformio/smear/examples/cube/main.c" $flags && "$base/pc" >"$base/pc.ppm" &&
            cmp "$base/pc.ppm" "$base/example.ppm"
    }
    claim "program by pkg-config" installed_example
else
    echo "not run without pkg-config"
fi

# ---------------------------------------------------------------------- CMake, and what is built on it

if command -v cmake >/dev/null 2>&1; then
    # project NAME: configures and builds out/NAME, whose program draws the example's picture
    project() {
        cp "$dist/platformio/smear/examples/cube/main.c" "$base/$1/main.c"
        cmake -S "$base/$1" -B "$base/$1/build" -DCMAKE_PREFIX_PATH="$base/prefix" && cmake --build "$base/$1/build" -j2 &&
            "$base/$1/build/program" >"$base/$1/picture.ppm" && cmp "$base/$1/picture.ppm" "$base/example.ppm"
    }
    mkdir -p "$base/subdirectory" "$base/package" "$base/esp-idf" "$base/zephyr" "$base/pico-sdk"
    cat >"$base/subdirectory/CMakeLists.txt" <<END
cmake_minimum_required(VERSION 3.13)
project(program C)
add_subdirectory($dist/cmake/smear smear)
add_executable(program main.c)
target_link_libraries(program smear::smear)
END
    claim "cmake: add_subdirectory" project subdirectory
    package() {
        cmake -S "$dist/cmake/smear" -B "$base/cmake" -DCMAKE_INSTALL_PREFIX="$base/prefix" && cmake --build "$base/cmake" -j2 &&
            cmake --install "$base/cmake" && project package
    }
    cat >"$base/package/CMakeLists.txt" <<END
cmake_minimum_required(VERSION 3.13)
project(program C)
find_package(smear $version EXACT REQUIRED)
add_executable(program main.c)
target_link_libraries(program smear::smear)
END
    claim "cmake: find_package" package

    switches=$(sed -n 's/^config \(SMEAR_WITH_[A-Z0-9_]*\)$/set(CONFIG_\1 y)/p' "$dist/esp-idf/smear/Kconfig" | grep -v _MODEL)
    cat >"$base/esp-idf/CMakeLists.txt" <<END
cmake_minimum_required(VERSION 3.13)
project(program C)
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
    claim "esp-idf: a switch that is off leaves code out" sh -c "! nm '$base/esp-idf/build/libcomponent.a' | grep -q smear_actor_init"
    cat >"$base/zephyr/CMakeLists.txt" <<END
cmake_minimum_required(VERSION 3.13)
project(program C)
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
    cat >"$base/pico-sdk/CMakeLists.txt" <<END
cmake_minimum_required(VERSION 3.13)
project(program C)
add_subdirectory($dist/pico-sdk/smear smear)
add_executable(program main.c)
target_link_libraries(program smear)
END
    claim "pico-sdk" project pico-sdk
else
    echo "not run without cmake"
fi
finish
