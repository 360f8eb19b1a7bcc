#!/bin/sh
# SPDX-License-Identifier: MIT
# boot.sh PROGRAM FRAME OUT.ppm SCREEN
# Boots Linux in QEMU with the demo as its only process, shows frame FRAME and takes a screenshot.
# SCREEN: fbdev (framebuffer device, 640x480, 24 bits), bochs or virtio (DRM). The kernel is that
# of kernel.sh, in KERNEL [build/kernel].
set -u
program=$1 frame=$2 shot=$3 screen=$4
log=$shot.log archive=$shot.cpio list=$shot.list
vga= card="-vga std" modules= out=drm
case $screen in
fbdev)
    vga=vga=0x312
    out=fb
    ;;
bochs) modules="drm drm_kms_helper ttm drm_ttm_helper drm_vram_helper bochs" ;;
virtio)
    modules="virtio_ring virtio virtio_pci_modern_dev virtio_pci_legacy_dev virtio_pci
        virtio_dma_buf drm drm_kms_helper drm_shmem_helper virtio-gpu"
    card="-vga none -device virtio-gpu-pci"
    ;;
*)
    echo "boot.sh: $screen: no such screen" >&2
    exit 2
    ;;
esac

package=$(sh platform/linux/kernel.sh "${KERNEL:-build/kernel}") || exit 1
kernel=$(ls "$package"/boot/vmlinuz-*)

rm -f "$shot" "$log" "$list"
files=$program=init
for module in $modules; do
    files="$files $(find "$package/lib/modules" -name "$module.ko")=modules/$module.ko"
    echo "$module.ko" >>"$list"
done
[ -z "$modules" ] || files="$files $list=modules/list"
# shellcheck disable=SC2086
build/linux/mkcpio $files >"$archive" || exit 1

wait_for() {
    tries=0
    while ! "$@" 2>/dev/null && [ $tries -lt 1200 ]; do
        sleep 0.1
        tries=$((tries + 1))
    done
}
# QEMU's screen follows the guest's a little later.
{
    wait_for grep -q shown "$log"
    sleep 1
    echo "screendump $shot"
    wait_for test -s "$shot"
    echo quit
} | timeout 180 qemu-system-x86_64 -M pc -m 128 $card -kernel "$kernel" -initrd "$archive" \
    -append "console=ttyS0 quiet loglevel=3 vt.global_cursor_default=0 $vga SMEAR_OUT=$out -- show linux $frame" \
    -display none -no-reboot -serial "file:$log" -monitor stdio >/dev/null 2>&1
rm -f "$archive" "$list"
if [ ! -s "$shot" ]; then
    echo "boot.sh: $screen: no screenshot of frame $frame" >&2
    cat "$log" >&2
    exit 1
fi
