/* SPDX-License-Identifier: MIT */
/* gbarun.c - host program: runs a Game Boy Advance program in libmgba, without a window.
 *
 *     gbarun [-n FRAMES] [-s SHOT.ppm] [-k KEYS] [-p PROFILE] [-d DATA] PROGRAM.gba [ARGUMENT...]
 *
 * Prints what the program prints; ends with its exit status, with 99 when it does what it must not
 * (like an access to nowhere), or with 124 after FRAMES video frames [400000]. The arguments
 * are written into the cartridge's header (start.S).
 *
 * -s: takes a picture of the screen once the program has printed "shown", and ends. -k: a mask of
 * keys to press then, before a second "shown". -p: single steps and writes "ADDRESS CYCLES COUNT"
 * for every word of code that ran, then "jump FROM TO COUNT". -d: writes "ADDRESS CYCLES" and how often
 * it was read by 8, 16 and 32 bits, and written by these, for every 8 bytes of fast, slow and video memory, and of ROM's
 * first MB. */
#include <mgba/flags.h>         /* first: it says how the library was built */

#include <mgba/core/core.h>
#include <mgba/core/log.h>
#include <mgba/core/timing.h>
#include <mgba/internal/arm/arm.h>
#include <mgba-util/vfs.h>

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { COMMAND_LINE_AT = 0xd0, COMMAND_LINE_BYTES = 128, LIMIT_STATUS = 124, FAULT_STATUS = 99, KEY_FRAMES = 30 };

static struct {
    int status;                 /* -1 while it runs */
    int shown;                  /* times it said so */
} program = { .status = -1 };

static void take_log(struct mLogger *logger, int category, enum mLogLevel level, const char *format,
                     va_list arguments)
{
    char text[512];
    const char *id = mLogCategoryId(category);
    (void)logger;
    vsnprintf(text, sizeof text, format, arguments);
    if (id == NULL || strcmp(id, "gba.debug") != 0) {
        bool is_wrong = level & (mLOG_FATAL | mLOG_ERROR | mLOG_GAME_ERROR);
        if (is_wrong && program.status < 0) {
            fprintf(stderr, "gbarun: %s: %s\n", id != NULL ? id : "?", text);
            program.status = FAULT_STATUS;
        }
        return;
    }
    const char *exit_text = strstr(text, "#exit ");
    if (exit_text != NULL) {
        program.status = atoi(exit_text + 6);
        return;
    }
    program.shown += strcmp(text, "shown") == 0;
    printf("%s\n", text);
}

/* --- profile: one slot per word of ROM (its first MB), fast (and its first mirrors), slow and video memory --- */

enum { BANKS = 4, SLOTS = 262144 };
static struct { uint64_t cycles, count; } profile[BANKS][SLOTS];
static const uint32_t bank_base[BANKS] = { 0x08000000u, 0x03000000u, 0x02000000u, 0x06000000u };

/* --- data: what loads and stores took, by 8 bytes, in the same memories --- */

enum { DATA_SLOTS = 131072, WIDTHS = 3 };
static struct { int64_t cycles; uint32_t loads[WIDTHS], stores[WIDTHS]; } data[BANKS][DATA_SLOTS];
static struct ARMMemory plain;

static void note(uint32_t address, bool stores, int width, uint32_t words, int cycles)
{
    for (int bank = 0; bank < BANKS; bank++)
        if (address >> 24 == bank_base[bank] >> 24) {
            const uint32_t slot = (address & (bank == 1 ? 0x7fffu : bank == 0 ? 0xfffffu : 0x3ffffu)) >> 3;
            uint32_t *count = stores ? data[bank][slot].stores : data[bank][slot].loads;
            data[bank][slot].cycles += cycles;
            count[width] += words;
        }
}

/* Loads and stores of so many bits, noted as WIDTH: log2 of their bytes. The core's clock may be null. */
#define LOAD(BITS, WIDTH) \
    static uint32_t load_##BITS(struct ARMCore *cpu, uint32_t address, int *wait) \
    { \
        int took = 0; \
        const uint32_t value = plain.load##BITS(cpu, address, &took); \
        if (wait != NULL) \
            *wait += took; \
        note(address, false, WIDTH, 1, took); \
        return value; \
    }
#define STORE(BITS, WIDTH) \
    static void store_##BITS(struct ARMCore *cpu, uint32_t address, int##BITS##_t value, int *wait) \
    { \
        int took = 0; \
        plain.store##BITS(cpu, address, value, &took); \
        if (wait != NULL) \
            *wait += took; \
        note(address, true, WIDTH, 1, took); \
    }
LOAD(32, 2)
LOAD(16, 1)
LOAD(8, 0)
STORE(32, 2)
STORE(16, 1)
STORE(8, 0)

static void note_words(uint32_t address, int mask, enum LSMDirection direction, bool stores, int took)
{
    const int words = __builtin_popcount((unsigned)mask);
    uint32_t first = address;
    switch (direction) {
    case LSM_IA: break;
    case LSM_IB: first = address + 4; break;
    case LSM_DA: first = address - 4 * (uint32_t)words + 4; break;
    case LSM_DB: first = address - 4 * (uint32_t)words; break;
    }
    for (int i = 0; i < words; i++)
        note(first + 4 * (uint32_t)i, stores, 2, 1, (int)(took * (i + 1) / words - took * i / words));
}

