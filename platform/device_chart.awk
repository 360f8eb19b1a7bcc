# SPDX-License-Identifier: MIT
# device_chart.awk - draws device.csv as SVG: a panel per target, cost along x (logarithmic), error along y; what no other
# way beats in both is filled and joined by a line.
#
#     awk -f device_chart.awk device.csv
BEGIN {
    FS = ","
    WIDTH = 400; HEIGHT = 300; LEFT = 46; TOP = 34; RIGHT = 20; BOTTOM = 44
    split("#5b6b82 #b0562b #5b8a3c #7d4fa3 #2b78a3 #a33b5b #8a7a2b #2b8a7a", palette, " ")
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
function family(text) { sub(/-.*/, "", text); return text }
function color_of(text,    f) {
    f = family(text)
    if (!(f in color))
        color[f] = palette[1 + colors++ % 8]
    return color[f]
}
function text(x, y, anchor, size, s) {
    printf "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\" font-size=\"%d\">%s</text>\n", x, y, anchor, size, s
}
END {
    top = worst * 1.12
    step = worst > 12 ? 4 : worst > 5 ? 2 : 1
    printf "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %d %d\" font-family=\"sans-serif\" fill=\"#333\">\n", WIDTH * panels, HEIGHT
    printf "<rect width=\"100%%\" height=\"100%%\" fill=\"#fff\"/>\n"
    for (p = 1; p <= panels; p++) {
        from[p] = log10(low[p] * 0.8)
        to[p] = log10(high[p] * 1.5)
        printf "<g transform=\"translate(%d 0)\">\n", (p - 1) * WIDTH
        text(WIDTH / 2, 18, "middle", 13, title[p])
        for (v = 0; v <= top; v += step) {
            printf "<path d=\"M%d %.1fH%d\" stroke=\"#ddd\"/>\n", LEFT, y_of(v), WIDTH - RIGHT
            text(LEFT - 6, y_of(v) + 4, "end", 10, v)
        }
        for (decade = 1; decade <= 1000000; decade *= 10)
            for (k = 1; k <= 5; k += k < 2 ? 1 : 3) {
                v = decade * k
                if (log10(v) < from[p] || log10(v) > to[p])
                    continue
                printf "<path d=\"M%.1f %dV%d\" stroke=\"#eee\"/>\n", x_of(p, v), TOP, HEIGHT - BOTTOM
                text(x_of(p, v), HEIGHT - BOTTOM + 15, "middle", 10, v)
            }
        if (p == 1)
            text(12, TOP - 8, "start", 10, "RMS, codes")
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
        printf "<path d=\"%s\" fill=\"none\" stroke=\"#bbb\"/>\n", line
        taken = 0
        for (i = 1; i <= count[p]; i++) {
            x = x_of(p, cost[p, i]); y = y_of(error[p, i])
            printf "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"4\" stroke=\"%s\" fill=\"%s\"><title>%s: %.1f, %.2f</title></circle>\n",
                x, y, color_of(name[p, i]), is_best(p, i) ? color_of(name[p, i]) : "#fff", name[p, i], cost[p, i], error[p, i]
            # a label goes up until it is free of those before
            right = x > WIDTH - RIGHT - 75
            at = y - 6
            for (moved = 1; moved;) {
                moved = 0
                for (k = 1; k <= taken; k++)
                    if (at - label_y[k] < 9 && label_y[k] - at < 9 && x - label_x[k] < 72 && label_x[k] - x < 72) {
                        at = label_y[k] - 9.5
                        moved = 1
                    }
            }
            taken++
            label_x[taken] = x
            label_y[taken] = at
            text(x + (right ? -3 : 3), at, right ? "end" : "start", 9, name[p, i])
        }
        printf "</g>\n"
    }
    print "</svg>"
}
