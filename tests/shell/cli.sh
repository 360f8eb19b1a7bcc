#!/bin/sh
# SPDX-License-Identifier: MIT
# cli.sh - the program smear as its users meet it: every option, every file it writes, every error
# line.
#
#     sh tests/shell/cli.sh build/smear
#
# Works in a folder of its own. Prints each claim that does not hold and, last,
# `N passed, N failed`.

. "$(dirname "$0")/lib.sh"
of_program "$@"
in_passing cli
mkdir "$base/in" "$base/work" && cd "$base/work" || exit 1

render() { works render "$@"; }

usage() { # SUBJECT ARGUMENTS...
    claim "bad usage: smear $(shift; echo "$*")" fails 2 "$@"
}

input() { # SUBJECT ARGUMENTS...
    claim "bad input: smear $(shift; echo "$*")" fails 1 "$@"
}

bad() { # OPTION VALUES...
    option=$1
    shift
    for value; do usage "$option" render "$plate" "$option" "$value"; done
}

drawn() { # same|differ OTHER FILE ARGUMENTS...: drawn into the file, which is compared with another one
    compares=$1
    other=$2
    file=$3
    shift 3
    render "$@" -o "$file" && $compares "$other" "$file"
}

out_has() { has "$base/out" "$1"; }
err_has() { has "$base/err" "$1"; }
starts_with() { # FILE OCTAL-BYTES
    start=$(od -An -to1 -N"$(echo $2 | wc -w)" "$1" | tr -s ' \n' ' ' | sed 's/^ //;s/ $//')
    [ "$start" = "$2" ] || { echo "starts with $(od -An -c -N8 "$1")"; return 1; }
}
stat_of() { # FILE KEY: its first value
    sed -n "s/.*\"$2\":\"\{0,1\}\([^,}\"]*\).*/\1/p" "$1" | head -1
}
value_of() { sed -n "s/^$1=//p" "$base/out"; }

# bytes FILE [SKIP]: of a PPM, in decimal, one to a line, behind its three header lines
ppm_bytes() { tail -n +4 "$1" | od -An -v -tu1 | tr -s ' ' '\n' | grep .; }
ppm_pixel() { # FILE WIDTH X Y
    first=$((($4 * $2 + $3) * 3 + 1))
    ppm_bytes "$1" | sed -n "$first,$((first + 2))p" | tr '\n' ' ' | sed 's/ $//'
}
# pfm_value FILE WIDTH HEIGHT CHANNELS X Y CHANNEL: PFM has the bottom row first
pfm_value() {
    tail -n +4 "$1" | od -An -v -tf4 | tr -s ' ' '\n' | grep . |
        sed -n "$(((($3 - 1 - $6) * $2 + $5) * $4 + $7 + 1))p"
}
# The CRC-32 that gzip puts in its trailer
crc_of() {
    gzip -c | tail -c 8 | od -An -tx1 -N4 | awk '{ print $4 $3 $2 $1 }'
}

# ------------------------------------------------------------------ scenes of our own

