#include "report/story.h"

#include <string.h>

#include "base/mem.h"

static void take(JoxMoment *m, const JoxFrame *frame, const JoxDensity *grid, const JoxWalls *walls,
                 uint64_t left) {
    const size_t cells = (size_t)grid->columns * grid->rows;
    m->taken = true;
    m->time = frame->time;
    m->left = left;
    JOX_RESERVE(m->people, m->capacity, frame->count);
    for (m->count = 0; m->count < frame->count; m->count++)
        m->people[m->count] =
            (JoxMomentPerson){frame->key[m->count], frame->x[m->count], frame->y[m->count],
                              frame->radius ? frame->radius[m->count] : 0.0f};
    JOX_RESERVE(m->field, m->cell_capacity, cells);
    memcpy(m->field, grid->now, cells * sizeof *m->field);
    m->cells = cells;
    JOX_RESERVE(m->open, m->ring_capacity, walls->ring_count);
    for (m->rings = 0; m->rings < walls->ring_count; m->rings++)
        m->open[m->rings] = walls->rings[m->rings].open;
}

void jox_story_sample(JoxStory *story, const JoxFrame *frame, const JoxDensity *grid,
                      const JoxWalls *walls, uint64_t left) {
    float most = 0.0f;
    bool takes[JOX_MOMENTS] = {false};
    if (frame->count > 0)
        for (size_t c = 0; c < (size_t)grid->columns * grid->rows; c++)
            most = grid->now[c] > most ? grid->now[c] : most;
    const bool half = left > 0 && left >= frame->count;
    takes[JOX_MOMENT_START] = frame->count > 0 && !story->moments[JOX_MOMENT_START].taken;
    takes[JOX_MOMENT_DENSEST] = most > story->most;
    takes[JOX_MOMENT_HALF] = frame->count > 0 && half && !story->half;
    takes[JOX_MOMENT_LAST] = frame->count > 0;
    for (int m = 0; m < JOX_MOMENTS; m++)
        if (takes[m])
            take(&story->moments[m], frame, grid, walls, left);
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
    }
    JOX_SECTION(s, "most", story->most);
    JOX_SECTION(s, "half", story->half);
}

void jox_story_free(JoxStory *story) {
    for (int k = 0; k < JOX_MOMENTS; k++) {
        jox_free(story->moments[k].people);
        jox_free(story->moments[k].field);
        jox_free(story->moments[k].open);
    }
}
