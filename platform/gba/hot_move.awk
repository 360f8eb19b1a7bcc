# SPDX-License-Identifier: MIT
# hot_move.awk - awk -v place=fast|warm|out -v name=FUNCTION -v slack="ASSEMBLE DRAW WARM" -v more=BYTES -f hot_move.awk MODEL STATE
# Prints STATE, "NAME PLACE", with a function moved, to fast or video memory or out of fast memory, and those moved out that gain
# least per byte and give it room and MORE bytes. What leaves fast memory goes to video memory, in place of what gains less there.
# Fails if all that would have to go gains more.
function by_density(list, n,    i, j, held) {
    for (i = 2; i <= n; i++)
        for (j = i; j > 1 && density[list[j]] < density[list[j - 1]]; j--) {
            held = list[j]
            list[j] = list[j - 1]
            list[j - 1] = held
        }
}
# Moves out of WHERE, among those of a stage, until there is room; returns the bytes that are missing. What need not go stays.
function make_room(where, kind, need,    list, n, i, other, gone, last) {
    for (other in at)
        if (at[other] == where && other != name && (kind == "" || stage[other] == kind))
            list[++n] = other
    by_density(list, n)
    for (i = 1; i <= n && need > 0; i++) {
        at[list[i]] = "rom"
        out[list[i]] = where
        need -= bytes[list[i]]
        gone += bytes[list[i]] * density[list[i]]
        last = i
    }
    for (i = last; i >= 1; i--)
        if (need + bytes[list[i]] <= 0) {
            at[list[i]] = where
            delete out[list[i]]
            need += bytes[list[i]]
            gone -= bytes[list[i]] * density[list[i]]
        }
    lost += gone
    return need
}
FNR == NR { stage[$1] = $2; bytes[$1] = $3; density[$1] = $4 / $3; next }
{ at[$1] = $2; order[++lines] = $1 }
END {
    if (!(name in at)) {                # before anything asks where it lies
        order[++lines] = name
        at[name] = "rom"
    }
    split(slack, left, " ")
    need = bytes[name] + 16 + more
    if (at[name] == "warm")
        left[3] += bytes[name]
    missing = 0
    if (place == "warm")
        missing = make_room("warm", "", need - left[3])
    else {
        if (place == "out") {
            at[name] = "rom"
            out[name] = "fast"
            need = 0
        }
        if (stage[name] != "draw")
            missing += make_room("fast", "assemble", need - left[1])
        if (stage[name] != "assemble")
            missing += make_room("fast", "draw", need - left[2])
        # From the densest on, to where video memory has room.
        for (other in out)
            rest[++n] = other
        by_density(rest, n)
        for (i = n; i >= 1; i--) {
            for (other in at)
                if (at[other] == "warm" && other != name && density[other] < density[rest[i]] && left[3] < bytes[rest[i]] + 8) {
                    at[other] = "rom"
                    left[3] += bytes[other]
                }
            if (left[3] >= bytes[rest[i]] + 8) {
                at[rest[i]] = "warm"
                left[3] -= bytes[rest[i]] + 8
            }
        }
    }
    if (place != "out" && (missing > 0 || lost > 3 * density[name] * bytes[name]))
        exit 1
    if (place != "out")
        at[name] = place
    for (i = 1; i <= lines; i++)
        if (at[order[i]] != "rom")
            print order[i], at[order[i]]
}
