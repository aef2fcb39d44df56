/* Levels of service of named areas over time, such as rooms and platforms. At each sample of danger
   the density of an area is the mean, over the people inside, of the density where they stand; its
   level is Fruin's level for queues at that density. An empty area has no level. danger.c owns and
   feeds them. */
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

enum { JOX_DANGER_AREAS = 32 }; /* most areas; further ones are ignored */

typedef struct JoxDangerAreaRow {
    double time;   /* s */
    float density; /* 1/m2: mean over the people inside; NAN if there are none */
    uint32_t people;
    int32_t level; /* index in jox_levels; -1: empty */
} JoxDangerAreaRow;

typedef struct JoxDangerArea {
    char *name;
    JoxV2 *points, low, high; /* m: the polygon and its bounding box */
    uint32_t count;
    double surface; /* m2 */
    JoxDangerAreaRow *rows;
    uint32_t row_count, row_capacity;
    double level_s[JOX_LEVELS]; /* s: time at each level */
    /* person-seconds at each level, by the density where each person stands */
    double person_s[JOX_LEVELS];
    uint32_t most_people;
    float most; /* 1/m2: greatest mean; NAN: always empty */
    double most_time;
    int32_t worst; /* worst level so far; -1: always empty */
} JoxDangerArea;

typedef struct JoxDangerAreas {
    JoxDangerArea *items;
    uint32_t count, capacity;
} JoxDangerAreas;

/* Adds the polygons among the places and the areas of probes `measure`. Of two with the same
   outline the first is kept. */
void jox_danger_areas_add(JoxDangerAreas *areas, const JoxPlace *places, uint32_t place_count,
                          const JoxProbeDef *probes, uint32_t probe_count);
/* Takes a sample; the arguments are those of jox_danger_lines_sample. */
void jox_danger_areas_sample(JoxDangerAreas *areas, const JoxFrame *frame, const float *density,
                             double duration);
/* Writes "areas": {...}, or null if there are none. */
void jox_danger_areas_json(const JoxDangerAreas *areas, JoxJson *json);
void jox_danger_areas_csv(const JoxDangerAreas *areas, FILE *out);
void jox_danger_areas_sections(JoxDangerAreas *areas, JoxSections *sections);
void jox_danger_areas_free(JoxDangerAreas *areas);

#endif
