/* What there is where a term of a condition does not hold: candidates of targets, calls of signals,
   messages. */
#include "unit/why_answers.h"

/* Candidates of targets are counted by what they lack first, in all words on targets. */
static void candidates_are_counted_by_what_they_lack(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(
        "jostle: 1\nseed: 3\nwalls: [{line: [[-3, -5], [-3, 5]], height: 3}]\n"
        "bodies: [{name: ball, shape: {sphere: {radius: 0.1}}, mass: 1, at: [1, 1, 0.1], tags: "
        "[runner]}]\n"
        "groups:\n"
        "  one: {behaviour: own.lua, at: [[0, 0]]}\n"
        "  runners: {behaviour: own.lua, tags: [runner], at: [[2, 0], [4, 0], [-4, 0], [40, 0]]}\n",
        "local mine = memory { friend = nobody, hp = 2, met = list(4, nobody) }\n"
        "local weak = best(\"runner\", 0 - distance(other)):where(\"hp\", 3)\n" MACHINE_START
        "\"Look\", public = { \"hp\" }, defaults = { perception = 9, speed = 1 }, states = {\n"
        "  Look = { steer = hold,\n"
        "    { to = \"A\", when = exists(weak) },\n"
        "    { to = \"B\", when = distance(nearest \"runner\":within(1)):below(3) },\n"
        "    { to = \"C\", when = exists(best(\"runner\", 0 - distance(other))) & now.x:above(9) "
        "},\n"
        "    { to = \"D\", when = neighbours \"runner\":above(7) },\n"
        "    { to = \"E\", when = theirs(mine.friend, \"hp\"):above(7) },\n"
        "    { to = \"F\", when = same(mine.friend, nearest \"opponents\") },\n"
        "    { to = \"G\", when = mine.met:contains(nearest \"runner\":in_state \"A\") } },\n"
        "  A = { steer = hold }, B = { steer = hold }, C = { steer = hold }, D = { steer = hold "
        "},\n"
        "  E = { steer = hold }, F = { steer = hold }, G = { steer = hold } } }\n");
    step_scene(scene, 1);
    char *text = ask_agent(scene, 0);
    CHECK_PARTS(
        text, "exists(best(runner):where(\"hp\", 3))",
        "none of 5 passes: 1 no person, 4 without hp >= 3; the nearest to passing is agent 1 (in "
        "Look), 2 m away, without hp >= 3 (2)",
        "distance(runner:within(1)) < 3",
        "none of 5 passes: 5 not within 1 m; the nearest to passing is body 'ball', 1.41 m away",
        "yes  exists(best(runner))",
        "best(runner) is body 'ball', 1.41 m away, the best of 3, with score -1.41",
        "0 m, needs > 9 m",
        "2, needs > 7; 2 of 4 pass: 1 beyond its perception of 9 m, 1 behind a wall",
        "theirs(mine.friend, \"hp\") > 7", "0, needs > 7; mine.friend is nobody",
        "same(mine.friend, opponents)",
        "mine.friend is nobody; it has no opponents, as it is in no team",
        "mine.met is empty; none of 5 passes: 1 no person, 4 not in state A");
    jo_free(text);
    jo_scene_free(scene);
}

/* Calls are measured from where a followed agent was; the one that it hears now is named. */
static void calls_are_measured_from_where_the_agent_was(void **state) {
    (void)state;
    write_test_file(
        "bell.lua",
        "return machine { name = \"bell\", start = \"Ring\", states = { Ring = { steer = hold,\n"
        "  { when = now.y:below(1) & now.time:below(0.01), signal = \"bell\" },\n"
        "  { every = 0.95, when = now.y:above(0.5) & now.time:below(1.5), signal = \"gong\" }\n"
        "} } }\n");
    JoScene *scene = load_scene_text(
        "jostle: 1\nplaces: {far: {point: [90, 0]}}\ngroups:\n"
        "  walkers: {behaviour: own.lua, at: [[0, 0]]}\n"
        "  bells: {behaviour: bell.lua, at: [[3, 0], [0, 9], [0, 1]]}\n",
        MACHINE_START "\"Go\", defaults = { perception = 5, speed = 1 }, states = {\n"
                      "  Go = { steer = seek \"far\",\n"
                      "    { to = \"Go\", when = heard(\"bell\", 2) & now.x:above(90) },\n"
                      "    { to = \"Go\", when = heard \"gong\" & now.x:above(90) } } } }\n");
    jo_scene_follow(scene, 0);
    step_scene(scene, 20);
    char *text = ask_agent(scene, 0);
    CHECK_ORDER(text, "yes  heard(\"gong\")", "agent 3 called it at 1.00 s at (0.00, 1.00), ",
                " m away\n");
    jo_free(text);
    step_scene(scene, 60);
    text = ask_agent(scene, 0);
    CHECK_PARTS(
        text, "no   heard(\"gong\")",
        "agent 3 called it at 1.00 s at (0.00, 1.00), 1.38 m away from where it was then; a "
        "signal is heard in the next step alone",
        "no   heard(\"bell\", 2)",
        "agent 1 called it at 0.05 s at (3.00, 0.00), 2.98 m away from where it was then; "
        "it hears as far as 2 m (as asked for)");
    jo_free(text);
    jo_scene_free(scene);
}

