#!/bin/sh
# SPDX-License-Identifier: MIT
# view_x11.sh - `smear view` in a window, under Xvfb: the picture on the screen is the frame, by shared
# memory and without, at 24 and 16 bits; keys, pointer, sizes and close requests arrive; a server that
# refuses or goes is told in one line.
#
#     sh tests/shell/view_x11.sh build/smear build/host/view_x11_user
. "$(dirname "$0")/view_lib.sh"
user=$(absolute "$2")
servers=
trap 'kill $servers 2>/dev/null; rm -rf "$base"' EXIT
cd "$base" || exit 1

# server NAME OPTIONS...: starts one; $DISPLAY is its display, $server its process
server() {
    name=$1
    shift
    mkfifo "$base/$name.fifo"
    "$@" -displayfd 3 -noreset -nolisten unix >"$base/$name.log" 2>&1 3>"$base/$name.fifo" &
    server=$!
    servers="$servers $server"
    read -r number <"$base/$name.fifo" || { echo "no Xvfb: $(tail -n 1 "$base/$name.log")"; exit 1; }
    DISPLAY=:$number
    export DISPLAY
}

found() { "$user" find smear >"$base/window" && read -r window width height <"$base/window"; }
# start OPTIONS...: the program, until its window is there and shows something
start() {
    "$smear" view --out x11 "$@" >"$base/out" 2>"$base/err" &
    process=$!
    wait_for 30 found || { cat "$base/err"; return 1; }
    found && wait_for 30 is_drawn
}
is_drawn() { "$user" shot "$window" "$base/shot.png" && [ "$(wc -c <"$base/shot.png")" -gt 4000 ]; }
ended() { # STATUS: the program has ended with it
    wait_for 30 eval '! kill -0 $process 2>/dev/null'
    wait "$process"
    equals $? "$1"
}
end() { kill "$process" && ended 0; }
# shows OPTIONS...: the window's picture is what render draws with these options
shows() {
    "$smear" render $race -o "$base/want.png" "$@" || return 1
    wait_for 20 looks_right || { "$smear" compare "$base/want.png" "$base/shot.png"; return 1; }
}
looks_right() {
    "$user" shot "$window" "$base/shot.png" &&
        "$smear" compare "$base/want.png" "$base/shot.png" | grep -q 'rmse=0.000000$'
}
looks_wrong() { ! looks_right; }
key() { "$user" key "$window" "$@"; }

# ------------------------------------------------------------------ 24 bits

server plain Xvfb -screen 0 800x600x24
plain=$DISPLAY
# Shared memory that process $1 has made and that is still there.
segments() { ipcs -m -p | awk -v process="$1" '$3 == process' | wc -l; }

claim "a window" start $race --zoom 1 --paused --frames 1000
claim "of the panel's size" equals "$width $height" "320 240"
claim "the picture is the frame" shows --frames 0-0
mkdir -p "$here/build/view" && cp "$base/shot.png" "$here/build/view/x11.png"
claim "a key: a step" eval 'key 0x2e && shows --frames 1-1'
claim "a key: no blur" eval 'key 0x62 && shows --frames 1-1 --method none'
claim "a key with shift" eval 'key 0x62 && key 0x4d 1 && shows --frames 1-1 --method layered'
claim "the pointer turns the camera" eval '"$user" press "$window" 1 100 100 &&
    "$user" move "$window" 0 140 110 && "$user" release "$window" 1 140 110 &&
    wait_for 20 looks_wrong'
claim "a pointer that holds no button does not" eval 'key 0x78 && wait_for 10 looks_right &&
    "$user" move "$window" 0 10 10 && sleep 1 && looks_right'
claim "the wheel comes closer" eval '"$user" press "$window" 4 100 100 && wait_for 20 looks_wrong'
claim "and back" eval '"$user" press "$window" 5 100 100 && wait_for 10 looks_right'
claim "arrow keys" eval 'key 0xff53 && wait_for 20 looks_wrong && key 0xff51 && wait_for 10 looks_right'
claim "a close request ends it" eval '"$user" close "$window" && ended 0'
claim "it says nothing" equals "$(cat "$base/err")" ""

