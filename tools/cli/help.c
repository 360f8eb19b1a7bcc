/* SPDX-License-Identifier: MIT */
/* help.c - `smear help`: what the program can do, on standard output. */
#include "tools/cli/commands.h"

#include "tools/options/arguments.h"
#include "tools/options/say.h"
#include "tools/scenes/methods.h"

#include <string.h>

static const char program_help[] =
    "smear - motion blur for machines without a GPU, drawn on this one\n"
    "\n"
    "    smear render SCENE [options]     frames of a model or built-in scene into files\n"
    "    smear show MODEL [-o OUT.gif]    a model at its best: clip, camera and background are chosen\n"
    "    smear view [SCENE]               in a window or terminal, with live controls\n"
    "    smear convert MODEL|PICTURE -o OUT.h|OUT.smr|OUT.zip\n"
    "                                     a model, sprite or font as constant data for firmware; a sketch\n"
    "    smear compare A B                how far two pictures are from each other\n"
    "    smear info SCENE                 what is in a scene, and the memory it needs\n"
    "    smear bench                      what frames cost, beside the bars set for them\n"
    "    smear chart                      error against cost of every method\n"
    "    smear help [COMMAND]             this, or the options of a command\n"
    "    smear -v, --version\n"
    "\n"
    "SCENE is a .glb, .gltf or .obj file, textures PNG or JPEG, or builtin:NAME (smear info builtin:\n"
    "lists them).\n"
    "Exit status: 0 done, 1 bad input, 2 bad usage; errors are one line on standard error.\n";

/* Stands for the list of methods. */
static const char method_lines[] = "";

