/* SPDX-License-Identifier: MIT */
/* validate.h - whether what the application asks for is valid, and its defaults. */
#ifndef SMEAR_VALIDATE_H
#define SMEAR_VALIDATE_H

#include "base/base.h"
#include "smear.h"

/* Fill in defaults; false when something is out of range, or was not compiled in. */
bool smear_resolve_desc(smear_desc *d);
bool smear_resolve_frame(smear_frame *f, const smear_desc *desc);

bool smear_is_camera(const smear_camera *c);
bool smear_are_layers(const smear_frame *f);
bool smear_is_draw(const smear_draw *draw);

#endif
