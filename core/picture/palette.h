/* Colours of pictures. */
#ifndef JOX_PICTURE_PALETTE_H
#define JOX_PICTURE_PALETTE_H

#include <stdint.h>

/* sRGB; a: opacity, 0 draws nothing. */
typedef struct JoxInk {
    uint8_t r, g, b;
    float a;
} JoxInk;

/* The n-th of classes that are told apart, as states or groups: the colours of M. Okabe and K. Ito,
   "Color Universal Design" (2008), which people with any colour vision tell apart; behind the first
   seven come lighter and darker ones of them. */
JoxInk jox_palette_class(uint32_t n);
/* A value, 0 to 1: pale yellow to dark purple; lightness falls throughout, in grey too. */
JoxInk jox_palette_value(float share);

#endif
