# SPDX-License-Identifier: MIT
# branches.awk - what `gcov -t -b -c` says of src/, against the list of branches that no suite takes (tests/coverage.txt).
# A branch is taken where any object that has its line takes it. Missed branches are counted by function.
#
#     awk -v least=95 -v spare=100 -f branches.awk coverage.txt gcov.txt
#
# Fails where fewer than `least` of 100 branches are taken, or more than `spare` are missed that the list does not have.
FNR == 1 { list = ++files == 1 }
list && /^src\// { for (i = 2; i < NF; i += 2) listed[$1 " " $i] += $(i + 1); next }
list { next }
/^ +-: +0:Source:/ { file = substr($0, index($0, "Source:") + 7); next }
/^function / { name = $2; next }
/^ *[-#=0-9*]+: *[0-9]+:/ { split($0, part, ":"); line = part[2] + 0; next }
/^branch / && file ~ /^src\// {
    key = file ":" line " " $2
    where[key] = file " " name
    at[key] = file ":" line
    if ($3 == "taken" && $4 + 0 > 0)
        taken[key] = 1
}
END {
    for (key in where) {
        all++
        if (key in taken)
            continue
        missed++
        count[where[key]]++
        lines[where[key]] = lines[where[key]] " " at[key]
    }
    for (f in count) {
        more = count[f] - listed[f]
        if (more > 0) {
            unlisted += more
            print "not listed: " f " " count[f] " (" listed[f] + 0 "):" lines[f]
        }
    }
    for (f in listed)
        if (count[f] + 0 < listed[f])
            fewer++
    if (all == 0) {
        print "coverage: no branches were counted"
        exit 1
    }
    share = (all - missed) * 100 / all
    printf "coverage: %d of %d branches of src/ are taken, %.2f %%; %d are missed, %d of these not listed; %d functions miss fewer\n", \
        all - missed, all, share, missed, unlisted, fewer
    exit share < least || unlisted > spare
}