/* Printed one after the other; C promises strings of 4095 characters at most. */
static const char *const render_help[] = {
    "smear render SCENE [options]\n"
    "\n"
    "Renders frames of SCENE: a .glb, .gltf or .obj file, textures PNG or JPEG, or builtin:NAME (smear\n"
    "info builtin: lists the names). Built-in scenes bring their own camera, and their own size, frame\n"
    "rate, time and clear colour as defaults.\n"
    "\n"
    "What and when\n"
    "  --size WxH            pixels, 1 to 2048 [320x240]\n"
    "  --fps F               frames per second [30]\n"
    "  --time SECONDS        one frame, number 0, at this time [0]\n"
    "  --frames A-B          frames A to B; frame i shows the time i / fps [0-0; of a .gif or .apng, all\n"
    "                        frames of the clip]\n"
    "  --clip NAME|INDEX|all|none\n"
    "                        what moves the model [0]; all: together, the later in the file wins\n"
    "  --loop                clips start again at the end of their longest channel [they stop]\n"
    "  --outside             files that SCENE names (textures, buffers, .mtl) may lie outside of its\n"
    "                        folder [only in it or below]\n"
    "  --double-sided        backs of faces are seen, too [where the file's material says so; OBJ: not]\n"
    "  --camera NAME|INDEX   of the file [the first; without any, one that sees everything]\n"
    "  --eye X,Y,Z --look X,Y,Z [--fov DEG]\n"
    "                        another camera, its vertical field of view [45]\n"
    "  --orbit TURNS         the camera goes so often round what it looks at, over all frames; a single\n"
    "                        frame is seen from there\n"
    "  --filter nearest|bilinear\n"
    "                        texels [nearest]\n"
    "  --clear RRGGBB[,RRGGBB]\n"
    "                        background; of two colours, from the top to the bottom [000000]\n"
    "  --sun RRGGBB,X,Y,Z, --second RRGGBB,X,Y,Z\n"
    "                        light from that direction, 3/10 of the sun's from everywhere; another one\n"
    "  --lamp RRGGBB,X,Y,Z,REACH\n"
    "                        a lamp at that place, in units of the scene\n"
    "                        without any of these: the file's lights [the library's sun]\n"
    "  --gloss               highlights of what the file says is not rough\n"
    "  --fog RRGGBB,NEAR,FAR fog between two distances from the camera, in units of the scene; the\n"
    "                        background has its colour, and nothing is drawn beyond it [none]\n"
    "  --sky ZENITH,HORIZON,GROUND,NADIR\n"
    "                        a sky of four colours, RRGGBB each, that turns with the camera [none]\n"
    "  --shadow blob|planar[,PERCENT]\n"
    "                        of a file: a round one under it, or what it casts in the sun, so dark [45];\n"
    "                        on level ground at the height of the lowest point of the clip: on what the\n"
    "                        file has there, or on the background, which should not be black [none]\n"
    "  --edges hard|smooth   auto, subframes: what lies on both sides of an edge is mixed where it\n"
    "                        passes a pixel; --exact: of 16 x 16 places in each pixel, or as many\n"
    "                        as make a picture of 2048; with --keep-display beside --keep-still [hard]\n"
    "\n",
    "Blur\n"
    "  --shutter DEG|SECONDS 360 is the whole frame time; rounded to whole degrees, up to 3600;\n"
    "                        0 is the sharp frame; seconds as 0.01s or 10ms [180]\n"
    "  --shutter-mode native|capped|fixed[:HZ]\n"
    "                        degrees of the frame time; capped: of 1/30 s at most; fixed: of 1/30 s\n"
    "                        or 1/HZ, whatever the frame rate is. capped holds seconds to a frame\n"
    "                        [native]\n"
    "  --exposure centred|trailing|leading\n"
    "                        where the frame's instant lies in it [centred]\n"
    "  --path curve|line|origin|screw\n"
    "                        what joins poses of frames ago: the turn about the point that three of\n"
    "                        them tell; straight lines; the turn about the own origin, which goes\n"
    "                        straight; the turn about the axis that leads from pose to pose [curve]\n"
    "  --poses previous|shutter\n"
    "                        what the library is told: the poses of one and two frames ago, or those\n"
    "                        at shutter open, centre and close. What jumps in between (STEP keys; two\n"
    "                        keys within half a millisecond; with --loop, an end that does not meet\n"
    "                        the start) is in all of them where it is at the frame's instant; what\n"
    "                        moves behind a jump goes on before it as it does there [previous]\n",
    method_lines,
    "  --samples N           taps, or instants of accumulate; 1 to 1024 [8]; instants of subframes\n"
    "                        at most, slots of timemask (8, 16 or 32) [32]\n"
    "  --exact               accumulate: every instant is posed and lit by the file itself; the\n"
    "                        truth, when there are many; up to 65536 of them\n"
    "  --reconstruct LIST    departures of reconstruct from the published filter, with commas:\n"
    "                        fence      still foreground keeps its edges\n"
    "                        corner     a diagonal tile counts if its motion points here\n"
    "                        box        box shutter instead of the tent\n"
    "                        direction  second direction along the pixel's own motion\n"
    "                        published  nothing of ours: weights also where all motion is alike,\n"
    "                                   the camera's motion from vertices, the background still\n"
    "  --weights stack|mcguire|guertin|jimenez\n"
    "                        whose weights reconstruct gives to its taps: Post Processing Stack v2,\n"
    "                        or the papers of 2012, 2014 and 2014 [stack]\n"
    "  --inside mean|reconstruct|pingpong\n"
    "                        what blurs in camera [mean] and half [reconstruct]\n"
    "  --camera-step 1|2|4   filters: what does not move itself gets its velocity from depth, at\n"
    "                        each pixel, 2 x 2 or 4 x 4; the background, too\n"
    "                        [camera, reconstruct: 4]\n"
    "  --pingpong LIST       passes=2 taps=8 base=TAPS jitter=0 bias=255 (taps nearer by more\n"
    "                        than so many 1/256 of the distance are left out; 255: none; 16\n"
    "                        with spread) spread (silhouettes do), with commas\n"
    "  --scatter             the reach may exceed the tile, up to 64 pixels\n"
    "  --budget N            auto: as coarse as it takes to draw no more than N pixels x instants of\n"
    "                        what moves (work of --stats), but not coarser than draft\n"
    "  --keep-still          auto, subframes, timemask: what does not move is kept from frame to\n"
    "                        frame, for memory of the whole frame; the same pictures\n"
    "  --keep-display        likewise, and none: the display keeps what it is sent, and only tiles\n"
    "                        that it does not show are drawn and sent (tiles kept of --stats); the\n"
    "                        same pictures\n"
    "  --scale LIST          turn=1,way=1,objects=1: of the camera's rotation, its translation and\n"
    "                        the motion of objects, 0 to 63\n",
    "  --quality sketch|draft|balanced|fine, --target CODES\n"
    "                        error that auto aims at: 8, 4, 1.5, 0.5 codes [balanced]; no effect\n"
    "                        on other methods\n"
    "  --reach PX|PERCENT%   longest blur radius of reconstruct, in pixels or of the height; not\n"
    "                        above the tile [5%, at most a tile]\n"
    "  --tile 4|8|16|32|64   [8 or the smallest not below the reach]\n"
    "  --motion NODE=full|camera|none\n"
    "                        what moves the node (name or index) and all below it: all there is,\n"
    "                        the camera alone, nothing; may be repeated\n"
    "  --mask NODE[,...]     object, layered: only these nodes (name or index) and all below them are\n"
    "                        blurred [what moves]\n"
    "  --cut FRAME           no motion in this frame; may be repeated\n"
    "  --light linear|encoded\n"
    "                        what is lit and averaged: linear light, or codes [linear]\n"
    "\n",
    "Device\n"
    "  --format NAME         rgb888, rgb565, rgb565be (high byte first), rgb555 (blue on top),\n"
    "                        rgb332, l8, l4, l1, l1pages (8 rows per byte) [rgb888]\n"
    "  --dither none|ordered|blue|diffuse\n"
    "                        [ordered; rgb888 and l8 never]; diffuse: of l4, l1, l1pages, what\n"
    "                        rounding leaves over goes to the next pixels\n"
    "  --double 2x1|1x2|2x2  the display is so many times as wide and high as what is drawn\n"
    "  --arena BYTES         memory there is for the context. Where the frame's triangles do not\n"
    "                        fit it is drawn in parts (counted as split); exit status 1 when\n"
    "                        nothing does\n"
    "  --threads N           1 to 8 cores [1]; the picture does not depend on it\n"
    "  --repeat N            draws every frame N times after one untimed time; times are medians,\n"
    "                        printed where there is no --stats\n"
    "\n"
    "Files\n"
    "  -o FILE               .png, .ppm, .pfm (code / 255), .gif or .apng. One %d or %04d in the\n"
    "                        name is the frame's number. [SCENE.png in the current folder, unless\n"
    "                        --stats or --repeat is given]\n"
    "  --depth FILE.pfm      distance along the view, 1 channel; background is infinite\n"
    "  --velocity FILE.pfm   x, y, 0: pixels per frame, right and down; from the pose a frame ago\n"
    "                        to now, or with --poses shutter from open to close, scaled\n"
    "                        Both belong to the sharp frame at its time, whatever the exposure.\n"
    "  --stats FILE.json|-   times, counts and the CRC-32 of the pixels as the display gets them; - is\n"
    "                        standard output\n"
    "Files get their names when all are complete, at the end: all of them, or none.\n",
    NULL
};

