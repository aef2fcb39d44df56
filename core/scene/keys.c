/* The table of the scene format, and of the files that describe mods. */
#include "scene/schema.h"

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

/* clang-format off */
const JoxKey jox_scene_keys[] = {
    {"scene", "jostle", WHOLE, "", 1, 1, "!", .meaning = "version of the format"},
    {"scene", "include", NAMES, "", 0, 0, "",
     .meaning = "scenes beside this one that give what it lacks; maps are joined key by key"},
    {"scene", "title", TEXT, "", 0, 0, "", .meaning = "what people see"},
    {"scene", "seed", WHOLE, "", 0, 9e15, "1", .meaning = "of all random numbers"},
    {"scene", "step", NUMBER, "s", 0.001, 0.2, "0.05", .meaning = "time step"},
    {"scene", "duration", NUMBER, "s", 0, 1e6, "60",
     .meaning = "how long a run lasts unless told otherwise"},
    {"scene", "gravity", NUMBER, "m/s2", 0, 100, "9.81", .meaning = "downwards, for bodies"},
    {"scene", "bounds", POINTS, "m", -FAR, FAR, "", .of = "xy[2]",
     .meaning = "two opposite corners; every agent must start between them"},
    {"scene", "input", TEXT, "", 0, 0, "",
     .meaning = "file of the input log that drives player agents"},
    {"scene", "player", TEXT, "", 0, 0, "",
     .meaning = "group whose first agent a person drives"},
    {"scene", "mods", TABLE, "", 0, 0, "", .of = "quantity**",
     .meaning = "mods that are taken, each with values for its settings"},
    {"scene", "patch", TEXT, "", 0, 0, "",
     .meaning = "in a mod's patches: the scene that this one is merged into"},
    {"scene", "replace", TEXT, "", 0, 0, "",
     .meaning = "in a mod's patches: the scene whose place this one takes"},
    {"scene", "forces", TABLE, "", 0, 0, "", .of = "forces", .meaning = "how forces act"},
    {"scene", "limits", TABLE, "", 0, 0, "", .of = "limits", .meaning = "what scripts may use"},
    {"scene", "heatmap", TABLE, "", 0, 0, "", .of = "heatmap",
     .meaning = "area and time of the density map"},
    {"scene", "camera", TABLE, "", 0, 0, "", .of = "camera",
     .meaning = "where one looks from"},
    {"scene", "places", TABLE, "", 0, 0, "", .of = "place*",
     .meaning = "what behaviours and groups know by name"},
    {"scene", "regions", TABLE, "", 0, 0, "", .of = "xy[3]*",
     .meaning = "polygons in which the mean speed is measured"},
    {"scene", "walls", LIST, "", 0, 0, "", .of = "wall[]", .meaning = "what never moves"},
    {"scene", "bodies", LIST, "", 0, 0, "", .of = "body[]",
     .meaning = "rigid bodies: what is pushed, kicked and falls"},
    {"scene", "groups", TABLE, "", 0, 0, "", .of = "group*", .meaning = "agents made alike"},
    {"scene", "sources", LIST, "", 0, 0, "", .of = "source[]", .meaning = "where agents come in"},
    {"scene", "sinks", LIST, "", 0, 0, "", .of = "sink[]", .meaning = "where agents leave"},

    {"forces", "enabled", BOOL, "", 0, 0, "true", .meaning = "false: collision avoidance alone"},
    {"forces", "mode", TEXT, "", 0, 0, "physical", .choices = "physical|literal",
     .meaning = "literal: the equations as they were printed"},
    {"limits", "instructions", WHOLE, "", 1000, 1e9, "100000",
     .meaning = "of one call of a Lua function"},
    {"limits", "memory", NUMBER, "MB", 1, 1024, "32", .meaning = "of one behaviour"},
    {"heatmap", "area", POINTS, "m", -FAR, FAR, "", .of = "xy[2]",
     .meaning = "two opposite corners"},
    {"heatmap", "from", NUMBER, "s", 0, 1e6, "0", .meaning = "averages begin then"},
    {"camera", "position", POINT3, "m", -FAR, FAR, "", .meaning = "where the eye is"},
    {"camera", "target", POINT3, "m", -FAR, FAR, "", .meaning = "what it looks at"},

    {"place", "point", POINT, "m", -FAR, FAR, "", .meaning = "its middle"},
    {"place", "radius", NUMBER, "m", 0.01, 1000, "0.5",
     .meaning = "of a point: nearer than this is inside"},
    {"place", "line", POINTS, "m", -FAR, FAR, "", .of = "xy[2]",
     .meaning = "two points; it is crossed from its right to its left"},
    {"place", "polygon", POINTS, "m", -FAR, FAR, "", .of = "xy[3]",
     .meaning = "corners in order; no edge crosses another"},
    {"place", "start", TEXT, "", 0, 0, "",
     .meaning = "of a polygon: the line from which circuits about it count"},
    {"place", "queue", POINTS, "m", -FAR, FAR, "", .of = "xy[2]",
     .meaning = "a line with bends, its head first"},
    {"place", "spacing", NUMBER, "m", 0.1, 10, "0.5",
     .meaning = "of a queue: the length that a person takes"},
    {"place", "set", NAMES, "", 0, 0, "", .meaning = "other places, but no sets"},

    {"wall", "solid", POINTS, "m", -FAR, FAR, "", .of = "xy[3]",
     .meaning = "corners of a filled block"},
    {"wall", "line", POINTS, "m", -FAR, FAR, "", .of = "xy[2]", .meaning = "a thin wall"},
    {"wall", "closed", BOOL, "", 0, 0, "false", .meaning = "of a line: its ends are joined"},
    {"wall", "height", NUMBER, "m", 0.01, 1000, "3",
     .meaning = "bodies fly over it above this; people never do"},

    {"body", "name", TEXT, "", 0, 0, "", .meaning = "for people and messages"},
    {"body", "shape", TABLE, "", 0, 0, "!", .of = "shape",
     .meaning = "one of box, sphere, cylinder, hull, compound"},
    {"body", "mass", NUMBER, "kg", 0, 1e7, "", .meaning = "0 never moves; 10 kg where no density is given either"},
    {"body", "density", NUMBER, "kg/m3", 0.1, 30000, "", .meaning = "in place of mass"},
    {"body", "at", POINT3, "m", -FAR, FAR, "!", .meaning = "middle of the shape"},
    {"body", "turn", NUMBER, "deg", -1e4, 1e4, "0",
     .meaning = "about the vertical, anti-clockwise"},
    {"body", "velocity", POINT3, "m/s", -100, 100, "", .meaning = "at the start"},
    {"body", "friction", NUMBER, "", 0, 10, "0.6", .meaning = "multiplied with the other's"},
    {"body", "restitution", NUMBER, "", 0, 1, "0", .meaning = "multiplied with the other's"},
    {"body", "damping", NUMBER, "", 0, 1, "0",
     .meaning = "share of the velocity lost in a second"},
    {"body", "tags", NAMES, "", 0, 0, "", .meaning = "what behaviours know it by"},
    {"shape", "box", TABLE, "", 0, 0, "", .of = "box", .meaning = "a cuboid"},
    {"shape", "sphere", TABLE, "", 0, 0, "", .of = "sphere", .meaning = "a ball"},
    {"shape", "cylinder", TABLE, "", 0, 0, "", .of = "cylinder",
     .meaning = "upright, until it falls"},
    {"shape", "hull", TABLE, "", 0, 0, "", .of = "hull",
     .meaning = "the smallest convex shape about some points"},
    {"shape", "compound", LIST, "", 0, 0, "", .of = "part[]",
     .meaning = "shapes joined to one body"},
    {"box", "size", POINT3, "m", 0.01, 1000, "!", .meaning = "whole lengths along x, y and z"},
    {"sphere", "radius", NUMBER, "m", 0.01, 100, "!", .meaning = "half its width"},
    {"cylinder", "radius", NUMBER, "m", 0.01, 100, "!", .meaning = "half its width"},
    {"cylinder", "height", NUMBER, "m", 0.01, 100, "!", .meaning = "whole height"},
    {"hull", "points", LIST, "m", -1000, 1000, "!", .of = "xyz[4]",
     .meaning = "4 to 256 points about the middle of the body"},
    {"part", "shape", TABLE, "", 0, 0, "!", .of = "shape",
     .meaning = "as of a body, but no compound"},
    {"part", "at", POINT3, "m", -FAR, FAR, "", .meaning = "in the body's frame"},
    {"part", "mass", NUMBER, "kg", 0.001, 1e7, "1", .meaning = "of this part"},

    {"group", "behaviour", TEXT, "", 0, 0, "",
     .meaning = "a Lua file: beside the scene, in ../behaviours or of the installed ones"},
    {"group", "mix", VALUES, "", 0, 0, "", .of = "weight*",
     .meaning = "several behaviours, each with its share"},
    {"group", "count", WHOLE, "", 1, 1000000, "", .meaning = "how many agents"},
    {"group", "density", NUMBER, "1/m2", 0.001, 20, "", .meaning = "in place of count"},
    {"group", "at", POINTS, "m", -FAR, FAR, "", .of = "xy[1]",
     .meaning = "in place of count: one agent at each point"},
    {"group", "fill", TEXT, "", 0, 0, "random", .choices = "hex|grid|random|circle",
     .meaning = "how they stand; a circle goes about one point at its radius"},
    {"group", "in", NAMES, "", 0, 0, "", .meaning = "places to fill; needed with count or density"},
    {"group", "outside", NAMES, "", 0, 0, "", .meaning = "places to keep out of"},
    {"group", "spacing", NUMBER, "m", 0.05, 100, "", .meaning = "least distance between them"},
    {"group", "facing", NUMBER, "deg", -1e4, 1e4, "", .meaning = "anti-clockwise from +x"},
    {"group", "party", WHOLE, "", 1, 1000, "1",
     .meaning = "agents in a row that keep together: each party is a team of its own"},
    {"group", "team", TEXT, "", 0, 0, "", .meaning = "agents of other teams are opponents"},
    {"group", "tags", NAMES, "", 0, 0, "", .meaning = "what behaviours know them by"},
    {"group", "set", VALUES, "", 0, 0, "", .of = "value*",
     .meaning = "values for names in the behaviour's `defaults`; `antipode`: the point opposite on a circle"},
    {"group", "memory", VALUES, "", 0, 0, "", .of = "draw*",
     .meaning = "what they remember at the start"},

    {"source", "at", TEXT, "", 0, 0, "!", .meaning = "place where agents appear, but no set"},
    {"source", "like", TEXT, "", 0, 0, "!", .meaning = "group that they belong to"},
    {"source", "rate", NUMBER, "1/s", 0, 1000, "0", .meaning = "agents a second"},
    {"source", "keep", WHOLE, "", 0, 1000000, "0",
     .meaning = "tops the group up to this number, once a second"},
    {"source", "from", NUMBER, "s", 0, 1e9, "0", .meaning = "nobody comes before"},
    {"source", "until", NUMBER, "s", 0, 1e9, "1e9", .meaning = "nobody comes from then on"},
    {"source", "memory", VALUES, "", 0, 0, "", .of = "draw*",
     .meaning = "in place of the group's"},

    {"sink", "at", TEXT, "", 0, 0, "!", .meaning = "place; agents that come in are removed"},
    {"sink", "group", TEXT, "", 0, 0, "", .meaning = "only agents of this group"},

    {"mod", "name", TEXT, "", 0, 0, "!", .meaning = "what other mods and scenes call it"},
    {"mod", "title", TEXT, "", 0, 0, "", .meaning = "what people see"},
    {"mod", "version", TEXT, "", 0, 0, "!", .meaning = "three numbers: 1.2.0"},
    {"mod", "api", WHOLE, "", 1, 1, "!", .meaning = "version of the engine's interface for mods"},
    {"mod", "depends", NAMES, "", 0, 0, "",
     .meaning = "mods that must be there, and come before; `NAME >= 1.2` asks for a version"},
    {"mod", "optional", NAMES, "", 0, 0, "", .meaning = "mods that come before if they are there"},
    {"mod", "conflicts", NAMES, "", 0, 0, "", .meaning = "mods that must not be there"},
    {"mod", "load_after", NAMES, "", 0, 0, "", .meaning = "mods that only come before"},
    {"mod", "enabled", BOOL, "", 0, 0, "true",
     .meaning = "whether it is taken just because it lies in a folder of mods"},
    {"mod", "settings", TABLE, "", 0, 0, "", .of = "setting*",
     .meaning = "numbers that a scene may choose for it"},
    {"setting", "value", NUMBER, "", -1e9, 1e9, "!", .meaning = "unless a scene chooses another"},
    {"setting", "unit", TEXT, "", 0, 0, "", .meaning = "of the value, as m/s"},
    {"setting", "least", NUMBER, "", -1e9, 1e9, "", .meaning = "the smallest that may be chosen"},
    {"setting", "greatest", NUMBER, "", -1e9, 1e9, "", .meaning = "the largest that may be chosen"},
    {"setting", "meaning", TEXT, "", 0, 0, "", .meaning = "what it does, in a sentence"},
};
const size_t jox_scene_key_count = sizeof jox_scene_keys / sizeof *jox_scene_keys;

