/* SPDX-License-Identifier: MIT */
/* lanes8.c - how check_kernels calls kernels/lanes8.h, and what kernels/tiny_weights.h has of it: all functions that have a
 * scalar form, of numbers of any size and of those about powers of two, and where codes of depth are rounded. */
#include "kernels/lanes8.h"
#include "kernels/tiny_weights.h"

#include "tests/kernels/kernels.h"

#if SMEAR_AVX2

enum { FUNCTIONS = 14 };

static uint32_t number(uint32_t word)
{
    const uint32_t any = kernel_random(), few = (uint32_t)kernel_between(-2, 2);
    switch (kernel_random() % 6u) {
    case 0:  return word;
    case 1:  return any >> (word & 31u);
    case 2:  return (1u << (any & 31u)) + few;
    case 3:  return (any % 32768u << 11) + 0x400u + few;
    case 4:  return (any % 4096u << 15) + (32768u << 11) + 0x4000u + few;
    default: return (32768u << 11) + few;
    }
}

static void prepare(struct kernel_call *c)
{
    uint32_t *in = c->plane[0];
    c->n &= ~7;
    c->bytes[0] = c->bytes[1] = 4 * c->n;
    for (int32_t i = 0; i < c->n; i++)
        in[i] = number(in[i]);
}

static uint32_t at_least_one(uint32_t a) { return a >> 1 != 0 ? a >> 1 : 1u; }
static int32_t lower(uint32_t a) { return (int16_t)(a & 0xffffu); }
static int32_t upper(uint32_t a) { return (int16_t)(a >> 16); }

/* Function i of a, within its domain, and where it takes two of another number. */
static uint32_t one(int i, uint32_t a, uint32_t b)
{
    switch (i) {
    case 0:  return a >> 8 != 0 ? 31u - (uint32_t)count_leading_zeros(a >> 8) : 0;
    case 1:  return (uint32_t)count_leading_zeros(at_least_one(a));
    case 2:  return recip_norm(a | 0x80000000u);
    case 3:  return sqrt_q3(a & 0xfffffu);
    case 4:  return noise_of(a);
    case 5:  return smear_srgb_encode[a & 4095u];
    case 6:  return smear_srgb_decode[a & 255u];
    case 7:  return (uint32_t)smear_sine[a & 255u];
    case 8:  return (uint32_t)((uint64_t)a * b >> 32);
    case 9:  return (uint32_t)((uint64_t)((int64_t)(int32_t)a * (int32_t)b) >> 32);
    case 10: return (uint32_t)smear_srgb_decode[a & 255u] << 16;
    case 11: return (uint32_t)(lower(a) * lower(b)) + (uint32_t)(upper(a) * upper(b));
    case 12: return ((a & 0xffffu) | b << 16) ^ ((a >> 16 | (b & 0xffff0000u)) * 3u);
    default: return tiny_code((int32_t)a);
    }
}

SMEAR_AVX2_INLINE lanes8 eight(int i, lanes8 a, lanes8 b)
{
    const lanes8 some = a >> 1;
    uintptr_t table = (uintptr_t)smear_srgb_decode;      /* what is read of it begins before it, but for compilers */
    SMEAR_KEEP_VALUE(table);
    switch (i) {
    case 0:  return (lanes8)lanes8_log2(a >> 8);
    case 1:  return (lanes8)lanes8i_zeros((lanes8i)lanes8_choose(some != 0, some, lanes8_all(1)));
    case 2:  return lanes8_recip_norm(a | 0x80000000u);
    case 3:  return lanes8_sqrt_q3(a & 0xfffffu);
    case 4:  return lanes8_noise_of(a);
    case 5:  return lanes8_encode(a & 4095u);
    case 6:  return lanes8_decode(a & 255u);
    case 7:  return (lanes8)lanes8i_of_bytes(smear_sine, a & 255u);
    case 8:  return lanes8_mulh(a, b);
    case 9:  return (lanes8)lanes8i_mulh((lanes8i)a, (lanes8i)b);
    case 10: return lanes8_gather_upper_from_0((const void *)table, (lanes8i)(a & 255u)) & 0xffff0000u;
    case 11: return (lanes8)lanes8_dot(a, b);
    case 12: return lanes8_pair(a, b) ^ lanes8_upper_pair(a, b) * 3u;
    default: return tiny_code8(a);
    }
}

static void reference(struct kernel_call *c)
{
    const uint32_t *in = c->plane[0];
    uint32_t *out = c->plane[1];
    for (int32_t i = 0; i < c->n; i++) {
        out[i] = 0;
        for (int k = 0; k < FUNCTIONS; k++)
            out[i] = out[i] * 31u + one(k, in[i], in[i ^ 1]);
    }
}

SMEAR_AVX2_FUNCTION static void by_eights(struct kernel_call *c)
{
    for (int32_t i = 0; i < c->n; i += 8) {
        const lanes8 a = lanes8_load((uint32_t *)c->plane[0] + i);
        const lanes8 b = (lanes8)lanes8i_permute((lanes8i)a, lanes8i_numbers() ^ 1);
        lanes8 out = lanes8_all(0);
        for (int k = 0; k < FUNCTIONS; k++)
            out = out * 31u + eight(k, a, b);
        lanes8_store((uint32_t *)c->plane[1] + i, out);
    }
}

static void best(struct kernel_call *c)
{
    if (smear_has_avx2())
        by_eights(c);
    else
        reference(c);
}
#endif

extern const struct kernel kernels_lanes8[];
const struct kernel kernels_lanes8[] = {
#if SMEAR_AVX2
    { .name = "lanes8 (all functions)", .most = 64, .size = { 4, 4 }, .prepare = prepare, .timed = 64,
      .form = { { "reference", reference }, { "avx2", best } } },
#endif
    { .name = NULL }
};
