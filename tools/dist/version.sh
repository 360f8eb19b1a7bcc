#!/bin/sh
# SPDX-License-Identifier: MIT
# version.sh - prints the version that include/smear.h states.
awk '$2 == "SMEAR_VERSION_MAJOR" { a = $3 } $2 == "SMEAR_VERSION_MINOR" { b = $3 } $2 == "SMEAR_VERSION_PATCH" { c = $3 }
    END { print a "." b "." c }' include/smear.h
