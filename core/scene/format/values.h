/* Single values of a scene: numbers with units, points, names, distributions. */
#ifndef JOX_SCENE_VALUES_H
#define JOX_SCENE_VALUES_H

#include "base/number/distribution.h"
#include "base/vec.h"
#include "scene/format/reader.h"

#define JOX_FARTHEST 10000 /* m: floats still resolve a millimetre */

/* Units that may be written, each with the SI unit of its kind and the factor to it. */
typedef struct JoxUnit {
    const char *name, *kind;
    double factor;
} JoxUnit;
extern const JoxUnit jox_scene_units[];
extern const size_t jox_scene_unit_count;

/* A number in SI, of text like "2 m", "5 min", "90 deg"; false with an error. */
bool jox_read_number(const JoxReader *reader, const JoxYaml *node, const char *unit, double *out);
/* Points of a list; NULL if wrong (reported). */
JoxV2 *jox_read_points(const JoxReader *reader, const JoxYaml *list, uint32_t least,
                       uint32_t *count);
/* Names of a list or of a single scalar; none of NULL. */
uint32_t jox_read_names(const JoxReader *reader, const JoxYaml *node, const JoxYaml *const **out);
/* A number, or "normal(1, 0.1 [, least, greatest])", "uniform(a, b)", "choose(a, b, ...)". Quiet
   false if the text is none of these. */
bool jox_read_dist(const JoxReader *reader, const JoxYaml *node, JoxDist *out);

#endif
