/* SPDX-License-Identifier: MIT */
/* crc32.h - the CRC-32 of PNG and zlib, of pictures and of models. */
#ifndef SMEAR_CRC32_H
#define SMEAR_CRC32_H

#include "base/base.h"

/* Returns the CRC of the bytes before, whose CRC is `crc` (0: there are none), and these. */
uint32_t smear_crc32(uint32_t crc, const uint8_t *bytes, uint32_t size);

#endif
