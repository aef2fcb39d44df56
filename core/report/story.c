#include "report/story.h"

#include <string.h>

#include "base/mem.h"

/* Copies the outlines of the sample's bodies into a moment. */
static void copy_bodies(JoxMoment *m, const JoxStorySample *sample) {
    m->bodies.count = 0;
    jox_draw_add_bodies(&m->bodies, sample->bodies);
    if (sample->body_reader)
        jox_draw_add_recorded(&m->bodies, sample->body_reader, sample->frame->time);
    for (size_t b = 0; b < m->bodies.count; b++)
        m->bodies.items[b].name = NULL; /* the names' owner may be freed before the story */
}

static JoxMomentPerson get_moment_person(const JoxFrame *frame, uint32_t i) {
    JoxMomentPerson person = {.key = frame->key[i],
                              .x = frame->x[i],
                              .y = frame->y[i],
                              .radius = jox_frame_radius(frame, i, 0.0f)};
    if (frame->axis_x) {
        person.axis_x = frame->axis_x[i];
        person.axis_y = frame->axis_y[i];
        person.contact_radius = frame->contact_radius[i];
    }
    return person;
}

/* Copies a sample into a moment. */
static void store_moment(JoxMoment *m, const JoxStorySample *sample) {
    const JoxFrame *frame = sample->frame;
    const JoxDensity *grid = sample->grid;
    const JoxWalls *walls = sample->walls;
    const size_t cells = (size_t)grid->columns * grid->rows;
    m->taken = true;
    m->time = frame->time;
    m->left = sample->left;
    JOX_RESERVE(m->people, m->capacity, frame->count);
    for (m->count = 0; m->count < frame->count; m->count++)
        m->people[m->count] = get_moment_person(frame, (uint32_t)m->count);
    JOX_RESERVE(m->field, m->cell_capacity, cells);
    memcpy(m->field, grid->now, cells * sizeof *m->field);
    m->cells = cells;
    JOX_RESERVE(m->open, m->ring_capacity, walls->ring_count);
    for (m->rings = 0; m->rings < walls->ring_count; m->rings++)
        m->open[m->rings] = walls->rings[m->rings].open;
    JOX_RESERVE(m->cars, m->car_capacity, frame->lift_count);
    for (m->car_count = 0; m->car_count < frame->lift_count; m->car_count++)
        m->cars[m->car_count] = frame->cars[m->car_count];
    copy_bodies(m, sample);
}

void jox_story_add_sample(JoxStory *story, const JoxStorySample *sample) {
    const JoxFrame *frame = sample->frame;
    const JoxDensity *grid = sample->grid;
    float most = 0.0f;
    bool takes[JOX_MOMENTS] = {false};
    if (frame->count > 0)
        for (size_t c = 0; c < (size_t)grid->columns * grid->rows; c++)
            most = grid->now[c] > most ? grid->now[c] : most;
    const bool half = sample->left > 0 && sample->left >= frame->count;
    takes[JOX_MOMENT_START] = frame->count > 0 && !story->moments[JOX_MOMENT_START].taken;
    takes[JOX_MOMENT_DENSEST] = most > story->most;
    takes[JOX_MOMENT_HALF] = frame->count > 0 && half && !story->half;
    takes[JOX_MOMENT_LAST] = frame->count > 0;
    for (int m = 0; m < JOX_MOMENTS; m++)
        if (takes[m])
            store_moment(&story->moments[m], sample);
    story->most = most > story->most ? most : story->most;
    story->half = half;
}

void jox_story_sections(JoxStory *story, JoxSections *s) {
    for (int k = 0; k < JOX_MOMENTS; k++) {
        JoxMoment *m = &story->moments[k];
        JOX_SECTION(s, "taken", m->taken);
        JOX_SECTION(s, "time", m->time);
        JOX_SECTION(s, "left", m->left);
        JOX_SECTION_ARRAY(s, "people", m->people, m->count, m->capacity);
        JOX_SECTION_ARRAY(s, "field", m->field, m->cells, m->cell_capacity);
        JOX_SECTION_ARRAY(s, "open", m->open, m->rings, m->ring_capacity);
        JOX_SECTION_ARRAY(s, "bodies", m->bodies.items, m->bodies.count, m->bodies.capacity);
        JOX_SECTION_ARRAY(s, "cars", m->cars, m->car_count, m->car_capacity);
    }
    JOX_SECTION(s, "most", story->most);
    JOX_SECTION(s, "half", story->half);
}

void jox_story_free(JoxStory *story) {
    for (int k = 0; k < JOX_MOMENTS; k++) {
        jox_free(story->moments[k].people);
        jox_free(story->moments[k].field);
        jox_free(story->moments[k].open);
        jox_free(story->moments[k].cars);
        jox_free(story->moments[k].bodies.items);
    }
}
