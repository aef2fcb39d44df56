/* Asks why agents stay in their states, and checks the answer. Shared by tests of that. */
#ifndef JOX_TESTS_WHY_ANSWERS_H
#define JOX_TESTS_WHY_ANSWERS_H

#include "jostle_tools.h"
#include "unit/scene_loader.h"

static inline char *ask_why(JoScene *scene, JoWhyDef def) {
    JoError error = {0};
    def.cookie = jo_default_why_def().cookie;
    char *text = jo_scene_why(scene, &def, &error);
    if (!text)
        fail_msg("%s", error.text);
    return text;
}

static inline char *ask_agent(JoScene *scene, uint32_t id) {
    return ask_why(scene, (JoWhyDef){.has_agent = true, .agent = id});
}

/* Checks that a text has all parts, each behind the one before; `...` ends with NULL. */
static inline void check_order(const char *text, const char *const *parts) {
    const char *at = text;
    for (; *parts; parts++) {
        const char *found = strstr(at, *parts);
        if (!found)
            fail_msg("'%s' is missing, or not in its order, in:\n%s", *parts, text);
        at = found + strlen(*parts);
    }
}
#define CHECK_ORDER(text, ...) check_order(text, (const char *const[]){__VA_ARGS__, NULL})

/* Checks that a text has all parts, in any order. */
static inline void check_parts(const char *text, const char *const *parts) {
    for (; *parts; parts++)
        if (!strstr(text, *parts))
            fail_msg("'%s' is missing in:\n%s", *parts, text);
}
#define CHECK_PARTS(text, ...) check_parts(text, (const char *const[]){__VA_ARGS__, NULL})

#endif
