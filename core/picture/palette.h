/* Colours of pictures: for classes, values, calm values and directions. Used by draw*.c, plots
   and the live page's data. */
#ifndef JOX_PICTURE_PALETTE_H
#define JOX_PICTURE_PALETTE_H

#include "base/format/colour.h"

/* A colour in sRGB; a: opacity, 0 to 1, where 0 paints nothing. */
typedef struct JoxInk {
    uint8_t r, g, b;
    float a;
} JoxInk;

/* Returns the colour of class n (of states or groups): JOX_CLASS_COLOURS, then lighter and
   darker shades of them, then the same again. */
JoxInk jox_palette_class(uint32_t n);
/* Fills `out` with the colours of `count` classes. A class keeps its given colour (`given` NULL
   or 0: none); the others take, in order, class colours that no class was given. */
void jox_palette_classes(const JoxColour *given, uint32_t count, JoxInk *out);
JoxColour jox_palette_colour(JoxInk ink);
/* Returns the colour of a value, 0 to 1, from pale yellow to dark purple. Lightness falls all
   the way, so the scale can be read in grey. */
JoxInk jox_palette_value(float share);
/* Returns the colour of a harmless value such as speed, 0 to 1, from pale to dark blue. */
JoxInk jox_palette_calm(float share);
/* Returns the colour of a direction, in turns counter-clockwise from the east, on a circle of
   hues. */
JoxInk jox_palette_way(float turn);

#endif
