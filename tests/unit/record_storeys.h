/* Two storeys with a stair, the same plan laid flat, and a crowd on both. */
#ifndef JOSTLE_TESTS_RECORD_STOREYS_H
#define JOSTLE_TESTS_RECORD_STOREYS_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "assert_near.h"
#include "base/mem.h"
#include "geom/storeys.h"

/* Lays out two storeys, 3 m apart, on a plan of 20 m x 10 m. A stair leads from x = 8 up to x = 14,
   about y = 5, 2 m wide. */
static inline JoxStoreys lay_out_two_storeys(void) {
    JoxStoreys s = {.storey_count = 2, .stair_count = 1};
    s.storeys = jox_alloc(2, sizeof *s.storeys);
    s.storeys[0] = (JoxStorey){jox_strdup("ground"), 0.0f};
    s.storeys[1] = (JoxStorey){jox_strdup("first"), 3.0f};
    s.stairs = jox_alloc(1, sizeof *s.stairs);
    s.stairs[0] = (JoxStair){.name = jox_strdup("north"), .upper = 1, .width = 2.0f};
    s.stairs[0].path = jox_alloc(2, sizeof *s.stairs[0].path);
    s.stairs[0].path[0] = jox_v2(8, 5);
    s.stairs[0].path[1] = jox_v2(14, 5);
    s.stairs[0].path_count = 2;
    jox_storeys_lay_out(&s, jox_v2(0, 0), jox_v2(20, 10));
    return s;
}

enum { CROWD = 800 };
static const float WEST = 8.0f, EAST = 14.0f; /* m: x of the foot and the head of the stair */

/* A crowd in a room west of x = 8, on the stair and in a room east of x = 14: in one plane, and on
   the sheets of storeys. */
typedef struct Plan {
    float turn; /* rad: all of the plan is turned by it */
    uint32_t count;
    float x[CROWD], flat[CROWD], sheets[CROWD];
    JoxWalls flat_walls, sheet_walls;
    JoxStoreys storeys;
} Plan;

static inline JoxV2 turn_point(const Plan *p, float x, float y) {
    return jox_v2(x * cosf(p->turn) - y * sinf(p->turn), x * sinf(p->turn) + y * cosf(p->turn));
}

/* Returns the position on its sheet of a point that was not turned yet. */
static inline JoxV2 put_on_sheet(const Plan *p, float x, float y) {
    const uint32_t sheet = x < WEST ? 0 : x < EAST ? p->storeys.stairs[0].sheet : 1;
    return jox_on_sheet(&p->storeys, sheet, turn_point(p, x, y));
}

static inline void add_walls(const Plan *p, const float (*points)[2], uint32_t count, bool closed,
                             uint32_t sheet, JoxWalls *walls) {
    JoxV2 at[4];
    for (uint32_t k = 0; k < count; k++)
        at[k] = jox_on_sheet(&p->storeys, sheet, turn_point(p, points[k][0], points[k][1]));
    jox_walls_add_polyline(walls, at, count, closed, INFINITY);
}

/* Adds an outer wall and, at x, a wall with an opening for the stair. */
static inline void add_room(const Plan *p, float x, uint32_t sheet, JoxWalls *walls) {
    add_walls(p, (const float[][2]){{0, 0}, {20, 0}, {20, 10}, {0, 10}}, 4, true, sheet, walls);
    add_walls(p, (const float[][2]){{x, 0}, {x, 4}}, 2, false, sheet, walls);
    add_walls(p, (const float[][2]){{x, 6}, {x, 10}}, 2, false, sheet, walls);
}

/* Adds people 0.5 m apart, and twice as many beside each other in the middle of the stair. */
static inline void add_crowd(Plan *p) {
    for (float x = 0.25f; x < 20.0f; x += 0.5f)
        for (float y = 0.2f; y<10.0f; y += x> 10.0f && x < 12.0f ? 0.25f : 0.5f) {
            if (x > WEST && x < EAST && (y < 4.0f || y > 6.0f))
                continue;
            p->x[p->count] = turn_point(p, x, y).x;
            p->flat[p->count] = turn_point(p, x, y).y;
            p->sheets[p->count++] = put_on_sheet(p, x, y).y;
        }
}

static inline Plan *make_plan(float turn) {
    Plan *p = jox_alloc(1, sizeof *p);
    p->turn = turn;
    p->storeys = lay_out_two_storeys();
    JoxStair *stair = &p->storeys.stairs[0];
    for (uint32_t k = 0; k < 2; k++)
        stair->path[k] = turn_point(p, stair->path[k].x, stair->path[k].y);
    jox_storeys_lay_out(&p->storeys, jox_v2(-10, -10), jox_v2(20, 25));
    add_crowd(p);
    add_room(p, WEST, 0, &p->flat_walls);
    add_room(p, EAST, 0, &p->flat_walls);
    add_walls(p, (const float[][2]){{WEST, 4}, {EAST, 4}}, 2, false, 0, &p->flat_walls);
    add_walls(p, (const float[][2]){{WEST, 6}, {EAST, 6}}, 2, false, 0, &p->flat_walls);
    add_room(p, WEST, 0, &p->sheet_walls);
    add_room(p, EAST, 1, &p->sheet_walls);
    jox_storeys_add_walls(&p->storeys, &p->sheet_walls);
    return p;
}

static inline void free_plan(Plan *p) {
    jox_walls_free(&p->flat_walls);
    jox_walls_free(&p->sheet_walls);
    jox_storeys_free(&p->storeys);
    jox_free(p);
}

#endif
