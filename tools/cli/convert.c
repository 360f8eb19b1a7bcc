/* SPDX-License-Identifier: MIT */
/* convert.c - `smear convert`: a model, or a picture for what lies over frames, as constant data for firmware. */
#include "tools/cli/commands.h"

#include "tools/convert/convert.h"
#include "tools/convert/segments.h"
#include "tools/convert/sketch.h"
#include "tools/convert/sprite.h"
#include "tools/image/file.h"
#include "tools/image/image.h"
#include "tools/options/apart.h"
#include "tools/options/arguments.h"
#include "tools/options/say.h"
#include "tools/options/source.h"

#include <stdlib.h>
#include <string.h>

enum { MAX_CHOICES = 64, LINES_BYTES_MOST = 16 << 20 };

struct convert_command {
    const char *output, *name;
    const char *clip[MAX_CHOICES], *keep[MAX_CHOICES];
    int clip_count, keep_count;
    enum model_files files;
    long max_triangles, max_flash, max_ram;     /* 0: no limit */
    struct convert_options options;
    struct sprite_options sprite;
    struct sketch_options sketch;
    const char *kit;
    bool is_sprite, is_sketch;  /* an option says so */
    bool lines;                 /* of an OBJ file these, and nothing else */
    bool double_sided;
};

/* ------------------------------------------------------------------ options */

static const char *read_identifier(void *to, const char *value)
{
    size_t length = strlen(value);
    ((struct convert_command *)to)->name = value;
    if (length == 0 || length > 60 || (value[0] >= '0' && value[0] <= '9')
        || strspn(value, "abcdefghijklmnopqrstuvwxyz0123456789_") != length)
        return "needs small letters, digits and underscores";
    return NULL;
}

static const char *read_clips(void *to, const char *value)
{
    struct convert_command *c = to;
    if (c->clip_count == MAX_CHOICES)
        return "at most 64 times";
    c->clip[c->clip_count++] = value;
    return NULL;
}

static const char *read_keep(void *to, const char *value)
{
    struct convert_command *c = to;
    if (c->keep_count == MAX_CHOICES)
        return "at most 64 times";
    c->keep[c->keep_count++] = value;
    return NULL;
}

static const char *read_cell(void *to, const char *value)
{
    struct convert_command *c = to;
    c->is_sprite = true;
    return read_size(value, 2048, &c->sprite.cell_width, &c->sprite.cell_height) ? NULL : "needs WIDTHxHEIGHT, at most 2048x2048";
}

static const char *read_key(void *to, const char *value)
{
    struct convert_command *c = to;
    unsigned rgb;
    if (!read_color(value, &rgb))
        return "needs RRGGBB";
    c->sprite.key = rgb;
    c->is_sprite = c->sprite.has_key = true;
    return NULL;
}

static const char *read_display(void *to, const char *value)
{
    struct convert_command *c = to;
    c->is_sketch = true;
    c->sketch.display = read_name(value, sketch_displays);
    return c->sketch.display >= 0 ? NULL : "needs one of smear help convert";
}

static const char *read_screen(void *to, const char *value)
{
    struct convert_command *c = to;
    c->is_sketch = true;
    return read_size(value, 2048, &c->sketch.width, &c->sketch.height) ? NULL : "needs WIDTHxHEIGHT, at most 2048x2048";
}

#define AT(member) OPTION_AT(struct convert_command, member)
#define SPRITE .given = offsetof(struct convert_command, is_sprite)
#define SKETCH .given = offsetof(struct convert_command, is_sketch)
#define LIMIT .low = 1, .high = 1 << 30

