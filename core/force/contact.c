/* Equation 6: contacts between agents, and the passes over all contacts. Split masses make the
   passes converge with every contact solved at once, so that no order of contacts exists. */
#include <math.h>

#include "base/assert.h"
#include "base/mem.h"
#include "force/equations.h"
#include "force/internal.h"

/* Whether `other` sees agent i, `distance2` away: pairs are entered once, by the one of lesser id
   if both see. Whoever is nearer than the farthest one seen is seen. */
static bool sees(const JoxNeighbours *near, uint32_t other, uint32_t i, float distance2) {
    uint32_t count = near->count[other];
    if (count && distance2 < near->distance2[jox_neighbour_at(near, other, count - 1)])
        return true;
    for (uint32_t k = count; k-- > 0;)
        if (near->index[jox_neighbour_at(near, other, k)] == i)
            return true;
    return false;
}

/* The normal is the first's, which has the lesser id; people in one place part along x. */
static JoxPair make_pair(const JoxAgents *a, uint32_t i, uint32_t k) {
    uint32_t first = a->id[i] < a->id[k] ? i : k, second = first == i ? k : i;
    JoxV2 normal = jox_unit(jox_offset(a, second, first));
    if (normal.x == 0.0f && normal.y == 0.0f)
        normal.x = 1.0f;
    JOX_ASSERT(first != second && a->id[first] < a->id[second]);
    JOX_ASSERT(jox_is_unit(normal));
    return (JoxPair){.first = first, .second = second, .nx = normal.x, .ny = normal.y};
}

static float pair_speed(const JoxPair *p, const float *vx, const float *vy) {
    return (vx[p->first] - vx[p->second]) * p->nx + (vy[p->first] - vy[p->second]) * p->ny;
}

static void find_chunk(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    JoxForces *f = context;
    const JoxAgents *a = f->step.agents;
    const JoxNeighbours *near = f->step.neighbours;
    const float *radius = a->param[JOX_PARAM_radius];
    uint32_t chunk = begin / JOX_FORCE_GRAIN, count = 0, approaching = 0;
    JoxPair *list = (JoxPair *)f->pairs.items + (size_t)chunk * f->pairs.room;
    for (uint32_t i = begin; i < end; i++) {
        float widest = radius[i] + f->widest;
        for (uint32_t k = 0; k < near->count[i]; k++) {
            size_t at = jox_neighbour_at(near, i, k);
            float distance2 = near->distance2[at];
            if (!(distance2 < widest * widest))
                break; /* nearest first: no one further on can touch */
            uint32_t other = near->index[at];
            float touch = radius[i] + radius[other];
            if (!(distance2 < touch * touch) ||
                (a->id[i] > a->id[other] && sees(near, other, i, distance2)))
                continue;
            list[count] = make_pair(a, i, other);
            approaching += pair_speed(&list[count], a->vx, a->vy) < 0.0f;
            count++;
        }
    }
    JOX_ASSERT(count <= f->pairs.room && approaching <= count);
    f->pairs.counts[chunk] = count;
    f->chunk[chunk].approaching = approaching;
    if (f->bodies)
        jox_touches_find(f, begin, end);
}

typedef void PairVisitor(JoxForces *f, JoxPair *pair, uint32_t at);

static void visit_pairs(JoxForces *f, PairVisitor *visit) {
    for (uint32_t c = 0; c < f->chunks; c++) {
        uint32_t first = c * f->pairs.room;
        for (uint32_t k = 0; k < f->pairs.counts[c]; k++)
            visit(f, (JoxPair *)f->pairs.items + first + k, first + k);
    }
}

static void count_ends(JoxForces *f, JoxPair *pair, uint32_t at) {
    (void)at;
    f->starts[pair->first]++;
    f->starts[pair->second]++;
}

