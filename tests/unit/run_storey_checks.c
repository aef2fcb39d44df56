/* Tests of what is said before a run about lifts: words of behaviours that are given other places,
   and people who are too heavy or too broad for a lift or a stair. */
#include <stdio.h>

#include "jostle_tools.h"
#include "unit/scene_loader.h"

#define LIFT(keys)                                                                                 \
    "jostle: 1\n"                                                                                  \
    "storeys: {ground: {height: 0}, first: {height: 4}}\n"                                         \
    "lifts: {east: {area: [[10, 5], [11.6, 6.8]], door: [[10.4, 5], [11.01, 5]]" keys "}}\n"       \
    "places:\n"                                                                                    \
    "  low: {polygon: [[1, 1], [7, 1], [7, 7], [1, 7]]}\n"                                         \
    "  high: {polygon: [[1, 1], [7, 1], [7, 7], [1, 7]], storey: first}\n"                         \
    "  cars: {set: [east.ground, east.first]}\n"                                                   \
    "  mixed: {set: [east.ground, low]}\n"

/* Checks a scene, with a behaviour own.lua unless it is NULL, and returns what is said; the caller
   frees it. */
static JoxText check_text(const char *scene, const char *behaviour) {
    JoxText said = {0};
    if (behaviour)
        write_test_file("own.lua", behaviour);
    const char *paths[] = {write_test_file("scene.yaml", scene)};
    jo_check(paths, 1, false, append_message, &said, NULL);
    return said;
}

static void expect_said(const char *scene, const char *behaviour, const char *wanted) {
    JoxText said = check_text(scene, behaviour);
    if (!said.data || !strstr(said.data, wanted))
        fail_msg("no '%s' in:\n%s", wanted, said.data ? said.data : "");
    jox_text_free(&said);
}

static void words_on_lifts_need_places_of_lifts(void **state) {
    (void)state;
    static const struct {
        const char *go, *says;
    } CASES[] = {
        {"steer = hold, { to = \"End\", when = in_use \"low\" }",
         "own.lua:2:52: in_use: the place 'low' is no lift's. Places of lifts are LIFT.STOREY: "
         "\"east.ground\""},
        {"steer = hold, { to = \"End\", when = in_use \"mixed\" }",
         "own.lua:2:52: in_use: the set 'mixed' has the place 'low', which is no lift's"},
        {"steer = ride \"low\"", "own.lua:2:23: ride: the place 'low' is no lift's"},
        {"steer = ride \"mixed\"", "own.lua:2:23: ride: the set 'mixed' has the place 'low'"},
        {"steer = hold, { to = \"End\", when = rode }",
         "own.lua:2:38: warning: `rode` never holds here: the agent does not ride in this state"},
        {"steer = ride \"cars\", { to = \"End\", when = rode & in_use \"cars\" }", "nothing wrong"},
    };
    for (size_t k = 0; k < sizeof CASES / sizeof *CASES; k++) {
        char behaviour[500];
        snprintf(behaviour, sizeof behaviour,
                 MACHINE_START
                 "\"Go\", states = {\n  Go = { %s, { to = \"End\", when = after(9) } },"
                 "\n  End = { steer = hold } } }\n",
                 CASES[k].go);
        expect_said(LIFT("") "groups: {people: {behaviour: own.lua, count: 1, in: low}}\n",
                    behaviour, CASES[k].says);
    }
    expect_said(LIFT("") "groups: {people: {count: 1, in: low, journey: [{ride: mixed}]}}\n", NULL,
                "scene.yaml:9:55: the place 'low' is no lift's");
}

#define STAIR "stairs: {north: {from: ground, to: first, path: [[4, 12], [11, 12]], width: 0.5}}\n"

static void people_who_cannot_ride_are_named(void **state) {
    (void)state;
#define PEOPLE(set, journey)                                                                       \
    "groups: {people: {count: 5, in: low, set: {" set "}, journey: [{" journey "}]}}\n"
    static const struct {
        const char *scene, *says;
    } CASES[] = {
        {LIFT(", load: 100") PEOPLE("mass: 150", "ride: east.first"),
         "scene.yaml:9:10: warning: nobody of group 'people' can ride in 'east': they weigh up to "
         "150 kg, and its load is 100 kg. Give the lift load: 150"},
        {LIFT(", load: 100") PEOPLE("mass: 150", "to: high"), "nobody of group 'people' can ride"},
        {LIFT(", load: 100") PEOPLE("mass: 'choose(90, 150)'", "ride: cars"),
         "of the 5 people of group 'people' cannot ride in 'east'"},
        {LIFT("") PEOPLE("radius: 0.5", "ride: east.first"),
         "warning: nobody of group 'people' can ride in 'east': its door on ground is 0.61 m wide, "
         "and their radius is up to 0.50 m. Make the door 1.00 m wide"},
        /* They pass, or have no reason to ride. */
        {LIFT("") PEOPLE("radius: 0.4", "ride: east.first"), "nothing wrong"},
        {LIFT("") STAIR PEOPLE("radius: 0.4", "to: high"),
         "warning: nobody of group 'people' can pass the stair 'north': it is 0.50 m wide, and "
         "their radius is up to 0.40 m. Make it 0.80 m wide"},
        {LIFT("") STAIR PEOPLE("radius: 0.3", "to: high"), "nothing wrong"},
        {LIFT("") STAIR PEOPLE("radius: 0.4", "to: low"), "nothing wrong"},
        {LIFT(", load: 100") PEOPLE("mass: 100", "ride: east.first"), "nothing wrong"},
        {LIFT(", load: 100") PEOPLE("mass: 150", "to: low"), "nothing wrong"},
    };
    for (size_t k = 0; k < sizeof CASES / sizeof *CASES; k++)
        expect_said(CASES[k].scene, NULL, CASES[k].says);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(words_on_lifts_need_places_of_lifts),
        cmocka_unit_test(people_who_cannot_ride_are_named),
    };
    return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
