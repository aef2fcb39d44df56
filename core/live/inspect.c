/* One agent as JSON: state, parameters with the places that set them, memory, own values,
   half-planes and forces of the last step. Called by the live page and by jo_scene_inspect. */

#include "live/inspect.h"
#include "agents/torso.h"
#include "base/assert.h"
#include "base/guard.h"
#include "base/mem.h"
#include "base/number/elementary.h"
#include "base/number/pi.h"
#include "geom/storey_text.h"
#include "jostle_tools.h"
#include "machine/lifts.h"
#include "run/mods/settings.h"
#include "run/why/why.h"

enum { DIGITS = 6 };

static void add_rounded(JoxJson *json, const char *key, double number) {
    jox_json_digits(json, key, number, DIGITS);
}

static void add_rounded_vector(JoxJson *json, const char *key, JoxV2 v) {
    jox_json_numbers_of(json, key, (double[]){(double)v.x, (double)v.y}, 2, DIGITS);
}

/* Adds where an agent is, m; with storeys in plan, the name of the storey or stair, and the height
   of its floor, m. */
static void add_place(const JoWorld *world, uint32_t i, JoxJson *json) {
    const JoxStoreys *storeys = &world->model.storeys;
    const JoxV2 at = {world->state.agents.x[i], world->state.agents.y[i]};
    const JoxV2 plan = jox_in_plan(storeys, at);
    add_rounded(json, "x", (double)plan.x);
    add_rounded(json, "y", (double)plan.y);
    if (!jox_has_storeys(storeys))
        return;
    jox_json_string(json, "storey", jox_storey_name_at(storeys, at));
    add_rounded(json, "height", (double)jox_machines_height(&world->machines, i));
}

/* ---- state, parameters and memory ---- */

static const JoxMachine *find_agent_machine(const JoScene *scene, uint32_t i) {
    const JoxMachineRun *machines = &scene->world->machines;
    const uint16_t machine = machines->agents->machine[i];
    return machine == JOX_NO_MACHINE ? NULL : machines->set->items[machine];
}

/* Adds what the agent carries or holds on to, and who hold on to it, where anybody does. */
static void add_holds(const JoWorld *world, uint32_t i, JoxJson *json) {
    const JoxAgents *a = &world->state.agents;
    const double who = jox_who_is_held(&world->machines, i);
    JoxText text = {0};
    if (who > 0.0) {
        jox_who_print(&world->machines, who, &text);
        jox_json_string(json, "holds", text.data);
        jox_text_free(&text);
    }
    if (a->held[i] == 0)
        return;
    jox_json_array(json, "held_by");
    for (uint32_t j = 0; j < a->count; j++)
        if (a->grasped[j] == a->id[i] + 1)
            jox_json_whole(json, NULL, a->id[j]);
    jox_json_end(json);
}

/* Adds an agent's torso: breadth and depth, m; where its chest points, degrees anticlockwise from
   +x; how fast it turns, degrees/s. null of a disc. */
static void add_torso(const JoWorld *world, uint32_t i, JoxJson *json) {
    const JoxAgents *a = &world->state.agents;
    const JoxTorso torso = jox_agent_torso(a, i, world->model.def.literal);
    if (!(torso.half > 0.0f)) {
        jox_json_null(json, "torso");
        return;
    }
    const double chest = jox_atan2((double)a->chest_y[i], (double)a->chest_x[i]) / JOX_DEGREE;
    jox_json_object(json, "torso");
    add_rounded(json, "breadth", 2.0 * (double)(torso.half + torso.radius));
    add_rounded(json, "depth", 2.0 * (double)torso.radius);
    add_rounded(json, "chest", chest < 0.0 ? chest + 360.0 : chest);
    add_rounded(json, "spin", (double)a->spin[i] / JOX_DEGREE);
    jox_json_end(json);
}

static void add_inspected_agent(const JoScene *scene, uint32_t i, JoxJson *json) {
    const JoWorld *world = scene->world;
    const JoxAgents *a = &world->state.agents;
    const JoxMachine *machine = find_agent_machine(scene, i);
    bool grouped = a->group[i] < scene->spec->group_count;
    uint64_t since = world->state.tick > a->entered[i] ? world->state.tick - a->entered[i] : 0;
    jox_json_object(json, "agent");
    jox_json_whole(json, "id", a->id[i]);
    jox_json_whole(json, "slot", a->slot[i]);
    jox_json_string(json, "group", grouped ? scene->spec->groups[a->group[i]].name : "");
    jox_json_string(json, "machine", machine ? machine->name : "");
    jox_json_string(json, "state", machine ? machine->states[a->state[i]].name : "");
    add_rounded(json, "since", (double)since * world->model.def.dt);
    add_place(world, i, json);
    add_rounded(json, "vx", (double)a->vx[i]);
    add_rounded(json, "vy", (double)a->vy[i]);
    add_rounded(json, "radius", (double)jox_param(a, JOX_PARAM_radius, i));
    add_rounded(json, "mass", (double)jox_param(a, JOX_PARAM_mass, i));
    add_torso(world, i, json);
    add_holds(world, i, json);
    if (a->fallen[i] > 0.0f)
        add_rounded(json, "fallen", (double)a->fallen[i]); /* s */
    jox_json_end(json);
}

