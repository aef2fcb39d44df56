/* The vocabulary of behaviours as JSON, for editors: from the tables of which `jostle reference`
   makes its pages. */
#include "agents/parameters.h"
#include "base/format/json_writer.h"
#include "base/guard.h"
#include "lua/language/vocabulary.h"
#include "wasm/module.h"

static const char *name_kind(JoxNodeKind kind) {
    switch (kind) {
    case JOX_NODE_CONDITION:
        return "condition";
    case JOX_NODE_NUMBER:
        return "number";
    case JOX_NODE_TARGET:
        return "target";
    case JOX_NODE_STEER:
        return "steering";
    case JOX_NODE_DIST:
        return "distribution";
    default:
        return "word";
    }
}

/* Begins a row: what it is of, its name and what it means. */
static void begin_row(JoxJson *json, const char *name, const char *kind, const char *signature,
                      const char *unit, const char *meaning, const char *example) {
    jox_json_object(json, NULL);
    jox_json_string(json, "word", name);
    jox_json_string(json, "kind", kind);
    jox_json_string(json, "signature", signature);
    jox_json_string(json, "unit", unit ? unit : "");
    jox_json_string(json, "meaning", meaning);
    jox_json_string(json, "example", example ? example : "");
}

static void add_range(JoxJson *json, double least, double greatest) {
    jox_json_number(json, "least", least);
    jox_json_number(json, "greatest", greatest);
}

static void write_vocabulary(JoxText *text) {
    JoxJson json = jox_json_begin(text, 1);
    jox_json_array(&json, NULL);
    for (size_t w = 0; w < jox_word_count; w++) {
        const JoxWord *word = &jox_words[w];
        begin_row(&json, word->name, name_kind(word->makes), word->signature, word->unit,
                  word->meaning, word->example);
        jox_json_end(&json);
    }
    for (size_t k = 0; k < jox_table_key_count; k++) {
        const JoxTableKey *key = &jox_table_keys[k];
        begin_row(&json, key->name, "key", key->type, key->unit, key->meaning, key->example);
        jox_json_string(&json, "of", key->owner);
        if (key->greatest > key->least)
            add_range(&json, key->least, key->greatest);
        jox_json_end(&json);
    }
    for (int p = 0; p < JOX_PARAM_COUNT; p++) {
        const JoxParameterInfo *info = &jox_parameters[p];
        begin_row(&json, info->name, "parameter", "number", info->unit, info->meaning, NULL);
        add_range(&json, info->least, info->greatest);
        jox_json_number(&json, "default", info->value);
        jox_json_end(&json);
    }
    for (size_t k = 0; k < jox_me_key_count; k++) {
        const JoxMeKey *key = &jox_me_keys[k];
        begin_row(&json, key->name, "field", key->type, key->unit, key->meaning, NULL);
        jox_json_string(&json, "of", "me");
        jox_json_end(&json);
    }
    jox_json_end(&json);
}

/* Answers an array with a row for each word, key, parameter and field of `me`. */
JOX_MODULE_CALL bool jostle_vocabulary(void) {
    JOX_GUARD (NULL, NULL)
        return false;
    JoxText text = {0};
    write_vocabulary(&text);
    jox_module_answer(&text);
    return true;
}
