#!/bin/sh
# SPDX-License-Identifier: MIT
# dist_rules.sh [DIST]: the packages that `make dist` wrote keep their registries' rules (tools/dist/rules.py), and each of these
# rules can be broken: a copy is spoiled in one way, and that is what is found.
set -u
dist=$PWD/${1:-build/dist}
. "$(dirname "$0")/lib.sh"
in_passing dist-rules
rules() { python3 "$here/tools/dist/rules.py" "$@"; }

for form in arduino/smear tree; do
    claim "Arduino's rules: $form" rules arduino "$dist/$form"
done
for form in esp-idf/smear tree; do
    claim "the component manager's rules: $form" rules idf "$dist/$form"
done

# What rules look at, small: texts of the package itself.
copy() { # KIND
    rm -rf "$base/smear"
    mkdir -p "$base/smear" && cd "$base/smear" || return 1
    if [ "$1" = arduino ]; then
        (cd "$dist/arduino/smear" && cp -r README.md LICENSE library.properties "$base/smear" && mkdir -p "$base/smear/src" &&
            cp src/*.h "$base/smear/src" && mkdir "$base/smear/examples" && cp -r examples/cube "$base/smear/examples")
    else
        (cd "$dist/esp-idf/smear" && cp -r README.md LICENSE CMakeLists.txt idf_component.yml "$base/smear" && mkdir "$base/smear/examples" &&
            cp -r examples/cube examples/fox examples/board "$base/smear/examples" && rm "$base/smear/examples/"*/main/model.h)
    fi
}
# breaks KIND RULE COMMAND...: in a copy, that command; then that rule is broken
breaks() {
    kind=$1 rule=$2
    shift 2
    copy "$kind" && eval "$*" || return 1
    cd "$here" || return 1
    if rules "$kind" "$base/smear" >"$base/found" 2>"$base/said"; then
        echo "nothing is found"
        return 1
    fi
    [ ! -s "$base/said" ] && grep -qF "smear: $rule: " "$base/found" || { cat "$base/found" "$base/said"; return 1; }
}
whole() { copy "$1" && cd "$here" && rules "$1" "$base/smear"; }
claim "the copy of arduino is whole" whole arduino
claim "the copy of esp-idf is whole" whole idf

