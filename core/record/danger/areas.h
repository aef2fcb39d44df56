/* Levels of service by area and time: of polygons that have a name, such as rooms and platforms. At
   each sample of danger, the level of an area is Fruin's for queues at the mean, over the people in
   it, of the density where they stand; of an area that is empty there is none. */
#ifndef JOX_RECORD_DANGER_AREAS_H
#define JOX_RECORD_DANGER_AREAS_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "base/format/json_writer.h"
#include "base/sections.h"
#include "geom/place.h"
#include "record/danger/levels.h"
#include "record/frame.h"
#include "world/probe.h"

enum { JOX_DANGER_AREAS = 32 }; /* at most; further ones are not measured */

typedef struct JoxDangerAreaRow {
    double time;   /* s */
    float density; /* 1/m2: mean over the people there; NAN of none */
    uint32_t people;
    int32_t level; /* -1: nobody is there */
} JoxDangerAreaRow;

typedef struct JoxDangerArea {
    char *name;
    JoxV2 *points, low, high; /* m: the ring, and the box about it */
    uint32_t count;
    double surface; /* m2 */
    JoxDangerAreaRow *rows;
    uint32_t row_count, row_capacity;
    double level_s[JOX_LEVELS];  /* s at each level, over time */
    double person_s[JOX_LEVELS]; /* person-seconds there, by the density where each stands */
    uint32_t most_people;
    float most; /* 1/m2: greatest mean; NAN: nobody was ever there */
    double most_time;
    int32_t worst; /* level; -1: nobody was ever there */
} JoxDangerArea;

typedef struct JoxDangerAreas {
    JoxDangerArea *items;
    uint32_t count, capacity;
} JoxDangerAreas;

/* Polygons among the places, and areas of probes `measure`. Of two that have one outline the first
   is taken. */
void jox_danger_areas_add(JoxDangerAreas *areas, const JoxPlace *places, uint32_t place_count,
                          const JoxProbeDef *probes, uint32_t probe_count);
/* As jox_danger_lines_sample. */
void jox_danger_areas_sample(JoxDangerAreas *areas, const JoxFrame *frame, const float *density,
                             double duration);
/* Adds "areas": {...}; null without any. */
void jox_danger_areas_json(const JoxDangerAreas *areas, JoxJson *json);
void jox_danger_areas_csv(const JoxDangerAreas *areas, FILE *out);
void jox_danger_areas_sections(JoxDangerAreas *areas, JoxSections *sections);
void jox_danger_areas_free(JoxDangerAreas *areas);

#endif
