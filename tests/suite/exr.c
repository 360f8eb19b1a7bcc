/* SPDX-License-Identifier: MIT */
/* exr.c - frames as OpenEXR files, through the C interface of OpenEXR 3.1 or later. */
#include "tests/suite/exr.h"

#include "tools/image/image.h"

#include <openexr.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const channel_name[EXR_PLANES] = {
    "R", "G", "B", "Z", "velocity.X", "velocity.Y"
};

/* Bytes of planes that a byte of file can hold at most: deflate packs 1032 to 1. */
enum { MAX_PACKING = 1100 };

bool exr_frame_alloc(struct exr_frame *frame, int width, int height, struct failure *f)
{
    memset(frame, 0, sizeof *frame);
    if (width < 1 || height < 1 || width > IMAGE_MAX_EDGE || height > IMAGE_MAX_EDGE)
        return fail(f, "no such size (%d x %d)", width, height);
    frame->width = width;
    frame->height = height;
    for (int i = 0; i < EXR_PLANES; i++) {
        frame->plane[i] = calloc((size_t)width * (size_t)height, sizeof(float));
        if (frame->plane[i] == NULL) {
            exr_frame_free(frame);
            return fail(f, "no memory for a frame (%d x %d)", width, height);
        }
    }
    return true;
}

void exr_frame_free(struct exr_frame *frame)
{
    for (int i = 0; i < EXR_PLANES; i++)
        free(frame->plane[i]);
    memset(frame, 0, sizeof *frame);
}

/* The plane of a channel: channels come back in alphabetical order, so only the name tells. */
static int plane_named(const char *name)
{
    for (int i = 0; i < EXR_PLANES; i++)
        if (strcmp(name, channel_name[i]) == 0)
            return i;
    return -1;
}

/* OpenEXRCore prints its errors unless it is given somewhere else to put them; the code it returns
 * is enough. */
static void keep_quiet(exr_const_context_t context, exr_result_t code, const char *text)
{
    (void)context;
    (void)code;
    (void)text;
}

static bool done(exr_result_t result, const char *what, struct failure *f)
{
    if (result == EXR_ERR_SUCCESS)
        return true;
    return fail(f, "%s (%s)", exr_get_default_error_message(result), what);
}

/* ------------------------------------------------------------------ writing */

static bool write_header(exr_context_t file, const struct exr_frame *frame, int *lines,
                         struct failure *f)
{
    int part;
    if (!done(exr_add_part(file, "main", EXR_STORAGE_SCANLINE, &part), "part", f)
        || !done(exr_initialize_required_attr_simple(file, part, frame->width, frame->height,
                                                     EXR_COMPRESSION_ZIP), "header", f))
        return false;
    for (int i = 0; i < EXR_PLANES; i++)
        if (!done(exr_add_channel(file, part, channel_name[i], EXR_PIXEL_FLOAT,
                                  EXR_PERCEPTUALLY_LINEAR, 1, 1), channel_name[i], f))
            return false;
    return done(exr_write_header(file), "header", f)
        && done(exr_get_scanlines_per_chunk(file, part, lines), "header", f);
}

static bool write_chunks(exr_context_t file, const struct exr_frame *frame, int lines,
                         exr_encode_pipeline_t *encode, struct failure *f)
{
    for (int y = 0; y < frame->height; y += lines) {
        exr_chunk_info_t chunk;
        if (!done(exr_write_scanline_chunk_info(file, 0, y, &chunk), "chunk", f)
            || !done(y == 0 ? exr_encoding_initialize(file, 0, &chunk, encode)
                            : exr_encoding_update(file, 0, &chunk, encode), "chunk", f))
            return false;
        for (int i = 0; i < encode->channel_count; i++) {
            exr_coding_channel_info_t *c = &encode->channels[i];
            const float *plane = frame->plane[plane_named(c->channel_name)];
            c->encode_from_ptr = (const uint8_t *)(plane + (size_t)y * (size_t)frame->width);
            c->user_bytes_per_element = (int16_t)sizeof(float);
            c->user_data_type = EXR_PIXEL_FLOAT;
            c->user_pixel_stride = (int32_t)sizeof(float);
            c->user_line_stride = (int32_t)sizeof(float) * frame->width;
        }
        if (y == 0 && !done(exr_encoding_choose_default_routines(file, 0, encode), "chunk", f))
            return false;
        if (!done(exr_encoding_run(file, 0, encode), "chunk", f))
            return false;
    }
    return true;
}

static bool write_file(const char *path, const struct exr_frame *frame, struct failure *f)
{
    exr_context_initializer_t start = EXR_DEFAULT_CONTEXT_INITIALIZER;
    exr_context_t file;
    exr_encode_pipeline_t encode = EXR_ENCODE_PIPELINE_INITIALIZER;
    int lines = 0;
    start.error_handler_fn = keep_quiet;
    if (!done(exr_start_write(&file, path, EXR_WRITE_FILE_DIRECTLY, &start), "create", f))
        return false;
    bool ok = write_header(file, frame, &lines, f) && write_chunks(file, frame, lines, &encode, f);
    exr_encoding_destroy(file, &encode);
    exr_result_t finished = exr_finish(&file);
    return ok && done(finished, "close", f);
}

