/* A scene with a gate, a ball and four walkers, and the lines of input that act on them. Shared by
   the tests of inputs and of inspection. */
#ifndef JOX_TESTS_GATE_BALL_SCENE_H
#define JOX_TESTS_GATE_BALL_SCENE_H

#include "unit/scene_loader.h"

/* People walk east until a signal stops them; their parameters are numbers, draws and expressions.
 */
#define WALKER                                                                                     \
    "local mine = memory { met = false, laps = 3 }\n" MACHINE_START                                \
    "\"Walk\", defaults = { speed = normal(1.2, 0.2), perception = 4 }, states = {\n"              \
    "  Walk = { steer = drift(1, 0), speed = 0.5 * now.speed + 0.4,\n"                             \
    "    { to = \"Wait\", when = heard \"stop\" & ~mine.met & mine.laps:above(1) } },\n"           \
    "  Wait = { steer = hold, push = own.speed, max_speed = 1,\n"                                  \
    "    { to = \"Walk\", when = after(60), chance = 0.5 } } } }\n"
#define GATE_AND_BODIES                                                                            \
    "jostle: 1\nwalls: [{line: [[30, -5], [30, 5]], name: gate}]\n"                                \
    "bodies:\n"                                                                                    \
    "  - {name: ball, shape: {sphere: {radius: 0.15}}, mass: 1, at: [8, 0, 0.15]}\n"               \
    "  - {name: pillar, shape: {box: {size: [1, 1, 2]}}, mass: 0, at: [15, 5, 1]}\n"
#define GATE_ALONE "jostle: 1\nwalls: [{line: [[30, -5], [30, 5]], name: gate}]\n"
#define FOUR_WALKERS                                                                               \
    "groups: {people: {behaviour: own.lua, at: [[0, 0], [1, 0.1], [2, -0.3], [3, 0.2]],"           \
    " set: {mass: 80}}}\n"

static inline JoScene *load_gate_and_ball(void) {
    return load_scene_text(
        jox_bodies_available() ? GATE_AND_BODIES FOUR_WALKERS : GATE_ALONE FOUR_WALKERS, WALKER);
}

static inline void apply_input(JoScene *scene, const char *line) {
    JoError error = {0};
    if (!jo_scene_input(scene, line, &error))
        fail_msg("%s: %s", line, error.text);
}

#endif
