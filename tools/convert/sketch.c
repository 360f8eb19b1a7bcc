/* SPDX-License-Identifier: MIT */
/* sketch.c - see sketch.h. A kit has folders smear, arduino and esp-idf: the first goes into what is made of either. model.h and
 * settings.h are written here. */
#include "tools/convert/sketch.h"

#include "tools/image/buffer.h"
#include "tools/image/image.h"

#include <smear.h>
#include <string.h>

/* Boards have pointers of 4 bytes. */
#undef SMEAR_BY_POINTER_
#define SMEAR_BY_POINTER_(narrow, wide) (narrow)

/* All of it as it is linked: by -O2 on a Cortex-M33 (M0+ and rv32imc: a sixth more), by -Os on a Cortex-M0+. */
enum { LIBRARY_FLASH = 285000, LIBRARY_SMALL = 182000 };

const char *const sketch_displays[] = { "lovyangfx", "arduino_gfx", "tft_espi", "adafruit_gfx", "u8g2", "ili9341_t4", "esp_lcd", NULL };

/* What their headers say. */
static const struct display {
    int width, height, bands, format;
    bool is_idf;
} displays[] = {
    { 240, 240, 2, SMEAR_RGB565, false }, { 240, 240, 1, SMEAR_RGB565, false }, { 240, 240, 1, SMEAR_RGB565, false },
    { 240, 240, 1, SMEAR_RGB565, false }, { 128, 64, 1, SMEAR_L1_PAGES, false }, { 240, 320, 1, SMEAR_RGB565, false },
    { 240, 240, 2, SMEAR_RGB565, true },
};

/* ------------------------------------------------------------------ a .zip file, nothing compressed */

struct zip {
    struct buffer files, directory;
    unsigned count;
};

static void zip_add(struct zip *z, const char *name, const void *data, size_t size)
{
    const size_t at = z->files.size;
    const uint32_t crc = crc32_update(0, data, size);
    for (int i = 0; i < 2; i++) {
        struct buffer *b = i == 0 ? &z->files : &z->directory;
        buffer_le32(b, i == 0 ? 0x04034b50 : 0x02014b50);
        if (i == 1)
            buffer_le16(b, 10);                 /* made by version 1.0 of MS-DOS */
        buffer_le32(b, 10);                        /* read by it; no flags */
        buffer_le32(b, 0);                         /* stored, at midnight */
        buffer_le16(b, 1 << 5 | 1);             /* of 1980-01-01 */
        buffer_le32(b, crc);
        buffer_le32(b, (uint32_t)size);
        buffer_le32(b, (uint32_t)size);
        buffer_le16(b, (unsigned)strlen(name));
        buffer_le16(b, 0);
        for (int k = 0; i == 1 && k < 5; k++)   /* no comment; disk 0; no attributes */
            buffer_le16(b, 0);
        if (i == 1)
            buffer_le32(b, (uint32_t)at);
        buffer_append(b, name, strlen(name));
    }
    buffer_append(&z->files, data, size);
    z->count++;
}

static bool zip_end(struct zip *z, uint8_t **bytes, size_t *size, struct failure *f)
{
    struct buffer *b = &z->files;
    const size_t at = b->size, length = z->directory.size;
    buffer_append(b, z->directory.data, length);
    buffer_le32(b, 0x06054b50);
    buffer_le32(b, 0);
    buffer_le16(b, z->count);
    buffer_le16(b, z->count);
    buffer_le32(b, (uint32_t)length);
    buffer_le32(b, (uint32_t)at);
    buffer_le16(b, 0);
    b->failed = b->failed || z->directory.failed;
    buffer_free(&z->directory);
    return buffer_give(b, bytes, size) || fail(f, "out of memory");
}

/* ------------------------------------------------------------------ the kit */

/* Puts what the kit has for this form into the folder `name`. False where it has nothing, or is damaged. */
static bool add_kit(struct zip *z, const char *name, bool is_idf, const uint8_t *kit, size_t size)
{
    const char *form = is_idf ? "esp-idf/" : "arduino/";
    char path[256];
    for (size_t at = 0;; at += 512) {
        const char *head = (const char *)kit + at;
        size_t length = 0;
        if (at + 512 > size)
            return false;
        if (head[0] == '\0')
            return z->count > 0;
        if (memcmp(head + 257, "ustar", 5) != 0 || memchr(head, '\0', 100) == NULL)
            return false;
        for (const char *digit = head + 124; digit < head + 135 && *digit >= '0' && *digit <= '7'; digit++)
            length = length * 8 + (size_t)(*digit - '0');
        if (length > size - at - 512)
            return false;
        const bool is_shared = strncmp(head, "smear/", 6) == 0, is_file = head[156] == '0' && (is_shared || strncmp(head, form, 8) == 0);
        if (is_file && is_shared)
            snprintf(path, sizeof path, "%s/%s%s", name, is_idf ? "components/" : "", is_idf ? head : head + 6);
        else if (is_file && strcmp(head, "arduino/show.ino") == 0)
            snprintf(path, sizeof path, "%s/%s.ino", name, name);
        else if (is_file)
            snprintf(path, sizeof path, "%s/%s", name, head + 8);
        if (is_file)
            zip_add(z, path, kit + at + 512, length);
        at += (length + 511) / 512 * 512;
    }
}

