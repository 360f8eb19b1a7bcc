# SPDX-License-Identifier: MIT
# suites.awk - makes of a file test_NAME.c the function that runs its tests, one after the other, for the file's last line to include.
# A test is `static void test_CLAIM(void)`. What compiles only where a condition holds is run only there.
#
#     awk -v suite=NAME -f suites.awk test_NAME.c
BEGIN { printf "/* Made of test_%s.c by tests/suites.awk. */\nvoid suite_%s(void);\nvoid suite_%s(void)\n{\n", suite, suite, suite }
/^#(if|elif|else|endif)/ { print; while (/\\$/ && (getline) > 0) print }
/^static void test_[a-z0-9_]+\(void\)$/ { name = $3; sub(/\(.*/, "", name); print "    RUN(" name ");" }
END { print "}" }
