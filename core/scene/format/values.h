/* Reads single values of a scene: numbers with units, points, names, distributions. Called by the
   readers of keys. */
#ifndef JOX_SCENE_VALUES_H
#define JOX_SCENE_VALUES_H

#include "base/number/distribution.h"
#include "base/vec.h"
#include "scene/format/reader.h"

#define JOX_FARTHEST 10000 /* m, of a coordinate: there a float still resolves a millimetre */

/* A unit that scenes may write, the SI unit of its dimension, and the factor to it. */
typedef struct JoxUnit {
    const char *name, *kind;
    double factor;
} JoxUnit;
extern const JoxUnit jox_scene_units[];
extern const size_t jox_scene_unit_count;

/* Reads a number with or without a unit ("2", "2 m", "5 min") and converts it to `unit`, an SI
   unit; false with an error. */
bool jox_read_number(const JoxReader *reader, const JoxYaml *node, const char *unit, double *out);
/* Reads a list of at least `least` points, in m, as positions on the sheet of their storey, into
   the arena; NULL with an error. */
JoxV2 *jox_read_points(const JoxReader *reader, const JoxYaml *list, uint32_t least,
                       uint32_t *count);
/* Reads a list of names, or a single one; returns their number, 0 for NULL. Reports items that are
   no names, and leaves them out. */
uint32_t jox_read_names(const JoxReader *reader, const JoxYaml *node, const JoxYaml *const **out);
/* Reads a number, "normal(1, 0.1 [, least, greatest])", "uniform(a, b)" or "choose(a, b, ...)".
   False, without an error, if the text is none of these; a malformed one is reported. */
bool jox_read_dist(const JoxReader *reader, const JoxYaml *node, JoxDist *out);

#endif
