#!/bin/sh
# SPDX-License-Identifier: MIT
# did_you_mean.sh - names that smear does not know: the line says what is wrong with which, and the nearest that there is.
#
#     sh tests/shell/did_you_mean.sh build/smear
#
# Prints each claim that does not hold and, last, `N passed, N failed`.

. "$(dirname "$0")/lib.sh"
of_program "$@"
in_passing did-you-mean
arm=$here/tests/data/arm.gltf
cd "$base" || exit 1

# says LINE ARGUMENTS...: bad usage, and all that is said is this line
says() {
    line=$1
    shift
    run "$@"
    equals "$rc $(cat "$base/err")$(cat "$base/out")" "2 smear: $line"
}

# means NAME SUBJECT ARGUMENTS...: bad usage of the subject, for which the line names the one that is near
means() {
    name=$1
    subject=$2
    shift 2
    run "$@"
    has_failed 2 "$subject" && has "$base/err" "did you mean $name?"
}

# ------------------------------------------------------------------ fields of a smear_desc

desc() { # WRONG TEXT
    claim "--desc $2" says "--desc: $1 (\"$2\")" info --desc "$2"
}
desc "wdth is no field of smear_desc; did you mean width?" wdth=3
desc "methds is no field of smear_desc; did you mean methods?" width=8,methds=none
desc "buffers is no field of smear_desc" buffers=2
desc "width needs a number from 0 to 32767" width=99999
desc "bands needs a number from 0 to 255" width=240,bands=256
desc "max_draws needs a number from 0 to 32767" max_draws=-1
desc "max_triangles needs a number from 0 to 2147483647" max_triangles=2147483648
desc "height needs a number from 0 to 32767" height=many
desc "width needs an equals sign and a value" width
desc "width needs a value" width=
desc "format needs rgb888, rgb565, rgb565be, rgb555, rgb332, l8, l4, l1 or l1pages; did you mean rgb565?" format=rgb65
desc "display.dither needs ordered, none, blue or diffuse; did you mean blue?" display.dither=bleu
claim "a method of --desc" means reconstruct --desc info --desc width=240,methods=none+recnstruct
claim "names what there is" has "$base/err" "methods: there is no recnstruct, but none, .* or auto, and accumulate_bands"
claim "many methods are read" works info --desc width=240,height=240,methods=none+accumulate+reconstruct+subframes+timemask
claim "what smear_init refuses" says "--desc: desc.width: not 1 to 2048" info --desc width=32767,height=8
# ------------------------------------------------------------------ everything else

claim "a command to be helped with" means render rendr help rendr
claim "the version" means --version --versoin --versoin
claim "an option of info" means --board --bord info --bord rp2040
claim "of compare" means --diff --dif compare --dif x
claim "of chart" means --scenes --scnes chart --scnes arena
claim "an option without its value" says "--scenes: needs a value" chart --scenes
claim "a report" means peers pers bench pers
claim "a scene of the chart" means arena --scenes chart --scenes roll,aren
claim "a setting of the chart" means "auto fine" --methods chart --methods auto-fien
claim "a board" means rp2040 --board view --board rp240
claim "a board of info" means rp2040 --board info --board rp240 "$arm"
claim "names all boards" has "$base/err" "there is oled, .* fb320"
claim "a method" means timemask --method render "$arm" --method timemaks
claim "a method of the left half" means timemask --split view --split timemaks
claim "a format" means rgb565be --format render "$arm" --format rgb565eb
claim "a quality" means balanced --quality render "$arm" --quality balancd
claim "a part of a list" means corner --reconstruct render "$arm" --method reconstruct --reconstruct fence,croner
claim "a screen" means term --out view --out trem
claim "a kind of texture" means palette8 --texture convert "$arm" -o x.h --texture palete8
claim "what is like no name" says '--light: needs linear or encoded ("bright")' render "$arm" --light bright
claim "no near name of an option before" says '--fov: needs degrees from 0.01 to 179 ("x")' render "$arm" --light linear --fov x

finish
