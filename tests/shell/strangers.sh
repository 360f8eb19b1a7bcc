#!/bin/sh
# SPDX-License-Identifier: MIT
# strangers.sh - models and pictures that somebody else has made: what they may ask of the program smear, and what
# they get. tools/README.md promises it.
#
#     sh tests/shell/strangers.sh build/smear

. "$(dirname "$0")/lib.sh"
of_program "$1"
in_passing strangers
mkdir "$base/model" "$base/model/below" "$base/other" && cd "$base" || exit 1

# A triangle whose corners lie in the file of that name.
model() { # NAME URI
    cat >"model/$1" <<END
{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],
"bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":"$2"}]}
END
}
corners='\0\0\0\0\0\0\0\0\0\0\0\0\0\0\200\077\0\0\0\0\0\0\0\0\0\0\0\0\0\0\200\077\0\0\0\0'
for file in model/own.bin model/below/own.bin other/secret.bin; do
    printf "$corners" >$file
done
ln -s ../other/secret.bin model/link.bin
ln -s own.bin model/near.bin
ln -s ../other model/door
ln -s /dev/zero model/zero.bin
mkfifo model/pipe.bin

# limited COMMAND...: at most five seconds
limited() { timeout 5 "$smear" "$@" >"$base/out" 2>"$base/err" </dev/null; rc=$?; }
reads() { limited info "model/$1"; [ $rc -eq 0 ] && [ ! -s err ] || { cat err; return 1; }; }
refuses() { # MODEL PATTERN [COMMAND...]
    file=$1 pattern=$2
    shift 2
    limited "${@:-info}" "model/$file"
    has_failed 1 "model/$file" && has err "$pattern"
}

# ------------------------------------------------------------------ where a model's files may lie

n=0
for uri in own.bin below/own.bin below/../own.bin ./own.bin o%77n.bin near.bin; do
    model m$n.gltf "$uri"
    claim "$uri is read" reads m$n.gltf
    n=$((n + 1))
done
for uri in ../other/secret.bin below/../../other/secret.bin %2e%2e/other/secret.bin ..%2fother%2fsecret.bin link.bin \
    door/secret.bin; do
    model m$n.gltf "$uri"
    claim "$uri is not" refuses m$n.gltf 'lies outside of the model.s folder (--outside)'
    claim "nor by render" refuses m$n.gltf 'lies outside' render --size 8x8 -o x.png
    claim "nor by convert" refuses m$n.gltf 'lies outside' convert -o x.h
    claim "nor by view" refuses m$n.gltf 'lies outside' view --out null --frames 1
    claim "but where the user says so" works info --outside model/m$n.gltf
    n=$((n + 1))
done
claim "render, too" works render --outside model/m$((n - 1)).gltf --size 8x8 -o x.ppm
claim "view, too" works view --outside model/m$((n - 1)).gltf --size 8x8 --out null --frames 1
claim "convert, too" works convert --outside model/m$((n - 1)).gltf -o x.h
for uri in /etc/passwd file:own.bin 'C:own.bin' '\\\\own.bin'; do
    model m$n.gltf "$uri"
    claim "$uri is no path" refuses m$n.gltf 'is no relative path'
    n=$((n + 1))
done
for uri in pipe.bin below; do
    model m$n.gltf "$uri"
    claim "$uri is no file" refuses m$n.gltf 'is no regular file'
    claim "and none with --outside" eval 'limited info --outside model/m$n.gltf; [ $rc -eq 1 ] && has err "is no regular file"'
    n=$((n + 1))
done
model zero.gltf zero.bin
claim "a device is none, either" eval 'limited info --outside model/zero.gltf; [ $rc -eq 1 ] && has err "is no regular file"'
cd model && model_here=$(for i in own.bin ../other/secret.bin; do "$smear" info m0.gltf >/dev/null 2>&1 && echo yes; done)
cd "$base" || exit 1
claim "the current folder is one, too" equals "$model_here" "yes
yes"

# An OBJ without its materials is shown without.
printf 'mtllib %s\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' ../other/m.mtl >model/far.obj
printf 'newmtl m\nKd 1 0 0\n' >other/m.mtl
limited info model/far.obj
claim "an OBJ's materials from elsewhere are left out" eval '[ $rc -eq 0 ] && has err "warning: ../other/m.mtl: lies outside"'
printf 'mtllib pipe.bin\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >model/pipe.obj
limited info model/pipe.obj
claim "nor does it wait for any" eval '[ $rc -eq 0 ] && has err "is no regular file"'
{
    i=0
    while [ $((i += 1)) -le 4097 ]; do echo 'mtllib gone.mtl'; done
    printf 'mtllib near.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n'
} >model/many.obj
printf 'newmtl m\nKd 1 0 0\n' >model/near.mtl
limited info model/many.obj
claim "nor look for more than 4096" eval '[ $rc -eq 0 ] && has out "\"m\" opaque, colour 1 1 1 1"'

# ------------------------------------------------------------------ sizes, before anything is read

sparse() { # FILE MEGABYTES: takes no room on the disk
    dd if=/dev/null of="$1" bs=1048576 seek="$2" 2>/dev/null
}
within() { # KILOBYTES COMMAND...: of memory, in five seconds
    kilobytes=$1
    shift
    (ulimit -v "$kilobytes" && exec timeout 5 "$smear" "$@") >out 2>err </dev/null
    rc=$?
}
sparse model/large.glb 1024
sparse model/large.obj 3072
sparse model/large.png 1024
sparse model/medium.glb 200
for file in large.glb large.obj; do
    within 100000 info model/$file
    claim "$file is refused by its size" eval 'has_failed 1 model/$file && has err "file is too large"'
done
within 100000 compare model/large.png model/large.png
claim "a picture, too" eval 'has_failed 1 model/large.png && has err "file is too large"'
within 100000 info model/medium.glb
claim "a file that is no GLB is refused by its first bytes" eval 'has_failed 1 model/medium.glb && has err "not glTF"'
cp model/medium.glb model/medium.obj
within 100000 info model/medium.obj
claim "likewise an OBJ that is no text" eval 'has_failed 1 model/medium.obj && has err "neither glTF nor text"'

finish