/* The use or loss of messages is told: of one agent if it is followed, else of the scene. */
static void told_messages_are_accounted_for(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(
        "jostle: 1\ngroups:\n  pupils: {behaviour: own.lua, at: [[0, 0], [1, 0], [2, 0]]}\n",
        "local mine = memory { got = 0 }\n" MACHINE_START
        "\"Lesson\", defaults = { perception = 5 }, states = {\n"
        "  Lesson = { steer = hold,\n"
        "    { when = told \"note\", set = { got = mine.got + 1 } },\n"
        "    { every = 1, when = now.x:above(0.5), tell = { nearest \"anyone\", \"note\" } },\n"
        "    { every = 1, tell = { nearest \"opponents\", \"shout\" } },\n"
        "    { every = 1, tell = { neighbours \"opponents\", \"shout\" } },\n"
        "    { to = \"End\", when = told \"note\" & mine.got:above(5) },\n"
        "    { to = \"End\", when = told \"shout\" }, { to = \"End\", when = told \"bell\" } },\n"
        "  End = { steer = hold } } }\n");
    jo_scene_follow(scene, 0);
    step_scene(scene, 50);
    char *text = ask_agent(scene, 0);
    CHECK_PARTS(
        text,
        "no such message waits; the last of 2 that came was told by agent 1 at 2.00 s, and was "
        "used "
        "at 2.05 s by a reaction (",
        "own.lua:4); in the scene 4 were told\n",
        "no such message waits; none has come to it since 0.00 s; in the scene 12 were told, 12 of "
        "them to nobody\n",
        "no such message waits: no behaviour of the scene tells "
        "it\n");
    jo_free(text);
    text = ask_agent(scene, 2);
    CHECK_ORDER(text, "told(\"note\")",
                "no such message waits; in the scene 4 were told, the last at 2.00 s by agent "
                "2 to agent 1");
    jo_free(text);
    jo_scene_free(scene);
}

/* What a state does in vain is told: steering to whom it does not see, and bodies beyond reach. */
static void actions_in_vain_are_told(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(
        "jostle: 1\nwalls: [{line: [[-3, -5], [-3, 5]], height: 3}]\nplaces: {far: {point: [9, "
        "0]}}\n"
        "bodies: [{name: ball, shape: {sphere: {radius: 0.1}}, mass: 1, at: [1.5, 0, 0.1], tags: "
        "[ball]}]\n"
        "groups:\n"
        "  one: {behaviour: own.lua, tags: [one], at: [[0, 0]]}\n"
        "  runners: {behaviour: own.lua, tags: [runner], at: [[-4, 0]]}\n"
        "  guides: {behaviour: own.lua, at: [[-3, 7]]}\n",
        "local mine = memory { friend = nobody }\nlocal ball = nearest \"ball\"\n"
        "local hi = told \"hi\"\n" MACHINE_START
        "\"Look\", defaults = { perception = 9, speed = 1 }, states = {\n"
        "  Look = { steer = hold,\n"
        "    { when = now.y:above(5) & after(0.05),\n"
        "      tell = { nearest \"one\", \"hi\", who = nearest \"runner\" } },\n"
        "    { to = \"Go\", when = hi, set = { friend = hi.who } } },\n"
        "  Go = { steer = field(last_seen(mine.friend)), face = mine.friend, take = ball,\n"
        "    kick = { ball, at = \"far\", impulse = 1 }, grasp = mine.friend,\n"
        "    { to = \"Throw\", when = after(1) } },\n"
        "  Throw = { steer = seek \"far\" + spread, throw = { ball, at = \"far\", speed = 3 },\n"
        "    { to = \"Look\", when = after(9) } } } }\n");
    step_scene(scene, 10);
    char *text = ask_agent(scene, 0);
    CHECK_ORDER(text, "memory: friend agent 1",
                "  steering: field(last_seen(mine.friend)): it has not seen mine.friend; "
                "mine.friend is agent 1 (in Look), 4 m away, behind a wall; so it stands\n",
                "  face mine.friend: mine.friend is agent 1 (in Look), 4 m away, behind a wall\n",
                "  take ball: body 'ball', 1.5 m away: a gap of 1.2 m, reach 0.6 m\n",
                "  kick ball: body 'ball', 1.5 m away: a gap of 1.2 m, reach 0.05 m\n",
                "  grasp mine.friend: mine.friend is agent 1 (in Look), 4 m away, behind a wall\n",
                "It stays, as its transition does not fire");
    jo_free(text);
    step_scene(scene, 30);
    text = ask_agent(scene, 0);
    CHECK_ORDER(text, "  steering: seek(far): ", " m away; spread\n",
                "  throw ball: it does not hold it\n", "It stays");
    jo_free(text);
    jo_scene_free(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(candidates_are_counted_by_what_they_lack),
        cmocka_unit_test(calls_are_measured_from_where_the_agent_was),
        cmocka_unit_test(told_messages_are_accounted_for),
        cmocka_unit_test(actions_in_vain_are_told),
    };
    return cmocka_run_group_tests(tests, make_test_folder, remove_scene_folder);
}
