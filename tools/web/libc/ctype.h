/* SPDX-License-Identifier: MIT */
/* ctype.h - of the C locale; see libc.c. */
#ifndef SMEAR_WEB_CTYPE_H
#define SMEAR_WEB_CTYPE_H

int tolower(int c);

#endif
