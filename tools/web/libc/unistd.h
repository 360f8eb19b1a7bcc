/* SPDX-License-Identifier: MIT */
/* unistd.h - nobody sits at a terminal here. */
#ifndef SMEAR_WEB_UNISTD_H
#define SMEAR_WEB_UNISTD_H

enum { STDERR_FILENO = 2 };

static inline int isatty(int file)
{
    (void)file;
    return 0;
}

#endif
