/* SPDX-License-Identifier: MIT */
/* desc.h - the memory of a smear_desc, as `smear info --desc` prints it. */
#ifndef SMEAR_TOOLS_CLI_DESC_H
#define SMEAR_TOOLS_CLI_DESC_H

#include <smear.h>
#include <stdbool.h>

/* Reads fields as NAME=VALUE with commas. Returns null, or what is wrong with them. */
const char *desc_read(smear_desc *desc, const char *text);

/* Prints the array that the desc takes. Returns null, or what is wrong with the desc. */
const char *desc_print_memory(const smear_desc *desc);

#endif