/* ------------------------------------------------------------------ settings */

static size_t context_bytes(const struct display *d, const struct sketch_report *r, unsigned draws)
{
    return 8 * (SMEAR_MEMORY(r->width, r->height, r->triangles, draws, d->format)
                + (size_t)(d->bands - 1) * SMEAR_MEMORY_BAND(r->width, r->height, d->format));
}

static bool fit(const struct conversion *c, const struct sketch_options *o, struct sketch_report *r, struct failure *f)
{
    const struct display *d = &displays[o->display];
    r->width = o->width > 0 ? o->width : d->width;
    r->height = o->height > 0 ? o->height : d->height;
    r->triangles = c->triangles > 0 ? c->triangles : 1;
    r->actor = c->bytes.actor[1];
    r->model = c->bytes.meshes + c->bytes.textures + c->bytes.animation;
    r->library = LIBRARY_FLASH;
    r->small = LIBRARY_SMALL;
    const size_t all = r->context = context_bytes(d, r, c->model.draw_count);
    while (o->max_ram > 0 && r->context + r->actor > (size_t)o->max_ram && r->triangles > c->triangles / 4) {
        r->triangles -= (r->triangles + 63) / 64;
        r->context = context_bytes(d, r, c->model.draw_count);
    }
    if (r->triangles > c->triangles / 4)
        return true;
    return fail(f, "takes %zu bytes of RAM at %dx%d (%d triangles and %u draws: %zu, an actor with 2 poses: %zu), and %zu with a "
                "quarter of the triangles at once; there are %ld", all + r->actor, r->width, r->height, c->triangles,
                c->model.draw_count, all, r->actor, r->context + r->actor, o->max_ram);
}

static void put_settings(struct buffer *b, const struct sketch_options *o, const struct sketch_report *r)
{
    static const char *const target[] = { "0", "SMEAR_DRAFT", "SMEAR_BALANCED", "SMEAR_FINE" };
    const char *display = sketch_displays[o->display];
    buffer_print(b, "/* settings.h - how show.h draws model.h, written by smear convert.\n *\n"
                 " * RAM: %zu bytes (the library %zu, the model's poses %zu).\n"
                 " * Flash: %zu bytes for the model, %zu or so for the library; %zu by -Os, half as fast. */\n", r->context + r->actor,
                 r->context, r->actor, r->model, r->library, r->small);
    if (!displays[o->display].is_idf) {
        buffer_print(b, "#define DISPLAY_");
        for (const char *p = display; *p != '\0'; p++)
            buffer_byte(b, (unsigned)(*p >= 'a' && *p <= 'z' ? *p - 'a' + 'A' : *p));
        buffer_print(b, "      /* its pins are in %s.h */\n", display);
    }
    buffer_print(b, "#define SCREEN_WIDTH %d\n#define SCREEN_HEIGHT %d\n", r->width, r->height);
    buffer_print(b, "#define SCREEN_TRIANGLES %d     /* drawn at once; more are drawn in parts, slower */\n", r->triangles);
    buffer_print(b, "#define SCREEN_METHOD %s     /* SMEAR_NONE is sharp, SMEAR_AUTO blurred */\n",
                 o->quality == SKETCH_SHARP ? "SMEAR_NONE" : "SMEAR_AUTO");
    buffer_print(b, "#define SCREEN_TARGET %s    /* SMEAR_DRAFT, SMEAR_BALANCED, SMEAR_FINE: finer and slower */\n", target[o->quality]);
    buffer_print(b, "#define SCREEN_LIGHT SMEAR_LIGHT_ENCODED    /* SMEAR_LIGHT_LINEAR: truer and slower */\n");
    buffer_print(b, "#define SCREEN_TIME(frame) %s\n",
                 displays[o->display].is_idf ? "(xTaskGetTickCount() * portTICK_PERIOD_MS)" : "millis()");
}

bool convert_to_sketch(const struct conversion *c, const struct sketch_options *o, const char *name, const char *from,
                       const uint8_t *kit, size_t kit_size, uint8_t **bytes, size_t *size, struct sketch_report *report,
                       struct failure *f)
{
    struct zip z = { 0 };
    struct buffer settings = { 0 };
    const bool is_idf = displays[o->display].is_idf;
    struct conversion dark = *c;        /* sketches have the library's light */
    uint8_t *header = NULL;
    size_t header_size;
    char path[128];
    dark.has_sun = dark.has_lights = false;
    if (!fit(c, o, report, f) || !convert_to_header(&dark, "model", from, &header, &header_size, f))
        return false;
    bool ok = add_kit(&z, name, is_idf, kit, kit_size) || fail(f, "the kit is none of this program: make kit");
    put_settings(&settings, o, report);
    snprintf(path, sizeof path, "%s/%smodel.h", name, is_idf ? "main/" : "");
    zip_add(&z, path, header, header_size);
    snprintf(path, sizeof path, "%s/%ssettings.h", name, is_idf ? "main/" : "");
    zip_add(&z, path, settings.data, settings.size);
    ok = ok && (!settings.failed || fail(f, "out of memory"));
    free(header);
    buffer_free(&settings);
    if (ok)
        return zip_end(&z, bytes, size, f);
    buffer_free(&z.files);
    buffer_free(&z.directory);
    return false;
}
