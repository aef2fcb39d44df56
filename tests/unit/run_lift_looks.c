/* Tests of what is told of people at lifts while a scene runs: where they are, how they use a lift
   and since when, and why they stay in their state. */
#include "jostle_tools.h"
#include "unit/assert_near.h"
#include "unit/scene_loader.h"

static const char SCENE[] =
    "jostle: 1\n"
    "storeys: {ground: {height: 0}, first: {height: 4}, second: {height: 8}}\n"
    "lifts:\n"
    "  east: {area: [[10, 5], [11.6, 6.8]], door: [[10.35, 5], [11.25, 5]], home: second}\n"
    "walls:\n"
    "  - {line: [[0, 0], [16, 0], [16, 8], [0, 8]], closed: true, storey: [ground, first, "
    "second]}\n"
    "groups: {people: {behaviour: own.lua, at: [[4, 3], [5, 3], [5, 2]]}}\n";
/* Between the storeys they are in Low, then High: by the program's word and by a function. */
static const char MACHINE[] = MACHINE_START
    "\"Ride\", states = {\n"
    "  Ride = { steer = ride \"east.second\",\n"
    "    { to = \"Low\", when = now.height:above(1) & now.height:below(3) } },\n"
    "  Low = { steer = ride \"east.second\",\n"
    "    { to = \"High\", when = function(me) return me.height > 5 and me.height < 7 end } "
    "},\n"
    "  High = { steer = ride \"east.second\" } } }\n";

static JoAgent find_first(const JoScene *scene) {
    return jo_world_agent_of(scene->world, 0);
}

/* Asks why an agent, or all, stay; the caller frees the text. */
static char *ask_why(JoScene *scene, bool one) {
    JoError error = {0};
    JoWhyDef def = jo_default_why_def();
    def.has_agent = one;
    def.group = one ? NULL : "people";
    char *text = jo_scene_why(scene, &def, &error);
    if (!text)
        fail_msg("%s", error.text);
    return text;
}

static void expect_why(JoScene *scene, bool one, const char *wanted) {
    char *text = ask_why(scene, one);
    if (!strstr(text, wanted))
        fail_msg("no '%s' in:\n%s", wanted, text);
    jo_free(text);
}

static void riders_are_told_with_lift_time_and_height(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(SCENE, MACHINE);
    double called = 0.0, boarded = 0.0;
    bool between = false;
    int phase = JO_RIDE_NONE;
    for (int n = 0; n < 60 * 20 && phase != 4; n++) {
        step_scene(scene, 1);
        const JoWhere at = jo_agent_where(scene->world, find_first(scene));
        const JoLiftState car = jo_world_lift(scene->world, 0);
        assert_int_equal(at.lift, at.ride == JO_RIDE_NONE ? JO_NO_LIFT : 0);
        assert_int_equal(isnan(at.since), at.ride < JO_RIDE_WAITS);
        if (at.ride == JO_RIDE_WAITS && phase == JO_RIDE_APPROACHES) {
            called = jo_world_time(scene->world);
            assert_near(at.since, called, 0.11);
            expect_why(scene, true, "lift east: it waits before the door on ground, since ");
            expect_why(scene, true, "to ride to second; the car ");
            expect_why(scene, false, "  lift east: ");
        }
        if (at.ride == JO_RIDE_RIDES && phase == JO_RIDE_WAITS) {
            boarded = jo_world_time(scene->world);
            assert_near(at.since, boarded, 0.11);
            expect_why(scene, true, "lift east: it is in the car, since ");
        }
        if (at.ride == JO_RIDE_RIDES)
            assert_near(at.height, car.height, 1e-5);
        between |= at.height > 4.5 && at.height < 7.5;
        if (at.ride == JO_RIDE_NONE && phase == JO_RIDE_RIDES)
            phase = 4; /* it is out */
        else
            phase = (int)at.ride;
    }
    assert_int_equal(phase, 4);
    assert_true(between && boarded > called && called > 0.0);
    const JoWhere out = jo_agent_where(scene->world, find_first(scene));
    assert_near(out.height, 8.0, 0);
    assert_int_equal(out.storey, 2);
    const JoxAgents *a = &scene->world->state.agents; /* words of behaviours saw the car's height */
    const uint32_t first = jox_agents_find(a, 0);
    assert_string_equal(
        scene->world->machines.set->items[a->machine[first]]->states[a->state[first]].name, "High");
    jo_scene_free(scene);
}

static void crowds_before_a_lift_are_counted(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(SCENE, MACHINE);
    for (int n = 0; n < 20 * 20 && jo_world_lift(scene->world, 0).waiting < 3; n++)
        step_scene(scene, 1);
    expect_why(scene, false, "lift east: 3 wait before it, agent ");
    JoWhyDef def = jo_default_why_def();
    JoError error = {0};
    def.json = true;
    def.group = "people";
    char *text = jo_scene_why(scene, &def, &error);
    assert_non_null(strstr(text, "\"wait\": 3"));
    jo_free(text);
    def = jo_default_why_def();
    def.json = def.has_agent = true;
    text = jo_scene_why(scene, &def, &error);
    assert_non_null(strstr(text, "\"does\": \"waits\""));
    assert_non_null(strstr(text, "\"to\": \"second\""));
    jo_free(text);
    jo_scene_free(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(riders_are_told_with_lift_time_and_height),
        cmocka_unit_test(crowds_before_a_lift_are_counted),
    };
    return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
