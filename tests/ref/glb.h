/* SPDX-License-Identifier: MIT */
/* glb.h - glTF files in the making: text that grows, and the binary container. */
#ifndef SMEAR_TESTS_REF_GLB_H
#define SMEAR_TESTS_REF_GLB_H

#include <stddef.h>
#include <stdint.h>

/* Adds to a text in a block of `room` bytes; what does not fit is cut off. */
void append(char *text, size_t room, const char *format, ...);

/* The container of a JSON text, in which ' stands for ", and of binary data: a block of exactly its size, the caller's to free. */
uint8_t *glb_make(const char *json, const uint8_t *bin, size_t bin_size, size_t *size);

#endif
