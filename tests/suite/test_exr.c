/* SPDX-License-Identifier: MIT */
/* test_exr.c - EXR files keep every bit, name their channels, and bad ones are refused. */
#include "tests/test.h"

#include "tests/suite/exr.h"

#include "tools/image/image.h"

#include <openexr.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const name = "build-test.exr";

/* Every bit pattern that is awkward somewhere, and a ramp. Odd sizes: the last chunk is short. */
static bool sample(struct exr_frame *frame, int width, int height)
{
    static const float odd[8] = { 0.0f, -0.0f, INFINITY, -INFINITY, 1e-42f, 3.4028235e38f, -1.5f,
                                  65504.0f };
    struct failure f = {{0}};
    if (!CHECK(exr_frame_alloc(frame, width, height, &f)))
        return false;
    for (int p = 0; p < EXR_PLANES; p++)
        for (int i = 0; i < width * height; i++)
            frame->plane[p][i] = i % 5 == p % 5 ? odd[i / 5 % 8] : (float)(i * 3 - p * 1000) / 7.0f;
    const uint32_t quiet_nan = 0x7fc01234;
    memcpy(&frame->plane[EXR_VELOCITY_X][0], &quiet_nan, sizeof quiet_nan);
    return true;
}

static void check_round_trip(int width, int height)
{
    size_t bytes = sizeof(float) * (size_t)(width * height);
    struct exr_frame frame, back;
    struct failure f = {{0}};
    if (!sample(&frame, width, height))
        return;
    CHECK(exr_save(name, &frame, &f));
    if (CHECK(exr_load(name, &back, &f))) {
        CHECK(back.width == width && back.height == height);
        for (int p = 0; p < EXR_PLANES; p++)
            CHECK(memcmp(frame.plane[p], back.plane[p], bytes) == 0);
        exr_frame_free(&back);
    }
    exr_frame_free(&frame);
    remove(name);
}

static void test_every_bit_of_every_channel_comes_back(void)
{
    check_round_trip(61, 37);
    check_round_trip(1, 1);
    check_round_trip(64, 16);
    check_round_trip(3, 200);
}

/* The file lists its channels in alphabetical order; other programs find each by its name. */
static void test_channels_carry_their_names(void)
{
    static const char *const want[EXR_PLANES] = { "B", "G", "R", "Z", "velocity.X", "velocity.Y" };
    exr_context_initializer_t start = EXR_DEFAULT_CONTEXT_INITIALIZER;
    exr_context_t file;
    const exr_attr_chlist_t *list;
    exr_compression_t packing;
    struct exr_frame frame;
    struct failure f = {{0}};
    if (!sample(&frame, 20, 20))
        return;
    CHECK(exr_save(name, &frame, &f));
    exr_frame_free(&frame);
    if (!CHECK(exr_start_read(&file, name, &start) == EXR_ERR_SUCCESS))
        return;
    if (CHECK(exr_get_channels(file, 0, &list) == EXR_ERR_SUCCESS)
        && CHECK_EQ(list->num_channels, EXR_PLANES)) {
        for (int i = 0; i < EXR_PLANES; i++) {
            CHECK(strcmp(list->entries[i].name.str, want[i]) == 0);
            CHECK_EQ(list->entries[i].pixel_type, EXR_PIXEL_FLOAT);
        }
    }
    CHECK(exr_get_compression(file, 0, &packing) == EXR_ERR_SUCCESS);
    CHECK_EQ(packing, EXR_COMPRESSION_ZIP);
    exr_finish(&file);
    remove(name);
}

/* Loads what is given as a file; true when it was refused for a reason that has `word` in it. */
static bool refused_for(const uint8_t *bytes, size_t size, const char *word)
{
    struct exr_frame frame;
    struct failure f = {{0}};
    CHECK(file_write(name, bytes, size, &f));
    bool ok = exr_load(name, &frame, &f);
    bool kept = frame.plane[0] != NULL;
    if (ok)
        exr_frame_free(&frame);
    remove(name);
    return !ok && !kept && f.text[0] != '\0' && strstr(f.text, word) != NULL;
}

