/* What the files reader*.c share. */
#ifndef JOX_RECORD_TRAJECTORY_READER_PARTS_H
#define JOX_RECORD_TRAJECTORY_READER_PARTS_H

#include "base/database.h"
#include "record/trajectory_reader.h"

/* How the rows of a frame are found. */
typedef enum { JOX_READ_BY_INDEX, JOX_READ_BY_ROW, JOX_READ_WHOLE } JoxTrajectoryReaderWay;

struct JoxTrajectoryReader {
    JoxTrajectoryReaderWay way;
    double fps;
    JoxDatabase *db;
    sqlite3_stmt *rows, *body_at, *bodies;
    bool ours;   /* with states, forces and groups */
    bool loads;  /* with loads, which older ones of ours lack */
    bool radii;  /* likewise */
    bool facing; /* with the way people look */
    int64_t *number,
        *from; /* of each frame; JOX_READ_BY_ROW: its first row, and one more at the end */
    uint32_t frames;
    size_t number_capacity, from_capacity;
    int64_t last;      /* number of the last frame that is listed, in which nobody may be */
    bool sorted;       /* the rows are those of a copy in order */
    int64_t last_body; /* row */
    sqlite3_stmt *part;
    int64_t *changes; /* numbers of the frames in which shapes changed */
    uint32_t change_count;
    size_t change_capacity;
    JoxV3 *corners;
    size_t corner_capacity;
    JoxTrajectories *all;
    JoxTrajectories outlines; /* walls and groups as they are read from SQLite */
    struct JoxTrajectoryReaderState *states;
    uint32_t state_count;
    bool bounded;
    JoxV2 low, high;
    /* The frame that was read last. */
    int64_t *id;
    float *x, *y, *face_x, *face_y, *force, *compression, *load, *radius;
    uint32_t *state;
    uint16_t *group;
    JoxRecordBody *body;
    size_t capacity, body_capacity;
};

/* As jox_trajectory_reader_read, of a file that is not read whole, without bodies. */
bool jox_trajectory_reader_read_people(JoxTrajectoryReader *reader, uint32_t frame,
                                       JoxTrajectoryReaderFrame *out, JoxText *why);

#endif
