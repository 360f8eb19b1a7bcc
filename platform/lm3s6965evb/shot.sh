#!/bin/sh
# SPDX-License-Identifier: MIT
# shot.sh PROGRAM.elf FRAME OUT.ppm [KEY]
# Shows frame FRAME of the demo on the emulated panel and takes a screenshot, every pixel 4x4.
# KEY, as QEMU's monitor calls it, is pressed before that: `ctrl` is the select button. QEMU gives the
# board's keys no level before their first event, so it is pressed twice.
set -u
program=$1 frame=$2 shot=$3 key=${4:-}
log=$shot.log
rm -f "$shot" "$log"
has_shown() {
    [ "$(grep -c shown "$log")" -ge "$1" ]
}
wait_for() {
    tries=0
    while ! "$@" 2>/dev/null && [ $tries -lt 300 ]; do
        sleep 0.1
        tries=$((tries + 1))
    done
}
{
    echo cont
    wait_for has_shown 1
    if [ -n "$key" ]; then
        for press in 1 2; do
            echo "sendkey $key 200"
            sleep 0.5
        done
        wait_for has_shown 2
    fi
    echo "screendump $shot"
    wait_for test -s "$shot"
    echo quit
} | timeout 90 qemu-system-arm -M lm3s6965evb -S -display none -serial none -monitor stdio \
    -chardev file,id=out,path="$log" \
    -semihosting-config "enable=on,target=native,chardev=out,arg=demo,arg=show,arg=oled,arg=$frame" \
    -kernel "$program" >/dev/null 2>&1
if [ ! -s "$shot" ]; then
    echo "shot.sh: $program: no screenshot of frame $frame" >&2
    cat "$log" >&2
    exit 1
fi
