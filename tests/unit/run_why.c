/* Why agents stay in their states: terms with values and bounds, the nearest to holding first; and
   asking does not change the run. */
#include <math.h>

#include "unit/why_answers.h"

#define SCHOOL                                                                                     \
    "jostle: 1\nseed: 3\n"                                                                         \
    "walls: [{line: [[6, -5], [6, 5]], height: 3}]\n"                                              \
    "places: {door: {point: [20, 0], radius: 0.5}, line: {line: [[3, -4], [3, 4]]}}\n"             \
    "groups:\n"                                                                                    \
    "  pupils: {behaviour: own.lua, tags: [pupil], at: [[0, 0], [0, 2], [5, 0]]}\n"                \
    "  guards: {behaviour: own.lua, tags: [guard], at: [[8, 0]], set: {perception: 3}}\n"

/* A class that waits for a bell which nobody calls; its transitions are `list`. */
#define CLASS(list)                                                                                \
    "local mine = memory { laps = 2, met = false }\n" MACHINE_START                                \
    "\"Lesson\", defaults = { perception = 5, speed = 1 }, states = {\n"                           \
    "  Lesson = { steer = hold,\n" list                                                            \
    "  }, Hide = { steer = hold }, Break = { steer = hold } } }\n"

static void nearest_transition_comes_first(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(
        SCHOOL,
        CLASS("{ to = \"Hide\", when = now.x:above(100) & after(50) & mine.met },\n"
              "{ to = \"Break\", when = heard \"bell\" & after(1) & mine.laps:at_least(2) },\n"));
    step_scene(scene, 40);
    char *text = ask_agent(scene, 0);
    CHECK_ORDER(text, "agent 0 of group pupils (machine m) has been in state Lesson for 2.00 s",
                "memory: laps 2, met false", "-> Break", "one term is missing",
                "no   heard(\"bell\")", "nobody has called it so far", "yes  after(1)", "2 s",
                "yes  mine.laps >= 2", "-> Hide", "3 terms are missing", "now.x > 100",
                "0 m, needs > 100 m", "after(50)", "2 s, needs >= 50 s", "no   mine.met");
    jo_free(text);
    jo_scene_free(scene);
}

/* Of alternatives the nearest counts; `not` is carried to the words. */
static void alternatives_and_negations_are_terms(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(
        SCHOOL,
        CLASS("{ to = \"Hide\", when = ~(now.y:below(9) | mine.met) },\n"
              "{ to = \"Break\", when = after(50) | near(\"door\", 19) | ~now.y:below(9) },\n"));
    step_scene(scene, 40);
    char *text = ask_agent(scene, 0);
    CHECK_ORDER(text, "-> Break", "one term is missing", "no   one of", "near(door, 19)",
                "20 m, needs < 19 m", "-> Hide", "one term is missing", "no   not (now.y < 9)",
                "0 m, needs >= 9 m", "yes  not mine.met");
    jo_free(text);
    jo_scene_free(scene);
}

/* Targets out of sight are named, with the reason. */
static void absent_targets_are_explained(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(
        SCHOOL,
        CLASS("{ to = \"Hide\", when = sees(nearest \"guard\") },\n"
              "{ to = \"Break\", when = touches(nearest \"pupil\") },\n"
              "{ to = \"Lesson\", when = sees(nearest \"pupil\":in_state(\"Break\")) },\n"));
    step_scene(scene, 1);
    char *text = ask_agent(scene, 2);
    CHECK_ORDER(text, "touches(pupil)", "4.6 m, needs < 0.05 m; agent 0 (in Lesson), 5 m away",
                "sees(guard)", "the only one is agent 3 (in Lesson), 3 m away, behind a wall",
                "sees(pupil:in_state(\"Break\"))",
                "none of 2 passes: 2 not in state Break; the nearest to passing is agent 0 (in "
                "Lesson), 5 m away\n");
    jo_free(text);
    text = ask_agent(scene, 3);
    assert_non_null(strstr(text, "there is no other guard in the world"));
    CHECK_ORDER(text, "touches(pupil)",
                "none of 3 passes: 2 beyond its perception of 3 m, 1 behind a wall; the nearest to "
                "passing is agent 2 (in Lesson), 3 m away, behind a wall");
    jo_free(text);
    text = ask_agent(scene, 0);
    assert_non_null(strstr(text, "agent 3 (in Lesson), 8 m away, beyond its perception of 5 m"));
    jo_free(text);
    jo_scene_free(scene);
}

