/* SPDX-License-Identifier: MIT */
/* inttypes.h - formats of a machine with 32-bit pointers. */
#ifndef SMEAR_WEB_INTTYPES_H
#define SMEAR_WEB_INTTYPES_H

#include <stdint.h>

#define PRId8 "d"
#define PRIu8 "u"
#define PRId16 "d"
#define PRIu16 "u"
#define PRIx16 "x"
#define PRId32 "d"
#define PRIu32 "u"
#define PRIx32 "x"
#define PRIX32 "X"
#define PRId64 "lld"
#define PRIu64 "llu"
#define PRIx64 "llx"

#endif
