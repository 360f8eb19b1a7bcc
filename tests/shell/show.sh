#!/bin/sh
# SPDX-License-Identifier: MIT
# show.sh - `smear show` and how `smear view` begins: the clip that moves most, all of it, filling the picture, before a background
# of two colours; moving pictures of which no frames are said; what cannot be shown.
#
#     sh tests/shell/show.sh build/smear
#
# Prints each claim that does not hold and, last, `N passed, N failed`.
. "$(dirname "$0")/lib.sh"
of_program "$@"
assets=${SMEAR_ASSETS-$([ ! -d "$here/../shared/assets" ] || echo "$here/../shared/assets")}
in_passing show
mkdir "$base/in" "$base/work" && cd "$base/work" || exit 1

show() { works show "$@"; }
out_has() { has "$base/out" "$1"; }

# ------------------------------------------------------------------ models

# A plate of 2 x 2. In half a second "slide" moves it by 1, "rise" by 2; "rest" does not. -1 is 000 000 200 277, 1 is 000 000 200 077,
# 1/2 is 000 000 000 077 (little-endian floats, in octal).
{
    printf '\000\000\200\277\000\000\200\277\000\000\000\000'
    printf '\000\000\200\077\000\000\200\277\000\000\000\000'
    printf '\000\000\200\077\000\000\200\077\000\000\000\000'
    printf '\000\000\200\277\000\000\200\077\000\000\000\000'
    printf '\000\000\001\000\002\000\000\000\002\000\003\000'
    printf '\000\000\000\000\000\000\000\077'
    printf '\000\000\000\000\000\000\000\000\000\000\000\000\000\000\200\077\000\000\000\000\000\000\000\000'
    printf '\000\000\000\000\000\000\200\277\000\000\000\000\000\000\000\000\000\000\200\077\000\000\000\000'
} >"$base/in/plate.bin"
# plate FILE MESH ANIMATIONS
plate() {
    cat >"$base/in/$1" <<END
{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"name":"plate"$2}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}]}],
"materials":[{"doubleSided":true}]$3,
"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[-1,-1,0],"max":[1,1,0]},
{"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"},
{"bufferView":2,"componentType":5126,"count":2,"type":"SCALAR","min":[0],"max":[0.5]},
{"bufferView":3,"componentType":5126,"count":2,"type":"VEC3"},
{"bufferView":4,"componentType":5126,"count":2,"type":"VEC3"}],
"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":12},
{"buffer":0,"byteOffset":60,"byteLength":8},{"buffer":0,"byteOffset":68,"byteLength":24},
{"buffer":0,"byteOffset":92,"byteLength":24}],
"buffers":[{"byteLength":116,"uri":"plate.bin"}]}
END
}
channel='"channels":[{"sampler":0,"target":{"node":0,"path":"translation"}}]'
slide="{\"name\":\"slide\",$channel,\"samplers\":[{\"input\":2,\"output\":3}]}"
rise="{\"name\":\"rise\",$channel,\"samplers\":[{\"input\":2,\"output\":4}]}"
rest="{\"name\":\"rest\",$channel,\"samplers\":[{\"input\":2,\"output\":3,\"interpolation\":\"STEP\"}]}"
plate plate.gltf ',"mesh":0' ",\"animations\":[$slide,$rise,$rest]"
plate swapped.gltf ',"mesh":0' ",\"animations\":[$rise,$slide]"
plate still.gltf ',"mesh":0' ""
plate nothing.gltf "" ""
plate=$base/in/plate.gltf still=$base/in/still.gltf arm=$here/tests/data/arm.gltf

