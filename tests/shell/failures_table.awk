# SPDX-License-Identifier: MIT
# failures_table.awk - build/test/failures.txt as a table of tests/README.md: which methods hold all bars of a row; what
# `auto` has where it does not.
BEGIN {
    # Columns of failures.txt that are shown.
    split("none:1 reconstruct:3 mended:4 object:13 subframes:5 timemask:6 auto:7 fine:8", shown, " ")
    printf "| what fails elsewhere |"
    for (i = 1; i <= 8; i++) {
        split(shown[i], part, ":")
        column[i] = part[2]
        printf " %s |", part[1]
    }
    printf "\n|---|"
    for (i = 1; i <= 8; i++)
        printf "---|"
    printf "\n"
}

function finish(    i) {
    if (row == "")
        return
    if (fails[7])
        exceptions = exceptions misses
    printf "| %s |", name
    for (i = 1; i <= 8; i++)
        printf " %s |", fails[column[i]] ? "-" : "holds"
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
        misses = misses "| " name " | " what " | " missed " | " $(at - 1) " " $at " |\n"
    }
}
END {
    finish()
    printf "\n| what `auto` misses | measured is | has | bar |\n|---|---|---|---|\n%s", exceptions
}
