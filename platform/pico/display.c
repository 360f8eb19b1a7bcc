/* SPDX-License-Identifier: MIT */
/* display.c - display.h on the panels of boards.h: ST7789, ST7735S, GC9107 on SPI or eight wires, by DMA.
 *
 * One band is sent while the next is drawn. Both cores draw; core 1 waits in smear_work between frames. */
#include "platform/display.h"
#include "platform/pico/board.h"
#include "platform/pico/sdk.h"

/* Commands that all of these controllers share. */
enum {
    RESET = 0x01, SLEEP_OUT = 0x11, INVERT = 0x21, DISPLAY_ON = 0x29, COLUMNS = 0x2a, ROWS = 0x2b, MEMORY = 0x2c,
    TEARING_LINE = 0x35, MEMORY_ORDER = 0x36, PIXEL_FORMAT = 0x3a,
    BITS_16 = 0x55
};

enum { IS_PARALLEL = BOARD(BUS) == BUS_PARALLEL };

static struct {
    smear_context *ctx;
    int dma;
    volatile unsigned waiting;      /* bands handed to flush and not sent, 0 to 2 */
    smear_band next;                /* with two: the one behind the one that is being sent */
    unsigned left;                  /* of them, those of a frame that display_show() was told of */
    bool begun;                     /* a band of the frame has been handed out */
} bus;

/* ------------------------------------------------------------------ bus */

#define SPI (BOARD(BUS) == 1 ? spi1 : spi0)

static void open_spi(void)
{
    spi_init(SPI, BOARD(BUS_KHZ) * 1000);
    gpio_set_function(BOARD(CLK), GPIO_FUNC_SPI);
    gpio_set_function(BOARD(DATA), GPIO_FUNC_SPI);
}

/* Until the last bit is on the wire: D/C must not change before. */
static void drain(void)
{
    if (IS_PARALLEL) {
        wires_drain();
        return;
    }
    while (spi_is_busy(SPI))
        tight_loop_contents();
    while (spi_is_readable(SPI))
        (void)spi_get_hw(SPI)->dr;
    spi_get_hw(SPI)->icr = SPI_SSPICR_RORIC_BITS;       /* nobody has read what came back */
}

static void write_bytes(const uint8_t *bytes, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        if (IS_PARALLEL)
            wires_put(bytes[i]);
        else
            spi_write_blocking(SPI, &bytes[i], 1);
    }
}

static void command(uint8_t code, const uint8_t *data, uint32_t count)
{
    drain();
    gpio_put(BOARD(DC), 0);
    write_bytes(&code, 1);
    drain();
    gpio_put(BOARD(DC), 1);
    write_bytes(data, count);
}

static void open_dma(void)
{
    bus.dma = (int)dma_claim_unused_channel(true);
    dma_channel_config c = dma_channel_get_default_config((uint)bus.dma);
    channel_config_set_transfer_data_size(&c, DMA_SIZE_8);
    channel_config_set_dreq(&c, IS_PARALLEL ? wires_dreq() : spi_get_dreq(SPI, true));
    volatile void *to = IS_PARALLEL ? wires_queue() : (volatile void *)&spi_get_hw(SPI)->dr;
    dma_channel_configure((uint)bus.dma, &c, to, NULL, 0, false);
    dma_channel_set_irq0_enabled((uint)bus.dma, true);
}

/* ------------------------------------------------------------------ bands */

static void put_range(uint8_t code, int first, int count)
{
    const int last = first + count - 1;
    const uint8_t data[4] = { (uint8_t)(first >> 8), (uint8_t)first, (uint8_t)(last >> 8), (uint8_t)last };
    command(code, data, 4);
}

static void send(const smear_band *band)
{
    put_range(COLUMNS, BOARD(X) + band->x, band->width);
    put_range(ROWS, BOARD(Y) + band->y, band->height);
    command(MEMORY, NULL, 0);
    dma_channel_transfer_from_buffer_now((uint)bus.dma, band->pixels, band->size);
}

/* Until the panel scans its first rows and is ahead by more than a band. It stays ahead of what is sent from then on, and shows
 * a whole frame, if the next scan does not come up with it: if all of it is sent within two refreshes. */
static void wait_for_scan(void)
{
    enum { AHEAD_US = 2000, REFRESH_US = 20000 };
    if (BOARD(TE) == NO_PIN || bus.begun)
        return;
    /* A line that is not wired must not stop the program. */
    const absolute_time_t end = make_timeout_time_us(2 * REFRESH_US);
    gpio_acknowledge_irq(BOARD(TE), GPIO_IRQ_EDGE_FALL);
    while ((iobank0_hw->intr[BOARD(TE) / 8] >> 4 * (BOARD(TE) % 8) & GPIO_IRQ_EDGE_FALL) == 0 && !time_reached(end))
        tight_loop_contents();
    busy_wait_us(AHEAD_US);
}

