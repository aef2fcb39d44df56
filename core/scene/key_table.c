/* The table of the scene format, and of the mod.yaml of mods: a row for each key, and one for each
   kind of map that has keys (format/keys.h). Rows of JOX_STORE_EARLIER are read elsewhere:
   `include` by format/yaml_files.c, `mods` by mods_find.c, what a mod says about others by
   mods_read.c. */
#include "geom/place_kinds.h"
#include "scene/game_keys.h"
#include "scene/mod_key_rows.h"
#include "scene/report_key_rows.h"
#include "scene/scene_draft.h"
#include "scene/storey_key_rows.h"

#define FAR JOX_FARTHEST
#define NUMBER JOX_TYPE_NUMBER
#define WHOLE JOX_TYPE_WHOLE
#define BOOL JOX_TYPE_BOOL
#define TEXT JOX_TYPE_TEXT
#define POINT JOX_TYPE_POINT
#define POINT3 JOX_TYPE_POINT3
#define POINTS JOX_TYPE_POINTS
#define NAMES JOX_TYPE_NAMES
#define TABLE JOX_TYPE_TABLE
#define LIST JOX_TYPE_LIST
#define VALUES JOX_TYPE_VALUES
#define TO JOX_TO
#define OR(name) "|" #name
#define ITEMS JOX_TO_ITEMS
#define READ JOX_READ
#define READ_TO JOX_READ_TO
#define SAME_STRUCT JOX_SAME_STRUCT
#define IN_DRAFT(member) JOX_TO(JoxSceneDraft, member), .in_draft = true
#define EARLIER JOX_READ_EARLIER
#define CHECKED JOX_CHECKED
#define SELECTS JOX_SELECTS_KIND
#define RESTART(why) .restart_reason = why

/* Choices, "hex|grid|...", from the enumerations that they stand for. */
#define CHOICE(enumerator, name) "|" name
#define FILLS (&(JOX_FILLS(CHOICE))[1])
#define TOOLS (&(JOX_TOOLS(CHOICE))[1])
#define CLOTHES (&(JOX_CLOTHES(CHOICE))[1])
#define FLOORS (&(JOX_FLOORS(CHOICE))[1])
#define KIND(enumerator, name, form, x, y, z, meaning) "|" name
#define KIND_ROW(enumerator, name, form, x, y, z, meaning)                                         \
    "\n| `" name "` | " #x ", " #y ", " #z " | " meaning " |"
#define SCENERY (&(JOX_SCENERY_KINDS(KIND))[1])

/* Names of a report's files, which a probe must not have. */
#define REPORT_FILES                                                                               \
    "plan|density|density-greatest|load-greatest|pressure-greatest|snapshot-1|snapshot-2|"         \
    "snapshot-3|snapshot-4|leaving|levels|paths|regions|walls|spread|seeds|danger|danger-map|"     \
    "danger-limits|danger-people|danger-levels|danger-areas|danger-leaving|danger-lines|"          \
    "danger-walls|danger-sources"

/* Choices in the order of JoLost. */
#define LOST "end|remove|stop"

#define AT(Struct, member) (1 + offsetof(Struct, member))

/* Columns of a kind of probe, by the form of its value in JOX_PROBES. */
#define PROBE_LINE(name)                                                                           \
    POINTS, "m", -FAR, FAR, "", .content = "xy[2]",                                                \
                                READ_TO(jox_key_read_line, JoxProbeDef, points, count)
#define PROBE_LINES(name)                                                                          \
    LIST, "m", -FAR, FAR, "", .content = "xy[2][2]",                                               \
                              READ_TO(jox_key_read_lines, JoxProbeDef, points, count)
#define PROBE_RING(name)                                                                           \
    POINTS, "m", -FAR, FAR, "", .content = "xy[3]",                                                \
                                READ_TO(jox_key_read_ring, JoxProbeDef, points, count)
#define PROBE_POINT(name)                                                                          \
    POINT, "m", -FAR, FAR, "", .placed = true,                                                     \
                               READ_TO(jox_key_read_point, JoxProbeDef, points, count)
#define PROBE_FLAG(name) BOOL, "", 0, 0, "", READ(jox_key_read_true)
#define PROBE_SECONDS(name) NUMBER, "s", 0.01, 1e6, "", TO(JoxProbeDef, every)
#define PROBE_STATES(name) NAMES, "", 0, 0, "", READ(jox_key_read_states)
#define PROBE_TABLE(name) TABLE, "", 0, 0, "", .content = #name, SAME_STRUCT

