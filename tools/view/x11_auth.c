/* SPDX-License-Identifier: MIT */
/* x11_auth.c - see x11_auth.h. A record is a family and four counted strings, all 16-bit numbers
 * with the high byte first: address, display number, method, data. */
#include "tools/view/x11_auth.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { FAMILY_LOCAL = 256, FAMILY_WILD = 65535, MAX_FIELD = 1024 };
enum { ADDRESS, NUMBER, METHOD, DATA, FIELDS };

struct field {
    unsigned size;
    uint8_t bytes[MAX_FIELD + 1];
};

static bool read16(FILE *stream, unsigned *value)
{
    int high = fgetc(stream), low = fgetc(stream);
    *value = (unsigned)high << 8 | (unsigned)low;
    return high != EOF && low != EOF;
}

static bool read_field(FILE *stream, struct field *field)
{
    if (!read16(stream, &field->size) || field->size > MAX_FIELD ||
        fread(field->bytes, 1, field->size, stream) != field->size)
        return false;
    field->bytes[field->size] = '\0';
    return true;
}

static bool is_text(const struct field *field, const char *text)
{
    return field->size == strlen(text) && memcmp(field->bytes, text, field->size) == 0;
}

static int worth(unsigned family, const struct field field[FIELDS], const char *number,
                 const char *host)
{
    if (!is_text(&field[METHOD], "MIT-MAGIC-COOKIE-1") || field[DATA].size != X11_COOKIE ||
        (field[NUMBER].size > 0 && !is_text(&field[NUMBER], number)))
        return 0;
    if (family == FAMILY_LOCAL && is_text(&field[ADDRESS], host))
        return 3;
    return family == FAMILY_WILD ? 2 : 1;
}

static FILE *open_file(void)
{
    const char *path = getenv("XAUTHORITY"), *home = getenv("HOME");
    char own[4096];
    if (path == NULL || path[0] == '\0') {
        snprintf(own, sizeof own, "%s/.Xauthority", home != NULL ? home : "");
        path = own;
    }
    return fopen(path, "rb");
}

bool x11_find_cookie(int number, uint8_t cookie[X11_COOKIE])
{
    static struct field field[FIELDS];
    char text[16], host[256] = "";
    unsigned family;
    int best = 0;
    FILE *stream = open_file();
    if (stream == NULL)
        return false;
    snprintf(text, sizeof text, "%d", number);
    gethostname(host, sizeof host - 1);
    while (read16(stream, &family)) {
        int fields = 0;
        while (fields < FIELDS && read_field(stream, &field[fields]))
            fields++;
        if (fields < FIELDS)
            break;
        int value = worth(family, field, text, host);
        if (value > best) {
            best = value;
            memcpy(cookie, field[DATA].bytes, X11_COOKIE);
        }
    }
    fclose(stream);
    return best > 0;
}
