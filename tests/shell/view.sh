#!/bin/sh
# SPDX-License-Identifier: MIT
# view.sh - `smear view` without a screen: the pictures are those of `render`, controls do what they
# say, CRCs are kept and checked, input is recorded and played.
#
#     sh tests/shell/view.sh build/smear
#
# Prints each claim that does not hold and, last, `N passed, N failed`.
. "$(dirname "$0")/view_lib.sh"
golden=$here/tests/golden.txt
mkdir "$base/in" "$base/work" && cd "$base/work" || exit 1

view() { works view --out null "$@"; }
small="--size 96x72"

# ------------------------------------------------------------------ the same bits as render

# A spinning plate, to have a file with a clip of one second.
cat >"$base/in/plate.gltf" <<'END'
{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1,2]}],
"nodes":[{"name":"plate","mesh":0},{"name":"near","camera":0,"translation":[0,0,4]},
{"name":"far","camera":0,"translation":[0,0,9]}],
"cameras":[{"type":"perspective","perspective":{"yfov":0.9,"znear":0.1}}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
"animations":[{"name":"slide","channels":[{"sampler":0,"target":{"node":0,"path":"translation"}}],
"samplers":[{"input":2,"output":3}]},
{"name":"rise","channels":[{"sampler":0,"target":{"node":0,"path":"translation"}}],
"samplers":[{"input":2,"output":4}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[-1,-1,0],"max":[1,1,0]},
{"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"},
{"bufferView":2,"componentType":5126,"count":2,"type":"SCALAR","min":[0],"max":[1]},
{"bufferView":3,"componentType":5126,"count":2,"type":"VEC3"},
{"bufferView":4,"componentType":5126,"count":2,"type":"VEC3"}],
"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":12},
{"buffer":0,"byteOffset":60,"byteLength":8},{"buffer":0,"byteOffset":68,"byteLength":24},
{"buffer":0,"byteOffset":92,"byteLength":24}],
"buffers":[{"byteLength":116,"uri":"plate.bin"}]}
END
# -1 is 000 000 200 277, 1 is 000 000 200 077 (little-endian floats, in octal)
{
    printf '\000\000\200\277\000\000\200\277\000\000\000\000'
    printf '\000\000\200\077\000\000\200\277\000\000\000\000'
    printf '\000\000\200\077\000\000\200\077\000\000\000\000'
    printf '\000\000\200\277\000\000\200\077\000\000\000\000'
    printf '\000\000\001\000\002\000\000\000\002\000\003\000'
    printf '\000\000\000\000\000\000\200\077'
    printf '\000\000\200\277\000\000\000\000\000\000\000\000\000\000\200\077\000\000\000\000\000\000\000\000'
    printf '\000\000\000\000\000\000\200\277\000\000\000\000\000\000\000\000\000\000\200\077\000\000\000\000'
} >"$base/in/plate.bin"
plate=$base/in/plate.gltf

as_render() { # SCENE A-B OPTIONS...
    as_scene=$1
    as_range=$2
    shift 2
    render_crcs "$as_scene" "$as_range" "$@" >"$base/want" || return 1
    view "$as_scene" --frames "$as_range" --crc "$@" || return 1
    crcs >"$base/got"
    [ -s "$base/want" ] && diff "$base/want" "$base/got"
}

claim "the demo" as_render $race 0-2 $small
claim "its later frames" as_render $race 40-41 $small
for method in none accumulate reconstruct subframes timemask; do
    claim "method $method" as_render $race 3-4 $small --method $method
done
for format in rgb565 rgb565be rgb555 rgb332 l8 l4 l1 l1pages; do
    claim "format $format" as_render $race 5-5 $small --format $format
done
claim "dither, light, shutter, exposure, samples" as_render $race 6-7 $small --format rgb332 \
    --dither blue --light encoded --shutter 300 --exposure trailing --method reconstruct --samples 5
