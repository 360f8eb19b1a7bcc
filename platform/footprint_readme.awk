# SPDX-License-Identifier: MIT
# footprint_readme.awk - platform/README.md with the tables of build/NAME.txt between its markers
# <!-- NAME --> and <!-- /NAME -->.
/^<!-- [a-z]+ -->$/ {
    print
    name = $2
    found[name] = 1
    print "```"
    while ((getline line < ("build/" name ".txt")) > 0)
        print line
    print "```"
    skip = 1
    next
}
/^<!-- \/[a-z]+ -->$/ { skip = 0 }
!skip { print }