/* clang-format off */
static const JoxKey KEYS[] = {
    {"scene", "jostle", WHOLE, "", 1, 1, "!", CHECKED, .meaning = "version of the format"},
    {"scene", "include", NAMES, "", 0, 0, "", EARLIER,
     .meaning = "scenes that give the keys this one lacks; maps are merged key by key, and a map in place of a list changes its items by their `name`"},
    {"scene", "title", TEXT, "", 0, 0, "", TO(JoxSceneSpec, title), .meaning = "title for people"},
    {"scene", "about", TEXT, "", 0, 0, "", TO(JoxSceneSpec, about), .meaning = "description in a sentence or two, for the first tab of the live page"},
    {"scene", "seed", WHOLE, "", 0, 9e15, "1", TO(JoxSceneSpec, seed), RESTART("all random numbers follow from it"), .meaning = "seed of all random numbers"},
    {"scene", "step", NUMBER, "s", 0.001, 0.2, "0.05", TO(JoxSceneSpec, step), RESTART("the run keeps its step"), .meaning = "time step"},
    {"scene", "duration", NUMBER, "s", 0, 1e6, "60", TO(JoxSceneSpec, duration),
     RESTART("a run keeps the end that it started with"), .meaning = "length of a run, unless an option gives another"},
    {"scene", "gravity", NUMBER, "m/s2", 0, 100, "9.81", TO(JoxSceneSpec, gravity), RESTART("bodies are made with it"), .meaning = "gravity on bodies, downwards"},
    {"scene", "bounds", POINTS, "m", -FAR, FAR, "", READ(jox_key_read_bounds), .content = "xy[2]",
     RESTART("agents are placed within them at the start"), .meaning = "two opposite corners; every agent must start between them"},
    {"scene", "periodic", TEXT, "", 0, 0, "none", READ(jox_key_read_periodic), .choices = "none|x|y|both",
     RESTART("the world is made with them"), .meaning = "axes along which opposite bounds are joined: people who leave at one edge come in at the other, and people and walls near an edge are perceived across it; bodies and signals do not cross"},
    {"scene", "input", TEXT, "", 0, 0, "", READ(jox_key_read_input),
     RESTART("a log is played from the first step on"), .meaning = "file of an input log to play (see input.md)"},
    {"scene", "mods", TABLE, "", 0, 0, "", EARLIER, .content = "quantity**",
     RESTART("they are found when the scene is loaded"), .meaning = "mods that the scene uses, each with values of its settings"},
    {"scene", "patch", TEXT, "", 0, 0, "", EARLIER, .meaning = "in a patch of a mod: the scene that it is merged into"},
    {"scene", "replace", TEXT, "", 0, 0, "", EARLIER, .meaning = "in a patch of a mod: the scene that it replaces"},
    {"scene", "forces", TABLE, "", 0, 0, "", SAME_STRUCT, .content = "forces", RESTART("the world is made with them"), .meaning = "how forces act"},
    {"scene", "walking", TABLE, "", 0, 0, "", TO(JoxSceneSpec, walking), .content = "walking", RESTART("the world is made with them"), .meaning = "constants of the walking law"},
    {"scene", "guard", TABLE, "", 0, 0, "", SAME_STRUCT, .content = "guard", .example = "guard: {people: remove, bodies: stop}",
     RESTART("the world is made with it"), .meaning = "what to do with people and bodies whose numbers become invalid"},
    {"scene", "limits", TABLE, "", 0, 0, "", TO(JoxSceneSpec, limits), .content = "limits", RESTART("behaviours are loaded under them"), .meaning = "limits on scripts"},
    {"scene", "report", TABLE, "", 0, 0, "", TO(JoxSceneSpec, report), .content = "report", .example = "report: {author: A. Engineer, project: Station hall}", .meaning = "who made a report, and for what: its title block"},
    JOX_STOREY_SCENE_ROWS
    {"scene", "heatmap", TABLE, "", 0, 0, "", SAME_STRUCT, .content = "heatmap",
     .meaning = "area and time of the density map"},
    {"scene", "camera", TABLE, "", 0, 0, "", TO(JoxSceneSpec, camera), .content = "camera",
     .meaning = "camera of the live page and of pictures"},
    {"scene", "view", TABLE, "", 0, 0, "", TO(JoxSceneSpec, view), .content = "view",
     .meaning = "what the live page shows at first, and the tools that it offers"},
    {"scene", "places", TABLE, "", 0, 0, "", ITEMS(JoxSceneSpec, places, place_count), .content = "place*",
     .meaning = "named points, lines and areas for behaviours and groups"},
    {"scene", "regions", TABLE, "", 0, 0, "", READ(jox_key_read_regions), .content = "xy[3]*",
     RESTART("they are measured from the start on"), .meaning = "polygons in which the mean speed is measured"},
    {"scene", "walls", LIST, "", 0, 0, "", READ(jox_key_read_walls), .content = "wall[]", .meaning = "walls: they never move, but can be opened"},
    {"scene", "bodies", LIST, "", 0, 0, "", READ(jox_key_read_bodies), .content = "body[]",
     RESTART("they are made at the start"), .meaning = "rigid bodies, which can be pushed, kicked and thrown, and fall"},
    {"scene", "groups", TABLE, "", 0, 0, "", ITEMS(JoxSceneSpec, groups, group_count), .content = "group*", .meaning = "groups of agents with the same properties"},
    {"scene", "sources", LIST, "", 0, 0, "", ITEMS(JoxSceneSpec, sources, source_count), .content = "source[]", .meaning = "where agents come in"},
    {"scene", "sinks", LIST, "", 0, 0, "", ITEMS(JoxSceneSpec, sinks, sink_count), .content = "sink[]", .meaning = "where agents leave"},
    {"scene", "player", TEXT, "", 0, 0, "", READ_TO(jox_key_read_group, JoxSceneSpec, player_group, player_group),
     .meaning = "group whose first agent the user drives"},
    {"scene", "probes", TABLE, "", 0, 0, "", ITEMS(JoxSceneSpec, probes, probe_count), .example = "probes: {door: {flow: [[0, 0], [1, 0]]}}", .content = "probe*", RESTART("they measure from the start on"), .meaning = "probes: what to measure"},
    {"scene", "criteria", TABLE, "", 0, 0, "", ITEMS(JoxSceneSpec, criteria, criterion_count), .example = "criteria: {out in time: {cleared: 120}}", .content = "criterion*", RESTART("they are measured from the start on"), .meaning = "limits that the run is held against: pass or fail"},
    {"scene", "events", LIST, "", 0, 0, "", ITEMS(JoxSceneSpec, events, event_count), .example = "events: [{at: 20, open: gate}]", .content = "event[]", .meaning = "what happens at given times"},
    {"scene", "tally", TABLE, "", 0, 0, "", ITEMS(JoxSceneSpec, tallies, tally_count), .example = "tally: {red: {memory: hits, group: blue}}", .content = "tally*", .meaning = "scores, printed in the last lines of a run"},
    {"scene", "game", TABLE, "", 0, 0, "", TO(JoxSceneSpec, game), .content = "game", .example = "game: {ours: red, theirs: blue, points: 5}", RESTART("a round keeps its rules"), .meaning = "a game of the `player` against the machine"},

    {"scene", "floor", TEXT, "", 0, 0, "plain", TO(JoxSceneSpec, floor), .choices = FLOORS, .meaning = "material of the floor on the live page and in pictures"},
    {"scene", "scenery", LIST, "", 0, 0, "", ITEMS(JoxSceneSpec, scenery, scenery_count), .example = "scenery: [{kind: tree, at: [2, 3]}]", .content = "scenery[]", .meaning = "things that the live page and `jostle render` draw around people; no obstacles"},

    JOX_REPORT_KEY_ROWS
    {"forces", "enabled", BOOL, "", 0, 0, "true", TO(JoxSceneSpec, forces), .meaning = "false: collision avoidance alone"},
    {"forces", "mode", TEXT, "", 0, 0, "physical", TO(JoxSceneSpec, literal), .choices = "physical|literal",
     .meaning = "literal: the equations as they were printed (core/paper.md); parameters that they do not have are noted, as they then have no effect"},
#define X(name, unit, least, greatest, value, meant) \
    {"walking", #name, NUMBER, unit, least, greatest, #value, TO(JoxWalkLaw, name), .meaning = meant},
    JOX_WALK_CONSTANTS(X)
#undef X
    {"guard", "people", TEXT, "", 0, 0, "end", TO(JoxSceneSpec, lost_people), .choices = LOST, .meaning = "reaction to a person with a number that is not finite, or farther than 10 km from the origin"},
    {"guard", "bodies", TEXT, "", 0, 0, "remove", TO(JoxSceneSpec, lost_bodies), .choices = LOST, .meaning = "reaction to such a body, or one that falls through the ground or passes a wall"},
    {"limits", "instructions", WHOLE, "", 1000, 1e9, "100000", TO(JoxSceneLimits, instructions), .meaning = "instructions of one call of a Lua function"},
    {"limits", "step_instructions", WHOLE, "", 10000, 1e12, "20000000", TO(JoxSceneLimits, step_instructions), .meaning = "instructions of all functions of a behaviour in a step"},
    {"limits", "load_instructions", WHOLE, "", 10000, 1e9, "20000000", TO(JoxSceneLimits, load_instructions), .meaning = "instructions for loading one behaviour"},
    {"limits", "memory", NUMBER, "MB", 1, 1024, "32", TO(JoxSceneLimits, memory), .meaning = "memory of one behaviour"},
    {"limits", "block", NUMBER, "MB", 0.1, 1024, "2", TO(JoxSceneLimits, block), .meaning = "memory of one text or table of a behaviour"},
    {"limits", "source", NUMBER, "KB", 1, 16384, "256", TO(JoxSceneLimits, source), .meaning = "size of one Lua file"},
    {"limits", "print", WHOLE, "", 0, 1000, "20", TO(JoxSceneLimits, print), .meaning = "lines that a behaviour may print in a second"},
    {"heatmap", "area", POINTS, "m", -FAR, FAR, "", READ(jox_key_read_heatmap_area), .content = "xy[2]", .meaning = "two opposite corners"},
    {"heatmap", "from", NUMBER, "s", 0, 1e6, "0", TO(JoxSceneSpec, heatmap_from), .meaning = "start of averaging"},
    {"camera", "position", POINT3, "m", -FAR, FAR, "", TO(JoxSceneCamera, position), .meaning = "position of the camera"},
    {"camera", "target", POINT3, "m", -FAR, FAR, "", TO(JoxSceneCamera, target), .meaning = "point that it looks at"},
    {"view", "tools", NAMES, "", 0, 0, "throw|drag|push|gates|parameters|signals|player", TO(JoxSceneView, tools), .choices = TOOLS,
     .meaning = "tools for the user: throw boxes, drag bodies, push people, open and close gates, change parameters of behaviours, give signals, drive the player"},
    {"view", "colour", TEXT, "", 0, 0, "auto", TO(JoxSceneView, colour), .choices = "auto" JOX_SCENE_COLOURS(OR),
     .meaning = "quantity that people are coloured by, as in pictures of `jostle render`; direction: of walking; service: levels of service A to F; auto: their state, "
                "if behaviours have three to eight in all; else their group, if there are two to eight; else their state, if there are more; else their speed"},
    {"view", "field", TEXT, "", 0, 0, "none", TO(JoxSceneView, field), .choices = "density|pressure|none",
     .meaning = "field shown on the floor"},

    {"scenery", "kind", TEXT, "", 0, 0, "!", TO(JoxScenery, kind), .choices = SCENERY, .meaning = "what it is; a table below has their sizes"},
    {"scenery", "at", POINTS, "m", -FAR, FAR, "", .placed = true, READ_TO(jox_key_read_scenery_at, JoxScenery, at, at_count), .content = "spots", .meaning = "its centre, or those of several copies; with `body`: from the body's own centre"},
    {"scenery", "through", POINTS, "m", -FAR, FAR, "", READ_TO(jox_key_read_points, JoxScenery, through, through_count), .content = "xy[2]", .meaning = "points of a line, parapet, fence or hedge, and corners of an area"},
    {"scenery", "turn", NUMBER, "deg", -1e4, 1e4, "0", TO(JoxScenery, turn), .meaning = "rotation about the vertical axis, anti-clockwise"},
    {"scenery", "faces", POINT, "m", -FAR, FAR, "", .placed = true, READ_TO(jox_key_read_point, JoxScenery, faces, face_count), .meaning = "point that the front of each copy looks at, before it is turned by `turn`"},
    {"scenery", "size", POINT3, "m", 0, 1000, "", TO(JoxScenery, size), .meaning = "its own lengths along x, y and z; of what goes through points, y is the width. 0 and no size: those of its kind"},
    {"scenery", "colour", TEXT, "", 0, 0, "", READ_TO(jox_key_read_colour, JoxScenery, colour, colour), .meaning = "colour in place of that of its kind: " JOX_COLOUR_RULE},
    {"scenery", "doors", LIST, "m", -500, 500, "", READ(jox_key_read_doors), .content = "quantity[1]", .example = "doors: [-4, 4]", .meaning = "of a train: where along it its doors are, from its middle; each is 1.4 m wide. Default: four at even distances"},
    {"scenery", "body", TEXT, "", 0, 0, "", READ_TO(jox_key_read_name, JoxScenery, body, body), .meaning = "body that carries it, as a train that moves"},

    {"place", "point", POINT, "m", -FAR, FAR, "", .placed = true, READ(jox_key_read_place_points), SELECTS(JOX_PLACE_POINT), .meaning = "its centre"},
    {"place", "radius", NUMBER, "m", 0.01, 1000, "0.5", TO(JoxPlace, radius), .meaning = "of a point: radius of its inside"},
    {"place", "line", POINTS, "m", -FAR, FAR, "", READ(jox_key_read_place_points), SELECTS(JOX_PLACE_LINE), .content = "xy[2]",
     .meaning = "two points; it is crossed from its right to its left"},
    {"place", "polygon", POINTS, "m", -FAR, FAR, "", READ(jox_key_read_place_points), SELECTS(JOX_PLACE_POLYGON), .content = "xy[3]",
     .meaning = "corners in order; no edge crosses another"},
    {"place", "start", TEXT, "", 0, 0, "", READ(jox_key_read_place_start), .meaning = "of a polygon: the line from which circuits around it are counted"},
    {"place", "queue", POINTS, "m", -FAR, FAR, "", READ(jox_key_read_place_points), SELECTS(JOX_PLACE_QUEUE), .content = "xy[2]",
     .meaning = "points of a polyline, beginning at its head"},
    {"place", "spacing", NUMBER, "m", 0.1, 10, "0.5", TO(JoxPlace, spacing), .meaning = "of a queue: length for one person"},
    {"place", "refuge", BOOL, "", 0, 0, "false", TO(JoxPlace, refuge), .example = "refuge: true", .meaning = "people who cannot use stairs (`set: {lifts: only}`) wait here while no lift takes them; they go to the nearest refuge of their storey"},
    {"place", "set", NAMES, "", 0, 0, "", READ(jox_key_read_place_points), SELECTS(JOX_PLACE_SET), .meaning = "names of other places, but not of sets"},

    {"wall", "solid", POINTS, "m", -FAR, FAR, "", READ(jox_key_read_wall_points), SELECTS(JOX_WALL_SOLID), .content = "xy[3]",
     .meaning = "corners of a filled block"},
    {"wall", "line", POINTS, "m", -FAR, FAR, "", READ(jox_key_read_wall_points), SELECTS(JOX_WALL_LINE), .content = "xy[2]", .meaning = "points of a thin wall"},
    {"wall", "file", TEXT, "", 0, 0, "", READ(jox_key_read_wall_file), SELECTS(JOX_WALL_FILE),
     .meaning = "file beside the scene: walls as well-known text (WKT), as a geometry of JuPedSim (XML), or the plan of a recording (SQLite); recordings by Jostle have solid walls and the bounds only"},
    {"wall", "unit", NUMBER, "m", 1e-4, 1000, "1", TO(JoxWallDraft, unit), .meaning = "of a file: its unit of length"},
    {"wall", "origin", POINT, "", -1e12, 1e12, "", TO(JoxWallDraft, origin),
     .meaning = "of a file: the point, in its unit, that becomes [0, 0]"},
    {"wall", "closed", BOOL, "", 0, 0, "false", TO(JoxWallDraft, closed), .meaning = "of a line: its ends are joined"},
    {"wall", "height", NUMBER, "m", 0.01, 1000, "3", TO(JoxWallDraft, height),
     .meaning = "bodies can fly over the wall above this height; people never pass it"},
    {"wall", "drawn", NUMBER, "m", 0.01, 1000, "", TO(JoxWallDraft, drawn), .meaning = "height up to which the live page draws it, in place of its height: a low one where scenery stands in its place"},
    {"wall", "name", TEXT, "", 0, 0, "", READ_TO(jox_key_read_name, JoxWallDraft, name, name), .meaning = "name by which events open and close it; several walls may share it"},
    {"wall", "open", BOOL, "", 0, 0, "false", TO(JoxWallDraft, open), .meaning = "the wall is open, that is absent, until it is closed"},

    {"body", "name", TEXT, "", 0, 0, "", READ_TO(jox_key_read_name, JoxBodyDraft, body.def.name, body.def.name), .meaning = "name, for events and messages"},
    {"body", "shape", TABLE, "", 0, 0, "!", TO(JoxBodyDraft, body.def.shape), .content = "shape",
     .meaning = "one of box, sphere, cylinder, hull, compound, blocks"},
    {"body", "mass", NUMBER, "kg", 0, 1e7, "", TO(JoxBodyDraft, mass), .meaning = "0: it never moves; default 10 kg if no density is given, and the sum of the parts of a compound"},
    {"body", "density", NUMBER, "kg/m3", 0.1, 30000, "", TO(JoxBodyDraft, density), .meaning = "in place of mass"},
    {"body", "at", POINT3, "m", -FAR, FAR, "!", .placed = true, TO(JoxBodyDraft, body.def.position), .meaning = "centre of the shape"},
    {"body", "turn", NUMBER, "deg", -1e4, 1e4, "0", READ_TO(jox_key_read_turn, JoxBodyDraft, body.def.turn, body.def.turn),
     .meaning = "rotation about the vertical axis, anti-clockwise"},
    {"body", "velocity", POINT3, "m/s", -100, 100, "", TO(JoxBodyDraft, body.def.velocity), .meaning = "velocity at the start; of a kinematic body: for ever"},
    {"body", "spin", POINT3, "rad/s", -100, 100, "", TO(JoxBodyDraft, body.def.spin), .meaning = "angular velocity about the axes x, y and z, likewise"},
    {"body", "kinematic", BOOL, "", 0, 0, "false", TO(JoxBodyDraft, body.def.kinematic),
     .meaning = "for doors, trains, lifts: it has no mass and moves by its velocity and spin or along its `path`; it pushes bodies, and people up to its `force_limit`, and nothing pushes it"},
    {"body", "path", TABLE, "", 0, 0, "", SAME_STRUCT, .content = "path", .meaning = "of a kinematic body: path that it moves along, from `at`"},
    {"body", "force_limit", NUMBER, "N", 1, 1e6, "6227", TO(JoxBodyDraft, body.def.force_limit),
     .meaning = "of a kinematic body: greatest total force on the people that it moves towards. At the limit it moves as fast as they give way, or stops and presses with this force, and goes on when they bear less; the rest of its path is delayed. The default is the load estimated to kill one person within 15 s (Hopkins et al. 1993, in Lee and Hughes 2006)"},
    {"body", "at_limit", TEXT, "", 0, 0, "yield", TO(JoxBodyDraft, body.def.ends_run), .choices = "yield|end",
     .meaning = "of a kinematic body at its force limit: it yields, or the run ends, with status 1, and says whom it presses"},
    {"body", "friction", NUMBER, "", 0, 10, "0.6", TO(JoxBodyDraft, body.def.friction), .meaning = "coefficient of friction, multiplied by that of the other body"},
    {"body", "restitution", NUMBER, "", 0, 1, "0", TO(JoxBodyDraft, body.def.restitution), .meaning = "coefficient of restitution, multiplied by that of the other body"},
    {"body", "damping", NUMBER, "", 0, 1, "0", TO(JoxBodyDraft, body.def.damping),
     .meaning = "share of the velocity lost in a second"},
    {"body", "repeat", TABLE, "", 0, 0, "", SAME_STRUCT, .content = "repeat",
     .meaning = "copies of the body on a lattice; a scene has at most 200,000 bodies, counting their blocks and parts"},
    {"body", "tags", NAMES, "", 0, 0, "", READ_TO(jox_key_read_tags, JoxBodyDraft, body.tags, body.tag_count), .meaning = "tags by which behaviours find it"},
    {"repeat", "count", POINT3, "", 1, 4096, "!", READ(jox_key_read_copies), .meaning = "number of bodies along x, y and z; at most 4096 in all"},
    {"repeat", "step", POINT3, "m", -FAR, FAR, "!", TO(JoxBodyDraft, distance), .meaning = "distance from one to the next along x, y and z"},
    {"path", "through", LIST, "m", -FAR, FAR, "!", .placed = true, READ(jox_key_read_path), .content = "xyz[1]", .meaning = "points that the centre of the shape comes to, in straight lines; at most 255"},
    {"path", "speed", NUMBER, "m/s", 0.001, 100, "!", TO(JoxBodyDraft, body.def.path.speed), .meaning = "speed along the path"},
    {"path", "after", NUMBER, "s", 0, 1e6, "0", TO(JoxBodyDraft, body.def.path.after), .meaning = "time until it starts"},
    {"path", "wait", NUMBER, "s", 0, 1e6, "0", TO(JoxBodyDraft, body.def.path.wait), .meaning = "time that it waits at each point"},
    {"path", "force_limit", NUMBER, "N", 1, 1e6, "", TO(JoxBodyDraft, path_force), .meaning = "in place of the body's (doors of trains: 150 N)"},
    {"path", "reopens", BOOL, "", 0, 0, "false", TO(JoxBodyDraft, body.def.path.reopens), .meaning = "at its force limit it goes back to the point that it came from, waits there again, and starts once more"},
    {"path", "end", TEXT, "", 0, 0, "stay", TO(JoxBodyDraft, body.def.path.end), .choices = "stay|back|round",
     .meaning = "at the last point: it stays, goes back and forth for ever, or goes on to the first point and round for ever"},
    {"shape", "box", TABLE, "", 0, 0, "", SAME_STRUCT, SELECTS(JOX_SHAPE_BOX), .content = "box", .meaning = "a cuboid"},
    {"shape", "sphere", TABLE, "", 0, 0, "", SAME_STRUCT, SELECTS(JOX_SHAPE_SPHERE), .content = "sphere", .meaning = "a ball"},
    {"shape", "cylinder", TABLE, "", 0, 0, "", SAME_STRUCT, SELECTS(JOX_SHAPE_CYLINDER), .content = "cylinder",
     .meaning = "a cylinder, upright at the start"},
    {"shape", "hull", TABLE, "", 0, 0, "", SAME_STRUCT, SELECTS(JOX_SHAPE_HULL), .content = "hull",
     .meaning = "convex hull of some points"},
    {"shape", "compound", LIST, "", 0, 0, "", ITEMS(JoxShape, parts, part_count), SELECTS(JOX_SHAPE_COMPOUND), .content = "part[1]",
     .meaning = "shapes joined to one body"},
    {"shape", "blocks", TABLE, "", 0, 0, "", SAME_STRUCT, SELECTS(JOX_SHAPE_BLOCKS), .content = "blocks",
     .meaning = "cuboids glued to one body, which breaks where the load on the glue is too great"},
    {"box", "size", POINT3, "m", 0.01, 1000, "!", TO(JoxShape, size), .meaning = "lengths along x, y and z"},
    {"sphere", "radius", NUMBER, "m", 0.01, 100, "!", TO(JoxShape, size[0]), .meaning = "radius of the ball"},
    {"cylinder", "radius", NUMBER, "m", 0.01, 100, "!", TO(JoxShape, size[0]), .meaning = "radius of the cylinder"},
    {"cylinder", "height", NUMBER, "m", 0.01, 100, "!", TO(JoxShape, size[1]), .meaning = "whole height"},
    {"hull", "points", LIST, "m", -1000, 1000, "!", READ(jox_key_read_hull), .content = "xyz[4]", .meaning = "4 to 256 points, relative to the centre of the body"},
    {"blocks", "size", POINT3, "m", 0.01, 1000, "!", TO(JoxShape, size), .meaning = "lengths of one block along x, y and z"},
    {"blocks", "count", POINT3, "", 1, 4096, "!", READ(jox_key_read_block_count), .meaning = "number of blocks along x, y and z; at most 4096 in all"},
    {"blocks", "bond", NUMBER, "N", 0.001, 1e9, "!", TO(JoxShape, bond), .meaning = "force that breaks the glue between two blocks: tension and shear together; pressure never does"},
    {"blocks", "block_mass", NUMBER, "kg", 0.001, 1e6, "", IN_DRAFT(block_mass), .meaning = "mass of one block, in place of the body's mass"},
    {"part", "shape", TABLE, "", 0, 0, "!", READ(jox_key_read_part_shape), .content = "shape",
     .meaning = "as of a body, but neither a compound nor blocks"},
    {"part", "at", POINT3, "m", -FAR, FAR, "", TO(JoxBodyPart, position), .meaning = "position in the body's frame"},
    {"part", "mass", NUMBER, "kg", 0.001, 1e7, "1", TO(JoxBodyPart, mass), .meaning = "mass of this part; where the body has a mass too, the parts share it in proportion to theirs"},

    {"group", "behaviour", TEXT, "", 0, 0, "", READ(jox_key_read_behaviour),
     .meaning = "a Lua file: beside the scene, in ../behaviours, or installed"},
    {"group", "mix", VALUES, "", 0, 0, "", READ(jox_key_read_mix), .content = "weight*",
     .meaning = "several behaviours, each with its weight"},
    {"group", "journey", LIST, "", 0, 0, "", ITEMS(JoxGroup, journey, journey_count), .content = "step[1]",
     .example = "journey: [{to: hall, wait: 5}, {exit: door}]", RESTART("behaviours are loaded at the start"),
     .meaning = "in place of a behaviour: steps that people do one after another"},
    {"group", "profiles", TABLE, "", 0, 0, "", ITEMS(JoxGroup, profiles, profile_count), .content = "profile*",
     .example = "profiles: {adult: {share: 0.9}, child: {share: 0.1, set: {radius: 0.15}}}",
     .meaning = "kinds of people, each with its share; each person is of one kind"},
    {"group", "count", WHOLE, "", 0, 1000000, "", TO(JoxGroup, count), .meaning = "number of agents at the start; 0 if sources bring them"},
    {"group", "density", NUMBER, "1/m2", 0.001, 20, "", IN_DRAFT(fill.density),
     .meaning = "in place of count: agents for each square metre of floor in the places, without solid walls; they stand 0.2 m from walls"},
    {"group", "at", POINTS, "m", -FAR, FAR, "", READ_TO(jox_key_read_points, JoxGroup, positions, count), .content = "xy[1]",
     .meaning = "in place of count: one agent at each point"},
    {"group", "starts", LIST, "", 0, 0, "", READ(jox_key_read_starts), .content = "start[1]",
     .example = "starts: [[0, 1, 2], [4.5, 1, 2, 1.3, 0]]",
     .meaning = "in place of count, as in a recording: for each agent [s, x, y] or [s, x, y, vx, vy], the time, position and velocity at which it comes in; at 0 it is there from the beginning, and it waits while another agent stands there"},
    {"group", "fill", TEXT, "", 0, 0, "random", TO(JoxGroup, fill), .choices = FILLS,
     .meaning = "arrangement of the agents; circle: around one point, at its radius; line: evenly along one line"},
    {"group", "in", NAMES, "", 0, 0, "", READ_TO(jox_key_read_fills, JoxSceneDraft, fill.in, fill.in_count), .in_draft = true, .meaning = "places to fill; needed with count or density"},
    {"group", "outside", NAMES, "", 0, 0, "", READ_TO(jox_key_read_fills, JoxSceneDraft, fill.outside, fill.outside_count), .in_draft = true, .meaning = "places to keep out of"},
    {"group", "spacing", NUMBER, "m", 0.05, 100, "", IN_DRAFT(fill.spacing), .meaning = "least distance between agents"},
    {"group", "facing", NUMBER, "deg", -1e4, 1e4, "", READ_TO(jox_key_read_facing, JoxGroup, facing, facing), .meaning = "direction that they face and to which their chests point, anti-clockwise from +x"},
    {"group", "party", WHOLE, "", 1, 1000, "1", TO(JoxGroup, party),
     .meaning = "size of parties: so many consecutive agents keep together, each party as a team of its own"},
    {"group", "team", TEXT, "", 0, 0, "", READ_TO(jox_key_read_name, JoxGroup, team, team), .meaning = "name of their team; agents of other teams are opponents"},
    {"group", "tags", NAMES, "", 0, 0, "", READ_TO(jox_key_read_tags, JoxGroup, tags, tag_count), .meaning = "tags by which behaviours find them"},
    {"group", "colour", TEXT, "", 0, 0, "", READ_TO(jox_key_read_colour, JoxGroup, colour, colour),
     .meaning = "colour of its people if people are coloured by group, else one is chosen: " JOX_COLOUR_RULE},
    {"group", "clothes", TEXT, "", 0, 0, "casual", TO(JoxGroup, clothes), .choices = CLOTHES, .example = "clothes: sport",
     .meaning = "what its people wear on the live page; ihram: the white cloths of pilgrims, sport: shirt and shorts, work: overalls and a helmet. The top has the colour that they are shown in"},
    {"group", "set", VALUES, "", 0, 0, "", READ_TO(jox_key_read_values, JoxGroup, set, set_count), .content = "value*",
     .meaning = "values of names in the behaviour's `defaults`; `antipode`: the opposite point of the circle"},
    {"group", "memory", VALUES, "", 0, 0, "", READ_TO(jox_key_read_values, JoxGroup, memory, memory_count), .content = "draw*",
     .meaning = "values of their memory at the start"},

    JOX_BASIS_KEY_ROW
    {"profile", "share", NUMBER, "", 1e-6, 1e6, "1", TO(JoxProfile, share), .meaning = "weight among the profiles of the group"},
    {"profile", "set", VALUES, "", 0, 0, "", READ_TO(jox_key_read_values, JoxProfile, set, set_count), .content = "value*",
     .meaning = "values in place of those that the group sets"},

    {"step", "to", TEXT, "", 0, 0, "", READ_TO(jox_key_read_place, JoxJourneyStep, to, to),
     .meaning = "place to walk to, by the quickest way; of a set, the member that is reached first. People who wait in a polygon move up to its front while there is room, and stand 0.9 m from others, or closer, down to 0.51 m, if there are many; people who find no room wait behind it"},
    {"step", "front", TEXT, "", 0, 0, "", READ_TO(jox_key_read_place, JoxJourneyStep, front, front), .example = "front: stage",
     .meaning = "place that people look at while they wait, and towards which they fill a polygon. Default: the side of the polygon away from where they come from, which is the place of the step before, or where they start"},
    {"step", "queue", NAMES, "", 0, 0, "", READ(jox_key_read_queues),
     .meaning = "queues, of which each person chooses one: the one that seems to take the least time, including the way there, judged with an error of up to 2 s"},
    {"step", "service", TEXT, "", 0, 0, "", READ_TO(jox_key_read_duration, JoxJourneyStep, service, service), .content = "draw", .example = "service: uniform(2, 4)",
     .meaning = "time at the head of the queue, in s: a number or a distribution"},
    {"step", "wait", TEXT, "", 0, 0, "", READ_TO(jox_key_read_duration, JoxJourneyStep, wait, wait), .content = "draw", .example = "wait: 5 s",
     .meaning = "time to stand, in s: a number or a distribution"},
    {"step", "until", TEXT, "", 0, 0, "", TO(JoxJourneyStep, until), .meaning = "stand until this signal is given, by an event or by somebody near; it counts on the way there, too, on foot or in the ride before"},
    {"step", "open", TEXT, "", 0, 0, "", READ_TO(jox_key_read_gate, JoxJourneyStep, gate, gate), .meaning = "stand until the walls of this name are open"},
    JOX_LIFT_STEP_ROWS
    {"step", "exit", TEXT, "", 0, 0, "", READ_TO(jox_key_read_place, JoxJourneyStep, exit, exit), .meaning = "place to walk to and to leave by; not through a wall or a closed gate"},
    {"step", "share", NUMBER, "", 0, 1, "1", TO(JoxJourneyStep, share), .meaning = "share of people who do this step; the others go on to the next"},

    {"source", "at", TEXT, "", 0, 0, "!", READ_TO(jox_key_read_place, JoxAgentSource, place, place), .meaning = "place where agents appear; of a set, each at one of its members"},
    {"source", "like", TEXT, "", 0, 0, "!", READ_TO(jox_key_read_group, JoxAgentSource, like, like), .meaning = "group that the agents belong to"},
    {"source", "rate", NUMBER, "1/s", 0, 1000, "0", TO(JoxAgentSource, rate), .meaning = "agents a second, on average"},
    {"source", "even", BOOL, "", 0, 0, "false", TO(JoxAgentSource, even), .meaning = "agents come by `rate` and `curve` at even intervals, equally many for each seed; else at times drawn by the seed"},
    {"source", "people", WHOLE, "", 0, 100000, "0", TO(JoxAgentSource, people),
     .meaning = "agents that come together at each of the times of `every` and `times`; 1 if not given"},
    {"source", "every", NUMBER, "s", 0.01, 1e6, "", TO(JoxAgentSource, every), .meaning = "interval between such times, beginning with `from`"},
    {"source", "times", LIST, "s", 0, 1e6, "", READ(jox_key_read_times), .content = "quantity[1]", .example = "times: [10 s, 75 s, 3 min]",
     .meaning = "a timetable of such times"},
    {"source", "curve", LIST, "", 0, 0, "", READ(jox_key_read_curve), .content = "quantity[2][2]", .example = "curve: [[0, 0], [60, 2], [300, 0]]",
     .meaning = "[s, agents a second] at some times; linear between them, 0 before and after"},
    {"source", "keep", WHOLE, "", 0, 1000000, "0", TO(JoxAgentSource, keep),
     .meaning = "tops the group up to this number, once a second"},
    {"source", "from", NUMBER, "s", 0, 1e9, "0", TO(JoxAgentSource, from), .meaning = "nobody comes before this time"},
    {"source", "until", NUMBER, "s", 0, 1e9, "1e9", TO(JoxAgentSource, until), .meaning = "nobody comes from this time on, not even people who wait"},
    {"source", "memory", VALUES, "", 0, 0, "", READ_TO(jox_key_read_values, JoxAgentSource, memory, memory_count), .content = "draw*",
     .meaning = "values of memory, in place of those that the group gives"},

    {"sink", "at", TEXT, "", 0, 0, "!", READ_TO(jox_key_read_place, JoxAgentSink, place, place), .meaning = "place; agents that enter it are removed, but not through a wall or a closed gate"},
    {"sink", "group", TEXT, "", 0, 0, "", READ_TO(jox_key_read_group, JoxAgentSink, group, group), .meaning = "only agents of this group"},
    JOX_TALLY_KEYS
    JOX_GAME_KEYS

#define X(kind, name, form, options, example_, meaning_) \
    {"probe", #name, PROBE_##form(name), SELECTS(JOX_PROBE_##kind), .meaning = meaning_},
    JOX_PROBES(X)
#undef X
    {"probe", "group", NAMES, "", 0, 0, "", READ_TO(jox_key_read_groups, JoxProbeDef, groups, group_count), .meaning = "only people of these groups are measured"},
    {"probe", "from", NUMBER, "s", 0, 1e9, "0", TO(JoxProbeDef, from), .meaning = "nothing is measured before this time"},
    {"probe", "until", NUMBER, "s", 0, 1e9, "1e9", TO(JoxProbeDef, until), .meaning = "nothing is measured from this time on"},
    {"probe", "every", NUMBER, "s", 0.01, 1e6, "1", TO(JoxProbeDef, every),
     .meaning = "of measure and oscillation: length of an interval; of map and lanes: time between samples"},
    {"probe", "cutoff", NUMBER, "m", 0.1, 100, "1", TO(JoxProbeDef, cutoff),
     .meaning = "of measure: greatest radius of a Voronoi cell; walls bound it, too"},
    {"probe", "during", POINTS, "m", -FAR, FAR, "", .content = "xy[2]", READ_TO(jox_key_read_line, JoxProbeDef, during, during_count),
     .meaning = "of measure: a line; figures are taken over the intervals in which the middle 60 % of the passages across it were made"},
    {"probe", "onset", NUMBER, "m", 0.001, 100, "0.05", TO(JoxProbeDef, onset),
     .meaning = "of displacement and bodies: people or bodies farther than this have moved"},
    {"probe", "rest", NUMBER, "s", 0, 1e6, "0", TO(JoxProbeDef, rest),
     .meaning = "of displacement: it is measured from the mean position during so many seconds at the start"},
    {"probe", "along", POINT, "", -FAR, FAR, "", READ_TO(jox_key_read_point, JoxProbeDef, points, count),
     .meaning = "of displacement: a direction; only the component along it counts"},
    {"map", "area", POINTS, "m", -FAR, FAR, "", READ_TO(jox_key_read_box, JoxProbeDef, low, high), .content = "xy[2]",
     .meaning = "two opposite corners; default: all of the scene"},
    {"map", "cell", NUMBER, "m", 0.02, 100, "0.2", TO(JoxProbeDef, cell), .meaning = "width of the grid's cells"},
    {"map", "kernel", NUMBER, "m", 0.05, 50, "0.70710678", TO(JoxProbeDef, kernel),
     .meaning = "standard deviation of the Gaussian by which people are spread; the default is that of all other densities: R / sqrt 2, R = 1 m"},
    {"map", "through_walls", BOOL, "", 0, 0, "false", TO(JoxProbeDef, through_walls),
     .meaning = "the Gaussian passes through walls: people behind a wall count, too"},
    {"lanes", "area", POINTS, "m", -FAR, FAR, "!", READ_TO(jox_key_read_box, JoxProbeDef, low, high), .content = "xy[2]",
     .meaning = "two opposite corners"},
    {"lanes", "rows", NUMBER, "m", 0.05, 100, "0.4", TO(JoxProbeDef, rows), .meaning = "width of the rows"},
    {"lanes", "along", TEXT, "", 0, 0, "x", TO(JoxProbeDef, along_y), .choices = "x|y", .meaning = "axis that people walk along"},
    {"oscillation", "area", POINTS, "m", -FAR, FAR, "!", READ_TO(jox_key_read_box, JoxProbeDef, low, high), .content = "xy[2]",
     .meaning = "two opposite corners; divided into windows, beginning at the first"},
    {"oscillation", "window", NUMBER, "m", 0.1, 100, "1.5", TO(JoxProbeDef, window), .meaning = "width of the windows"},
    {"oscillation", "span", NUMBER, "s", 1, 1e5, "120", TO(JoxProbeDef, span),
     .meaning = "length of the time series whose spectra are averaged; frequencies are 2 pi / span apart"},
    {"event", "at", NUMBER, "s", 0, 1e6, "!", TO(JoxEvent, at), .meaning = "time; the event takes effect in the step that begins then"},
    {"event", "every", NUMBER, "s", 0.01, 1e6, "", TO(JoxEvent, every), .meaning = "interval at which it is repeated"},
    {"event", "until", NUMBER, "s", 0, 1e9, "1e9", TO(JoxEvent, until), .meaning = "of a repeated event: it does not happen after this time"},
    {"event", "throw", TEXT, "", 0, 0, "", READ(jox_key_read_event_name), SELECTS(JOX_EVENT_THROW), .meaning = "name of a body to throw; an agent that carries it lets it go"},
    {"event", "move", TEXT, "", 0, 0, "", READ(jox_key_read_event_name), SELECTS(JOX_EVENT_MOVE), .meaning = "name of a kinematic body: it leaves its path, and has this `velocity` and `spin` from then on"},
    {"event", "from", POINT3, "m", -FAR, FAR, "", .placed = true, TO(JoxEvent, from), .meaning = "of a throw: position from which the body is thrown; default: where it is"},
    {"event", "velocity", POINT3, "m/s", -100, 100, "", TO(JoxEvent, velocity), .meaning = "velocity of a throw or a move"},
    {"event", "spin", POINT3, "rad/s", -100, 100, "", TO(JoxEvent, spin), .meaning = "angular velocity of a throw or a move, about the axes x, y and z"},
    {"event", "open", TEXT, "", 0, 0, "", READ(jox_key_read_event_name), SELECTS(JOX_EVENT_OPEN), .meaning = "opens the walls of this name: they are absent from then on; or the stair of this name"},
    {"event", "close", TEXT, "", 0, 0, "", READ(jox_key_read_event_name), SELECTS(JOX_EVENT_CLOSE), .meaning = "closes the walls of this name: people who stand there are moved out; or the stair of this name: nobody sets out over it, and who is on it goes on"},
    {"event", "push", TEXT, "", 0, 0, "", READ(jox_key_read_event_name), SELECTS(JOX_EVENT_PUSH), .meaning = "pushes the people in the place of this name, or the body of this name"},
    {"event", "force", POINT, "N", -1e4, 1e4, "", TO(JoxEvent, force), .meaning = "of a push: force on each person, or on the body"},
    {"event", "lasts", NUMBER, "s", 0.01, 1e4, "", TO(JoxEvent, lasts), .meaning = "of a push: its duration"},
    {"event", "signal", TEXT, "", 0, 0, "", READ(jox_key_read_event_name), SELECTS(JOX_EVENT_SIGNAL), .meaning = "gives a signal that everybody hears, however far, by `heard`"},

    JOX_STOREY_KEY_ROWS
    JOX_CRITERION_KEY_ROWS
    JOX_MOD_KEY_ROWS
};

static const JoxOwner OWNERS[] = {
    {"scene", "Scene", "A scene is one YAML file: the keys below, in any order. Anchors, aliases and `<<` work as "
     "usual. Names of groups, places and all else have letters of any script, digits, spaces, _, - and . (no space, "
     "- or . at the beginning).",
     .struct_size = sizeof(JoxSceneSpec)},
    {"forces", "forces", "Forces between agents.", .struct_size = 0},
    {"walking", "walking", "One set of constants serves all crowds, and is the default (core/walking.md says what each does); to try others is research. R is the sum of two people's radii.",
     .struct_size = sizeof(JoxWalkLaw)},
    {"guard", "guard", "A message names the first person or body, with the step, its state and the forces on it. `end`: the run ends there; "
     "`remove`: the person or body is removed; `stop`: it is put back to where it was, at rest. If the run goes on, its exit status is 1 "
     "if people were lost, and the summary counts `people_lost` and `bodies_lost`.", .struct_size = 0},
    {"limits", "limits", "A script that needs more is stopped and named; the run goes on.",
     .struct_size = sizeof(JoxSceneLimits)},
    {"report", "report", "The title block of `jostle run SCENE --report DIR`; `--set report.author=NAME` sets a value for one run. What is not given is left blank, to be filled in by hand.",
     .struct_size = sizeof(JoxSceneReport)},
    {"criterion", "Criteria", "`criteria` maps names to limits. The key of a criterion tells its kind. Each is one figure of a run against one limit: the report, the last lines of a run "
     "and `--summary` say which are met, and `jostle run` ends with status 1 if one is not. One run is one seed: with `--seeds N` the mean of `criteria.NAME.met` is the share of seeds that meet it.",
     .struct_size = sizeof(JoxCriterion), .kind_offset = AT(JoxCriterion, kind), .kind_error = "bad-criterion", .name_offset = AT(JoxCriterion, name), .finish = jox_finish_criterion},
    {"heatmap", "heatmap", "Area and time of the density map of a report.", .struct_size = 0},
    {"camera", "camera", "Of the live page and of pictures; the simulation does not use it.",
     .struct_size = sizeof(JoxSceneCamera), .finish = jox_finish_camera},
    {"view", "view", "Of the live page, `jostle run SCENE --view`; the simulation does not use it. A tool is "
     "offered if there is something to use it on: gates that have names, signals that somebody hears, a `player`.",
     .struct_size = sizeof(JoxSceneView)},
    {"scenery", "Scenery", "Things that the live page draws. They are no obstacles: where people can walk, a wall belongs under each of those that are "
     "solid, and `jostle check` warns of one that lacks it. Neither people nor bodies nor the hash of a run depend on them.\n\n"
     "| kind | size [m] | |\n| --- | --- | --- |" JOX_SCENERY_KINDS(KIND_ROW),
     .struct_size = sizeof(JoxScenery), .position_offset = AT(JoxScenery, position), .finish = jox_finish_scenery, .resolve = jox_resolve_scenery},
    JOX_STOREY_OWNERS
    {"place", "Places", "`places` maps names to places. The key of a place tells its kind:",
     .struct_size = sizeof(JoxPlace), .kind_offset = AT(JoxPlace, kind), .kind_error = "bad-place", .name_offset = AT(JoxPlace, name),
     .finish = jox_finish_place, .resolve = jox_resolve_place},
    {"wall", "Walls", "Each wall of the list `walls` is a `solid`, a `line` or a `file`. In a file, a "
     "POLYGON is walkable floor: its outer ring and its holes become walls; so do MULTIPOLYGON, LINESTRING, "
     "MULTILINESTRING and GEOMETRYCOLLECTION. In an XML geometry of JuPedSim (rooms, subrooms) polygons are thin walls "
     "and obstacles are solid; each transition is a door, a wall named `door-ID` by its id: it is open until an event "
     "closes it. Crossings are gaps.",
     .struct_size = sizeof(JoxWallDraft), .kind_offset = AT(JoxWallDraft, kind), .kind_error = "bad-wall"},
    {"body", "Bodies", "Each body of the list `bodies` is simulated by Bullet, and pushed by people unless its mass is 0 or it is `kinematic`.",
     .struct_size = sizeof(JoxBodyDraft)},
    {"repeat", "repeat", "The first copy stands at the body's `at`. Copies of a body with a name are `NAME-1`, `NAME-2` and so on, along x first, then y, then z.", .struct_size = 0},
    {"path", "path", "A body on a path pushes along or squeezes what stands in its way: nothing stops it, unless it has a `force_limit`. Programs that set its velocity "
     "or place it end the path.", .struct_size = 0},
    {"shape", "Shapes", "A shape is a map with one key, its kind.",
     .struct_size = sizeof(JoxShape), .kind_offset = AT(JoxShape, kind), .kind_error = "bad-shape", .hint = "{sphere: {radius: 0.1}}"},
    {"box", "box", "", .struct_size = 0},
    {"sphere", "sphere", "", .struct_size = 0},
    {"cylinder", "cylinder", "", .struct_size = 0},
    {"hull", "hull", "", .struct_size = 0},
    {"blocks", "blocks", "Blocks stand side by side and are glued face to face. While they hold they are one rigid body; "
     "people, ground and other bodies load the glue, and pieces that break off become bodies of their own, with the same tags.", .struct_size = 0},
    {"part", "part", "Each part stands at its own place of the body's frame.",
     .struct_size = sizeof(JoxBodyPart)},
    {"group", "Groups", "`groups` maps names to groups of agents with the same properties: so many (`count`, `density`) in "
     "some places (`in`), `at` given points, or coming in as in a recording (`starts`).",
     .struct_size = sizeof(JoxGroup), .name_offset = AT(JoxGroup, name),
     .position_offset = AT(JoxGroup, position), .finish = jox_finish_group},
    {"profile", "profile", "Children, people with luggage, wheelchairs: what differs between the people of one group.",
     .struct_size = sizeof(JoxProfile), .name_offset = AT(JoxProfile, name), .position_offset = AT(JoxProfile, position)},
    {"step", "Journeys", "`journey` of a group is a list of steps. The parts of a step are done in the order of this table, and people "
     "walk by the walking law. People who have done the last step stay, unless it is an `exit`. Their states are named after "
     "the steps, as `3 Queue at gate_1`; `jostle run SCENE --trace 0` shows them.",
     .struct_size = sizeof(JoxJourneyStep), .position_offset = AT(JoxJourneyStep, position), .finish = jox_finish_step},
    {"source", "Sources", "Each source of the list `sources` brings agents in as time goes on; agents for whom its place has no room wait, and the last lines of a run, `sources` of its summary and its report say how many were due, came, and wait. If walls divide the place, people come in on its largest part only.\n\nBy `rate` and `curve` people arrive independently of each other: their times are a Poisson process that the seed draws, the same at any `step`; the number who come varies from seed to seed by about the root of its mean. `even: true` makes them come evenly instead, as an experiment lets people in. What `every`, `times`, `people` and `keep` say is exact.",
     .struct_size = sizeof(JoxAgentSource), .position_offset = AT(JoxAgentSource, position),
     .finish = jox_finish_source},
    {"sink", "Sinks", "Each sink of the list `sinks` takes agents out.",
     .struct_size = sizeof(JoxAgentSink), .finish = jox_finish_sink},
    {"probe", "Probes", "`probes` maps names to probes; one key of each says what it measures. Their figures stand in the summary under `probes`; `--report DIR` adds DIR/NAME.csv, NAME.png and "
     "NAME.svg. `jostle report` measures recordings by them, those of real crowds too.",
     .struct_size = sizeof(JoxProbeDef), .kind_offset = AT(JoxProbeDef, kind), .kind_error = "bad-probe", .name_offset = AT(JoxProbeDef, name),
     .hint = "{flow: [[0, 0], [1, 0]]}", .reserved_names = REPORT_FILES,
     .finish = jox_finish_probe},
    {"map", "map", "", .struct_size = 0},
    {"lanes", "lanes", "The two directions are the two groups that the probe names; else they are the signs of the velocity.", .struct_size = 0},
    {"oscillation", "oscillation", "The velocity of a window is the mean over the people in it and over `every`. Its figures: the `frequency` "
     "of the greatest power of the directions and by what factor it `rises` above the least power of lower ones (1: it does not), "
     "the same of the speeds, and of the stretches of windows the share that turn `anticlockwise` and how much more `one_way` than "
     "the other.", .struct_size = 0},
    {"event", "Events", "Each event of the list `events` does one thing at its time, once or again and again. Those of the "
     "same time are done in the order of the list.",
     .struct_size = sizeof(JoxEvent), .kind_offset = AT(JoxEvent, kind), .kind_error = "bad-event", .hint = "{at: 20, open: gate}",
     .finish = jox_finish_event},
    JOX_TALLY_OWNERS
    JOX_GAME_OWNERS
    {"mod", "Mods", "A mod is a folder; its file `mod.yaml` has these keys. A scene uses it, and chooses "
     "its settings, by `mods: {calm: {patience: 60}}`.",
     .struct_size = sizeof(JoxMod)},
    {"setting", "setting", "`settings` maps names to settings, which patches of the mod read as `settings.NAME`: numbers, true or false, or one of `choices`.",
     .struct_size = sizeof(JoxModSetting), .name_offset = AT(JoxModSetting, name),
     .position_offset = AT(JoxModSetting, position), .finish = jox_finish_setting},
};

const JoxAlternative jox_scene_alternatives[] = {
    {"body", "mass|density", JOX_AT_MOST_ONE},
    {"group", "behaviour|mix|journey", JOX_EXACTLY_ONE},
    {"group", "count|density", JOX_AT_MOST_ONE},
    {"group", "count|density|at|starts", JOX_AT_LEAST_ONE},
    {"source", "rate|keep|every|times|curve", JOX_AT_LEAST_ONE},
    {"game", "points|time|all", JOX_AT_LEAST_ONE},
};
const size_t jox_scene_alternative_count =
    sizeof jox_scene_alternatives / sizeof *jox_scene_alternatives;
/* clang-format on */

const JoxFormat jox_scene_format = {KEYS, sizeof KEYS / sizeof *KEYS, OWNERS,
                                    sizeof OWNERS / sizeof *OWNERS};
