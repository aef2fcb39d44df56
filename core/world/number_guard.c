/* Finds agents whose numbers are not finite or too large before the next step reads them, and
   reports lost agents and bodies. The first is named; what happens to it is set by the world's def.
 */
#include <math.h>
#include <stdatomic.h>
#include <stdio.h>

#include "base/assert.h"
#include "base/format/plurals.h"
#include "base/number/bits.h"
#include "geom/storey_text.h"
#include "world/world.h"

enum { MOST_TOLD = 5 };

/* X(what, column, rest): checked columns of agents, and the values they are reset to. Causes before
   effects: an agent whose preferred velocity is not finite spoils its neighbours' velocities in the
   same step. */
#define COLUMNS_OF_STATE(X, name, label)                                                           \
    X(label " force", name##_x, 0.0f) X(label " force", name##_y, 0.0f)
#define COLUMNS_OF_SCRATCH(X, name, label)
#define TERM_COLUMNS(X, keep, role, name, label) COLUMNS_OF_##keep(X, name, label)
#define COLUMNS(X)                                                                                 \
    X("eagerness", eager, 0.0f)                                                                    \
    X("course", course_x, 0.0f)                                                                    \
    X("course", course_y, 0.0f)                                                                    \
    X("direction", face_x, 1.0f)                                                                   \
    X("direction", face_y, 0.0f)                                                                   \
    X("preferred velocity", pref_x, 0.0f)                                                          \
    X("preferred velocity", pref_y, 0.0f)                                                          \
    X("chest", chest_x, 1.0f)                                                                      \
    X("chest", chest_y, 0.0f)                                                                      \
    X("spin", spin, 0.0f)                                                                          \
    X("net force", force_x, 0.0f)                                                                  \
    X("net force", force_y, 0.0f)                                                                  \
    X("planned velocity", next_x, 0.0f)                                                            \
    X("planned velocity", next_y, 0.0f)                                                            \
    JOX_FORCE_TERMS(TERM_COLUMNS, X)                                                               \
    X("velocity", vx, 0.0f)                                                                        \
    X("velocity", vy, 0.0f)                                                                        \
    X("position", x, 0.0f)                                                                         \
    X("position", y, 0.0f)
#define ONE(what, column, rest) +1
enum { COLUMN_COUNT = COLUMNS(ONE) };

typedef struct Column {
    const char *what;
    float *of;
    float rest;
    float most; /* greatest magnitude */
} Column;

static void list_columns(JoxAgents *a, Column out[COLUMN_COUNT]) {
    Column *next = out;
#define LIST(what, column, rest) *next++ = (Column){what, a->column, rest, INFINITY};
    COLUMNS(LIST)
    next[-2].most = next[-1].most = JOX_WORLD_FARTHEST; /* the last two are the position */
    JOX_ASSERT(next == out + COLUMN_COUNT);
}

static bool is_wrong(const Column *column, uint32_t i) {
    return !isfinite(column->of[i]) || fabsf(column->of[i]) > column->most;
}

static bool has_wrong(const Column *column, uint32_t count) {
    bool wrong = false;
    for (uint32_t i = 0; i < count; i++)
        wrong |= is_wrong(column, i);
    return wrong;
}

/* Returns whether an agent may have a wrong number; never false if one has. A sum of finite numbers
   is finite unless they are huge; an exponent of all ones carries into the sign bit; and magnitudes
   of floats order like their bits. Works in blocks, which compilers vectorize. */
static bool may_be_wrong(const JoxAgents *a, uint32_t begin, uint32_t end) {
    enum { BLOCK = 64 };
    const uint32_t exponent = 0x7f800000u, one = 0x00800000u, magnitude = 0x7fffffffu;
    const uint32_t most = jox_float_bits(JOX_WORLD_FARTHEST);
    uint32_t signs = 0;
#define PLUS(what, column, rest) +a->column[i]
#define LOOK(i)                                                                                    \
    signs |= (jox_float_bits(COLUMNS(PLUS)) & exponent) + one;                                     \
    signs |= (most - (jox_float_bits(a->x[i]) & magnitude)) |                                      \
             (most - (jox_float_bits(a->y[i]) & magnitude));
    for (; begin + BLOCK <= end; begin += BLOCK)
        for (uint32_t i = begin; i < begin + BLOCK; i++) {
            LOOK(i)
        }
    for (uint32_t i = begin; i < end; i++) {
        LOOK(i)
    }
    return signs >> 31;
}

typedef struct Scan {
    const JoxAgents *agents;
    atomic_bool found;
} Scan;

static void scan_chunk(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    Scan *scan = context;
    (void)worker;
    if (may_be_wrong(scan->agents, begin, end))
        atomic_store(&scan->found, true);
}

static bool may_any_be_wrong(const JoWorld *w) {
    enum { GRAIN = 2048 };
    Scan scan = {.agents = &w->state.agents};
    jox_parallel_for(w->scratch.pool, scan.agents->count, GRAIN, scan_chunk, &scan);
    return atomic_load(&scan.found);
}

/* ---- messages ---- */

static void add_when(const JoWorld *w, JoxText *out) {
    jox_text_printf(out, "step %llu, t = %.2f s: ", (unsigned long long)w->state.tick,
                    (double)w->state.tick * w->model.def.dt);
}

static void add_vector(JoxText *out, const char *label, JoxV3 v) {
    jox_text_printf(out, "%s (%.6g, %.6g, %.6g)", label, (double)v.x, (double)v.y, (double)v.z);
}

/* Adds a point, which may not be finite: in plan, with its storey. */
static void add_point_in_plan(const JoWorld *w, JoxText *out, const char *label, JoxV2 at) {
    const JoxStoreys *storeys = isfinite(at.y) ? &w->model.storeys : NULL;
    const JoxV2 plan = jox_in_plan(storeys, at);
    jox_text_printf(out, "%s (%.6g, %.6g) m", label, (double)plan.x, (double)plan.y);
    jox_text_storey(out, storeys, at);
}

static void add_body_point(const JoWorld *w, JoxText *out, const char *label, JoxV3 at) {
    const JoxV2 on_floor = {at.x, at.y};
    const JoxStoreys *storeys = isfinite(at.y) ? &w->model.storeys : NULL;
    const JoxV2 plan = jox_in_plan(storeys, on_floor);
    add_vector(out, label, (JoxV3){plan.x, plan.y, at.z});
    jox_text_add(out, " m");
    jox_text_storey(out, storeys, on_floor);
}

static void add_machine(const JoWorld *w, uint32_t i, JoxText *out) {
    const uint16_t number = w->state.agents.machine[i];
    const JoxMachine *machine = number == JOX_NO_MACHINE ? NULL : w->model.machines.items[number];
    if (machine)
        jox_text_printf(out, " (machine %.60s, state %.60s)", machine->name,
                        machine->states[w->state.agents.state[i]].name);
    else
        jox_text_add(out, " (no machine)");
}

static void add_forces(const JoxAgents *a, uint32_t i, JoxText *out) {
    jox_text_add(out, "; forces, N:");
#define ADD(X, keep, role, name, label)                                                            \
    if (a->name##_x != a->ext_x) /* cleared by now, and part of the net force */                   \
        jox_text_printf(out, " " label " (%.6g, %.6g),", (double)a->name##_x[i],                   \
                        (double)a->name##_y[i]);
    JOX_FORCE_TERMS(ADD, )
#undef ADD
    jox_text_printf(out, " net (%.6g, %.6g)", (double)a->force_x[i], (double)a->force_y[i]);
}

/* Describes the agent with the least id that has a wrong number in a column. */
static void describe_agent(const JoWorld *w, const Column *column, JoxText *out) {
    const JoxAgents *a = &w->state.agents;
    uint32_t worst = JOX_NO_INDEX;
    for (uint32_t i = 0; i < a->count; i++)
        if (is_wrong(column, i) && (worst == JOX_NO_INDEX || a->id[i] < a->id[worst]))
            worst = i;
    JOX_ASSERT(worst != JOX_NO_INDEX); /* the caller found one */
    const bool left = isfinite(column->of[worst]);
    add_when(w, out);
    jox_text_printf(out, "the %s of agent %u is %s", column->what, a->id[worst],
                    left ? "more than 10 km from the origin" : "not finite");
    add_machine(w, worst, out);
    add_point_in_plan(w, out, ", at", (JoxV2){a->x[worst], a->y[worst]});
    add_point_in_plan(w, out, ", before at", (JoxV2){a->prev_x[worst], a->prev_y[worst]});
    jox_text_printf(out, ", with (%.6g, %.6g) m/s", (double)a->vx[worst], (double)a->vy[worst]);
    add_forces(a, worst, out);
}

/* ---- recovery ---- */

/* Puts an agent back to where it was before the substep, at rest. Returns false if that position is
   unknown. */
static bool put_to_rest(JoWorld *w, const Column *columns, uint32_t i) {
    JoxAgents *a = &w->state.agents;
    const bool known =
        fabsf(a->prev_x[i]) <= JOX_WORLD_FARTHEST && fabsf(a->prev_y[i]) <= JOX_WORLD_FARTHEST;
    if (!known)
        a->prev_x[i] = a->prev_y[i] = 0.0f;
    for (int c = 0; c < COLUMN_COUNT; c++)
        if (is_wrong(&columns[c], i))
            columns[c].of[i] = columns[c].rest;
    a->x[i] = a->still_x[i] = a->prev_x[i];
    a->y[i] = a->still_y[i] = a->prev_y[i];
    a->vx[i] = a->vy[i] = a->next_x[i] = a->next_y[i] = 0.0f;
    if (!jox_is_unit(jox_v2(a->face_x[i], a->face_y[i]))) {
        a->face_x[i] = 1.0f;
        a->face_y[i] = 0.0f;
    }
    a->spin[i] = 0.0f;
    if (!jox_is_unit(jox_v2(a->chest_x[i], a->chest_y[i]))) {
        a->chest_x[i] = a->face_x[i];
        a->chest_y[i] = a->face_y[i];
    }
    a->compression[i] = isfinite(a->compression[i]) ? a->compression[i] : 0.0f;
    a->load[i] = isfinite(a->load[i]) ? a->load[i] : 0.0f;
    if (w->scratch.walked_capacity > i)
        w->scratch.walked[i] = jox_v2(0.0f, 0.0f);
    return known;
}

/* Counts a lost agent, and removes it if that is asked for or its position is unknown. */
static void count_lost(JoWorld *w, uint32_t i, bool known) {
    w->state.statistics.people_lost++;
    if (w->model.def.lost_people != JO_LOST_REMOVE && known)
        return;
    JOX_RESERVE(w->scratch.lost.ids, w->scratch.lost.capacity, w->scratch.lost.count + 1);
    w->scratch.lost.ids[w->scratch.lost.count++] = w->state.agents.id[i];
}

/* Puts all agents with wrong numbers to rest. Those with a wrong number in the column of the cause
   are lost; the others only had them near, and continue. */
static void recover_agents(JoWorld *w, const Column *columns, int cause) {
    const JoxAgents *a = &w->state.agents;
    for (uint32_t i = 0; i < a->count; i++) {
        bool wrong = false;
        for (int c = cause; c < COLUMN_COUNT && !wrong; c++)
            wrong = is_wrong(&columns[c], i);
        if (!wrong)
            continue;
        const bool lost = is_wrong(&columns[cause], i);
        /* A vector is in two columns. */
        const bool pair = cause + 1 < COLUMN_COUNT &&
                          columns[cause + 1].what == columns[cause].what &&
                          is_wrong(&columns[cause + 1], i);
        const bool known = put_to_rest(w, columns, i);
        if (lost || pair || !known)
            count_lost(w, i, known);
    }
    jox_nav_invalidate_order(w->scratch.nav); /* moved agents are not where they were sorted */
}

/* Ends the world with a reason, or adds a message; returns whether it continues. */
static bool report_loss(JoWorld *w, JoLost lost, uint64_t before, JoxText *what) {
    const char *const ends[] = {[JO_LOST_END] = "the run cannot go on",
                                [JO_LOST_REMOVE] = "removed",
                                [JO_LOST_STOP] = "put back, at rest"};
    if (lost == JO_LOST_END)
        snprintf(w->failure, sizeof w->failure, "%s; %s", what->data, ends[lost]);
    else if (before <= MOST_TOLD)
        jox_text_printf(&w->scratch.messages, "%s; %s%s\n", what->data, ends[lost],
                        before == MOST_TOLD ? "; from here on it is only counted" : "");
    jox_text_free(what);
    return lost != JO_LOST_END;
}

void jox_world_report_lost_body(JoWorld *w, const JoxBodyGone *gone) {
    const char *const ends[] = {[JOX_BODY_FELL] = "fell through the ground",
                                [JOX_BODY_NOT_FINITE] = "has a number that is not finite",
                                [JOX_BODY_LEFT] = "is more than 10 km from the origin",
                                [JOX_BODY_PASSED_WALL] = "passed a wall",
                                [JOX_BODY_LEFT_STOREY] = "left the plan of its storey"};
    JoxText what = {0};
    add_when(w, &what);
    jox_text_printf(&what, "body %u%s%s %s", gone->id, *gone->name ? ", " : "", gone->name,
                    ends[gone->why]);
    add_body_point(w, &what, ", at", gone->at);
    add_body_point(w, &what, ", before at", gone->before);
    add_vector(&what, ", with", gone->velocity);
    add_vector(&what, " m/s; people gave it", gone->force);
    jox_text_add(&what, " N");
    report_loss(w, w->model.def.lost_bodies, w->state.statistics.bodies_lost, &what);
}

void jox_world_end_overloaded(JoWorld *w, const JoxDriveLoad *load) {
    const JoxObject *body = &w->scratch.objects.rows[load->row];
    const char *name = jox_bodies_name(w->state.bodies, load->row);
    JoxText what = {0};
    add_when(w, &what);
    jox_text_printf(&what, "body %u%s%s presses ", body->id, *name ? ", " : "", name);
    jox_text_noun(&what, load->people, "person|people");
    jox_text_printf(&what, " with %.6g N, its limit", (double)load->force);
    add_body_point(w, &what, ", at", body->position);
    jox_text_printf(&what, "; agent %u bears most of it, %.6g N", load->agent,
                    (double)load->hardest);
    const uint32_t i = jox_agents_find(&w->state.agents, load->agent);
    if (i != JOX_NO_INDEX)
        add_point_in_plan(w, &what, ", at", (JoxV2){w->state.agents.x[i], w->state.agents.y[i]});
    report_loss(w, JO_LOST_END, 0, &what);
}

/* Returns whether an agent left the sheet on which it was, not over a seam, which moves the
   position before, too. */
static bool has_left_sheet(const JoxStoreys *s, const JoxAgents *a, uint32_t i) {
    return jox_sheet_of(s, a->y[i]) != jox_sheet_of(s, a->prev_y[i]);
}

/* Handles agents that left the plan of their storey; false if the run ends. */
static bool guard_storeys(JoWorld *w) {
    const JoxStoreys *s = &w->model.storeys;
    const JoxAgents *a = &w->state.agents;
    const uint64_t before = w->state.statistics.people_lost;
    uint32_t first = JOX_NO_INDEX;
    Column columns[COLUMN_COUNT];
    JoxText what = {0};
    list_columns(&w->state.agents, columns);
    for (uint32_t i = 0; i < a->count; i++)
        if (has_left_sheet(s, a, i) && (first == JOX_NO_INDEX || a->id[i] < a->id[first]))
            first = i;
    if (first == JOX_NO_INDEX)
        return true;
    add_when(w, &what);
    jox_text_printf(&what, "agent %u left the plan of its storey", a->id[first]);
    add_machine(w, first, &what);
    add_point_in_plan(w, &what, ", before at", (JoxV2){a->prev_x[first], a->prev_y[first]});
    jox_text_add(&what, "; enclose it by walls");
    for (uint32_t i = 0; w->model.def.lost_people != JO_LOST_END && i < a->count; i++)
        if (has_left_sheet(s, a, i))
            count_lost(w, i, put_to_rest(w, columns, i));
    jox_nav_invalidate_order(w->scratch.nav);
    return report_loss(w, w->model.def.lost_people, before, &what);
}

bool jox_world_guard_numbers(JoWorld *w) {
    if (w->failure[0]) /* set for a lost body */
        return false;
    if (!may_any_be_wrong(w))
        return !jox_has_storeys(&w->model.storeys) || guard_storeys(w);
    Column columns[COLUMN_COUNT];
    list_columns(&w->state.agents, columns);
    for (int c = 0; c < COLUMN_COUNT; c++) {
        if (!has_wrong(&columns[c], w->state.agents.count))
            continue;
        const uint64_t before = w->state.statistics.people_lost;
        JoxText what = {0};
        describe_agent(w, &columns[c], &what);
        if (w->model.def.lost_people != JO_LOST_END)
            recover_agents(w, columns, c);
        return report_loss(w, w->model.def.lost_people, before, &what);
    }
    return true;
}

void jox_world_remove_lost(JoWorld *w) {
    JoxAgents *a = &w->state.agents;
    for (uint32_t n = 0; n < w->scratch.lost.count; n++) {
        const uint32_t i = jox_agents_find(a, w->scratch.lost.ids[n]);
        if (i != JOX_NO_INDEX) /* not removed meanwhile */
            a->removed[i] = 1;
    }
    if (w->scratch.lost.count)
        jox_agents_compact(a);
    w->scratch.lost.count = 0;
}
