/* SPDX-License-Identifier: MIT */
/* errno.h - what files in memory can say. */
#ifndef SMEAR_WEB_ERRNO_H
#define SMEAR_WEB_ERRNO_H

enum { ENOENT = 2, ENOMEM = 12, EINVAL = 22, ERANGE = 34 };

extern int web_errno;
#define errno web_errno

#endif
