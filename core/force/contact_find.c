/* Who touches whom, and which walls. A contact is looked for a little before the discs meet: what
   would meet within the step is kept from moving into each other, so that people at rest neither
   overlap nor lose and find each other from step to step. */
#include <math.h>

#include "base/assert.h"
#include "force/internal.h"

static bool lists(const JoxNeighbours *near, uint32_t i, uint32_t other) {
    const uint32_t *index = near->touch_index + (size_t)i * JOX_MOST_NEIGHBOURS;
    for (uint32_t k = 0; k < near->touch_count[i]; k++)
        if (index[k] == other)
            return true;
    return false;
}

/* Whether more may be within touching range of an agent than its list holds. */
static bool is_cut(const JoxNeighbours *near, uint32_t i) {
    return near->touch_count && near->touch_count[i] == JOX_MOST_NEIGHBOURS;
}

/* N/m: what shoulders that are turned to each other press with, until the bodies themselves meet.
 */
static const float SQUEEZE = 2000.0f;

/* Two agents, if the gap between them may close within the step. */
static bool touches(const JoxForces *f, uint32_t i, uint32_t other, bool walls,
                    JoxFoundContact *out) {
    const JoxAgents *a = f->step.agents;
    JoxV2 offset = jox_offset(a, other, i);
    float distance2 = jox_length2(offset);
    const float *radius = a->param[JOX_PARAM_radius];
    float sum = a->breadth[i] + a->breadth[other];
    float whole = radius[i] + radius[other];
    float most = whole + JOX_TOUCH_LEAST + JOX_TOUCH_MOST;
    if (!(distance2 < most * most))
        return false;
    float distance = sqrtf(distance2), gap = distance - sum;
    float squeeze = SQUEEZE * jox_clampf(whole - distance, 0.0f, whole - sum);
    if (gap > JOX_TOUCH_LEAST && !(squeeze > 0.0f)) {
        JoxV2 towards = {a->vx[other] - a->vx[i], a->vy[other] - a->vy[i]};
        float closing = jox_length(towards) * (float)f->step.dt;
        if (gap > JOX_TOUCH_LEAST + jox_minf(JOX_TOUCH_MOST, closing))
            return false;
    }
    JoxV2 at = {a->x[i], a->y[i]};
    if (walls && jox_wall_grid_separates(f->step.walls, at, jox_sub(at, offset)))
        return false;
    JoxV2 normal = jox_unit(offset);
    if (normal.x == 0.0f && normal.y == 0.0f)
        normal.x = 1.0f; /* people in one place part along x */
    JOX_ASSERT(jox_is_unit(normal));
    *out = (JoxFoundContact){.other = other, .normal = normal, .squeeze = squeeze, .gap = gap};
    return true;
}

/* Those that agent i touches and it is for i to find, by ascending id: the one of lesser id finds a
   contact, or, in a heap of people where its list is cut, the other. */
static uint32_t find_people(const JoxForces *f, uint32_t i, bool walls, JoxFoundContact *out) {
    const JoxAgents *a = f->step.agents;
    const JoxNeighbours *near = f->step.neighbours;
    bool seen = !near->touch_count || near->touch_count[i] == JOX_TOUCH_IS_SEEN;
    float reach = a->param[JOX_PARAM_radius][i] + f->widest + JOX_TOUCH_LEAST + JOX_TOUCH_MOST;
    uint32_t count = seen ? near->count[i] : near->touch_count[i], found = 0;
    for (uint32_t k = 0; k < count; k++) {
        size_t at = jox_neighbour_at(near, i, k);
        if (seen && !(near->distance2[at] < reach * reach))
            break; /* nearest first: no one further on can touch */
        uint32_t other =
            seen ? near->index[at] : near->touch_index[(size_t)i * JOX_MOST_NEIGHBOURS + k];
        if (a->id[other] < a->id[i] && (!is_cut(near, other) || lists(near, other, i)))
            continue;
        JoxFoundContact contact;
        if (!touches(f, i, other, walls, &contact))
            continue;
        uint32_t place = found++;
        for (; place > 0 && a->id[out[place - 1].other] > a->id[other]; place--)
            out[place] = out[place - 1];
        out[place] = contact;
    }
    JOX_ASSERT(found <= JOX_MOST_NEIGHBOURS);
    return found;
}

/* The nearest point of an edge, if it is this edge's to touch: its inner points, and a convex
   corner seen from beyond both of its edges, which counts for the edge that it starts. */
