/* Colours as scenes and behaviours write them: names, or "#rrggbb". */
#ifndef JOX_BASE_FORMAT_COLOUR_H
#define JOX_BASE_FORMAT_COLOUR_H

#include <stdbool.h>
#include <stdint.h>

#include "base/text.h"

/* sRGB as 0xrrggbb | JOX_COLOUR_GIVEN; 0: none was given. */
typedef uint32_t JoxColour;
enum { JOX_COLOUR_GIVEN = 1 << 24 };

/* X(name, rrggbb): colours of groups and states, from M. Okabe and K. Ito, "Color Universal Design"
   (2008), which people with any colour vision can tell apart. Black is left out, since walls and
   text have it; wine, as dark, takes its place. Any two differ by 10 (CIEDE2000) to all eyes. */
#define JOX_CLASS_COLOURS(X)                                                                       \
    X(blue, 0x0072b2)                                                                              \
    X(orange, 0xe69f00)                                                                            \
    X(green, 0x009e73)                                                                             \
    X(vermilion, 0xd55e00)                                                                         \
    X(sky, 0x56b4e9)                                                                               \
    X(purple, 0xcc79a7)                                                                            \
    X(yellow, 0xf0e442)                                                                            \
    X(wine, 0x7d1f4a)
/* X(name, rrggbb): the colour of people who belong to no class, as without a machine. */
#define JOX_PLAIN_COLOURS(X) X(grey, 0x777777)

#define JOX_COLOUR_NAMES "blue, orange, green, vermilion, sky, purple, yellow, wine or grey"
#define JOX_COLOUR_RULE JOX_COLOUR_NAMES ", which all eyes tell apart, or \"#rrggbb\" in quotes"

/* Reads a name, or '#' and six hexadecimal digits; false if the text is neither. */
bool jox_colour_read(const char *text, JoxColour *colour);
/* Appends a hint for a text that is no colour: the nearest name, or the rule. */
void jox_colour_hint(const char *text, JoxText *out);
/* Writes "#rrggbb". */
void jox_colour_write(JoxColour colour, char out[8]);

#endif