arduino() { rule=$1; shift; claim "arduino $rule can be broken: $*" breaks arduino "$rule" "$@"; }
field() { arduino "$1" "sed -i 's|^$2=.*|$2=$3|' library.properties"; }
no_field() { arduino "$1" "sed -i '/^$2=/d' library.properties"; }
new_field() { arduino "$1" "echo '$2' >>library.properties"; }
arduino LS001 'rm src/*.h src/*.hpp 2>/dev/null; true'
arduino LS004 ': >.gitmodules'
arduino LS005 'ln -s smear.h src/other.h'
arduino LS006 ': >.development'
arduino LS007 ': >src/tool.exe'
arduino LS008 'mv src/smear.h src/blur.h; rm -f src/smear.hpp'
arduino LS009 'mv src Src'
arduino LS010 'mkdir utility'
arduino LS011 'mkdir extra'
arduino LS012 'mkdir Extras'
arduino LP001 'rm library.properties'
arduino LP002 'cp library.properties library.property'
arduino LP003 'mv library.properties Library.properties'
arduino LP004 'cp library.properties src'
new_field LP005 'a line'
new_field LP006 'architecture=avr'
no_field LP007 name
field LP008 name ''
field LP009 name "$(printf 'smear%.0s' 1 2 3 4 5 6 7 8 9 10 11 12 13)"
field LP010 name 'smearsmearsmearsmear'
field LP011 name 'smear!'
field LP012 name 'Arduino_smear'
field LP014 name 'smear_arduino'
field LP015 name 'smear 3D'
field LP016 name 'smearlibrary'
no_field LP019 version
field LP020 version ''
field LP021 version '1.0'
no_field LP023 author
field LP024 author ''
no_field LP025 maintainer
field LP026 maintainer ''
field LP027 maintainer 'Arduino people'
field LP057 maintainer 'the Arduino people'
new_field LP028 'email=a@b.c'
no_field LP031 sentence
field LP032 sentence ''
field LP033 sentence 'Pictures wich move.'
no_field LP034 paragraph
field LP035 paragraph 'You recieve rows.'
arduino LP036 "sed -i 's/^paragraph=/&Motion-blurred 3D on machines without a GPU. /' library.properties"
no_field LP037 category
field LP038 category Graphics
field LP039 category Uncategorized
no_field LP040 url
field LP056 url ''
field LP041 url 'example'
no_field LP043 architectures
field LP044 architectures ''
field LP045 architectures mbed
field LP046 architectures ESP32
new_field LP047 'depends=,,'
new_field LP058 'depends=LovyanGFX (about 1)'
new_field LP049 'dot_a_linkage=yes'
field LP051 includes ''
field LP052 includes 'smear3.h'
new_field LP053 'precompiled=perhaps'
new_field LP055 'ldflags='
arduino LC001 'echo "#include <arduino.h>" >>src/smear.h'
arduino LD001 'rm README.md'
arduino LD002 'rm LICENSE'
arduino LD003 'cp -r examples/cube src/cube'
arduino LD004 'rm examples/*/*.ino'
arduino LD005 'mv examples example'
arduino LD006 'mv examples Examples'
arduino SS001 'mv examples/cube/cube.ino examples/cube/square.ino'
arduino SS002 'mv examples/cube/cube.h "examples/cube/a cube.h"'
arduino SS003 ': >examples/cube/$(printf "cube%.0s" 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18).h'
arduino SS004 'mv examples/cube/cube.ino examples/cube/cube.pde'
arduino SS005 'mkdir examples/cube/SRC'
arduino SC001 'echo "#include \"arduino.h\"" >>examples/cube/cube.h'
named() { copy arduino && mv "$base/smear" "$base/$2" && cd "$here" && ! rules arduino "$base/$2" >"$base/found" && grep -qF "$1: " "$base/found"; }
claim "arduino LS002 can be broken" named LS002 "$(printf 'smear%.0s' 1 2 3 4 5 6 7 8 9 10 11 12 13)"
claim "arduino LS003 can be broken" named LS003 'smear 3'

idf() { rule=$1; shift; claim "idf $rule can be broken: $*" breaks idf "$rule" "$@"; }
key() { idf "$1" "sed -i 's|^$2:.*|$2: $3|' idf_component.yml"; }
no_key() { idf "$1" "sed -i '/^$2:/d' idf_component.yml"; }
new_key() { idf "$1" "echo '$2' >>idf_component.yml"; }
idf README 'rm README.md'
idf README ': >README.md'
idf CMakeLists.txt ': >CMakeLists.txt'
idf manifest 'rm idf_component.yml'
idf YAML 'echo "a line" >>idf_component.yml'
new_key field 'homepage: "https://a.b"'
no_key version version
key version version '"1.0"'
no_key description description
key license license '"my own"'
idf 'license file' 'rm LICENSE'
new_key targets 'targets: [esp32]'
key tag tags '[graphics, 3d]'
key tags tags '[graphics, graphics]'
new_key maintainers 'maintainers: me'
no_key url url
key address url '"somewhere"'
key repository repository '"somewhere"'
idf repository_info 'sed -i "/^repository:/d" idf_component.yml; printf "repository_info:\n  path: .\n" >>idf_component.yml'
idf files 'printf "files:\n  leave: []\n" >>idf_component.yml'
idf dependencies 'sed -i "/^dependencies:/,\$d" idf_component.yml; echo "dependencies: idf" >>idf_component.yml'
new_key 'dependency name' '  smear__it: "*"'
idf 'dependency field' 'sed -i "s/version:/versions:/" examples/cube/main/idf_component.yml'
new_key 'dependency version' '  other: "newest"'
idf override_path 'sed -i "s|override_path:.*|override_path: \"..\"|" examples/cube/main/idf_component.yml; rm -f examples/cube/CMakeLists.txt'
idf examples 'sed -i "s/- path:/- at:/" idf_component.yml'
idf example 'rm -r examples/fox'
finish
