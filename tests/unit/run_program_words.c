/* Tests of words that a program adds to the language: numbers and conditions over columns, actions,
   refusals, the reference; equal runs on any number of threads. */
#include <math.h>

#include "jostle_words.h"
#include "unit/scene_loader.h"

#define ROOM                                                                                       \
    "jostle: 1\nstep: 0.05\nplaces: {goal: {point: [90, 0]}, room: {polygon: [[0, 0], [60, 0], "   \
    "[60, 60], [0, 60]]}}\n"                                                                       \
    "groups: {some: {behaviour: own.lua, in: room, count: 400}}\n"
#define OWN                                                                                        \
    "local mine = memory { rings = 0 }\n" MACHINE_START "\"Walk\", states = {\n"                   \
    "  Walk = { steer = drift(1, 0), speed = 1 + 0.01 * noise,\n"                                  \
    "    { to = \"Rest\", when = noise:above(50) & ~gate_is_free, on_take = ring } },\n"           \
    "  Rest = { steer = hold, on_enter = function(me) ring(me.x, 2) ring(me, 1) end } } }\n"

/* Data of the program: loudness to the east, and the rings that it heard. */
typedef struct Host {
    double loudest;
    uint32_t rings, wrong, last_id;
    double sum;
    bool moves; /* a ring moves the agent */
    bool invalid;
} Host;

static void measure_noise(void *context, const JoWorld *world, const uint32_t *agents,
                          uint32_t count, double *values) {
    const Host *host = context;
    const JoColumn x = jo_world_column(world, "x");
    for (uint32_t n = 0; n < count; n++)
        values[n] =
            host->invalid
                ? (double)NAN
                : host->loudest *
                      (double)*(const float *)((const char *)x.data + agents[n] * x.stride) / 60.0;
}

static void ask_gate(void *context, const JoWorld *world, const uint32_t *agents, uint32_t count,
                     double *values) {
    (void)context;
    const JoColumn y = jo_world_column(world, "y");
    for (uint32_t n = 0; n < count; n++)
        values[n] =
            *(const float *)((const char *)y.data + agents[n] * y.stride) > 30.0f ? 7.0 : 0.0;
}

static void hear_ring(void *context, JoWorld *world, JoAgent agent, const double *numbers,
                      uint32_t count) {
    Host *host = context;
    host->rings++;
    host->sum += count == 2 ? numbers[1] : count == 1 ? numbers[0] : 100.0;
    host->wrong += !jo_agent_is_live(world, agent);
    host->last_id = jo_agent_state(world, agent).id;
    JoError error;
    if (host->moves && !jo_agent_teleport(world, agent, 70, 10, &error))
        host->wrong++;
}

static Host host;
static JoWord words[] = {
    {"noise", "dB", "how loud it is where the agent stands", "noise:above(80)", JO_WORD_NUMBER,
     measure_noise, NULL, &host},
    {"gate_is_free", "", "whether the gate's reader is idle", "gate_is_free", JO_WORD_CONDITION,
     ask_gate, NULL, &host},
    {"ring", "", "rings a bell", "ring(2.5)", JO_WORD_ACTION, NULL, hear_ring, &host}};

static JoScene *load_with_words(const char *behaviour, uint32_t threads, JoError *error) {
    write_test_file("own.lua", behaviour);
    JoSceneDef def = define_scene(write_test_file("scene.yaml", ROOM));
    def.words = words;
    def.word_count = sizeof words / sizeof *words;
    def.threads = threads;
    *error = (JoError){0};
    return jo_scene_load(&def, error);
}