sizes() {
    start $race --size 100x80 --paused || return 1
    for size in '100 80' '1 1' '7 300' '790 590' '333 111' '100 80'; do
        "$user" size "$window" $size || return 1
        sleep 0.4
        kill -0 $process || { echo "gone at $size"; return 1; }
    done
    shows --size 100x80 --frames 0-0
}
claim "any size, and back" sizes
claim "q ends it" eval 'key 0x71 && ended 0'

enlarged() { # pixel (x, y) of the frame is 2x2 pixels of the window
    start $race --size 64x48 --zoom 2 --paused || return 1
    found && equals "$width $height" "128 96" || return 1
    wait_for 20 sees_enlarged
}
sees_enlarged() {
    "$user" shot "$window" shot.png && "$smear" render $race --size 64x48 --frames 0-0 -o want.ppm || return 1
    # the shot's pixels at even places, compared as text
    "$smear" compare shot.png shot.png --diff zero.ppm >/dev/null || return 1
    png_to_text shot.png | awk 'int((NR - 1) / 128) % 2 == 0 && (NR - 1) % 2 == 0' >even
    tail -n +4 want.ppm | od -An -v -tu1 -w3 >wanted
    cmp even wanted
}
# A PNG's pixels as lines of three numbers, by way of the program itself: |picture - black|.
png_to_text() {
    width=$(od -An -tu1 -j16 -N4 "$1" | awk '{ print $3 * 256 + $4 }')
    height=$(od -An -tu1 -j20 -N4 "$1" | awk '{ print $3 * 256 + $4 }')
    { printf 'P6\n%d %d\n255\n' "$width" "$height"; head -c $((width * height * 3)) /dev/zero; } >black.ppm
    "$smear" compare "$1" black.ppm --diff plain.ppm --gain 1 >/dev/null
    tail -n +4 plain.ppm | od -An -v -tu1 -w3
}
claim "pixels are enlarged by whole numbers" enlarged
claim "SIGTERM ends it" end

claim "a picture that stands does not tear" eval 'start $race --zoom 1 --paused --bus 3000000 --panel-hz 60 &&
    key 0x2e && shows --frames 1-1'
claim "ends after it" end
timed() { # OPTIONS...: view's figures
    "$smear" view $race --out x11 --size 640x480 --frames 12 --times "$@" >times || return 1
    sed 's/.*window_percent=\([0-9.]*\) screen=\(.*\)/\1 \2/' times
}
by_shared_memory() {
    timed >figures && has figures 'MIT-SHM' && cat times && is_true "$(cut -d' ' -f1 figures) <= 10"
}
claim "640x480 by shared memory takes at most 10 % of the frame's time" by_shared_memory
echo "    $(cat times)"
claim "the frames are those of render" eval '"$smear" view $race --out x11 --size 96x72 --frames 3 --crc >crc &&
    equals "$(sed "s/.*crc32=//" crc | tr "\n" " ")" "$(render_crcs $race 0-2 --size 96x72 | tr "\n" " ")"'
killed() {
    start $race --paused && equals "$(segments $process)" 1 || return 1
    kill -9 $process
    wait_for 10 eval '[ "$(segments $process)" -eq 0 ]'
}
claim "nothing is left behind by a kill -9" killed

# ------------------------------------------------------------------ without shared memory

claim "without shared memory, by choice" eval 'start $race --zoom 1 --paused --no-shared-memory &&
    shows --frames 0-0'
claim "SIGINT ends it" eval 'kill -INT $process && ended 0'
claim "figures tell it" eval 'timed --no-shared-memory >figures && has figures PutImage'
echo "    $(cat times)"