claim "smooth edges" as_render $race 3-4 $small --edges smooth
claim "poses at the shutter" as_render $race 6-7 $small --poses shutter
claim "a cut" as_render $race 6-7 $small --cut 7
claim "threads" as_render $race 6-7 $small --threads 3
claim "an arena that draws in parts" as_render $race 6-6 $small --arena 100000 --method reconstruct
claim "a file" as_render "$plate" 4-6 $small
claim "a file, beyond the end of its clip" as_render "$plate" 29-33 $small
claim "a file that loops" as_render "$plate" 29-33 $small --loop
claim "another clip and camera" as_render "$plate" 4-6 $small --clip rise --camera far
claim "forced motion" as_render "$plate" 4-6 $small --motion plate=none
claim "another rate" as_render "$plate" 4-6 $small --fps 12.5

# The golden frames that firmware of every target is checked against (tests/golden.txt).
as_firmware() {
    sed -n 's/^reconstruct-l1 [01] \([0-9a-f]*\).*/\1/p' "$golden" >"$base/want"
    view builtin:demo/drone --size 133x65 --format l1 --reach 8 --method reconstruct --shutter 360 --frames 9-10 --crc || return 1
    crcs >"$base/got"
    [ "$(wc -l <"$base/want")" -eq 2 ] && diff "$base/want" "$base/got"
}
claim "frames of firmware" as_firmware

at_a_time() {
    "$smear" render $race --time 0.77 $small --stats "$base/stats.json" || return 1
    want=$(sed -n 's/.*"crc32":"\([0-9a-f]*\)".*/\1/p' "$base/stats.json")
    view $race --time 0.77 $small --frames 1 --crc && equals "$(crcs)" "$want"
}
claim "an instant" at_a_time

# ------------------------------------------------------------------ controls

# keys FRAMES LINES: the CRCs with this input
keys() {
    printf '%b' "$2" >"$base/in/keys"
    view $race $small --frames "$1" --play "$base/in/keys" --crc || return 1
    crcs
}
plain=$(render_crcs $race 0-5 $small | tr '\n' ' ')
nth() { echo "$2" | cut -d' ' -f"$1"; }

pauses() {
    got=$(keys 4 '2 key space\n3 key space\n' | tr '\n' ' ')
    # what is paused is drawn again
    equals "$got" "$(nth 1 "$plain") $(nth 2 "$plain") $(nth 2 "$plain") $(nth 3 "$plain") "
}
claim "space pauses, and goes on" pauses

steps() {
    got=$(keys 4 '1 key .\n2 key .\n3 key ,\n' | tr '\n' ' ')
    equals "$got" "$(nth 1 "$plain") $(nth 2 "$plain") $(nth 3 "$plain") $(nth 2 "$plain") "
}
claim "steps forward and back show the same frames" steps

back_at_start() {
    got=$(keys 3 '1 key ,\n2 key ,\n' | tr '\n' ' ')
    equals "$got" "$(nth 1 "$plain") $(nth 1 "$plain") $(nth 1 "$plain") "
}
claim "there is nothing before the first frame" back_at_start

home_key() {
    got=$(keys 4 '3 key home\n3 key space\n' | tr '\n' ' ')
    equals "$(nth 4 "$got")" "$(nth 1 "$plain")"
}
claim "home goes to the first frame" home_key

# setting NAME INPUT OPTIONS...: after the input, frame 1 is that of render with the options
setting() {
    setting_input=$1
    shift
    want=$(render_crcs $race 1-1 $small "$@") || return 1
    got=$(keys 2 "$setting_input" | tail -n 1)
    equals "$got" "$want"
}
claim "b turns blur off" setting '1 key b\n' --method none
claim "b turns it on again" setting '1 key b\n1 key b\n'
claim "m: the method after auto" setting '1 key m\n' --method none
claim "M: the method before auto" setting '1 key M\n' --method layered
claim "u: quality" setting '1 key u\n' --quality fine
claim "U: quality" setting '1 key U\n' --quality draft
claim "]: shutter" setting '1 key ]\n' --shutter 195
claim "[: shutter" setting '1 key [\n1 key [\n' --shutter 150
claim "shutter ends at 360" setting "$(printf '1 key ]\\n%.0s' 1 2 3 4 5 6 7 8 9 10 11 12 13 14)" \
    --shutter 360
