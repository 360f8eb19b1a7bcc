/* SPDX-License-Identifier: MIT */
/* gallery.c - see gallery.h. */
#include "tools/demo/gallery.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

enum { MAX_PATH = 4096 };

static bool make_folder(const char *path, struct failure *f)
{
    struct stat info;
    if (mkdir(path, 0777) == 0)
        return true;
    int error = errno;
    if (stat(path, &info) == 0)
        return S_ISDIR(info.st_mode) || fail(f, "is no folder");
    return fail(f, "cannot be made (%s)", strerror(error));
}

bool gallery_open(struct gallery *gallery, const char *folder, struct failure *f)
{
    char path[MAX_PATH];
    size_t length = strlen(folder);
    *gallery = (struct gallery){ .folder = folder };
    if (length == 0 || length >= sizeof path)
        return fail(f, "is no name for a folder");
    for (size_t i = 1; i <= length; i++) {
        if (folder[i] != '/' && folder[i] != '\0')
            continue;
        memcpy(path, folder, i);
        path[i] = '\0';
        if (!make_folder(path, f))
            return false;
    }
    return true;
}

static bool path_of(const struct gallery *gallery, const char *name, char path[MAX_PATH],
                    struct failure *f)
{
    int length = snprintf(path, MAX_PATH, "%s/%s", gallery->folder, name);
    return (length > 0 && length < MAX_PATH) || fail(f, "the path is too long");
}

static void tell(const char *path, const char *what)
{
    printf("%-34s %s\n", path, what);
    fflush(stdout);
}

bool gallery_hang(const struct gallery *gallery, const char *name, const char *what,
                  const struct image *picture, struct failure *f)
{
    char path[MAX_PATH];
    if (!path_of(gallery, name, path, f) || !png_save(path, picture, f))
        return false;
    tell(path, what);
    return true;
}

static bool is_gif(const char *name)
{
    size_t length = strlen(name);
    return length > 4 && strcmp(name + length - 4, ".gif") == 0;
}

/* GIF counts in hundredths of a second: frames begin at the nearest, so that the whole keeps its
 * length. Milliseconds. */
static int delay_of(double fps, int frame, double unit)
{
    double begin = floor(frame * 1000.0 / fps / unit + 0.5);
    double end = floor((frame + 1) * 1000.0 / fps / unit + 0.5);
    return (int)((end - begin) * unit);
}

static bool add_frame(struct animation_writer **writer, const char *path, const struct image *frame,
                      int delay, struct failure *f)
{
    if (*writer == NULL)
        *writer = is_gif(path) ? gif_begin(path, frame->width, frame->height, f)
                               : apng_begin(path, frame->width, frame->height, f);
    return *writer != NULL && animation_add(*writer, frame, delay, f);
}

bool gallery_show(const struct gallery *gallery, const char *name, const char *what, double fps,
                  int count, gallery_frame_fn *frame, void *user, struct failure *f)
{
    char path[MAX_PATH];
    double unit = is_gif(name) ? 10 : 1;
    struct animation_writer *writer = NULL;
    if (!path_of(gallery, name, path, f))
        return false;
    for (int i = 0; i < count; i++) {
        struct image picture;
        bool ok = frame(user, i, &picture, f) &&
                  add_frame(&writer, path, &picture, delay_of(fps, i, unit), f);
        image_free(&picture);
        if (!ok) {
            animation_cancel(writer);
            return false;
        }
    }
    if (writer == NULL)
        return fail(f, "has no frames");
    if (!animation_end(writer, f))
        return false;
    tell(path, what);
    return true;
}
