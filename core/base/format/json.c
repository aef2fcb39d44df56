#include "base/format/json.h"

#include <cJSON.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/mem.h"
#include "base/text.h"

enum { LONGEST_PATH = 256 };

/* ---- checks before parsing: size, nesting, and characters that cJSON would accept ---- */

/* Returns the length of a quoted text with its quotes; 0 if it does not end, or has control
   characters, an escaped zero or invalid UTF-8. */
static size_t quoted_length(const char *s) {
    size_t n = 1;
    while (s[n] != '"') {
        size_t wide = jox_utf8_length(s + n);
        if ((unsigned char)s[n] < 32 || wide == 0 || !strncmp(s + n, "\\u0000", 6))
            return 0;
        n += s[n] == '\\' && s[n + 1] ? 2 : wide;
    }
    return n + 1;
}

static bool is_within_json_limits(const char *text, JoxJsonLimits limits) {
    size_t items = 0;
    int depth = 0;
    if (strnlen(text, limits.length + 1) > limits.length)
        return false;
    for (const char *s = text; *s;) {
        size_t n = *s == '"' ? quoted_length(s) : 1;
        if (n == 0)
            return false;
        items += *s == ',' || *s == '{' || *s == '[';
        depth += (*s == '{' || *s == '[') - (*s == '}' || *s == ']');
        if (depth > limits.depth || items > limits.items)
            return false;
        s += n;
    }
    return true;
}

/* ---- visiting ---- */

typedef struct Reader {
    JoxJsonVisit *visit;
    void *context;
    char path[LONGEST_PATH];
} Reader;

static JoxJsonItem convert_json_item(const cJSON *value, int depth, const char *path) {
    JoxJsonItem item = {.depth = depth, .key = value->string, .path = path};
    if (cJSON_IsString(value)) {
        item.kind = JOX_JSON_TEXT;
        item.text = value->valuestring;
    } else if (cJSON_IsNumber(value)) {
        item.kind = JOX_JSON_NUMBER;
        item.number = value->valuedouble;
    } else if (cJSON_IsBool(value)) {
        item.kind = JOX_JSON_BOOL;
        item.number = cJSON_IsTrue(value);
    } else if (cJSON_IsObject(value)) {
        item.kind = JOX_JSON_OBJECT;
    } else if (cJSON_IsArray(value)) {
        item.kind = JOX_JSON_ARRAY;
    }
    return item;
}

static bool visit_items(Reader *r, const cJSON *parent, int depth) {
    const size_t length = strlen(r->path);
    int index = 0;
    for (const cJSON *child = parent->child; child; child = child->next, index++) {
        const char *dot = length ? "." : "";
        if (child->string)
            snprintf(r->path + length, sizeof r->path - length, "%s%s", dot, child->string);
        else
            snprintf(r->path + length, sizeof r->path - length, "%s%d", dot, index);
        const JoxJsonItem item = convert_json_item(child, depth, r->path);
        if (!r->visit(r->context, &item) || !visit_items(r, child, depth + 1))
            return false;
        r->path[length] = 0;
    }
    return true;
}

/* Whether every number is finite: cJSON reads 1e999 as infinity. */
static bool has_finite_numbers(const cJSON *value) {
    if (cJSON_IsNumber(value) && !isfinite(value->valuedouble))
        return false;
    for (const cJSON *child = value->child; child; child = child->next)
        if (!has_finite_numbers(child))
            return false;
    return true;
}

bool jox_json_read(const char *text, JoxJsonLimits limits, JoxJsonVisit *visit, void *context) {
    Reader reader = {.visit = visit, .context = context};
    if (!is_within_json_limits(text, limits))
        return false;
    cJSON *document = cJSON_ParseWithOpts(text, NULL, true); /* from malloc: no heap owns it */
    JoxRecovery recovery;
    jox_recovery_push(&recovery);
    if (setjmp(recovery.jump) != 0) {
        cJSON_Delete(document);
        jox_out_of_memory(0);
    }
    const bool good = cJSON_IsObject(document) && has_finite_numbers(document) &&
                      visit_items(&reader, document, 1);
    jox_recovery_pop(&recovery);
    cJSON_Delete(document);
    return good;
}

const JoxJsonLimits jox_json_own_files = {.length = 1 << 26, .items = 1 << 20, .depth = 16};

typedef struct Numbers {
    JoxJsonNumber *number;
    void *context;
} Numbers;

static bool visit_number(void *context, const JoxJsonItem *item) {
    const Numbers *numbers = context;
    if (item->kind == JOX_JSON_NUMBER)
        numbers->number(numbers->context, item->path, item->number);
    return true;
}

bool jox_json_numbers(const char *text, JoxJsonNumber *number, void *context) {
    Numbers numbers = {number, context};
    return jox_json_read(text, jox_json_own_files, visit_number, &numbers);
}