static const struct option table[] = {
    { "-o", OPTION_TEXT, AT(output) },
    { "--name", OPTION_READ, .read = read_identifier },
    { "--clip", OPTION_READ, .read = read_clips },
    { "--keep", OPTION_READ, .read = read_keep },
    { "--scale", OPTION_NUMBER, AT(options.scale), .low = 1e-9, .high = 1e9, .needs = "a factor" },
    { "--fit", OPTION_NUMBER, AT(options.fit), .low = 1e-3, .high = 20000, .needs = "units" },
    { "--up", OPTION_NAME, AT(options.z_up), OPTION_NAMES("y", "z") },
    { "--texture", OPTION_NAME, AT(options.texture), OPTION_NAMES("palette8", "rgb565", "rgb8888", "baked", "none") },
    { "--texture-size", OPTION_INTEGER, AT(options.texture_edge), .low = 1, .high = 4096, .needs = "pixels" },
    { "--colors", OPTION_INTEGER, AT(options.colors), .low = 2, .high = 256 },
    { "--mipmaps", OPTION_FLAG, AT(options.mipmaps) },
    { "--filter", OPTION_NAME, AT(options.bilinear), OPTION_NAMES("nearest", "bilinear") },
    { "--normals", OPTION_NAME, AT(options.flat), OPTION_NAMES("keep", "flat") },
    { "--influences", OPTION_INTEGER, AT(options.influences), .low = 1, .high = 4 },
    { "--clip-error", OPTION_NUMBER, AT(options.clip_error_px), .low = 1e-3, .high = 100, .needs = "pixels" },
    { "--distance", OPTION_NUMBER, AT(options.distance), .low = 1e-6, .high = 1e9, .needs = "units" },
    { "--rows", OPTION_NUMBER, AT(options.rows), .low = 1, .high = 2048, .needs = "rows" },
    { "--outside", OPTION_FLAG, AT(files) },
    { "--double-sided", OPTION_FLAG, AT(double_sided) },
    { "--fov", OPTION_NUMBER, AT(options.fov_degrees), .low = 0.01, .high = 179, .needs = "degrees" },
    { "--max-triangles", OPTION_INTEGER, AT(max_triangles), LIMIT },
    { "--max-flash", OPTION_INTEGER, AT(max_flash), LIMIT },
    { "--max-ram", OPTION_INTEGER, AT(max_ram), LIMIT },
    { "--cell", OPTION_READ, .read = read_cell },
    { "--key", OPTION_READ, .read = read_key },
    { "--mask", OPTION_FLAG, AT(sprite.mask), SPRITE },
    { "--font", OPTION_INTEGER, AT(sprite.first), .given = offsetof(struct convert_command, sprite.font), .high = 255,
      .needs = "the code of its first letter" },
    { "--lines", OPTION_FLAG, AT(lines) },
    { "--kit", OPTION_TEXT, AT(kit), SKETCH },
    { "--display", OPTION_READ, .read = read_display },
    { "--size", OPTION_READ, .read = read_screen },
    { "--quality", OPTION_NAME, AT(sketch.quality), SKETCH, OPTION_NAMES("sharp", "draft", "balanced", "fine") },
    { .name = NULL },
};

static bool ends_with(const char *text, const char *end)
{
    size_t length = strlen(text), tail = strlen(end);
    return length > tail && strcmp(text + length - tail, end) == 0;
}

/* ------------------------------------------------------------------ what of the model */

static int choose_clips(const struct convert_command *c, const struct model *model, int *clip, int *count)
{
    *count = 0;
    if (c->clip_count == 0 || (c->clip_count == 1 && strcmp(c->clip[0], "all") == 0
                               && model_find_clip(model, "all") < 0)) {
        for (int i = 0; i < model->clip_count; i++)
            clip[(*count)++] = i;
        return STATUS_OK;
    }
    for (int i = 0; i < c->clip_count; i++) {
        int found = model_find_clip(model, c->clip[i]);
        const bool is_word = found < 0 && (strcmp(c->clip[i], "none") == 0 || strcmp(c->clip[i], "all") == 0);
        if (is_word && c->clip_count > 1)
            return say_bad_usage("--clip", "%s goes with no other --clip", c->clip[i]);
        if (is_word)
            return STATUS_OK;
        if (found < 0)
            return source_say_no_clip(model, c->clip[i]);
        for (int k = 0; k < *count; k++)
            if (clip[k] == found)
                return say_bad_usage("--clip", "given twice (\"%s\")", c->clip[i]);
        clip[(*count)++] = found;
    }
    return STATUS_OK;
}

static int choose_kept_nodes(const struct convert_command *c, const struct model *model, uint8_t *keep)
{
    for (int i = 0; i < c->keep_count; i++) {
        int found = model_find_node(model, c->keep[i]);
        long index;
        if (found < 0 && strcmp(c->keep[i], "all") == 0) {
            memset(keep, 1, (size_t)model->node_count);
            continue;
        }
        if (found < 0 && read_integer(c->keep[i], 0, model->node_count - 1, &index))
            found = (int)index;
        if (found < 0)
            return source_say_no_node(model, "--keep", c->keep[i]);
        keep[found] = 1;
    }
    return STATUS_OK;
}

