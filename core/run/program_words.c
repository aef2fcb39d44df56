/* Words of the program in a scene: copies them, does their actions after a step, and writes their
   reference. build_scene.c and step_scene.c call it. */
#include "run/program_words.h"

#include <string.h>

#include "base/assert.h"
#include "base/format/quote.h"
#include "base/guard.h"
#include "base/mem.h"

/* ---- in a scene ---- */

void jox_run_set_words(JoScene *scene, const JoSceneDef *def, JoxDiagnostics *diagnostics) {
    JoxText why = {0};
    if (!jox_program_words_check(def->words, def->word_count, &why)) {
        jox_diag_error(diagnostics, ((JoxPosition){"JoSceneDef.words", 0, 0, 0}), "bad-word", NULL,
                       "%s", why.data);
        jox_text_free(&why);
        return;
    }
    const uint32_t count = (uint32_t)def->word_count;
    JoWord *words = jox_alloc(count + 1, sizeof *words);
    JoxProgramWord *run = jox_alloc(count + 1, sizeof *run);
    for (uint32_t w = 0; w < count; w++) {
        words[w] = def->words[w];
        words[w].name = jox_strdup(words[w].name);
        words[w].unit = jox_strdup(words[w].unit);
        words[w].meaning = jox_strdup(words[w].meaning);
        words[w].example = jox_strdup(words[w].example);
        run[w].name = words[w].name;
        run[w].values = words[w].values;
        run[w].context = words[w].context;
        run[w].world = scene->world;
    }
    scene->words = words;
    scene->word_count = count;
    scene->program_words = run;
    scene->world->machines.program_words = run;
    jox_lua_set_words(scene->lua, words, count);
}

void jox_run_free_words(JoScene *scene) {
    for (uint32_t w = 0; w < scene->word_count; w++) {
        jox_free((char *)scene->words[w].name);
        jox_free((char *)scene->words[w].unit);
        jox_free((char *)scene->words[w].meaning);
        jox_free((char *)scene->words[w].example);
    }
    jox_free((JoWord *)scene->words);
    jox_free(scene->program_words);
}

/* Reports values that were not finite: of each word the first ones, then once in a second. */
static void report_invalid_values(JoScene *scene) {
    const double now = jo_world_time(scene->world);
    for (uint32_t w = 0; w < scene->word_count; w++) {
        const uint32_t invalid = atomic_load(&scene->program_words[w].invalid);
        if (!invalid || now < scene->words_told_until)
            continue;
        atomic_store(&scene->program_words[w].invalid, 0);
        jox_run_say(scene,
                    "t = %.2f s: the program's word '%s' gave %u values that are not finite: 0 was "
                    "taken\n",
                    now, scene->words[w].name, invalid);
        scene->words_told_until = now + 1.0;
    }
}

void jox_run_do_program_acts(JoScene *scene) {
    if (!scene->word_count)
        return;
    uint32_t count;
    jox_lua_acts(scene->lua, &count);
    scene->acting = true;
    scene->world->busy = false;
    for (uint32_t n = 0; n < count; n++) {
        const JoxAct act = jox_lua_acts(scene->lua, &(uint32_t){0})[n];
        const JoWord *word = &scene->words[act.word];
        const JoAgent agent = jo_world_agent_of(scene->world, act.agent_id);
        const JoxOutside outside = jox_guard_leave();
        word->act(word->context, scene->world, agent, act.numbers, act.count);
        jox_guard_return(outside);
    }
    scene->world->busy = true;
    scene->acting = false;
    jox_lua_forget_acts(scene->lua);
    report_invalid_values(scene);
}

/* ---- the reference ---- */

/* Returns whether a behaviour with the words loads. */
static bool loads_with(const JoWord *words, size_t count, const JoxText *behaviour,
                       JoxDiagnostics *diagnostics) {
    JoxLua *lua = jox_lua_create(NULL);
    jox_lua_set_words(lua, words, (uint32_t)count);
    JoxMachine *machine =
        jox_lua_load_text(lua, "example", behaviour->data, behaviour->length, NULL, diagnostics);
    jox_machine_free(machine);
    jox_lua_free(lua);
    return machine != NULL;
}