/* The library hands out no third band before the first has been sent. */
static int flush(void *user, const smear_band *band)
{
    (void)user;
    wait_for_scan();
    bus.begun = true;
    const uint32_t state = save_and_disable_interrupts();
    if (bus.waiting++ == 0)
        send(band);
    else
        bus.next = *band;
    restore_interrupts(state);
    return 0;
}

static void end_frame(void)
{
    drain();
    if (BOARD(LED) != NO_PIN)
        gpio_xor_mask(1u << BOARD(LED));
}

/* The band has left memory; its last bytes are in the bus's queue. */
static void sent(void)
{
    dma_channel_acknowledge_irq0((uint)bus.dma);
    smear_band_done(bus.ctx);
    if (bus.left > 0 && --bus.left == 0)
        end_frame();
    if (--bus.waiting > 0)
        send(&bus.next);
}

/* A core waits for a word of the other, which is no event, so it must not sleep; but it leaves the bus to it, and the flash,
 * as this lies in RAM. */
static void __not_in_flash_func(idle)(void *user)
{
    (void)user;
    busy_wait_at_least_cycles(16);
}

static void work(void)
{
    for (;;)
        smear_work(bus.ctx, 1);
}

/* ------------------------------------------------------------------ display.h */

static void open_output(uint pin, bool level)
{
    if (pin == NO_PIN)
        return;
    gpio_init(pin);
    gpio_put(pin, level);
    gpio_set_dir(pin, GPIO_OUT);
}

static void wake_panel(void)
{
    static const uint8_t order[] = { BOARD(MADCTL) }, format[] = { BITS_16 }, blanking[] = { 0 };
    if (BOARD(RESET) != NO_PIN) {
        gpio_put(BOARD(RESET), 0);
        sleep_ms(10);
        gpio_put(BOARD(RESET), 1);
    } else {
        command(RESET, NULL, 0);
    }
    sleep_ms(150);
    command(SLEEP_OUT, NULL, 0);
    sleep_ms(120);
    command(PIXEL_FORMAT, format, 1);
    command(MEMORY_ORDER, order, 1);
    if (BOARD(INVERTED))
        command(INVERT, NULL, 0);
    if (BOARD(TE) != NO_PIN)
        command(TEARING_LINE, blanking, 1);
    command(DISPLAY_ON, NULL, 0);
    drain();
}

static const struct {
    uint8_t pin, key;
} keys[] = {
    { BOARD(UP), KEY_UP }, { BOARD(DOWN), KEY_DOWN }, { BOARD(LEFT), KEY_LEFT },
    { BOARD(RIGHT), KEY_RIGHT }, { BOARD(A), KEY_A }, { BOARD(START), KEY_START }
};

enum { KEYS = sizeof keys / sizeof *keys };

static void open_keys(void)
{
    for (int i = 0; i < KEYS; i++)
        if (keys[i].pin != NO_PIN) {
            gpio_init(keys[i].pin);
            gpio_set_pulls(keys[i].pin, BOARD(LEVEL) == 0, BOARD(LEVEL) != 0);
        }
}

bool display_open(smear_desc *desc)
{
    if (desc->width != BOARD(WIDTH) || desc->height != BOARD(HEIGHT) || desc->format != SMEAR_RGB565_SWAPPED)
        return false;
    desc->bands = 2;
    desc->workers = (uint8_t)board_cores();
    desc->flush = flush;
    desc->idle = idle;
    open_output(BOARD(CS), 1);
    open_output(BOARD(DC), 1);
    open_output(BOARD(RD), 1);
    open_output(BOARD(RESET), 1);
    open_output(BOARD(LED), 0);
    if (BOARD(TE) != NO_PIN)
        gpio_init(BOARD(TE));
    if (IS_PARALLEL)
        wires_open();
    else
        open_spi();
    gpio_put(BOARD(CS), 0);
    wake_panel();
    open_output(BOARD(LIGHT), 1);
    open_keys();
    open_dma();
    return true;
}

void display_attach(smear_context *ctx)
{
    bus.ctx = ctx;
    irq_set_exclusive_handler(DMA_IRQ_0, sent);
    irq_set_enabled(DMA_IRQ_0, true);
    if (board_cores() > 1)
        board_start_core1(work);
}

/* The frame's last bands are sent while the next frame is prepared. */
void display_show(void)
{
    bus.begun = false;
    const uint32_t state = save_and_disable_interrupts();
    bus.left = bus.waiting;
    if (bus.left == 0)
        end_frame();
    restore_interrupts(state);
}

/* Somebody may always be looking. */
bool display_wait(void)
{
    sleep_ms(10);
    return true;
}

uint32_t display_time(void) { return to_ms_since_boot(get_absolute_time()); }

unsigned display_keys(void)
{
    const uint32_t levels = gpio_get_all();
    unsigned held = 0;
    for (int i = 0; i < KEYS; i++)
        if (keys[i].pin != NO_PIN && (levels >> keys[i].pin & 1) == BOARD(LEVEL))
            held |= keys[i].key;
    return held;
}
