/* SPDX-License-Identifier: MIT */
/* fuzz_wavefront.c - libFuzzer target: any bytes are the statements of an OBJ file, most of which refer to what is there
 * (check_model.h). */
#include "tests/fuzz/check_model.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

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
    int count[3] = { 0 };
    text.size = 0;
    say("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\nf 1 2 3\n");
    count[0] = 3;
    count[1] = count[2] = 1;
    for (size_t i = 0; i + 4 <= size && text.size < 65000; i += 4)
        statement(data + i, count);
    check_file(text.data, text.size, (unsigned)text.size * 40503u);
    return 0;
}
