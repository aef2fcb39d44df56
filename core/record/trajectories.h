/* Whole recordings in memory, as frames. Reads SQLite files in the JuPedSim format, versions 1 and
   2, our own included; text with the columns id, frame, x, y and optionally z, as PeTrack and the
   Juelich archive write it; and CSV with a header, such as ID,Frame,x,y,v_x,v_y. Commands that
   analyse a recording call it; trajectory_reader.h reads frame by frame instead. */
#ifndef JOX_RECORD_TRAJECTORIES_H
#define JOX_RECORD_TRAJECTORIES_H

#include <stdbool.h>
#include <stdint.h>

#include "base/format/diag.h"
#include "geom/walls.h"
#include "record/frame.h"
#include "record/lift_history.h"
#include "record/wall_history.h"

typedef struct JoxTrajectoryOptions {
    double fps;             /* frames per second; 0: read it from the file */
    double unit;            /* m: length of the unit in the file; 0: read it from the file */
    JoxV2 period;           /* m: lengths of the periodic edges; 0: not periodic */
    const char *fps_option; /* option that sets `fps`, for hints of errors; NULL: "--fps 25" */
} JoxTrajectoryOptions;

/* Columns of rows, in ascending order of frame, then person. */
typedef struct JoxTrajectories {
    double fps;      /* frames per second */
    int64_t *number; /* frame number of each row */
    uint32_t *key;   /* ids of the file, or their ranks unless all ids are from 0 to 2^22 - 1 */
    float *x, *y, *vx, *vy;            /* m, m/s */
    float *force, *compression, *load; /* N, N/m, N; NULL unless recorded */
    float *radius;                     /* m; NULL unless recorded */
    /* m: torsos as in JoxTrajectoryReaderFrame; NULL unless recorded */
    float *axis_x, *axis_y, *contact_radius;
    float *fallen;            /* s: time since a fall; 0: stands; NULL unless recorded */
    uint16_t *group;          /* NULL unless recorded */
    char **groups;            /* names */
    JoxColour *group_colours; /* 0 where a group has none */
    uint32_t *group_clothes;  /* indices of jox_clothes_names */
    uint32_t group_count;
    uint32_t *state;          /* index in `states`; NULL unless recorded */
    char **states;            /* names; the first, "", is the state of people without a machine */
    JoxColour *state_colours; /* 0 where a state has none */
    uint32_t state_count;
    float *face_x, *face_y; /* unit vectors along which people look; NULL unless recorded */
    int64_t *id;            /* id in the file; freed, with `line`, when reading is finished */
    uint32_t *line;         /* line in a text file; 0 in others */
    size_t count, capacity;
    size_t *first;                      /* first row of each frame, and the row count at the end */
    uint32_t frame_count, keys, people; /* all keys are below `keys` */
    int64_t last;                       /* number of the last frame, which may be empty */
    JoxV2 period;                       /* m */
    bool has_velocity;                  /* the file has velocities */
    JoxV2 low, high;                    /* m: bounding box of all rows */
    /* Walls of the first frame in our recordings; else the outlines of the walkable area, as
       lines. */
    JoxWalls walls;
    JoxWallHistory *history; /* the walls over time; NULL: the file has none */
    /* x and y, walls and the bounding box are positions on the sheets of storeys. Empty: one plane.
     */
    JoxStoreys storeys;
    JoxLiftHistory *lifts; /* NULL: none are recorded */
} JoxTrajectories;

/* Reads a recording. Returns NULL with errors in `diagnostics`. Where the file has no velocities,
   they are displacements from 0.2 s before to 0.2 s after, or between the nearest frames where
   these are farther apart. */
JoxTrajectories *jox_trajectories_read(const char *path, const JoxTrajectoryOptions *options,
                                       JoxDiagnostics *diagnostics);
/* Sets `out` to the f-th of the frames with people. Its walls are those that stand then, valid
   until the next call. Returns false after the last frame. */
bool jox_trajectories_frame(const JoxTrajectories *trajectories, uint32_t f, JoxFrame *out);
/* Returns the walls in the f-th frame, open gates included, valid until the next call. */
const JoxWalls *jox_trajectories_walls(const JoxTrajectories *trajectories, uint32_t f);
/* Sets the bounding box of all rows, m; if there are storeys, which are returned, that of all rows
   and walls, in plan. Without, returns NULL. */
const JoxStoreys *jox_trajectories_plan_area(const JoxTrajectories *trajectories, JoxV2 *low,
                                             JoxV2 *high);
void jox_trajectories_free(JoxTrajectories *trajectories);

/* The rest is for the files trajectories*.c and trajectory_*.c. jox_trajectories_read_text
   (trajectories.c) reads a text file as jox_trajectories_read does. jox_trajectories_finish sorts
   added rows by frame, gives people keys and measures velocities; returns false with errors. */
JoxTrajectories *jox_trajectories_read_text(const char *path, const JoxTrajectoryOptions *options,
                                            JoxDiagnostics *diagnostics);
bool jox_trajectories_finish(JoxTrajectories *t, const char *path, JoxDiagnostics *diagnostics);
/* Adds the rows of a text (trajectories_text.c). Returns false with errors. */
bool jox_trajectories_add_text(JoxTrajectories *t, const char *path, const char *text,
                               size_t length, const JoxTrajectoryOptions *options,
                               JoxDiagnostics *diagnostics);
/* Reads only walls and groups from an open file (trajectory_plan.c), whose storeys are set. Returns
   false with a sentence in `why` if a wall is damaged. */
struct JoxDatabase;
bool jox_trajectories_read_walls(JoxTrajectories *t, struct JoxDatabase *db, JoxText *why);
/* Returns the colour in a column of a row; 0 for none. */
struct sqlite3_stmt;
JoxColour jox_trajectory_colour(struct sqlite3_stmt *row, int column);
/* Returns the index of the name in a column of a row; 0 if it is none of the `count` names. */
uint32_t jox_trajectory_choice(struct sqlite3_stmt *row, int column, const char *const *names,
                               uint32_t count);
/* Returns whether a file begins with the signature of SQLite. */
bool jox_is_sqlite(const char *path);
/* Adds a row and returns its index; the caller fills its columns. */
size_t jox_trajectories_add_row(JoxTrajectories *t);

#endif
