/* Makes the frame in which probes, reports and pictures see a running world, once a step, and
   finds the area that they show. */
#include <math.h>

#include "agents/torso.h"
#include "base/mem.h"
#include "record/danger/criteria.h"
#include "run/present_frame.h"
#include "run/run.h"

/* The frame, and memory for the columns that the world does not hold in a frame's form. */
typedef struct JoxRunFrame {
    JoxFrame frame;
    float *vx, *vy, *force;
    size_t vx_capacity, vy_capacity, force_capacity;
    const char **names, **states;
    JoxColour *group_colours, *state_colours;
    size_t name_capacity, states_capacity, state_capacity, group_colour_capacity;
    size_t state_colour_capacity;
    uint32_t *state, state_count;
    JoxTorsos torsos;
    JoxCarLook *cars;
    size_t car_capacity;
    uint64_t made;  /* 1 + the tick of the frame */
    uint32_t parts; /* bits of the columns that are filled */
} JoxRunFrame;

/* Lists all states of all machines, anew since a reload may change them, and each agent's state. */
static void fill_states(JoxRunFrame *f, const JoWorld *world) {
    const JoxMachineRun *machines = &world->machines;
    const JoxAgents *a = &world->state.agents;
    uint32_t first[JOX_MOST_MACHINES + 1] = {1};
    for (uint32_t k = 0; k < machines->set->count; k++)
        first[k + 1] = first[k] + machines->set->items[k]->state_count;
    f->state_count = first[machines->set->count];
    JOX_RESERVE(f->states, f->states_capacity, f->state_count);
    JOX_RESERVE(f->state, f->state_capacity, a->count + 1);
    JOX_RESERVE(f->state_colours, f->state_colour_capacity, f->state_count);
    f->states[0] = ""; /* agents without a machine */
    f->state_colours[0] = 0;
    for (uint32_t k = 0; k < machines->set->count; k++)
        for (uint32_t s = 0; s < machines->set->items[k]->state_count; s++) {
            f->states[first[k] + s] = machines->set->items[k]->states[s].name;
            f->state_colours[first[k] + s] = machines->set->items[k]->states[s].colour;
        }
    for (uint32_t i = 0; i < a->count; i++)
        f->state[i] = a->machine[i] == JOX_NO_MACHINE ? 0 : first[a->machine[i]] + a->state[i];
    f->frame.state = f->state;
    f->frame.states = f->states;
    f->frame.state_count = f->state_count;
    f->frame.state_colours = f->state_colours;
}

/* Fills in velocities: the distance moved in the last step, over its duration. */
static void fill_velocities(JoxRunFrame *f, const JoWorld *world) {
    const JoxAgents *a = &world->state.agents;
    const float rate = (float)(1.0 / world->model.def.dt);
    JOX_RESERVE(f->vx, f->vx_capacity, a->count + 1);
    JOX_RESERVE(f->vy, f->vy_capacity, a->count + 1);
    for (uint32_t i = 0; i < a->count; i++) {
        f->vx[i] = (a->x[i] - a->prev_x[i]) * rate;
        f->vy[i] = (a->y[i] - a->prev_y[i]) * rate;
    }
    f->frame.vx = f->vx;
    f->frame.vy = f->vy;
}

static void fill_forces(JoxRunFrame *f, const JoxAgents *a) {
    JOX_RESERVE(f->force, f->force_capacity, a->count + 1);
    for (uint32_t i = 0; i < a->count; i++)
        f->force[i] = sqrtf(a->force_x[i] * a->force_x[i] + a->force_y[i] * a->force_y[i]);
    f->frame.force = f->force;
}

static void fill_torsos(JoxRunFrame *f, const JoWorld *world) {
    if (!jox_torsos_list(&f->torsos, &world->state.agents, world->model.def.literal))
        return;
    f->frame.axis_x = f->torsos.axis_x;
    f->frame.axis_y = f->torsos.axis_y;
    f->frame.contact_radius = f->torsos.radius;
}

