/* People on stairs between storeys: how many went up and down, how many were on each at most, and
   how dense it was there. danger.c owns and feeds them. */
#ifndef JOX_RECORD_DANGER_STAIR_COUNTS_H
#define JOX_RECORD_DANGER_STAIR_COUNTS_H

#include "base/format/json_writer.h"
#include "base/sections.h"
#include "record/frame.h"

typedef struct JoxDangerStair {
    uint32_t up, down; /* people who left it at the head, at the foot, not where they came from */
    uint32_t people_most; /* on it at a time */
    float density_most;   /* 1/m2, where people on it stood */
    double density_time;  /* s; NAN: nobody was on it at a sample */
} JoxDangerStair;

typedef struct JoxDangerStairs {
    JoxDangerStair *items; /* by stair; those of slopes stay empty */
    uint32_t count;
    /* By key: 1 + the stair that the person is on, 0 on a storey; and the sheet that it came from,
       UINT32_MAX if it came in on the stair. */
    struct JoxOnStair {
        uint32_t stair, from;
    } * people;
    uint32_t people_capacity;
    const JoxStoreys *storeys; /* storeys of the last frame */
} JoxDangerStairs;

/* Takes a frame; every frame. Does nothing in a world without storeys. */
void jox_danger_stairs_frame(JoxDangerStairs *stairs, const JoxFrame *frame);
/* Takes a sample of the density at each person, 1/m2, after the frame. */
void jox_danger_stairs_sample(JoxDangerStairs *stairs, const JoxFrame *frame, const float *density);
/* Writes "stairs": {NAME: {...}}, if there are any. */
void jox_danger_stairs_json(const JoxDangerStairs *stairs, const JoxStoreys *storeys,
                            JoxJson *json);
void jox_danger_stairs_sections(JoxDangerStairs *stairs, JoxSections *sections);
void jox_danger_stairs_free(JoxDangerStairs *stairs);

#endif