static bool refused(const uint8_t *bytes, size_t size)
{
    return refused_for(bytes, size, "");
}

static bool sample_bytes(uint8_t **bytes, size_t *size)
{
    struct exr_frame frame;
    struct failure f = {{0}};
    if (!sample(&frame, 40, 50))
        return false;
    bool ok = CHECK(exr_save(name, &frame, &f)) && CHECK(file_read(name, 1 << 24, bytes, size, &f));
    exr_frame_free(&frame);
    remove(name);
    return ok;
}

static void test_truncated_files_are_refused_at_every_length(void)
{
    uint8_t *bytes;
    size_t size;
    if (!sample_bytes(&bytes, &size))
        return;
    for (size_t length = 0; length < size; length += length < 700 ? 1 : 97)
        if (!CHECK(refused(bytes, length)))
            break;
    CHECK(refused(bytes, size - 1));
    free(bytes);
}

static void test_unreadable_files_are_refused(void)
{
    static const uint8_t text[] = "P6 2 2 255 this is no EXR file at all, nor anything else";
    struct exr_frame frame;
    struct failure f = {{0}};
    CHECK(refused(text, sizeof text));
    CHECK(!exr_load("no/such/file.exr", &frame, &f) && f.text[0] != '\0');
    f.text[0] = '\0';
    if (!sample(&frame, 4, 4))
        return;
    CHECK(!exr_save("no/such/folder.exr", &frame, &f) && f.text[0] != '\0');
    exr_frame_free(&frame);
}

static uint8_t *find(uint8_t *bytes, size_t size, const char *text, size_t length)
{
    for (size_t i = 0; i + length <= size; i++)
        if (memcmp(bytes + i, text, length) == 0)
            return bytes + i;
    return NULL;
}

static void test_missing_channels_and_lying_sizes_are_refused(void)
{
    uint8_t *bytes;
    size_t size;
    if (!sample_bytes(&bytes, &size))
        return;
    uint8_t *channel = find(bytes, size, "velocity.X", 11);
    if (CHECK(channel != NULL)) {
        channel[0] = 'w';
        CHECK(refused_for(bytes, size, "velocity.X"));
        channel[0] = 'v';
    }
    uint8_t *window = find(bytes, size, "dataWindow", 11);
    if (CHECK(window != NULL)) {            /* name, type "box2i", length, then x0 y0 x1 y1 */
        uint8_t *right = window + 11 + 6 + 4 + 8, kept[8];
        memcpy(kept, right, sizeof kept);
        memset(right, 0, 8);
        right[1] = right[5] = 0x3f;         /* 16128 more: 6 GB of planes */
        CHECK(refused_for(bytes, size, "hold"));
        memset(right, 0xff, 4);             /* x1 < x0 - 0: no width */
        CHECK(refused(bytes, size));
        memcpy(right, kept, sizeof kept);
    }
    CHECK(!refused(bytes, size));
    free(bytes);
}

/* A flipped bit may spoil the picture or the file, never the program. */
static void test_damaged_files_do_no_harm(void)
{
    uint8_t *bytes;
    size_t size;
    uint32_t seed = 1;
    int refusals = 0;
    if (!sample_bytes(&bytes, &size))
        return;
    for (int i = 0; i < 400; i++) {
        seed = seed * 1664525u + 1013904223u;
        size_t where = (seed >> 8) % (i < 200 ? 600 : size);
        uint8_t bit = (uint8_t)(1u << (seed & 7));
        bytes[where] ^= bit;
        refusals += refused(bytes, size);
        bytes[where] ^= bit;
    }
    CHECK(refusals > 0);
    CHECK(!refused(bytes, size));
    free(bytes);
}

void suite_exr(void);
void suite_exr(void)
{
    RUN(test_every_bit_of_every_channel_comes_back);
    RUN(test_channels_carry_their_names);
    RUN(test_truncated_files_are_refused_at_every_length);
    RUN(test_unreadable_files_are_refused);
    RUN(test_missing_channels_and_lying_sizes_are_refused);
    RUN(test_damaged_files_do_no_harm);
}