static bool edge_contact(const JoxWalls *walls, uint32_t edge, JoxV2 p, JoxFoundContact *out) {
    const JoxWallVertex *a = &walls->vertices[edge], *b = &walls->vertices[a->next];
    if (jox_det(a->direction, jox_sub(p, a->point)) >= 0.0f)
        return false; /* on the inner side */
    float length = jox_length(jox_sub(b->point, a->point));
    float along = jox_dot(jox_sub(p, a->point), a->direction);
    if (along > length)
        return false; /* the next edge's start, or nobody's */
    JoxV2 at = jox_add(a->point, jox_scale(a->direction, jox_maxf(along, 0.0f)));
    if (along < 0.0f) {
        const JoxWallVertex *before = &walls->vertices[a->previous];
        JoxV2 from_start = jox_sub(p, before->point);
        float reached = jox_dot(from_start, before->direction);
        if (!a->convex || reached < jox_length(jox_sub(a->point, before->point)))
            return false;
    }
    JoxV2 out_of = jox_sub(p, at);
    float distance = jox_length(out_of);
    JoxV2 normal = distance > 1e-6f ? jox_scale(out_of, 1.0f / distance)
                                    : jox_scale(jox_left(a->direction), -1.0f);
    *out = (JoxFoundContact){
        .other = edge, .normal = normal, .gap = distance, .along = jox_maxf(along, 0.0f)};
    return true;
}

/* Edges that agent i touches, the nearest of them. */
static uint32_t find_walls(const JoxForces *f, uint32_t i, const uint32_t *edges, uint32_t count,
                           JoxFoundContact out[JOX_CONTACT_MOST_WALLS]) {
    const JoxAgents *a = f->step.agents;
    JoxV2 at = {a->x[i], a->y[i]};
    float radius = a->breadth[i];
    float closing = jox_length(jox_v2(a->vx[i], a->vy[i])) * (float)f->step.dt;
    float most = JOX_TOUCH_LEAST + jox_minf(JOX_TOUCH_MOST, closing);
    uint32_t found = 0;
    for (uint32_t k = 0; k < count; k++) {
        JoxFoundContact contact;
        if (!edge_contact(f->step.walls->walls, edges[k], at, &contact))
            continue;
        contact.gap -= radius;
        if (contact.gap > most)
            continue;
        uint32_t place = found < JOX_CONTACT_MOST_WALLS ? found++ : found;
        if (place == JOX_CONTACT_MOST_WALLS) {
            if (contact.gap >= out[place - 1].gap)
                continue;
            place--;
        }
        for (; place > 0 && out[place - 1].gap > contact.gap; place--)
            out[place] = out[place - 1];
        out[place] = contact;
    }
    return found;
}

static void keep(JoxChunkList *list, uint32_t chunk, const JoxFoundContact *found, uint32_t n) {
    JoxFoundContact *items = (JoxFoundContact *)list->items + (size_t)chunk * list->room;
    JOX_ASSERT(list->counts[chunk] + n <= list->room);
    for (uint32_t k = 0; k < n; k++)
        items[list->counts[chunk]++] = found[k];
}

static void find_chunk(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    JoxForces *f = context;
    const JoxAgents *a = f->step.agents;
    uint32_t chunk = begin / JOX_FORCE_GRAIN;
    JoxFoundContact found[JOX_MOST_NEIGHBOURS];
    for (uint32_t i = begin; i < end; i++) {
        uint32_t edges = 0;
        const uint32_t *edge = NULL;
        if (f->step.walls)
            edge = jox_wall_grid_at(f->step.walls, jox_v2(a->x[i], a->y[i]), &edges);
        f->found_first[i] = chunk * f->found.room + f->found.counts[chunk];
        f->found_number[i] = (uint8_t)find_people(f, i, edges > 0, found);
        keep(&f->found, chunk, found, f->found_number[i]);
        f->wall_first[i] = chunk * f->found_walls.room + f->found_walls.counts[chunk];
        f->wall_number[i] = edges ? (uint8_t)find_walls(f, i, edge, edges, found) : 0;
        keep(&f->found_walls, chunk, found, f->wall_number[i]);
    }
    if (f->bodies)
        jox_touches_find(f, begin, end);
}

void jox_contacts_find(JoxForces *f) {
    uint32_t n = f->step.agents->count;
    jox_chunks_begin(&f->found, f->chunks, JOX_FORCE_GRAIN * JOX_MOST_NEIGHBOURS,
                     sizeof(JoxFoundContact));
    jox_chunks_begin(&f->found_walls, f->chunks, JOX_FORCE_GRAIN * JOX_CONTACT_MOST_WALLS,
                     sizeof(JoxFoundContact));
    JOX_RESERVE(f->found_first, f->found_first_capacity, n);
    JOX_RESERVE(f->found_number, f->found_number_capacity, n);
    JOX_RESERVE(f->wall_first, f->wall_first_capacity, n);
    JOX_RESERVE(f->wall_number, f->wall_number_capacity, n);
    if (f->bodies) {
        jox_chunks_begin(&f->touches, f->chunks, JOX_FORCE_GRAIN * JOX_MOST_BODIES_TOUCHED,
                         sizeof(JoxTouch));
        JOX_RESERVE(f->touch_first, f->touch_first_capacity, n);
        JOX_RESERVE(f->touch_number, f->touch_number_capacity, n);
    }
    jox_parallel_for(f->step.pool, n, JOX_FORCE_GRAIN, find_chunk, f);
}
