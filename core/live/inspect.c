/* One agent as JSON, for who looks at it. */
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/guard.h"
#include "run/run.h"

/* ---- pieces of JSON ---- */

static void add_number(JoxText *out, double number) {
    if (isfinite(number))
        jox_text_printf(out, "%.6g", number);
    else
        jox_text_add(out, "null");
}

static void add_key(JoxText *out, const char *key) {
    jox_text_printf(out, ",\"%s\":", key);
}

static void add_figure(JoxText *out, const char *key, double number) {
    add_key(out, key);
    add_number(out, number);
}

static void add_vector(JoxText *out, const char *key, JoxV2 v) {
    add_key(out, key);
    jox_text_add(out, "[");
    add_number(out, v.x);
    jox_text_add(out, ",");
    add_number(out, v.y);
    jox_text_add(out, "]");
}

/* ---- what the agent is ---- */

static const JoxMachine *machine_of(const JoScene *scene, uint32_t i) {
    const JoxMind *mind = &scene->world->mind;
    const uint16_t machine = mind->agents->machine[i];
    return machine == JOX_NO_MACHINE ? NULL : mind->machines[machine];
}

static void add_agent(const JoScene *scene, uint32_t i, JoxText *out) {
    const JoWorld *world = scene->world;
    const JoxAgents *a = &world->agents;
    const JoxMachine *machine = machine_of(scene, i);
    bool grouped = a->group[i] < scene->spec->group_count;
    jox_text_printf(out, "{\"id\":%u,\"slot\":%u,\"group\":", a->id[i], a->slot[i]);
    jox_text_json(out, grouped ? scene->spec->groups[a->group[i]].name : "");
    add_key(out, "machine");
    jox_text_json(out, machine ? machine->name : "");
    add_key(out, "state");
    jox_text_json(out, machine ? machine->states[a->state[i]].name : "");
    uint64_t since = world->tick > a->entered[i] ? world->tick - a->entered[i] : 0;
    add_figure(out, "since", (double)since * world->def.dt);
    add_figure(out, "x", (double)a->x[i]);
    add_figure(out, "y", (double)a->y[i]);
    add_figure(out, "vx", (double)a->vx[i]);
    add_figure(out, "vy", (double)a->vy[i]);
    add_figure(out, "radius", (double)a->param[JOX_PARAM_radius][i]);
    add_figure(out, "mass", (double)a->param[JOX_PARAM_mass][i]);
    jox_text_add(out, "}");
}

/* What the agent's group in the scene sets of a name, or NULL. */
static const JoxSceneSet *group_set(const JoScene *scene, uint32_t i, const char *name) {
    const JoxSceneSpec *spec = scene->spec;
    const uint32_t group = scene->world->agents.group[i];
    for (uint32_t s = 0; group < spec->group_count && s < spec->groups[group].set_count; s++)
        if (strcmp(spec->groups[group].set[s].name, name) == 0)
            return &spec->groups[group].set[s];
    return NULL;
}

/* Who set a parameter of the agent: its state, the defaults, its group, or a function since. */
static void add_setter(const JoScene *scene, uint32_t i, const JoxMachine *machine, int p,
                       JoxText *out) {
    const JoxAgents *a = &scene->world->agents;
    const JoxState *state = &machine->states[a->state[i]];
    bool own = state->param[p].kind == JOX_VALUE_UNSET;
    const JoxValue *value = own ? &machine->defaults[p] : &state->param[p];
    const double *row = a->own + (size_t)i * a->own_stride;
    bool slot = value->kind == JOX_VALUE_OWN && (uint32_t)value->index < a->own_stride;
    double meant = value->kind == JOX_VALUE_CONST ? value->number : slot ? row[value->index] : NAN;
    bool given = own && slot && value->index < 64 && (a->given[i] >> value->index & 1);
    const JoxSceneSet *set = given ? group_set(scene, i, jox_parameters[p].name) : NULL;
    JoxText text = {0};
    if (!isnan(meant) && jox_parameter_store((JoxParameter)p, meant) != a->param[p][i]) {
        jox_text_add(&text, "function");
    } else if (set) {
        jox_text_printf(&text, "scene groups.%s.set %s:%d", scene->spec->groups[a->group[i]].name,
                        set->position.file ? set->position.file : scene->spec->path,
                        set->position.line);
    } else if (given) {
        jox_text_add(&text, "function");
    } else {
        JoxSetBy by = jox_run_set_by(scene, machine, state, p);
        jox_text_add(&text, by.where.data);
        jox_set_by_free(&by);
    }
    jox_text_json(out, text.data);
    jox_text_free(&text);
}

static void add_parameters(const JoScene *scene, uint32_t i, JoxText *out) {
    const JoxAgents *a = &scene->world->agents;
    const JoxMachine *machine = machine_of(scene, i);
    jox_text_add(out, "[");
    for (int p = 0; p < JOX_PARAM_COUNT; p++) {
        jox_text_printf(out, "%s{\"name\":\"%s\"", p ? "," : "", jox_parameters[p].name);
        add_figure(out, "value", jox_parameter_value((JoxParameter)p, a->param[p][i]));
        add_key(out, "unit");
        jox_text_json(out, jox_parameters[p].unit);
        add_key(out, "set");
        if (machine)
            add_setter(scene, i, machine, p, out);
        else
            jox_text_json(out, "program");
        jox_text_add(out, "}");
    }
    jox_text_add(out, "]");
}