/* Appends the place that set a value in a few words: "state Circle behaviours/tawaf.lua:21". */
static void print_setting_place(const JoSetting *by, JoxText *out) {
    switch (by->by) {
    case JO_SET_DEFAULT:
        jox_text_add(out, "engine");
        return;
    case JO_SET_PROGRAM:
        jox_text_add(out, "program or page");
        return;
    case JO_SET_UNSEEN:
        jox_text_add(out, "function or program");
        return;
    case JO_SET_FUNCTION:
        jox_text_add(out, "function");
        break;
    case JO_SET_MOD:
        jox_text_printf(out, "mod %s", by->mod);
        break;
    case JO_SET_SCENE:
        jox_text_printf(out, "scene %s", by->where);
        break;
    default: /* a behaviour */
        jox_text_add(out, by->where);
    }
    jox_text_printf(out, " %s:%d", by->file, by->line);
}

static void add_setter(JoScene *scene, uint32_t i, const JoxWatched *watched, int parameter,
                       JoxJson *json) {
    JoSettings *settings = jox_run_parameter_settings(scene, i, watched, parameter);
    JoxText text = {0};
    JOX_ASSERT(settings->count > 0);
    print_setting_place(&settings->items[settings->count - 1], &text);
    jox_json_string(json, "set", text.data);
    jox_text_free(&text);
    jox_free(settings);
}

static void add_agent_parameters(JoScene *scene, uint32_t i, const JoxWatched *watched,
                                 JoxJson *json) {
    const JoxAgents *a = &scene->world->state.agents;
    const JoxMachine *machine = find_agent_machine(scene, i);
    jox_json_array(json, "parameters");
    for (int p = 0; p < JOX_PARAM_COUNT; p++) {
        jox_json_object(json, NULL);
        jox_json_string(json, "name", jox_parameters[p].name);
        add_rounded(json, "value", jox_parameter_value((JoxParameter)p, jox_param(a, p, i)));
        jox_json_string(json, "unit", jox_parameters[p].unit);
        if (machine)
            add_setter(scene, i, watched, p, json);
        else
            jox_json_string(json, "set", "program");
        jox_json_end(json);
    }
    jox_json_end(json);
}

/* Adds whom memory holds, or its list, as text. */
static void add_somebody(const JoScene *scene, uint32_t i, const JoxMachine *machine, uint32_t slot,
                         JoxJson *json) {
    const JoxAgents *a = &scene->world->state.agents;
    const double *memory = a->memory + (size_t)i * a->memory_stride;
    JoxText text = {0};
    jox_memory_print(&scene->world->machines, machine, memory, slot, &text);
    jox_json_string(json, machine->memory[slot].name, text.data);
    jox_text_free(&text);
}

static void add_memory_values(const JoScene *scene, uint32_t i, JoxJson *json) {
    const JoxAgents *a = &scene->world->state.agents;
    const JoxMachine *machine = find_agent_machine(scene, i);
    jox_json_object(json, "memory");
    for (uint32_t s = 0; machine && s < machine->memory_count; s++) {
        const JoxMemorySlot *slot = &machine->memory[s];
        double value = a->memory[(size_t)i * a->memory_stride + s];
        if (!*slot->name)
            continue;
        if (slot->kind == JOX_MEMORY_BOOLEAN)
            jox_json_bool(json, slot->name, value != 0.0);
        else if (slot->kind >= JOX_MEMORY_SOMEBODY)
            add_somebody(scene, i, machine, s, json);
        else
            add_rounded(json, slot->name, value);
    }
    jox_json_end(json);
}

/* Adds the agent's own values by name, except those that set a parameter: "parameters" has them. */
static void add_own_values(const JoScene *scene, uint32_t i, JoxJson *json) {
    const JoWorld *world = scene->world;
    const JoxAgents *a = &world->state.agents;
    const JoxMachine *machine = find_agent_machine(scene, i);
    jox_json_object(json, "own");
    for (uint32_t s = 0; machine && s < machine->own_count; s++) {
        const JoxOwnSlot *slot = &machine->own[s];
        double value = jox_own(a, i, s);
        if (!*slot->name || jox_parameter_find(slot->name) >= 0 || slot->general)
            continue;
        bool place = slot->is_place && value >= 0.0 && value < world->model.place_count;
        if (place && world->model.places[(uint32_t)value].name)
            jox_json_string(json, slot->name, world->model.places[(uint32_t)value].name);
        else
            add_rounded(json, slot->name, value);
    }
    jox_json_end(json);
}

