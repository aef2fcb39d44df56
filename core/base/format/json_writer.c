#include "base/format/json_writer.h"

#include <math.h>
#include <stdarg.h>

#include "base/assert.h"

JoxJson jox_json_begin(JoxText *out, int lines) {
    return (JoxJson){.out = out, .lines = lines};
}

/* Begins a line at the present depth. */
static void begin_json_line(JoxJson *json) {
    jox_text_append(json->out, "\n", 1);
    for (int d = 0; d < json->depth; d++)
        jox_text_append(json->out, " ", 1);
}

/* Writes what comes before a value: separator, line break and indentation, key. */
static void begin_value(JoxJson *json, const char *key, bool has_items) {
    if (json->depth == 0) {
        JOX_ASSERT(!key && !json->ended);
        json->ended = true;
        return;
    }
    struct JoxJsonLevel *level = &json->levels[json->depth - 1];
    const bool own_line = json->depth <= json->lines && (level->is_object || has_items);
    JOX_ASSERT(level->is_object == (key != NULL));
    if (level->any)
        jox_text_add(json->out, own_line ? "," : ", ");
    if (own_line)
        begin_json_line(json);
    if (level->is_object && key) {
        jox_text_json(json->out, key);
        jox_text_append(json->out, ": ", 2);
    }
    level->any = true;
    level->on_lines |= own_line;
}

/* Begins an object or an array. */
static void open_level(JoxJson *json, const char *key, bool is_object) {
    begin_value(json, key, true);
    JOX_ASSERT(json->depth < JOX_JSON_DEEPEST);
    jox_text_append(json->out, is_object ? "{" : "[", 1);
    json->levels[json->depth++] = (struct JoxJsonLevel){.is_object = is_object};
}

void jox_json_object(JoxJson *json, const char *key) {
    open_level(json, key, true);
}

void jox_json_array(JoxJson *json, const char *key) {
    open_level(json, key, false);
}

void jox_json_end(JoxJson *json) {
    JOX_ASSERT(json->depth > 0);
    json->depth--;
    if (json->levels[json->depth].on_lines)
        begin_json_line(json);
    jox_text_append(json->out, json->levels[json->depth].is_object ? "}" : "]", 1);
}

void jox_json_string(JoxJson *json, const char *key, const char *string) {
    if (!string) {
        jox_json_null(json, key);
        return;
    }
    begin_value(json, key, false);
    jox_text_json(json->out, string);
}

void jox_json_format(JoxJson *json, const char *key, const char *format, ...) {
    va_list arguments;
    JoxText text = {0};
    va_start(arguments, format);
    jox_text_vprintf(&text, format, arguments);
    va_end(arguments);
    jox_json_string(json, key, text.data ? text.data : "");
    jox_text_free(&text);
}

void jox_json_digits(JoxJson *json, const char *key, double number, int digits) {
    JOX_ASSERT(digits >= 1 && digits <= 17);
    begin_value(json, key, false);
    if (isfinite(number))
        jox_text_printf(json->out, "%.*g", digits, number);
    else
        jox_text_add(json->out, "null");
}

void jox_json_number(JoxJson *json, const char *key, double number) {
    jox_json_digits(json, key, number, 9);
}

void jox_json_whole(JoxJson *json, const char *key, uint64_t number) {
    begin_value(json, key, false);
    jox_text_printf(json->out, "%llu", (unsigned long long)number);
}

void jox_json_integer(JoxJson *json, const char *key, int64_t number) {
    begin_value(json, key, false);
    jox_text_printf(json->out, "%lld", (long long)number);
}

void jox_json_bool(JoxJson *json, const char *key, bool value) {
    begin_value(json, key, false);
    jox_text_add(json->out, value ? "true" : "false");
}

void jox_json_null(JoxJson *json, const char *key) {
    begin_value(json, key, false);
    jox_text_add(json->out, "null");
}

void jox_json_numbers_of(JoxJson *json, const char *key, const double *numbers, int count,
                         int digits) {
    jox_json_array(json, key);
    for (int i = 0; i < count; i++)
        jox_json_digits(json, NULL, numbers[i], digits);
    jox_json_end(json);
}
