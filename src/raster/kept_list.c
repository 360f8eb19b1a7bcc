/* SPDX-License-Identifier: MIT */
/* kept_list.c - see kept_list.h: triangles that are kept need not be in the list that rolls down the frame, in which each is asked
 * in every row whether it goes on. */
#include "raster/kept_list.h"

#include "raster/raster.h"

#if SMEAR_KEPT_LISTS

/* Goes on to the first triangle of a list that is not before `triangle`: returns the word that tells its number. */
static inline uint32_t *link_to(const struct smear_bins *g, uint32_t *link, uint32_t triangle)
{
    while (*link < triangle)            /* none is the largest number */
        link = &bins_triangle(g, *link)->next;
    return link;
}

/* Takes what is kept out of a list. Returns the first one left. */
static uint32_t take_kept(const struct smear_raster_cache *cache, const struct smear_bins *g, uint32_t head)
{
    struct kept_list *const l = kept_list_of(cache);
    uint32_t *link = &head;
    l->apart = true;
    for (uint16_t number = l->first; number != 0 && *link != SMEAR_NO_TRIANGLE;) {
        const struct kept *const k = kept_at(cache, number);
        link = link_to(g, link, k->triangle);
        if (*link == k->triangle)
            *link = bins_triangle(g, *link)->next;
        number = k->next;
    }
    return head;
}

/* Puts it back, in order; then nothing is kept. */
static uint32_t put_back(const struct smear_raster_cache *cache, const struct smear_bins *g, uint32_t head)
{
    struct kept_list *const l = kept_list_of(cache);
    uint32_t *link = &head;
    for (uint16_t number = l->first; number != 0;) {
        const struct kept *const k = kept_at(cache, number);
        link = link_to(g, link, k->triangle);
        if (*link != k->triangle) {
            bins_triangle(g, k->triangle)->next = *link;
            *link = k->triangle;
        }
        number = k->next;
    }
    kept_list_clear(cache);
    return head;
}

/* Those of lists with fog, and without AVX2, are looked for where lists have them (raster.c). */
uint32_t smear_raster_advance(const struct smear_raster_frame *frame, const struct smear_raster_cache *cache, const uint32_t *last,
                              uint32_t head, int row)
{
    if (kept_list_seen(cache)->area.narrow && !frame_has_fog(frame) && smear_has_avx2())
        head = take_kept(cache, frame->bins, head);
    return smear_bins_advance(frame->bins, last, head, row);
}

uint32_t smear_raster_rejoin(const struct smear_raster_frame *frame, const struct smear_raster_cache *cache, uint32_t head)
{
    return kept_list_seen(cache)->apart ? put_back(cache, frame->bins, head) : head;
}
#endif
