# SPDX-License-Identifier: MIT
# manual_names.awk NAMES PAGE - the manual's sections, each with the names that it tells of, as a table: NAMES are what
# header_names.awk prints of public headers. A name stands with the section that names it first and with that which names it most often.
NR == FNR {
    name = $1 == "function" ? $2 "()" : $1 == "field" ? "." $2 : $2
    if (!(name in known)) {
        known[name] = 1
        sorted[++count] = name
    }
    next
}
/^<!-- names -->$/ { skip = 1 }
/^<!-- \/names -->$/ { skip = 0 }
/^```/ { code = !code }
!code && /^##* / {
    level = length($1)
    heading = $0
    sub(/^#* /, "", heading)
    if (level > 1 && heading != "Names") {
        section[++sections] = heading
        depth[sections] = level
    }
}
skip || sections == 0 || section[sections] == "Changes" { next }
{
    line = $0
    while (match(line, /smear_[a-z0-9_]+\(|SMEAR_[A-Z0-9_]+|(\.|->)[a-z_0-9]+/)) {
        word = substr(line, RSTART, RLENGTH)
        line = substr(line, RSTART + RLENGTH - (word ~ /\($/))
        sub(/\($/, "()", word)
        sub(/^->/, ".", word)
        if (word in known)
            times[word, sections]++
    }
}
END {
    for (i = 1; i <= count; i++) {
        first = most = 0
        for (k = 1; k <= sections; k++) {
            if (!first && times[sorted[i], k])
                first = k
            if (times[sorted[i], k] > times[sorted[i], most])
                most = k
        }
        of[first] = of[first] " " sorted[i]
        if (most != first)
            of[most] = of[most] " " sorted[i]
    }
    print "| section | names |"
    print "|---|---|"
    for (k = 1; k <= sections; k++) {
        anchor = tolower(section[k])
        gsub(/[^a-z0-9 _-]/, "", anchor)
        gsub(/ /, "-", anchor)
        n = split(of[k], list, " ")
        printf "| %s[%s](#%s) |", depth[k] == 3 ? "- " : "", section[k], anchor
        for (i = 2; i <= n; i++)
            for (j = i; j > 1 && tolower(plain(list[j])) < tolower(plain(list[j - 1])); j--) {
                t = list[j]
                list[j] = list[j - 1]
                list[j - 1] = t
            }
        for (i = 1; i <= n; i++)
            printf " `%s`", list[i]
        print " |"
    }
}
function plain(text) {
    sub(/^\./, "", text)
    return text
}