claim "n: samples" setting '1 key m\n1 key m\n1 key n\n' --method accumulate --samples 12
claim "N: samples" setting '1 key m\n1 key m\n1 key m\n1 key m\n1 key m\n1 key N\n' --method timemask --samples 16
claim "l: light" setting '1 key l\n' --light encoded
claim "h: smooth edges" setting '1 key h\n' --edges smooth
claim "h: hard edges again" setting '1 key h\n1 key h\n' --edges hard
claim "smooth edges, where a method has them" setting '1 key h\n1 key b\n' --method none
claim "smooth edges come back with the method" setting '1 key h\n1 key m\n1 key M\n' --edges smooth
claim "f: format" setting '1 key f\n' --format rgb565
claim "F: format" setting '1 key F\n' --format l1pages
claim "d: dither" setting '1 key f\n1 key d\n' --format rgb565 --dither none

speed() {
    got=$(keys 3 '1 key t\n2 key T\n' | tr '\n' ' ')
    equals "$got" "$(nth 1 "$plain") $(nth 3 "$plain") $(nth 4 "$plain") "
}
claim "t doubles the speed of time, T halves it" speed

slow() {
    want=$("$smear" render $race $small --time 0.016666666666666666 --stats "$base/stats.json" &&
        sed -n 's/.*"crc32":"\([0-9a-f]*\)".*/\1/p' "$base/stats.json")
    got=$(keys 2 '1 key T\n' | tail -n 1)
    equals "$got" "$want"
}
claim "slow motion shows the instants between frames" slow

orbit() {
    got=$(keys 6 '1 key right\n2 key left\n3 drag 1 200 100\n4 key x\n5 wheel 1\n' | tr '\n' ' ')
    equals "$(nth 3 "$got")" "$(nth 3 "$plain")" && equals "$(nth 5 "$got")" "$(nth 5 "$plain")" ||
        return 1
    for i in 2 4 6; do
        [ "$(nth $i "$got")" != "$(nth $i "$plain")" ] || { echo "picture $i is not turned"; return 1; }
    done
}
claim "the camera turns, moves and comes back" orbit

clips() {
    printf '1 key k\n2 key c\n' >"$base/in/keys"
    view "$plate" $small --frames 3 --play "$base/in/keys" --crc || return 1
    got=$(crcs | tr '\n' ' ')
    equals "$(nth 2 "$got")" "$(render_crcs "$plate" 1-1 $small --clip rise)" &&
        equals "$(nth 3 "$got")" "$(render_crcs "$plate" 2-2 $small --clip rise --camera far)"
}
claim "k and c choose clip and camera" clips

reload() {
    cp "$plate" "$base/in/moving.gltf"
    printf '1 key i\n' >"$base/in/keys"
    view "$base/in/moving.gltf" $small --frames 2 --play "$base/in/keys" --crc
}
claim "i loads the file again" reload

# Every key there is, in every order of ten, through a small scene: nothing dies or says anything.
every_key() {
    "$smear" help view | sed -n '/^Controls/,$p' >"$base/controls"
    awk 'BEGIN { srand(7); split("? . , t T w b m M u U ] [ n N l f F d v V > < o z Z r R y x c k K L i e", k, " ")
            for (i in k) n++
            for (t = 1; t < 60; t++) { print t, "key", k[int(rand() * n) + 1]; print t, "key tab" }
            for (t = 60; t < 90; t++) { print t, "key", k[int(rand() * n) + 1]
                print t, "drag", int(rand() * 3) + 1, int(rand() * 400) - 200, int(rand() * 400) - 200
                print t, "wheel", rand() < 0.5 ? -1 : 1 } }' >"$base/in/keys"
    view "$plate" --size 40x30 --frames 90 --play "$base/in/keys" --crc || return 1
    cp "$base/out" "$base/first"
    view "$plate" --size 40x30 --frames 90 --play "$base/in/keys" --crc && cmp "$base/first" "$base/out"
}
claim "any input gives the same pictures twice" every_key