static const char *const show_help[] = {
    "smear show MODEL [-o OUT.gif|.apng|.png] [options]\n"
    "\n"
    "Shows a .glb, .gltf or .obj file at its best: the clip that moves most, all of it, looped (without\n"
    "one, the model turned once about itself), seen from where all of it fills the picture (by the\n"
    "file's own camera, where it has one), blurred, with smooth edges, before a soft background. Prints\n"
    "the options of `render` that draw the same, to go on from.\n"
    "\n"
    "  -o FILE               .gif or .apng; a still (.png, .ppm, .pfm) is of the middle of the clip, and\n"
    "                        one %d or %04d in its name makes one of each frame [a window or terminal,\n"
    "                        as `smear view MODEL` opens it]\n"
    "  --outside             files that MODEL names may lie outside of its folder [only in it or below]\n"
    "  --double-sided        backs of faces are seen, too [where the file's material says so; OBJ: not]\n"
    "  --shadow blob|planar[,PERCENT]\n"
    "                        a round one under it, or what it casts in the sun, so dark [45] [none]\n",
    NULL
};

static const char *const convert_help[] = {
    "smear convert MODEL -o OUT.h|OUT.smr|OUT.zip|- [options]\n"
    "\n"
    "Writes a .glb, .gltf or .obj file as constant data for firmware: int16 vertices in an order that\n"
    "suits the vertex cache, textures, materials, and clips for the optional animation module\n"
    "(smear_model.h). A header is C and fits every machine; a .smr blob is little-endian and is read\n"
    "where it lies. The same model and options give the same bytes everywhere. Prints the flash and\n"
    "RAM it takes and how many pixels vertices are off, played by the code of the device.\n"
    "\n"
    "  -o FILE.h|FILE.smr|-  - is a header on standard output; the report goes to standard error\n"
    "  --name NAME           prefix of the header's names [from the file's]\n"
    "  --clip NAME|INDEX|all|none\n"
    "                        clips to keep; may be repeated [all]\n"
    "  --keep NODE|all       a node that a program will move (name or index); may be repeated. Nodes\n"
    "                        that do not move go into the vertices\n"
    "  --scale F             world units per unit of the file [1]\n"
    "  --fit UNITS           instead: the largest extent at rest becomes so many units\n"
    "  --up y|z              the file's axis that points up; it becomes +Y [y]\n"
    "\n",
    "  --double-sided        backs of faces are kept, too [where the file's material says so; OBJ: not]\n"
    "  --outside             files that MODEL names (textures, buffers, .mtl) may lie outside of its\n"
    "                        folder [only in it or below]\n"
    "  --texture palette8|rgb565|rgb8888|baked|none\n"
    "                        baked: no texture, its mean colour goes to each vertex, or to each face\n"
    "                        of flat meshes. rgb565 has no alpha: pictures that need it stay\n"
    "                        palette8 [palette8]\n"
    "  --texture-size N      pictures are halved until no edge is longer [128]\n"
    "  --colors N            of a palette, 2 to 256 [256]\n"
    "  --mipmaps             behind pictures that repeat and whose sizes are powers of two: smaller\n"
    "                        ones, which triangles show whose texels would be smaller than pixels; a\n"
    "                        third more flash [none]\n"
    "  --filter nearest|bilinear\n"
    "                        [nearest]\n"
    "  --normals keep|flat   flat: normals are left out [keep]\n"
    "  --influences N        joints per vertex at most, 1 to 4 [4]\n"
    "  --clip-error PX       what the keys of a clip may be off by [0.1]\n"
    "  --rows N, --fov DEG, --distance UNITS\n"
    "                        what a pixel is [240 rows, 45 degrees, where the whole model is seen]\n"
    "  --max-triangles N, --max-flash BYTES, --max-ram BYTES\n"
    "                        exit status 1 when it takes more; nothing is simplified\n",
    "\n"
    "OUT.zip is a program that draws the model and compiles as it is, an Arduino sketch or, for esp_lcd,\n"
    "a project of ESP-IDF:\n"
    "\n"
    "  --kit FILE            what it is made of: make kit writes build/kit/kit.tar\n"
    "  --display lovyangfx|arduino_gfx|tft_espi|adafruit_gfx|u8g2|ili9341_t4|esp_lcd\n"
    "                        the library that knows the display [lovyangfx]\n"
    "  --size WxH            of the display [240x240; u8g2 128x64, ili9341_t4 240x320]\n"
    "  --quality sharp|draft|balanced|fine\n"
    "                        [draft]\n"
    "  --max-ram BYTES       as many triangles at once as fit into it, a quarter of all at least\n",
    "\n"
    "A .png or .ppm file becomes an image or font of smear_overlay.h, in the smallest format that keeps\n"
    "its colours: at most 256, with their alpha.\n"
    "\n"
    "  --cell WxH            the picture is cut into cells of so many pixels, row by row [it is one]\n"
    "  --key RRGGBB          pixels of this colour are holes\n"
    "  --mask                1 or 4 bits per pixel of a colour that firmware names: the alpha, or the\n"
    "                        brightness where all is opaque\n"
    "  --font CODE           a mask whose cells are letters, the first of this code (32: a space)\n"
    "\n"
    "  --lines               of an .obj file the lines (l) alone, as segments of smear_ribbon.h\n",
    NULL
};

