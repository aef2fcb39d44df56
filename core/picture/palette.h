/* Colours of pictures. */
#ifndef JOX_PICTURE_PALETTE_H
#define JOX_PICTURE_PALETTE_H

#include "base/format/colour.h"

/* sRGB; a: opacity, 0 draws nothing. */
typedef struct JoxInk {
    uint8_t r, g, b;
    float a;
} JoxInk;

/* The n-th of classes that are told apart, as states or groups: those of JOX_CLASS_COLOURS; behind
   the first seven come lighter and darker ones of them. */
JoxInk jox_palette_class(uint32_t n);
/* Colours of so many classes: those that were given (NULL: none), and for the others, in their
   order, those of the classes that nobody was given. */
void jox_palette_classes(const JoxColour *given, uint32_t count, JoxInk *out);
JoxColour jox_palette_colour(JoxInk ink);
/* A value, 0 to 1: pale yellow to dark purple; lightness falls throughout, in grey too. */
JoxInk jox_palette_value(float share);
/* The same of what is no danger, as speed: pale to dark blue. */
JoxInk jox_palette_calm(float share);
/* A way, in turns from the east, counter-clockwise: hues of a circle. */
JoxInk jox_palette_way(float turn);

#endif
