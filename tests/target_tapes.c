/* SPDX-License-Identifier: MIT */
/* target_tapes.c - host program that records the tapes which the programs for targets play.
 *
 *     target_tapes golden OUT.c GOLDEN.txt     frames with known CRCs, all within 256 kB of RAM
 *     target_tapes bench OUT.c                 the peers' scenes at 320x240, whole and in bands
 *
 * A line of GOLDEN.txt is `TAPE FRAME CRC`; other lines are comments. A tape of which a frame is
 * missing there is recorded without CRCs, and target_golden fails; `target_golden list` prints
 * them. */
#include "../tools/scenes/present.h"
#include "../tools/scenes/tape.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

struct spec {
    const char *name, *scene;
    int first, count, step;         /* frames at the scene's rate */
    smear_desc desc;                /* max_draws 0: as many as there are */
    struct present_options present; /* fps, clear and a shutter of 0 degrees are filled in */
};

enum { DEFAULT_SHUTTER_DEGREES = 180, MAX_FRAMES = 64, MAX_GOLDEN_BYTES = 1 << 20 };

/* Every method, output format, dither and light, all tile sizes, both pose models, kept poses, a
 * cut, a full triangle list; sizes that are no multiple of anything; one for 16 kB of RAM. */
static const struct spec golden[] = {
    { "none-xrgb", "peer/E", 0, 2, 1,
      { .width = 160, .height = 120, .format = SMEAR_XRGB8888, .max_triangles = 600 },
      { .method = SMEAR_NONE } },
    { "sharp-565", "peer/B64", 3, 2, 1,
      { .width = 160, .height = 120, .format = SMEAR_RGB565, .sharp = 1, .band_rows = 24 },
      { .method = SMEAR_NONE } },
    { "accumulate-332", "peer/E", 2, 1, 1,
      { .width = 96, .height = 64, .format = SMEAR_RGB332, .sharp = 1, .accumulate = 1 },
      { .method = SMEAR_ACCUMULATE, .samples = 5 } },
    { "accumulate-poses", "demo/race", 7, 1, 1,
      { .width = 97, .height = 61, .format = SMEAR_XRGB8888, .sharp = 1, .accumulate = 1 },
      { .method = SMEAR_ACCUMULATE, .samples = 4, .shutter_poses = true } },
    { "reconstruct-565", "peer/E", 1, 2, 1,
      { .width = 160, .height = 120, .reach = 8, .format = SMEAR_RGB565, .max_triangles = 600 },
      { .samples = 8 } },
    { "reconstruct-swapped", "peer/B64", 5, 2, 1,
      { .width = 128, .height = 128, .reach = 12, .format = SMEAR_RGB565_SWAPPED,
        .dither = SMEAR_DITHER_BLUE },
      { .samples = 6, .shutter_degrees = 270, .exposure = SMEAR_TRAILING } },
    { "reconstruct-555", "demo/race", 12, 2, 1,
      { .width = 120, .height = 80, .reach = 6, .format = SMEAR_RGB555 },
      { .shutter_poses = true, .reconstruct = SMEAR_FENCE | SMEAR_CORNER } },
    { "reconstruct-l8", "demo/drone", 4, 2, 1,
      { .width = 101, .height = 75, .reach = 15, .tile = 32, .format = SMEAR_L8 },
      { .samples = 12, .reconstruct = SMEAR_BOX | SMEAR_DIRECTION } },
    { "reconstruct-l4", "demo/race", 20, 2, 1,
      { .width = 128, .height = 64, .reach = 8, .format = SMEAR_L4 },
      { .light = SMEAR_LIGHT_ENCODED, .exposure = SMEAR_LEADING, .reconstruct = SMEAR_UNIFORM } },
    { "reconstruct-l1", "demo/drone", 9, 2, 1,
      { .width = 133, .height = 65, .reach = 8, .format = SMEAR_L1 }, { .shutter_degrees = 360 } },
    { "reconstruct-pages", "peer/E", 6, 2, 1,
      { .width = 128, .height = 64, .reach = 5, .format = SMEAR_L1_PAGES,
        .dither = SMEAR_DITHER_BLUE },
      { .shutter_degrees = 90 } },
    { "far-reach", "peer/B64", 2, 1, 1,
      { .width = 100, .height = 70, .reach = 40, .tile = 64, .format = SMEAR_RGB565,
        .dither = SMEAR_DITHER_NONE },
      { .shutter_degrees = 720, .samples = 16 } },
    { "kept", "demo/race", 30, 4, 1,
      { .width = 120, .height = 90, .reach = 8, .format = SMEAR_RGB565 }, { .keep_ids = true } },
    { "full-list", "peer/E", 3, 1, 1,
      { .width = 96, .height = 96, .reach = 8, .format = SMEAR_RGB565, .max_triangles = 64 },
      { .samples = 4 } },
    { "tiny", "peer/E", 5, 2, 1,
      { .width = 64, .height = 48, .format = SMEAR_L1_PAGES, .sharp = 1, .band_rows = 8,
        .max_triangles = 96 },
      { .method = SMEAR_NONE } },
    { "cut", "peer/E", 4, 1, 1,
      { .width = 64, .height = 48, .reach = 8, .format = SMEAR_RGB565 }, { .cut = true } },
};