/* ------------------------------------------------------------------ what came out */

static void print_quoted(FILE *to, const char *name)
{
    fputc('"', to);
    for (; *name != '\0'; name++)
        fputc((unsigned char)*name < 32 || *name == 127 ? '?' : *name, to);
    fputc('"', to);
}

static void print_textures(FILE *to, const struct conversion *c)
{
    static const char *const format[] = { "rgb8888", "rgb565", "palette8" };
    fprintf(to, "textures: %d\n", c->texture_count);
    for (int i = 0; i < c->texture_count; i++) {
        const struct convert_texture_report *t = &c->texture_report[i];
        fprintf(to, "  %d %dx%d from %dx%d, %s", i, t->width, t->height, t->from_width, t->from_height,
                format[c->texture[i].format]);
        if (t->colors > 0)
            fprintf(to, ", %d colours", t->colors);
        if (c->texture[i].levels > 0)
            fprintf(to, ", %d smaller pictures", c->texture[i].levels);
        if (c->same_texels[i] != i)
            fprintf(to, ", texels of %d\n", c->same_texels[i]);
        else
            fprintf(to, ", rms error %.2f codes\n", t->rms);
    }
}

static void print_result(FILE *to, const struct conversion *c, const struct convert_options *o)
{
    const smear_model *m = &c->model;
    size_t flash = c->bytes.meshes + c->bytes.textures + c->bytes.animation;
    int jumps = 0;
    fprintf(to, "triangles: %d", c->triangles);
    if (c->triangles != c->triangles_in_file)
        fprintf(to, " of %d", c->triangles_in_file);
    fprintf(to, "\nvertices: %d of %d\n", c->vertices, c->vertices_in_file);
    fprintf(to, "draws: %u, materials: %u, nodes: %u\n", m->draw_count, m->material_count, m->node_count);
    if (c->invisible > 0)
        fprintf(to, "left out: %d draws that let nothing be seen\n", c->invisible);
    if (c->triangles > 0)
        fprintf(to, "vertices transformed per triangle: %.2f, in the file's order %.2f\n",
                (double)c->transformed / c->triangles, (double)c->transformed_in_file / c->triangles_in_file);
    print_textures(to, c);
    const bool has_second = (c->lights.diffuse[0] | c->lights.diffuse[1] | c->lights.diffuse[2]) != 0;
    if (c->has_sun || c->has_lights || c->lamp_is_beyond)
        fprintf(to, "lights:%s%s%s%s\n", c->has_sun ? " sun" : "", has_second ? " second" : "", c->lights.reach > 0 ? " lamp" : "",
                c->lamp_is_beyond ? " (a lamp beyond 32767 units is left out)" : "");
    fprintf(to, "clips: %u\n", m->clip_count);
    for (int i = 0; i < m->clip_count; i++) {
        jumps += c->clip_report[i].jumps;
        const struct convert_clip_report *r = &c->clip_report[i];
        fprintf(to, "  %d ", i);
        print_quoted(to, m->text + m->clip[i].name);
        fprintf(to, " %.6g s, %u channels, %d keys of %d, position error %.3f px at %.3f s\n",
                m->clip[i].duration / 65536.0, m->clip[i].channel_count, r->keys, r->keys_in_file, r->error_px,
                r->error_time);
    }
    if (jumps > 0)
        fprintf(to, "jumps: %d that no blur joins; keys tell them, 0 bytes of flash and %u of an actor's ram\n", jumps,
                (unsigned)CONVERT_JUMP_BYTES);
    fprintf(to, "flash: %zu bytes (meshes %zu, textures %zu, nodes, skins and clips %zu)\n", flash,
            c->bytes.meshes, c->bytes.textures, c->bytes.animation);
    fprintf(to, "ram: %zu bytes an actor with 2 poses (1: %zu, 3: %zu), %zu more for a blob; 32-bit pointers\n",
            c->bytes.actor[1], c->bytes.actor[0], c->bytes.actor[2], c->bytes.open);
    fprintf(to, "largest position error: %.3f px, at rest %.3f (%g rows, %g degrees, at %.6g units)\n",
            c->error_px, c->rest_error_px, o->rows, o->fov_degrees, c->distance);
}

