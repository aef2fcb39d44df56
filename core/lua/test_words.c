#include "lua/test_words.h"

#include <string.h>

/* clang-format off */
const JoxTestWord jox_test_words[] = {
    {"test", "test(name, run)", "string;fun()", "",
     "declares a test; it passes if `run` raises no error"},
    {"scene", "scene(what [, options])", "string|table;jostle.SceneOptions", "jostle.Scene",
     "loads a scene: a table with the keys of a scene's file, where `behaviour` may also be the text of a behaviour, or the path of a scene. Agents get teams, own values and memory from their group: `{ behaviour = \"runner.lua\", at = { { 0, 0 } }, team = \"red\", set = { shoe = 44 }, memory = { laps = 1 } }`"},
    {"refused", "refused(what, text)", "string|table;string", "",
     "the scene must be refused with an error that has this text"},
    {"equal", "equal(value, wanted)", "any;any", "", "both values must be the same"},
    {"near", "near(value, wanted, tolerance)", "number;number;number", "", "the numbers must differ by no more than the tolerance"},
    {"truthy", "truthy(value [, message])", "any;string", "", "the value must be neither false nor nil"},
    {"fails", "fails(run [, text])", "fun();string", "", "the function must raise an error that has this text"},
    {":run", "s:run(seconds)", "number", "", "runs the scene for so many simulated seconds"},
    {":step", "s:step([steps])", "integer", "", "runs one step, or so many"},
    {":time", "s:time()", "", "number", "the simulated time, s"},
    {":count", "s:count([state [, options]])", "string;jostle.AgentsOptions", "integer", "the number of agents, of those in a state"},
    {":entered", "s:entered(state [, options])", "string;jostle.AgentsOptions", "integer", "the number of agents that have been in a state"},
    {":agents", "s:agents([group])", "string", "jostle.TestAgent[]", "the agents, of a group, by ascending id"},
    {":agent", "s:agent(id)", "integer", "jostle.TestAgent|nil", "the agent with this id; nil if it has left. Fields: `state`, `machine`, `group`, `team`, `x`, `y`, in a building `storey` and, of those on one, `stair`, `own.NAME` for own values, memory and parameters by their names. Memory of somebody is the id of a person, the text \"place 'north'\" or \"body 3\", or nil for nobody; a list is a table, of ids if it holds people. Any other name is an error"},
    {":body", "s:body(name)", "string", "jostle.TestBody", "a body by its name"},
    {":reaches", "s:reaches(state [, options])", "string;jostle.ReachesOptions", "", "runs the scene until its agents have been in a state; they must get there in time"},
    {":never", "s:never(state [, options])", "string;jostle.DuringOptions", "", "runs the scene; nobody may come into the state, nor have been in it"},
    {":slower_than", "s:slower_than(speed [, options])", "number;jostle.DuringOptions", "", "runs the scene; nobody may be faster, m/s"},
    {":faster_than", "s:faster_than(speed [, options])", "number;jostle.DuringOptions", "number", "runs the scene; the mean speed, which it returns, must be greater, m/s"},
    {":why", "s:why([who])", "integer|jostle.WhyOptions", "string", "why agents stay in their states, as `jostle why` says it: one by its id, or several"},
    {":hash", "s:hash()", "", "string", "the hash of the state of the scene, by which runs are compared"},
};
const size_t jox_test_word_count = sizeof jox_test_words / sizeof *jox_test_words;

const JoxTestOption jox_test_options[] = {
    {"SceneOptions", "set", "table<string, string|number|boolean>", "settings of the scene by path, as `jostle run --set`"},
    {"SceneOptions", "mods", "string[]", "folders of mods"},
    {"SceneOptions", "seed", "integer", "seed of the run"},
    {"SceneOptions", "dt", "number", "length of a step, s"},
    {"SceneOptions", "threads", "integer", "threads that step the scene; default 1"},
    {"AgentsOptions", "agents", "string", "only agents of this group"},
    {"ReachesOptions", "within", "number", "time for it, s"},
    {"ReachesOptions", "agents", "string", "only agents of this group"},
    {"ReachesOptions", "count", "integer", "how many must get there; default: all"},
    {"ReachesOptions", "any", "boolean", "one is enough"},
    {"DuringOptions", "during", "number", "time that is run, s"},
    {"DuringOptions", "agents", "string", "only agents of this group"},
    {"WhyOptions", "agents", "string", "only agents of this group"},
    {"WhyOptions", "state", "string", "agents in this state"},
    {"WhyOptions", "to", "string", "transitions to this state alone"},
};
const size_t jox_test_option_count = sizeof jox_test_options / sizeof *jox_test_options;
/* clang-format on */

int jox_test_word_is_known(const char *name) {
    for (size_t w = 0; w < jox_test_word_count; w++)
        if (strcmp(jox_test_words[w].name, name) == 0)
            return 1;
    return 0;
}