/* ---- the last transition and the last step ---- */

/* Adds the agent's last transition. If it happened before the agent was watched, only the state
   that it led to and the time are known. */
static void add_last_transition(const JoScene *scene, uint32_t i, const JoxWatched *watched,
                                JoxJson *json) {
    const JoWorld *world = scene->world;
    const JoxMachine *machine = find_agent_machine(scene, i);
    const uint32_t entered = world->state.agents.entered[i];
    if (!machine) {
        jox_json_null(json, "last");
        return;
    }
    bool known = watched->took;
    jox_json_object(json, "last");
    jox_json_string(json, "from", known ? watched->from : NULL);
    jox_json_string(json, "to",
                    known ? watched->to : machine->states[world->state.agents.state[i]].name);
    add_rounded(json, "time", (known ? watched->tick : entered) * world->model.def.dt);
    jox_json_string(json, "why", known ? watched->why.data : NULL);
    jox_json_end(json);
}

/* Adds "why": the transitions out of the agent's state with the terms of their conditions. null of
   an agent without a behaviour. */
static void add_why(JoScene *scene, uint32_t i, JoxJson *json) {
    JoxBehaviourLook look;
    JoxWhyAgent why;
    if (!find_agent_machine(scene, i)) {
        jox_json_null(json, "why");
        return;
    }
    jox_world_look(scene->world, &look);
    jox_why_agent(scene, &look, i, NULL, &why);
    jox_json_object(json, "why");
    jox_why_agent_json(scene, &why, json);
    jox_json_end(json);
    jox_why_agent_free(&why);
    jox_world_end_look(scene->world, &look);
}

static void add_last_step(const JoxInspected *seen, double compression, double load,
                          JoxJson *json) {
    static const char *const PLANES[] = {"wall", "contact", "agent", "body", "force"};
    jox_json_array(json, "planes");
    for (uint32_t p = 0; p < seen->plane_count; p++) {
        const JoxConstraint *plane = &seen->planes[p];
        jox_json_object(json, NULL);
        jox_json_string(json, "kind", PLANES[plane->kind]);
        add_rounded_vector(json, "point", jox_scale(plane->normal, plane->offset));
        add_rounded_vector(json, "direction", (JoxV2){plane->normal.y, -plane->normal.x});
        jox_json_end(json);
    }
    jox_json_end(json);
    add_rounded_vector(json, "preferred", seen->preferred);
    add_rounded_vector(json, "chosen", seen->chosen);
    add_rounded(json, "max_speed", (double)seen->speed_limit);
    jox_json_bool(json, "failed", seen->failed);
    jox_json_array(json, "forces");
    for (int f = 0; f < JOX_FORCE_PARTS; f++) {
        jox_json_object(json, NULL);
        jox_json_string(json, "kind", jox_force_part_names[f]);
        add_rounded(json, "fx", (double)seen->forces[f].x);
        add_rounded(json, "fy", (double)seen->forces[f].y);
        jox_json_end(json);
    }
    jox_json_end(json);
    add_rounded(json, "compression", compression);
    add_rounded(json, "load", load);
}

bool jox_live_inspect(JoScene *scene, uint32_t slot, JoxJson *json) {
    const JoxAgents *a = &scene->world->state.agents;
    const JoxWatched *watched;
    const JoxInspected *seen = jox_world_inspect(scene->world, slot, &watched);
    if (!seen) {
        jox_json_null(json, "agent");
        return false;
    }
    uint32_t i = a->slot_index[slot];
    add_inspected_agent(scene, i, json);
    add_agent_parameters(scene, i, watched, json);
    add_memory_values(scene, i, json);
    add_own_values(scene, i, json);
    add_last_transition(scene, i, watched, json);
    add_why(scene, i, json);
    jox_json_bool(json, "seen", seen->seen);
    add_last_step(seen, (double)a->compression[i], (double)a->load[i], json);
    return true;
}

char *jo_scene_inspect(JoScene *scene, uint32_t slot) {
    JOX_REQUIRE(scene && !scene->def.dry, NULL);
    JOX_GUARD (scene->heap, NULL)
        return NULL;
    JoxText out = {0};
    JoxJson json = jox_json_begin(&out, 0);
    jox_json_object(&json, NULL);
    jox_live_inspect(scene, slot, &json);
    jox_json_end(&json);
    return jox_disown(out.data);
}
