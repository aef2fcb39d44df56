/* Rows of key_table.c for storeys, the stairs and lifts between them, and the storey of what is
   placed. Uses the macros of that file. */
#ifndef JOX_SCENE_STOREY_KEY_ROWS_H
#define JOX_SCENE_STOREY_KEY_ROWS_H

#include "scene/lift_key_rows.h"

/* clang-format off */
#define JOX_STOREY_SCENE_ROWS \
    {"scene", "storeys", TABLE, "", 0, 0, "", ITEMS(JoxSceneDraft, storeys.storeys, storeys.storey_count), .in_draft = true, .content = "storey*", .example = "storeys: {ground: {height: 0}, first: {height: 3.5}}", \
     RESTART("the world is made with them"), .meaning = "storeys of a building, from the lowest up; `storey` says on which of them a place, a wall or anything else is"}, \
    {"scene", "stairs", TABLE, "", 0, 0, "", READ_TO(jox_key_read_stairs, JoxSceneDraft, storeys.stairs, storeys.stair_count), .in_draft = true, .content = "stair*", .example = "stairs: {north: {from: ground, to: first, path: [[10, 2], [16, 2]]}}", \
     RESTART("the world is made with them"), .meaning = "stairs, ramps and escalators"}, \
    JOX_LIFT_SCENE_ROWS

#define JOX_STOREY_OF(owner, what) \
    {owner, "storey", TEXT, "", 0, 0, "", READ(jox_key_read_storey), .first = true, .meaning = what},

#define JOX_STOREY_KEY_ROWS \
    {"storey", "height", NUMBER, "m", -1000, 1000, "!", TO(JoxStorey, height), .meaning = "height of its floor above a level of your choice; it grows from storey to storey"}, \
    {"stair", "from", TEXT, "", 0, 0, "!", READ_TO(jox_key_read_stair_storey, JoxStairDraft, stair.lower, stair.lower), .meaning = "storey of its foot: the lower one"}, \
    {"stair", "to", TEXT, "", 0, 0, "!", READ_TO(jox_key_read_stair_storey, JoxStairDraft, stair.upper, stair.upper), .meaning = "storey of its head: the upper one. The same as `from`: steps on one storey, as the aisles of a stand, which join nothing"}, \
    {"stair", "path", POINTS, "m", -FAR, FAR, "!", READ_TO(jox_key_read_points, JoxStairDraft, stair.path, stair.path_count), .content = "xy[2]", .meaning = "its middle line in plan, from the foot to the head; where it turns there is a landing; at most 300 m long"}, \
    {"stair", "width", NUMBER, "m", 0.5, 100, "1.2", TO(JoxStairDraft, stair.width), .meaning = "clear width"}, \
    {"stair", "kind", TEXT, "", 0, 0, "stairs", TO(JoxStairDraft, kind), .choices = "stairs|ramp|escalator", .meaning = "what it is: people walk more slowly on stairs than on a ramp, and an escalator carries them"}, \
    {"stair", "way", TEXT, "", 0, 0, "both", TO(JoxStairDraft, way), .choices = "both|up|down", .meaning = "ways that people may go over it; an escalator runs up or down"}, \
    {"stair", "speed", NUMBER, "m/s", 0.1, 2, "", TO(JoxStairDraft, speed), .meaning = "of an escalator: its speed along the slope; default 0.5"}, \
    {"stair", "landings", LIST, "m", 0, 10000, "", READ(jox_key_read_landings), .content = "quantity[2][1]", .example = "landings: [[2.4, 3.6]]", .meaning = "flat parts: [from, to] along the path, in plan"}, \
    {"stair", "closed", BOOL, "", 0, 0, "false", TO(JoxStairDraft, stair.closed), .meaning = "nobody sets out over it until an event opens it (`open: NAME`)"}, \
    {"stair", "rise", NUMBER, "m", 0.05, 100, "", TO(JoxStairDraft, rise), .meaning = "of steps on one storey: height of their head above their foot"}, \
    JOX_STOREY_OF("place", "storey or stair that it is on; default: the lowest storey. A place that is on two of them is two places and a set") \
    {"wall", "storey", NAMES, "", 0, 0, "", READ(jox_key_read_storey), .first = true, .meaning = "storey or stair that it is on, or several: it stands on each of them; default: the lowest storey"}, \
    {"scenery", "storey", NAMES, "", 0, 0, "", READ(jox_key_read_storey), .first = true, .meaning = "storey or stair that it is on, or several: it stands on each of them; default: the lowest storey, or that of its `body`"}, \
    JOX_STOREY_OF("body", "storey or stair that it is on; default: the lowest storey. It stays there, above the floor at height 0: bodies do not go over stairs") \
    JOX_STOREY_OF("group", "storey or stair on which the points of `at` and `starts` are; default: the lowest storey. Places of `in` have storeys of their own") \
    JOX_STOREY_OF("probe", "storey or stair on which its points are; default: the lowest storey") \
    JOX_STOREY_OF("event", "of a throw: storey or stair on which the point `from` is; default: the lowest storey") \
    JOX_STOREY_OF("heatmap", "storey or stair on which its area is; default: the lowest storey") \
    JOX_LIFT_EVENT_ROWS \
    JOX_LIFT_KEY_ROWS

#define JOX_STOREY_OWNERS \
    {"storey", "Storeys", "`storeys` maps names to storeys, from the lowest up. All coordinates are in plan; `storey: NAME` says on which storey something is. What names no storey is on the lowest.", \
     .struct_size = sizeof(JoxStorey), .name_offset = AT(JoxStorey, name), .finish = jox_finish_storey}, \
    {"stair", "Stairs", "`stairs` maps names to stairs, ramps and escalators, each from a storey up to another. They have walls at both sides; on their storeys they are open at the foot and at the head alone.", \
     .struct_size = sizeof(JoxStairDraft), .name_offset = AT(JoxStairDraft, stair.name), .position_offset = AT(JoxStairDraft, position), .finish = jox_finish_stair}, \
    JOX_LIFT_OWNERS
/* clang-format on */

#endif