/* A signal that came too early, or from too far. */
static void last_call_of_a_signal_is_told(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(
        SCHOOL, CLASS("{ to = \"Break\", when = heard \"bell\" & mine.met },\n"
                      "{ to = \"Hide\", when = now.x:above(7), signal = \"bell\" },\n"));
    step_scene(scene, 2);
    char *text = ask_agent(scene, 0);
    CHECK_ORDER(
        text, "heard(\"bell\")",
        "agent 3 called it at 0.05 s at (8.00, 0.00), 8 m from where it is now, behind a wall; it "
        "hears as far as 5 m (its perception)");
    jo_free(text);
    JoError error = {0};
    assert_true(jo_scene_signal(scene, "bell", &error));
    step_scene(scene, 10);
    text = ask_agent(scene, 0);
    CHECK_ORDER(text, "heard(\"bell\")",
                "called out to everybody at 0.10 s; a signal is heard in the next step alone");
    jo_free(text);
    jo_scene_free(scene);
}

static void chance_and_functions_are_explained(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(
        SCHOOL, CLASS("{ to = \"Hide\", when = after(0.1), chance = 0 },\n"
                      "{ to = \"Break\", when = function(me) return me.met end },\n"));
    step_scene(scene, 40);
    char *text = ask_agent(scene, 0);
    CHECK_ORDER(text, "-> Hide", "yes  after(0.1)", "no   chance 0: drawn", "lost", "-> Break",
                "no   a function: it returned false when it was last asked", "160 calls in all");
    jo_free(text);
    jo_scene_free(scene);
    scene = load_scene_text(SCHOOL,
                            CLASS("{ to = \"Hide\", when = after(0.1), chance = 0 },\n"
                                  "{ to = \"Break\", when = function(me) return me.met end },\n"));
    jo_scene_follow(scene, 0);
    step_scene(scene, 40);
    text = ask_agent(scene, 0);
    CHECK_ORDER(text, "no   chance 0: 0.", "was drawn at 0.10 s, when the condition became true");
    jo_free(text);
    text = ask_why(scene, (JoWhyDef){.group = "pupils"});
    CHECK_ORDER(
        text, "3 people of group pupils", "3 people are in Lesson (machine m), all since 0.00 s",
        "-> Hide", "fires for nobody", "3 of 3  after(0.1)",
        "3 of 3 for whom the condition holds drew and lost", "-> Break", "0 of 3  a function");
    jo_free(text);
    jo_scene_free(scene);
}

/* The term that fewest people hold comes first; of a state that nobody is in, the ways there. */
static void crowds_are_counted_by_term(void **state) {
    (void)state;
    JoScene *scene =
        load_scene_text(SCHOOL, CLASS("{ to = \"Hide\", when = now.x:above(4) & now.y:above(1) },\n"
                                      "{ to = \"Break\", when = now.x:above(7) },\n"));
    step_scene(scene, 2);
    char *text = ask_why(scene, (JoWhyDef){.state = "Lesson"});
    CHECK_ORDER(text, "4 people", "3 people are in Lesson", "-> Hide", "the nearest is agent",
                "1 of 3  now.", "1 of 3  now.");
    jo_free(text);
    text = ask_why(scene, (JoWhyDef){.state = "Hide"});
    CHECK_ORDER(text, "4 people, nobody in Hide; who could go to Hide:", "3 people are in Lesson",
                "-> Hide");
    assert_null(strstr(text, "-> Break"));
    jo_free(text);
    text = ask_why(scene, (JoWhyDef){.state = "Break", .json = true});
    CHECK_ORDER(text, "\"people\": 4", "\"in_state\": 1", "\"crowds\": [", "\"state\": \"Break\"",
                "\"transitions\": []");
    jo_free(text);
    jo_scene_free(scene);
}

