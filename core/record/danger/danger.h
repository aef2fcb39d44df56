/* Measures where people are squeezed, over the frames of a run or of a recording:

   - density: people per m2 by the Gaussian kernel, R = 1 m, within the walls (fields/density.h)
   - Voronoi density: one over the area of a person's cell within 1 m (fields/voronoi_people.h)
   - pressure: crowd pressure, 1/s2 (fields/pressure.h), where it is measured
   - compression: sum of the contact force magnitudes on a person over the circumference, N/m
   - load: greatest push on a person from any one direction, N: over directions d, the greatest sum
     of the positive parts of f.d over the contacts f. Published limits for chests are such forces
   - dose: accumulated load, as a share of the time until death is estimated (jox_danger_dose_text)

   Compression and load are exponential means over 1 s for each person: sustained pushes, not the
   knock of one step. It also collects levels of service (levels.h), congestion (congestion.h), flow
   over lines (line_counts.h), loads on walls (wall_loads.h) and when people left (leaving.h).

   A run or an analysis of a recording creates one, adds lines and areas, gives each frame by
   jox_danger_frame, and at the end reads the figures or writes the JSON of the summary. */
#ifndef JOX_RECORD_DANGER_H
#define JOX_RECORD_DANGER_H

#include <stdbool.h>

#include "base/format/json_writer.h"
#include "base/sections.h"
#include "base/text.h"
#include "geom/place.h"
#include "geom/walls.h"
#include "record/frame.h"
#include "record/local_samples.h"
#include "world/exits.h"
#include "world/probe.h"

typedef enum JoxDangerMeasure {
    JOX_DANGER_DENSITY,
    JOX_DANGER_PRESSURE,
    JOX_DANGER_COMPRESSION,
    JOX_DANGER_LOAD,
    JOX_DANGER_MAPPED, /* measures before this one are drawn on maps */
    JOX_DANGER_DOSE = JOX_DANGER_MAPPED,
    JOX_DANGER_VORONOI, /* per person, at samples only */
    JOX_DANGER_MEASURES
} JoxDangerMeasure;
extern const char *const jox_danger_names[JOX_DANGER_MEASURES];  /* "density", ... */
extern const char *const jox_danger_units[JOX_DANGER_MEASURES];  /* "1/m2", ... */
extern const char *const jox_danger_titles[JOX_DANGER_MEASURES]; /* titles for reports */

/* A published limit of a measure. */
typedef struct JoxDangerLimit {
    const char *key;   /* key in summaries */
    const char *title; /* title for reports */
    JoxDangerMeasure measure;
    double value;       /* in the measure's unit */
    const char *what;   /* consequence in a crowd */
    const char *source; /* publication */
} JoxDangerLimit;
enum { JOX_DANGER_LIMITS = 9 };
extern const JoxDangerLimit jox_danger_limits[JOX_DANGER_LIMITS];
/* Returns the lowest limit of a measure; NAN if it has none. */
double jox_danger_lowest_limit(JoxDangerMeasure measure);
/* Explanation of the dose, for reports. */
extern const char jox_danger_dose_text[];

/* Returns the time at which the last person left, s; NAN while `inside` > 0 or if nobody left. */
double jox_exits_clearance(const JoxExits *exits, uint32_t inside);
/* Writes "left": ..., "inside": ..., "last_left_s": ..., "clearance_s": ..., "exits": {...}. */
void jox_exits_json(const JoxExits *exits, uint32_t inside, JoxJson *json);

typedef struct JoxDangerCount {
    uint32_t people; /* people who were over the limit at any time */
    double person_s; /* person-seconds over it */
    double longest;  /* s: total time over it of the person who was over it longest */
    double first;    /* s: first time over it; NAN: never */
    JoxV2 first_at;  /* m: place of that */
} JoxDangerCount;
typedef struct JoxDangerMost {
    double value, time; /* time in s; both NAN if the measure was never read */
    uint32_t person;    /* key of the person; valid for measures of persons */
    JoxV2 at;           /* m */
} JoxDangerMost;

typedef struct JoxDanger JoxDanger;
/* Creates one with local densities of its own; `low` to `high` is the area of fields and maps, m,
   of all storeys if they are given (local_samples.h). */
JoxDanger *jox_danger_create(JoxV2 low, JoxV2 high, const JoxStoreys *storeys);
/* Creates one on local densities of the caller, which gives each frame to `local` first. */
JoxDanger *jox_danger_create_on(JoxLocal *local);
/* Adds a line to measure, such as a door (line_counts.h), before the first frame. */
void jox_danger_add_line(JoxDanger *danger, const char *name, JoxV2 a, JoxV2 b);
/* Adds the lines of probes `flow`, the polygons among the places, and the areas of probes
   `measure`. */
void jox_danger_add_plan(JoxDanger *danger, const JoxPlace *places, uint32_t place_count,
                         const JoxProbeDef *probes, uint32_t probe_count);
/* Takes a frame, in ascending order of time, and the exits at that time; NULL if there are none. */
void jox_danger_frame(JoxDanger *danger, const JoxFrame *frame, const JoxExits *exits);
/* Lists the state; local densities are included unless the caller owns them. */
void jox_danger_sections(JoxDanger *danger, JoxSections *sections);
/* Returns the local densities that it uses. */
const JoxLocal *jox_danger_local(const JoxDanger *danger);
/* Returns the field of density or pressure at the last sample, and its grid. */
const float *jox_danger_field(const JoxDanger *danger, JoxDangerMeasure measure,
                              const JoxDensity **grid);
JoxDangerCount jox_danger_count(const JoxDanger *danger, int limit);
/* Returns the minutes from a time, s, until the last frame; NAN for NAN. */
double jox_danger_minutes_since(const JoxDanger *danger, double first);
JoxDangerMost jox_danger_most(const JoxDanger *danger, JoxDangerMeasure measure);
/* Returns whether the measure was read, so that counts over its limits are known: compression and
   load exist in our own recordings only, and crowd pressure needs 20 s of frames. */
bool jox_danger_has_measure(const JoxDanger *danger, JoxDangerMeasure measure);
/* Writes "density_max": ..., "limits": {...}, "level_person_s": {...}, "congestion": {...},
   "areas": {...}, "lines": {...}, "walls": {...}, "leaving_s": {...}; null where a measure was not
   read. */
void jox_danger_json(const JoxDanger *danger, JoxJson *json);
void jox_danger_free(JoxDanger *danger);

#endif
