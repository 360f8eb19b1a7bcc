/* SPDX-License-Identifier: MIT */
/* A stand-in for the header of LovyanGFX that declares LGFX: LovyanGFX.hpp does here. */