static const char *const compare_help[] = {
    "smear compare A B [options]\n"
    "\n"
    "Prints how far two pictures of one size (.png, .ppm, .pfm) are from each other:\n"
    "  rmse   root mean square error over red, green and blue, in codes\n"
    "  psnr   dB of 255; inf when equal\n"
    "  ssim   mean structural similarity of luma, 1 when equal\n"
    "  flip   mean FLIP at 67 pixels per degree, 0 when equal\n"
    "\n"
    "  --diff FILE           writes |A - B| x gain: .png, .ppm or .pfm\n"
    "  --gain N              1 to 255 [8]\n",
    NULL
};

static const char *const info_help[] = {
    "smear info SCENE [--board NAME] [--outside]\n"
    "smear info --desc FIELD=VALUE,...\n"
    "\n"
    "Prints what is in a .glb, .gltf or .obj file or in builtin:NAME: nodes, clips, cameras,\n"
    "materials, textures, meshes, bounds, and the memory a device needs for its frame at the\n"
    "start (t = 0; of built-in scenes, at the time that stands for them), by method: with the\n"
    "smallest list of triangles that draws it in one part.\n"
    "\n"
    "smear info builtin: lists the built-in scenes.\n"
    "--board: what it takes of the memory there is on that board, too (smear help view lists boards).\n"
    "--outside: files that SCENE names may lie outside of its folder.\n"
    "--desc: the array that a smear_desc of these fields takes; what is left out is 0, the default. Names\n"
    "of methods (joined by +), formats and dither are those of render, accumulate_bands is one more:\n"
    "    smear info --desc width=240,height=240,methods=auto+none,format=rgb565be,bands=2\n",
    NULL
};

