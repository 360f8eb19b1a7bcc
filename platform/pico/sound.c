/* SPDX-License-Identifier: MIT */
/* sound.c - sound.h on the speaker of a board, by the pico-sdk: DMA brings a sample of a ring to the pulse width modulator 15000
 * times a second, and neither core is asked. */
#include "platform/sound.h"

#include "platform/pico/board.h"
#include "platform/pico/sdk.h"

#include <hardware/pwm.h>

enum {
    RING_LOG2 = 11, RING = 1 << RING_LOG2,      /* samples: 137 ms */
    AHEAD = RING - SOUND_FRAME,                 /* at most so many wait to be heard */
    LEVELS = 1024, TURNS = 0x10000000
};

static uint16_t ring[RING] __attribute__((aligned(2 * RING)));

static struct {
    int dma;
    uint32_t written;               /* samples so far, from the ring's beginning on */
    struct sound_voice voice;
    bool is_open;
} sound;

static void start_dma(volatile void *to)
{
    sound.dma = (int)dma_claim_unused_channel(true);
    const int timer = dma_claim_unused_timer(true);
    dma_timer_set_fraction((uint)timer, 1, (uint16_t)(BOARD(CLOCK_KHZ) * 1000 / SOUND_HZ));
    dma_channel_config c = dma_channel_get_default_config((uint)sound.dma);
    channel_config_set_transfer_data_size(&c, DMA_SIZE_16);
    channel_config_set_ring(&c, false, RING_LOG2 + 1);
    channel_config_set_dreq(&c, dma_get_timer_dreq((uint)timer));
    dma_channel_configure((uint)sound.dma, &c, to, ring, TURNS, true);
}

static void open_sound(void)
{
    const uint slice = pwm_gpio_to_slice_num(BOARD(SOUND));
    gpio_set_function(BOARD(SOUND), GPIO_FUNC_PWM);
    pwm_set_wrap(slice, LEVELS - 1);
    pwm_set_enabled(slice, true);
    /* Both halves of the register get a sample; the other channel's pin is none of this. */
    start_dma(&pwm_hw->slice[slice].cc);
    sound.is_open = true;
}

/* Returns how many samples wait to be heard. Where the ring ran dry its last turn was heard again. */
static uint32_t waiting(void)
{
    const uint32_t heard = (uint32_t)(dma_hw->ch[sound.dma].read_addr - (uintptr_t)ring) / 2;
    return (sound.written - heard) % RING;
}

void sound_play(const struct sound_tone *tone)
{
    static int16_t sample[SOUND_FRAME];
    if (BOARD(SOUND) == NO_PIN)
        return;
    if (!sound.is_open)
        open_sound();
    if (waiting() > AHEAD)
        return;
    sound_samples(&sound.voice, tone, sample, SOUND_FRAME);
    for (int i = 0; i < SOUND_FRAME; i++, sound.written++)
        ring[sound.written % RING] = (uint16_t)((sample[i] + 32768) / (65536 / LEVELS));
}