/* The peers' scenes as they were measured: 320x240, RGB565, frames 0, 2, 4, 6; and two blurred. */
static const struct spec bench[] = {
    { "A whole", "peer/A", 0, 4, 2, { .band_rows = 240, .max_triangles = 24000 },
      { .method = SMEAR_NONE } },
    { "A bands", "peer/A", 0, 4, 2, { .band_rows = 16, .max_triangles = 24000 },
      { .method = SMEAR_NONE } },
    { "B64 whole", "peer/B64", 0, 4, 2, { .band_rows = 240, .max_triangles = 1000 },
      { .method = SMEAR_NONE } },
    { "B64 bands", "peer/B64", 0, 4, 2, { .band_rows = 16, .max_triangles = 1000 },
      { .method = SMEAR_NONE } },
    { "B256 whole", "peer/B256", 0, 4, 2, { .band_rows = 240, .max_triangles = 1000 },
      { .method = SMEAR_NONE } },
    { "C whole", "peer/C", 0, 4, 2, { .band_rows = 240, .max_triangles = 64 },
      { .method = SMEAR_NONE } },
    { "C bands", "peer/C", 0, 4, 2, { .band_rows = 16, .max_triangles = 64 },
      { .method = SMEAR_NONE } },
    { "D whole", "peer/D", 0, 4, 2, { .band_rows = 240, .max_triangles = 52000 },
      { .method = SMEAR_NONE } },
    { "D bands", "peer/D", 0, 4, 2, { .band_rows = 16, .max_triangles = 52000 },
      { .method = SMEAR_NONE } },
    { "E whole", "peer/E", 0, 4, 2, { .band_rows = 240, .max_triangles = 640 },
      { .method = SMEAR_NONE } },
    { "E bands", "peer/E", 0, 4, 2, { .band_rows = 16, .max_triangles = 640 },
      { .method = SMEAR_NONE } },
    { "B64 blurred", "peer/B64", 0, 4, 2, { .reach = 12, .max_triangles = 1000 },
      { .method = SMEAR_RECONSTRUCT, .samples = 8 } },
    { "E blurred", "peer/E", 0, 4, 2, { .reach = 12, .max_triangles = 640 },
      { .method = SMEAR_RECONSTRUCT, .samples = 8 } },
};

static void complete_bench(struct spec *spec)
{
    spec->desc.width = 320;
    spec->desc.height = 240;
    spec->desc.format = SMEAR_RGB565;
    spec->desc.dither = SMEAR_DITHER_NONE;
    spec->desc.sharp = spec->present.method == SMEAR_NONE;
}

/* The CRC of a frame in the text of GOLDEN.txt; false when it has none. */
static bool find_crc(const char *text, const char *tape, int frame, uint32_t *crc)
{
    char wanted[96];
    int length = snprintf(wanted, sizeof wanted, "%s %d ", tape, frame);
    for (const char *line = text; line != NULL && *line != '\0'; line = strchr(line, '\n')) {
        if (*line == '\n')
            line++;
        char *end;
        if (strncmp(line, wanted, (size_t)length) != 0)
            continue;
        *crc = (uint32_t)strtoul(line + length, &end, 16);
        return end > line + length;
    }
    return false;
}

static bool record(struct tape_writer *writer, const struct spec *spec, const char *crcs,
                   struct failure *f)
{
    struct scene scene = { 0 };
    if (!scene_builtin(spec->scene, &scene, f))
        return false;
    struct present_options options = spec->present;
    options.fps = scene.fps;
    options.clear = scene.clear;
    if (options.shutter_degrees == 0.0)
        options.shutter_degrees = DEFAULT_SHUTTER_DEGREES;
    struct presenter *presenter = presenter_new(&scene, f);
    bool ok = presenter != NULL;
    for (int i = 0; i < spec->count && ok; i++) {
        int frame = spec->first + i * spec->step;
        const struct presented *presented =
            presenter_frame(presenter, frame / scene.fps, &options, f);
        ok = presented != NULL;
        if (ok && i == 0) {
            smear_desc desc = spec->desc;
            /* no draw of these scenes appears later than in the first frame */
            desc.max_draws = presented_desc(presented, desc.width, desc.height).max_draws;
            ok = tape_begin(writer, spec->name, &desc, f);
        }
        uint32_t crc;
        bool has_crc = crcs != NULL && find_crc(crcs, spec->name, i, &crc);
        ok = ok && tape_add(writer, presented, has_crc ? &crc : NULL, f);
    }
    presenter_free(presenter);
    scene_free(&scene);
    return ok;
}

int main(int argc, char **argv)
{
    struct failure f = { "" };
    bool is_golden = argc == 4 && strcmp(argv[1], "golden") == 0;
    bool is_bench = argc == 3 && strcmp(argv[1], "bench") == 0;
    if (!is_golden && !is_bench) {
        fprintf(stderr, "usage: target_tapes golden OUT.c GOLDEN.txt | target_tapes bench OUT.c\n");
        return 2;
    }
    uint8_t *crcs = NULL;
    size_t size;
    const char *file = is_golden ? argv[3] : argv[2];
    bool ok = !is_golden || file_read(file, MAX_GOLDEN_BYTES, &crcs, &size, &f);
    struct tape_writer *writer = ok ? tape_writer_new(&f) : NULL;
    ok = writer != NULL;
    int count = is_golden ? (int)(sizeof golden / sizeof *golden)
                          : (int)(sizeof bench / sizeof *bench);
    for (int i = 0; i < count && ok; i++) {
        struct spec spec = is_golden ? golden[i] : bench[i];
        if (is_golden)
            spec.desc.crc = 1;
        else
            complete_bench(&spec);
        file = spec.name;
        ok = record(writer, &spec, (const char *)crcs, &f);
    }
    if (ok) {
        file = argv[2];
        ok = tape_write(writer, file, is_golden ? "target_tapes golden" : "target_tapes bench", &f);
    }
    tape_writer_free(writer);
    free(crcs);
    if (!ok)
        fprintf(stderr, "target_tapes: %s: %s\n", file, f.text);
    return ok ? 0 : 1;
}
