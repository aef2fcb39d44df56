/* Implements render.h: loads a scene or recording, advances it, and fills in the picture of a
   frame. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/format/path.h"
#include "base/mem.h"
#include "render/render.h"
#include "run/present_frame.h"

static const float RADIUS = 0.2f; /* m: of people in recordings without radii */

/* ---- area shown ---- */

typedef struct Box {
    JoxV2 low, high;
} Box;

/* Returns the storeys of the scene or recording; NULL without any. */
static const JoxStoreys *get_storeys(const JoxRender *r) {
    const JoxStoreys *s = r->scene ? &r->scene->world->model.storeys : r->frame.storeys;
    return jox_has_storeys(s) ? s : NULL;
}

static void widen_box(Box *box, JoxV2 p) {
    box->low = jox_v2(jox_minf(box->low.x, p.x), jox_minf(box->low.y, p.y));
    box->high = jox_v2(jox_maxf(box->high.x, p.x), jox_maxf(box->high.y, p.y));
}

/* Returns a box grown on each side by so many times its longer side. */
static Box expand_box(const Box *box, float times) {
    float reach = times * jox_maxf(box->high.x - box->low.x, box->high.y - box->low.y);
    return (Box){jox_sub(box->low, jox_v2(reach, reach)), jox_add(box->high, jox_v2(reach, reach))};
}

/* Widens the box by the places near it; distant places may serve only as directions. Without
   walls, places are all there is, and more distant ones count. */
static void widen_by_places(Box *box, const JoxStoreys *storeys, const JoxPlace *places,
                            uint32_t count, bool walls) {
    Box near = expand_box(box, walls ? 1.0f : 10.0f);
    for (uint32_t p = 0; p < count; p++)
        for (uint32_t i = 0; i < places[p].count; i++) {
            JoxV2 at = jox_in_plan(storeys, places[p].points[i]);
            float around = jox_place_radius(&places[p]);
            if (at.x < near.low.x || at.y < near.low.y || at.x > near.high.x || at.y > near.high.y)
                continue;
            widen_box(box, jox_sub(at, jox_v2(around, around)));
            widen_box(box, jox_add(at, jox_v2(around, around)));
        }
}

/* Sets the area shown: that of the options, else the scene's bounds, else walls, people and near
   places with a margin. */
static void choose_map_area(JoxRender *r) {
    JoxPicture *p = &r->picture;
    const JoxSceneSpec *spec = r->scene ? r->scene->spec : r->spec;
    const double *area = r->def->area;
    const JoxStoreys *storeys = p->storeys = get_storeys(r);
    if (area) {
        p->low = jox_v2((float)area[0], (float)area[1]);
        p->high = jox_v2((float)area[2], (float)area[3]);
        return;
    }
    if (spec && spec->bounded) {
        p->low = spec->low;
        p->high = spec->high;
        return;
    }
    Box box = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    for (uint32_t i = 0; p->walls && i < p->walls->count; i++)
        widen_box(&box, jox_in_plan(storeys, p->walls->vertices[i].point));
    if (r->crowd && !storeys) {
        widen_box(&box, r->crowd->low);
        widen_box(&box, r->crowd->high);
    }
    const JoxFrame *frame = r->scene ? jox_run_present_frame(r->scene, 0) : NULL;
    for (uint32_t i = 0; frame && i < frame->count; i++)
        widen_box(&box, jox_in_plan(storeys, jox_v2(frame->x[i], frame->y[i])));
    if (!(box.low.x <= box.high.x)) /* no people and no walls: places alone */
        for (uint32_t k = 0; k < p->place_count; k++)
            if (p->places[k].count)
                widen_box(&box, jox_in_plan(storeys, p->places[k].points[0]));
    if (!(box.low.x <= box.high.x))
        box = (Box){{-1, -1}, {1, 1}};
    widen_by_places(&box, storeys, p->places, p->place_count, p->walls && p->walls->count > 0);
    float edge = 0.5f + 0.01f * jox_maxf(box.high.x - box.low.x, box.high.y - box.low.y);
    p->low = jox_sub(box.low, jox_v2(edge, edge));
    p->high = jox_add(box.high, jox_v2(edge, edge));
}

