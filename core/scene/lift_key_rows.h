/* Rows of key_table.c for lifts, and for events that change their mode. Uses the macros of that
   file. */
#ifndef JOX_SCENE_LIFT_KEY_ROWS_H
#define JOX_SCENE_LIFT_KEY_ROWS_H

#define JOX_LIFT_MODE_NAMES "in_use|out_of_use|firemen" /* in the order of JoxLiftMode */

/* clang-format off */
#define JOX_LIFT_SCENE_ROWS \
    {"scene", "lifts", TABLE, "", 0, 0, "", READ_TO(jox_key_read_lifts, JoxSceneDraft, lifts, lift_count), .in_draft = true, .content = "lift*", .example = "lifts: {east: {area: [[0, 0], [1.6, 1.8]], door: [[0.4, 1.8], [1.2, 1.8]]}}", \
     RESTART("the world is made with them"), .meaning = "lifts that carry people between storeys; behaviours take them by `ride`"},

#define JOX_LIFT_KEY_ROWS \
    {"lift", "area", POINTS, "m", -FAR, FAR, "!", READ(jox_key_read_lift_area), .content = "xy[2]", .meaning = "shaft and floor of the car, in plan: two opposite corners of a rectangle, or the corners of a polygon"}, \
    {"lift", "door", POINTS, "m", -FAR, FAR, "", READ_TO(jox_key_read_lift_door, JoxLiftDraft, door, has_door), .content = "xy[2]", .meaning = "ends of its door, on the outline of the area: that of each storey for which `doors` has none"}, \
    {"lift", "doors", TABLE, "m", -FAR, FAR, "", READ(jox_key_read_lift_doors), .content = "xy[2]*", .example = "doors: {first: [[0.4, 0], [1.2, 0]]}", .meaning = "ends of the doors of single storeys"}, \
    {"lift", "storeys", NAMES, "", 0, 0, "", READ(jox_key_read_lift_storeys), .meaning = "storeys that it serves; default: all. The shaft passes the others, without a door"}, \
    {"lift", "capacity", WHOLE, "", 1, JOX_MOST_CAPACITY, "8", TO(JoxLiftDraft, lift.capacity), .meaning = "people for whom there is room"}, \
    {"lift", "load", NUMBER, "kg", 50, 1e5, "", TO(JoxLiftDraft, load), .meaning = "greatest mass of its people; default: 100 kg for each of `capacity`"}, \
    {"lift", "speed", NUMBER, "m/s", 0.05, 20, "1.6", TO(JoxLiftDraft, lift.speed), .meaning = "greatest speed of the car"}, \
    {"lift", "acceleration", NUMBER, "m/s2", 0.05, 3, "0.8", TO(JoxLiftDraft, lift.acceleration), .meaning = "with which it starts and stops"}, \
    {"lift", "opening", NUMBER, "s", 0, 60, "2", TO(JoxLiftDraft, lift.opening), .meaning = "time in which the door opens"}, \
    {"lift", "closing", NUMBER, "s", 0, 60, "3", TO(JoxLiftDraft, lift.closing), .meaning = "time in which it closes; it opens again while somebody stands in it"}, \
    {"lift", "dwell", NUMBER, "s", 0, 600, "3", TO(JoxLiftDraft, lift.dwell), .meaning = "time for which it stays open at least; it waits for those who go in or out, but no longer than 8 s for one who does not get on"}, \
    {"lift", "home", TEXT, "", 0, 0, "", READ_TO(jox_key_read_stair_storey, JoxLiftDraft, home, home), .meaning = "storey where the car is at the start, and to which firemen take people; default: the lowest that it serves"}, \
    {"lift", "returns", BOOL, "", 0, 0, "true", TO(JoxLiftDraft, lift.returns), .meaning = "the car goes home when nobody has called it for 10 s"}, \
    {"lift", "mode", TEXT, "", 0, 0, "in_use", TO(JoxLiftDraft, lift.mode), .choices = JOX_LIFT_MODE_NAMES, .meaning = "`in_use`: it serves calls in its direction of travel before it turns; `out_of_use`: it lets its riders out at the next storey, and stands; `firemen`: it fetches those who wait storey by storey, the highest first, and takes them to `home`. Events change it"}, \
    {"lift", "first", TEXT, "", 0, 0, "", READ_TO(jox_key_read_stair_storey, JoxLiftDraft, first, first), .meaning = "storey from which firemen fetch people first, as that of a fire"},

#define JOX_LIFT_STEP_ROWS \
    {"step", "ride", TEXT, "", 0, 0, "", READ_TO(jox_key_read_ride, JoxJourneyStep, ride, ride), .example = "ride: east.first", \
     .meaning = "ride in a lift to the storey of this place (see [lifts](#lifts)); of a set, in the lift that takes least time. People who are not in the car when the lift goes out of use, or is left to firemen, go on to what comes next by themselves"}, \
    {"step", "firemen", BOOL, "", 0, 0, "false", TO(JoxJourneyStep, firemen), .meaning = "of a ride: people cannot use stairs, and wait until the lift is in use again or firemen fetch them"},

#define JOX_LIFT_EVENT_ROWS \
    {"event", "lift", TEXT, "", 0, 0, "", READ(jox_key_read_event_name), SELECTS(JOX_EVENT_LIFT), .meaning = "name of a lift, or `all` of them: it has this `mode` from then on"}, \
    {"event", "mode", TEXT, "", 0, 0, "in_use", TO(JoxEvent, mode), .choices = JOX_LIFT_MODE_NAMES, .meaning = "of a lift: see `mode` of [lifts](#lifts)"},

#define JOX_LIFT_OWNERS \
    {"lift", "Lifts", "`lifts` maps names to lifts, of a scene with `storeys`. Each has a shaft, with walls, a door on each storey that it serves, and one car. " \
     "Its floor on each of these storeys is a place, `LIFT.STOREY`: `ride \"east.first\"` in a behaviour and `ride: east.first` in a journey mean that lift and storey, " \
     "`inside`, `count` and probes take the place, and `open \"east.first\"` is true while the door is open there. " \
     "Who walks to such a place, as by `to: east.first`, arrives before the door, and calls no lift: `ride` does. A set of such places stands for the one that takes least time. " \
     "People whose way leads to another storey take lifts by themselves, over any chain of stairs, ramps and lifts (see the parameter `lifts`). " \
     "Bodies are not carried, except in hands. The last lines of a run, its summary and its report say how long people waited, and how full the car was.", \
     .struct_size = sizeof(JoxLiftDraft), .name_offset = AT(JoxLiftDraft, lift.name), .position_offset = AT(JoxLiftDraft, position), .finish = jox_finish_lift},
/* clang-format on */

#endif
