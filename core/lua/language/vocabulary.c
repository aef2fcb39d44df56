#include "lua/language/vocabulary.h"

#include <math.h>
#include <string.h>

#include "base/assert.h"

#define CONDITION JOX_NODE_CONDITION
#define NUMBER JOX_NODE_NUMBER
#define TARGET JOX_NODE_TARGET
#define STEER JOX_NODE_STEER
#define NOW JOX_OP_NOW
/* clang-format off */
const JoxWord jox_words[] = {
    /* conditions */
    {"inside", "t?p", CONDITION, JOX_OP_INSIDE, 0, "inside(place) or inside(target, place)", "",
     "the agent, or a target, is in a place; of a point, line or queue no wall or closed gate may lie between, "
     "except solids that contain the point", "inside \"yard\""},
    {"crosses", "p", CONDITION, JOX_OP_CROSSES, 0, "crosses(line)", "",
     "the last step crossed a line, from its right to its left", "crosses \"mid\""},
    {"near", "tn", CONDITION, JOX_OP_NEAR, 0, "near(target, metres)", "",
     "the target is nearer than so many metres; of a place, no wall or closed gate may lie between, except "
     "walls that its nearest point lies on or in", "near(\"post\", 2)"},
    {"touches", "t", CONDITION, JOX_OP_TOUCHES, 0, "touches(target)", "",
     "the gap to the target is below 5 cm", "touches(nearest \"ball\")"},
    {"first_in", "p", CONDITION, JOX_OP_FIRST_IN, 0, "first_in(queue)", "",
     "the agent heads the queue that it steers in", "first_in \"row\""},
    {"after", "n", CONDITION, JOX_OP_AFTER, 0, "after(seconds)", "",
     "the agent has been in this state for so many seconds", "after(5)"},
    {"lasted", NULL, CONDITION, JOX_OP_LASTED, 0, "lasted", "",
     "the duration that `lasts` drew has passed", "lasted"},
    {"stuck", "n", CONDITION, JOX_OP_STUCK, 0, "stuck(seconds)", "",
     "the agent has not moved by 0.25 m for so many seconds", "stuck(3)"},
    {"hit_by", "t", CONDITION, JOX_OP_HIT_BY, 0, "hit_by(target)", "",
     "a target faster than 1 m/s touches the agent, or hit it in the last step", "hit_by(nearest \"ball\")"},
    {"grounded", "t", CONDITION, JOX_OP_GROUNDED, 0, "grounded(target)", "",
     "the body touches the ground", "grounded(nearest \"ball\")"},
    {"incoming", "tn", CONDITION, JOX_OP_INCOMING, 0, "incoming(target, metres)", "",
     "the target, going on as it moves, passes within so many metres in the next 2 s",
     "incoming(nearest \"ball\", 0.5)"},
    {"kicked", "t", CONDITION, JOX_OP_KICKED, 0, "kicked(target)", "",
     "the agent kicked or threw the body in the last step", "kicked(nearest \"ball\")"},
    {"has", "t", CONDITION, JOX_OP_HAS, 0, "has(target)", "",
     "the agent carries the body (see `take`), or holds on to an agent that the target selects (see `grasp`)", "has(nearest \"ball\")"},
    {"sees", "t", CONDITION, JOX_OP_SEES, 0, "sees(target)", "",
     "the target is there, within perception, with no wall and no tall body between", "sees(nearest \"people\")"},
    {"heard", "s?n", CONDITION, JOX_OP_HEARD, 0, "heard(name [, metres])", "",
     "somebody within perception (and so many metres), with no wall of 1.3 m or more between, gave the signal in the last step, or the scene gives it now; bodies are no hindrance",
     "heard(\"alarm\", 10)"},
    {"shut", "p", CONDITION, JOX_OP_SHUT, 0, "shut(place)", "",
     "a gate at the place, or within half a metre of it, is closed, and the agent sees that: within "
     "perception, with no other wall before it; bodies are no hindrance", "shut \"mid\""},
    {"open", "w", CONDITION, JOX_OP_OPEN, 0, "open(gate)", "",
     "the walls of this name are open, wherever they are: all know it, as of a door that is announced",
     "open \"gate\""},
    /* numbers */
    {"density", "p", NUMBER, JOX_OP_PLACE_DENSITY, 0, "density(place)", "1/m2",
     "people per square metre in a place; of a point, line or queue: within 2 m", "density \"yard\""},
    {"count", "p", NUMBER, JOX_OP_PLACE_COUNT, 0, "count(place)", "", "people in a place",
     "count \"yard\""},
    {"queued", "p", NUMBER, JOX_OP_QUEUED, 0, "queued(queue)", "",
     "people who steer in a queue, on their way to their place in it too", "queued \"row\""},
    {"distance", "t", NUMBER, JOX_OP_DISTANCE, 0, "distance(target)", "m",
     "to the target, 0 in a place; infinite where there is none", "distance \"post\""},
    {"neighbours", "g", NUMBER, JOX_OP_NEIGHBOURS, 0, "neighbours(tag)", "",
     "agents seen, with no wall and no tall body between, that bear a tag, or are \"anyone\", \"teammates\", "
     "\"opponents\": of its `neighbours` nearest, and in a crowd of at most 64 of all within perception; "
     "the methods with a colon select among them", "neighbours \"people\""},
    {"theirs", "ts", NUMBER, JOX_OP_THEIRS, 0, "theirs(target, name)", "",
     "memory of another agent that its machine makes `public`, true as 1; 0 if there is no such agent "
     "or memory", "theirs(nearest \"people\", \"laps\")"},
#define X(name, word, unit, meaning, value) \
    {#word, NULL, NUMBER, NOW, JOX_NOW_##name, #word, unit, meaning, #word},
    JOX_MEASURED_WORDS(X)
#undef X
    {"min", "nn", NUMBER, JOX_OP_MIN, 0, "min(a, b)", "", "the lesser of two", "min(1.2, 2 - density_here)"},
    {"max", "nn", NUMBER, JOX_OP_MAX, 0, "max(a, b)", "", "the greater of two", "max(now.speed, own.speed)"},
    {"abs", "n", NUMBER, JOX_OP_ABS, 0, "abs(a)", "", "absolute value", "abs(now.x)"},
    {"sqrt", "n", NUMBER, JOX_OP_SQRT, 0, "sqrt(a)", "", "square root; 0 of a negative number",
     "sqrt(density_here)"},
    {"clamp", "nnn", NUMBER, JOX_OP_CLAMP, 0, "clamp(a, least, greatest)", "",
     "kept between two bounds", "clamp(headway / 0.95, 0.2, own.speed)"},
    {"now", NULL, 0, 0, 0, "now.NAME", "",
     "what is measured of the agent now; NAME is one of"
#define X(name, ...) " " #name
     JOX_MEASURED(X),
#undef X
     "now.speed"},
    {"own", NULL, 0, 0, 0, "own.NAME", "",
     "the agent's own value: drawn from `defaults`, or given by the scene's group, which may be a "
     "place too", "own.speed"},
    /* targets */
    {"nearest", "g", TARGET, JOX_TARGET_NEAREST, 0, "nearest(tag)", "",
     "the nearest body or agent seen, with no wall and no tall body between, that bears a tag, or of \"anyone\", "
     "\"opponents\" or \"teammates\"; the methods with a colon select among agents", "nearest \"ball\""},
    {":in_state", "*", TARGET, 0, 0, "of:in_state(name)", "",
     "of `nearest` and `neighbours`: only agents in a state of this name",
     "nearest(\"people\"):in_state(\"Start\")"},
    {":of_machine", "*", TARGET, 0, 0, "of:of_machine(name)", "",
     "the same: only agents whose machine has this name",
     "nearest(\"anyone\"):of_machine(\"example\")"},
    {":of_group", "*", TARGET, 0, 0, "of:of_group(name)", "",
     "the same: only agents of a group of the scene", "nearest(\"anyone\"):of_group(\"people\")"},
    {":where", "*", TARGET, 0, 0, "of:where(name [, least [, greatest]])", "",
     "the same: only those whose public memory of this name is true, or is a number within bounds, "
     "both included", "nearest(\"people\"):where(\"laps\", 0, 2)"},
    {"one_of", "p", TARGET, JOX_TARGET_ONE_OF, 0, "one_of(set)", "",
     "a member of a set of places, drawn on entering the state; `goal` from then on",
     "one_of \"ends\""},
    {"goal", NULL, TARGET, JOX_TARGET_GOAL, 0, "goal", "",
     "the place that one_of drew last, or that a function set", "goal"},
    {"home", NULL, TARGET, JOX_TARGET_HOME, 0, "home", "",
     "the agent's own post: where it arrived, or took up its present machine", "home"},
    /* steering */
    {"seek", "t", STEER, JOX_STEER_SEEK, 0, "seek(target)", "",
     "straight to the target: a line is passed, at a point one stops", "seek \"post\""},
    {"field", "p", STEER, JOX_STEER_FIELD, 0, "field(place)", "",
     "the shortest way to the place round walls and large bodies; of a set, to the nearest member", "field \"post\""},
    {"away_from", "t", STEER, JOX_STEER_AWAY_FROM, 0, "away_from(target)", "",
     "straight away from the target", "away_from(nearest \"ball\")"},
    {"orbit", "*", STEER, JOX_STEER_ORBIT, 0, "orbit(place [, options])", "",
     "round a place, counter-clockwise; options inward, density_near, density_far, far, beyond shape "
     "the density about it", "orbit(\"yard\", { far = 20 })"},
    {"queue", "p", STEER, JOX_STEER_QUEUE, 0, "queue(place)", "",
     "to one's place in a queue, in order of arrival", "queue \"row\""},
    {"along", "p", STEER, JOX_STEER_ALONG, 0, "along(place)", "",
     "in a line's direction, or along a queue to its head", "along \"row\""},
    {"follow", "t?d", STEER, JOX_STEER_FOLLOW, 0, "follow(target [, metres])", "",
     "behind the target, at a distance", "follow(nearest \"people\", 1)"},
    {"together", "?d", STEER, JOX_STEER_TOGETHER, 0, "together([metres])", "",
     "towards the teammates seen, once they are farther than that", "seek(\"post\") + 0.5 * together(1)"},
    {"drift", "nn", STEER, JOX_STEER_DRIFT, 0, "drift(x, y)", "",
     "in the direction x east and y north, numbers or expressions; a length of 1 is the wanted "
     "speed", "drift(1, 0.1 * mine.laps)"},
    {"wander", "?p", STEER, JOX_STEER_WANDER, 0, "wander([place])", "",
     "walks about, turning gradually, and back from walls; with a place: within it", "wander \"yard\""},
    {"formation", "t?d", STEER, JOX_STEER_FORMATION, 0, "formation(target [, metres])", "",
     "to the agent's place in a row, so far apart: along a line, or behind an agent and across "
     "the direction it looks in; in the order in which they stand", "formation(\"mid\", 0.8)"},
    {"gather", "p?d", STEER, JOX_STEER_GATHER, 0, "gather(place [, degrees])", "",
     "to the agent's spot among those who wait in a polygon, round walls and fixed bodies: they fill "
     "it from its front, which lies in that direction, anti-clockwise from +x, 0.9 m apart, or "
     "closer, to 0.51 m and 1.2 breadths, where they are many; those for whom there is no room stand "
     "about it", "gather(\"yard\", 90)"},
    {"spread", NULL, STEER, JOX_STEER_SPREAD, 0, "spread", "",
     "away from the neighbours", "0.3 * spread + seek \"post\""},
    {"evade", NULL, STEER, JOX_STEER_EVADE, 0, "evade", "",
     "sideways, out of the way of oncoming agents; to the right of one straight ahead", "seek \"post\" + 0.5 * evade"},
    {"hold", NULL, STEER, JOX_STEER_HOLD, 0, "hold", "", "stands", "hold"},
    {"player", NULL, STEER, JOX_STEER_PLAYER, 0, "player", "",
     "a person, or the input log, drives this agent", "player"},
    /* drawn values */
#define X(kind, name, arguments, meaning, example)                                                 \
    {#name, "*", JOX_NODE_DIST, JOX_DIST_##kind, 0, #name "(" arguments ")", "",                   \
     meaning ", drawn once per agent", example},
    JOX_DISTS(X)
#undef X
    /* the machine's table */
    {"circuits", "p", JOX_NODE_CIRCUITS, 0, 0, "circuits(place)", "",
     "for `counts`: net counter-clockwise turns about a place since its start line was first "
     "crossed; walking back counts down", "circuits \"yard\""},
    {"memory", "*", 0, 0, 0, "memory { name = value, ... }", "",
     "what each agent remembers: numbers and booleans, kept through reloads; the result gives the "
     "values as expressions", "memory { laps = 0, touched = false }"},
    {"machine", "*", 0, 0, 0, "machine { ... }", "", "the table that a behaviour returns",
     "machine { name = \"m\", start = \"A\", states = { A = {} } }"},
    {"patch", "*", 0, 0, 0, "patch \"behaviour\" { ... }", "",
     "in a mod: changes a behaviour's table, key by key; returned by the file",
     "patch \"stander\" { defaults = { perception = 2 } }"},
    {"replace", "*", 0, 0, 0, "replace \"behaviour\" { ... }", "",
     "in a mod: replaces a behaviour's whole table; returned by the file",
     "replace \"stander\" { name = \"stander\", start = \"Stand\", states = { Stand = {} } }"},
    {"none", NULL, 0, 0, 0, "none", "", "in a patch: removes a key or a state",
     "patch \"stander\" { defaults = { perception = none } }"},
    {"settings", NULL, 0, 0, 0, "settings.NAME", "",
     "in a mod: the values of its settings, plain numbers", "patch \"stander\" { defaults = { perception = settings.reach } }"},
    {"require", "*", 0, 0, 0, "require \"name\"", "",
     "what another file returns: beside this one, or of the library; in a mod \"mod:name\" too",
     "require \"crowd\""},
    {"print", "*", 0, 0, 0, "print(...)", "", "writes a line to the output, a limited number a second",
     "print(\"loaded\")"},
};
const size_t jox_word_count = sizeof jox_words / sizeof *jox_words;

const JoxWordNumber jox_word_numbers[] = {
    {"orbit", "inward", -10, 10, 0.5, ""},
    {"orbit", "density_near", 0, 20, 5.6, "1/m2"},
    {"orbit", "density_far", 0, 20, 4.6, "1/m2"},
    {"orbit", "far", 0.1, 10000, 40, "m"},
    {"orbit", "beyond", 0, 10000, 50, "m"},
    {"follow", "metres", 0, 1000, 1, "m"},
    {"together", "metres", 0, 1000, 1, "m"},
    {"formation", "metres", 0.1, 100, 0.7, "m"},
    {"gather", "degrees", -360, 360, 90, "deg"},
    {"drift", "x", -100, 100, NAN, ""},
    {"drift", "y", -100, 100, NAN, ""},
};
const size_t jox_word_number_count = sizeof jox_word_numbers / sizeof *jox_word_numbers;

const JoxTableKey jox_table_keys[] = {
    {"machine", "name", "text", "", "how messages and mods call it", "name = \"walker\"", 0, 0},
    {"machine", "version", "number", "", "set by the author, shown in messages", "version = 1", 0, 0},
    {"machine", "start", "name of a state", "", "where agents begin", "start = \"Start\"", 0, 0},
    {"machine", "defaults", "table of parameters", "", "values for all states, drawn once per agent",
     "defaults = { speed = normal(1.3, 0.2), radius = 0.2 }", 0, 0},
    {"machine", "own", "table", "", "own values besides the parameters, drawn once per agent: numbers, distributions, or places by name; a group may set them",
     "own = { courage = uniform(0, 1), camp = \"yard\" }", 0, 0},
    {"machine", "public", "name or list of names", "", "memory that others may ask for, by `theirs` and `:where`",
     "public = { \"laps\" }", 0, 0},
    {"machine", "counts", "table", "", "memory that counts by itself, in all states",
     "counts = { laps = circuits \"yard\" }", 0, 0},
    {"machine", "renamed", "table of names", "", "old name = new name, of states, own values and memory, which agents keep at a reload. A scene, mod or other behaviour that uses the old name gets a message with the new one",
     "renamed = { Old = \"Start\" }", 0, 0},
    {"machine", "states", "table of states", "", "name = state", "states = { Start = { steer = hold } }", 0, 0},
    {"state", "steer", "steering or function", "", "where the agent wants to go: a value, a weighted sum, or function(me) that returns vx, vy in m/s",
     "steer = 0.8 * seek(\"post\") + 0.2 * spread", 0, 0},
    {"state", "lasts", "number, distribution", "s", "drawn on entering; see `lasted`", "lasts = uniform(1, 3)", 0, 1e6},
    {"state", "removes", "true or false", "", "the agent leaves the world on entering", "removes = false", 0, 0},
    {"state", "lies", "true or false", "", "the live page of a running scene shows the agent as lying; nothing else changes", "lies = true", 0, 0},
    {"state", "become", "name of a behaviour", "", "on entering, goes on with another machine, from its start; keeps its body, what the scene gave it, and memory by name",
     "become = \"stander\"", 0, 0},
    {"state", "push_when", "condition", "", "pushes only while this holds", "push_when = stuck(2)", 0, 0},
    {"state", "push_toward", "target", "", "pushes that way; else the way it wants to go", "push_toward = \"post\"", 0, 0},
    {"state", "push_weight", "\"equal\" or \"nearest\"", "", "shares the push among all in the way, or gives it to the nearest",
     "push_weight = \"nearest\"", 0, 0},
    {"state", "push_only", "tag or list of tags", "", "pushes only agents with these tags", "push_only = \"people\"", 0, 0},
    {"state", "ignore", "tag or list of tags", "", "does not avoid agents and bodies with these tags", "ignore = { \"people\" }", 0, 0},
    {"state", "face", "target", "", "looks at; else where it walks", "face = \"post\"", 0, 0},
    {"state", "approach", "target", "", "a body or agent: not avoided in advance, only not overlapped; agents are kept apart by contacts alone, where forces are on",
     "approach = nearest \"ball\"", 0, 0},
    {"state", "kick", "table", "", "kicks a body that it touches, with no wall between", "kick = { nearest \"ball\", at = \"post\", impulse = 4 }", 0, 0},
    {"state", "take", "target", "", "picks up a body within 0.6 m that is slower than 8 m/s, where hands reach it and there is room to hold it; it is carried in front, its middle at 1.2 m, nearer or to a side where a wall, or a body that is static, driven or heavier than 200 kg, leaves no room, and falls where there is none. Hands reach over what is lower than the lowest point of what they hold", "take = nearest \"ball\"", 0, 0},
    {"state", "grasp", "target", "", "takes hold of somebody within 0.5 m, and pulls and is pulled until it comes into a state without `grasp` or 1 m is between them; "
     "the agent that is held is dragged, or carried while its own `damping` is 0; see `has` and `holders`", "grasp = nearest \"people\"", 0, 0},
    {"state", "grip", "number", "N", "the greatest force with which it holds on; else 300", "grasp = nearest \"people\", grip = 400", 0, JOX_MOST_GRIP},
    {"state", "throw", "table", "", "throws the body that it carries, from its own side of walls", "throw = { nearest \"ball\", at = \"post\", speed = 6 }", 0, 0},
    {"state", "colour", "text", "", "of agents in this state where people are coloured by state; without it one is chosen; one of " JOX_COLOUR_RULE,
     "colour = \"vermilion\"", 0, 0},
    {"state", "signal", "name, or table", "", "calls out on entering, and every so often with { name, every = seconds }",
     "signal = { \"alarm\", every = 1 }", 0, 0},
    {"state", "set", "table", "", "on entering, memory = number, condition or true/false; team = name of a team and tags = tag or list of tags, replacing those it had: of the scene, or new ones",
     "set = { laps = mine.laps + 1, tags = \"people\" }", 0, 0},
    {"state", "counts", "table", "", "memory that counts while in this state", "counts = { laps = circuits \"yard\" }", 0, 0},
    {"state", "on_enter", "function(me)", "", "called on entering", "on_enter = function(me) me.laps = 1 end", 0, 0},
    {"state", "on_exit", "function(me)", "", "called on leaving", "on_exit = function(me) me.laps = 2 end", 0, 0},
    {"transition", "to", "name of a state", "", "where it leads", "to = \"Next\"", 0, 0},
    {"transition", "when", "condition or function(me)", "", "absent: always; the first that holds wins", "when = after(1)", 0, 0},
    {"transition", "chance", "number", "", "rolled each time `when` turns true", "chance = 0.5", 0, 1},
    {"transition", "set", "table", "", "memory, team and tags, as of a state", "set = { touched = true }", 0, 0},
    {"transition", "signal", "name", "", "calls out", "signal = \"alarm\"", 0, 0},
    {"transition", "on_take", "function(me)", "", "called when it is taken", "on_take = function(me) me.touched = true end", 0, 0},
    {"transition", "id", "text", "", "how mods name it; else its target, with #2, #3 for repeats", "id = \"leave\"", 0, 0},
    {"kick", "at", "target", "", "where it goes; without it straight ahead", "at = \"post\"", 0, 0},
    {"kick", "impulse", "number", "m/s", "N s per kg of the body: the change of its velocity", "impulse = 2 + 2 * now.speed", 0, 50},
    {"throw", "at", "target", "", "where it goes", "at = nearest \"people\"", 0, 0},
    {"throw", "speed", "number", "m/s", "level speed", "speed = 6", 0.1, 40},
    {"signal", "every", "plain number", "s", "between two calls", "every = 0.5", 0.01, 1e6},
};
const size_t jox_table_key_count = sizeof jox_table_keys / sizeof *jox_table_keys;

const JoxMeKey jox_me_keys[] = {
    {"id", "number", "", "the agent's number, never used again"},
    {"x", "number", "m", "position east"},
    {"y", "number", "m", "position north"},
    {"vx", "number", "m/s", "velocity east"},
    {"vy", "number", "m/s", "velocity north"},
    {"time", "number", "s", "simulated time"},
    {"time_in_state", "number", "s", "since the state was entered"},
    {"density", "number", "1/m2", "people per square metre around the agent"},
    {"pushed", "number", "N", "magnitude of the net force"},
    {"compression", "number", "N/m", "sum of contact force magnitudes over circumference"},
    {"load", "number", "N", JOX_LOAD_MEANING},
    {"team", "number", "", "0 is none"},
    {"state", "text", "", "name of its state; nil of a neighbour without a machine"},
    {"machine", "text", "", "name of its machine; nil of a neighbour without one"},
    {"goal", "name of a place", "", "can be set"},
    {"neighbours", "list", "", "views of the agents that `nearest \"anyone\"` chooses from: nearest first, within perception, with no wall and no tall body between; its `neighbours` nearest, and in a crowd of at most 64 all of them. As they were before the step; memory set in them changes after it, and memory that their machine lacks is nil"},
    {"signal", "function(name)", "", "calls out: me.signal(\"alarm\")"},
};
const size_t jox_me_key_count = sizeof jox_me_keys / sizeof *jox_me_keys;
/* clang-format on */

size_t jox_table_key_names(const char *owner, bool parameters, const char **names,
                           size_t capacity) {
    size_t n = 0;
    for (size_t k = 0; k < jox_table_key_count && n < capacity; k++)
        if (strcmp(jox_table_keys[k].owner, owner) == 0)
            names[n++] = jox_table_keys[k].name;
    for (int p = 0; parameters && p < JOX_PARAM_COUNT && n < capacity; p++)
        names[n++] = jox_parameters[p].name;
    return n;
}

const JoxWordNumber *jox_word_number(const char *word, uint32_t n) {
    for (size_t i = 0; i < jox_word_number_count; i++)
        if (strcmp(jox_word_numbers[i].word, word) == 0 && n-- == 0)
            return &jox_word_numbers[i];
    return NULL;
}

JoxParameterInfo jox_table_key_number(const char *owner, const char *name) {
    for (size_t k = 0; k < jox_table_key_count; k++) {
        const JoxTableKey *key = &jox_table_keys[k];
        if (strcmp(key->owner, owner) == 0 && strcmp(key->name, name) == 0)
            return (JoxParameterInfo){key->name,  key->unit,     key->meaning,
                                      key->least, key->greatest, 0};
    }
    JOX_ASSERT(!"a key with a row");
    return (JoxParameterInfo){name, "", "", 0, 0, 0};
}
