#include "body/image.h"

#include <math.h>
#include <string.h>

#include "base/mem.h"

_Static_assert(sizeof(JoxBodyRecord) == 384, "a body's record has no padding");
_Static_assert(sizeof(JoxBodyPartRecord) == 104, "a part's record has no padding");
_Static_assert(sizeof(JoxBlockRecord) == 88, "a block's record has no padding");
_Static_assert(sizeof(JoxContactRecord) == 64, "a contact's record has no padding");
_Static_assert(sizeof(JoxBondRecord) == 24, "a bond's record has no padding");

enum { SPARE_ROWS = 1 << 16, SPARE_EACH = 8, MOST_POINTS = 256, LAST_ACTIVATION = 5 };

void jox_bodies_image_free(JoxBodiesImage *image) {
    jox_free(image->bodies);
    jox_free(image->parts);
    jox_free(image->points);
    jox_free(image->names);
    jox_free(image->path_points);
    jox_free(image->blocks);
    jox_free(image->bonds);
    jox_free(image->contacts);
    *image = (JoxBodiesImage){0};
}

void jox_bodies_image_sections(JoxBodiesImage *i, JoxSections *s) {
    jox_sections_module(s, "bodies");
    JOX_SECTION(s, "counters", i->counters);
    JOX_SECTION_ARRAY(s, "bodies", i->bodies, i->body_count, i->body_capacity);
    JOX_SECTION_ARRAY(s, "parts", i->parts, i->part_count, i->part_capacity);
    JOX_SECTION_ARRAY(s, "points", i->points, i->point_count, i->point_capacity);
    JOX_SECTION_ARRAY(s, "names", i->names, i->name_count, i->name_capacity);
    JOX_SECTION_ARRAY(s, "paths", i->path_points, i->path_point_count, i->path_point_capacity);
    JOX_SECTION_ARRAY(s, "blocks", i->blocks, i->block_count, i->block_capacity);
    JOX_SECTION_ARRAY(s, "bonds", i->bonds, i->bond_count, i->bond_capacity);
    JOX_SECTION_ARRAY(s, "contacts", i->contacts, i->contact_count, i->contact_capacity);
}

/* ---- bonds ---- */

void jox_bodies_image_add_bonds(JoxBodiesImage *image, JoxBodyRecord *record,
                                const JoxBondGraph *graph) {
    record->block_count = graph->count;
    record->bond_count = graph->bond_count;
    memcpy(record->low, graph->low, sizeof record->low);
    memcpy(record->range, graph->range, sizeof record->range);
    memcpy(record->block_size, graph->size, sizeof record->block_size);
    memcpy(record->origin, graph->origin, sizeof record->origin);
    record->block_mass = graph->block_mass;
    record->peak_load = graph->peak_load;
    JOX_RESERVE(image->blocks, image->block_capacity, image->block_count + graph->count);
    for (uint32_t n = 0; n < graph->count; n++) {
        JoxBlockRecord *to = &image->blocks[image->block_count++];
        *to = (JoxBlockRecord){0};
        memcpy(to->cell, graph->cell[n], sizeof to->cell);
        memcpy(to->impulse, graph->impulse[n], sizeof to->impulse);
        memcpy(to->load, graph->load[n], sizeof to->load);
        memcpy(to->displacement, graph->displacement[n], sizeof to->displacement);
    }
    JOX_RESERVE(image->bonds, image->bond_capacity, image->bond_count + graph->bond_count);
    for (uint32_t n = 0; n < graph->bond_count; n++) {
        const JoxBond *bond = &graph->bonds[n];
        image->bonds[image->bond_count++] =
            (JoxBondRecord){bond->a, bond->b, bond->axis, 0, bond->strength};
    }
}

JoxBondGraph *jox_bodies_image_bonds(const JoxBodiesImage *image, const JoxBodyRecord *record,
                                     uint32_t first_block, uint32_t first_bond) {
    JoxBondGraph *graph = jox_bonds_allocate(record->low, record->range, record->block_count);
    memcpy(graph->size, record->block_size, sizeof graph->size);
    memcpy(graph->origin, record->origin, sizeof graph->origin);
    graph->block_mass = record->block_mass;
    graph->peak_load = record->peak_load;
    graph->bond_count = record->bond_count;
    for (uint32_t n = 0; n < graph->count; n++) {
        const JoxBlockRecord *from = &image->blocks[first_block + n];
        memcpy(graph->cell[n], from->cell, sizeof from->cell);
        memcpy(graph->impulse[n], from->impulse, sizeof from->impulse);
        memcpy(graph->load[n], from->load, sizeof from->load);
        memcpy(graph->displacement[n], from->displacement, sizeof from->displacement);
    }
    for (uint32_t n = 0; n < graph->bond_count; n++) {
        const JoxBondRecord *from = &image->bonds[first_bond + n];
        graph->bonds[n] = (JoxBond){from->a, from->b, from->axis, from->strength};
    }
    jox_bonds_index(graph);
    return graph;
}

