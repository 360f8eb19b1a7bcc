/* SPDX-License-Identifier: MIT */
/* fuzz_wavefront.c - libFuzzer target: any bytes are the statements of an OBJ file, most of which refer to what is there. What
 * the loader takes keeps its promises (model.h), or is refused with a reason and a line. */
#include "tests/fuzz/require.h"
#include "tools/model/model.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static char text[1 << 16];
static size_t length;

__attribute__((format(printf, 1, 2))) static void say(const char *format, ...)
{
    va_list args;
    va_start(args, format);
    int n = vsnprintf(text + length, sizeof text - length, format, args);
    va_end(args);
    if (n > 0)
        length = length + (size_t)n < sizeof text ? length + (size_t)n : sizeof text - 1;
}

/* Counted from the end where `back` is odd; beyond it for the last of 32. */
static int reference(uint8_t choice, int count)
{
    int i = choice % 32 == 31 ? count + 1 : count > 0 ? choice / 2 % count + 1 : 0;
    return choice & 1 ? -i : i;
}

/* One statement of four bytes. */
static void statement(const uint8_t b[4], int count[3])
{
    static const char *const form[] = { "f %d %d %d", "f %d/%d %d/%d %d/%d", "f %d//%d %d//%d %d//%d",
                                        "f %d/%d/%d %d/%d/%d %d/%d/%d" };
    int v[3], vt[3], vn[3];
    for (int k = 0; k < 3; k++) {
        v[k] = reference(b[1 + k], count[0]);
        vt[k] = reference(b[1 + k], count[1]);
        vn[k] = reference(b[1 + k], count[2]);
    }
    switch (b[0] % 16) {
    case 0: case 1: case 2: case 3:
        say("v %d %d.%d %g", b[1], b[2], b[3], (double)(b[3] - 128) * pow(10, b[2] % 40));
        count[0]++;
        break;
    case 4: say("vt %d.%d %d", b[1] % 2, b[2], b[3] % 3), count[1]++; break;
    case 5: say("vn %d %d %d", b[1] - 128, b[2] - 128, b[3] - 128), count[2]++; break;
    case 6: case 7: say(form[0], v[0], v[1], v[2]); break;
    case 8: say(form[1], v[0], vt[0], v[1], vt[1], v[2], vt[2]); break;
    case 9: say(form[2], v[0], vn[0], v[1], vn[1], v[2], vn[2]); break;
    case 10: say(form[3], v[0], vt[0], vn[0], v[1], vt[1], vn[1], v[2], vt[2], vn[2]); break;
    case 11: say("o %c%c", 'a' + b[1] % 4, b[2] % 3 == 0 ? ' ' : 'b'); break;
    case 12: say("g %c", 'a' + b[1] % 4); break;
    case 13: say("usemtl %c", 'a' + b[1] % 4); break;
    case 14: say("v 1 2 3 0.%d 0.5 %d", b[1], b[2]), count[0]++; break;
    default: say("%.*s", b[1] % 4, (const char[]){ (char)(b[1] | 1), (char)(b[2] | 1), (char)(b[3] | 1) }); break;
    }
    say("%s\n", b[0] >= 240 ? " \\" : "");
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct failure f = { "" };
    struct model m;
    int count[3] = { 0 };
    length = 0;
    say("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\nf 1 2 3\n");
    count[0] = 3;
    count[1] = count[2] = 1;
    for (size_t i = 0; i + 4 <= size && length < sizeof text - 200; i += 4)
        statement(data + i, count);
    uint8_t *exact = malloc(length);
    require(exact != NULL);
    memcpy(exact, text, length);
    if (model_parse(exact, length, NULL, &m, &f)) {
        struct model_pose pose = { 0 };
        for (int i = 0; i < m.mesh_count; i++)
            for (int k = 0; k < m.mesh[i].primitive_count; k++) {
                const struct model_primitive *p = &m.mesh[i].primitive[k];
                require(p->vertex_count > 0 && p->triangle_count > 0 && p->material < m.material_count);
                for (int c = 0; c < 3 * p->triangle_count; c++)
                    require(p->index[c] < (uint32_t)p->vertex_count);
                for (int c = 0; c < 3 * p->vertex_count; c++)
                    require(isfinite(p->position[c]));
            }
        require(model_pose(&m, MODEL_CLIP_NONE, 0, false, &pose, &f) || f.text[0] != '\0');
        model_pose_free(&pose);
        model_free(&m);
    } else {
        require(f.text[0] != '\0');
    }
    free(exact);
    return 0;
}