static uint32_t load_words(struct ARMCore *cpu, uint32_t base, int mask, enum LSMDirection direction, int *wait)
{
    int took = 0;
    const uint32_t value = plain.loadMultiple(cpu, base, mask, direction, &took);
    if (wait != NULL)
        *wait += took;
    note_words(base, mask, direction, false, took);
    return value;
}

static uint32_t store_words(struct ARMCore *cpu, uint32_t base, int mask, enum LSMDirection direction, int *wait)
{
    int took = 0;
    const uint32_t value = plain.storeMultiple(cpu, base, mask, direction, &took);
    if (wait != NULL)
        *wait += took;
    note_words(base, mask, direction, true, took);
    return value;
}

static void watch_data(struct mCore *core)
{
    struct ARMCore *cpu = core->cpu;
    plain = cpu->memory;
    cpu->memory.load32 = load_32;
    cpu->memory.load16 = load_16;
    cpu->memory.load8 = load_8;
    cpu->memory.store32 = store_32;
    cpu->memory.store16 = store_16;
    cpu->memory.store8 = store_8;
    cpu->memory.loadMultiple = load_words;
    cpu->memory.storeMultiple = store_words;
}

static bool write_data(const char *path)
{
    FILE *file = fopen(path, "w");
    if (file == NULL)
        return false;
    for (int bank = 0; bank < BANKS; bank++)
        for (uint32_t i = 0; i < DATA_SLOTS; i++)
            if (data[bank][i].cycles != 0)
                fprintf(file, "%08x %lld %u %u %u %u %u %u\n", (unsigned)(bank_base[bank] + i * 8),
                        (long long)data[bank][i].cycles, data[bank][i].loads[0], data[bank][i].loads[1],
                        data[bank][i].loads[2], data[bank][i].stores[0], data[bank][i].stores[1],
                        data[bank][i].stores[2]);
    return fclose(file) == 0;
}

/* Jumps, by where they come from and where they go: calls are those to a function's start. */
enum { JUMPS = 1 << 17 };
static struct { uint32_t from, to; uint64_t count; } jump[JUMPS];

static void note_jump(uint32_t from, uint32_t to)
{
    uint32_t at = (from * 2654435761u ^ to * 40503u) >> 4 & (JUMPS - 1);
    for (int tries = 0; tries < JUMPS && jump[at].count != 0 && (jump[at].from != from || jump[at].to != to); tries++)
        at = (at + 1) & (JUMPS - 1);
    if (jump[at].count == 0 || (jump[at].from == from && jump[at].to == to)) {
        jump[at].from = from;
        jump[at].to = to;
        jump[at].count++;
    }
}

static void step_frame(struct mCore *core)
{
    static uint32_t last;
    uint32_t frame = core->frameCounter(core);
    while (core->frameCounter(core) == frame && program.status < 0) {
        uint32_t pc = 0, flags = 0;
        core->readRegister(core, "pc", &pc);
        core->readRegister(core, "cpsr", &flags);
        pc -= flags & 0x20 ? 2 : 4;     /* libmgba 0.10 is one instruction ahead between steps */
        if (pc - last > 4)
            note_jump(last, pc);
        last = pc;
        uint32_t before = (uint32_t)mTimingCurrentTime(core->timing);
        core->step(core);
        uint32_t took = (uint32_t)mTimingCurrentTime(core->timing) - before;
        for (int bank = 0; bank < BANKS; bank++)
            if (pc >> 24 == bank_base[bank] >> 24) {
                uint32_t slot = (pc & (bank == 1 ? 0x1ffffu : bank == 0 ? 0xfffffu : 0x3ffffu)) >> 2;
                profile[bank][slot].cycles += took;
                profile[bank][slot].count++;
            }
    }
}

static bool write_profile(const char *path)
{
    FILE *file = fopen(path, "w");
    if (file == NULL)
        return false;
    for (int bank = 0; bank < BANKS; bank++)
        for (uint32_t i = 0; i < SLOTS; i++)
            if (profile[bank][i].count != 0)
                fprintf(file, "%08x %llu %llu\n", (unsigned)(bank_base[bank] + i * 4),
                        (unsigned long long)profile[bank][i].cycles,
                        (unsigned long long)profile[bank][i].count);
    for (int i = 0; i < JUMPS; i++)
        if (jump[i].count != 0)
            fprintf(file, "jump %08x %08x %llu\n", (unsigned)jump[i].from, (unsigned)jump[i].to,
                    (unsigned long long)jump[i].count);
    return fclose(file) == 0;
}

/* --- picture --- */