bool exr_save(const char *path, const struct exr_frame *frame, struct failure *f)
{
    size_t room = strlen(path) + sizeof ".tmp";
    char *temporary = malloc(room);
    if (temporary == NULL)
        return fail(f, "no memory for a name");
    snprintf(temporary, room, "%s.tmp", path);
    bool ok = write_file(temporary, frame, f);
    if (ok && rename(temporary, path) != 0)
        ok = fail(f, "cannot be written");
    if (!ok)
        remove(temporary);
    free(temporary);
    return ok;
}

/* ------------------------------------------------------------------ reading */

static bool check_channels(exr_context_t file, struct failure *f)
{
    const exr_attr_chlist_t *list;
    bool found[EXR_PLANES] = { false };
    if (!done(exr_get_channels(file, 0, &list), "channels", f))
        return false;
    for (int i = 0; i < list->num_channels; i++) {
        const exr_attr_chlist_entry_t *entry = &list->entries[i];
        int plane = plane_named(entry->name.str);
        if (plane < 0)
            continue;
        if (entry->pixel_type != EXR_PIXEL_FLOAT || entry->x_sampling != 1
            || entry->y_sampling != 1)
            return fail(f, "not a 32-bit float for every pixel (channel %s)", channel_name[plane]);
        found[plane] = true;
    }
    for (int i = 0; i < EXR_PLANES; i++)
        if (!found[i])
            return fail(f, "channel is missing (%s)", channel_name[i]);
    return true;
}

/* Reads the header and makes room for the planes it promises, if the file is long enough to keep
 * the promise. */
static bool read_header(exr_context_t file, long file_bytes, struct exr_frame *out, int *top,
                        struct failure *f)
{
    exr_storage_t storage;
    exr_attr_box2i_t window;
    if (!done(exr_get_storage(file, 0, &storage), "header", f))
        return false;
    if (storage != EXR_STORAGE_SCANLINE)
        return fail(f, "not made of scan lines (first part)");
    if (!check_channels(file, f) || !done(exr_get_data_window(file, 0, &window), "window", f))
        return false;
    int64_t width = (int64_t)window.max.x - window.min.x + 1;
    int64_t height = (int64_t)window.max.y - window.min.y + 1;
    if (width < 1 || height < 1 || width > IMAGE_MAX_EDGE || height > IMAGE_MAX_EDGE)
        return fail(f, "no such size (%lld x %lld)", (long long)width, (long long)height);
    int64_t bytes = width * height * EXR_PLANES * (int64_t)sizeof(float);
    if (bytes / MAX_PACKING > file_bytes)
        return fail(f, "size is more than the file can hold (%lld x %lld)", (long long)width,
                    (long long)height);
    *top = window.min.y;
    return exr_frame_alloc(out, (int)width, (int)height, f);
}

static bool read_chunks(exr_context_t file, struct exr_frame *out, int top,
                        exr_decode_pipeline_t *decode, struct failure *f)
{
    int lines;
    if (!done(exr_get_scanlines_per_chunk(file, 0, &lines), "header", f))
        return false;
    for (int y = 0; y < out->height; y += lines) {
        exr_chunk_info_t chunk;
        if (!done(exr_read_scanline_chunk_info(file, 0, top + y, &chunk), "chunk", f)
            || !done(y == 0 ? exr_decoding_initialize(file, 0, &chunk, decode)
                            : exr_decoding_update(file, 0, &chunk, decode), "chunk", f))
            return false;
        for (int i = 0; i < decode->channel_count; i++) {
            exr_coding_channel_info_t *c = &decode->channels[i];
            int plane = plane_named(c->channel_name);
            c->decode_to_ptr = plane < 0 ? NULL
                                         : (uint8_t *)(out->plane[plane] + (size_t)y * (size_t)out->width);
            c->user_bytes_per_element = (int16_t)sizeof(float);
            c->user_data_type = EXR_PIXEL_FLOAT;
            c->user_pixel_stride = (int32_t)sizeof(float);
            c->user_line_stride = (int32_t)sizeof(float) * out->width;
        }
        if (y == 0 && !done(exr_decoding_choose_default_routines(file, 0, decode), "chunk", f))
            return false;
        if (!done(exr_decoding_run(file, 0, decode), "chunk", f))
            return false;
    }
    return true;
}

static bool file_length(const char *path, long *bytes, struct failure *f)
{
    FILE *file = fopen(path, "rb");
    if (file == NULL)
        return fail(f, "cannot be opened");
    bool ok = fseek(file, 0, SEEK_END) == 0 && (*bytes = ftell(file)) >= 0;
    fclose(file);
    return ok || fail(f, "cannot be read");
}

bool exr_load(const char *path, struct exr_frame *out, struct failure *f)
{
    exr_context_initializer_t start = EXR_DEFAULT_CONTEXT_INITIALIZER;
    exr_context_t file;
    exr_decode_pipeline_t decode = EXR_DECODE_PIPELINE_INITIALIZER;
    long bytes = 0;
    int top = 0;
    memset(out, 0, sizeof *out);
    start.error_handler_fn = keep_quiet;
    start.max_image_width = start.max_image_height = IMAGE_MAX_EDGE;
    if (!file_length(path, &bytes, f) || !done(exr_start_read(&file, path, &start), "header", f))
        return false;
    bool ok = read_header(file, bytes, out, &top, f) && read_chunks(file, out, top, &decode, f);
    exr_decoding_destroy(file, &decode);
    exr_finish(&file);
    if (!ok)
        exr_frame_free(out);
    return ok;
}
