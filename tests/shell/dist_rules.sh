#!/bin/sh
# SPDX-License-Identifier: MIT
# dist_rules.sh [DIST]: the packages of Arduino and ESP-IDF that `make dist` wrote are those whose manifests were held against their
# registries' rules: of arduino-lint, at its level "strict", and of ESP-IDF's component manager. Their texts have sums here, but for
# versions, addresses and paths, which are looked at: who changes a text has it checked by those programs, then writes down its sum.
set -u
dist=$PWD/${1:-build/dist}
. "$(dirname "$0")/lib.sh"
in_passing dist-rules

arduino_sum='1418504670 509' idf_sum='2340512494 295' examples_sum='3961446020 375'
number='[0-9][0-9]*\.[0-9][0-9]*\.[0-9][0-9]*'
address='https\{0,1\}://[^ /]*\.[^ ]*'

# rule TEXT COMMAND...: says the text of a rule that is broken
rule() {
    rule_text=$1
    shift
    "$@" >/dev/null 2>&1 || { echo "$rule_text"; broken=yes; }
}
none() { ! "$@" | grep .; }
has_sum() { equals "$(cksum)" "$1"; }
is_component() { [ -f "$1/CMakeLists.txt" ]; }

# arduino FOLDER ENTRIES: the layout of a library, and its properties
arduino() (
    cd "$1" || exit
    broken=
    rule "another text than was checked" eval "sed 's|^version=$number$|version|; s|^url=$address$|url|; s|^includes=smear\.h.*|includes|' library.properties | has_sum '$arduino_sum'"
    rule "a name that is not allowed" eval 'echo "${PWD##*/}" | grep -qE "^[A-Za-z0-9_][A-Za-z0-9_.-]{0,62}$"'
    rule "other files than those of a library" none sh -c "ls -A | grep -vxE '$2'"
    for entry in README.md LICENSE src/smear.h $(sed -n 's/^includes=//p' library.properties | sed 's|^|src/|; s|,| src/|g'); do
        rule "no $entry" [ -s "$entry" ]
    done
    rule "links, programs, or sketches of an old kind" none find . -type l -o -name '*.exe' -o -name '*.pde' -o -path './?*/library.properties'
    rule "arduino.h" none grep -riE '#[ ]*include *[<"](a|A[R-Z])rduino\.h' src examples --include='*.h*' --include='*.ino' --exclude-dir=.git
    rule "no sketch" eval 'find examples -name "*.ino" | grep .'
    rule "sketches of another name than their folder" none sh -c "find . -name '*.ino' | grep -vE '^\./examples/.*/?([^/]*)/\1\.ino$'"
    for sketch in $(find . -name '*.ino'); do
        rule "names in ${sketch%/*}" none sh -c "ls -A '${sketch%/*}' | grep -vE '^[A-Za-z0-9_][A-Za-z0-9_.-]{0,66}$|^src$' || ls -A '${sketch%/*}' | grep -x SRC"
    done
    [ -z "$broken" ]
)

# idf FOLDER: a component, and the projects that its manifest names
idf() (
    cd "$1" || exit
    broken=
    rule "another text than was checked" eval "sed 's|^version: \"$number\"$|version|; s|: \"$address\"|: address|; s|path: .*/|path: |' idf_component.yml |
        has_sum '$idf_sum'"
    rule "no README.md or LICENSE" [ -s README.md -a -s LICENSE ]
    rule "no component" grep -q idf_component_register CMakeLists.txt
    for path in $(sed -n 's/^ *- path: //p' idf_component.yml); do
        rule "no project at $path" [ -f "$path/CMakeLists.txt" -a -f "$path/main/CMakeLists.txt" ]
    done
    rule "another text of examples" eval "find . -path './?*/idf_component.yml' | sort | xargs sed 's|override_path: .*|override_path|' | has_sum '$examples_sum'"
    for manifest in $(find . -path './?*/idf_component.yml'); do
        rule "no component for $manifest" is_component "${manifest%/*}/$(sed -n 's/^ *override_path: "\(.*\)"$/\1/p' "$manifest")"
    done
    [ -z "$broken" ]
)

library='README.md|LICENSE|library.properties|src|examples'
claim "Arduino's rules: its package" arduino "$dist/arduino/smear" "$library"
claim "the tree" arduino "$dist/tree" "$library|CMakeLists.txt|Kconfig|idf_component.yml|library.json|samples|zephyr"
for form in esp-idf/smear tree; do
    claim "the component manager's rules: $form" idf "$dist/$form"
done

# Each kind of rule can be broken: a copy is spoiled in one way, and that is what is said.
breaks() { # FORM TEXT COMMAND
    rm -rf "$base/smear" && cp -r "$dist/$1/smear" "$base/smear" && (cd "$base/smear" && eval "$3") || return 1
    case $1 in arduino) arduino "$base/smear" "$library" ;; *) idf "$base/smear" ;; esac >"$base/found" && { echo "nothing is found"; return 1; }
    has "$base/found" "^$2"
}
spoilt() { claim "can be broken: $*" breaks "$@"; }
spoilt arduino "another text" "sed -i 's/^version=.*/version=1.0/' library.properties"
spoilt arduino "other files" "mkdir extra"
spoilt arduino "no src/smear_math.h" "rm src/smear_math.h"
spoilt arduino links "ln -s smear.h src/other.h"
spoilt arduino arduino.h "echo '#include <arduino.h>' >>src/smear.h"
spoilt arduino sketches "mv examples/cube/cube.ino examples/cube/square.ino"
spoilt arduino names "mv examples/cube/cube.h 'examples/cube/a cube.h'"
spoilt esp-idf "another text than" "sed -i 's|^url:.*|url: \"somewhere\"|' idf_component.yml"
spoilt esp-idf "another text of" "sed -i 's/version:/versions:/' examples/cube/main/idf_component.yml"
spoilt esp-idf "no component for" "sed -i 's|override_path:.*|override_path: \"..\"|' examples/cube/main/idf_component.yml; rm -f examples/cube/CMakeLists.txt"
spoilt esp-idf "no project" "rm -r examples/fox"

finish