/* ---- validity ---- */

static bool are_floats_finite(const float *values, uint32_t count) {
    bool finite = true;
    for (uint32_t i = 0; i < count; i++)
        finite &= isfinite(values[i]) != 0;
    return finite;
}

static bool are_doubles_finite(const double *values, uint32_t count) {
    bool finite = true;
    for (uint32_t i = 0; i < count; i++)
        finite &= isfinite(values[i]) != 0;
    return finite;
}

/* Whether a record's blocks lie in distinct cells within the range, and its bonds join two of
   them. */
static bool graph_is_sound(const JoxBodiesImage *image, const JoxBodyRecord *r,
                           uint32_t first_block, uint32_t first_bond) {
    uint64_t cells = 1;
    bool sound = r->block_count <= JOX_BONDS_MOST_BLOCKS && r->bond_count <= 3 * r->block_count &&
                 r->block_mass > 0.0 && isfinite(r->block_mass) && are_doubles_finite(r->origin, 3);
    for (int i = 0; i < 3; i++) {
        sound = sound && r->block_size[i] > 0.0 && isfinite(r->block_size[i]) && r->range[i] > 0 &&
                r->range[i] <= JOX_BONDS_MOST_BLOCKS && r->low[i] <= JOX_BONDS_MOST_BLOCKS;
        cells = sound ? cells * r->range[i] : 0;
    }
    if (!sound || cells > JOX_BONDS_MOST_BLOCKS)
        return false;
    uint8_t *filled = jox_alloc(cells, 1);
    for (uint32_t n = 0; n < r->block_count && sound; n++) {
        const JoxBlockRecord *block = &image->blocks[first_block + n];
        uint64_t at = 0;
        for (int i = 2; i >= 0 && sound; i--) {
            sound = block->cell[i] >= r->low[i] && block->cell[i] - r->low[i] < r->range[i];
            at = at * r->range[i] + block->cell[i] - r->low[i];
        }
        sound = sound && !filled[at] && are_doubles_finite(block->impulse, 3) &&
                are_doubles_finite(block->load, 3) && are_doubles_finite(block->displacement, 3);
        if (sound)
            filled[at] = 1;
    }
    jox_free(filled);
    for (uint32_t n = 0; n < r->bond_count && sound; n++) {
        const JoxBondRecord *bond = &image->bonds[first_bond + n];
        sound = bond->a < bond->b && bond->b < r->block_count && bond->axis < 3 &&
                bond->strength > 0.0 && isfinite(bond->strength);
    }
    return sound;
}

/* Numbers of items of all bodies, which must equal the lengths of the arrays. */
typedef struct Totals {
    uint64_t names, parts, points, blocks, bonds, paths;
} Totals;

/* Whether a record whose path points start at index `first` has a valid path. */
static bool path_is_sound(const JoxBodiesImage *image, const JoxBodyRecord *r, uint64_t first) {
    if (first + 3 * (uint64_t)r->path_count > image->path_point_count)
        return false;
    const JoxBodyPath path = {image->path_points + first,
                              r->path_count,
                              r->path_end,
                              r->path_speed,
                              r->path_after,
                              r->path_wait,
                              (r->drive & JOX_DRIVE_REOPENS) != 0};
    return r->path_count <= JOX_PATH_POINTS && r->still == JOX_BODY_KINEMATIC &&
           !jox_path_find_fault(&path) && r->path_time >= 0.0 && isfinite(r->path_time) &&
           r->path_back <= 1;
}

static bool are_floats_within(const float *values, uint32_t count, float most) {
    bool within = true;
    for (uint32_t i = 0; i < count; i++)
        within &= fabsf(values[i]) <= most;
    return within;
}

/* Whether the position and velocity of a kinematic body are within bounds: Bullet finds contacts
   at its new position before the guard sees it there. */