void jox_render_widen_area(JoxRender *r) {
    JoxPicture *p = &r->picture;
    Box box = {p->low, p->high};
    const Box near = expand_box(&box, 2.0f);
    if (r->def->area)
        return;
    for (uint32_t i = 0; i < r->frame.count; i++) {
        const JoxV2 edge = {0.5f, 0.5f};
        const JoxV2 at = jox_in_plan(p->storeys, jox_v2(r->frame.x[i], r->frame.y[i]));
        bool far = !(at.x >= near.low.x && at.y >= near.low.y && at.x <= near.high.x &&
                     at.y <= near.high.y);
        if (far)
            continue;
        widen_box(&box, jox_sub(at, edge));
        widen_box(&box, jox_add(at, edge));
    }
    p->low = box.low;
    p->high = box.high;
    if (!r->grid)
        return;
    jox_density_free(r->grid);
    r->grid = jox_local_grid(p->low, p->high, p->storeys);
}

/* ---- colours ---- */

/* Parses an option such as "speed" or "speed:1.5" into a quantity and the value at its bar's
   upper end. Returns false with `error`. */
static bool parse_show_option(const char *option, const char *text, const char *choices,
                              JoxShow *show, float *most, JoError *error) {
    const char *colon = strchr(text, ':'), *found = NULL;
    size_t length = colon ? (size_t)(colon - text) : strlen(text);
    for (int s = 0; s < JOX_SHOWS; s++) {
        const char *name = jox_shown[s].name;
        if (strlen(name) != length || strncmp(name, text, length) != 0)
            continue;
        found = strstr(choices, name);
        *show = (JoxShow)s;
        *most = jox_shown[s].most;
    }
    if (!found) {
        jox_error(error, JO_USAGE, "--%s is %s, not '%.40s'", option, choices, text);
        return false;
    }
    if (!colon)
        return true;
    char *end;
    double value = strtod(colon + 1, &end);
    if (*most <= 0.0f || end == colon + 1 || *end || !(value > 0.0 && value < 1e9)) {
        jox_error(error, JO_USAGE,
                  *most > 0.0f ? "--%s %.40s: after the colon comes the value at the bar's end, "
                                 "above 0"
                               : "--%s %.40s: only values have a bar, as speed:1.5",
                  option, text);
        return false;
    }
    *most = (float)value;
    return true;
}

/* Returns whether the current frame has the values of a quantity. */
static bool has_shown_values(const JoxRender *r, JoxShow show) {
    const JoxFrame *f = &r->frame;
    return show == JOX_SHOW_STATE         ? f->state != NULL && f->state_count > 0
           : show == JOX_SHOW_GROUP       ? f->group != NULL
           : show == JOX_SHOW_FORCE       ? f->force != NULL
           : show == JOX_SHOW_COMPRESSION ? f->compression != NULL
           : show == JOX_SHOW_LOAD        ? f->load != NULL
                                          : true;
}

/* Fails with a way out if the crowd does not have the values of a quantity. */
static bool require_shown_values(const JoxRender *r, JoxShow show, JoError *error) {
    if (has_shown_values(r, show))
        return true;
    jox_error(error, JO_INPUT,
              "this recording does not know the %s of people; --colour speed, or density",
              jox_shown[show].name);
    return false;
}

/* Returns the quantity that the scene asks for, or the most telling one that the crowd has. */
static JoxShow choose_default_colour(const JoxRender *r) {
    const JoxFrame *f = &r->frame;
    /* the first is "none" */
    const uint32_t states = f->state && f->state_count > 0 ? f->state_count - 1 : 0;
    const char *name =
        jox_scene_choose_colouring(r->look.colour, states, f->group ? f->group_count : 0);
    for (int s = 0; s < JOX_SHOWS; s++)
        if (strcmp(jox_shown[s].name, name) == 0 && has_shown_values(r, (JoxShow)s))
            return (JoxShow)s;
    return strcmp(name, "service") == 0 ? JOX_SHOW_DENSITY : JOX_SHOW_SPEED;
}