server bare Xvfb -screen 0 800x600x24 -extension MIT-SHM
claim "a server without shared memory" eval 'start $race --zoom 1 --paused && shows --frames 0-0'
claim "a picture larger than a request" eval '"$user" size "$window" 780 590 && key 0x2e && key 0x2c &&
    "$user" size "$window" 320 240 && shows --frames 0-0'
claim "ends" end
if unshare -i true 2>/dev/null; then
    # a server that cannot see our memory refuses to attach it
    server far unshare -i Xvfb -screen 0 800x600x24
    claim "a server that refuses shared memory" eval 'start $race --zoom 1 --paused && shows --frames 0-0'
    claim "ends" end
    claim "figures tell it" eval 'timed >figures && has figures PutImage'
else
    echo "this machine cannot part a server from our memory (unshare -i)"
    failed=$((failed + 1))
fi

# ------------------------------------------------------------------ other servers

server shallow Xvfb -screen 0 800x600x16
claim "16 bits" eval 'start $race --zoom 1 --paused --format rgb565 && shows --frames 0-0 --format rgb565'
claim "ends" end
claim "16 bits without shared memory, odd width" eval 'start $race --zoom 1 --paused --size 131x77 \
    --format rgb565 --no-shared-memory && shows --size 131x77 --frames 0-0 --format rgb565'
claim "ends" end
server poor Xvfb -screen 0 800x600x8
claim "8 bits are too few" fails 1 x11 view --out x11 --frames 1

: >cookies
: >cookies.server
server locked Xvfb -screen 0 800x600x24 -auth "$base/cookies.server"
kill "$server"
wait "$server" 2>/dev/null          # the next one takes its number
cookie=00112233445566778899aabbccddeeff
xauth -f cookies.server -q add ":$number" . $cookie
xauth -f cookies -q add ":$number" . $cookie
rm -f locked.fifo
Xvfb ":$number" -screen 0 800x600x24 -auth "$base/cookies.server" >locked.log 2>&1 &
server=$!
servers="$servers $server"
with_cookie() { XAUTHORITY=$base/cookies "$smear" view $race --out x11 --size 32x24 --frames 2; }
claim "a cookie opens" wait_for 20 with_cookie
refused() { HOME=$base fails 1 x11 view --out x11 --frames 1 && has "$base/err" "refuses"; }
claim "without the cookie it is refused, and says so" refused
head -c 3000 /dev/urandom >noise
claim "a broken cookie file" eval 'XAUTHORITY=$base/noise fails 1 x11 view --out x11 --frames 1'

server tcp Xvfb -screen 0 800x600x24 -listen tcp
claim "over TCP" eval 'DISPLAY=localhost$DISPLAY "$smear" view $race --out x11 --size 32x24 --frames 2 --times >times'
claim "screen 1 is not there" eval 'DISPLAY=$DISPLAY.1 fails 1 x11 view --out x11 --frames 1'

# ------------------------------------------------------------------ losses

DISPLAY=$plain
destroyed() {
    start $race --size 96x72 || return 1
    "$user" destroy "$window" && ended 0
}
claim "a window that is destroyed ends it" destroyed
lost() {
    server short Xvfb -screen 0 800x600x24
    start $race --size 96x72 "$@" || return 1
    kill -9 "$server"
    ended 1 && equals "$(cat "$base/err")" "smear: x11: the X server is gone"
}
claim "a server that goes" lost
rm -f short.fifo
claim "a server that goes while nothing moves" lost --paused
rm -f short.fifo
claim "a server that goes, without shared memory" lost --no-shared-memory
hangs() { # a stopped server does not keep SIGTERM away
    rm -f short.fifo
    server short Xvfb -screen 0 800x600x24
    start $race --size 96x72 || return 1
    kill -STOP "$server"
    sleep 0.5
    kill "$process"
    ended 0
    status=$?
    kill -CONT "$server"
    return $status
}
claim "SIGTERM while the server hangs" hangs

finish
