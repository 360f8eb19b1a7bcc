# SPDX-License-Identifier: MIT
# footprint_readme.awk - a README with build/NAME.txt, or build/NAME.md, which is Markdown already, between its markers
# <!-- NAME --> and <!-- /NAME -->. Where neither is there, what it has stays.
/^<!-- [a-z]+ -->$/ {
    print
    name = $2
    file = "build/" name ".txt"
    fence = (getline line < file) > 0
    if (fence)
        print "```"
    else {
        file = "build/" name ".md"
        if ((getline line < file) <= 0)
            next
    }
    do
        print line
    while ((getline line < file) > 0)
    if (fence)
        print "```"
    skip = 1
    next
}
/^<!-- \/[a-z]+ -->$/ { skip = 0 }
!skip { print }
