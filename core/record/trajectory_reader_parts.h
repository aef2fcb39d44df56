/* The trajectory reader's members, shared by trajectory_reader*.c and trajectories_read.c. */
#ifndef JOX_RECORD_TRAJECTORY_READER_PARTS_H
#define JOX_RECORD_TRAJECTORY_READER_PARTS_H

#include "base/database.h"
#include "record/trajectory_reader.h"

/* Method that finds the rows of a frame: by the index of the table, by the range of row numbers, or
   in memory. */
typedef enum { JOX_READ_BY_INDEX, JOX_READ_BY_ROW, JOX_READ_WHOLE } JoxTrajectoryReaderWay;

struct JoxTrajectoryReader {
    JoxTrajectoryReaderWay way;
    double fps;
    JoxDatabase *db;
    sqlite3_stmt *rows, *body_at, *bodies;
    bool ours;   /* our own recording, with states, forces and groups */
    bool loads;  /* has loads; older recordings of ours have none */
    bool radii;  /* has radii; older recordings of ours have none */
    bool falls;  /* has a column of falls; older recordings of ours have none */
    bool torsos; /* has columns of torsos; older recordings of ours have none */
    bool torso;  /* somebody in the frame that was read last is no disc */
    bool facing; /* has the directions in which people look */
    bool placed; /* has storeys and stairs of people */
    /* by frame: its number and, for JOX_READ_BY_ROW, its first row, with the end of the last
       frame */
    int64_t *number, *from;
    uint32_t frames;
    size_t number_capacity, from_capacity;
    int64_t last;      /* number of the last listed frame, which may be empty */
    bool sorted;       /* the rows are those of a sorted copy */
    int64_t last_body; /* last row number of the bodies */
    sqlite3_stmt *part;
    int64_t *changes; /* frame numbers at which shapes of bodies changed */
    uint32_t change_count;
    size_t change_capacity;
    JoxV3 *corners;
    size_t corner_capacity;
    JoxTrajectories *in_memory;
    JoxTrajectories outlines; /* only walls and groups, of an SQLite file */
    struct JoxTrajectoryReaderState *states;
    uint32_t state_count;
    char *look; /* JSON of what the scene shows; NULL: none is recorded */
    bool bounded;
    JoxV2 low, high;
    /* Columns of the frame that was read last. */
    int64_t *id;
    float *x, *y, *face_x, *face_y, *force, *compression, *load, *radius, *fallen, *axis_x, *axis_y,
        *contact_radius;
    uint32_t *state;
    uint16_t *group;
    JoxRecordBody *body;
    size_t capacity, body_capacity;
};

/* Reads the people of a frame as jox_trajectory_reader_read does, without bodies. The recording
   must be an SQLite file. */
bool jox_trajectory_reader_read_people(JoxTrajectoryReader *reader, uint32_t frame,
                                       JoxTrajectoryReaderFrame *out, JoxText *why);

#endif
