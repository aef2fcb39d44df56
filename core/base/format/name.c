#include "base/format/name.h"

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "base/text.h"

enum { LONGEST = 100 };

/* Ranges of code points beyond ASCII that are not letters, marks or digits: controls, punctuation,
   symbols, direction marks, private use and emoji, by the blocks of Unicode 15. */
static const uint32_t EXCLUDED[][2] = {
    {0x80, 0xa9},       {0xab, 0xb4},     {0xb6, 0xb9},     {0xbb, 0xbf},       {0xd7, 0xd7},
    {0xf7, 0xf7},       {0x37e, 0x37e},   {0x387, 0x387},   {0x55a, 0x55f},     {0x589, 0x58f},
    {0x5be, 0x5be},     {0x5c0, 0x5c0},   {0x5c3, 0x5c3},   {0x5f3, 0x5f4},     {0x600, 0x60f},
    {0x61b, 0x61f},     {0x66a, 0x66d},   {0x6d4, 0x6d4},   {0x6dd, 0x6de},     {0x700, 0x70f},
    {0x964, 0x965},     {0x1680, 0x1680}, {0x180b, 0x180e}, {0x2000, 0x2070},   {0x207a, 0x207e},
    {0x208a, 0x208e},   {0x20a0, 0x20cf}, {0x2100, 0x2101}, {0x2190, 0x2bff},   {0x2e00, 0x2fff},
    {0x3000, 0x3004},   {0x3008, 0x3020}, {0x3030, 0x3030}, {0x303d, 0x303f},   {0xd800, 0xf8ff},
    {0xfd3e, 0xfd3f},   {0xfdd0, 0xfdef}, {0xfe00, 0xfe6f}, {0xfeff, 0xff0f},   {0xff1a, 0xff20},
    {0xff3b, 0xff40},   {0xff5b, 0xff65}, {0xffe0, 0xffff}, {0x1d000, 0x1d35f}, {0x1f000, 0x1faff},
    {0xe0000, 0x10ffff}};

static bool is_name_character(uint32_t code) {
    if (code < 0x80)
        return (code >= 'a' && code <= 'z') || (code >= 'A' && code <= 'Z') ||
               (code >= '0' && code <= '9') || code == '_';
    for (size_t k = 0; k < sizeof EXCLUDED / sizeof *EXCLUDED; k++)
        if (code >= EXCLUDED[k][0] && code <= EXCLUDED[k][1])
            return false;
    return true;
}

/* Returns the code point of a valid UTF-8 sequence. */
static uint32_t decode_utf8(const unsigned char *s, size_t length) {
    uint32_t code = length == 1 ? s[0] : s[0] & (0x7fU >> length);
    for (size_t k = 1; k < length; k++)
        code = code << 6 | (s[k] & 0x3fU);
    return code;
}

bool jox_name_is_plain(const char *name) {
    size_t n = strlen(name);
    if (n == 0 || n > LONGEST || strchr(" -.", name[0]) || name[n - 1] == ' ')
        return false;
    for (const char *c = name; *c;) {
        size_t length = jox_utf8_length(c);
        if (length == 0 || (!strchr(" -.", *c) &&
                            !is_name_character(decode_utf8((const unsigned char *)c, length))))
            return false;
        c += length;
    }
    return true;
}

bool jox_name_is_within(const char *name, const char *outer) {
    const size_t n = strlen(outer);
    return strncmp(name, outer, n) == 0 && (!name[n] || name[n] == '.');
}
