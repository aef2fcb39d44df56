/* The recorder's members, shared by recorder.c, which writes frames, and recorder_tables.c, which
   writes what holds for many frames. */
#ifndef JOX_RECORD_RECORDER_PARTS_H
#define JOX_RECORD_RECORDER_PARTS_H

#include <pthread.h>
#include <stdio.h>

#include "base/database.h"
#include "geom/storeys.h"
#include "record/recorder.h"
#include "record/recorder_schema.h"

/* A frame that waits to be written. */
typedef struct JoxRecorderFrame {
    uint32_t number;
    JoxRecordRow *rows;
    JoxRecordBody *bodies;
    JoxRecordCar *cars;
    uint32_t row_count, body_count, car_count;
    size_t row_capacity, body_capacity, car_capacity;
} JoxRecorderFrame;
enum { JOX_RECORDER_FRAMES = 4 };

struct JoxRecorder {
    FILE *claimed; /* the same file, kept open and locked so that no other run writes to it */
    JoxDatabase *db;
    sqlite3_stmt *row, *batch, *body, *frame; /* inserts */
    sqlite3_stmt *car;                        /* NULL without storeys */
    pthread_t thread;
    pthread_mutex_t lock;
    pthread_cond_t filled, emptied;
    JoxRecorderFrame frames[JOX_RECORDER_FRAMES]; /* ring buffer: `first` is the oldest frame,
                                                     `count` are filled */
    uint32_t first, count;
    bool ending, failed;
    bool borrowed;                       /* the stepping thread uses the database at present */
    char why[256];                       /* why it failed */
    double low_x, high_x, low_y, high_y; /* m: bounds of all positions */
    double committed;                    /* s: time of the last commit */
    uint64_t geometry;
    JoxStoreys storeys; /* a copy; empty: one plane */
    int columns;        /* of the rows of people */
};

/* Waits until the writer has written all frames, then reserves the database for the calling thread.
   The writer sleeps until the next frame; it wakes to commit, but not while `borrowed` is set. */
void jox_recorder_borrow(JoxRecorder *recorder);
void jox_recorder_return(JoxRecorder *recorder);
/* Prepares a statement of a borrowed database; false with the reason in `why` of the recorder. */
bool jox_recorder_prepare(JoxRecorder *recorder, sqlite3_stmt **statement, const char *sql);
/* Steps a statement that returns no rows and resets it for the next use. */
bool jox_recorder_execute(JoxRecorder *recorder, sqlite3_stmt *statement);
/* recorder_storeys.c: appends "x y, x y, ..." */
void jox_recorder_write_points(JoxText *out, const JoxV2 *points, uint32_t count);
bool jox_recorder_set_metadata(JoxRecorder *recorder, const char *key, const char *value);

#endif
