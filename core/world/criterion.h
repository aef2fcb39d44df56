/* Criteria that a scene is held against, as plain data: scene reads them, record/danger/criteria.h
   judges them. */
#ifndef JOX_WORLD_CRITERION_H
#define JOX_WORLD_CRITERION_H

#include <stdint.h>

/* The kinds, a row each: enumerator, key, unit of the limit, greatest limit, an example, meaning.
 */
/* clang-format off */
#define JOX_CRITERION_KINDS(X)                                                                      \
    X(CLEARED, cleared, "s", 1e6, "cleared: 120 s",                                                 \
      "available time: everybody must have left by then; the time required, times `margin`, is at most this") \
    X(DENSITY, density, "1/m2", 20, "density: 4",                                                   \
      "density (Gaussian, R = 1 m) that is exceeded anywhere in the place `at` for no longer than `lasting`") \
    X(FLOW, flow, "", 10, "flow: 1.3",                                                       \
      "greatest flow over the line of the probe `of`, in any ten seconds of the run, of everybody: people per second and metre of clear width") \
    X(WAITING, waiting, "s", 1e6, "waiting: 300",                                                   \
      "longest time of a person in the probe `of`, a transit or a visit")                           \
    X(LOAD, load, "N", 1e5, "load: 623",                                                            \
      "greatest push that a person bears from one side, held for a second")
/* clang-format on */

typedef enum JoxCriterionKind {
#define X(kind, name, unit, greatest, example, meaning) JOX_CRITERION_##kind,
    JOX_CRITERION_KINDS(X)
#undef X
        JOX_CRITERION_KIND_COUNT
} JoxCriterionKind;

typedef struct JoxCriterion {
    char *name;
    JoxCriterionKind kind;
    double limits[JOX_CRITERION_KIND_COUNT]; /* in the unit of the kind; that of `kind` counts */
    double margin;                           /* cleared: factor on the time required */
    double lasting;                          /* s; density: longest time above the limit in all */
    int32_t place;                           /* density: index; -1: everywhere */
    int32_t probe;                           /* flow, waiting: index; -1: none */
} JoxCriterion;

#endif