# frames FILE: of a GIF, by its graphic control extensions; looped, by Netscape's
frames() { od -An -v -tx1 "$1" | tr -d ' \n' | grep -o '0021f904' | wc -l; }
loops() { LC_ALL=C grep -q NETSCAPE2.0 "$1"; }
# again ARGUMENTS...: `render` with the options that show has printed but for its frames and output, and these
again() {
    # shellcheck disable=SC2046
    works render "$1" $(sed 's/.*: smear render MODEL //; s/ --frames.*//; s/ -o .*//' "$base/printed") $(shift; echo "$@")
}
# fills MODEL FRAME LEAST: the model fills so much of the height of that frame, by its depth, and touches no edge
fills() {
    again "$1" --frames "$2-$2" --depth depth.pfm -o depth.png || return 1
    size=$(sed -n 2p depth.pfm | tr -d '\r')
    tail -c $((4 * ${size% *} * ${size#* })) depth.pfm | od -An -v -tx4 -w$((4 * ${size% *})) |
        awk -v least="$3" '{ seen = 0; for (i = 1; i <= NF; i++) if ($i != "7f800000") { seen = 1; if (i == 1 || i == NF) edge = 1 } }
            seen { rows++; if (NR == 1) edge = 1 } END { if (seen) edge = 1
            if (rows < least * NR || edge) { print rows, "of", NR, "rows" (edge ? ", at an edge" : ""); exit 1 } }'
}
# shows MODEL NAME FRAMES
shows() {
    show "$1" -o shown.gif && cp "$base/out" "$base/printed" && out_has "$2" && equals "$(frames shown.gif)" "$3" && loops shown.gif &&
        fills "$1" $(($3 / 2)) "${4:-0.5}"
}

# ------------------------------------------------------------------ what is shown

# Its way is as long as it is high.
claim "the clip that moves most" shows "$plate" 'clip 1 "rise", 15 frames' 15 0.4
claim "is another where the file has another order" shows "$base/in/swapped.gltf" 'clip 0 "rise", 15 frames' 15 0.4
claim "a model at rest is turned" shows "$still" 'a turn, 90 frames' 90
# Keys at 0 and 0.5 s are read as 0 and 32 s: 000 000 000 102.
mkdir "$base/in/long" && cp "$plate" "$base/in/long/plate.gltf" && sed -i 's/"max":\[0.5\]/"max":[32]/' "$base/in/long/plate.gltf"
{
    head -c 64 "$base/in/plate.bin"
    printf '\000\000\000\102'
    tail -c +69 "$base/in/plate.bin"
} >"$base/in/long/plate.bin"
long() { show "$base/in/long/plate.gltf" -o long.png && out_has 'clip 1 "rise", the first 600 frames'; }
claim "of a long clip the beginning" long
claim "skins, parts, morphs" shows "$arm" 'clip [01] "' 30
if [ -f "${assets:-none}/khronos/Fox.glb" ]; then
    claim "a fox runs" shows "$assets/khronos/Fox.glb" 'clip 2 "Run", 35 frames' 35
    claim "a teapot is turned" shows "$assets/classic/teapot.obj" 'a turn, 90 frames' 90
fi

# A picture of the middle, all frames, and an animation of true colour.
kinds() {
    show "$plate" -o middle.png && cp "$base/out" "$base/printed" && again "$plate" --frames 7-7 -o want.png && same middle.png want.png &&
        show "$plate" -o each%02d.ppm && exists each00.ppm && exists each14.ppm && missing each15.ppm && show "$plate" -o all.apng &&
        show "$still" -o still.png && exists still.png
}
claim "stills, numbered ones, APNG" kinds
printed() { show "$plate" -o one.gif && cp "$base/out" "$base/printed" && again "$plate" --frames 0-14 -o two.gif && same one.gif two.gif; }
claim "what it prints draws the same" printed
shaded() {
    show "$plate" --shadow planar,80 -o shaded.png && cp "$base/out" "$base/printed" && out_has 'render MODEL --shadow planar,80 ' &&
        again "$plate" --frames 7-7 -o want.png && same shaded.png want.png && differ middle.png shaded.png
}
claim "and a shadow, where that is asked for" shaded

# ppm_row FILE ROW: bytes of a row, in decimal
ppm_row() {
    width=$(sed -n 2p "$1" | cut -d' ' -f1)
    tail -c +$(($(head -n 3 "$1" | wc -c) + 1)) "$1" | od -An -v -tu1 -w$((3 * width)) | sed -n "$(($2 + 1))p"
}
# The background is alike along a row, changes by few codes from row to row, and has both colours at its ends.
gradient() {
    run render "$still" --clear 203040,a0b0c0 --eye 0,0,100 --look 0,0,0 --fov 90 --size 64x48 "$@" -o gradient.ppm
    equals "$rc" 0 || return 1
    row=0
    while [ $row -lt 48 ]; do
        ppm_row gradient.ppm $row
        row=$((row + 1))
    done | awk '{ for (k = 1; k <= 3; k++) { if ($k < last[k] || $k > last[k] + 4 && NR > 1) bad = 1; last[k] = $k }
        if ($1 != $(NF - 2) || $2 != $(NF - 1)) bad = 1
        if (NR == 1 && ($1 - 32) * ($1 - 32) > 9 || NR == 48 && ($1 - 160) * ($1 - 160) > 9 || bad) { print "row", NR ":", $1, $2, $3, $(NF - 2); exit 1 } }'
}
claim "a background of two colours" gradient
claim "by a filter" gradient --method reconstruct
claim "in encoded light" gradient --light encoded
claim "sharp" gradient --method none
claim "of a truth" gradient --method accumulate --exact --samples 4
smooth() {      # more colours than a plate and its background have
    works render "$still" --clear 203040,203041 --eye 1,2,3 --look 0,0,0 --fov 45 --size 64x48 --edges "$1" -o edges.ppm &&
        is_true "$(tail -c 9216 edges.ppm | od -An -v -tu1 -w3 | sort -u | wc -l) $2"
}
claim "edges before it are smooth" smooth smooth "> 4"
claim "or hard" smooth hard "== 3"
planes() {
    works render "$plate" --clip 1 --time 0.2 --depth d1.pfm --velocity v1.pfm -o a.png &&
        works render "$plate" --clip 1 --time 0.2 --clear 000000,ffffff --depth d2.pfm --velocity v2.pfm -o b.png && same d1.pfm d2.pfm &&
        same v1.pfm v2.pfm && differ a.png b.png
}
claim "it has no distance and no velocity" planes
unseen() {
    run render "$still" --clear 102030,405060 --eye 0,0,4 --look 0,0,9 --fov 45 -o unseen.png
    [ "$rc" -eq 0 ] && has "$base/err" 'nothing is seen of 2 triangles'
}
claim "what is not seen before it is told" unseen

# ------------------------------------------------------------------ moving pictures of `render`

moving() { works render "$plate" "$@" && equals "$(frames "$3")" "$4"; }
all_frames() {
    works render "$plate" --size 64x48 --loop -o a.gif && equals "$(frames a.gif)" 15 &&
        works render "$plate" --size 64x48 -o b.gif && equals "$(frames b.gif)" 16 &&
        works render "$plate" --size 64x48 --fps 10 --loop -o c.gif && equals "$(frames c.gif)" 5 &&
        works render "$plate" --size 64x48 --frames 0-3 -o d.gif && equals "$(frames d.gif)" 4 &&
        works render "$plate" --size 64x48 --time 0.2 -o e.gif && equals "$(frames e.gif)" 1 &&
        works render "$still" --size 64x48 -o f.gif && equals "$(frames f.gif)" 1
}
claim "all frames of the clip, unless others are said" all_frames
claim "one still cannot hold what goes with them" fails 2 --depth render "$plate" -o out.gif --depth d.pfm

# ------------------------------------------------------------------ memory

first_is_default() { works info "$plate" && grep -A 1 '^memory at 320x240' "$base/out" | tail -n 1 | grep 'what a smear_desc has that says no methods$'; }
claim "what a smear_desc takes that says nothing comes first" first_is_default

# ------------------------------------------------------------------ the viewer

# A terminal that is asked for nothing but what it is sent in a second; the first row's colours are the background's.
in_terminal() {
    python3 - "$smear" "$@" >"$base/terminal" <<'END'
import os, pty, select, sys, time
child, fd = pty.fork()
if child == 0:
    os.environ.update(TERM="xterm", COLORTERM="truecolor", DISPLAY="", LINES="30", COLUMNS="90")
    os.execv(sys.argv[1], sys.argv[1:])
end, text = time.time() + 60, b""
while time.time() < end and text.count(b"\x1b[38;2") + text.count(b"\x1b[48;2") < 400:
    if select.select([fd], [], [], 1)[0]:
        try:
            text += os.read(fd, 65536)
        except OSError:
            break
try:
    os.write(fd, b"q")
    while os.read(fd, 65536):
        pass
except OSError:
    pass
os.waitpid(child, 0)
sys.stdout.buffer.write(text)
END
}
# The upper colour of the background is 55 63 6f; downscaled, nearly so.
is_studio() { in_terminal "$@" && LC_ALL=C grep -qE '8;2;8[5-9];(99|10[0-3]);11[1-5]' "$base/terminal"; }
is_black() { in_terminal "$@" && LC_ALL=C grep -qE '8;2;0;0;0' "$base/terminal" && ! LC_ALL=C grep -qE '8;2;8[5-9];(99|10[0-3]);11[1-5]' "$base/terminal"; }
if command -v python3 >/dev/null 2>&1; then
    claim "show opens the viewer" is_studio show "$plate"
    claim "with a shadow, too" is_studio show --shadow blob "$plate"
    claim "view begins likewise" is_studio view --out term "$still"
    claim "unless a clip is said" is_black view --out term --clip 1 "$plate"
    claim "or it draws as a board" is_black view --out term --board rp2040 "$plate"
fi

# ------------------------------------------------------------------ what cannot be shown

bad_usage() { subject=$1; shift; claim "bad usage: smear $*" fails 2 "$subject" "$@"; }
bad_input() { subject=$1; shift; claim "bad input: smear $*" fails 1 "$subject" "$@"; }
printf 'v 0 0 0\nv 1 0 0\nl 1 2\n' >"$base/in/line.obj"
printf 'nonsense' >"$base/in/bad.glb"
bad_usage show show
bad_usage b show "$plate" b
bad_usage show show builtin:demo/race
bad_usage --frob show "$plate" --frob
bad_usage -o show "$plate" -o
bad_usage -o show "$plate" -o out.webp
bad_usage -o show "$plate" -o out
bad_usage -o show "$plate" -o out%s.png
bad_usage -o show "$plate" -o out%d.gif
bad_usage --clear render "$plate" --clear 102030,4050 -o out.png
bad_usage --clear render "$plate" --clear 102030,40506g -o out.png
bad_usage --clear render "$plate" --clear 102030,405060,1 -o out.png
bad_usage --fog render "$plate" --clear 102030,405060 --fog 102030,1,9 -o out.png
bad_input missing.glb show missing.glb -o out.gif
bad_input missing.glb show missing.glb
bad_input "$base/in/bad.glb" show "$base/in/bad.glb" -o out.gif
bad_input "$base/in/nothing.gltf" show "$base/in/nothing.gltf" -o out.gif
bad_input "$base/in/line.obj" show "$base/in/line.obj" -o out.gif
bad_input nowhere/out.gif show "$plate" -o nowhere/out.gif
says() { fails_with "$1" "$smear" show "$2" -o out.gif && missing out.gif; }
claim "no triangles are told" says 'nothing.gltf: there are no triangles to show' "$base/in/nothing.gltf"
claim "it is no file that it writes over" fails 2 -o show "$plate" -o "$base/in/plate.png/../plate.bin"
mkdir -p folder.gif
claim "nor a folder" sh -c "! '$smear' show '$plate' -o folder.gif >'$base/told' 2>&1 && grep -q 'smear: folder.gif: ' '$base/told'"
finish