/* Chooses the quantities that colours show, from the def's options or by the crowd. Returns
   false with `error` if the crowd does not have them. */
static bool choose_colours(JoxRender *r, JoError *error) {
    const JoRenderDef *def = r->def;
    JoxPicture *p = &r->picture;
    if (def->field && !parse_show_option("field", def->field, "density or pressure", &p->floor,
                                         &p->floor_most, error))
        return false;
    if (def->colour)
        return parse_show_option(
                   "colour", def->colour,
                   "state, group, speed, force, compression, load, density, direction or none",
                   &p->colour, &p->colour_most, error) &&
               require_shown_values(r, p->colour, error);
    /* with a field, people are rings */
    p->colour = def->field ? JOX_SHOW_NOTHING : choose_default_colour(r);
    p->colour_most = jox_shown[p->colour].most;
    return true;
}

/* Creates what the chosen quantities need: a grid of density, collection of crowd pressure. */
static void create_fields(JoxRender *r) {
    JoxPicture *p = &r->picture;
    if (p->colour == JOX_SHOW_DENSITY || p->floor == JOX_SHOW_DENSITY)
        r->grid = jox_local_grid(p->low, p->high, p->storeys);
    if (p->floor != JOX_SHOW_PRESSURE)
        return;
    if (r->scene)
        jox_run_collect_danger_in(r->scene, p->low, p->high);
    else
        r->danger = jox_danger_create(p->low, p->high, p->storeys);
}

/* Measures the density of the current frame on the grid and at each person. */
static void measure_local_density(JoxRender *r) {
    JoxDensity *g = r->grid;
    const JoxFrame *f = &r->frame;
    jox_density_storeys(g, f->storeys);
    jox_density_walls(g, jox_frame_dividing_walls(f));
    jox_density_add(g, f->period, f->x, f->y, f->count, f->time);
    JOX_RESERVE(r->density, r->density_capacity, f->count + 1);
    for (uint32_t i = 0; i < f->count; i++) {
        size_t cell;
        bool inside = jox_density_cell_of(g, f->x[i], f->y[i], &cell);
        r->density[i] = inside ? g->now[cell] : 0.0f;
    }
}

/* ---- moments ---- */

/* Builds the names of states by row, as "machine: state" if there are several machines. */
static void build_state_names(JoxRender *r) {
    const JoxMachineRun *machines = &r->scene->world->machines;
    r->states = jox_alloc(r->frame.state_count + 1, sizeof *r->states);
    r->states[r->state_count++] = jox_strdup("");
    for (uint32_t m = 0; m < machines->set->count; m++)
        for (uint32_t s = 0; s < machines->set->items[m]->state_count; s++) {
            JoxText text = {0};
            if (machines->set->count > 1)
                jox_text_printf(&text, "%s: ", machines->set->items[m]->name);
            jox_text_add(&text, machines->set->items[m]->states[s].name);
            r->states[r->state_count++] = text.data;
        }
}

/* Returns whether the scene given with a recording supplies the walls: the recording has no
   history of its own walls. */
static bool uses_scene_walls(const JoxRender *r) {
    return r->spec && r->spec->walls.ring_count && !r->crowd->history;
}

/* Takes the current step or frame as r->frame, and extends the trails. */
static void take_frame(JoxRender *r) {
    if (r->scene) {
        r->frame = *jox_run_present_frame(r->scene, JOX_FRAME_WHOLE);
        if (!r->states)
            build_state_names(r);
        r->frame.states = (const char *const *)r->states;
    } else {
        jox_trajectories_frame(r->crowd, r->at, &r->frame);
        if (uses_scene_walls(r))
            r->frame.walls = &r->spec->walls;
        if (r->danger)
            jox_danger_frame(r->danger, &r->frame, NULL);
    }
    if (r->def->paths)
        jox_render_extend_people_trails(r);
    if (r->def->paths && r->scene)
        jox_render_extend_body_trails(r);
}