const JoxOwner jox_scene_owners[] = {
    {"scene", "Scene", "A scene is one YAML file: the keys below, in any order. Anchors, aliases and `<<` work as "
     "usual."},
    {"forces", "forces", "What pushes between agents do."},
    {"limits", "limits", "A script that needs more is stopped and named; the run goes on."},
    {"heatmap", "heatmap", "What the density map of a report shows."},
    {"camera", "camera", "For programs that draw the scene; the simulation does not use it."},
    {"place", "Places", "`places` maps names to places. There are five kinds, told apart by their key:"},
    {"wall", "Walls", "Each wall of the list `walls` is a `solid` or a `line`."},
    {"body", "Bodies", "Each body of the list `bodies` is simulated by Bullet, and pushed by people."},
    {"shape", "Shapes", "A shape is a map with one key, its kind."},
    {"box", "box", ""},
    {"sphere", "sphere", ""},
    {"cylinder", "cylinder", ""},
    {"hull", "hull", ""},
    {"part", "part", "Each part stands at its own place of the body's frame."},
    {"group", "Groups", "`groups` maps names to groups: agents that are made alike, so many (`count`, `density`) in "
     "some places (`in`), or `at` given points."},
    {"source", "Sources", "Each source of the list `sources` brings agents in as time goes on."},
    {"sink", "Sinks", "Each sink of the list `sinks` takes agents out."},
    {"mod", "Mods", "A mod is a folder; its file `mod.yaml` has these keys. A scene takes it, and chooses "
     "its settings, by `mods: {calm: {patience: 60}}`."},
    {"setting", "setting", "`settings` maps names to settings: numbers that behaviours of the mod read."},
};
const size_t jox_scene_owner_count = sizeof jox_scene_owners / sizeof *jox_scene_owners;

