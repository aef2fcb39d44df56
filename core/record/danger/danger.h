/* Where people are squeezed, over the frames of a run or of a recording:

   - density: people per m2 by the Gaussian kernel, R = 1 m, within the walls (fields/density.h)
   - Voronoi density: one over the area that a person has, within 1 m (fields/voronoi_people.h)
   - pressure: crowd pressure, 1/s2 (fields/pressure.h), where it was measured
   - compression: sum of the contact forces' magnitudes on a person over the girth, N/m
   - load: the greatest push that a person bears from any one direction, N: over directions d, the
     greatest sum of the positive parts of f.d over the contacts f. Published limits for chests are
     forces of that kind
   - dose: of load, the share of the time after which death is estimated (jox_danger_dose_text)

   Compression and load are exponential means over 1 s of each person: what is held, not a knock of
   one step. With levels of service (levels.h), congestion (congestion.h), lines that people pass
   (lines.h), what walls bear (walls.h); exits: who left where, and when the last did. */
#ifndef JOX_RECORD_DANGER_H
#define JOX_RECORD_DANGER_H

#include <stdbool.h>

#include "base/format/json_writer.h"
#include "base/sections.h"
#include "base/text.h"
#include "geom/place.h"
#include "geom/walls.h"
#include "record/frame.h"
#include "record/local.h"
#include "world/exits.h"
#include "world/probe.h"

typedef enum JoxDangerMeasure {
    JOX_DANGER_DENSITY,
    JOX_DANGER_PRESSURE,
    JOX_DANGER_COMPRESSION,
    JOX_DANGER_LOAD,
    JOX_DANGER_MAPPED, /* those before are drawn on maps */
    JOX_DANGER_DOSE = JOX_DANGER_MAPPED,
    JOX_DANGER_VORONOI, /* of each person, as density is at samples */
    JOX_DANGER_MEASURES
} JoxDangerMeasure;
extern const char *const jox_danger_names[JOX_DANGER_MEASURES];  /* "density", ... */
extern const char *const jox_danger_units[JOX_DANGER_MEASURES];  /* "1/m2", ... */
extern const char *const jox_danger_titles[JOX_DANGER_MEASURES]; /* in words, for people */

/* A published limit. */
typedef struct JoxDangerLimit {
    const char *key;   /* in summaries */
    const char *title; /* in words, for people */
    JoxDangerMeasure measure;
    double value;       /* in the measure's unit */
    const char *what;   /* what is known of it */
    const char *source; /* who says so */
} JoxDangerLimit;
enum { JOX_DANGER_LIMITS = 9 };
extern const JoxDangerLimit jox_danger_limits[JOX_DANGER_LIMITS];
/* The least limit of a measure; NAN without one. */
double jox_danger_least(JoxDangerMeasure measure);
/* What a dose is, in words, for reports. */
extern const char jox_danger_dose_text[];

/* When the last of all left, s; NAN while `inside` people are still there, or where nobody left. */
double jox_exits_clearance(const JoxExits *exits, uint32_t inside);
/* Adds "left": ..., "inside": ..., "last_left_s": ..., "clearance_s": ..., "exits": {...}. */
void jox_exits_json(const JoxExits *exits, uint32_t inside, JoxJson *json);

typedef struct JoxDangerCount {
    uint32_t people; /* who were ever over the limit */
    double person_s; /* sum of the times over it */
    double longest;  /* s; time over it of the person who was longest, all in all */
    double first;    /* s; NAN: never */
    JoxV2 first_at;  /* m */
} JoxDangerCount;
typedef struct JoxDangerMost {
    double value, time; /* s; NAN where nothing was read */
    uint32_t person;    /* of what people bear: whose */
    JoxV2 at;           /* m */
} JoxDangerMost;

typedef struct JoxDanger JoxDanger;
/* `low` to `high`: the area of fields and maps. */
JoxDanger *jox_danger_create(JoxV2 low, JoxV2 high);
/* The same on densities that someone else takes, of each frame before it comes here. */
JoxDanger *jox_danger_create_on(JoxLocal *local);
/* A line that people pass, for flow, levels of service, stop-and-go and the growth of its queue;
   before the first frame. */
void jox_danger_add_line(JoxDanger *danger, const char *name, JoxV2 a, JoxV2 b);
/* Those of probes that measure flow; and areas, for levels of service: polygons among the places,
   and those of probes that measure in one. */
void jox_danger_add_plan(JoxDanger *danger, const JoxPlace *places, uint32_t place_count,
                         const JoxProbeDef *probes, uint32_t probe_count);
/* Frames in ascending time; `exits` as they are then, or NULL. */
void jox_danger_frame(JoxDanger *danger, const JoxFrame *frame, const JoxExits *exits);
/* All but the densities of one that takes them from someone else. */
void jox_danger_sections(JoxDanger *danger, JoxSections *sections);
/* The densities that it is measured on. */
const JoxLocal *jox_danger_local(const JoxDanger *danger);
/* The field of density or pressure at the last sample, and its grid. */
const float *jox_danger_field(const JoxDanger *danger, JoxDangerMeasure measure,
                              const JoxDensity **grid);
JoxDangerCount jox_danger_count(const JoxDanger *danger, int limit);
/* Minutes from a first time until the last frame; NAN of NAN. */
double jox_danger_since(const JoxDanger *danger, double first);
JoxDangerMost jox_danger_most(const JoxDanger *danger, JoxDangerMeasure measure);
/* Whether it is known who is over its limits: compression and load are in our own recordings alone,
   crowd pressure takes ten seconds. */
bool jox_danger_reads(const JoxDanger *danger, JoxDangerMeasure measure);
/* Adds "density_max": ..., "limits": {...}, "levels": {...}, "congestion": {...}, "areas": {...},
   "lines": {...}, "walls": {...}, "leaving_s": {...}; null where it was not read. */
void jox_danger_json(const JoxDanger *danger, JoxJson *json);
void jox_danger_free(JoxDanger *danger);

#endif