static bool motion_is_sound(const JoxBodyRecord *r) {
    return r->still != JOX_BODY_KINEMATIC || (are_floats_within(r->motion + 9, 3, 1e4f) &&
                                              are_floats_within(r->motion + 24, 6, 500.0f));
}

static bool drive_is_sound(const JoxBodyRecord *r) {
    const uint32_t flags = JOX_DRIVE_REOPENS | JOX_DRIVE_ENDS | JOX_DRIVE_MET;
    if (r->still != JOX_BODY_KINEMATIC)
        return r->force_limit == 0.0 && r->held_up == 0.0 && r->drive == 0;
    return r->force_limit >= 0.0 && r->force_limit <= 1e6 && r->held_up >= 0.0 &&
           r->held_up <= 1.0 && r->drive <= flags &&
           (r->force_limit > 0.0 || !(r->drive & JOX_DRIVE_REOPENS));
}

static bool record_is_sound(const JoxBodiesImage *image, uint32_t n, uint8_t *taken) {
    const JoxBodyRecord *r = &image->bodies[n];
    if (r->row >= image->counters.row_count || taken[r->row] || r->id >= image->counters.next_id ||
        (n > 0 && r->id <= image->bodies[n - 1].id))
        return false;
    taken[r->row] = 1;
    return r->still <= JOX_BODY_KINEMATIC && r->held <= 1 && r->grounded <= 1 && r->swept <= 1 &&
           !(r->still && (r->held || r->block_count)) && r->activation >= 1 &&
           r->activation <= LAST_ACTIVATION && r->part_count >= 1 && r->part_count <= 4096 &&
           (r->bond_count == 0) == (r->block_count == 0) && motion_is_sound(r) &&
           drive_is_sound(r) && are_floats_finite(r->motion, JOX_BODY_MOTION) &&
           are_floats_finite(&r->deactivation_time, 1) && are_floats_finite(r->material, 4) &&
           are_floats_finite(r->force, 3);
}

static bool bodies_are_sound(const JoxBodiesImage *image) {
    Totals t = {0};
    uint8_t *taken = jox_alloc((size_t)image->counters.row_count + 1, 1);
    bool sound = true;
    for (uint32_t n = 0; n < image->body_count && sound; n++) {
        const JoxBodyRecord *r = &image->bodies[n];
        sound = record_is_sound(image, n, taken);
        if (sound && r->block_count && t.blocks + r->block_count <= image->block_count &&
            t.bonds + r->bond_count <= image->bond_count)
            sound = graph_is_sound(image, r, (uint32_t)t.blocks, (uint32_t)t.bonds);
        if (sound && r->path_count)
            sound = path_is_sound(image, r, t.paths);
        t.paths += 3 * (uint64_t)r->path_count;
        t.names += r->name_length;
        t.parts += r->part_count;
        t.blocks += r->block_count;
        t.bonds += r->bond_count;
    }
    jox_free(taken);
    for (uint32_t n = 0; n < image->part_count && sound; n++) {
        const JoxBodyPartRecord *part = &image->parts[n];
        sound = part->kind <= JOX_SHAPE_HULL && part->point_count <= MOST_POINTS &&
                (part->kind == JOX_SHAPE_HULL) == (part->point_count > 0);
        t.points += 3 * (uint64_t)part->point_count;
    }
    return sound && t.names == image->name_count && t.parts == image->part_count &&
           t.points == image->point_count && t.blocks == image->block_count &&
           t.bonds == image->bond_count && t.paths == image->path_point_count;
}

static bool contacts_are_sound(const JoxBodiesImage *image) {
    for (uint32_t n = 0; n < image->contact_count; n++) {
        const JoxContactRecord *c = &image->contacts[n];
        if (!are_floats_finite(c->points[0], 3) || !are_floats_finite(c->points[1], 3) ||
            !are_floats_finite(c->normal, 3) || !are_floats_finite(c->impulse, 3))
            return false;
    }
    return true;
}

bool jox_bodies_image_check(const JoxBodiesImage *image, JoxText *error) {
    const uint64_t rows = image->counters.row_count;
    bool sound = image->body_count <= rows && rows <= image->counters.next_id &&
                 /* bounds the memory for rows of removed bodies */
                 rows <= SPARE_ROWS + (uint64_t)SPARE_EACH * image->body_count &&
                 isfinite(image->counters.last_dt) && contacts_are_sound(image) &&
                 bodies_are_sound(image);
    if (!sound && error)
        jox_text_add(error, "the bodies of the saved state contradict each other");
    return sound;
}