/* Messages count as delivered, as they are in the next step; reactions do not lead out. */
static void messages_and_reactions_are_explained(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(
        SCHOOL,
        "local mine = memory { friend = nobody }\nlocal note = told \"note\"\n" MACHINE_START
        "\"Lesson\", defaults = { perception = 5, speed = 1 }, states = {\n"
        "  Lesson = { steer = hold,\n"
        "    { every = 0.5, set = { friend = nearest \"pupil\" },\n"
        "      tell = { nearest \"pupil\", \"note\", pages = 2, about = nearest \"pupil\" } },\n"
        "    { to = \"Hide\", when = note & note.pages:above(3) },\n"
        "    { to = \"Break\", when = told \"bell\" },\n"
        "    { to = \"Break\", when = exists(mine.friend) & mine.friend.x:above(90) } },\n"
        "  Hide = { steer = hold, { every = 1, tell = { nearest \"pupil\", \"bell\" } } },\n"
        "  Break = { steer = hold } } }\n");
    step_scene(scene, 11);
    char *text = ask_agent(scene, 0);
    CHECK_ORDER(text, "memory: friend agent 1",
                "message: 'note' of agent 1, told at 0.50 s, about agent 0, pages 2", "It stays",
                "-> Hide", "one term is missing", "told(\"note\").pages > 3", "2, needs > 3",
                "yes  told(\"note\")", "'note' of agent 1", "-> Break", "told(\"bell\")",
                "no such message waits: nobody has told one so far; others do: 'note'", "-> Break",
                "mine.friend.x > 90", "yes  exists(mine.friend)", "mine.friend is agent 1",
                "reaction", "0.55 s in the state, next at 1 s");
    jo_free(text);
    jo_scene_free(scene);
}

/* Nested machines: the clock of the outer state, its terms, and the way back. */
static void nested_machines_are_explained(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(
        SCHOOL,
        "local walk = machine { start = \"Go\", states = {\n"
        "  Go = { steer = hold, { to = \"Look\", when = after(1) } },\n"
        "  Look = { steer = hold, { to = \"Go\", when = now.x:above(90) } } } }\n" MACHINE_START
        "\"Guard\", states = {\n"
        "  Guard = { runs = walk,\n"
        "    { to = \"Rest\", when = after(3.5) & now.x:above(90) },\n"
        "    { to = \"Tea\", when = done }, { to = \"Nap\", when = now.x:above(4) & after(2) } },\n"
        "  Rest = { steer = hold }, Tea = { steer = hold },\n"
        "  Nap = { steer = hold, { to = back, when = now.x:above(99) } } } }\n");
    step_scene(scene, 60);
    char *text = ask_agent(scene, 0);
    CHECK_ORDER(text, "in state Guard.Look for 2.00 s, since 1.00 s", "-> Tea", "no   done",
                "what Guard runs goes on, in Guard.Look", "-> Nap", "now.x > 4", "yes  after(2)",
                "3 s", "-> Guard.Go", "now.x > 90", "-> Rest", "2 terms are missing", "after(3.5)",
                "3 s, needs >= 3.5 s");
    jo_free(text);
    text = ask_agent(scene, 2);
    CHECK_ORDER(text, "in state Nap", "-> back, to Guard.Look", "now.x > 99");
    jo_free(text);
    text = ask_why(scene, (JoWhyDef){.state = "Guard", .to = "Tea"});
    CHECK_ORDER(text, "who could go to Tea:", "2 people are in Guard.Look", "-> Tea",
                "0 of 2  done");
    jo_free(text);
    text = ask_why(scene, (JoWhyDef){.to = "Guard"});
    CHECK_ORDER(text, "who could go to Guard:", "people are in Guard.Look", "-> Guard.Go");
    jo_free(text);
    jo_scene_free(scene);
}