# A plate of 2x2 at z = 0 that slides along x at 8 units per second, or spins; a wall behind it; two
# cameras at (0, 0, 4): 1 unit at z = 0 is an eighth of the height for the first one.
cat >"$base/in/plate.gltf" <<'END'
{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
"nodes":[{"name":"root","children":[1,2,3,4]},{"name":"plate","mesh":0},
 {"name":"wall","mesh":1,"translation":[0,1.5,-2],"scale":[3,0.5,1]},
 {"name":"front","camera":0,"translation":[0,0,4]},
 {"name":"flat","camera":1,"translation":[0,0,4]}],
"cameras":[{"type":"perspective","perspective":{"yfov":1.5707963267948966,"znear":0.5,"zfar":20}},
 {"type":"orthographic","orthographic":{"xmag":4,"ymag":4,"znear":0.5,"zfar":20}}],
"materials":[{"name":"red","doubleSided":true,"extensions":{"KHR_materials_unlit":{}},
  "pbrMetallicRoughness":{"baseColorFactor":[1,0,0,1]}},
 {"name":"green","extensions":{"KHR_materials_unlit":{}},
  "pbrMetallicRoughness":{"baseColorFactor":[0,0.5,0,1]}}],
"extensionsUsed":["KHR_materials_unlit"],
"meshes":[{"name":"quad","primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}]},
 {"name":"back","primitives":[{"attributes":{"POSITION":0},"indices":1,"material":1}]}],
"animations":[{"name":"slide","samplers":[{"input":2,"output":3}],
  "channels":[{"sampler":0,"target":{"node":1,"path":"translation"}}]},
 {"name":"spin","samplers":[{"input":2,"output":4}],
  "channels":[{"sampler":0,"target":{"node":1,"path":"rotation"}}]}],
"bufferViews":[
 {"buffer":0,"byteOffset":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":12},
 {"buffer":0,"byteOffset":60,"byteLength":8},{"buffer":0,"byteOffset":68,"byteLength":24},
 {"buffer":0,"byteOffset":92,"byteLength":32}],
"accessors":[
 {"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[-1,-1,0],"max":[1,1,0]},
 {"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"},
 {"bufferView":2,"componentType":5126,"count":2,"type":"SCALAR","min":[0],"max":[1]},
 {"bufferView":3,"componentType":5126,"count":2,"type":"VEC3"},
 {"bufferView":4,"componentType":5126,"count":2,"type":"VEC4"}],
END
# Corners, indices, two times, two places and two turns.
printf '"buffers":[{"byteLength":124,"uri":"data:application/octet-stream;base64,%s%s%s"}]}\n' \
    AACAvwAAgL8AAAAAAACAPwAAgL8AAAAAAACAPwAAgD8AAAAAAACAvwAAgD8AAAAA \
    AAABAAIAAAACAAMAAAAAAAAAgD8AAIDAAAAAAAAAAAAAAIBAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAIA/ \
    AAAAAAAAAADXs10/AAAAPw== >>"$base/in/plate.gltf"
plate=$base/in/plate.gltf
sed 's/"mode":4,//;s/"material":1}/"material":1},{"attributes":{"POSITION":0},"mode":0}/' "$plate" \
    >"$base/in/points.gltf"

# A textured quad; the texture is drawn below.
cat >"$base/in/card.obj" <<'END'
mtllib card.mtl
v -1 -1 0
v 1 -1 0
v 1 1 0
v -1 1 0
vt 0 0
vt 1 0
vt 1 1
vt 0 1
usemtl card
f 1/1 2/2 3/3 4/4
END
printf 'newmtl card\nKd 1 1 1\nmap_Kd card.png\n' >"$base/in/card.mtl"

small="--size 48x32 --fps 4 --reach 8"
moving="$plate $small --time 0.5"

# ------------------------------------------------------------------ files

claim "the scene's name names the default output" render "$plate" --size 32x24
claim "it lies in the current folder" exists plate.png
claim "the program says so" out_has '^wrote plate.png$'
claim "a built-in scene's slash becomes a dash" render builtin:demo/race --size 32x24
claim "the file is there" exists demo-race.png
rm -f plate.png demo-race.png
claim "statistics alone write no picture" render $moving --stats s.json
claim "no picture" [ ! -e plate.png ]
claim "repetitions alone write no picture" render $moving --repeat 2
claim "times are printed instead" out_has '^frame=0 total_us=[0-9.]* crc32=[0-9a-f]\{8\}$'
claim "no picture either" [ ! -e plate.png ]

for kind in png ppm pfm gif apng; do
    claim "writes .$kind" render $moving -o "out.$kind"
done
claim "PNG" starts_with out.png "211 120 116 107"
claim "PPM is P6" starts_with out.ppm "120 066 012"
claim "PFM in colour is PF" starts_with out.pfm "120 106 012"
claim "GIF" starts_with out.gif "107 111 106 070 071 141"
claim "APNG has PNG's signature" starts_with out.apng "211 120 116 107"
claim "APNG has an animation chunk" grep -c acTL out.apng
claim "endings may be capitals which changes nothing" drawn same out.ppm OUT.PPM $moving
claim "PPM header" equals "$(sed -n 2p out.ppm)" "48 32"
claim "PFM header" equals "$(sed -n 2,3p out.pfm | tr '\n' ' ')" "48 32 -1.0 "
claim "PFM has the bottom row first and codes / 255" equals \
    "$(pfm_value out.pfm 48 32 3 24 16 0 | awk '{ printf "%d", $1 * 255 + 0.5 }')" \
    "$(ppm_pixel out.ppm 48 24 16 | cut -d' ' -f1)"

claim "numbered files" render "$plate" $small --frames 1-3 -o 'f-%03d.ppm'
claim "first" exists f-001.ppm
claim "last" exists f-003.ppm
claim "no other" [ ! -e f-004.ppm ]
claim "frame i shows i / fps" same f-002.ppm out.ppm
claim "a pattern without width" render "$plate" $small --frames 2-3 -o 'g%d.ppm' --depth 'd%02d.pfm'
claim "has no zeros" exists g2.ppm
claim "patterns of other files" exists d02.pfm
claim "animations hold many frames" render "$plate" $small --frames 2-5 -o four.gif
claim "a true-colour one" render "$plate" $small --frames 2-5 -o four.apng
claim "and are larger than a single frame" is_true "$(wc -c <four.apng) > $(wc -c <out.apng)"
claim "A-A is one frame and fits a still file the same one" drawn same out.ppm one.ppm "$plate" $small --frames 2-2
claim "--option=value is --option value" drawn same out.ppm equals.ppm "$plate" --size=48x32 --fps=4 --time=0.5 --reach=8
cp "$plate" ./--odd.gltf
claim "-- ends the options" render $small --time 0.5 -o dashes.ppm -- --odd.gltf
claim "what follows is a file" same dashes.ppm out.ppm

# ------------------------------------------------------------------ defaults and the shutter

claim "written-out defaults" render "$plate" --size 320x240 --fps 30 --time 0 --clip 0 --camera 0 \
    --shutter 180 --exposure centred --poses previous --method auto --samples 8 --quality balanced \
    --reach 5% --tile 16 --shutter-mode native --light linear --filter nearest --clear 000000 \
    --format rgb888 --dither ordered --threads 1 -o written.ppm
claim "no options are the same" drawn same written.ppm nothing.ppm "$plate"
claim "the target of balanced is the default" drawn same out.ppm target.ppm $moving --target 1.5
turn="$plate $small --time 0.25 --clip spin"
claim "what auto aims at" render $turn --method accumulate --samples 256 -o truth.ppm
for quality in sketch draft balanced fine; do
    claim "--quality $quality" render $turn --quality $quality -o $quality.ppm
    run compare truth.ppm $quality.ppm
    eval "rmse_$quality=\$(value_of rmse)"
done
claim "fine is better than draft" is_true "$rmse_fine < $rmse_draft && $rmse_balanced <= $rmse_draft"
claim "the target of fine is fine" drawn same fine.ppm target.ppm $turn --target 0.5
claim "--target" render $moving --method reconstruct --target 0.5 -o target.ppm
claim "without a target does not change reconstruct" drawn same target.ppm reconstruct.ppm $moving --method reconstruct

# samples SCENE DEGREES: how many pixels of instants are drawn
samples() { render "builtin:$1" --size 160x120 --time 0.8 --poses shutter --shutter "$2" -o short.ppm --stats short.json && stat_of short.json samples; }
for scene in demo/race suite/dolly suite/pan suite/textured suite/near test/room; do
    whole=$(samples $scene 180) two_thirds=$(samples $scene 120) half=$(samples $scene 90)
    claim "$scene: less of an exposure takes no more" is_true "$two_thirds <= $whole && $half <= $two_thirds"
done

claim "--method none" render $moving --method none -o none.ppm
claim "--shutter 0 is none" drawn same none.ppm shut.ppm $moving --shutter 0
claim "--method auto is the default" drawn same out.ppm auto.ppm $moving --method auto
claim "--method reconstruct it blurs" drawn differ none.ppm reconstruct.ppm $moving --method reconstruct
claim "--method subframes" render $moving --method subframes -o subframes.ppm
claim "32 instants at most are the default" drawn same subframes.ppm instants.ppm $moving --method subframes --samples 32
claim "2 instants are fewer" drawn differ subframes.ppm instants.ppm $moving --method subframes --samples 2
claim "--method timemask" render $moving --method timemask -o timemask.ppm
claim "32 slots are the default" drawn same timemask.ppm slots.ppm $moving --method timemask --samples 32
claim "32 slots of a turn" render $turn --method timemask -o turn32.ppm
claim "8 slots are fewer" drawn differ turn32.ppm turn8.ppm $turn --method timemask --samples 8
for method in object layered; do
    claim "--method $method it blurs" drawn differ none.ppm $method.ppm $moving --method $method --stats $method.json
    claim "tiles are told" is_true "$(sed -n "s/.*\"$method\":\([0-9]*\).*/\1/p" $method.json) > 0"
    claim "with 3 threads the same" drawn same $method.ppm threads.ppm $moving --method $method --threads 3
    claim "of a masked node the same, for nothing else moves" drawn same $method.ppm masked.ppm $moving --method $method --mask plate
    claim "by its root's index the same again" drawn same $method.ppm masked.ppm $moving --method $method --mask 0
    claim "of one that opts out is the sharp frame" drawn same none.ppm calm.ppm $moving --method $method --motion plate=none
    claim "with a shutter of 0 too" drawn same none.ppm calm.ppm $moving --method $method --shutter 0
done
claim "--method accumulate it blurs, too" drawn differ none.ppm accumulate.ppm $moving --method accumulate
claim "8 instants are the default" drawn same accumulate.ppm eight.ppm $moving --method accumulate --samples 8
claim "one instant is the sharp frame" drawn same none.ppm first.ppm $moving --method accumulate --samples 1
claim "64 instants" render $moving --method accumulate --samples 64 -o many.ppm
claim "exact instants" render $moving --method accumulate --samples 64 --exact -o exact.ppm
run compare many.ppm exact.ppm
claim "of linear motion are as the library moves it" is_true "$(value_of rmse) < 1.5"
for method in "auto --quality fine" subframes timemask; do
    claim "$method of linear motion" render $moving --method $method -o timed.ppm
    run compare timed.ppm exact.ppm
    claim "is near the truth" is_true "$(value_of rmse) < 1.5"
    claim "$method with a shutter of 0 is none" drawn same none.ppm timed.ppm $moving --method $method --shutter 0
    claim "$method with a cut is none" drawn same none.ppm timed.ppm "$plate" $small --frames 2-2 --cut 2 --method $method
done
claim "exact instants of a turn differ from the sharp frame" drawn differ none.ppm turn.ppm "$plate" $small --clip spin --time 0.5 \
    --method accumulate --samples 32 --exact
claim "an exact frame that is cut is sharp" drawn same none.ppm exactcut.ppm "$plate" $small --clip slide --frames 2-2 --cut 2 \
    --method accumulate --exact
claim "an exact shutter of 0 is sharp" drawn same none.ppm exactshut.ppm $moving --method accumulate --exact --shutter 0
claim "fractions of a degree are rounded to whole ones" drawn same out.ppm rounded.ppm $moving --shutter 180.3
claim "a longer shutter blurs more" drawn differ out.ppm longer.ppm $moving --shutter 360

sed 's/"input":2,"output":3}/"input":2,"output":3,"interpolation":"STEP"}/' "$plate" >"$base/in/held.gltf"
claim "a held key" render "$base/in/held.gltf" $small --frames 4-4 -o held.ppm
claim "the same frame, cut is joined by no path" drawn same held.ppm cut.ppm "$base/in/held.gltf" $small --frames 4-4 --cut 4
exact="--method accumulate --exact --samples 16 --clip slide"
claim "an exposure around t" render $moving $exact -o centred.ppm
claim "one that ends at t are the same instants" drawn same centred.ppm trailing.ppm "$plate" $small $exact --exposure trailing --time 0.5625
claim "one that starts at t as well" drawn same centred.ppm leading.ppm "$plate" $small $exact --exposure leading --time 0.4375
for exposure in trailing leading; do
    claim "the filter's exposure may be $exposure" drawn differ out.ppm filter-$exposure.ppm $moving --exposure $exposure
done
turning="$plate $small --time 0.5 --clip spin --method accumulate"
claim "the pose a frame ago, joined by lines" render $turning --poses previous --path line -o previous.ppm
claim "and by a curve" render $turning --poses previous -o curve.ppm
claim "the poses of the shutter are different things for what turns" drawn differ previous.ppm poses.ppm $turning --poses shutter
claim "but a curve turns as evenly" same curve.ppm poses.ppm

for flag in fence corner box direction published box,published fence,corner,box,direction,published; do
    claim "--reconstruct $flag" render $moving --method reconstruct --reconstruct $flag -o "flag-$flag.ppm"
done
claim "a box is no tent" differ flag-box,published.ppm flag-published.ppm

# ------------------------------------------------------------------ what moves, what is seen

claim "clips by name" render "$plate" $small --time 0.25 --clip spin -o spin.ppm
claim "clips by index are the same" drawn same spin.ppm one.ppm "$plate" $small --time 0.25 --clip 1
turned="$plate $small --clip none --shutter 0"
claim "a camera that goes round" render $turned --frames 0-3 --orbit 1 -o round%d.ppm
claim "a quarter of the way" render $turned --orbit 0.25 -o quarter.ppm
claim "is there in the second of four frames" eval 'works compare round1.ppm quarter.ppm && is_true "$(value_of rmse) < 1"'
claim "and begins where it is without" eval 'render $turned -o begin.ppm && works compare round0.ppm begin.ppm && is_true "$(value_of rmse) < 1"'
claim "which is elsewhere" differ begin.ppm quarter.ppm
claim "no clip" render "$plate" $small --time 0.25 --clip none -o still.ppm --stats still.json
claim "holds still" equals "$(stat_of still.json still)" "$(stat_of still.json none)"
claim "all clips do both" drawn differ spin.ppm all.ppm "$plate" $small --time 0.25 --clip all
claim "clips stop at their end" render "$plate" $small --time 1.5 -o end.ppm
claim "and stay there without moving" drawn same end.ppm later.ppm "$plate" $small --time 7
claim "or loop from their start" drawn same out.ppm loop.ppm "$plate" $small --time 1.5 --loop

claim "cameras by name" render $moving --camera flat --method none -o flat.ppm
claim "cameras by index are the same" drawn same flat.ppm camera1.ppm $moving --camera 1 --method none
claim "and others are not" differ flat.ppm none.ppm
claim "an eye of one's own may be the file's" drawn same none.ppm eye.ppm $moving --eye 0,0,4 --look 0,0,0 --fov 90 --method none
claim "--fov has a default" render $moving --eye 0,0,4 --look 0,0,0 -o fov.ppm
claim "of 45 degrees indeed" drawn same fov.ppm fov45.ppm $moving --eye 0,0,4 --look 0,0,0 --fov 45

claim "a node without motion is not blurred" drawn same none.ppm calm.ppm $moving --motion plate=none --stats none.json
claim "nor with the camera's, which stands either" drawn same none.ppm calm.ppm $moving --motion plate=camera
claim "by index, and all below the same" drawn same none.ppm calm.ppm $moving --motion 0=none
claim "the last setting counts" drawn same out.ppm full.ppm $moving --motion root=none --motion plate=full
claim "a cut" render "$plate" $small --frames 1-3 --cut 2 -o 'cut%d.ppm'
claim "has no motion" same cut2.ppm none.ppm
claim "the frame before" same cut1.ppm f-001.ppm
claim "and the one after have" same cut3.ppm f-003.ppm

claim "clear colour" render $moving --clear 204060 --method none -o clear.ppm
claim "in the corner" equals "$(ppm_pixel clear.ppm 48 0 31)" "32 64 96"
claim "the plate is red" equals "$(ppm_pixel clear.ppm 48 24 16)" "255 0 0"
shade="$plate $small --time 0.5 --method none --light encoded --clear ffffff --eye 0,9,6 --look 0,-1,0"
claim "a shadow on the ground, away from the sun" render $shade --sun ffffff,0,1,1 --shadow planar -o shadow.ppm
claim "is as dark as the library's" equals "$(ppm_pixel shadow.ppm 48 24 11)" "140 140 140"
claim "and ends" equals "$(ppm_pixel shadow.ppm 48 18 11)" "255 255 255"
claim "as dark as asked for" eval 'render $shade --sun ffffff,0,1,1 --shadow planar,100 -o black.ppm &&
    equals "$(ppm_pixel black.ppm 48 24 11)" "0 0 0"'
claim "elsewhere with another sun" drawn differ shadow.ppm sun.ppm $shade --sun ffffff,1,1,1 --shadow planar
claim "it leaves distances alone" eval 'render $shade --depth bare.pfm -o bare.ppm &&
    render $shade --shadow planar,100 --depth shade.pfm -o black.ppm && same bare.pfm shade.pfm && differ bare.ppm black.ppm'
claim "a round one" render $shade --shadow blob -o blob.ppm
claim "is darker in the middle" eval 'set -- $(ppm_pixel blob.ppm 48 24 11) $(ppm_pixel blob.ppm 48 15 13) &&
    [ "$1" -lt "$4" ] && [ "$4" -lt 255 ]'
printf '{"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{}]}' >"$base/in/bare.gltf"
claim "none of nothing" render "$base/in/bare.gltf" $small --frames 1-1 --shadow blob -o bare.ppm
claim "shadows move" render $moving --clear ffffff --eye 0,9,6 --look 0,-1,0 --sun ffffff,0,1,1 --shadow planar -o slide.ppm
claim "as their things do" render $moving --clear ffffff --eye 0,9,6 --look 0,-1,0 --sun ffffff,0,1,1 --shadow planar \
    --method accumulate --exact --samples 64 -o shadows.ppm
claim "and are blurred" eval 'works compare slide.ppm shadows.ppm && is_true "$(value_of rmse) < 1"'
claim "light may be encoded which mixes darker" drawn differ out.ppm encoded.ppm $moving --light encoded
claim "a texture" render builtin:demo/race --size 16x16 -o "$base/in/card.png"
claim "nearest texels" render "$base/in/card.obj" --size 64x64 -o nearest.ppm
claim "bilinear texels are not the same" drawn differ nearest.ppm bilinear.ppm "$base/in/card.obj" --size 64x64 --filter bilinear

claim "a built-in scene has its size" render builtin:suite/translate -o builtin.ppm
works info builtin:suite/translate
claim "as told" equals "$(sed -n 2p builtin.ppm)" "$(sed -n 's/^size: //;1s/x/ /p' "$base/out")"
claim "which can be changed" render builtin:suite/translate --size 64x48 --time 0.1 --fps 24 \
    -o small.ppm
claim "to another" equals "$(sed -n 2p small.ppm)" "64 48"
run render "$base/in/points.gltf" $small -o points.ppm
claim "points are skipped" equals "$rc" 0
claim "with one warning" equals "$(wc -l <"$base/err" | tr -d ' ')" 1
claim "that names the file" err_has "^smear: .*points.gltf: warning: "

# ------------------------------------------------------------------ nothing is seen

# warns TEXT ARGUMENTS...: done, with one line that has the text
warns() {
    expected=$1
    shift
    run "$@"
    [ "$rc" -eq 0 ] && [ "$(wc -l <"$base/err")" -eq 1 ] && has "$base/err" "^smear: .*: warning: .*$expected"
}
# A triangle 2 wide about the middle, its front to the camera of `near`, which sees from 1 to 10 along -z. ARGUMENTS: members of its
# node, of its material, of the asset.
scene_of() {
    cat <<END
{"asset":{"version":"2.0"},"nodes":[{"mesh":0$1},{"name":"near","camera":0,"translation":[0,0,5]}],
"cameras":[{"type":"perspective","perspective":{"yfov":0.9,"znear":1,"zfar":10}}],
"materials":[{"pbrMetallicRoughness":{"baseColorFactor":[0,0,0,$2]}}],$3
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],"bufferViews":[{"buffer":0,"byteLength":36}],
"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AACAvwAAgL8AAAAAAACAPwAAgL8AAAAAAAAAAAAAgD8AAAAA"}]}
END
}
scene_of '' 1 >"$base/in/black.gltf"
claim "black on black says nothing" works render "$base/in/black.gltf" $small -o black.png
claim "nor does it to a viewer" works view "$base/in/black.gltf" $small --out null --frames 1
for case in 'behind the camera|,"translation":[0,0,7]' 'before its near plane|,"translation":[0,0,4.5]' \
    'beyond its far plane|,"translation":[0,0,-7]' 'beside its view|,"translation":[9,0,0]' 'turned away|,"rotation":[0,1,0,0]' \
    'too small|,"scale":[1e-4,1e-4,1]' 'too small|,"scale":[0,0,0]'; do
    scene_of "${case#*|}" 1 >"$base/in/unseen.gltf"
    for command in "render -o unseen.png" "render --method accumulate -o unseen.ppm" "render --exact --method accumulate -o unseen.pfm" \
        "view --out null --frames 1"; do
        claim "$command: ${case%|*}" warns "nothing is seen of 1 triangle: 1 is .*${case%|*}" ${command%% *} "$base/in/unseen.gltf" \
            $small ${command#* }
    done
done
scene_of '' 0 | sed 's/"pbrM/"alphaMode":"BLEND","pbrM/' >"$base/in/unseen.gltf"
claim "wholly transparent" warns "1 is wholly transparent" render "$base/in/unseen.gltf" $small -o unseen.png
scene_of ',"rotation":[0,1,0,0]' 1 >"$base/in/unseen.gltf"
claim "--double-sided shows backs" works render "$base/in/unseen.gltf" $small --double-sided --clear ffffff -o unseen.ppm
claim "so" is_true "$(ppm_bytes unseen.ppm | sort -nu | wc -l) > 1"
claim "in a viewer, too" works view "$base/in/unseen.gltf" $small --double-sided --out null --frames 1
claim "and converted" works convert "$base/in/unseen.gltf" --double-sided -o unseen.h
claim "of two frames" warns "in 2 of 2 frames, 3 the first, nothing is seen of 1 triangle" render "$base/in/unseen.gltf" $small --frames 3-4 \
    -o unseen%d.png
usage --double-sided render builtin:demo/drone --double-sided
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n' >"$base/in/out.obj"
cp "$base/in/out.obj" "$base/in/inwards.obj"
printf 'f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n' >>"$base/in/out.obj"
printf 'f 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n' >>"$base/in/inwards.obj"
claim "a solid of an OBJ" works render "$base/in/out.obj" $small -o unseen.png
claim "wound inwards" warns "faces are wound inwards" render "$base/in/inwards.obj" $small -o unseen.png
claim "in a viewer" warns "faces are wound inwards" view "$base/in/inwards.obj" $small --out null --frames 1
claim "--double-sided" works render "$base/in/inwards.obj" $small --double-sided -o unseen.png

# ------------------------------------------------------------------ depth and velocity

planes="$plate $small --time 0.5"
claim "depth and velocity leave the picture alone" drawn same out.ppm planes.ppm $planes --depth d.pfm --velocity v.pfm
claim "depth has one channel" starts_with d.pfm "120 146 012"
claim "velocity has three" starts_with v.pfm "120 106 012"
claim "depth in scene units" is_true "$(pfm_value d.pfm 48 32 1 24 16 0) - 4 < 0.004 &&
    4 - $(pfm_value d.pfm 48 32 1 24 16 0) < 0.004"
claim "a background of infinity" equals "$(pfm_value d.pfm 48 32 1 0 31 0)" inf
vx=$(pfm_value v.pfm 48 32 3 24 16 0)
vy=$(pfm_value v.pfm 48 32 3 24 16 1)
claim "velocity in pixels per frame" is_true "$vx > 7.96 && $vx < 8.04 && $vy < 0.02 && $vy > -0.02"
claim "a background of zero" equals "$(pfm_value v.pfm 48 32 3 0 31 0)" 0
claim "the third channel is zero" equals "$(pfm_value v.pfm 48 32 3 24 16 2)" 0
claim "the same by another method and exposure" render $planes --depth d2.pfm --velocity v2.pfm \
    --method none --exposure trailing --shutter 90 -o planes.ppm
claim "depth" same d.pfm d2.pfm
claim "velocity" same v.pfm v2.pfm
claim "velocity from open to close" render $planes --poses shutter --velocity v3.pfm -o planes.ppm
vx=$(pfm_value v3.pfm 48 32 3 24 16 0)
claim "is per frame, too" is_true "$vx > 7.96 && $vx < 8.04"
claim "of an exact frame, too" render $planes --method accumulate --exact --velocity v4.pfm \
    -o planes.ppm
claim "the same" same v.pfm v4.pfm
claim "orthographic depth" render $planes --camera flat --depth d4.pfm -o planes.ppm
claim "is in scene units" is_true "$(pfm_value d4.pfm 48 32 1 24 16 0) - 4 < 0.004 &&
    4 - $(pfm_value d4.pfm 48 32 1 24 16 0) < 0.004"

# ------------------------------------------------------------------ the device

claim "grey of 50 % is dithered" render $moving --clear 7f7f7f --format l1 -o l1.ppm
claim "to black and white" equals "$(ppm_bytes l1.ppm | sort -nu | tr '\n' ' ')" "0 255 "
claim "pages of 8 rows" render builtin:demo/race --size 45x30 --format l1pages -o pages.ppm
claim "hold the same picture" drawn same pages.ppm l1.ppm builtin:demo/race --size 45x30 --format l1
claim "diffused" render builtin:demo/race --size 45x30 --format l1 --dither diffuse -o diffused.ppm
claim "by cores in pages the same" drawn same diffused.ppm pages.ppm builtin:demo/race --size 45x30 --format l1pages --dither diffuse --threads 3
claim "not dithered" differ l1.ppm diffused.ppm
claim "doubled" render builtin:demo/race --size 45x30 --format l1 --double 2x1 -o doubled.ppm
claim "wider" equals "$(sed -n 2p doubled.ppm)" "90 30"
claim "the mean of both" equals "$(ppm_bytes doubled.ppm | awk '{ s += $1 } END { print s }')" \
    "$(ppm_bytes l1.ppm | awk '{ s += 2 * $1 } END { print s }')"
claim "exact frames, too" render builtin:demo/race --size 45x30 --double 2x2 --method accumulate --exact --samples 2 -o doubled.ppm
claim "are as large" equals "$(sed -n 2p doubled.ppm)" "90 60"
usage --dither render builtin:demo/race --dither diffuse
usage --dither render builtin:demo/race --format l1 --dither diffuse --keep-display
usage --double render builtin:demo/race --double 3x3
claim "16 greys" render builtin:demo/race --size 47x32 --format l4 -o l4.ppm
claim "are 17 apart" is_true "$(ppm_bytes l4.ppm | awk '{ s += $1 % 17 } END { print s + 0 }') == 0"
claim "256 greys" render builtin:demo/race --size 48x32 --format l8 -o l8.ppm
claim "rgb332" render builtin:demo/race --size 48x32 --format rgb332 -o rgb332.ppm
claim "has 4 blues" is_true "$(ppm_bytes rgb332.ppm | awk 'NR % 3 == 0' | sort -nu | wc -l) <= 4"
claim "rgb555" render $moving --clear 808080 --format rgb555 --dither none -o rgb555.ppm
claim "rounds both ways to nearest" equals "$(ppm_pixel rgb555.ppm 48 0 31)" "132 132 132"
claim "red stays red" equals "$(ppm_pixel rgb555.ppm 48 24 16)" "255 0 0"
claim "rgb565" render $moving --clear 808080 --format rgb565 --dither none -o rgb565.ppm \
    --stats le.json
claim "has a finer green" equals "$(ppm_pixel rgb565.ppm 48 0 31)" "132 130 132"
claim "high byte first" render $moving --clear 808080 --format rgb565be --dither none -o be.ppm \
    --stats be.json
claim "shows the same" same rgb565.ppm be.ppm
claim "and has other bytes" is_true "\"$(stat_of le.json crc32)\" != \"$(stat_of be.json crc32)\""
for dither in ordered blue none; do
    claim "--dither $dither" render builtin:demo/race --size 48x32 --format rgb332 \
        --dither $dither -o "dither-$dither.ppm"
    claim "rgb888 and --dither $dither" render $moving --dither $dither -o "full-$dither.ppm"
    claim "rgb888 is never dithered" same full-$dither.ppm out.ppm
done
claim "ordered is the default" same dither-ordered.ppm rgb332.ppm
claim "blue is another" differ dither-blue.ppm dither-ordered.ppm
claim "none a third" differ dither-none.ppm dither-ordered.ppm

claim "statistics leave the picture alone" drawn same out.ppm out2.ppm $moving --stats s.json
for key in frames frame time_s us submit raster reduce class blur merge convert total triangles in \
    drawn dropped split pixels samples tiles still uniform complex methods none accumulate \
    reconstruct subframes timemask arena_bytes crc32; do
    claim "statistics have $key" grep -c "\"$key\":" s.json
done
claim "pixels" equals "$(stat_of s.json pixels)" 1536
claim "triangles" equals "$(stat_of s.json in)" 4
claim "time" equals "$(stat_of s.json time_s)" 0.5
if command -v gzip >/dev/null; then
    claim "CRC-32 of red, green and blue" equals "$(stat_of s.json crc32)" \
        "$(tail -n +4 out.ppm | crc_of)"
    to565='{ v[NR % 3] = int($1 * (NR % 3 == 2 ? 63 : 31) / 255 + 0.5) }
           NR % 3 == 0 { w = v[1] * 2048 + v[2] * 32 + v[0]
                         printf "\\0%o\\0%o", w % 256, int(w / 256) }'
    claim "CRC-32 of RGB565, low byte first" equals "$(stat_of le.json crc32)" \
        "$(printf '%b' "$(ppm_bytes rgb565.ppm | awk "$to565")" | crc_of)"
fi
claim "statistics of several frames" render "$plate" $small --frames 3-5 --stats three.json
claim "are one object each" equals "$(grep -c '"frame":' three.json)" 3
if command -v python3 >/dev/null; then
    claim "they are JSON" python3 -c 'import json, sys; json.load(open(sys.argv[1]))' three.json
fi
claim "statistics of accumulate" render $moving --method accumulate --samples 4 --stats acc.json
claim "count its instants" equals "$(stat_of acc.json samples)" 6144
claim "statistics of an exact frame" render $moving --method accumulate --exact --samples 4 \
    --format l8 --stats acc.json -o acc.ppm
claim "as well" equals "$(stat_of acc.json samples)" 6144
claim "and its triangles" equals "$(stat_of acc.json in)" 16
claim "medians of the same picture" drawn same out.ppm five.ppm $moving --repeat 5 --stats five.json
claim "with the same CRC" equals "$(stat_of five.json crc32)" "$(stat_of s.json crc32)"
claim "medians of an exact frame" render $moving --method accumulate --exact --repeat 3 \
    --stats five.json

race="builtin:demo/race --size 96x64"
claim "one core" render $race -o core1.ppm --stats core1.json
for threads in 2 3 8; do
    claim "$threads cores" render $race --threads $threads -o core.ppm --stats core.json
    claim "draw the same" same core.ppm core1.ppm
    claim "to the last bit" equals "$(stat_of core.json crc32)" "$(stat_of core1.json crc32)"
done
kept="builtin:demo/race --size 96x64 --frames 0-7 --keep-display"
crcs_of() { grep -o '"crc32":"[0-9a-f]*' "$1"; }
claim "a display that keeps tiles" render $kept --stats kept1.json
claim "gets eight frames" equals "$(crcs_of kept1.json | wc -l)" 8
for threads in 2 3 8; do
    claim "$threads cores, each assembling a part" render $kept --threads $threads --stats kept.json
    claim "show the same" equals "$(crcs_of kept.json)" "$(crcs_of kept1.json)"
done
claim "several cores and sharp frames" render $race --threads 2 --method accumulate -o a2.ppm
claim "draw the same" drawn same a2.ppm a1.ppm $race --method accumulate

claim "an ample arena" render $race --arena 10000000 -o ample.ppm --stats ample.json
claim "changes nothing" same ample.ppm core1.ppm
claim "and is not filled" equals "$(stat_of ample.json arena_bytes)" \
    "$(stat_of core1.json arena_bytes)"
run render $race --arena 1000 -o no.ppm
claim "no room" equals "$rc" 1
claim "tells what is needed" err_has "^smear: builtin:demo/race: needs [0-9]* bytes"
claim "and draws nothing" [ ! -e no.ppm ]
need=$(sed -n 's/.* needs \([0-9]*\) bytes.*/\1/p' "$base/err")
claim "the least arena" render $race --arena "${need:-0}" -o least.ppm --stats least.json
claim "is all that is used" is_true "$(stat_of least.json arena_bytes) <= ${need:-0}"
run render $race --arena "$((${need:-1} - 1))" -o no.ppm
claim "one byte less is too little" equals "$rc" 1
parts=0
for more in 40000 120000 240000 280000 320000 360000; do
    render $race --arena "$((${need:-0} + more))" -o tight.ppm --stats tight.json
    [ "$(stat_of tight.json split)" -gt 0 ] && [ "$(stat_of tight.json dropped)" -eq 0 ] || continue
    parts=$((parts + 1))
    claim "a tight arena draws the same picture" same tight.ppm core1.ppm
done
claim "in parts" is_true "$parts > 0"

render $moving --method timemask -o mask.ppm
for tile in 8 16 32 64; do
    claim "--tile $tile does not change what blurs by time samples" drawn same mask.ppm tile.ppm $moving --tile $tile --method timemask
    render $moving --tile $tile -o tile.ppm
    works compare tile.ppm out.ppm
    claim "and auto's instants by little" is_true "$(value_of rmse) < 1.5"
done
for method in reconstruct subframes timemask; do
    claim "--method $method" render $moving --tile 64 --method $method --stats tile.json
    claim "one tile of 64" equals "$(stat_of tile.json $method)" 1
done
claim "no other method" equals "$(stat_of tile.json subframes)" 0
claim "a reach in pixels" render $moving --reach 4 -o reach4.ppm
claim "a reach of a share of the height" drawn same reach4.ppm reach12.ppm $moving --reach 12.5%
claim "the default reach is at most a tile" render "$plate" --size 64x240 --method reconstruct --tile 8 -o tile8.ppm
claim "as large as it so" drawn same tile8.ppm tile88.ppm "$plate" --size 64x240 --method reconstruct --tile 8 --reach 8
claim "tiles of 4" render "$plate" --size 64x48 --method reconstruct --tile 4 -o tile4.ppm
claim "1x1" warns "too small" render "$plate" --size 1x1 -o tiny.ppm
claim "2048 wide" render "$plate" --size 2048x1 -o wide.ppm
claim "2048 high" render "$plate" --size 1x2048 -o high.ppm

claim "statistics into a device" render $moving --stats /dev/null
claim "leave it one" [ -c /dev/null ]
mkfifo pipe
cat pipe >piped.json &
claim "statistics into a pipe" render $moving --stats pipe
wait
claim "arrive there" grep crc32 piped.json
ln -s linked.json link.json
claim "statistics through a link" render $moving --stats link.json
claim "arrive behind it" grep crc32 linked.json

# ------------------------------------------------------------------ compare

claim "equal pictures" works compare out.ppm out.png
claim "are equal" equals "$(tr '\n' ' ' <"$base/out")" \
    "rmse=0.000000 psnr=inf ssim=1.000000 flip=0.000000 "
claim "as floats, too" works compare out.pfm out.png
claim "exactly" out_has '^rmse=0.000000$'
claim "different pictures" works compare none.ppm out.png --diff diff.png
claim "have a difference" is_true "$(value_of rmse) > 1 && $(value_of psnr) < 50 &&
    $(value_of ssim) < 1 && $(value_of flip) > 0"
claim "to be looked at" exists diff.png
claim "of two equal ones" works compare out.ppm out.png --diff diff.ppm
claim "it is black" equals "$(ppm_bytes diff.ppm | sort -nu | tr '\n' ' ')" "0 "
claim "--gain" works compare none.ppm out.ppm --diff gain1.ppm --gain 1
claim "scales it" works compare none.ppm out.ppm --diff gain2.pfm --gain 2
for bad in "compare out.png" "compare" "compare a b c" "compare a b --diff d.jpg" \
    "compare a b --diff" "compare a b --gain 0" "compare a b --frob" "compare a b --diff d.gif" \
    "compare a b --diff %x.png"; do
    claim "bad usage: smear $bad" fails 2 '*' $bad
done
input missing.png compare missing.png missing.png
printf 'not a picture' >"$base/in/text.png"
input "$base/in/text.png" compare "$base/in/text.png" "$base/work/out.png"
input "$base/work/d.pfm" compare "$base/work/d.pfm" "$base/work/d.pfm"
input "$base/work/small.ppm" compare "$base/work/out.ppm" "$base/work/small.ppm"
input nowhere/d.png compare "$base/work/out.ppm" "$base/work/out.png" --diff nowhere/d.png

# ------------------------------------------------------------------ info and help

claim "info of a file" works info "$plate"
for line in '^nodes: 5$' '1 "plate" under 0, mesh 0' '^clips: 2$' '0 "slide" 1 s, 1 channels' \
    '^cameras: 2$' '0 "front" perspective, yfov 90, near 0.5, far 20' '1 "flat" orthographic' \
    '^materials: ' '"green" opaque' '^textures: 0$' '^meshes: 2$' '2 triangles, 4 vertices' \
    '^skipped primitives: 0$' '^bounds at 0 s: -5 -1 -2 to 3 2 0$' '^triangles: 4$' \
    '^memory at 320x240 (' '^memory at 240x240 (' '^  auto  *[0-9]* bytes: window 115200, ' \
    '^  auto, no window  *[0-9]* bytes: window 30720, ' '^  reconstruct  *[0-9]* bytes: window 112640, ' \
    '^  none  *[0-9]* bytes: window 30720, '; do
    claim "has $line" out_has "$line"
done
cp "$base/out" info.txt
for method in auto reconstruct; do
    need=$(sed -n "/^memory at 240x240/,\$s/^  $method  *\([0-9]*\) bytes.*/\1/p" info.txt)
    claim "memory as told for $method" render "$plate" --size 240x240 --format rgb565 --method $method \
        --arena "${need:-1}" --stats need.json
    claim "draws in one part" equals "$(stat_of need.json split)" 0
done
run info "$base/in/points.gltf"
claim "info counts what is skipped" out_has '^skipped primitives: 1$'
claim "info of a textured file" works info "$base/in/card.obj"
claim "has its size" out_has '0 16x16$'
claim "info of a built-in scene" works info builtin:suite/pan
claim "has its frame rate" out_has '^fps: '
instances=$here/tests/fuzz/corpus/gltf/instances
claim "info of instances" works info "$instances"
claim "counts them beside their node" out_has '^  0 "", mesh 0, 5 instances$'
claim "and their triangles" out_has '^triangles: 60$'
claim "they are converted" works convert "$instances" -o instances.h
claim "each of them" out_has '^draws: 5,'
claim "info for a board" works info builtin:suite/pan --board rp2040
claim "info names the board's memory" out_has '^  auto at 240x240 takes [0-9]* bytes of 204800$'
run info builtin:suite/pan --board fridge
claim "info knows no such board" has_failed 2 --board
claim "info of a desc" works info --desc width=240,height=240,methods=auto+none,format=rgb565be,bands=2,tile=8,strip=8
claim "prints the array" out_has '^static uint64_t memory\[[0-9]*\];    /. [0-9]* bytes'
claim "another desc takes another" works info --desc width=240,height=240,methods=none,reuse.one_pose=1,display.dither=blue
usage --desc info --desc width=240
usage --desc info --desc width=240,height=240,tiles=8
usage --desc info --desc width=240,height=240,methods=blur
usage --desc info --desc width=240,height=240,tile=5
usage --desc info --desc height=240
usage info info --desc width=240,height=240 "$plate"
claim "the built-in scenes" works info builtin:
claim "are listed" out_has '^builtin:demo/race '
usage info info
usage --frob info --frob "$plate"
usage b info a b
input missing.glb info missing.glb
input builtin:nosuch info builtin:nosuch

for command in render convert compare info bench chart help; do
    claim "help $command" works help $command
    claim "names it" out_has "smear $command"
    claim "$command --help" works $command --help
done
claim "help" works help
claim "lists commands" out_has 'smear compare A B'
claim "--help" works --help
claim "-h" works -h
works help render >/dev/null
for option in size fps time frames clip loop camera eye look fov filter clear sky shadow shutter exposure \
    poses method samples exact reconstruct quality target reach tile motion cut light format \
    dither arena threads repeat depth velocity stats; do
    claim "help knows --$option" out_has "--$option"
done
works help convert >/dev/null
for option in name clip keep scale fit up texture texture-size colors filter normals influences \
    clip-error rows fov distance max-triangles max-flash max-ram; do
    claim "help convert knows --$option" out_has "--$option"
done
usage nosuch help nosuch
usage compare help render compare

# ------------------------------------------------------------------ convert

claim "a header" works convert "$plate" -o plate.h
for line in '^triangles: 4$' '^vertices: 8 of 8$' '^clips: 2$' '  0 "slide" 1 s, 1 channels, 2 keys of 2' \
    '^flash: [0-9]* bytes (meshes ' '^ram: [0-9]* bytes an actor with 2 poses' \
    '^largest position error: 0\.0[0-9]* px, at rest 0\.0' '^wrote plate.h$'; do
    claim "has $line" out_has "$line"
done
claim "one of held keys" works convert "$base/in/held.gltf" -o held.h
claim "says so" out_has '^jumps: 1 that no blur joins; keys tell them, 0 bytes of flash and 24 '
claim "its names are the file's" grep -q '^static const smear_model plate_model = {$' plate.h
claim "a name of one's own" works convert "$plate" --name my_plate -o other.h
claim "is in the header" grep -q '^#define MY_PLATE_CLIP_SLIDE 0$' other.h
claim "a blob" works convert "$plate" -o plate.smr
claim "begins with SMR1" starts_with plate.smr "123 115 122 061"
claim "the same again" works convert "$plate" -o again.smr
claim "is the same" same plate.smr again.smr
claim "one clip" works convert "$plate" --clip spin -o spin.smr
claim "is another file" differ plate.smr spin.smr
claim "knows one clip" out_has '^clips: 1$'
claim "no clips" works convert "$plate" --clip none -o still.h
claim "knows none" out_has '^clips: 0$'
claim "nothing moves" out_has 'nodes: 0$'
usage --clip convert "$plate" --clip none --clip spin -o still.h
claim "which says why" has "$base/err" "none goes with no other --clip"
usage --clip convert "$plate" --clip spin --clip all -o still.h
claim "kept nodes" works convert "$plate" --clip none --keep wall --keep 1 -o kept.h
claim "are nodes" out_has 'nodes: 2$'
claim "a texture" works convert "$base/in/card.obj" --texture-size 8 -o card.h
claim "is shrunk" out_has '0 8x8 from 16x16, palette8, '
claim "rgb565" works convert "$base/in/card.obj" --texture rgb565 --filter bilinear -o card.h
claim "is said" out_has '0 16x16 from 16x16, rgb565, rms error '
claim "baked" works convert "$base/in/card.obj" --texture baked -o card.h
claim "has no texture" out_has '^textures: 0$'
claim "has colours" grep -q card_face_color_0 card.h
claim "everything at once" works convert "$plate" --scale 0.5 --up z --normals flat --influences 1 --colors 16 \
    --clip-error 1 --rows 64 --fov 30 --distance 9 --max-triangles 4 --max-flash 99999 --max-ram 9999 -o all.h
claim "says what a pixel is" out_has '(64 rows, 30 degrees, at 9 units)$'
claim "to a size" works convert "$plate" --fit 3 -o fit.h
# Letters of 2 x 3 pixels: whole, half and none, and a sprite of four colours.
printf 'P2 4 3 255\n255 0 0 255\n0 255 255 0\n255 0 0 128\n' >letters.ppm
claim "a font" works convert letters.ppm --cell 2x3 --font 65 -o letters.h
claim "a font's pixels" grep -q '0xf0, 0x0f, 0xf0, 0x0f, 0xf0, 0x08' letters.h
claim "a font's table" grep -q '(const uint32_t \*)0, 2, 3, 2, SMEAR_IMAGE_MASK4 }, 65, 0' letters.h
printf 'P3 3 1 255\n255 0 255 1 2 3 4 5 6\n' >sprite.ppm
claim "a sprite" works convert sprite.ppm --key ff00ff --name mark -o sprite.h
claim "a sprite's pixels" grep -q '0x01, 0x20' sprite.h
claim "a sprite's palette" grep -q '0x00000000u, 0xff010203u, 0xff040506u' sprite.h
printf '#include "letters.h"\n#include "sprite.h"\nint main(void) { return mark.width + letters.first - 68; }\n' >sprite.c
claim "fonts and sprites compile" "${CC:-cc}" -std=c99 -Wall -Wextra -Wpedantic -Werror -I"$here/include" -o sprite sprite.c
claim "and are what they were" ./sprite
input "$base/work/letters.ppm" convert "$base/work/letters.ppm" --cell 3x3 -o no.h
input "$base/work/letters.ppm" convert "$base/work/letters.ppm" --max-flash 5 -o no.h
usage -o convert "$base/work/letters.ppm" -o no.smr
usage --cell convert "$plate" --mask -o no.h
usage --cell convert "$base/work/letters.ppm" --cell 0x3 -o no.h
usage --key convert "$base/work/letters.ppm" --key red -o no.h
usage --font convert "$base/work/letters.ppm" --font A -o no.h
input "$plate" convert "$plate" --max-triangles 3 -o no.h
claim "says how many there are" err_has 'has 4 triangles, more than 3 (--max-triangles)'
input "$plate" convert "$plate" --max-flash 100 -o no.h
claim "says what takes it" err_has 'bytes of flash (meshes [0-9]*, textures 0, animation [0-9]*), more than 100'
input "$plate" convert "$plate" --max-ram 100 -o no.h
claim "says how much" err_has 'bytes of RAM with 2 poses, more than 100'
input "$plate" convert "$plate" --scale 1e4 -o no.h
claim "says that it is too large" err_has 'reaches .* units, more than 30000: use --scale or --fit'
input missing.glb convert missing.glb -o no.h
input '""' convert '' -o no.h
input builtin:demo/race convert builtin:demo/race -o no.h
claim "says why" err_has "built-in scenes"
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 2\n' >"$base/in/line.obj"
for output in no.h no.smr; do
    input "$base/in/line.obj" convert "$base/in/line.obj" -o $output
    claim "says that there is nothing to draw" err_has "nothing to draw"
done
input nowhere/x.h convert "$plate" -o nowhere/x.h
usage convert convert
usage convert convert "$plate"
usage -o convert "$plate" -o out.c
usage two convert one two -o x.h
usage --frob convert "$plate" --frob -o x.h
usage --clip convert "$plate" --clip nosuch -o x.h
usage --clip convert "$plate" --clip spin --clip 1 -o x.h
usage --keep convert "$plate" --keep nosuch -o x.h
usage --name convert "$plate" --name 3d -o x.h
usage --name convert "$plate" --name Fox -o x.h
for wrong in "--scale 0" "--scale -1" "--scale nan" "--fit 0" "--up x" "--texture png" "--texture-size 0" \
    "--texture-size 5000" "--colors 1" "--colors 257" "--filter cubic" "--normals smooth" "--influences 5" \
    "--influences 0" "--clip-error 0" "--rows 0" "--fov 180" "--distance 0" "--max-triangles 0" "--max-flash x"; do
    usage "${wrong% *}" convert "$plate" $wrong -o x.h
done

# ------------------------------------------------------------------ bad usage

claim "the version" works --version
claim "is that of the packages" out_has "^smear $(cd "$here" && sh tools/dist/version.sh)\$"
usage more --version more
claim "-v is the same" eval 'works -v && out_has "^smear [0-9]"'
# means GUESS ARGUMENTS...: bad usage or input, in one line that says what was meant
means() {
    meant=$1
    shift
    run "$@"
    [ "$rc" -ne 0 ] && [ "$(wc -l <"$base/err")" -eq 1 ] && err_has "did you mean \"*$meant\"*?"
}
claim "a misspelt command" means render rendr
claim "two letters swapped" means convert cnovert
claim "a misspelt option" means --frames render "$plate" --frmes=0-1
claim "of the viewer" means --zoom view --zom 2
claim "of render in the viewer" means --method view --metod none
claim "a misspelt scene" means builtin:demo/race info builtin:demo/rase
claim "a misspelt clip" means slide render "$plate" --clip slid
claim "a misspelt shadow" means planar render "$plate" --shadow plannar
claim "a misspelt node" means plate render "$plate" --motion palte=none
claim "what is like nothing" eval 'run frobnicate; ! err_has "did you mean"'
claim "info says what a desc has that says nothing" eval \
    'run info "$plate" && [ "$(grep -c "what a smear_desc has that says no methods$" "$base/out")" -eq 2 ]'
usage frobnicate frobnicate
usage --frob chart --frob
usage --scenes chart --scenes nosuch
usage --methods chart --methods nosuch
usage --jobs chart --jobs
usage --jobs chart --jobs 0
input nosuch.csv chart --from nosuch.csv
: >"$base/in/empty.csv"
input "$base/in/empty.csv" chart --from "$base/in/empty.csv"
claim "says that no line is there" err_has "no line of a chart"
usage nosuch bench nosuch
usage render render
usage two render one two
usage --frob render "$plate" --frob
usage -x render "$plate" -x
usage -oout.png render "$plate" -oout.png
usage --orbit render "$plate" --orbit 0
usage --orbit render "$plate" --orbit 101
usage --size render "$plate" --size
usage --loop render "$plate" --loop=yes
bad --size 0x10 10x0 -1x10 2049x10 10x2049 10 10x 10x10x ax10 10x10z 1e1x10 '' ' 10x10' 99999999999999999999x1
bad --fps 0 -1 nan inf -inf 30x '' 1e99 0x10 ' 30' + .
bad --time -1 nan inf 1s '' 1e99
for frames in 1 1- -3 3-1 a-b 1-2-3 -1-2 1.5-2 '' 1-99999999999; do
    usage --frames render "$plate" --frames "$frames" -o '%d.png'
done
usage --frames render "$plate" --frames 7 -o 7.png
claim "which says how to ask for one" has "$base/err" "7-7 is frame 7 alone"
bad --shutter -1 nan inf 3601 180deg ''
bad --samples 0 -1 nan 1.5 65537 8x ''
usage --samples render "$plate" --samples 1025
bad --reach 0 -1 nan 0% -5% 'nan%' '%' 12px 1.5 101% ''
usage --reach render "$plate" --reach 65
usage --reach render "$plate" --reach 17 --tile 16
usage --tile render "$plate" --method auto --tile 4
claim "time masks have room" render builtin:test/ortho --size 8x8 --tile 8 --method timemask -o room.ppm
usage --edges render "$plate" --method timemask --edges smooth
usage --edges render "$plate" --edges soft
usage --edges render "$plate" --edges smooth --keep-display
claim "smooth edges without a shutter" render builtin:suite/cross --size 64x48 --shutter 0 --edges smooth -o edges.ppm
claim "hard edges without a shutter smooth edges are others than hard ones" drawn differ edges.ppm sharp.ppm builtin:suite/cross \
    --size 64x48 --shutter 0
usage --reach render "$plate" --reach 50%
bad --tile 0 2 12 128 16.0 -8 ''
bad --target 0 -1 nan inf 256 ''
bad --clear fff 0000000 '#00000' 00000g -00000 ''
bad --shadow '' round blob, blob,0 planar,101 planar,x ,45
usage --shadow render builtin:suite/cross --shadow blob
input "$plate" render "$plate" --sun ffffff,1,-1,0 --shadow planar
bad --arena 0 -1 1.5 64k nan ''
bad --threads 0 9 -1 two ''
bad --repeat 0 -1 1.5 ''
bad --cut -1 x 1.5 ''
for vector in 1,2 1,2,3,4 a,b,c 1,,3 nan,0,0 0,0,inf '' '1, 2,3'; do
    usage --eye render "$plate" --eye "$vector" --look 0,0,0
    usage --look render "$plate" --eye 9,9,9 --look "$vector"
done
for fov in 0 -1 180 nan ''; do
    usage --fov render "$plate" --eye 0,0,4 --look 0,0,0 --fov "$fov"
done
for option in --exposure --poses --method --quality --light --filter --format --dither \
    --shutter-mode --reconstruct; do
    usage $option render "$plate" $option frob
    usage $option render "$plate" $option ''
done
usage --reconstruct render "$plate" --reconstruct fence,
usage --reconstruct render "$plate" --reconstruct fence,frob
usage --inside render "$plate" --inside mean
usage --inside render "$plate" --method camera --inside gauss
usage --camera-step render "$plate" --method camera --camera-step 3
usage --camera-step render "$plate" --method timemask --camera-step 2
usage --pingpong render "$plate" --pingpong taps=8
for list in taps=1 taps=65 passes=0 passes=4 base=1 bias=0 bias=256 jitter=2 jitter=nan frob frob=1 taps taps=8, =; do
    usage --pingpong render "$plate" --method pingpong --pingpong "$list"
done
usage --reconstruct render "$plate" --method camera --reconstruct fence
for method in camera "camera --camera-step 4 --inside reconstruct --reconstruct fence,box" \
    "camera --inside pingpong --pingpong passes=3,taps=4,base=4,bias=255,jitter=0.5,spread" \
    "pingpong --camera-step 2" "reconstruct --camera-step 1"; do
    claim "draws with --method $method" render builtin:suite/pan --size 64x48 --method $method -o filter.png
done
usage --mask render "$plate" --mask plate
claim "says where it belongs" err_has "object and layered"
for mask in '' , plate, ,plate nosuch 99 -1 plate=none; do
    usage --mask render "$plate" --method object --mask "$mask"
done
usage --mask render builtin:suite/still --method layered --mask plate
usage --shutter-mode render "$plate" --shutter-mode frob
usage --shutter-mode render "$plate" --shutter-mode fixed:
usage --shutter-mode render "$plate" --shutter-mode capped:30
for value in 0s 2s 1001ms -1ms nans s ms 10us; do usage --shutter render "$plate" --shutter $value; done
for value in turn turn=64 way=-1 turn=nan frob=1 =1 way=1, ''; do usage --scale render "$plate" --scale "$value"; done
usage --scale render "$plate" --method accumulate --exact --scale turn=2
usage --weights render "$plate" --weights gauss --method reconstruct
usage --weights render "$plate" --weights guertin --method camera
for weights in mcguire guertin jimenez; do
    claim "draws with the weights of $weights" render builtin:suite/cross --size 64x48 --method reconstruct \
        --weights $weights -o $weights.png
done
claim "weights differ" differ mcguire.png guertin.png
claim "a shutter in seconds" render builtin:suite/cross --size 64x48 --fps 30 --shutter 16.6667ms -o seconds.png
claim "is that in degrees of the same length" drawn same seconds.png degrees.png builtin:suite/cross --size 64x48 --fps 30 --shutter 180
claim "at 10 Hz, fixed" render builtin:suite/cross --size 64x48 --fps 10 --shutter-mode fixed --poses shutter -o fixed.png
claim "it is as at 30 Hz bit for bit" drawn same fixed.png native.png builtin:suite/cross --size 64x48 --fps 30 --poses shutter
claim "capped, too bit for bit" drawn same native.png capped.png builtin:suite/cross --size 64x48 --fps 10 --shutter-mode capped --poses shutter
claim "at 60 Hz, fixed at 60" render builtin:suite/cross --size 64x48 --fps 60 --shutter-mode fixed:60 -o fixed.png
claim "it is native bit for bit" drawn same fixed.png native.png builtin:suite/cross --size 64x48 --fps 60
claim "capped does not lengthen bit for bit" drawn same native.png capped.png builtin:suite/cross --size 64x48 --fps 60 --shutter-mode capped
claim "no motion of objects" render builtin:suite/cross --size 64x48 --scale objects=0 -o scaled.png
claim "is the sharp frame before a still camera" drawn same scaled.png sharp.png builtin:suite/cross --size 64x48 --shutter 0
claim "no motion of the camera" render builtin:suite/pan --size 64x48 --scale turn=0,way=0 -o scaled.png
claim "is the sharp frame of what stands still" drawn same scaled.png sharp.png builtin:suite/pan --size 64x48 --shutter 0
usage --shutter-mode render "$plate" --shutter-mode fixed:0

claim "what stands still is drawn in every frame" render builtin:suite/arena --size 64x48 --frames 0-3 -o drawn%d.png
claim "or kept" render builtin:suite/arena --size 64x48 --frames 0-3 --keep-still -o kept%d.png
claim "the pictures are the same" same drawn3.png kept3.png
claim "in a scene without motion of the camera" render builtin:suite/cross --size 64x48 --frames 0-3 -o drawn%d.png
claim "likewise" render builtin:suite/cross --size 64x48 --frames 0-3 --keep-still -o kept%d.png
claim "they are the same, too" same drawn3.png kept3.png
claim "or where a display keeps its picture" render builtin:suite/cross --size 64x48 --frames 0-3 --keep-display --stats kept.json -o kept%d.png
claim "which shows the same" same drawn3.png kept3.png
claim "and is not sent all" grep -q '"kept":[1-9]' kept.json
claim "frames that are sent whole" render builtin:suite/cross --size 64x48 --frames 0-3 --format l4 --stats drawn.json -o drawn%d.png
claim "have the CRCs" render builtin:suite/cross --size 64x48 --frames 0-3 --format l4 --keep-display --stats kept.json -o kept%d.png
crcs() { grep -o '"crc32":"[0-9a-f]*"' "$1"; }
same_crcs() { [ -n "$(crcs "$1")" ] && [ "$(crcs "$1")" = "$(crcs "$2")" ]; }
claim "of those that are not" same_crcs drawn.json kept.json
claim "what stands still counts as kept" render builtin:suite/cross --size 64x48 --frames 0-3 --keep-still --stats kept.json -o kept%d.png
claim "with statistics, too" grep -q '"static_cached":1' kept.json
claim "a budget makes it coarser" render builtin:suite/cross --size 64x48 --quality fine --budget 1 --tile 16 -o kept3.png
claim "as coarse as a draft which it is" drawn same kept3.png drawn3.png builtin:suite/cross --size 64x48 --quality draft --tile 16
usage --budget render "$plate" --budget 0
usage --budget render "$plate" --budget 10 --method subframes
usage --keep-still render "$plate" --keep-still --method reconstruct
usage --keep-display render "$plate" --keep-display --method reconstruct
sharp="builtin:demo/drone --method none --size 96x64 --frames 0-5"
claim "sharp frames that are sent whole" render $sharp -o drawn%d.png
claim "and where a display keeps its picture" render $sharp --keep-display --stats kept.json -o kept%d.png
claim "show the same" same drawn5.png kept5.png
claim "for less" grep -q '"kept":[1-9]' kept.json

usage --time render "$plate" --time 1 --frames 0-0
usage --exact render "$plate" --exact
usage --exact render "$plate" --exact --method none
usage --motion render "$plate" --exact --method accumulate --motion plate=none
usage --reconstruct render "$plate" --method none --reconstruct box
usage --reconstruct render "$plate" --reconstruct box
usage --target render "$plate" --quality fine --target 1
usage --eye render "$plate" --eye 1,2,3
usage --look render "$plate" --look 1,2,3
usage --fov render "$plate" --fov 45
usage --camera render "$plate" --camera 0 --eye 1,2,3 --look 0,0,0
usage --look render "$plate" --eye 1,2,3 --look 1,2,3
usage --clip render "$plate" --clip nosuch
usage --clip render "$plate" --clip 2
usage --camera render "$plate" --camera nosuch
usage --camera render "$plate" --camera 2
bad --motion plate plate=frob =none nosuch=none 5=none ''
for option in '--clip 0' --loop '--camera 0' '--eye 1,2,3 --look 0,0,0' '--filter nearest' \
    '--motion a=none'; do
    usage "${option%% *}" render builtin:suite/still $option
done
for name in out.jpg out out. .png png 'out.png.' '%d%d.png' '%x.png' '%4d.png' '%00d.png' \
    '%0d.png' '%' '%%.png' '%s.png' '%0.png' '%-3d.png' '%.gif' '%d.gif' '%04d.apng' ''; do
    usage -o render "$plate" -o "$name"
done
usage -o render "$plate" --frames 0-1 -o out.png
usage -o render "$plate" --frames 0-1
usage --depth render "$plate" --frames 0-1 -o out.gif --depth d.pfm
usage --velocity render "$plate" --frames 0-1 -o out.gif --velocity v.pfm
usage --depth render "$plate" --depth d.png
usage --velocity render "$plate" --velocity v.gif
usage same.pfm render "$plate" -o same.pfm --depth same.pfm
usage --stats render "$plate" --stats ''

# ------------------------------------------------------------------ bad input

input missing.glb render missing.glb
input builtin:nosuch render builtin:nosuch
input builtin: render builtin: -o x.png
mkdir "$base/in/folder.glb"
input "$base/in/folder.glb" render "$base/in/folder.glb"
: >"$base/in/empty.gltf"
input "$base/in/empty.gltf" render "$base/in/empty.gltf"
head -c 700 "$plate" >"$base/in/half.gltf"
input "$base/in/half.gltf" render "$base/in/half.gltf"
printf 'v 0 0 0\nf 1 2 3\n' >"$base/in/bad.obj"
input "$base/in/bad.obj" render "$base/in/bad.obj"
printf 'glTF\002\000\000\000\377\377\377\377' >"$base/in/short.glb"
input "$base/in/short.glb" render "$base/in/short.glb"
odd=$(printf 'two\nlines.glb')
claim "a file name of two lines is one in the error" fails 1 'two?lines.glb' render "$odd"
input nowhere/out.png render "$plate" -o nowhere/out.png
input nowhere/out.gif render "$plate" -o nowhere/out.gif
input nowhere/s.json render "$plate" --stats nowhere/s.json
input nowhere/d.pfm render "$plate" --stats /dev/null --depth nowhere/d.pfm
input nowhere/v.pfm render "$plate" --stats /dev/null --velocity nowhere/v.pfm
# What is read is never replaced, and nothing is written twice, whatever it is called.
cp -r "$base/in" "$base/before"
cp out.ppm "$base/in/other.ppm"
cp out.ppm "$base/in/picture.ppm"
ln -s "$plate" "$base/in/link.json"
usage "$base/in/card.png" render "$base/in/card.obj" -o "$base/in/card.png"
claim "says why" err_has "it has been read, and would be lost"
ln "$base/in/card.png" "$base/in/card7.png"
usage "$base/in/card%d.png" render "$base/in/card.obj" --frames 6-8 -o "$base/in/card%d.png"
rm "$base/in/card7.png"
usage "$base/in/card.mtl" render "$base/in/card.obj" --stats "$base/in/card.mtl"
usage "$plate" render "$plate" --stats "$plate"
usage "$base/in/link.json" render "$plate" --stats "$base/in/link.json"
usage "$plate" view "$plate" --out null --frames 1 --record "$plate"
usage "$plate" view "$plate" --out null --frames 1 --check "$plate" --update
claim "keeps no picture" missing "$plate.0000.png"
ln "$plate" "$base/in/model.h"
usage "$base/in/model.h" convert "$plate" -o "$base/in/model.h"
rm "$base/in/model.h"
for picture in picture other; do
    usage "$base/in/$picture.ppm" compare "$base/in/picture.ppm" "$base/in/other.ppm" --diff "$base/in/$picture.ppm"
    claim "it is as it was" same out.ppm "$base/in/$picture.ppm"
done
claim "another name beside it is free" works compare "$base/in/picture.ppm" "$base/in/other.ppm" --diff "$base/in/diff.ppm"
for name in plate.gltf card.obj card.mtl card.png; do claim "$name is as it was" same "$base/before/$name" "$base/in/$name"; done
usage ./same.pfm render "$plate" -o same.pfm --depth ./same.pfm
usage ../empty/same.pfm render "$plate" -o same.pfm --velocity ../empty/same.pfm
usage ./s%04d.pfm render "$plate" --frames 999-1000 -o s%d.pfm --depth ./s%04d.pfm
usage f1.png render "$plate" --frames 0-2 -o f%d.png --stats f1.png
usage f1%d.pfm render "$plate" --frames 0-12 -o f%d.pfm --velocity f1%d.pfm
ln -s e.png "$base/in/e.json"
usage "$base/in/e.json" render "$plate" -o "$base/in/e.png" --stats "$base/in/e.json"
printf 'old\n' >"$base/in/one.png"
ln "$base/in/one.png" "$base/in/two.json"
usage "$base/in/two.json" render "$plate" -o "$base/in/one.png" --stats "$base/in/two.json"
claim "what is there stays" equals "$(cat "$base/in/one.png")" old
rm "$base/in/e.json" "$base/in/one.png" "$base/in/two.json"
(cd . && "$smear" render "$plate" -o own.png --stats - >own.png 2>"$base/err")
claim "standard output that is an output" equals "$? $(wc -c <own.png | tr -d ' ')" "2 0"
rm -f own.png
printf '0 key q\n' >"$base/in/played"
usage "$base/in/played" view "$plate" --out null --frames 1 --play "$base/in/played" --record "$base/in/played"
usage list view "$plate" --out null --frames 1 --check list --update --record list
usage list.0001.png view "$plate" --out null --frames 2 --check list --update --record list.0001.png
rm "$base/in/played"
claim "other folders, same names" render "$plate" $small -o "$base/in/same.pfm" --depth same.pfm
mkdir "$base/in/there.png"
input "$base/in/there.png" render "$plate" -o "$base/in/there.png"
mkfifo "$base/in/pipe.h" "$base/in/pipe.ppm" "$base/in/pipe.gif" "$base/in/pipe"
input "$base/in/pipe.h" convert "$plate" -o "$base/in/pipe.h"
input "$base/in/pipe.ppm" compare "$base/work/out.ppm" "$base/work/out.ppm" --diff "$base/in/pipe.ppm"
input "$base/in/pipe.gif" render "$plate" --frames 0-1 -o "$base/in/pipe.gif"
input "$base/in/pipe" view "$plate" --frames 1 --check "$base/in/pipe" --update
input "$base/in/pipe" view "$plate" --frames 1 --crc --record "$base/in/pipe"
claim "what is no regular file stays" [ -p "$base/in/pipe.h" -a -p "$base/in/pipe.ppm" -a -p "$base/in/pipe.gif" -a -p "$base/in/pipe" ]
if [ -c /dev/full ]; then
    input /dev/full render "$plate" --stats /dev/full
    "$smear" help >/dev/full 2>"$base/err"
    claim "a full disk is an error" equals "$? $(cat "$base/err")" \
        "1 smear: standard output: cannot be written (No space left on device)"
fi
# A disk that is full after the first 512 bytes.
for args in "render builtin:suite/pan -o full.png" "render $plate -o full.pfm" "render $plate --frames 0-1 -o full.gif" \
    "render $plate --frames 0-1 -o full.apng" "convert $plate -o full.h" "convert $plate -o full.smr"; do
    mkdir "$base/full"
    (cd "$base/full" && trap '' XFSZ && ulimit -f 1 && exec "$smear" $args) >/dev/null 2>"$base/err"
    claim "no room for $args" equals "$? $(ls -A "$base/full" | wc -l) $(wc -l <"$base/err")" "1 0 1"
    rm -rf "$base/full"
done
# A run that is ended leaves nothing. Those that last a minute are ended when they have begun to write.
begun() { ls -A "$1" | grep -q '^\.smear-.*\.tmp$'; }
ended_by() { # SIGNAL ARGUMENTS...
    signal=$1
    rm -rf "$base/empty" && mkdir "$base/empty" && cd "$base/empty" || return 1
    shift
    # who starts this suite may have signals ignored (nohup does)
    default=
    ! env --default-signal="$signal" true 2>"$base/err" || default="env --default-signal=$signal"
    # shellcheck disable=SC2086
    $default "$smear" "$@" >"$base/out" 2>"$base/err" </dev/null &
    process=$!
    cd "$base/work" || return 1
    wait_for 30 begun "$base/empty"
    kill -s "$signal" "$process"
    wait "$process"
    [ $? -gt 128 ] || { echo "not ended: $(cat "$base/err")"; return 1; }
    equals "$(ls -A "$base/empty")" ""
}
for signal in TERM HUP PIPE; do
    claim "an animation ended by $signal" ended_by $signal render builtin:demo/race --frames 0-2000 -o x.gif
done
claim "statistics ended" ended_by TERM render builtin:demo/race --frames 0-2000 --stats x.json
claim "no failed run has touched what was there" [ -d "$base/in/there.png" ]
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\n' >"$base/in/vertices.obj"
run render "$base/in/vertices.obj" --size 16x16 -o empty.ppm
claim "nothing to draw is a picture of the background, or one line" [ "$rc" -le 1 ]
cp out.ppm kept.ppm
run render "$plate" --arena 10 -o kept.ppm
claim "a failed run leaves the old picture" same kept.ppm out.ppm
claim "and no unfinished files" equals "$(ls -A | grep -c '\.tmp$')" 0

finish