/* Returns the storeys of a world, NULL for one plane. */
static const JoxStoreys *find_storeys(const JoWorld *world) {
    return jox_has_storeys(&world->model.storeys) ? &world->model.storeys : NULL;
}

/* Fills in the lifts and their cars. */
static void fill_cars(JoxRunFrame *f, const JoWorld *world) {
    const uint32_t count = world->model.lift_count;
    if (!count)
        return;
    JOX_RESERVE(f->cars, f->car_capacity, count);
    for (uint32_t l = 0; l < count; l++)
        f->cars[l] = jox_world_car_look(world, l);
    f->frame.lifts = world->model.lifts;
    f->frame.cars = f->cars;
    f->frame.lift_count = count;
}

/* Starts the frame of a step with the columns that it shares with the world. */
static void begin_frame(JoxRunFrame *f, const JoScene *scene) {
    const JoWorld *world = scene->world;
    const JoxAgents *a = &world->state.agents;
    f->made = world->state.tick + 1;
    f->parts = 0;
    JOX_RESERVE(f->names, f->name_capacity, scene->spec->group_count + 1);
    JOX_RESERVE(f->group_colours, f->group_colour_capacity, scene->spec->group_count + 1);
    for (uint32_t g = 0; g < scene->spec->group_count; g++) {
        f->names[g] = scene->spec->groups[g].name;
        f->group_colours[g] = scene->spec->groups[g].colour;
    }
    f->frame = (JoxFrame){.time = (double)world->state.tick * world->model.def.dt,
                          .count = a->count,
                          .period = a->period,
                          .keys = a->next_id,
                          .key = a->id,
                          .slots = a->slot_count,
                          .slot = a->slot,
                          .x = a->x,
                          .y = a->y,
                          .radius = a->param[JOX_PARAM_radius].cells,
                          .one_radius = !a->param[JOX_PARAM_radius].mask,
                          .fallen = a->fallen,
                          .compression = a->compression,
                          .load = a->load,
                          .failed = a->failed,
                          .group = a->group,
                          .groups = f->names,
                          .group_count = scene->spec->group_count,
                          .group_colours = f->group_colours,
                          .kicked = a->kicked,
                          .struck = a->struck,
                          .objects = &world->scratch.objects,
                          .walls = &world->scratch.walls,
                          .dividing = jox_world_dividing_walls(world),
                          .storeys = find_storeys(world)};
    f->frame.wall_loads = jox_force_wall_loads(world->scratch.forces, &f->frame.wall_load_count);
    fill_cars(f, world);
}

const JoxFrame *jox_run_present_frame(JoScene *scene, uint32_t parts) {
    const JoWorld *world = scene->world;
    if (!scene->frame)
        scene->frame = jox_alloc(1, sizeof *scene->frame);
    JoxRunFrame *f = scene->frame;
    if (f->made != world->state.tick + 1)
        begin_frame(f, scene);
    const uint32_t lacking = parts & ~f->parts;
    if (lacking & JOX_FRAME_VELOCITIES)
        fill_velocities(f, world);
    if (lacking & JOX_FRAME_FORCES)
        fill_forces(f, &world->state.agents);
    if (lacking & JOX_FRAME_STATES)
        fill_states(f, world);
    if (lacking & JOX_FRAME_TORSOS)
        fill_torsos(f, world);
    f->parts |= lacking;
    return &f->frame;
}

void jox_run_free_frame(JoScene *scene) {
    JoxRunFrame *f = scene->frame;
    if (!f)
        return;
    jox_free(f->vx);
    jox_free(f->vy);
    jox_free(f->force);
    jox_free(f->names);
    jox_free(f->group_colours);
    jox_free(f->state_colours);
    jox_free(f->states);
    jox_free(f->state);
    jox_torsos_free(&f->torsos);
    jox_free(f->cars);
    jox_free(f);
    scene->frame = NULL;
}

