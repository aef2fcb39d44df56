/* Reads places of the scene that words are given by name. words.c calls it. */
#include <stdio.h>
#include <string.h>

#include "lua/language/vocabulary.h"

/* Warns of the place that a word is given if it is of a form with which the word does nothing of
   its own. */
static void warn_of_form(lua_State *L, const char *word, const char *name, int32_t index) {
    static const struct {
        const char *word;
        JoxPlaceForm form;
        const char *what, *hint;
    } WANTED[] = {
        {"queue", JOX_FORM_QUEUE, "a queue", "Example: places: {row: {queue: [[0, 0], [6, 0]]}}"},
        {"first_in", JOX_FORM_QUEUE, "a queue", "For who is there: inside, near or arrived"},
        {"joined", JOX_FORM_QUEUE, "a queue", "For who is there: inside, near or arrived"},
        {"queued", JOX_FORM_QUEUE, "a queue", "For the people in a place: count"},
        {"gather", JOX_FORM_AREA, "a polygon", NULL},
        {"spread_over", JOX_FORM_AREA, "a polygon", NULL},
        {"one_of", JOX_FORM_SET, "a set of places",
         "Example: places: {gates: {set: [east, west]}}"},
        {"best_place", JOX_FORM_SET, "a set of places",
         "Example: places: {gates: {set: [east, west]}}"}};
    JoxScript *script = jox_script_of(L);
    const JoxPlace *place = index < 0 ? NULL : &script->scope->places[index];
    for (size_t k = 0; place && k < sizeof WANTED / sizeof *WANTED; k++)
        if (strcmp(WANTED[k].word, word) == 0 && jox_place_form(place) != WANTED[k].form)
            jox_diag_warn(script->diagnostics, jox_word_position(L, name), "wrong-place",
                          WANTED[k].hint, "%s needs %s, and the scene's '%s' is a %s", word,
                          WANTED[k].what, name, jox_place_kinds[place->kind].name);
}

/* Reports a place that is no lift's, or a set with such a place, given to a word that takes a
   lift's; false with an error pushed. */
static bool check_lift_place(lua_State *L, const char *word, const char *name, int32_t index) {
    const JoxScope *scope = jox_script_of(L)->scope;
    const JoxPlace *place = index < 0 ? NULL : &scope->places[index];
    const bool set = place && jox_place_is_set(place);
    char hint[JOX_HINT] = "Add `lifts` to the scene";
    if (!place || (strcmp(word, "ride") != 0 && strcmp(word, "in_use") != 0))
        return true;
    if (scope->car_count)
        snprintf(hint, sizeof hint, "Places of lifts are LIFT.STOREY: \"%.80s\"",
                 scope->places[0].name);
    for (uint32_t m = 0; m < (set ? place->member_count : 1); m++) {
        const uint32_t at = set ? (uint32_t)place->members[m] : (uint32_t)index;
        if (at < scope->car_count)
            continue;
        if (set)
            jox_word_error(L, name, "bad-place", hint,
                           "%s: the set '%.60s' has the place '%.60s', which is no lift's", word,
                           name, scope->places[at].name);
        else
            jox_word_error(L, name, "bad-place", hint, "%s: the place '%.60s' is no lift's", word,
                           name);
        return false;
    }
    return true;
}

JoxNode *jox_read_place_name(lua_State *L, const char *word, const char *name) {
    JoxScript *script = jox_script_of(L);
    int32_t index = -1;
    if (script->scope->places)
        index = jox_place_find(script->scope->places, script->scope->place_count, name);
    if (index < 0 && script->scope->complete) {
        const char *names[256];
        size_t count = script->scope->place_count < 256 ? script->scope->place_count : 256;
        for (size_t i = 0; i < count; i++)
            names[i] = script->scope->places[i].name;
        char hint[JOX_HINT];
        const char *near = jox_did_you_mean(name, names, count, hint);
        if (strcmp(name, "goal") == 0 || strcmp(name, "home") == 0) {
            snprintf(hint, sizeof hint, "The word stands without quotes: %s(%s)", word, name);
            near = hint;
        }
        jox_word_error(L, name, "unknown-place", near, "the scene has no place '%s'", name);
        return NULL;
    }
    if (!check_lift_place(L, word, name, index))
        return NULL;
    warn_of_form(L, word, name, index);
    JoxNode *node = jox_node_push(L, JOX_NODE_TARGET);
    node->target_kind = JOX_TARGET_PLACE;
    node->target_arg = index;
    node->name = jox_vm_intern(&script->vm, name);
    return node;
}