static void enter_ends(JoxForces *f, JoxPair *pair, uint32_t at) {
    const uint32_t *id = f->step.agents->id;
    f->ends[--f->starts[pair->first]] = (JoxEnd){id[pair->second], at};
    f->ends[--f->starts[pair->second]] = (JoxEnd){id[pair->first], at};
}

/* Each agent's ends of pairs, side by side; also counts its contacts. */
static void join_ends(JoxForces *f) {
    JoxAgents *a = f->step.agents;
    for (uint32_t i = 0; i <= a->count; i++)
        f->starts[i] = 0;
    visit_pairs(f, count_ends);
    uint32_t sum = 0;
    for (uint32_t i = 0; i <= a->count; i++) {
        uint32_t ends = i < a->count ? f->starts[i] : 0;
        if (ends) {
            uint32_t contacts = a->contacts[i] + ends;
            a->contacts[i] = (uint8_t)(contacts < UINT8_MAX ? contacts : UINT8_MAX);
        }
        sum += ends;
        f->starts[i] = sum;
    }
    uint32_t room =
        8 * f->step.agents->count; /* a dense crowd's, so that no steady step grows it */
    JOX_RESERVE(f->ends, f->end_capacity, sum > room ? sum : room);
    visit_pairs(f, enter_ends);
    JOX_ASSERT(sum == 2 * f->totals.pairs);
    JOX_ASSERT(f->starts[0] == 0 && f->starts[a->count] == sum);
}

/* Before the first pass: restitution, split masses. */
static void prepare_pairs(JoxForces *f, uint32_t chunk) {
    const JoxAgents *a = f->step.agents;
    const float *mass = a->param[JOX_PARAM_mass], *e = a->param[JOX_PARAM_restitution];
    JoxPair *list = (JoxPair *)f->pairs.items + (size_t)chunk * f->pairs.room;
    for (uint32_t k = 0; k < f->pairs.counts[chunk]; k++) {
        JoxPair *p = &list[k];
        float speed = pair_speed(p, a->vx, a->vy);
        p->stiff = 1.0f / ((float)a->contacts[p->first] / mass[p->first] +
                           (float)a->contacts[p->second] / mass[p->second]);
        p->bounce = speed < 0.0f ? -jox_minf(e[p->first], e[p->second]) * speed : 0.0f;
        JOX_ASSERT(p->stiff > 0.0f && a->contacts[p->first] && a->contacts[p->second]);
    }
}

static void order_ends(JoxEnd *ends, uint32_t count) {
    for (uint32_t i = 1; i < count; i++) {
        JoxEnd moved = ends[i];
        uint32_t j = i;
        for (; j > 0 && ends[j - 1].other_id > moved.other_id; j--)
            ends[j] = ends[j - 1];
        ends[j] = moved;
    }
}

static void start_chunk(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    JoxForces *f = context;
    const JoxAgents *a = f->step.agents;
    for (uint32_t i = begin; i < end; i++) {
        f->work_x[i] = a->vx[i];
        f->work_y[i] = a->vy[i];
        order_ends(f->ends + f->starts[i], f->starts[i + 1] - f->starts[i]);
    }
    prepare_pairs(f, begin / JOX_FORCE_GRAIN);
}

static void pass_chunk(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    (void)end;
    JoxForces *f = context;
    uint32_t chunk = begin / JOX_FORCE_GRAIN;
    JoxPair *list = (JoxPair *)f->pairs.items + (size_t)chunk * f->pairs.room;
    for (uint32_t k = 0; k < f->pairs.counts[chunk]; k++) {
        JoxPair *p = &list[k];
        float change = (p->bounce - pair_speed(p, f->work_x, f->work_y)) * p->stiff;
        p->impulse = jox_maxf(0.0f, p->impulse + change);
    }
}