double jox_render_time(const JoxRender *r) {
    return r->frame.time;
}

static double frame_time(const JoxTrajectories *t, uint32_t f) {
    return (double)t->number[t->first[f]] / t->fps;
}

/* Returns the least time between two frames, s; recordings may leave frames out. */
static double find_frame_interval(const JoxTrajectories *t) {
    int64_t least = INT64_MAX;
    for (uint32_t f = 1; f < t->frame_count; f++) {
        int64_t gap = t->number[t->first[f]] - t->number[t->first[f - 1]];
        least = gap < least ? gap : least;
    }
    return (double)(t->frame_count > 1 ? least : 1) / t->fps;
}

bool jox_render_advance(JoxRender *r, double time, JoError *error) {
    JoxFrame next;
    while (r->scene && r->frame.time < time - 0.5 * r->interval - 1e-9) {
        if (!jo_scene_step(r->scene, error))
            return false;
        take_frame(r);
    }
    if (r->scene)
        return true;
    while (jox_trajectories_frame(r->crowd, r->at + 1, &next) &&
           next.time - time <= time - frame_time(r->crowd, r->at) + 1e-9) {
        r->at++;
        take_frame(r);
    }
    /* Recordings leave out frames without people, so a gap means that nobody is there. */
    if (fabs(frame_time(r->crowd, r->at) - time) > 0.75 * r->interval) {
        r->frame.count = 0;
        r->frame.time = r->first + floor((time - r->first) / r->interval + 0.5) * r->interval;
    }
    return true;
}

/* Sets the picture's bodies to those of the current frame. */
static void collect_drawn_bodies(JoxRender *r) {
    r->bodies.count = 0;
    if (r->scene)
        jox_draw_add_bodies(&r->bodies, r->scene->world->state.bodies);
    else if (r->reader)
        jox_draw_add_recorded(&r->bodies, r->reader, r->frame.time + 0.25 * r->interval);
    r->picture.bodies = r->bodies.items;
    r->picture.body_count = (uint32_t)r->bodies.count;
}

const JoxPicture *jox_render_picture(JoxRender *r) {
    JoxPicture *p = &r->picture;
    p->frame = &r->frame;
    if (r->scene) {
        const JoxAgents *a = &r->scene->world->state.agents;
        p->face_x = a->face_x;
        p->face_y = a->face_y;
        p->walls = &r->scene->world->model.all_walls;
    } else {
        p->walls = uses_scene_walls(r) ? &r->spec->walls : jox_trajectories_walls(r->crowd, r->at);
    }
    if (!r->scene && r->crowd->face_x) {
        p->face_x = r->crowd->face_x + r->crowd->first[r->at];
        p->face_y = r->crowd->face_y + r->crowd->first[r->at];
    }
    p->lifts = r->frame.lifts;
    p->cars = r->frame.cars;
    p->lift_count = r->frame.lift_count;
    collect_drawn_bodies(r);
    p->trails = r->trails;
    p->trail_count = r->trail_count;
    if (r->grid)
        measure_local_density(r);
    p->density = r->density;
    if (p->floor == JOX_SHOW_DENSITY) {
        p->grid = r->grid;
        p->field = r->grid->now;
    } else if (p->floor == JOX_SHOW_PRESSURE) {
        p->field = jox_danger_field(r->scene ? jox_run_danger(r->scene) : r->danger,
                                    JOX_DANGER_PRESSURE, &p->grid);
    }
    return p;
}

/* ---- loading ---- */

/* Takes floor and scenery from the scene that was given, else from the recording. */
static void choose_recorded_look(JoxRender *r, JoxDiagnostics *diagnostics) {
    const char *text = r->reader ? jox_trajectory_reader_info(r->reader).look : NULL;
    const JoxPosition at = {r->def->recording, 0, 0, 0};
    r->look = jox_scene_look(r->spec);
    if (!r->spec && text && !jox_scene_read_look(text, &r->look))
        jox_diag_warn(diagnostics, at, "bad-recording", "Give the scene by --scene",
                      "what it has of its scene's looks is damaged, and is not shown");
}

