#!/bin/sh
# SPDX-License-Identifier: MIT
# layers.sh LAYER... - checks that every file of src/ includes only headers of layers above its own (and its own), that
# every file is in the list, and that the public headers include nothing of src/.
set -u
failed=0
checked=0
seen=" smear_config "
for layer in "$@"; do
    for file in "src/$layer.h" "src/$layer.c"; do
        [ -f "$file" ] || continue
        checked=$((checked + 1))
        # A source sees its own header; the public headers are part of every layer.
        allowed="$seen$layer smear smear_model "
        for name in $(sed -n 's/^#include "\([a-z0-9_/]*\)\.h"$/\1/p' "$file"); do
            case "$allowed" in
            *" $name "*) ;;
            *)
                echo "layers: $file includes $name.h, which is not above it"
                failed=1
                ;;
            esac
        done
    done
    seen="$seen$layer "
done
for file in src/*.c src/*.h; do
    name=$(basename "$file" | sed 's/\.[ch]$//')
    case "$seen" in
    *" $name "*) ;;
    *)
        echo "layers: $file is in no layer"
        failed=1
        ;;
    esac
done
if grep -n '^#include "' include/*.h | grep -v -e 'smear_config.h"' -e 'smear.h"'; then
    echo "layers: a public header includes a private one"
    failed=1
fi
[ $failed -eq 0 ] && echo "layers: $checked files in order"
exit $failed
