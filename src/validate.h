/* SPDX-License-Identifier: MIT */
/* validate.h - whether what the application asks for is valid, and its defaults. */
#ifndef SMEAR_VALIDATE_H
#define SMEAR_VALIDATE_H

#include "base/base.h"
#include "faults.h"

/* Fill in defaults. They return SMEAR_OK, or the number of the field that is out of range or was not compiled in. */
int smear_resolve_desc(smear_desc *d);
int smear_resolve_frame(smear_frame *f, const smear_desc *d);

/* Return SMEAR_OK or the number of what is wrong. */
int smear_check_cameras(const smear_frame *f);
int smear_check_fog(const smear_frame *f);
int smear_check_layers(const smear_frame *f);
int smear_check_overlay(const smear_overlay *overlay);
int smear_check_draw(const smear_draw *draw);

#endif
