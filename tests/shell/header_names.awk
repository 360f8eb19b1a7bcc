# SPDX-License-Identifier: MIT
# header_names.awk - words of a public header, of which // comments are gone: struct fields, functions, enum constants, macros; one a line,
# its kind first.
{ text = text $0 "\n" }
END {
    while ((start = index(text, "/*")) > 0) {
        rest = substr(text, start)
        text = substr(text, 1, start - 1) " " substr(rest, index(rest, "*/") + 2)
    }
    lines = split(text, line, "\n")
    depth = kind = 0
    for (i = 1; i <= lines; i++) {
        s = line[i]
        if (s ~ /^#define SMEAR_/) {
            split(substr(s, 9), part, /[^A-Za-z0-9_]/)
            print "macro", part[1]
        }
        if (s ~ /extern "C"/) continue
        if (s ~ /^#/) {
            while (s ~ /\\$/) s = line[++i]
            continue
        }
        if (depth == 0 && s ~ /^[a-z].*smear_[a-z0-9_]*\(/ && s !~ /typedef/) {
            match(s, /smear_[a-z0-9_]*\(/)
            print "function", substr(s, RSTART, RLENGTH - 1)
        }
        if (depth == 0 && s ~ /enum/) kind = "enum"
        if (depth == 0 && s ~ /typedef struct [a-z0-9_]* \{/) kind = "struct"
        if (depth == 0 && s ~ /\)$/) kind = ""
        if (depth > 0 || s ~ /\{.*\}/) {
            t = s
            if (kind == "enum") {
                gsub(/.*\{/, "", t)
                gsub(/=[^,]*/, "", t)
                n = split(t, part, /[^A-Z0-9a-z_]+/)
                for (k = 1; k <= n; k++)
                    if (part[k] ~ /^SMEAR_/) print "constant", part[k]
            } else if (kind == "struct" && t ~ /;/) {
                if (match(t, /\(\*[a-z_0-9]*\)/))
                    print "field", substr(t, RSTART + 2, RLENGTH - 3)
                else {
                    gsub(/\[[^]]*\]/, "", t)
                    sub(/}/, "", t)
                    gsub(/\*/, " ", t)
                    sub(/;.*/, "", t)
                    n = split(t, part, ",")
                    for (k = 1; k <= n; k++) {
                        m = split(part[k], word, " ")
                        if (m > 0) print "field", word[m]
                    }
                }
            }
        }
        opened = gsub(/\{/, "{", s)
        depth += opened - gsub(/\}/, "}", s)
        if (depth == 0 && s ~ /\}/) kind = ""
    }
}
