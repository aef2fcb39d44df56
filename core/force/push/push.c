/* The stage push, equation 5: deliberate pushes on agents and bodies ahead. */
#include "base/assert.h"
#include "base/mem.h"
#include "force/body_touch.h"
#include "force/push/pushes.h"

typedef struct Target {
    bool is_body;
    uint32_t index;
    JoxV2 offset;    /* from the pusher, m */
    JoxV2 to_centre; /* from the pusher to the centre of the target, m */
    JoxV3 point;     /* point at which a body is pushed, m */
    float gap;       /* of bodies; see find_gap */
} Target;

enum { MOST_TARGETS = JOX_MOST_NEIGHBOURS + JOX_MOST_BODIES_TOUCHED };

#define X(name, isa) [isa] = jox_push_packets_##name,
static JoxPushKernel *const KERNELS[JOX_ISA_ROOM] = {JOX_ISAS(X)};
#undef X

/* Lists those of the agents found that agent i pushes: with a tag that it pushes. Returns how
   many. */
static uint32_t list_people_targets(const JoxForces *f, uint32_t i, uint32_t found,
                                    Target *targets) {
    const JoxAgents *a = f->step.agents;
    const uint64_t only = a->push_only[i];
    uint32_t n = 0;
    while (found) {
        const uint32_t other = jox_take_found(f, i, &found);
        const JoxV2 offset = jox_offset(a, i, other);
        if (only && !(a->tags[other] & only))
            continue;
        targets[n++] = (Target){.index = other, .offset = offset, .to_centre = offset};
    }
    return n;
}

/* Lists the bodies that agent i pushes, the nearest ones in ascending row. Returns how many. */
static uint32_t find_body_targets(const JoxForces *f, uint32_t i, JoxV2 aim, Target *targets) {
    const JoxAgents *a = f->step.agents;
    float radius = jox_param(a, JOX_PARAM_radius, i), reach = jox_param(a, JOX_PARAM_push_reach, i);
    float cosine = jox_param(a, JOX_PARAM_push_angle, i);
    uint64_t only = a->push_only[i];
    JoxV2 centre = {a->x[i], a->y[i]};
    JoxNearest nearest;
    jox_nearest_begin(&nearest, JOX_MOST_BODIES_TOUCHED);
    JoxObjectWalk walk = jox_objects_near(f->step.objects, centre, radius + reach);
    uint32_t row, n = 0;
    while (jox_objects_next(&walk, &row)) {
        const JoxObject *body = &f->step.objects->rows[row];
        if (body->swept || jox_referred(a->parting[i]) == (int32_t)row ||
            (only && !(body->tags & only)) || !jox_object_reaches(body, centre, radius + reach))
            continue;
        JoxFootprintPoint at = jox_footprint_nearest(body, centre);
        if (at.gap - radius < reach && jox_cone_holds(jox_scale(at.normal, -1.0f), aim, cosine) &&
            !jox_wall_stops_force(f, centre, at.point))
            jox_nearest_offer(&nearest, at.gap, row);
    }
    jox_nearest_by_row(&nearest);
    for (uint32_t k = 0; k < nearest.count; k++) {
        const JoxObject *body = &f->step.objects->rows[nearest.rows[k]];
        JoxFootprintPoint at = jox_footprint_nearest(body, centre);
        JoxV3 point = {at.point.x, at.point.y, jox_touch_height(body)};
        JoxV2 to_centre = {body->position.x - centre.x, body->position.y - centre.y};
        targets[n++] = (Target){true,      nearest.rows[k], jox_scale(at.normal, -1.0f),
                                to_centre, point,           at.gap - radius};
    }
    return n;
}

/* Returns the gap between agent i and a target, m. */
static float find_gap(const JoxForces *f, uint32_t i, const Target *target) {
    const JoxParameterColumn radius = f->step.agents->param[JOX_PARAM_radius];
    return target->is_body
               ? target->gap
               : jox_length(target->offset) - jox_at(radius, i) - jox_at(radius, target->index);
}

/* Keeps the nearest target; of equals the first found, which has the least id. */
static uint32_t keep_nearest(const JoxForces *f, uint32_t i, Target *targets, uint32_t n) {
    JOX_ASSERT(n > 0);
    uint32_t best = 0;
    for (uint32_t k = 1; k < n; k++)
        if (find_gap(f, i, &targets[k]) < find_gap(f, i, &targets[best]))
            best = k;
    targets[0] = targets[best];
    return 1;
}

/* Returns agent i's push on one of n targets, N. */
static JoxV2 compute_push(const JoxForces *f, uint32_t i, JoxV2 aim, const Target *target,
                          uint32_t n) {
    const JoxAgents *a = f->step.agents;
    float newtons = jox_param(a, JOX_PARAM_push, i);
    JoxV2 offset = target->offset;
    if (f->options.literal)
        offset = jox_literal_push_offset(f, i, target->to_centre);
    if (offset.x == 0.0f && offset.y == 0.0f)
        offset = aim; /* both at the same place */
    return jox_push_share(offset, newtons, n);
}

/* Adds a push on a body to the list of its chunk. */
static void add_body_push(JoxForces *f, uint32_t chunk, uint32_t i, const Target *target,
                          JoxV2 force) {
    JoxChunkList *pushes = &f->pushes->on_bodies;
    JoxBodyPush *list = (JoxBodyPush *)pushes->items + (size_t)chunk * pushes->room;
    JOX_ASSERT(chunk < f->chunks && pushes->counts[chunk] < pushes->room);
    list[pushes->counts[chunk]++] = (JoxBodyPush){i, target->index, force, target->point};
}