static int check_limits(const struct convert_command *command, const char *path, const struct conversion *c)
{
    struct failure f = { "" };
    size_t flash = c->bytes.meshes + c->bytes.textures + c->bytes.animation;
    if (command->max_triangles > 0 && c->triangles > command->max_triangles)
        fail(&f, "has %d triangles, more than %ld (--max-triangles); smear does not simplify", c->triangles,
             command->max_triangles);
    else if (command->max_flash > 0 && flash > (size_t)command->max_flash)
        fail(&f, "takes %zu bytes of flash (meshes %zu, textures %zu, animation %zu), "
             "more than %ld (--max-flash)", flash, c->bytes.meshes, c->bytes.textures, c->bytes.animation,
             command->max_flash);
    else if (command->max_ram > 0 && c->bytes.actor[1] > (size_t)command->max_ram)
        fail(&f, "takes %zu bytes of RAM with 2 poses, more than %ld (--max-ram)", c->bytes.actor[1],
             command->max_ram);
    else
        return STATUS_OK;
    return say_bad_input(path, &f);
}

/* ------------------------------------------------------------------ files */

static const char *base_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash != NULL ? slash + 1 : path;
}

/* An identifier from the name of the file to be written. */
static void name_from(const char *path, char out[64])
{
    const char *base = base_name(path);
    size_t length = 0;
    if (base[0] >= '0' && base[0] <= '9')
        out[length++] = '_';
    for (; base[0] != '\0' && base[0] != '.' && length < 60; base++) {
        char c = base[0] >= 'A' && base[0] <= 'Z' ? (char)(base[0] - 'A' + 'a') : base[0];
        out[length++] = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') ? c : '_';
    }
    out[length] = '\0';
}

static bool is_standard_output(const char *path)
{
    return strcmp(path, "-") == 0;
}

static bool write_bytes(const char *path, const uint8_t *bytes, size_t size, struct failure *f)
{
    struct output o;
    if (!is_standard_output(path))
        return file_write(path, bytes, size, f);
    if (!output_open_text(&o, path, f))
        return false;
    if (fwrite(bytes, 1, size, o.stream) == size)
        return output_commit(&o, f);
    output_discard(&o);
    return fail(f, "out of memory");
}

/* Bytes of a header, blob or sketch, by the output's name. */
static bool make_result(const struct convert_command *command, const char *path, const struct conversion *c, struct sketch_report *report,
                        uint8_t **bytes, size_t *size, struct failure *f)
{
    const bool is_text = is_standard_output(command->output);
    uint8_t *kit;
    size_t kit_size;
    char name[64];
    name_from(is_text ? path : command->output, name);
    if (ends_with(command->output, ".smr"))
        return convert_to_blob(c, bytes, size, f);
    if (!ends_with(command->output, ".zip"))
        return convert_to_header(c, command->name != NULL ? command->name : name, base_name(path), bytes, size, f);
    struct failure why = { "" };
    if (!file_read(command->kit, 1 << 24, &kit, &kit_size, &why))
        return fail(f, "its kit %.100s: %.200s", command->kit, why.text);
    struct sketch_options o = command->sketch;
    o.max_ram = command->max_ram;
    const bool ok = convert_to_sketch(c, &o, command->name != NULL ? command->name : name + strspn(name, "_"), base_name(path), kit,
                                      kit_size, bytes, size, report, f);
    free(kit);
    return ok;
}

static void print_sketch(const struct sketch_report *r)
{
    if (r->width > 0)
        printf("sketch: %dx%d, %d triangles at once\nram of the sketch: %zu bytes (library %zu, poses %zu)\n"
               "flash of the sketch: %zu bytes (model %zu, library %zu or so; %zu by -Os)\n", r->width, r->height, r->triangles,
               r->context + r->actor, r->context, r->actor, r->model + r->library, r->model, r->library, r->small);
}