/* Checks the example of a word, as a condition, a number or a call. */
static bool check_example(const JoWord *words, size_t count, size_t w, JoError *error) {
    static const char *const PARTS[] = {"{ to = \"B\", when = %s }", "push = %s",
                                        "on_enter = function(me) %s end"};
    const bool acts = words[w].kind == JO_WORD_ACTION;
    bool good = false;
    char why[200] = "";
    for (int part = acts ? 2 : 0; part < (acts ? 3 : 2) && !good; part++) {
        JoxText behaviour = {0};
        JoxDiagnostics diagnostics = {0};
        jox_text_add(&behaviour, "return machine { name = \"example\", version = 1, start = \"A\", "
                                 "states = { A = { ");
        const char *hole = strstr(PARTS[part], "%s");
        jox_text_append(&behaviour, PARTS[part], (size_t)(hole - PARTS[part]));
        jox_text_add(&behaviour, words[w].example);
        jox_text_add(&behaviour, hole + 2);
        jox_text_add(&behaviour, " }, B = { steer = hold } } }");
        good = loads_with(words, count, &behaviour, &diagnostics);
        for (uint32_t d = 0; d < diagnostics.count && !*why; d++)
            if (diagnostics.items[d].severity == JOX_SEVERITY_ERROR)
                snprintf(why, sizeof why, "%.190s", diagnostics.items[d].message);
        jox_diag_free(&diagnostics);
        jox_text_free(&behaviour);
    }
    if (!good)
        jox_error(error, JO_INPUT, "the example of word %zu of the program, '%s': %s", w + 1,
                  words[w].name, why);
    return good;
}

/* Checks words with their examples. */
static bool check_words_and_examples(const JoWord *words, size_t count, JoError *error) {
    JoxText why = {0};
    bool good = jox_program_words_check(words, count, &why);
    if (!good)
        jox_error(error, JO_INPUT, "%s", why.data);
    jox_text_free(&why);
    for (size_t w = 0; w < count && good; w++)
        good = check_example(words, count, w, error);
    return good;
}

char *jo_words_reference(const JoWord *words, size_t count, JoError *error) {
    static const char *const KINDS[] = {"number", "condition", "action"};
    JOX_REQUIRE((words || !count) && error, NULL);
    JOX_GUARD (NULL, error)
        return NULL;
    if (!check_words_and_examples(words, count, error))
        return NULL;
    JoxText out = {0};
    jox_text_add(&out, "# Words of the program\n\nBesides the words of the language, behaviours "
                       "in this program can use these.\n\n| word | kind | meaning | example |\n"
                       "|---|---|---|---|\n");
    for (size_t w = 0; w < count; w++) {
        jox_text_printf(&out, "| `%s` | %s%s%s | ", words[w].name, KINDS[words[w].kind],
                        *words[w].unit ? ", " : "", words[w].unit);
        jox_quote_markdown(&out, words[w].meaning);
        jox_text_printf(&out, " | `%s` |\n", words[w].example);
    }
    return jox_disown(out.data);
}

char *jo_words_definitions(const JoWord *words, size_t count, JoError *error) {
    JOX_REQUIRE((words || !count) && error, NULL);
    JOX_GUARD (NULL, error)
        return NULL;
    if (!check_words_and_examples(words, count, error))
        return NULL;
    JoxText out = {0};
    jox_text_add(&out, "---@meta\n-- Words of a program for lua-language-server, beside those of "
                       "jostle.lua.\n");
    for (size_t w = 0; w < count; w++) {
        jox_text_printf(&out, "\n--- %s%s%s; `%s`\n", words[w].meaning, *words[w].unit ? ", " : "",
                        words[w].unit, words[w].example);
        if (words[w].kind == JO_WORD_ACTION)
            jox_text_printf(&out, "---@param ... number|jostle.Me\nfunction %s(...) end\n",
                            words[w].name);
        else
            jox_text_printf(&out, "---@type jostle.%s\n%s = nil\n",
                            words[w].kind == JO_WORD_NUMBER ? "Number" : "Condition",
                            words[w].name);
    }
    return jox_disown(out.data);
}
