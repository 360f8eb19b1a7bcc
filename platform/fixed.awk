# SPDX-License-Identifier: MIT
# fixed.awk - of what `demo cost` and `demo half` print, the cost of a frame that has no pixels, and that of each pixel: a line
# through both.
/ per pixel$/ && /^ ?(total|submit|raster|blur|convert) / {
    name = $1
    if (!(name in whole)) {
        whole[name] = $2
        order[++names] = name
        if (name == "total")
            pixels = $2 / $5
    } else
        half[name] = $2
}
END {
    if (!(names in order) || !("total" in half))
        exit 1
    print "whatever the size, and per pixel"
    for (i = 1; i <= names; i++) {
        name = order[i]
        printf "%-9s %9.0f  %7.1f\n", name, (4 * half[name] - whole[name]) / 3, (whole[name] - half[name]) / (0.75 * pixels)
    }
}