/* Memory, and own values that are no parameters, by name. */
static void add_values(const JoScene *scene, uint32_t i, JoxText *out) {
    const JoWorld *world = scene->world;
    const JoxAgents *a = &world->agents;
    const JoxMachine *machine = machine_of(scene, i);
    uint32_t added = 0;
    add_key(out, "memory");
    jox_text_add(out, "{");
    for (uint32_t s = 0; machine && s < machine->memory_count; s++) {
        const JoxMemorySlot *slot = &machine->memory[s];
        double value = a->memory[(size_t)i * a->memory_stride + s];
        if (!*slot->name)
            continue;
        jox_text_add(out, added++ ? "," : "");
        jox_text_json(out, slot->name);
        jox_text_add(out, ":");
        if (slot->kind == JOX_MEMORY_BOOLEAN)
            jox_text_add(out, value != 0.0 ? "true" : "false");
        else
            add_number(out, value);
    }
    jox_text_add(out, "}");
    add_key(out, "own");
    jox_text_add(out, "{");
    added = 0;
    for (uint32_t s = 0; machine && s < machine->own_count; s++) {
        const JoxOwnSlot *slot = &machine->own[s];
        double value = a->own[(size_t)i * a->own_stride + s];
        if (!*slot->name || jox_parameter_find(slot->name) >= 0)
            continue;
        jox_text_add(out, added++ ? "," : "");
        jox_text_json(out, slot->name);
        jox_text_add(out, ":");
        bool place = slot->is_place && value >= 0.0 && value < world->place_count;
        if (place && world->places[(uint32_t)value].name)
            jox_text_json(out, world->places[(uint32_t)value].name);
        else
            add_number(out, value);
    }
    jox_text_add(out, "}");
}

/* ---- what its last step was ---- */

static void add_last(const JoScene *scene, uint32_t i, const JoxWatched *watched, JoxText *out) {
    const JoWorld *world = scene->world;
    const JoxMachine *machine = machine_of(scene, i);
    const uint32_t entered = world->agents.entered[i];
    add_key(out, "last");
    if (!machine) {
        jox_text_add(out, "null");
        return;
    }
    bool known = watched->took;
    jox_text_add(out, "{\"from\":");
    if (known)
        jox_text_json(out, watched->from);
    else
        jox_text_add(out, "null");
    add_key(out, "to");
    jox_text_json(out, known ? watched->to : machine->states[world->agents.state[i]].name);
    add_figure(out, "time", (known ? watched->tick : entered) * world->def.dt);
    add_key(out, "why");
    if (known && watched->why.data)
        jox_text_json(out, watched->why.data);
    else
        jox_text_add(out, "null");
    jox_text_add(out, "}");
}

static void add_step(const JoxInspected *seen, double compression, JoxText *out) {
    static const char *const PLANES[] = {"wall", "agent", "body", "force"};
    static const char *const FORCES[JOX_FORCE_PARTS] = {"push",       "contact",  "deceleration",
                                                        "resistance", "external", "body"};
    add_key(out, "planes");
    jox_text_add(out, "[");
    for (uint32_t p = 0; p < seen->plane_count; p++) {
        const JoxWallFileeSeen *plane = &seen->planes[p];
        jox_text_printf(out, "%s{\"kind\":\"%s\"", p ? "," : "", PLANES[plane->kind]);
        add_vector(out, "point", jox_scale(plane->normal, plane->offset));
        add_vector(out, "direction", (JoxV2){plane->normal.y, -plane->normal.x});
        jox_text_add(out, "}");
    }
    jox_text_add(out, "]");
    add_vector(out, "preferred", seen->preferred);
    add_vector(out, "chosen", seen->chosen);
    add_figure(out, "max_speed", (double)seen->most);
    add_key(out, "failed");
    jox_text_add(out, seen->failed ? "true" : "false");
    add_key(out, "forces");
    jox_text_add(out, "[");
    for (int f = 0; f < JOX_FORCE_PARTS; f++) {
        jox_text_printf(out, "%s{\"kind\":\"%s\"", f ? "," : "", FORCES[f]);
        add_figure(out, "fx", (double)seen->forces[f].x);
        add_figure(out, "fy", (double)seen->forces[f].y);
        jox_text_add(out, "}");
    }
    jox_text_add(out, "]");
    add_figure(out, "compression", compression);
}

char *jo_scene_inspect(JoScene *scene, uint32_t slot) {
    JOX_REQUIRE(scene, NULL);
    JOX_GUARD(scene->heap, NULL)
    return NULL;
    const JoxAgents *a = &scene->world->agents;
    const JoxWatched *watched;
    const JoxInspected *seen = jox_world_inspect(scene->world, slot, &watched);
    JoxText out = {0};
    if (!seen) {
        jox_text_add(&out, "{\"agent\":null}");
        return jox_disown(out.data);
    }
    uint32_t i = a->slot_index[slot];
    jox_text_add(&out, "{\"agent\":");
    add_agent(scene, i, &out);
    add_key(&out, "parameters");
    add_parameters(scene, i, &out);
    add_values(scene, i, &out);
    add_last(scene, i, watched, &out);
    add_key(&out, "seen");
    jox_text_add(&out, seen->seen ? "true" : "false");
    add_step(seen, (double)a->compression[i], &out);
    jox_text_add(&out, "}");
    return jox_disown(out.data);
}