known_keys() { # each key of the help is one that scripts know
    "$smear" help view | sed -n '/^Controls/,/Ctrl-C/p' | sed '1d;$d' | cut -c3-13 |
        tr ' ' '\n' | grep . | sed 's/^-dn$/pagedown/' >"$base/names"
    is_true "$(wc -l <"$base/names") > 40" || return 1
    while read -r name; do
        case $name in q | escape) continue ;; esac
        echo "0 key $name" >"$base/in/keys"
        view "$plate" --size 16x12 --frames 1 --play "$base/in/keys" || return 1
    done <"$base/names"
}
claim "every key of the list is known" known_keys

too_small() { # what a control does must not end the program: the arena is too small for it
    printf '1 key m\n' >"$base/in/keys"
    view $race $small --frames 2 --arena 90000 --method none --play "$base/in/keys" --crc || return 1
    equals "$(crcs | tail -n 1)" "$(render_crcs $race 1-1 $small --method none --arena 90000)"
}
claim "settings that do not fit the arena are taken back" too_small

# ------------------------------------------------------------------ files

shoots() {
    rm -f ./*.png
    printf '1 key s\n2 key s\n' >"$base/in/keys"
    view $race $small --frames 3 --play "$base/in/keys" && exists demo-race-0000.png &&
        exists demo-race-0001.png || return 1
    "$smear" render $race $small --frames 0-1 -o f%d.png && cmp f0.png demo-race-0000.png &&
        cmp f1.png demo-race-0001.png
}
claim "screenshots are what render writes" shoots

checks() {
    rm -f gold*
    view $race $small --frames 3 --check gold --update && exists gold && exists gold.0002.png &&
        view $race $small --frames 3 --check gold && missing gold.0000.got.png || return 1
    "$smear" render $race $small --frames 2-2 -o f.png && cmp f.png gold.0002.png
}
claim "what was accepted is found again" checks

claim "where there is no display" works view $race $small --frames 3 --check gold
claim "CRCs where there is no display" eval 'works view $race $small --frames 2 --crc && equals "$(wc -l <"$base/out")" 2'

check_fails() {
    fails 1 gold view $race $small --out null --frames 3 --check gold --light encoded &&
        has "$base/err" "3 of 3 pictures differ" && exists gold.0001.got.png &&
        exists gold.0001.difference.png || return 1
    "$smear" render $race $small --frames 1-1 --light encoded -o f.png && cmp f.png gold.0001.got.png
}
claim "what differs is told, with pictures" check_fails
claim "pictures of a failure go when it is mended" eval 'view $race $small --frames 3 --check gold &&
    missing gold.0001.got.png && missing gold.0001.difference.png'
claim "too few pictures" fails 1 gold view $race $small --out null --frames 2 --check gold
claim "too many pictures" fails 1 gold view $race $small --out null --frames 4 --check gold
claim "other frames" fails 1 gold view $race $small --out null --frames 1-3 --check gold
claim "no file to check against" fails 1 none view $race $small --out null --frames 1 --check none
echo nonsense >bad
claim "a file of something else" fails 1 bad view $race $small --out null --frames 1 --check bad
claim "a folder that is not there" fails 1 no/where view $race $small --out null --frames 1 \
    --check no/where --update

plays_record() {
    printf '1 key b\n2 drag 1 30 -4\n2 wheel -1\n3 key left\n' >"$base/in/keys"
    view $race $small --frames 5 --play "$base/in/keys" --crc || return 1
    crcs >"$base/want"
    view $race $small --frames 5 --crc && crcs >"$base/got" && differ "$base/want" "$base/got"
}
claim "played input has an effect" plays_record
claim "an empty recording" eval 'view $race $small --frames 2 --record rec && exists rec && [ ! -s rec ]'
for line in 'x key b' '1 key nokey' '1 key' '1 drag 1 2' '1 wheel' '1 hop' '-1 key b' '1 key b c'; do
    echo "$line" >bad
    claim "input that is none: $line" fails 1 bad view $race $small --out null --frames 1 --play bad
done
printf '5 key b\n4 key b\n' >bad
claim "input that goes back" fails 1 bad view $race $small --out null --frames 1 --play bad

# ------------------------------------------------------------------ boards

# what help lists, so that none is forgotten
boards=$("$smear" help view | sed -n '/^Boards/,/^$/s/^  \([a-z0-9]*\) .*/\1/p')
claim "there are boards" is_true "$(echo "$boards" | wc -l) >= 9"
for board in $boards; do
    options=$("$smear" help view | sed -n "/^  $board /{n;p;}" |
        sed 's/--bus [0-9]*//;s/--panel-hz [0-9.]*//;s/--cpu [^ ]*//;s/--tint [^ ]*//;s/--round//')
    [ -n "$options" ] || failed=$((failed + 1))
    # shellcheck disable=SC2086
    board_as_render() {
        want=$(render_crcs $race 1-1 $options) || return 1
        view $race --board $board --frames 1-1 --crc && equals "$(crcs)" "$want"
    }
    claim "board $board draws what its options say" board_as_render
    # An arena may be too small for the demo in one part, but not for the demo.
    loses_nothing() {
        # shellcheck disable=SC2086
        works render $race --frames 0-1 $options --stats "$base/lost" && ! grep -q '"dropped":[1-9]' "$base/lost" &&
            [ "$(grep -c '"dropped":0' "$base/lost")" -eq 2 ]
    }
    claim "board $board loses no triangle" loses_nothing
    claim "board $board with another method" eval 'view $race --board $board --method none --frames 1 --crc'
done
claim "options go before the board's" eval 'view $race --board gba --size 64x48 --frames 1 --crc &&
    equals "$(crcs)" "$(render_crcs $race 0-0 --size 64x48 --format rgb555 --arena 229376 \
    --method auto --quality draft --light encoded --keep-display --tile 16 --reach 8)"'
kept_as_drawn() { # the picture is that of a display that is sent everything; less is sent
    view builtin:suite/propeller --board rp2040 --frames 4 --crc --times || return 1
    crcs >"$base/kept" && sent=$(sed -n 's/.* bus_ms=//p' "$base/out")
    render_crcs builtin:suite/propeller 0-3 --size 240x240 --format rgb565be --arena 204800 --quality draft --light encoded \
        --tile 16 --reach 12 >"$base/want" || return 1
    diff "$base/want" "$base/kept" && is_true "0 < $sent && $sent < 12"         # all of it: 13.9 ms at 66.5 MHz
}
claim "a board's display keeps what it shows" kept_as_drawn
keeps_within() { # an arena does not make it forget
    works render builtin:suite/propeller --size 96x72 --frames 0-3 --arena 100000 --keep-display --stats "$base/kept" &&
        [ "$(grep -c '"kept":0' "$base/kept")" -eq 1 ]
}
claim "with little memory, too" keeps_within
claim "what contradicts the board's goes before it, too" eval 'view $race --board rp2040 --target 1 --frames 1 --crc &&
    view $race --board oled --dither=diffuse --frames 1 --crc && view $race --board rp2040 --tile 8 --frames 1 --crc &&
    view $race --board lcd144 --reach 20 --frames 1 --crc'
claim "but not what the user contradicts" fails 2 --target view --board rp2040 --target 1 --quality fine --out null --frames 1
# the picture on the glass is not the frame: what the device draws stays the same
for look in '--zoom 3' '--rotate 90' '--rotate 180' '--rotate 270' '--round' '--tint 102030,ffffff' \
    '--bus 1000000 --panel-hz 60' '--bus 1000000 --sync' '--cpu cortex-m3:72e6' '--see velocity' \
    '--see depth' '--see tiles' '--see bands' '--split none' '--figures'; do
    # shellcheck disable=SC2086
    claim "the frame is the same with $look" eval 'view $race $small --frames 2 --crc '"$look"' &&
        equals "$(crcs | tr "\n" " ")" "$(nth 1 "$plain") $(nth 2 "$plain") "'
done

slow_board() { # a board that needs 3 frames for one shows every third, blurred as at a third of the rate
    view $race $small --method none --frames 2 --pace board --cpu cortex-m3:1e5 --crc || return 1
    n=$(sed -n 2p "$base/out" | sed 's/frame=\([0-9]*\).*/\1/')
    is_true "$n > 1" && equals "$(crcs | tail -n 1)" "$(render_crcs $race "$n-$n" $small --method none)"
}
claim "the board's pace leaves frames out" slow_board

# ------------------------------------------------------------------ wrong usage

wrong() { # SUBJECT ARGUMENTS...
    wrong_subject=$1
    shift
    claim "bad usage: smear view $*" fails 2 "$wrong_subject" view "$@"
}
wrong --out --out paper
wrong --board --board fridge
wrong --zoom --zoom 9
wrong --zoom --zoom 0
wrong --rotate --rotate 45
wrong --tint --tint 112233
wrong --bus --bus 0
wrong --panel-hz --panel-hz -1
wrong --cpu --cpu z80:4e6
wrong --cpu --cpu cortex-m3
wrong --pace --pace slow
wrong --pace --pace board
wrong --frames --frames 0
wrong --frames --frames 3-1
wrong --split --split halves
wrong --see --see sounds
wrong --colors --colors 16
wrong --update --update
wrong --check --check x
wrong --out --out null
wrong -o -o x.png
wrong --exact --exact --method accumulate
wrong --edges --edges smooth --board rp2040
wrong --stats --stats x.json
wrong --nonsense --nonsense
wrong --method --method magic
wrong --edges --edges smooth --method reconstruct
wrong --frames --frames
wrong two one two
wrong --clip builtin:demo/race --clip 1
claim "no such scene" fails 1 no.glb view no.glb --out null --frames 1
claim "no such built-in scene" fails 1 builtin:x view builtin:x --out null --frames 1
claim "an arena for nothing" fails 1 $race view $race --out null --frames 1 --arena 5000
head -c 5000 /dev/urandom >"$base/in/garbage.glb"
claim "garbage" fails 1 "$base/in/garbage.glb" view "$base/in/garbage.glb" --out null --frames 1
no_display() {
    TERM=xterm fails 1 "no display" view --frames 1 && has "$base/err" "DISPLAY is not set"
}
claim "no display at all" no_display
claim "a window without a server" eval 'DISPLAY=:4711 fails 1 x11 view --out x11 --frames 1'
claim "a display that is none" eval 'DISPLAY=nonsense fails 1 x11 view --out x11 --frames 1'
claim "a terminal that is none" fails 1 term view --out term --frames 1
claim "help" eval 'works view --help && has "$base/out" "Controls"'
claim "the same help" eval 'works help view && has "$base/out" "rp2040"'

sees_all() { # METHOD: every debug view of two halves of a screen; frames stay what they are
    want=$(render_crcs $race 0-1 $small --method "$1") || return 1
    for see in picture velocity depth tiles methods samples bands; do
        view $race $small --method "$1" --split "$1" --see $see --figures --frames 2 --crc || return 1
        equals "$(crcs)" "$want" || return 1
    done
}
for method in auto none accumulate reconstruct subframes timemask camera pingpong half object layered; do
    claim "all debug views of $method" sees_all $method
done

smooth_edges() { # methods that have none are drawn with hard ones
    for method in none timemask object; do
        view $race $small --edges smooth --split $method --frames 2 --crc || return 1
        equals "$(crcs)" "$(render_crcs $race 0-1 $small --edges smooth)" || return 1
    done
    echo '0 key b' >"$base/in/keys"
    view $race $small --edges smooth --frames 2 --play "$base/in/keys" --crc || return 1
    equals "$(crcs)" "$(render_crcs $race 0-1 $small --method none)"
}
claim "smooth edges beside hard ones" smooth_edges

finish