static void behaviours_use_words_of_the_program(void **state) {
    (void)state;
    uint64_t hashes[2];
    JoError error;
    for (int t = 0; t < 2; t++) {
        host = (Host){.loudest = 60};
        JoScene *scene = load_with_words(OWN, t ? 4 : 1, &error);
        if (!scene)
            fail_msg("%s", error.text);
        step_scene(scene, 40);
        uint32_t resting = 0, should = 0;
        const JoxAgents *a = &scene->world->state.agents;
        for (uint32_t i = 0; i < a->count; i++) {
            resting += a->state[i] == 0; /* Rest, by name */
            should += a->x[i] > 50.5f && a->y[i] <= 29.5f && a->state[i] == 1;
        }
        assert_true(resting > 10 && resting < 200);
        assert_int_equal(should, 0);
        assert_int_equal(host.rings, 3 * resting); /* on_take, and two of on_enter */
        assert_float_equal(host.sum, 103.0 * resting, 1e-9);
        assert_int_equal(host.wrong, 0);
        hashes[t] = jo_world_hash(jo_scene_world(scene));
        jo_scene_free(scene);
    }
    assert_true(hashes[0] == hashes[1]);
}

/* An action may change the world; a replay of the log acts again, and does not do it twice. */
static void actions_may_act_on_the_world(void **state) {
    (void)state;
    JoError error;
    host = (Host){.loudest = 60, .moves = true};
    JoScene *scene = load_with_words(OWN, 1, &error);
    const char *log = write_test_file("acts.log", "");
    assert_true(jo_scene_log_input(scene, log, &error));
    step_scene(scene, 40);
    assert_true(host.rings > 30 && host.wrong == 0);
    uint32_t moved = 0;
    for (uint32_t i = 0; i < scene->world->state.agents.count; i++)
        moved += scene->world->state.agents.x[i] > 65.0f;
    assert_true(moved > 10);
    const uint64_t hash = jo_world_hash(jo_scene_world(scene));
    assert_true(jo_scene_finish(scene, &error));
    jo_scene_free(scene);
    JoSceneDef def = define_scene(write_test_file("scene.yaml", ROOM));
    def.words = words;
    def.word_count = 3;
    def.input_log = log;
    scene = load_defined_scene(&def);
    step_scene(scene, 40);
    assert_true(hash == jo_world_hash(jo_scene_world(scene)));
    jo_scene_free(scene);
}

static void values_that_are_not_finite_count_as_zero(void **state) {
    (void)state;
    JoError error;
    host = (Host){.loudest = 60, .invalid = true};
    JoScene *scene = load_with_words(OWN, 2, &error);
    step_scene(scene, 3);
    assert_int_equal(host.rings, 0);
    assert_non_null(strstr(scene_messages.data, "the program's word 'noise' gave "));
    assert_non_null(strstr(scene_messages.data, "values that are not finite: 0 was taken"));
    jo_scene_free(scene);
}

static void assert_refused(const char *state_text, const char *because) {
    char behaviour[1000];
    JoError error;
    snprintf(behaviour, sizeof behaviour,
             MACHINE_START "\"A\", states = { A = { %s }, B = { steer = hold } } }\n", state_text);
    JoScene *scene = load_with_words(behaviour, 1, &error);
    if (scene)
        fail_msg("%s is accepted", state_text);
    if (!strstr(scene_messages.data, because))
        fail_msg("%s: not '%s', but %s", state_text, because, scene_messages.data);
}

static void misused_words_are_refused(void **state) {
    (void)state;
    assert_refused("{ to = \"B\", when = nois:above(3) }",
                   "unknown word 'nois'. Did you mean 'noise'?");
    assert_refused("{ to = \"B\", when = nothing_like_it }",
                   "A program that has more words must register them");
    assert_refused("{ to = \"B\", when = noise }", "this must be a condition, not a number");
    assert_refused("push = gate_is_free", "push must be a number, not this value");
    assert_refused("{ to = \"B\", when = gate_is_free and after(3) }", "and");
    assert_refused("{ to = \"B\", when = noise > 3 }", ":above");
    assert_refused("{ to = \"B\", when = ring }", "an action of the program is no condition");
    assert_refused("{ to = \"B\", when = ring(3) }", "'ring' acts for an agent");
    assert_refused("{ to = \"B\", when = after }",
                   "a word that takes arguments is called, with parentheses");
    assert_refused("on_enter = after", "'on_enter' must be a function of an agent, not a word");
    JoError error;
    JoScene *scene = load_with_words(
        MACHINE_START
        "\"A\", states = { A = { on_enter = function(me) ring(1, 2, 3, 4, 5) end } } }\n",
        1, &error);
    step_scene(scene, 1);
    assert_non_null(strstr(scene_messages.data, "'ring' takes at most 4 numbers"));
    jo_scene_free(scene);
    scene = load_with_words(
        MACHINE_START
        "\"A\", states = { A = { on_enter = function(me) return noise + 1 end } } }\n",
        1, &error);
    step_scene(scene, 1);
    assert_non_null(strstr(scene_messages.data, "cannot be used in a function"));
    jo_scene_free(scene);
}

