/* Worlds in which people and bodies meet: set-ups of the tests of driven and of heavy bodies. */
#ifndef JOX_TESTS_UNIT_WORLD_MEETING_H
#define JOX_TESTS_UNIT_WORLD_MEETING_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "body/body.h"
#include "jostle.h"
#include "jostle_act.h"
#include "jostle_read.h"
#include "world/world.h"

static inline JoWorld *create_world(void) {
    JoError error = {0};
    JoWorldDef def = jo_default_world_def();
    JoWorld *world = jo_world_create(&def, &error);
    if (!world)
        fail_msg("%s", error.text);
    return world;
}

/* Adds a wall along `count` points, x and y of each in m. */
static inline void add_wall(JoWorld *world, const double *points, uint32_t count) {
    JoError error = {0};
    if (!jo_world_add_line(world, points, count, &error))
        fail_msg("%s", error.text);
}

/* Adds an agent at a point, m, that pushes those in its way with `push` newtons. */
static inline JoAgent add_person(JoWorld *world, double x, double y, double push) {
    JoError error = {0};
    JoAgentDef def = jo_default_agent_def();
    def.x = x;
    def.y = y;
    def.push = push;
    const JoAgent person = jo_world_add_agent(world, &def, &error);
    if (error.text[0])
        fail_msg("%s", error.text);
    jo_agent_set_parameter(world, person, "breadth", 2.0 * def.radius, NULL); /* a disc */
    jo_agent_set_parameter(world, person, "depth", 2.0 * def.radius, NULL);
    return person;
}

static inline JoBody add_body(JoWorld *world, const JoBodyDef *def) {
    JoError error = {0};
    const JoBody body = jo_world_add_body(world, def, &error);
    if (error.text[0])
        fail_msg("%s", error.text);
    return body;
}

#endif
