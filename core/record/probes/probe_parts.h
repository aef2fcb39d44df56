/* Interface between probe.c and the kinds of probes, and helpers of the kinds. A kind has one
   JoxProbeCalls, jox_probe_NAME, listed in JOX_PROBES of world/probe.h. */
#ifndef JOX_RECORD_PROBES_PROBE_PARTS_H
#define JOX_RECORD_PROBES_PROBE_PARTS_H

#include <stddef.h>
#include <stdio.h>

#include "record/frame_track.h"
#include "record/probes/probe.h"

/* Frames that a kind takes: ten per second, all, or one in each `every` seconds of its
   definition. */
typedef enum { JOX_PACE_TENTH, JOX_PACE_ALL, JOX_PACE_EVERY } JoxPace;

/* Functions of one kind. probe.c allocates `state`, set to zero, and frees it. */
typedef struct JoxProbeCalls {
    size_t size; /* bytes of the state */
    JoxPace pace;
    /* Returns whether it takes a frame at time t, s. Replaces the pace unless NULL. */
    bool (*is_due)(const JoxProbeDef *def, const void *state, double t);
    void (*begin)(const JoxProbeDef *def,
                  void *state); /* prepares the state; NULL: zeros will do */
    /* Takes a frame. `seen[i]` is 1 for the people it measures. */
    void (*frame)(const JoxProbeDef *def, void *state, const JoxFrame *frame, const uint8_t *seen);
    void (*figures)(const JoxProbeDef *def, const void *state, JoxFigures *out);
    /* Lists all of the state that later frames and figures depend on. A restored state with
       impossible values must fail. */
    void (*sections)(void *state, JoxSections *sections);
    /* Writes a header with names and units in brackets, then rows. */
    void (*csv)(const JoxProbeDef *def, const void *state, FILE *out);
    /* Appends gnuplot commands that draw the table. In gnuplot `csv` is the name of its file;
       terminal and separator are already set. */
    void (*plot)(const JoxProbeDef *def, const void *state, bool walls, JoxText *out);
    int width, height; /* size of the plot in pixels; height 0: by the aspect ratio of the area */
    size_t owned[8];   /* arrays in the state for probe.c to free: JOX_OWNED of each */
    void (*release)(void *state); /* frees anything else in the state; NULL: nothing */
} JoxProbeCalls;
/* Members of JoxProbeCalls that all kinds have. The functions are named by the kind, as in
   add_flow_figures, list_flow_sections, write_flow_csv and plot_flow. */
#define JOX_PROBE_KIND(State, kind, wide, high)                                                    \
    .size = sizeof(State), .figures = add_##kind##_figures, .sections = list_##kind##_sections,    \
    .csv = write_##kind##_csv, .plot = plot_##kind, .width = wide, .height = high
#define JOX_OWNED(State, member) (offsetof(State, member) + 1) /* 0 stands for none */

#define X(kind, name, form, options, example, meaning) extern const JoxProbeCalls jox_probe_##name;
JOX_PROBES(X)
#undef X

/* flow.c, for a flow's state: number of valid passages. */
uint32_t jox_flow_passages(const void *state);
/* Returns the number of crossings against the direction of the line; 0 if anybody crossed in its
   direction. */
uint32_t jox_flow_backward_crossings(const void *state);
/* Sets the times, s, of the first and last passage of the middle 60 %. Returns false for fewer than
   two passages. */
bool jox_flow_middle(const void *state, double *from, double *to);
/* A flow inside another probe: creates its state, takes a frame, lists the state and frees it. */
void *jox_flow_create(void);
void jox_flow_frame(const JoxV2 line[2], void *state, const JoxFrame *frame, const uint8_t *seen);
void jox_flow_sections(void *state, JoxSections *sections);
void jox_flow_free(void *state);
/* Adds a figure; `title` is its name in words. */
void jox_figure_add(JoxFigures *figures, const char *name, const char *title, const char *unit,
                    double value);

/* Sets the reason why the figure added last has no value; ignored if it has one. */
void jox_figure_set_reason(JoxFigures *figures, const char *why);

/* Writes a plot with the reason why there is nothing to draw. */
void jox_plot_reason(JoxText *out, const char *why);

#endif
