/* Recordings as frames: SQLite files in the JuPedSim format, versions 1 and 2 (ours among them);
   text with the columns id, frame, x, y and perhaps z, as PeTrack and the archive of Juelich write
   it; and CSV with a line of names, as ID,Frame,x,y,v_x,v_y. */
#ifndef JOX_RECORD_TRAJECTORIES_H
#define JOX_RECORD_TRAJECTORIES_H

#include <stdbool.h>
#include <stdint.h>

#include "base/format/diag.h"
#include "geom/walls.h"
#include "record/frame.h"
#include "record/wall_history.h"

typedef struct JoxTrajectoryOptions {
    double fps;             /* frames a second; 0: the file says it */
    double unit;            /* m: length of the file's unit; 0: the file says it */
    JoxV2 period;           /* m: of periodic edges; 0 without */
    const char *fps_option; /* what gives `fps`, for hints; NULL: "--fps 25" */
} JoxTrajectoryOptions;

/* Rows by frame, then by person. */
typedef struct JoxTrajectories {
    double fps;
    int64_t *number; /* of each row: its frame */
    uint32_t *key;   /* the file's ids, or their ranks where these are not numbers below 2^22 */
    float *x, *y, *vx, *vy;
    float *force, *compression, *load; /* NULL unless recorded */
    float *radius;                     /* m; likewise */
    uint16_t *group;                   /* NULL unless recorded */
    char **groups;                     /* names */
    JoxColour *group_colours;          /* 0 where none was given */
    uint32_t group_count;
    uint32_t *state;          /* rows of `states`; NULL unless recorded */
    char **states;            /* names; the first, "", is of who has no machine */
    JoxColour *state_colours; /* 0 where none was given */
    uint32_t state_count;
    float *face_x, *face_y; /* unit vectors along which people look; NULL unless recorded */
    int64_t *id;            /* as in the file; freed, with `line`, once it is read */
    uint32_t *line;         /* of a text file */
    size_t count, capacity;
    size_t *first; /* row at which each frame begins; one more at the end */
    uint32_t frame_count, keys, people;
    int64_t last;      /* number of the last frame, in which nobody may be */
    JoxV2 period;      /* m */
    bool has_velocity; /* the file gave it */
    JoxV2 low, high;   /* m: everyone, always */
    /* Those that Jostle recorded, as they were at first; else outlines of the walkable area, as
       lines. */
    JoxWalls walls;
    JoxWallHistory *history; /* the same over time; NULL: the file has none */
} JoxTrajectories;

/* NULL with errors in `diagnostics`. Velocities that the file does not give are displacements over
   0.2 s before and after, or to the nearest frames where these are farther apart. */
JoxTrajectories *jox_trajectories_read(const char *path, const JoxTrajectoryOptions *options,
                                       JoxDiagnostics *diagnostics);
/* Frame `f` of those in which anyone is, with the walls that stand then; false behind the last. The
   walls hold until the next call. */
bool jox_trajectories_frame(const JoxTrajectories *trajectories, uint32_t f, JoxFrame *out);
/* Walls in frame `f`, open gates among them, until the next call. */
const JoxWalls *jox_trajectories_walls(const JoxTrajectories *trajectories, uint32_t f);
void jox_trajectories_free(JoxTrajectories *trajectories);

/* trajectories.c: the same of a text; and of rows as they came: sorts them by frame, numbers
   people, measures velocities. */
JoxTrajectories *jox_trajectories_read_text(const char *path, const JoxTrajectoryOptions *options,
                                            JoxDiagnostics *diagnostics);
bool jox_trajectories_finish(JoxTrajectories *t, const char *path, JoxDiagnostics *diagnostics);
/* trajectories_text.c: rows as they come; false with errors. */
bool jox_trajectories_text(JoxTrajectories *t, const char *path, const char *text, size_t length,
                           const JoxTrajectoryOptions *options, JoxDiagnostics *diagnostics);
/* trajectory_plan.c: walls and groups alone, of an open file. */
struct JoxDatabase;
void jox_trajectories_plan(JoxTrajectories *t, struct JoxDatabase *db);
/* The colour in a column of a row, 0 for none. */
struct sqlite3_stmt;
JoxColour jox_trajectory_colour(struct sqlite3_stmt *row, int column);
/* Whether a file begins as SQLite files do. */
bool jox_is_sqlite(const char *path);
/* Room for one more row; its number, by which the columns are filled. */
size_t jox_trajectories_add(JoxTrajectories *t);

#endif
