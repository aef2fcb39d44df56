/* What the kinds of probes share. */
#ifndef JOX_RECORD_PROBES_PROBE_PARTS_H
#define JOX_RECORD_PROBES_PROBE_PARTS_H

#include <stddef.h>
#include <stdio.h>

#include "record/probes/probe.h"
#include "record/track.h"

/* Which frames a kind wants: ten a second, all, or one in each `every` of its def. */
typedef enum { JOX_PACE_TENTH, JOX_PACE_ALL, JOX_PACE_EVERY } JoxPace;

/* One kind. `state` is its own and starts as zeros. */
typedef struct JoxProbeCalls {
    size_t size; /* of the state */
    JoxPace pace;
    /* Whether it wants a frame of time t, instead of a pace; or NULL. */
    bool (*is_due)(const JoxProbeDef *def, const void *state, double t);
    void (*begin)(const JoxProbeDef *def, void *state); /* or NULL */
    /* `seen[i]` is 1 for the people who are measured. */
    void (*frame)(const JoxProbeDef *def, void *state, const JoxFrame *frame, const uint8_t *seen);
    void (*figures)(const JoxProbeDef *def, const void *state, JoxFigures *out);
    /* What its future and its figures depend on; a restored one fails where it could not be. */
    void (*sections)(void *state, JoxSections *sections);
    /* A first line with names and units in brackets, then rows. */
    void (*csv)(const JoxProbeDef *def, const void *state, FILE *out);
    /* gnuplot commands that draw the file `csv`; the terminal is set, commas separate. */
    void (*plot)(const JoxProbeDef *def, const void *state, bool walls, JoxText *out);
    int width, height;            /* of the picture, pixels; height 0: by the area of the map */
    size_t owned[8];              /* what of the state jox_free takes: JOX_OWNED of each */
    void (*release)(void *state); /* the rest of it; or NULL */
} JoxProbeCalls;
/* Of calls: what all kinds have, by the names that their files give it. */
#define JOX_PROBE_KIND(State, wide, high)                                                          \
    .size = sizeof(State), .figures = figures, .sections = sections, .csv = csv, .plot = plot,     \
    .width = wide, .height = high
#define JOX_OWNED(State, member) (offsetof(State, member) + 1) /* 0: none */

#define X(kind, name, form, options, example, meaning) extern const JoxProbeCalls jox_probe_##name;
JOX_PROBES(X)
#undef X

/* probe_flow.c: passages that stand so far, of a flow's state. */
uint32_t jox_flow_passages(const void *state);
/* How often it was crossed against its direction; 0 where anybody crossed it along that. */
uint32_t jox_flow_against(const void *state);
/* When the middle 60 % of them were made, s; false of fewer than two. */
bool jox_flow_middle(const void *state, double *from, double *to);
/* A flow within another probe: its state, and a frame of it. */
void *jox_flow_create(void);
void jox_flow_frame(const JoxV2 line[2], void *state, const JoxFrame *frame, const uint8_t *seen);
void jox_flow_sections(void *state, JoxSections *sections);
void jox_flow_free(void *state);
/* `title`: what it is, in words. */
void jox_figure_add(JoxFigures *figures, const char *name, const char *title, const char *unit,
                    double value);

/* Why the figure that was added last has no value, where it has none. */
void jox_figure_why(JoxFigures *figures, const char *why);

/* A plot that only says why there is nothing to draw. */
void jox_plot_nothing(JoxText *out, const char *why);

#endif
