# SPDX-License-Identifier: MIT
# device_chart.awk - draws device.csv as SVG: a panel per target, one below the other, cost along x (logarithmic), error
# along y; what no other way beats in both is filled and joined by a grey line. The numbers of a method are joined by a line
# of its colour, which the list at the foot names; labels stand where they cover neither marks nor each other.
#
#     awk -f device_chart.awk device.csv
BEGIN {
    FS = ","
    WIDTH = 760; HEIGHT = 270; LEFT = 46; TOP = 34; RIGHT = 20; BOTTOM = 38; LIST = 24
    MARK = 4                                    # radius
    SIZE = 11                                   # of labels
    split("#5b6b82 #b0562b #5b8a3c #7d4fa3 #2b78a3 #a33b5b #8a7a2b #2b8a7a #c08a1e #6b4a2f", palette, " ")
}
NR > 1 {
    if (!($1 in panel)) {
        panel[$1] = ++panels
        title[panels] = $1 ", " $2 ": " $3 " per pixel"
    }
    p = panel[$1]
    n = ++count[p]
    name[p, n] = $4; cost[p, n] = $5 + 0; error[p, n] = $6 + 0
    if ($6 + 0 > worst) worst = $6 + 0
    if (n == 1 || $5 + 0 < low[p]) low[p] = $5 + 0
    if ($5 + 0 > high[p]) high[p] = $5 + 0
    f = family($4)
    if (!(f in color)) {
        color[f] = palette[1 + families % 10]
        family_name[++families] = f
    }
}
function log10(v) { return log(v) / log(10) }
function x_of(p, v) { return LEFT + (log10(v) - from[p]) / (to[p] - from[p]) * (WIDTH - LEFT - RIGHT) }
function y_of(v) { return HEIGHT - BOTTOM - v / top * (HEIGHT - TOP - BOTTOM) }
function is_best(p, i,    k) {
    for (k = 1; k <= count[p]; k++)
        if (k != i && cost[p, k] <= cost[p, i] && error[p, k] <= error[p, i] && (cost[p, k] < cost[p, i] || error[p, k] < error[p, i]))
            return 0
    return 1
}
# "auto-draft": of the family auto, labelled draft.
function family(text) { sub(/-.*/, "", text); return text }
function label_of(text) { sub(/^[^-]*-/, "", text); return text }
function text(x, y, anchor, size, s) {
    printf "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\" font-size=\"%d\">%s</text>\n", x, y, anchor, size, s
}
function add_box(x0, y0, x1, y1) {
    boxes++
    box_x0[boxes] = x0; box_y0[boxes] = y0; box_x1[boxes] = x1; box_y1[boxes] = y1
}
function is_free(x0, y0, x1, y1,    k) {
    if (x0 < LEFT || x1 > WIDTH - 2 || y0 < TOP || y1 > HEIGHT - BOTTOM)
        return 0
    for (k = 1; k <= boxes; k++)
        if (x0 < box_x1[k] && x1 > box_x0[k] && y0 < box_y1[k] && y1 > box_y0[k])
            return 0
    return 1
}
# Puts a label as near to its mark as there is room: rings of 16 places, above and to the right first. From where it could
# belong to another mark, a line leads back to its own.
function label(x, y, s, colored,    width, height, ring, k, turn, cx, cy) {
    width = length(s) * SIZE * 0.6 + 2
    height = SIZE
    for (ring = 0; ring < 40; ring++)
        for (k = 0; k < 16; k++) {
            turn = 0.7854 + (k % 2 ? 1 : -1) * int((k + 1) / 2) * 0.3927
            cx = x + cos(turn) * (MARK + 3 + width / 2 + ring * 4)
            cy = y - sin(turn) * (MARK + 2 + height / 2 + ring * 4)
            if (!is_free(cx - width / 2, cy - height / 2, cx + width / 2, cy + height / 2))
                continue
            add_box(cx - width / 2, cy - height / 2, cx + width / 2, cy + height / 2)
            if (ring > 1)
                printf "<path d=\"M%.1f %.1fL%.1f %.1f\" stroke=\"%s\" stroke-width=\"0.5\"/>\n", x, y,
                    cx - cos(turn) * width / 2, cy + sin(turn) * height / 2, colored
            text(cx, cy + SIZE * 0.36, "middle", SIZE, s)
            return
        }
    print "device_chart.awk: no room for the label " s > "/dev/stderr"
    no_room = 1
}
END {
    top = (worst > 0 ? worst : 1) * 1.12
    step = worst > 12 ? 4 : worst > 5 ? 2 : 1
    printf "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %d %d\" font-family=\"sans-serif\" fill=\"#333\">\n", WIDTH,
        HEIGHT * panels + LIST
    printf "<rect width=\"100%%\" height=\"100%%\" fill=\"#fff\"/>\n"
    for (p = 1; p <= panels; p++) {
        from[p] = log10(low[p] * 0.8)
        to[p] = log10(high[p] * 1.3)
        boxes = 0
        printf "<g transform=\"translate(0 %d)\">\n", (p - 1) * HEIGHT
        text(WIDTH / 2, 20, "middle", 14, title[p])
        text(12, TOP - 8, "start", SIZE, "RMS, codes")
        for (v = 0; v <= top; v += step) {
            printf "<path d=\"M%d %.1fH%d\" stroke=\"#ddd\"/>\n", LEFT, y_of(v), WIDTH - RIGHT
            text(LEFT - 6, y_of(v) + 4, "end", SIZE, v)
        }
        for (decade = 1; decade <= 1000000; decade *= 10)
            for (k = 1; k <= 5; k += k < 2 ? 1 : 3) {
                v = decade * k
                if (log10(v) < from[p] || log10(v) > to[p])
                    continue
                printf "<path d=\"M%.1f %dV%d\" stroke=\"#eee\"/>\n", x_of(p, v), TOP, HEIGHT - BOTTOM
                text(x_of(p, v), HEIGHT - BOTTOM + 16, "middle", SIZE, v)
            }
        # the front, from cheap to exact
        line = ""
        last = 0
        do {
            next_best = 0
            for (i = 1; i <= count[p]; i++)
                if (is_best(p, i) && cost[p, i] > last && (!next_best || cost[p, i] < cost[p, next_best]))
                    next_best = i
            if (next_best) {
                last = cost[p, next_best]
                line = line sprintf("%s%.1f %.1f", line == "" ? "M" : "L", x_of(p, last), y_of(error[p, next_best]))
            }
        } while (next_best)
        printf "<path d=\"%s\" fill=\"none\" stroke=\"#ccc\" stroke-width=\"3\"/>\n", line
        for (n = 1; n <= families; n++) {
            line = ""
            for (i = 1; i <= count[p]; i++)
                if (family(name[p, i]) == family_name[n])
                    line = line sprintf("%s%.1f %.1f", line == "" ? "M" : "L", x_of(p, cost[p, i]), y_of(error[p, i]))
            if (line ~ /L/)
                printf "<path d=\"%s\" fill=\"none\" stroke=\"%s\" stroke-opacity=\"0.5\"/>\n", line, color[family_name[n]]
        }
        for (i = 1; i <= count[p]; i++) {
            x = x_of(p, cost[p, i]); y = y_of(error[p, i])
            add_box(x - MARK, y - MARK, x + MARK, y + MARK)
            printf "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%d\" stroke=\"%s\" fill=\"%s\"><title>%s: %.1f, %.2f</title></circle>\n",
                x, y, MARK, color[family(name[p, i])], is_best(p, i) ? color[family(name[p, i])] : "#fff", name[p, i], cost[p, i],
                error[p, i]
        }
        for (i = 1; i <= count[p]; i++)
            label(x_of(p, cost[p, i]), y_of(error[p, i]), label_of(name[p, i]), color[family(name[p, i])])
        printf "</g>\n"
    }
    x = LEFT
    for (n = 1; n <= families; n++) {
        printf "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%d\" fill=\"%s\"/>\n", x, HEIGHT * panels + 8, MARK, color[family_name[n]]
        text(x + 8, HEIGHT * panels + 12, "start", SIZE, family_name[n])
        x += length(family_name[n]) * SIZE * 0.6 + 24
    }
    print "</svg>"
    exit no_room
}
