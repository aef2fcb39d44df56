#include "picture/palette.h"

#include "base/vec.h"

/* Without black, which walls and writing have; yellow, the palest, comes last. */
static const JoxInk CLASSES[] = {
    {0x00, 0x72, 0xb2, 1.0f}, {0xe6, 0x9f, 0x00, 1.0f}, {0x00, 0x9e, 0x73, 1.0f},
    {0xd5, 0x5e, 0x00, 1.0f}, {0x56, 0xb4, 0xe9, 1.0f}, {0xcc, 0x79, 0xa7, 1.0f},
    {0xf0, 0xe4, 0x42, 1.0f},
};
enum { CLASS_COUNT = sizeof CLASSES / sizeof *CLASSES, ANCHORS = 9 };

/* From pale yellow for nothing to dark purple for the most: lightness falls throughout, so that the
   ramp can be read in grey and where it is printed. The live page has the same (palette.js). */
static const uint8_t RAMP[ANCHORS][3] = {
    {0xfb, 0xf6, 0xd3}, {0xfd, 0xe3, 0x9a}, {0xfc, 0xc5, 0x62},
    {0xf8, 0xa1, 0x40}, {0xee, 0x76, 0x2f}, {0xd8, 0x4a, 0x2c},
    {0xb3, 0x25, 0x36}, {0x82, 0x12, 0x3f}, {0x4d, 0x0b, 0x3b},
};

static uint8_t level(float share) {
    return (uint8_t)(jox_clampf(share, 0.0f, 1.0f) * 255.0f + 0.5f);
}

static JoxInk towards(JoxInk ink, float white, float share) {
    return (JoxInk){level((float)ink.r / 255.0f * (1.0f - share) + white * share),
                    level((float)ink.g / 255.0f * (1.0f - share) + white * share),
                    level((float)ink.b / 255.0f * (1.0f - share) + white * share), ink.a};
}

JoxInk jox_palette_class(uint32_t n) {
    JoxInk ink = CLASSES[n % CLASS_COUNT];
    switch (n / CLASS_COUNT % 3) {
    case 1:
        return towards(ink, 1.0f, 0.45f);
    case 2:
        return towards(ink, 0.0f, 0.45f);
    default:
        return ink;
    }
}

JoxInk jox_palette_value(float share) {
    const float at = jox_clampf(share, 0.0f, 1.0f) * (float)(ANCHORS - 1);
    const int low = (int)at < ANCHORS - 2 ? (int)at : ANCHORS - 2;
    const float part = at - (float)low;
    uint8_t mixed[3];
    for (int c = 0; c < 3; c++)
        mixed[c] =
            (uint8_t)((float)RAMP[low][c] * (1.0f - part) + (float)RAMP[low + 1][c] * part + 0.5f);
    return (JoxInk){mixed[0], mixed[1], mixed[2], 1.0f};
}
