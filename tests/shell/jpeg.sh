#!/bin/sh
# SPDX-License-Identifier: MIT
# jpeg.sh - JPEG textures: wherever a model may have a PNG it may have a JPEG, and shows the same; and what is read of files
# that libjpeg's cjpeg has packed is what its djpeg unpacks, to 2 codes.
#
#     sh tests/shell/jpeg.sh build/smear build/host/jpeg-files textures
#     sh tests/shell/jpeg.sh build/smear build/host/jpeg-files libjpeg [COUNT]      needs cjpeg, djpeg

. "$(dirname "$0")/lib.sh"
of_program "$1"
files=$(absolute "${2:-}")
part=${3:-textures}
count=${4:-240}
pictures=$(absolute tests/data/jpeg)
in_passing jpeg
cd "$base" || exit 1

# ---------------------------------------------------------------------- textures

# A square in front of the camera; its picture as PICTURE, an `images` entry, says.
square() { # PICTURE [MORE BUFFERS] [MORE VIEWS]
    cat <<END
{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"material":0}]}],
"materials":[{"doubleSided":true,"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],
"textures":[{"source":0}],"images":[$1],
"accessors":[{"bufferView":0,"componentType":5126,"count":6,"type":"VEC3"},{"bufferView":1,"componentType":5126,"count":6,"type":"VEC2"}],
"bufferViews":[{"buffer":0,"byteLength":72},{"buffer":0,"byteOffset":72,"byteLength":48}${3:-}],
"buffers":[{"byteLength":120,"uri":"square.bin"}${2:-}]}
END
}

zero='\0\0\0\0'
one='\0\0\200\077'

make_models() { # FOLDER PICTURE MIME
    mkdir "$1"
    cp "$2" "$1/picture"
    printf "$zero$zero$zero$one$zero$zero$one$one$zero$zero$zero$zero$one$one$zero$zero$one$zero" >"$1/square.bin"
    printf "$zero$one$one$one$one$zero$zero$one$one$zero$zero$zero" >>"$1/square.bin"
    square '{"uri":"picture"}' >"$1/uri.gltf"
    square "{\"uri\":\"data:$3;base64,$(base64 <"$2" | tr -d '\n')\"}" >"$1/data.gltf"
    size=$(wc -c <"$2")
    square "{\"bufferView\":2,\"mimeType\":\"$3\"}" ",{\"byteLength\":$size,\"uri\":\"picture\"}" \
        ",{\"buffer\":1,\"byteLength\":$size}" >"$1/view.gltf"
    printf 'newmtl skin\nmap_Kd picture\n' >"$1/square.mtl"
    cat >"$1/square.obj" <<'END'
mtllib square.mtl
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
vt 0 0
vt 1 0
vt 1 1
vt 0 1
usemtl skin
f 1/1 2/2 3/3 4/4
END
}

# Of a model with one picture and with the other: a frame, a blob, and a list of checksums are the same.
alike() { # MODEL
    for folder in jpeg png; do
        works render "$folder/$1" --size 64x48 --light encoded -o "$folder.ppm" || return 1
        works convert "$folder/$1" -o "$folder.smr" || return 1
        works view "$folder/$1" --size 64x48 --out null --frames 2 --check "$folder.crc" --update || return 1
    done
    same jpeg.ppm png.ppm && same jpeg.smr png.smr && same jpeg.crc png.crc
}

fails() { # FILE PATTERN COMMAND...
    file=$1 pattern=$2
    shift 2
    run "$@"
    has_failed 1 "$file" && has err "$pattern" && missing none.ppm
}

# The base colour of a square whose picture is broken is missed; a map that is not drawn is not.
broken() {
    printf '\377\330\377\340\0\020JFIF\0\1\1\0\0\1\0\1\0\0\377\331' >broken.jpg
    make_models broken broken.jpg image/jpeg
    for model in uri data view; do
        claim "$model: a JPEG without a picture" fails "broken/$model.gltf" 'the JPEG file has no picture (images\[0\])' \
            render "broken/$model.gltf" -o none.ppm
        sed 's/"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}/"normalTexture":{"index":0}/' "broken/$model.gltf" >broken/normal.gltf
        claim "$model: not looked at as a normal map" works render broken/normal.gltf --size 16x16 -o normal.ppm
    done
    claim "map_Kd: a JPEG without a picture" fails broken/square.obj 'picture: the JPEG file has no picture' \
        render broken/square.obj -o none.ppm
}

textures() {
    for name in 2x2 420 440 422-progressive grey-progressive scans-apart; do
        cp "$pictures/$name.jpg" picture.jpg && "$files" png picture.jpg picture.png || exit 1
        make_models jpeg picture.jpg image/jpeg
        make_models png picture.png image/png
        for model in uri.gltf data.gltf view.gltf square.obj; do
            claim "picture $name, $model" alike "$model"
        done
        [ $name != 2x2 ] || claim "and it is not one colour" is_true "$(od -An -v -tx1 -w3 jpeg.ppm | sort -u | wc -l) > 20"
        rm -rf jpeg png
    done
    broken
}

# ---------------------------------------------------------------------- libjpeg

agrees() { # NUMBER
    options=$("$files" picture "$1" in.ppm) || return 1
    # shellcheck disable=SC2086
    cjpeg $options -outfile x.jpg in.ppm && djpeg -pnm -dct int -outfile out.ppm x.jpg && "$files" compare x.jpg out.ppm && return 0
    echo "cjpeg $options"
    return 1
}

libjpeg() {
    number=1
    while [ $number -le "$count" ]; do
        claim "picture $number" agrees $number
        number=$((number + 1))
    done
}

$part
finish
