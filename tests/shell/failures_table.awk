# SPDX-License-Identifier: MIT
# failures_table.awk - build/test/failures.txt as a table of tests/README.md: which methods hold all bars of a row.
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
    next
}

# The last fourteen results of a line, from its end: a number and its judgement, or a dash.
row != "" && / (pass|known|-) *$/ && !/^ *- not/ {
    at = NF
    for (i = 14; i >= 1; i--) {
        if ($at == "-")
            at--
        else {
            if ($at == "known")
                fails[i] = 1
            at -= 2
        }
    }
}
END { finish() }