/* The report goes where the header doesn't, and before the file has its name: neither is there without the other. */
static int write_result(const struct convert_command *command, const char *path, const struct conversion *c)
{
    struct failure f = { "" };
    bool is_text = is_standard_output(command->output);
    struct sketch_report sketch = { 0 };
    uint8_t *bytes;
    size_t size;
    bool ok = make_result(command, path, c, &sketch, &bytes, &size, &f);
    if (!ok)
        return say_bad_input(path, &f);
    if ((c->has_sun || c->has_lights) && (ends_with(command->output, ".smr") || ends_with(command->output, ".zip")))
        say_warning_when_done(path, "its lights are left out: headers have them, .smr and sketches do not");
    outputs_hold();
    ok = write_bytes(command->output, bytes, size, &f);
    free(bytes);
    if (!ok)
        return say_bad_input(is_text ? "standard output" : command->output, &f);
    if (!is_text) {
        print_result(stdout, c, &command->options);
        print_sketch(&sketch);
        printf("wrote %s\n", command->output);
    }
    ok = output_flush_standard(&f);
    if (!ok || !outputs_publish(NULL, &f)) {
        outputs_drop();
        return say_bad_input(!ok || is_text ? "standard output" : command->output, &f);
    }
    if (is_text)
        print_result(stderr, c, &command->options);
    return STATUS_OK;
}

static int convert_loaded(struct convert_command *command, const char *path, const struct model *model)
{
    struct failure f = { "" };
    struct conversion conversion;
    int *clip = calloc((size_t)model->clip_count + MAX_CHOICES, sizeof *clip), status;
    uint8_t *keep = calloc((size_t)model->node_count + 1, 1);
    if (clip == NULL || keep == NULL) {
        fail(&f, "out of memory");
        status = say_bad_input(path, &f);
    } else {
        status = choose_clips(command, model, clip, &command->options.clip_count);
        if (status == STATUS_OK)
            status = choose_kept_nodes(command, model, keep);
        command->options.clip = clip;
        command->options.keep = keep;
        if (status == STATUS_OK && !convert_model(model, &command->options, &conversion, &f)) {
            status = say_bad_input(path, &f);
        } else if (status == STATUS_OK) {
            status = check_limits(command, path, &conversion);
            if (status == STATUS_OK)
                status = write_result(command, path, &conversion);
            conversion_free(&conversion);
        }
    }
    free(clip);
    free(keep);
    return status;
}

static bool is_picture(const char *path)
{
    return ends_with(path, ".png") || ends_with(path, ".ppm");
}

/* Writes a header that something other than a model has become, and what it holds: `report`. */
static int write_header(const struct convert_command *command, const uint8_t *bytes, size_t size, const char *report)
{
    struct failure f = { "" };
    const bool is_text = is_standard_output(command->output);
    int status = STATUS_OK;
    if (!write_bytes(command->output, bytes, size, &f))
        status = say_bad_input(is_text ? "standard output" : command->output, &f);
    if (status == STATUS_OK)
        fprintf(is_text ? stderr : stdout, "%s\n%s%s%s", report, is_text ? "" : "wrote ", is_text ? "" : command->output,
                is_text ? "" : "\n");
    if (status == STATUS_OK && !output_flush_standard(&f))
        status = say_bad_input("standard output", &f);
    return status;
}

/* A picture becomes a header only. */
static int convert_picture(const struct convert_command *command, const char *path)
{
    struct failure f = { "" };
    struct sprite_report r;
    struct image image;
    char name[64], report[160];
    uint8_t *bytes = NULL;
    size_t size = 0;
    if (ends_with(command->output, ".smr") || ends_with(command->output, ".zip"))
        return say_bad_usage("-o", "writes pictures as .h or - (\"%s\")", command->output);
    if (!file_keep(path, &f) || !image_load(path, &image, &f))
        return say_bad_input(path, &f);
    int status = apart_check_inputs(&(struct apart_output){ .path = command->output }, 1);
    if (status != STATUS_OK) {
        image_free(&image);
        return status;
    }
    name_from(is_standard_output(command->output) ? path : command->output, name);
    const bool ok = sprite_to_header(&image, &command->sprite, command->name != NULL ? command->name : name, base_name(path),
                                     &bytes, &size, &r, &f);
    image_free(&image);
    if (ok && command->max_flash > 0 && r.bytes > (size_t)command->max_flash)
        fail(&f, "takes %zu bytes of flash, more than %ld (--max-flash)", r.bytes, command->max_flash);
    status = f.text[0] != '\0' ? say_bad_input(path, &f) : STATUS_OK;
    if (status == STATUS_OK) {
        snprintf(report, sizeof report, "%d of %dx%d pixels, %s: %zu bytes of flash", r.cells, r.width, r.height, r.format, r.bytes);
        status = write_header(command, bytes, size, report);
    }
    free(bytes);
    return status;
}