static bool load_recording(JoxRender *r, JoError *error) {
    const JoRenderDef *def = r->def;
    JoxDiagnostics diagnostics = {0};
    JoxTrajectoryOptions options = {
        .fps = def->recorded_fps, .unit = def->unit, .fps_option = "--recorded-fps 25"};
    if (def->plan)
        r->spec = jox_scene_read(def->plan, NULL, &diagnostics);
    if (r->spec && (r->spec->periodic_x || r->spec->periodic_y)) {
        JoxV2 size = jox_sub(r->spec->high, r->spec->low);
        options.period =
            jox_v2(r->spec->periodic_x ? size.x : 0.0f, r->spec->periodic_y ? size.y : 0.0f);
    }
    if (!def->plan || r->spec)
        r->crowd = jox_trajectories_read(def->recording, &options, &diagnostics);
    if (r->crowd && jox_is_sqlite(def->recording))
        r->reader = jox_trajectory_reader_open(def->recording, &options, &diagnostics);
    choose_recorded_look(r, &diagnostics);
    if (r->reader && !jox_trajectory_reader_info(r->reader).has_bodies) {
        jox_trajectory_reader_close(r->reader);
        r->reader = NULL;
    }
    for (uint32_t f = 0; r->spec && f < r->spec->file_count; f++)
        jox_diag_attach_source(&diagnostics, r->spec->files[f].path, r->spec->files[f].text,
                               r->spec->files[f].length);
    bool good = r->crowd && diagnostics.errors == 0;
    jox_run_report_diagnostics(def->message, def->message_context, &diagnostics, error);
    if (!good)
        return false;
    jox_trajectories_frame(r->crowd, 0, &r->frame);
    r->first = r->frame.time;
    r->last = (double)r->crowd->last / r->crowd->fps;
    r->interval = find_frame_interval(r->crowd);
    r->picture.walls = uses_scene_walls(r) ? &r->spec->walls : &r->crowd->walls;
    return true;
}

static bool load_scene(JoxRender *r, JoError *error) {
    r->scene = jo_scene_load(r->def->scene, error);
    if (!r->scene)
        return false;
    r->look = jox_scene_look(r->scene->spec);
    r->last = INFINITY;
    r->interval = r->scene->world->model.def.dt;
    r->picture.walls = &r->scene->world->model.all_walls;
    return true;
}

bool jox_render_load(JoxRender *r, JoError *error) {
    const JoRenderDef *def = r->def;
    if (!(def->scene ? load_scene(r, error) : load_recording(r, error)))
        return false;
    const char *path = def->scene ? def->scene->path : def->recording;
    snprintf(r->title, sizeof r->title, "%.250s",
             r->look.title && *r->look.title ? r->look.title : jox_path_name(path));
    r->picture.ground = r->look.floor;
    r->picture.scenery = r->look.scenery;
    r->picture.scenery_count = r->look.scenery_count;
    r->picture.title = r->title;
    r->picture.radius = RADIUS;
    r->picture.places = r->look.places;
    r->picture.place_count = r->look.place_count;
    choose_map_area(r);
    take_frame(r);
    if (!choose_colours(r, error))
        return false;
    create_fields(r);
    if (r->danger)
        jox_danger_frame(r->danger, &r->frame, NULL);
    return true;
}

void jox_render_free(JoxRender *r) {
    jo_scene_free(r->scene);
    jox_scene_free_look(&r->look);
    jox_trajectory_reader_close(r->reader);
    jox_trajectories_free(r->crowd);
    jox_scene_free(r->spec);
    jox_danger_free(r->danger);
    jox_density_free(r->grid);
    jox_free(r->density);
    jox_free(r->bodies.items);
    for (uint32_t s = 0; s < r->state_count; s++)
        jox_free(r->states[s]);
    jox_free(r->states);
    for (uint32_t t = 0; t < r->trail_count; t++)
        jox_free(r->trails[t].points);
    jox_free(r->trails);
    jox_free(r->trail_of);
}
