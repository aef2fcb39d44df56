#include "base/format/plurals.h"

#include <stdio.h>
#include <string.h>

const char *jox_number_text(char out[JOX_NOUN], uint64_t number) {
    char digits[24];
    const int count = snprintf(digits, sizeof digits, "%llu", (unsigned long long)number);
    char *at = out;
    for (int i = 0; i < count; i++) {
        if (i > 0 && (count - i) % 3 == 0)
            *at++ = ',';
        *at++ = digits[i];
    }
    *at = 0;
    return out;
}

const char *jox_noun_alone(char out[JOX_NOUN], uint64_t number, const char *noun) {
    const char *bar = strchr(noun, '|');
    const size_t length = strlen(noun);
    const bool y = length > 1 && noun[length - 1] == 'y' && !strchr("aeiou", noun[length - 2]);
    if (number == 1)
        snprintf(out, JOX_NOUN, "%.*s", bar ? (int)(bar - noun) : (int)strlen(noun), noun);
    else if (!bar && y) /* bodies */
        snprintf(out, JOX_NOUN, "%.*sies", (int)length - 1, noun);
    else
        snprintf(out, JOX_NOUN, "%s%s", bar ? bar + 1 : noun, bar ? "" : "s");
    return out;
}

const char *jox_noun(char out[JOX_NOUN], uint64_t number, const char *noun) {
    char word[JOX_NOUN];
    const size_t used = strlen(jox_number_text(out, number));
    snprintf(out + used, JOX_NOUN - used, " %s", jox_noun_alone(word, number, noun));
    return out;
}

void jox_text_noun(JoxText *text, uint64_t number, const char *noun) {
    char out[JOX_NOUN];
    jox_text_add(text, jox_noun(out, number, noun));
}

const char *jox_article(const char *noun) {
    return *noun && strchr("aeiouAEIOU", *noun) ? "an" : "a";
}
