# SPDX-License-Identifier: MIT
# failures_table.awk - build/test/failures.txt as a table of tests/README.md: which methods hold all bars of a row; what
# `auto` has where it does not.
BEGIN {
    # Columns of failures.txt that are shown.
    split("none:1 reconstruct:3 mended:4 object:13 subframes:5 timemask:6 auto:7 fine:8", shown, " ")
    printf "| | what fails elsewhere |"
    for (i = 1; i <= 8; i++) {
        split(shown[i], part, ":")
        column[i] = part[2]
        printf " %s |", part[1]
    }
    printf "\n|---|---|"
    for (i = 1; i <= 8; i++)
        printf "---|"
    printf "\n"
}

function finish(    i) {
    if (row == "")
        return
    if (fails[7])
        exceptions = exceptions (exceptions == "" ? "" : "; ") "F" row " " misses
    printf "| F%s | %s |", row, name
    for (i = 1; i <= 8; i++)
        printf " %s |", fails[column[i]] ? "-" : "Y"
    printf "\n"
}

# Rows beyond the catalogue have no number.
/^\+ / {
    finish()
    row = ""
}

/^[0-9]+ / {
    finish()
    row = $1
    name = $0
    sub(/^[0-9]+ */, "", name)
    split("", fails)
    misses = ""
    next
}

# The last fourteen results of a line, from its end: a number and its judgement, or a dash.
row != "" && / (pass|known|-) *$/ && !/^ *- not/ {
    at = NF
    missed = ""
    for (i = 14; i >= 1; i--) {
        if ($at == "-")
            at--
        else {
            if ($at == "known")
                fails[i] = 1
            if (i == 7 && $at == "known")
                missed = $(at - 1)
            at -= 2
        }
    }
    if (missed != "") {
        what = $1
        for (i = 2; i <= at - 2; i++)
            what = what " " $i
        misses = misses (misses == "" ? "" : ", ") what " " missed " (" $(at - 1) " " $at ")"
    }
}
END {
    finish()
    words = split("What `auto` misses, with its number and the bar: " exceptions ".", word, " ")
    printf "\n%s", word[1]
    column_now = length(word[1])
    for (i = 2; i <= words; i++) {
        wraps = column_now + 1 + length(word[i]) > 130
        printf "%s%s", wraps ? "\n" : " ", word[i]
        column_now = (wraps ? 0 : column_now + 1) + length(word[i])
    }
    print ""
}