/* So do the lines of an OBJ file. */
static int convert_lines(const struct convert_command *command, const char *path)
{
    struct failure f = { "" };
    char name[64], report[160];
    uint8_t *text = NULL, *bytes = NULL;
    size_t text_size = 0, size = 0;
    int count = 0;
    if (!ends_with(path, ".obj") || ends_with(command->output, ".smr") || ends_with(command->output, ".zip"))
        return say_bad_usage("--lines", "writes lines of an .obj file as .h or - (\"%s\")", path);
    if (!file_keep(path, &f) || !file_read(path, LINES_BYTES_MOST, &text, &text_size, &f))
        return say_bad_input(path, &f);
    int status = apart_check_inputs(&(struct apart_output){ .path = command->output }, 1);
    name_from(is_standard_output(command->output) ? path : command->output, name);
    if (status == STATUS_OK
        && !segments_to_header(text, text_size, command->options.scale, command->name != NULL ? command->name : name, base_name(path),
                               &bytes, &size, &count, &f))
        status = say_bad_input(path, &f);
    free(text);
    if (status == STATUS_OK) {
        snprintf(report, sizeof report, "%d lines: %d bytes of flash", count, 48 * count);
        status = write_header(command, bytes, size, report);
    }
    free(bytes);
    return status;
}

int command_convert(int count, char **text)
{
    struct convert_command command = { .options = { .scale = 1, .texture_edge = 128, .colors = 256,
                                                    .influences = 4, .clip_error_px = 0.1, .rows = 240,
                                                    .fov_degrees = 45 },
                                       .sketch.quality = SKETCH_DRAFT };
    struct failure f = { "" };
    struct model model;
    const char *path;
    bool wants_help;
    int status = arguments_read(count, text, table, &command, &path, 1, &wants_help);
    if (status == STATUS_OK && wants_help)
        return help_print("convert");
    if (status != STATUS_OK)
        return status;
    if (command.options.mipmaps && command.options.bilinear)
        return say_bad_usage("--mipmaps", "is for nearest texels, not for --filter bilinear");
    if (path == NULL)
        return say_bad_usage("convert", "needs a model or picture (smear help convert)");
    if (command.output == NULL)
        return say_bad_usage("convert", "needs -o FILE.h or -o FILE.smr (smear help convert)");
    const bool is_sketch = ends_with(command.output, ".zip");
    if (!ends_with(command.output, ".h") && !ends_with(command.output, ".smr") && !is_sketch && !is_standard_output(command.output))
        return say_bad_usage("-o", "writes .h, .smr, .zip or - (\"%s\")", command.output);
    if (is_sketch != command.is_sketch || (is_sketch && command.kit == NULL))
        return say_bad_usage("--kit", is_sketch ? "is needed for a .zip: make kit writes it"
                                                : "as --display, --size and --quality: for -o FILE.zip");
    if (source_builtin_name(path) != NULL) {
        fail(&f, "built-in scenes are made by the program; only files of models are converted");
        return say_bad_input(path, &f);
    }
    if (is_picture(path))
        return convert_picture(&command, path);
    if (command.lines)
        return convert_lines(&command, path);
    if (command.is_sprite || command.sprite.font)
        return say_bad_usage("--cell", "as --key, --mask and --font: for pictures, .png or .ppm (\"%s\")", path);
    if (!model_load_from(path, command.files, &model, &f))
        return say_bad_input(path, &f);
    if (model.warning[0] != '\0')
        say_warning_when_done(path, model.warning);
    if (command.double_sided)
        model_show_both_sides(&model);
    status = apart_check_inputs(&(struct apart_output){ .path = command.output }, 1);
    if (status == STATUS_OK)
        status = convert_loaded(&command, path, &model);
    model_free(&model);
    return status;
}