/* ---- the area ---- */

static const float MARGIN = 2.0f; /* m round the walls and people of a scene without bounds */

static void widen_area(JoxV2 p, JoxV2 *low, JoxV2 *high) {
    *low = (JoxV2){jox_minf(low->x, p.x), jox_minf(low->y, p.y)};
    *high = (JoxV2){jox_maxf(high->x, p.x), jox_maxf(high->y, p.y)};
}

/* Widens an area by the margin; one without anything is set to a square about the origin. */
static void add_margin(JoxV2 *low, JoxV2 *high) {
    if (low->x > high->x)
        *low = *high = (JoxV2){0.0f, 0.0f};
    *low = jox_sub(*low, (JoxV2){MARGIN, MARGIN});
    *high = jox_add(*high, (JoxV2){MARGIN, MARGIN});
}

void jox_run_find_shown_area(const JoScene *scene, JoxV2 *low, JoxV2 *high) {
    const JoxSceneSpec *spec = scene->spec;
    const JoWorld *world = scene->world;
    if (spec->heatmap || spec->bounded) {
        *low = spec->heatmap ? spec->heatmap_low : spec->low;
        *high = spec->heatmap ? spec->heatmap_high : spec->high;
        if (!spec->heatmap && find_storeys(world)) /* bounds are in plan */
            high->y += (float)(world->model.storeys.sheet_count - 1) * world->model.storeys.pitch;
        return;
    }
    *low = (JoxV2){INFINITY, INFINITY};
    *high = (JoxV2){-INFINITY, -INFINITY};
    const JoxWalls *walls = &world->model.all_walls;
    for (uint32_t i = 0; i < walls->count + world->state.agents.count; i++) {
        JoxV2 p = i < walls->count ? walls->vertices[i].point
                                   : (JoxV2){world->state.agents.x[i - walls->count],
                                             world->state.agents.y[i - walls->count]};
        widen_area(p, low, high);
    }
    jox_criteria_extend_area(spec->criteria, spec->criterion_count, spec->places, low, high);
    add_margin(low, high);
}

/* Sets the area of all walls, people and places in plan. */
static void find_area_of_all_storeys(const JoScene *scene, JoxV2 *low, JoxV2 *high) {
    const JoWorld *world = scene->world;
    const JoxStoreys *storeys = &world->model.storeys;
    const JoxWalls *walls = &world->model.all_walls;
    const JoxAgents *a = &world->state.agents;
    *low = (JoxV2){INFINITY, INFINITY};
    *high = (JoxV2){-INFINITY, -INFINITY};
    for (uint32_t i = 0; i < walls->count; i++)
        widen_area(jox_in_plan(storeys, walls->vertices[i].point), low, high);
    for (uint32_t i = 0; i < a->count; i++)
        widen_area(jox_in_plan(storeys, (JoxV2){a->x[i], a->y[i]}), low, high);
    for (uint32_t p = 0; p < scene->spec->place_count; p++)
        for (uint32_t k = 0; k < scene->spec->places[p].count; k++)
            widen_area(jox_in_plan(storeys, scene->spec->places[p].points[k]), low, high);
}

const JoxStoreys *jox_run_find_plan_area(const JoScene *scene, JoxV2 *low, JoxV2 *high) {
    const JoxStoreys *storeys = find_storeys(scene->world);
    if (!storeys || scene->spec->heatmap || scene->spec->bounded)
        jox_run_find_shown_area(scene, low, high);
    if (!storeys)
        return NULL;
    if (scene->spec->heatmap) {
        *low = jox_in_plan(storeys, *low);
        *high = jox_in_plan(storeys, *high);
    } else if (scene->spec->bounded) {
        *high = scene->spec->high;
    } else {
        find_area_of_all_storeys(scene, low, high);
    }
    /* The margin keeps people beyond an area, who count for its edge, within the rows. */
    add_margin(low, high);
    return storeys;
}
