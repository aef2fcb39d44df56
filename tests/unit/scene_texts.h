/* Reads scenes from texts, with parts that tests share, and compares diagnostics. */
#ifndef JOSTLE_TESTS_SCENE_TEXTS_H
#define JOSTLE_TESTS_SCENE_TEXTS_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "scene/scene.h"

#define GROUP "groups: {g: {behaviour: stander, at: [[0, 0]]}}\n"
#define SQUARE "places: {box: {polygon: [[0, 0], [2, 0], [2, 2], [0, 2]]}}\n"
#define WITH(x) "groups: {g: {behaviour: stander, " x "}}\n"

#define GATE "walls: [{line: [[0, 3], [2, 3]], name: gate}]\n"
#define CRATE                                                                                      \
    "bodies:\n"                                                                                    \
    "  - {name: crate, shape: {box: {size: [1, 1, 1]}}, mass: 9, at: [5, 5, 1]}\n"                 \
    "  - {name: rock, shape: {box: {size: [1, 1, 1]}}, mass: 0, at: [8, 5, 1]}\n"

static inline JoxSceneSpec *read_scene_text(const char *text, const char *const *sets,
                                            uint32_t count, JoxDiagnostics *diagnostics) {
    JoxSceneOptions options = {.sets = sets, .set_count = count};
    return jox_scene_read_text("scenes/test.yaml", text, strlen(text), &options, diagnostics);
}

static inline void print_diagnostics(const JoxDiagnostics *d, const char *what) {
    JoxText text = {0};
    jox_diag_print(d, &text);
    print_message("%s\n%s", what, text.data ? text.data : "(none)\n");
    jox_text_free(&text);
}

/* Whether a diagnostic has this code and position, and its hint contains `hint` (NULL: any). */
static inline bool is_diagnostic(const JoxDiagnostic *d, const char *code, int line, int column,
                                 const char *hint) {
    return !strcmp(d->code, code) && d->line == line && d->column == column &&
           (!hint || (d->hint && strstr(d->hint, hint)));
}

/* A text with one error. An `@`, which is removed, marks its position. */
typedef struct JoxErrorCase {
    const char *text, *code, *hint;
} JoxErrorCase;

/* Reads texts; returns of how many the one error is not as it should be, and prints those. */
static inline int count_wrong_cases(const JoxErrorCase *cases, size_t count) {
    int wrong = 0;
    for (size_t c = 0; c < count; c++) {
        char text[1024];
        snprintf(text, sizeof text, "jostle: 1\n%s", cases[c].text);
        char *at = strchr(text, '@');
        int line = 1, column = 1;
        for (char *k = text; k < at; k++) {
            column = *k == '\n' ? 1 : column + ((*k & 0xc0) != 0x80); /* characters */
            line += *k == '\n';
        }
        memmove(at, at + 1, strlen(at));
        JoxDiagnostics d = {0};
        JoxSceneSpec *scene = read_scene_text(text, NULL, 0, &d);
        if (scene || d.errors != 1 ||
            !is_diagnostic(&d.items[0], cases[c].code, line, column, cases[c].hint) ||
            strcmp(d.items[0].file, "scenes/test.yaml") != 0) {
            print_message("wanted one %s at %d:%d\n", cases[c].code, line, column);
            print_diagnostics(&d, text);
            wrong++;
        }
        jox_scene_free(scene);
        jox_diag_free(&d);
    }
    return wrong;
}

#endif
