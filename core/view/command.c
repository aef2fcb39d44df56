#include "view/command.h"

#include <string.h>

#include "base/format/json.h"

/* State of the JSON reader: the command, and the bytes of its store that are used. */
typedef struct Reading {
    JoxCommand *command;
    size_t used;
} Reading;

/* Returns whether a text has no control characters. */
static bool is_printable(const char *text) {
    for (const unsigned char *s = (const unsigned char *)text; *s; s++)
        if (*s < 32 || *s == 127 || (s[0] == 0xC2 && s[1] < 0xA0))
            return false;
    return true;
}

/* Copies a text into the store; NULL if there is no room, or if it has control characters. */
static char *store_text(Reading *r, const char *text) {
    const size_t size = strlen(text) + 1;
    char *copy = r->command->store + r->used;
    if (size > sizeof r->command->store - r->used || !is_printable(text))
        return NULL;
    memcpy(copy, text, size);
    r->used += size;
    return copy;
}

static bool add_command_value(void *context, const JoxJsonItem *item) {
    static const JoxCommandKind KINDS[] = {[JOX_JSON_NULL] = JOX_COMMAND_NULL,
                                           [JOX_JSON_BOOL] = JOX_COMMAND_BOOL,
                                           [JOX_JSON_NUMBER] = JOX_COMMAND_NUMBER,
                                           [JOX_JSON_TEXT] = JOX_COMMAND_TEXT};
    Reading *r = context;
    JoxCommand *command = r->command;
    if (item->kind == JOX_JSON_OBJECT || item->kind == JOX_JSON_ARRAY ||
        command->count == JOX_COMMAND_MOST_KEYS)
        return false;
    const int i = command->count++;
    command->values[i].kind = KINDS[item->kind];
    command->values[i].number = item->number;
    command->values[i].key = store_text(r, item->key);
    command->values[i].text = item->text ? store_text(r, item->text) : NULL;
    return command->values[i].key && (!item->text || command->values[i].text);
}

/* Returns the index of a key; -1 if it is missing or of another kind. */
static int find_key(const JoxCommand *command, const char *key, JoxCommandKind kind) {
    for (int i = 0; i < command->count; i++)
        if (!strcmp(command->values[i].key, key))
            return command->values[i].kind == kind ? i : -1;
    return -1;
}

bool jox_command_read(const char *json, JoxCommand *command) {
    static const JoxJsonLimits FLAT = {
        .length = 8 * sizeof command->store, .items = JOX_COMMAND_MOST_KEYS + 1, .depth = 1};
    Reading reading = {.command = command};
    command->count = 0;
    command->verb = NULL;
    if (!jox_json_read(json, FLAT, add_command_value, &reading))
        return false;
    int verb = find_key(command, "do", JOX_COMMAND_TEXT);
    if (verb < 0)
        return false;
    command->verb = command->values[verb].text;
    return true;
}

const char *jox_command_text(const JoxCommand *command, const char *key, const char *otherwise) {
    int i = find_key(command, key, JOX_COMMAND_TEXT);
    return i < 0 ? otherwise : command->values[i].text;
}

double jox_command_number(const JoxCommand *command, const char *key, double otherwise) {
    int i = find_key(command, key, JOX_COMMAND_NUMBER);
    return i < 0 ? otherwise : command->values[i].number;
}

bool jox_command_bool(const JoxCommand *command, const char *key, bool otherwise) {
    int i = find_key(command, key, JOX_COMMAND_BOOL);
    return i < 0 ? otherwise : command->values[i].number > 0.0;
}
