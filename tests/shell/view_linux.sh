#!/bin/sh
# SPDX-License-Identifier: MIT
# view_linux.sh - `smear view` on framebuffers and displays of a real kernel, in QEMU: the picture on
# the screen is the frame, keys of the console arrive, and the console is as it was afterwards.
#
#     sh tests/shell/view_linux.sh build/smear WORK_FOLDER STATIC_SMEAR INIT MKCPIO
#
# The kernel is that of platform/linux/kernel.sh, in the work folder.
. "$(dirname "$0")/view_lib.sh"
package=$(sh platform/linux/kernel.sh "$(absolute "$2")") || exit 1
static=$(absolute "$3")
init=$(absolute "$4")
mkcpio=$(absolute "$5")
machine=
trap '[ -z "$machine" ] || kill $machine 2>/dev/null; rm -rf "$base"' EXIT
trap '' PIPE
cd "$base" || exit 1

kernel=$(ls "$package"/boot/vmlinuz-*)
modules=$(ls -d "$package"/lib/modules/*/kernel)

# boot NAME DISPLAY-OPTIONS KERNEL-OPTIONS MODULES: with ./commands; $log is the serial line; MODULE:PARAMETER
boot() {
    name=$1
    files=
    : >list
    for module in $4; do
        parameter=
        case $module in
        *:*) parameter=" ${module#*:}" module=${module%%:*} ;;
        esac
        files="$files $(find "$modules" -name "$module.ko")=modules/$module.ko"
        echo "$module.ko$parameter" >>list
    done
    # shellcheck disable=SC2086
    "$mkcpio" "$init=init" "$static=smear" commands=commands $files list=modules/list >initramfs || return 1
    log=$base/$name.log
    : >"$log"
    rm -f monitor
    mkfifo monitor
    # shellcheck disable=SC2086
    timeout 600 qemu-system-x86_64 -M pc -m 256 $2 -kernel "$kernel" -initrd initramfs \
        -append "console=ttyS0 quiet loglevel=3 vt.global_cursor_default=0 $3" \
        -display none -no-reboot -serial "file:$log" -monitor stdio <monitor >qemu.log 2>&1 &
    machine=$!
    exec 4>monitor
}
off() {
    echo quit >&4
    exec 4>&-
    wait "$machine"
    machine=
}
monitor() { echo "$*" >&4; }
logged() { tr -d '\r' <"$log" | grep -e "$1"; }
wait_log() { wait_for 240 logged "$1" || { tail -n 3 "$log"; return 1; }; }

# The screen is the picture of frame $1 in format $2, within a minute or two. QEMU widens 16 bits by
# repeating upper bits, we by rounding: a code more or less.
shows() {
    slack=0
    [ "$2" = rgb888 ] || slack=0.6
    "$smear" render $race --size "$size" --method none --frames "$1-$1" --format "$2" -o want.png || return 1
    wait_for 120 looks_right || { "$smear" compare want.png screen.ppm; return 1; }
}
looks_right() {
    monitor "screendump screen.ppm"
    sleep 0.5
    is_true "$("$smear" compare want.png screen.ppm | sed -n 's/^rmse=//p') <= $slack"
}
key() { monitor "sendkey $1"; }
# ends NUMBER STATUS: command NUMBER ended so, and left the console as it was
ends() {
    wait_log "^END $1 $2" || return 1
    wait_for 20 eval '[ "$(logged ^CONSOLE | wc -l)" -gt '"$1"' ]'
    equals "$(logged ^CONSOLE | sort -u)" "CONSOLE text cooked"
}
look="--method none --paused"

# ------------------------------------------------------------------ framebuffers of the firmware

size=640x480
cat >commands <<END
smear view --out fb $race --size $size $look
smear view $race --size $size $look
smear view --out drm $race
END
boot vesa24 "-vga std" vga=0x312 ""
claim "framebuffer, 24 bits: starts" wait_log "^RUN 0"
claim "the picture is the frame" shows 0 rgb888
claim "a key: a step" eval 'key dot && shows 1 rgb888'
claim "q ends it, the console is text again" eval 'key q && ends 0 0'
claim "it is found without being named" eval 'wait_log "^RUN 1" && shows 0 rgb888'
claim "Ctrl-C ends it" eval 'key ctrl-c && ends 1 0'
claim "no display card is told" eval 'wait_log "^END 2 1" && logged "smear: drm: /dev/dri/card0"'
off

cat >commands <<END
smear view --out fb $race --size $size --format rgb565 $look
@alone smear view --out fb $race --size $size --format rgb565 $look
@kill=15 smear view --out fb $race --size $size
@kill=11 smear view --out fb $race --size $size
@alone @kill=11 smear view --out fb $race --size $size
END
boot vesa16 "-vga std" vga=0x311 evdev
claim "framebuffer, 16 bits: starts" wait_log "^RUN 0"
claim "the picture is the frame" shows 0 rgb565
claim "q ends it, the console is text again" eval 'key q && ends 0 0'
claim "without a terminal: the picture is the frame" eval 'wait_log "^RUN 1" && shows 0 rgb565'
claim "keys come from input devices" eval 'key dot && shows 1 rgb565'
claim "so does q" eval 'key q && ends 1 0'
claim "SIGTERM leaves the console as it was" ends 2 0
claim "so does a crash" ends 3 -11
claim "without a terminal, too" ends 4 -11
off

# ------------------------------------------------------------------ display cards

size=1280x800
cat >commands <<END
smear view --out drm $race --size $size $look
smear view $race --size $size $look
smear view --out fb $race --size $size $look
smear view --out drm $race --frames 20 --size 160x100 --zoom 8 --method none --times
END
boot bochs "-vga std" "" "drm drm_kms_helper ttm drm_ttm_helper drm_vram_helper bochs"
claim "display card: starts" wait_log "^RUN 0"
claim "the picture is the frame" shows 0 rgb888
claim "a step flips to the other buffer" eval 'key dot && shows 1 rgb888'
claim "and back" eval 'key dot && shows 2 rgb888'
claim "q ends it, the console is text again" eval 'key q && ends 0 0'
claim "it is found without being named" eval 'wait_log "^RUN 1" && shows 0 rgb888 && key q && ends 1 0 &&
    logged /dev/dri || true'
claim "the card's framebuffer, 32 bits" eval 'wait_log "^RUN 2" && shows 0 rgb888 && key q && ends 2 0'
claim "runs by itself" ends 3 0
logged "^pictures" | sed 's/^/    /'
off

cat >commands <<END
smear view --out drm $race --size $size $look
END
boot virtio "-vga none -device virtio-gpu-pci" "" "virtio_ring virtio virtio_pci_modern_dev
    virtio_pci_legacy_dev virtio_pci virtio_dma_buf drm drm_kms_helper drm_shmem_helper virtio-gpu"
claim "a card that copies: starts" wait_log "^RUN 0"
claim "the picture is the frame" shows 0 rgb888
claim "a step" eval 'key dot && shows 1 rgb888'
off

finish
