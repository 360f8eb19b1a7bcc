/* SPDX-License-Identifier: MIT */
/* web_file.h - files in memory, from the page's side. */
#ifndef SMEAR_WEB_FILE_H
#define SMEAR_WEB_FILE_H

#include <stddef.h>
#include <stdint.h>

/* A file of this name and size, to be filled; null without memory. */
uint8_t *web_file_make(const char *name, size_t size);

/* The bytes of a file, null when there is none; ".out" and ".err" are what has been printed. */
const uint8_t *web_file_data(const char *name, size_t *size);
void web_file_clear_texts(void);

#endif
