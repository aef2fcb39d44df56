/* Actions of programs: entries of the input log, made by the public calls of embed/action_calls.c.
 */
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/guard.h"
#include "world/verbs/verb_table.h"
#include "world/world.h"

bool jox_input_check_name(const char *what, const char *name, JoxText *why) {
    const size_t n = strlen(name);
    bool good = n > 0 && n <= JOX_INPUT_NAME;
    for (size_t i = 0; i < n; i++)
        good = good && (unsigned char)name[i] >= 0x20 && name[i] != 0x7f;
    if (!good)
        jox_text_printf(why, "%s has from 1 to %d bytes, without control characters", what,
                        JOX_INPUT_NAME);
    return good;
}

/* Checks names and numbers of an entry as the reader of a log does. */
static bool check_words(const JoxInputEntry *entry, JoxText *why) {
    const JoxVerb *verb = &jox_input_verbs[entry->verb];
    uint32_t name = 0, number = 0;
    for (uint32_t w = 0; w < verb->most; w++) {
        const JoxInputWord *word = &verb->words[w];
        if (word->kind == JOX_WORD_NAME) {
            char what[80];
            snprintf(what, sizeof what, "the %s of '%s'", word->name, verb->name);
            if (!jox_input_check_name(what, entry->names[name++], why))
                return false;
        } else if (word->kind == JOX_WORD_NUMBER && number < entry->given) {
            const double value = entry->numbers[number++];
            if (!(value >= word->least && value <= word->most)) {
                jox_text_printf(why, "%s of '%s' must be from %.9g to %.9g%s%s, not %.9g",
                                word->name, verb->name, word->least, word->most,
                                *word->unit ? " " : "", word->unit, value);
                return false;
            }
        }
    }
    return true;
}

bool jox_input_perform(JoWorld *world, JoxInputEntry *entry, JoError *error) {
    JoxText why = {0};
    JOX_ASSERT(entry->verb < jox_input_verb_count && jox_input_verbs[entry->verb].perform);
    if (world->failure[0])
        jox_text_add(&why, world->failure);
    const bool good = !why.length && check_words(entry, &why) &&
                      jox_input_verbs[entry->verb].perform(world, entry, &why);
    if (good && world->record)
        world->record(world->record_context, entry);
    if (!good)
        jox_error(error, JO_INPUT, "%s", why.data ? why.data : "it could not be done");
    jox_text_free(&why);
    return good;
}
