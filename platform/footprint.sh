#!/bin/sh
# SPDX-License-Identifier: MIT
# footprint.sh [TARGET:OPTIMIZATION...]
# What the library takes, as linked into the demo (all methods and formats, but no model module):
#
#   code, tables   bytes of flash of src/, without meshes and program
#   helpers        what the compiler adds: wide products, division
#   data           bytes of RAM it keeps for itself: none
#   SCREEN         bytes of memory it wants from the program (smear_memory_size) for screens of the demo
#   stack          worst of smear_render by the compiler's call graph, callbacks not counted
#   used           what the demo used of its stack, all in all; where programs can measure it. With more
#                  than `stack` and SLACK bytes of program and callbacks the script fails
set -u
[ $# -gt 0 ] || set -- cortex-m0plus:-O2 cortex-m0plus:-Os cortex-m3:-O2 cortex-m3:-Os \
    cortex-m33:-O2 cortex-m33:-Os gba:-O2 rv32imc:-O2 rv32imc:-Os
make=${MAKE:-make}
SLACK=1100
status=0
printf '%-14s %-4s %7s %7s %8s %5s %7s %7s %7s %7s %6s\n' target "" code tables helpers data oled gba \
    pico stack used
for pair in "$@"; do
    target=${pair%:*} optimization=${pair#*:}
    build=build/footprint/$target$optimization
    # With CALLS=1 the target's own build has call graphs.
    [ "${CALLS:-}" != 1 ] || [ "$optimization" != -O2 ] || build=build/$target
    log=$build.log
    mkdir -p "$build"
    $make --no-print-directory -s TARGET="$target" BUILD="$build" CALLS=1 OPT="$optimization" "$build/demo.elf" >"$log" 2>&1 ||
        { tail -5 "$log"; exit 1; }
    [ ! -e "platform/$target/gbarun.c" ] || $make --no-print-directory -s TARGET="$target" build/gba/gbarun
    run=$($make --no-print-directory -s TARGET="$target" print-run)
    # In the map: address, size and object of every section that was kept.
    sizes=$(awk '
        function number(hex,    i, value) {
            for (i = 3; i <= length(hex); i++)
                value = value * 16 + index("0123456789abcdef", substr(hex, i, 1)) - 1
            return value
        }
        /^Linker script and memory map/ { on = 1 }
        on && $1 ~ /^\.[a-z]/ { section = $1; if (NF >= 4) { address = $2; size = $3; object = $4 } }
        on && NF >= 3 && $1 ~ /^0x/ && $2 ~ /^0x/ { address = $1; size = $2; object = $3 }
        on && object != "" {
            if (object ~ /libsmear\.a/ && section !~ /debug|comment|attributes|exidx|note/ && number(address) > 0) {
                if (object ~ /tables\.o/) tables += number(size)
                else if (section ~ /^\.(data|bss|sdata|sbss)/) data += number(size)
                else code += number(size)
            }
            if (object ~ /libgcc\.a|arithmetic\.o/ && section ~ /^\.(text|fast|rodata)/) helpers += number(size)
            object = ""
        }
        END { printf "%d %d %d %d", code, tables, helpers, data }' "$build/demo.map")
    memory=$($run "$build/demo.elf" memory | awk '{ bytes[$1] = $2 }
        END { print bytes["oled"], bytes["gba"], bytes["pico"] }')
    stack=$(awk -f platform/stack.awk "$build"/src/*.ci "$build"/src/*/*.ci) || status=1
    worst=$(echo "$stack" | awk '$2 == "smear_render" { print $1 }')
    [ -n "$worst" ] || { echo "$stack"; status=1; worst=0; }
    used=$($run "$build/demo.elf" check oled 6 stack | sed -n 's/^stack //p')
    # shellcheck disable=SC2086
    printf '%-14s %-4s %7d %7d %8d %5d %7d %7d %7d %7d %6d\n' "$target" "$optimization" $sizes $memory \
        "$worst" "${used:-0}"
    if [ "${used:-0}" -gt $((worst + SLACK)) ]; then
        echo "footprint.sh: $target uses more stack than the call graph knows of"
        status=1
    fi
done
exit $status
