/* Snapshots of a report at the moments that story.c kept: where people stood, and the density. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/format/plurals.h"
#include "base/mem.h"
#include "picture/html.h"
#include "report/maps.h"

static bool is_same_moment(const JoxSubject *s, int a, int b) {
    const JoxMoment *m = s->story->moments;
    return m[a].taken && m[b].taken && m[a].time == m[b].time;
}

/* Writes the title of a moment's snapshot and its time. */
static void write_moment_names(const JoxSubject *s, int kind, char title[128], char when[64]) {
    const JoxMoment *m = &s->story->moments[kind];
    char people[JOX_NOUN];
    snprintf(when, 64, "%.1f s", m->time);
    if (kind == JOX_MOMENT_START)
        snprintf(title, 128, "At the start%s",
                 is_same_moment(s, JOX_MOMENT_DENSEST, kind) ? ": densest" : "");
    else if (kind == JOX_MOMENT_DENSEST)
        snprintf(title, 128, "Greatest density");
    else if (kind == JOX_MOMENT_HALF)
        snprintf(title, 128, "Half have left");
    else if (s->inside == 0)
        snprintf(title, 128, "The last %s inside", jox_noun(people, m->count, "person|people"));
    else
        snprintf(title, 128, "At the end: %s inside", jox_noun(people, m->count, "person|people"));
}

/* Returns a frame of the moment, whose columns free_moment_frame frees. */
static JoxFrame make_moment_frame(const JoxMoment *m) {
    uint32_t *key = jox_alloc(m->count + 1, sizeof *key);
    float *x = jox_alloc(7 * m->count + 1, sizeof *x);
    const bool radii = m->count && m->people[0].radius > 0.0f;
    for (size_t i = 0; i < m->count; i++) {
        const JoxMomentPerson *person = &m->people[i];
        key[i] = person->key;
        x[i] = person->x;
        x[m->count + i] = person->y;
        x[2 * m->count + i] = person->radius;
        x[4 * m->count + i] = person->axis_x;
        x[5 * m->count + i] = person->axis_y;
        x[6 * m->count + i] = person->contact_radius;
    }
    float *still = x + 3 * m->count; /* zero velocities: no headings are drawn */
    return (JoxFrame){.time = m->time,
                      .count = (uint32_t)m->count,
                      .key = key,
                      .x = x,
                      .y = x + m->count,
                      .vx = still,
                      .vy = still,
                      .radius = radii ? x + 2 * m->count : NULL,
                      .axis_x = x + 4 * m->count,
                      .axis_y = x + 5 * m->count,
                      .contact_radius = x + 6 * m->count};
}

static void free_moment_frame(JoxFrame *frame) {
    jox_free((void *)(uintptr_t)frame->key);
    jox_free((void *)(uintptr_t)frame->x);
}

/* Returns the walls with the gates as they were at the moment; the caller frees `rings`. */
static JoxWalls make_moment_walls(const JoxSubject *s, const JoxMoment *m) {
    JoxWalls walls = *s->walls;
    walls.rings = jox_alloc(walls.ring_count + 1, sizeof *walls.rings);
    for (uint32_t r = 0; r < walls.ring_count; r++) {
        walls.rings[r] = s->walls->rings[r];
        walls.rings[r].open = r < m->rings ? m->open[r] : walls.rings[r].open;
    }
    return walls;
}

static bool draw_moment(const JoxSubject *s, int kind, JoxText *error) {
    const JoxMoment *m = &s->story->moments[kind];
    char file[32], title[128], when[64];
    JoxFrame frame = make_moment_frame(m);
    JoxWalls walls = make_moment_walls(s, m);
    JoxPicture p = jox_maps_new_picture(s, &frame);
    write_moment_names(s, kind, title, when);
    snprintf(file, sizeof file, "snapshot-%d", kind + 1);
    p.title = title;
    p.when = when;
    p.panel = true;
    p.walls = &walls;
    p.cars = m->car_count == s->lift_count ? m->cars : NULL;
    p.bodies = m->bodies.items;
    p.body_count = (uint32_t)m->bodies.count;
    p.grid = s->grid;
    p.field = m->field;
    p.floor = JOX_SHOW_DENSITY;
    p.field_legend = "people per m\xc2\xb2 " JOX_DENSITY_BY;
    p.floor_most = jox_maps_scale_end((double)s->grid->most); /* all snapshots have one scale */
    const bool good = jox_maps_write_picture(s, &p, file, error);
    jox_free(walls.rings);
    free_moment_frame(&frame);
    return good;
}

/* Returns whether a moment gets a picture: it occurred and no other picture shows the same time. */
static bool is_moment_shown(const JoxSubject *s, int kind) {
    const JoxMoment *m = &s->story->moments[kind];
    return m->taken && m->cells == (size_t)s->grid->columns * s->grid->rows &&
           (kind == JOX_MOMENT_LAST || !is_same_moment(s, kind, JOX_MOMENT_LAST)) &&
           (kind != JOX_MOMENT_DENSEST || !is_same_moment(s, kind, JOX_MOMENT_START));
}

void jox_write_snapshots_html(FILE *out, const JoxSubject *s) {
    jox_maps_panels(out, s);
    for (int kind = 0; kind < JOX_MOMENTS; kind++) {
        char file[32], title[128], when[64], caption[320];
        if (!is_moment_shown(s, kind))
            continue;
        write_moment_names(s, kind, title, when);
        snprintf(file, sizeof file, "snapshot-%d", kind + 1);
        snprintf(caption, sizeof caption,
                 "%s, %s. Floor: density " JOX_DENSITY_BY ", cells of %.3g m", title, when,
                 (double)s->grid->cell);
        jox_html_figure(out, s->folder, file, caption, false);
    }
    jox_html_panels_end(out);
}

bool jox_draw_snapshots(const JoxSubject *s, JoxText *error) {
    bool good = true;
    for (int kind = 0; good && kind < JOX_MOMENTS; kind++)
        good = !is_moment_shown(s, kind) || draw_moment(s, kind, error);
    return good;
}