/* Converts a momentum, N s, to fixed point, so that sums do not depend on the order of threads. */
static int64_t to_fixed(double momentum) {
    double scaled = momentum * 1048576.0;
    return scaled > 1e14 ? (int64_t)1e14 : scaled > -1e14 ? (int64_t)scaled : (int64_t)-1e14;
}

/* Applies the pushes of agent i, which aims along a unit vector, to its targets: the agents found
   and bodies; and the reaction to itself or the ground. */
static void push_from_agent(JoxForces *f, uint32_t chunk, uint32_t i, JoxV2 aim, uint32_t found) {
    Target targets[MOST_TARGETS];
    if (f->step.agents->fallen[i] > 0.0f)
        return;
    uint32_t n = list_people_targets(f, i, found, targets);
    if (f->has_bodies)
        n += find_body_targets(f, i, aim, targets + n);
    JOX_ASSERT(n <= MOST_TARGETS);
    if (!n)
        return;
    if (f->in.push_nearest && f->in.push_nearest[i])
        n = keep_nearest(f, i, targets, n);
    JoxV2 sum = {0.0f, 0.0f};
    for (uint32_t k = 0; k < n; k++) {
        JoxV2 force = compute_push(f, i, aim, &targets[k], n);
        JOX_ASSERT(targets[k].is_body || targets[k].index != i);
        sum = jox_add(sum, force);
        if (targets[k].is_body)
            add_body_push(f, chunk, i, &targets[k], force);
        else
            jox_transfers_add(f, chunk, i, targets[k].index, force);
    }
    JoxPushTotals *totals = &f->pushes->totals[chunk];
    totals->pushers++;
    f->pushes->reactions[i] = jox_scale(sum, -1.0f);
    if (f->options.react) {
        jox_transfers_add(f, chunk, i, i, jox_scale(sum, -1.0f));
    } else {
        totals->ground_x += to_fixed(sum.x * f->step.timing.dt);
        totals->ground_y += to_fixed(sum.y * f->step.timing.dt);
    }
}

static void push_from_chunk(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    JoxForces *f = context;
    const uint32_t chunk = begin / JOX_FORCE_GRAIN;
    JoxPushing pushing;
    jox_chunk_clear(&f->transfers.list, chunk);
    if (f->has_bodies)
        jox_chunk_clear(&f->pushes->on_bodies, chunk);
    f->pushes->totals[chunk] = (JoxPushTotals){0};
    if (!KERNELS[f->isa](f, begin, end, &pushing))
        return;
    for (uint32_t i = begin; i < end; i++) {
        const JoxV2 aim = {pushing.aim_x[i - begin], pushing.aim_y[i - begin]};
        if (aim.x != 0.0f || aim.y != 0.0f)
            push_from_agent(f, chunk, i, aim, jox_find_reached(f, i, &pushing.people, i - begin));
    }
}

/* Adds the chunk's pushes on bodies to the impulses and the totals. */
static void apply_body_pushes(JoxForces *f, uint32_t chunk) {
    const JoxChunkList *list = &f->pushes->on_bodies;
    const JoxBodyPush *pushes = (const JoxBodyPush *)list->items + (size_t)chunk * list->room;
    const float dt = (float)f->step.timing.dt;
    for (uint32_t k = 0; k < list->counts[chunk]; k++) {
        const JoxBodyPush *push = &pushes[k];
        const JoxV3 impulse = {push->force.x * dt, push->force.y * dt, 0.0f};
        const bool moves = f->step.objects->rows[push->row].inverse_mass > 0.0f;
        f->totals.pushed_x += moves ? (double)impulse.x : 0.0;
        f->totals.pushed_y += moves ? (double)impulse.y : 0.0;
        jox_impulses_add(&f->impulses, f->step.agents->id[push->agent], push->row, impulse,
                         push->point, 1.0f);
    }
}

void jox_force_push(JoxForces *f) {
    JoxAgents *a = f->step.agents;
    JoxPushes *pushes = f->pushes;
    jox_transfers_reserve(f, &f->found_memory);
    if (f->has_bodies)
        jox_chunks_reserve(&pushes->on_bodies, NULL, f->chunks,
                           jox_most_chunk_agents(f) * JOX_MOST_BODIES_TOUCHED, sizeof(JoxBodyPush));
    jox_parallel_for(f->step.pool, a->count, JOX_FORCE_GRAIN, push_from_chunk, f);
    int64_t ground_x = 0, ground_y = 0;
    for (uint32_t c = 0; c < f->chunks; c++) {
        f->totals.pushers += pushes->totals[c].pushers;
        ground_x += pushes->totals[c].ground_x;
        ground_y += pushes->totals[c].ground_y;
        if (f->has_bodies)
            apply_body_pushes(f, c);
    }
    f->totals.ground_x = (double)ground_x / 1048576.0;
    f->totals.ground_y = (double)ground_y / 1048576.0;
    pushes->any = jox_transfers_sort(f) > 0;
    if (pushes->any)
        jox_transfers_sum(f, a->push_x, a->push_y);
}

void jox_pushes_start_step(JoxForces *f) {
    JoxPushes *pushes = f->pushes;
    const uint32_t n = f->step.agents->count;
    pushes->any = false;
    JOX_RESERVE(pushes->totals, pushes->total_capacity, f->chunks);
    if (n > pushes->reaction_capacity) {
        /* freshly allocated zeros take no memory until they are written */
        jox_free(pushes->reactions);
        pushes->reaction_capacity = n + n / 4;
        pushes->reactions = jox_alloc(pushes->reaction_capacity, sizeof *pushes->reactions);
    }
}

void jox_pushes_free(JoxPushes *pushes) {
    jox_chunks_free(&pushes->on_bodies);
    jox_free(pushes->reactions);
    jox_free(pushes->totals);
    jox_free(pushes);
}
