/* SPDX-License-Identifier: MIT */
/* context_rig.h - a context with guard bytes around its memory and callbacks that keep what they are given. For suites that test the
 * library through its public interface; those of a scene of their own include rig.h, which has it, too. Host only. */
#ifndef SMEAR_TESTS_CONTEXT_RIG_H
#define SMEAR_TESTS_CONTEXT_RIG_H

#include "smear.h"

#include "tests/host.h"

enum { GUARD = 64, PATTERN = 0xa5 };

/* A context in a block with guard bytes, and all that its callbacks were given. */
struct rig {
    smear_desc desc;
    smear_context *ctx;
    uint8_t *block;             /* GUARD bytes, the context's memory, GUARD bytes */
    size_t bytes;
    uint8_t *picture;           /* band after band */
    size_t picture_size, picture_room;
    int bands, next_row;
    bool bands_in_order;
    int fail_at, fail_with;     /* flush of band fail_at returns fail_with; -1: none */
    bool reports_sent;          /* with two bands: each counts as sent at once */
    int sent;                   /* pixels, by place_band */
    uint32_t *color;            /* inspected rows */
    uint16_t *depth;
    int32_t *velocity;
    int inspected;
    struct crew *crew;          /* the workers but one, where the desc has several */
};

/* The flush of a rig. */
int take_band(void *user, const smear_band *band);

/* A flush for desc.flush: puts pixels of 32 bits in their place on a picture that stays, as a display does. */
int place_band(void *user, const smear_band *band);

smear_desc small_desc(int width, int height);

/* False (and a failed check) when the context cannot be made. */
bool rig_begin(struct rig *r, const smear_desc *desc, bool inspect);

/* A rig that ends where its block does. One that cannot be made ends the program. */
#define RIG(name, desc, inspect) \
    struct rig name OWNED(rig_end); \
    rig_must_begin(&name, desc, inspect)
void rig_must_begin(struct rig *r, const smear_desc *desc, bool inspect);
bool guards_intact(const struct rig *r);
void rig_end(struct rig *r);
void rig_forget_output(struct rig *r);

/* Begins, submits, renders; returns the first error. */
int rig_frame(struct rig *r, const smear_frame *frame, const smear_draw *draw, int count);

/* One more frame into a fresh copy of the picture; the caller frees it. */
uint8_t *rig_copy(struct rig *r, const smear_frame *frame, const smear_draw *draw, int count);
bool same_picture(const struct rig *r, const uint8_t *picture);

/* Its picture of 32 bits as 3 bytes per pixel: red, green, blue. */
void rig_rgb(const struct rig *r, uint8_t *rgb);

/* How far two pictures of so many pixels of 32 bits are from each other: root of the mean square, codes. */
double rms_of(const void *a, const void *b, int pixels);

#endif