static void unknown_names_are_refused(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(SCHOOL, CLASS("{ to = \"Hide\", when = after(5) },\n"));
    const struct {
        JoWhyDef def;
        const char *text;
    } cases[] = {
        {{.has_agent = true, .agent = 9}, "there is no agent 9 at 0.00 s: 4 came in so far"},
        {{.group = "pupil"}, "the scene has no group 'pupil'. Did you mean 'pupils'?"},
        {{.state = "Leson"}, "the scene has no state 'Leson'. Did you mean 'Lesson'?"},
    };
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        JoError error = {0};
        JoWhyDef def = cases[c].def;
        def.cookie = jo_default_why_def().cookie;
        assert_null(jo_scene_why(scene, &def, &error));
        assert_int_equal(error.code, JO_USAGE);
        assert_non_null(strstr(error.text, cases[c].text));
    }
    jo_scene_free(scene);
}

/* Asking at every third step leaves hash and results as they are, with bodies, queues, signals. */
static void asking_does_not_change_the_run(void **state) {
    (void)state;
    static const char *const SCENES[] = {"scenes/dodgeball.yaml", "scenes/counter.yaml",
                                         "scenes/station.yaml", "scenes/outbreak.yaml"};
    for (size_t s = 0; s < sizeof SCENES / sizeof *SCENES; s++) {
        JoScene *asked = load_scene_file(SCENES[s], NULL, 0);
        JoScene *plain = load_scene_file(SCENES[s], NULL, 0);
        for (int n = 0; n < 200; n++) {
            step_scene(asked, 1);
            step_scene(plain, 1);
            if (n % 3 != 0)
                continue;
            const uint64_t before = jo_world_hash(asked->world);
            jo_free(ask_why(asked, (JoWhyDef){.json = n % 2}));
            assert_true(jo_world_hash(asked->world) == before);
        }
        assert_true(jo_world_hash(asked->world) == jo_world_hash(plain->world));
        jo_scene_free(asked);
        jo_scene_free(plain);
    }
}

/* What is told to fire next fires in the next step, and nothing else. */
static void told_transitions_fire_in_the_next_step(void **state) {
    (void)state;
    JoScene *scene = load_scene_file("scenes/dodgeball.yaml", NULL, 0);
    const JoxMachineRun *machines = &scene->world->machines;
    uint32_t fired = 0, told = 0, both = 0;
    for (int n = 0; n < 400; n++) {
        const JoxAgents *a = &scene->world->state.agents;
        bool will[64] = {0};
        for (uint32_t id = 0; id < a->next_id && id < 64; id++) {
            if (jox_agents_find(a, id) == JOX_NO_INDEX)
                continue;
            char *text = ask_agent(scene, id);
            will[id] = strstr(text, "in the next step:") != NULL;
            told += will[id];
            jo_free(text);
        }
        step_scene(scene, 1);
        for (uint32_t k = 0; k < machines->taken_count; k++) {
            fired++;
            both += will[machines->taken[k].agent_id];
        }
    }
    assert_true(fired > 10);
    assert_true(told == both && 2 * both > fired); /* the others have a chance */
    jo_scene_free(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nearest_transition_comes_first),
        cmocka_unit_test(alternatives_and_negations_are_terms),
        cmocka_unit_test(absent_targets_are_explained),
        cmocka_unit_test(last_call_of_a_signal_is_told),
        cmocka_unit_test(chance_and_functions_are_explained),
        cmocka_unit_test(crowds_are_counted_by_term),
        cmocka_unit_test(messages_and_reactions_are_explained),
        cmocka_unit_test(nested_machines_are_explained),
        cmocka_unit_test(unknown_names_are_refused),
        cmocka_unit_test(asking_does_not_change_the_run),
        cmocka_unit_test(told_transitions_fire_in_the_next_step),
    };
    return cmocka_run_group_tests(tests, make_test_folder, remove_scene_folder);
}
