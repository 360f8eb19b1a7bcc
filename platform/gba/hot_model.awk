# SPDX-License-Identifier: MIT
# hot_model.awk - awk -v model=FILE -v start=FILE -f hot_model.awk STAGES PROFILES
# What each function gains by fast memory: writes "NAME STAGE BYTES GAIN" to MODEL, and what to begin with to START, "NAME fast|warm".
#
# PROFILES are of programs whose functions all lie in ROM: "W WAY" before each, "F ADDRESS BYTES NAME" of its functions in order, "P ADDRESS
# CYCLES COUNT" and "J FROM TO COUNT" of gbarun. A function gains what it took beyond FAST cycles for an instruction, SLOW of each at most: the
# rest is data. Calls between memories go by way of a veneer, which takes CALL_OUT cycles in fast memory and CALL_IN in ROM.
# All is in millionths of a way's cycles. A function of both stages takes room from both.
function number(hex,    i, value) {
    for (i = 1; i <= length(hex); i++)
        value = value * 16 + index("0123456789abcdef", substr(hex, i, 1)) - 1
    return value
}
# Returns the index of the function that holds an address, or 0.
function holder(address,    low, high, middle) {
    low = 1
    high = functions
    while (low < high) {
        middle = int((low + high + 1) / 2)
        if (first[middle] <= address) low = middle; else high = middle - 1
    }
    return functions > 0 && address >= first[low] && address < end[low] ? low : 0
}
function end_way(    i, f, g, total) {
    for (i = 1; i <= lines; i++)
        total += cycles[i]
    for (i = 1; i <= lines; i++)
        if ((f = holder(at[i])) > 0) {
            more = cycles[i] - FAST * count[i]
            gain[label[f]] += 1e6 / total * (more < SLOW * count[i] ? more : SLOW * count[i])
        }
    for (i = 1; i <= jumps; i++) {
        f = holder(from[i])
        g = holder(to[i])
        if (f > 0 && g > 0 && to[i] == first[g] && label[f] != label[g]) {
            if (!((label[f], label[g]) in calls)) {
                callee[label[f], ++callees[label[f]]] = label[g]
                caller[label[g], ++callers[label[g]]] = label[f]
            }
            calls[label[f], label[g]] += 1e6 / total * times[i]
        }
    }
    functions = lines = jumps = 0
}
function worth(name,    i, other, value) {
    value = gain[name]
    for (i = 1; i <= callees[name]; i++) {
        other = callee[name, i]
        value += calls[name, other] * (other in fast ? CALL_IN : -CALL_OUT)
    }
    for (i = 1; i <= callers[name]; i++) {
        other = caller[name, i]
        value += calls[other, name] * (other in fast ? CALL_OUT : -CALL_IN)
    }
    return value
}
BEGIN { FAST = 1.8; SLOW = 3.2; CALL_OUT = 6; CALL_IN = 14; ROOM = 22400; WARM = 19400; VENEERS = 6 }
FILENAME != "-" { stage[$1] = $2; next }
$1 == "W" { end_way(); next }
$1 == "F" {
    name = $4
    sub(/\..*/, "", name)
    first[++functions] = number($2)
    end[functions] = first[functions] + number($3)
    label[functions] = name
    if (!((name, $3, $4) in counted) && name in stage)
        bytes[name] += number($3)
    counted[name, $3, $4] = 1
}
$1 == "P" { at[++lines] = number($2); cycles[lines] = $3; count[lines] = $4 }
$1 == "J" { from[++jumps] = number($2); to[jumps] = number($3); times[jumps] = $4 }
END {
    end_way()
    fast["memcpy"] = fast["memset"] = fast["__aeabi_lmul"] = fast["__aeabi_uidiv"] = fast["__aeabi_idiv"] = 1
    do {
        best = ""
        most = used["assemble"] > used["draw"] ? used["assemble"] : used["draw"]
        for (name in bytes) {
            if (name in fast || gain[name] <= 0)
                continue
            size = bytes[name] + VENEERS
            if (used["both"] + size + (stage[name] == "both" ? most : used[stage[name]]) > ROOM)
                continue
            dense = worth(name) / size / (stage[name] == "both" ? 2 : 1)
            if (best == "" || dense > highest) {
                best = name
                highest = dense
            }
        }
        if (best != "") {
            fast[best] = 1
            used[stage[best]] += bytes[best] + VENEERS
            print best, "fast" > start
        }
    } while (best != "")
    for (name in bytes)
        if (gain[name] > 0)
            printf "%s %s %d %.1f\n", name, stage[name], bytes[name], (worth(name) > 0 ? worth(name) : 0.1) / (stage[name] == "both" ? 2 : 1) > model
    do {
        best = ""
        for (name in bytes)
            if (!(name in fast) && gain[name] > 0 && used["warm"] + bytes[name] + VENEERS <= WARM && (best == "" || gain[name] / bytes[name] > highest)) {
                best = name
                highest = gain[name] / bytes[name]
            }
        if (best != "") {
            fast[best] = 1
            used["warm"] += bytes[best] + VENEERS
            print best, "warm" > start
        }
    } while (best != "")
}