static bool write_picture(const char *path, const color_t *pixel, unsigned width, unsigned height)
{
    FILE *file = fopen(path, "wb");
    if (file == NULL)
        return false;
    fprintf(file, "P6\n%u %u\n255\n", width, height);
    for (unsigned i = 0; i < width * height; i++) {
        const uint8_t rgb[3] = { (uint8_t)pixel[i], (uint8_t)(pixel[i] >> 8),
                                 (uint8_t)(pixel[i] >> 16) };
        fwrite(rgb, 1, sizeof rgb, file);
    }
    return fclose(file) == 0;
}

/* Frames until the program has said "shown" so many times, or has ended. */
static int run_until_shown(struct mCore *core, int times, int frames, int limit)
{
    for (; program.status < 0 && program.shown < times && frames < limit; frames++)
        core->runFrame(core);
    return frames;
}

/* Presses the keys, waits for the answer, and lets the picture come out. */
static void take_picture(struct mCore *core, uint32_t keys, int limit)
{
    int frames = run_until_shown(core, 1, 0, limit);
    if (keys != 0 && program.status < 0) {
        core->setKeys(core, keys);
        for (int i = 0; i < KEY_FRAMES; i++)
            core->runFrame(core);
        core->setKeys(core, 0);
        run_until_shown(core, 2, frames, limit);
    }
    for (int i = 0; i < 3; i++)
        core->runFrame(core);
}

static uint8_t *read_program(const char *path, size_t *size)
{
    FILE *file = fopen(path, "rb");
    if (file == NULL)
        return NULL;
    fseek(file, 0, SEEK_END);
    long length = ftell(file);
    rewind(file);
    uint8_t *bytes = length > COMMAND_LINE_AT + COMMAND_LINE_BYTES ? malloc((size_t)length) : NULL;
    if (bytes != NULL && fread(bytes, 1, (size_t)length, file) != (size_t)length) {
        free(bytes);
        bytes = NULL;
    }
    fclose(file);
    *size = bytes != NULL ? (size_t)length : 0;
    return bytes;
}

int main(int argc, char **argv)
{
    const char *shot = NULL, *profile_path = NULL, *data_path = NULL;
    int limit = 400000, at = 1;
    uint32_t keys = 0;
    for (; at + 1 < argc && argv[at][0] == '-'; at += 2) {
        switch (argv[at][1]) {
        case 'n': limit = atoi(argv[at + 1]); break;
        case 's': shot = argv[at + 1]; break;
        case 'k': keys = (uint32_t)strtoul(argv[at + 1], NULL, 0); break;
        case 'p': profile_path = argv[at + 1]; break;
        case 'd': data_path = argv[at + 1]; break;
        default: argc = 0;
        }
    }
    if (at >= argc) {
        fprintf(stderr, "usage: gbarun [-n FRAMES] [-s SHOT.ppm] [-k KEYS] [-p PROFILE] [-d DATA] "
                        "PROGRAM.gba [ARGUMENT...]\n");
        return 2;
    }
    size_t size;
    uint8_t *rom = read_program(argv[at], &size);
    if (rom == NULL) {
        fprintf(stderr, "gbarun: %s: cannot be read, or is no program\n", argv[at]);
        return 2;
    }
    char *line = (char *)rom + COMMAND_LINE_AT;
    for (int i = at + 1, used = 0; i < argc; i++)
        used += snprintf(line + used, (size_t)(COMMAND_LINE_BYTES - used), "%s ", argv[i]);

    struct mLogger logger = { .log = take_log };
    mLogSetDefaultLogger(&logger);
    struct VFile *file = VFileFromConstMemory(rom, size);
    struct mCore *core = file != NULL ? mCoreFindVF(file) : NULL;
    if (core == NULL || !core->init(core)) {
        fprintf(stderr, "gbarun: %s: is no program\n", argv[at]);
        return 2;
    }
    mCoreInitConfig(core, NULL);
    unsigned width, height;
    core->desiredVideoDimensions(core, &width, &height);
    color_t *pixels = calloc((size_t)width * height, sizeof *pixels);
    core->setVideoBuffer(core, pixels, width);
    if (!core->loadROM(core, file)) {
        fprintf(stderr, "gbarun: %s: cannot be loaded\n", argv[at]);
        return 2;
    }
    core->opts.skipBios = true;
    core->reset(core);
    if (data_path != NULL)
        watch_data(core);

    bool ok = true;
    if (shot != NULL) {
        take_picture(core, keys, limit);
        if (program.shown < 1 + (keys != 0)) {
            fprintf(stderr, "gbarun: %s: showed nothing\n", argv[at]);
            return program.status > 0 ? program.status : LIMIT_STATUS;
        }
        program.status = 0;
        ok = write_picture(shot, pixels, width, height);
    }
    for (int frames = 0; program.status < 0 && frames < limit; frames++) {
        if (profile_path != NULL)
            step_frame(core);
        else
            core->runFrame(core);
    }
    ok = ok && (profile_path == NULL || write_profile(profile_path)) && (data_path == NULL || write_data(data_path));
    mCoreConfigDeinit(&core->config);
    core->deinit(core);
    free(pixels);
    free(rom);
    if (!ok)
        fprintf(stderr, "gbarun: cannot write what was asked for\n");
    return !ok ? 2 : program.status < 0 ? LIMIT_STATUS : program.status;
}
