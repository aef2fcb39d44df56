#include "picture/palette.h"

#include "base/vec.h"

/* Without black, which walls and writing have; yellow, the palest, comes last. */
static const JoxInk CLASSES[] = {
    {0x00, 0x72, 0xb2, 1.0f}, {0xe6, 0x9f, 0x00, 1.0f}, {0x00, 0x9e, 0x73, 1.0f},
    {0xd5, 0x5e, 0x00, 1.0f}, {0x56, 0xb4, 0xe9, 1.0f}, {0xcc, 0x79, 0xa7, 1.0f},
    {0xf0, 0xe4, 0x42, 1.0f},
};
enum { CLASS_COUNT = sizeof CLASSES / sizeof *CLASSES, ANCHORS = 17 };

/* Every sixteenth of the 256 colours of viridis (N. Smith and S. van der Walt, matplotlib 1.5,
   2015, CC0), and the last one; straight lines between them are within 1/128 of the others. */
static const float VIRIDIS[ANCHORS][3] = {
    {0.267004f, 0.004874f, 0.329415f}, {0.282327f, 0.094955f, 0.417331f},
    {0.278826f, 0.175490f, 0.483397f}, {0.258965f, 0.251537f, 0.524736f},
    {0.229739f, 0.322361f, 0.545706f}, {0.199430f, 0.387607f, 0.554642f},
    {0.172719f, 0.448791f, 0.557885f}, {0.149039f, 0.508051f, 0.557250f},
    {0.127568f, 0.566949f, 0.550556f}, {0.120638f, 0.625828f, 0.533488f},
    {0.157851f, 0.683765f, 0.501686f}, {0.246070f, 0.738910f, 0.452024f},
    {0.369214f, 0.788888f, 0.382914f}, {0.515992f, 0.831158f, 0.294279f},
    {0.678489f, 0.863742f, 0.189503f}, {0.845561f, 0.887322f, 0.099702f},
    {0.993248f, 0.906157f, 0.143936f},
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
    float at = jox_clampf(share, 0.0f, 1.0f) * 255.0f;
    int low = (int)(at / 16.0f);
    low = low < ANCHORS - 2 ? low : ANCHORS - 2;
    float wide = low == ANCHORS - 2 ? 15.0f : 16.0f; /* the last stretch ends at 255 */
    float part = (at - 16.0f * (float)low) / wide;
    const float *a = VIRIDIS[low], *b = VIRIDIS[low + 1];
    return (JoxInk){level(a[0] + (b[0] - a[0]) * part), level(a[1] + (b[1] - a[1]) * part),
                    level(a[2] + (b[2] - a[2]) * part), 1.0f};
}