/* Sum of the impulses that agent i has received so far from agents; their sizes in *size. */
static JoxV2 received(const JoxForces *f, uint32_t i, float *size) {
    JoxV2 sum = {0.0f, 0.0f};
    const JoxPair *pairs = f->pairs.items;
    *size = 0.0f;
    for (uint32_t k = f->starts[i]; k < f->starts[i + 1]; k++) {
        const JoxPair *p = &pairs[f->ends[k].pair];
        JOX_ASSERT(p->first == i || p->second == i);
        float signed_impulse = p->first == i ? p->impulse : -p->impulse;
        sum.x += signed_impulse * p->nx;
        sum.y += signed_impulse * p->ny;
        *size += p->impulse;
    }
    return sum;
}

static void move_chunk(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    JoxForces *f = context;
    const JoxAgents *a = f->step.agents;
    const float *mass = a->param[JOX_PARAM_mass];
    for (uint32_t i = begin; i < end; i++) {
        if (!a->contacts[i])
            continue;
        float size;
        JoxV2 sum = received(f, i, &size);
        if (f->touch_count)
            for (uint32_t t = 0; t < f->touch_number[i]; t++) {
                const JoxTouch *touch = &f->touch[f->first_touch[i] + t];
                sum.x += touch->normal.x * touch->impulse;
                sum.y += touch->normal.y * touch->impulse;
            }
        f->work_x[i] = a->vx[i] + sum.x / mass[i];
        f->work_y[i] = a->vy[i] + sum.y / mass[i];
    }
}

static void finish_chunk(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    JoxForces *f = context;
    JoxAgents *a = f->step.agents;
    float per_second = 1.0f / (float)f->step.dt;
    for (uint32_t i = begin; i < end; i++) {
        if (!a->contacts[i])
            continue;
        float size;
        JoxV2 sum = received(f, i, &size);
        a->contact_x[i] = sum.x * per_second;
        a->contact_y[i] = sum.y * per_second;
        a->compression[i] += size * per_second / jox_circumference(a->param[JOX_PARAM_radius][i]);
    }
}

/* Room for a step; `touches` and the agents' numbers of them matter only where there are bodies. */
static void prepare(JoxForces *f) {
    uint32_t n = f->step.agents->count, stride = f->step.neighbours->stride;
    jox_chunks_begin(&f->pairs, f->chunks, JOX_FORCE_GRAIN * (stride ? stride : 1),
                     sizeof(JoxPair));
    JOX_RESERVE(f->work_x, f->work_x_capacity, n);
    JOX_RESERVE(f->work_y, f->work_y_capacity, n);
    if (!f->bodies)
        return;
    jox_chunks_begin(&f->touches, f->chunks, JOX_FORCE_GRAIN * JOX_FORCE_MOST_TOUCHES,
                     sizeof(JoxTouch));
    JOX_RESERVE(f->first_touch, f->first_touch_capacity, n);
    JOX_RESERVE(f->touch_number, f->touch_number_capacity, n);
}

static void each_chunk(JoxForces *f, JoxTask *task) {
    jox_parallel_for(f->step.pool, f->step.agents->count, JOX_FORCE_GRAIN, task, f);
}

static void solve_contacts(JoxForces *f) {
    jox_touches_prepare(f);
    for (uint32_t pass = 0; pass < f->options.iterations; pass++) {
        each_chunk(f, pass_chunk);
        jox_touches_pass(f);
        each_chunk(f, move_chunk);
    }
}

void jox_force_contact(JoxForces *f) {
    prepare(f);
    each_chunk(f, find_chunk);
    uint32_t approaching = 0;
    for (uint32_t c = 0; c < f->chunks; c++) {
        f->totals.pairs += f->pairs.counts[c];
        approaching += f->chunk[c].approaching;
    }
    if (f->bodies)
        jox_touches_collect(f);
    if (!f->totals.pairs && !f->touch_count)
        return;
    join_ends(f);
    if (!approaching && !f->touch_count)
        return;
    each_chunk(f, start_chunk);
    if (f->options.literal)
        jox_literal_contacts(f);
    else
        solve_contacts(f);
    each_chunk(f, finish_chunk);
    JOX_CHECK(jox_contacts_check(f));
    jox_touches_finish(f);
}
