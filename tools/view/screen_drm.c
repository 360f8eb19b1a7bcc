#include "screen.h"
static struct screen *o(const struct screen_wish *w, struct failure *f){(void)w; fail(f,"not built yet"); return NULL;}
const struct screen_kind screen_drm = { "drm", o, NULL, NULL, NULL, NULL };