static const char *const bench_help[] = {
    "smear bench [REPORT...]\n"
    "\n"
    "Instructions per frame of scenes by which other rasterizers were measured (counted by valgrind),\n"
    "beside the bars set for them: the report `peers`, which needs no name. `make bench` adds what\n"
    "frames cost on Cortex-M.\n"
    "\n"
    "  --strict              exit status 1 when a bar is missed\n",
    NULL
};

static const char *const chart_help[] = {
    "smear chart [options]\n"
    "\n"
    "Every method at several settings on the 20 scenes of the suite, 4 frames of the demo and 3\n"
    "models, as it comes (linear light, poses of frames ago, dithered RGB565) and as in studies\n"
    "(encoded light, exact poses): error (RMSE, FLIP, SSIM, flicker against 1024 exact instants),\n"
    "instructions (counted by valgrind) and time, beside a peer's. Writes chart.csv and pictures\n"
    "(marks.svg, chart.svg) into build/chart and prints means and bars. What is measured is kept\n"
    "until the program changes.\n"
    "Models lie in the folder that SMEAR_ASSETS names; without it they are left out.\n"
    "\n"
    "  --scenes A,B          only these scenes; files go to build/chart/part\n"
    "  --methods A,B         only settings whose names begin so, and none; likewise\n"
    "  --quick               as it comes, without times; likewise\n"
    "  --marks               what marks.svg shows, quick; likewise\n"
    "  --from FILE           measures nothing and reports what a chart.csv says\n"
    "  --out FOLDER          where files go\n"
    "  --jobs N              processes at a time, 1 to 8 [2]\n"
    "  --strict              exit status 1 when a bar is missed or not measured\n",
    NULL
};

static const char *const help_help[] = {
    "smear help [render|show|view|convert|compare|info|bench|chart]\n",
    NULL
};

/* A line for each method, and more where its text has more. */
static void print_methods(void)
{
    for (int i = 0; i < method_count; i++) {
        printf("%-24s%-13s", i == 0 ? "  --method NAME" : "", method_list[i].name);
        for (const char *c = method_list[i].help; *c != '\0'; c++)
            if (*c == '\n')
                printf("\n%-37s", "");
            else
                putchar(*c);
        putchar('\n');
    }
}

int help_print(const char *command)
{
    static const char *const names[] = { "render", "show", "convert", "compare", "info", "bench", "chart",
                                         "help", NULL };
    static const char *const *const texts[] = { render_help, show_help, convert_help, compare_help, info_help,
                                                bench_help, chart_help, help_help };
    int found = command != NULL ? read_name(command, names) : -1;
    if (command == NULL) {
        fputs(program_help, stdout);
        return STATUS_OK;
    }
    if (strcmp(command, "view") == 0)
        return view_help_print();
    if (found < 0)
        return say_unknown_command(command);
    for (const char *const *text = texts[found]; *text != NULL; text++)
        if (*text == method_lines)
            print_methods();
        else
            fputs(*text, stdout);
    return STATUS_OK;
}

int command_help(int count, char **text)
{
    if (count > 1)
        return say_bad_usage(text[1], "one argument too many");
    return help_print(count == 1 && strcmp(text[0], "--help") != 0 ? text[0] : NULL);
}