static void assert_word_refused(JoWord word, const char *because) {
    JoError error = {0};
    const JoWord both[] = {words[0], word};
    char *text = jo_words_reference(both, 2, &error);
    if (text || !strstr(error.text, because))
        fail_msg("not '%s', but %s", because, error.text);
    write_test_file("own.lua", OWN);
    JoSceneDef def = define_scene(write_test_file("scene.yaml", ROOM));
    def.words = both;
    def.word_count = 2;
    assert_null(jo_scene_load(&def, &error));
}

static void wrong_words_are_refused(void **state) {
    (void)state;
    const JoWord good = {"calm", "", "m", "calm", JO_WORD_CONDITION, ask_gate, NULL, NULL};
    JoWord w = good;
    w.name = "after", w.example = "after(3)";
    assert_word_refused(w, "word 2 of the program, 'after': the language has a word of this name");
    w.name = "noise", w.example = "noise";
    assert_word_refused(w, "it is registered twice");
    w.name = "while";
    assert_word_refused(w, "Lua or the language has this name");
    w.name = "speed";
    assert_word_refused(w, "a parameter has this name");
    w.name = "2nd";
    assert_word_refused(w, "a name has letters, digits and _");
    w.name = NULL;
    assert_word_refused(w, "it has no name");
    w = good, w.meaning = "";
    assert_word_refused(w, "`meaning` must be a text");
    w = good, w.unit = NULL;
    assert_word_refused(w, "`unit` must be a text");
    w = good, w.example = "after(3)";
    assert_word_refused(w, "in which the word stands");
    w = good, w.values = NULL;
    assert_word_refused(w, "it needs the function `values`");
    w = good, w.kind = JO_WORD_ACTION;
    assert_word_refused(w, "an action needs the function `act`");
}

static void the_reference_lists_words_and_checks_examples(void **state) {
    (void)state;
    JoError error = {0};
    char *text = jo_words_reference(words, 3, &error);
    assert_non_null(text);
    assert_non_null(strstr(text, "| `noise` | number, dB | how loud it is where the agent stands | "
                                 "`noise:above(80)` |"));
    assert_non_null(strstr(text, "| `ring` | action | rings a bell | `ring(2.5)` |"));
    jo_free(text);
    text = jo_words_definitions(words, 3, &error);
    assert_non_null(strstr(text, "---@type jostle.Number\nnoise = nil\n"));
    assert_non_null(strstr(text, "---@type jostle.Condition\ngate_is_free = nil\n"));
    assert_non_null(strstr(text, "function ring(...) end\n"));
    jo_free(text);
    JoWord wrong = words[0];
    wrong.example = "noise:abov(3)";
    assert_null(jo_words_reference(&wrong, 1, &error));
    assert_non_null(strstr(error.text, "the example of word 1 of the program, 'noise': "));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(behaviours_use_words_of_the_program),
        cmocka_unit_test(actions_may_act_on_the_world),
        cmocka_unit_test(values_that_are_not_finite_count_as_zero),
        cmocka_unit_test(misused_words_are_refused),
        cmocka_unit_test(wrong_words_are_refused),
        cmocka_unit_test(the_reference_lists_words_and_checks_examples),
    };
    return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
