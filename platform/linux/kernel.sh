#!/bin/sh
# SPDX-License-Identifier: MIT
# kernel.sh FOLDER
# The distribution's kernel, unpacked in FOLDER, never installed; fetched if it is not there. Prints the folder it lies in.
set -u
find_package() {
    package=$(apt-cache depends linux-image-amd64 2>/dev/null | awk '/Depends: linux-image/ { print $2; exit }')
    [ -n "$package" ]
}
find_package || { apt-get update -qq >&2 && find_package; } || {
    echo "kernel.sh: the package lists name no kernel" >&2
    exit 1
}
if [ ! -d "$1/$package" ]; then
    mkdir -p "$1" && cd "$1" && apt-get download -qq "$package" >&2 && dpkg -x "$package"_*.deb "$package.new" &&
        rm "$package"_*.deb && mv "$package.new" "$package" && cd "$OLDPWD" || exit 1
fi
echo "$1/$package"