const JoxAlternative jox_scene_alternatives[] = {
    {"place", "point|line|polygon|queue|set", JOX_EXACTLY_ONE},
    {"wall", "solid|line", JOX_EXACTLY_ONE},
    {"body", "mass|density", JOX_AT_MOST_ONE},
    {"shape", "box|sphere|cylinder|hull|compound", JOX_EXACTLY_ONE},
    {"group", "behaviour|mix", JOX_EXACTLY_ONE},
    {"group", "count|density", JOX_AT_MOST_ONE},
    {"group", "count|density|at", JOX_AT_LEAST_ONE},
    {"source", "rate|keep", JOX_AT_LEAST_ONE},
};
const size_t jox_scene_alternative_count =
    sizeof jox_scene_alternatives / sizeof *jox_scene_alternatives;

const JoxUnit jox_scene_units[] = {
    {"m", "m", 1}, {"cm", "m", 0.01}, {"mm", "m", 0.001}, {"km", "m", 1000},
    {"s", "s", 1}, {"ms", "s", 0.001}, {"min", "s", 60}, {"h", "s", 3600},
    {"m/s", "m/s", 1}, {"km/h", "m/s", 1 / 3.6},
    {"deg", "deg", 1}, {"rad", "deg", 57.29577951308232},
    {"kg", "kg", 1}, {"g", "kg", 0.001}, {"t", "kg", 1000},
    {"m/s2", "m/s2", 1}, {"kg/m3", "kg/m3", 1}, {"1/m2", "1/m2", 1}, {"1/s", "1/s", 1}, {"MB", "MB", 1}, {"KB", "KB", 1},
};
const size_t jox_scene_unit_count = sizeof jox_scene_units / sizeof *jox_scene_units;
/* clang-format on */
