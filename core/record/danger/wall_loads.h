/* Loads on walls, in pieces of at most a metre: the mean of each over 1 s, as for people, its
   greatest value, and since when it exceeds what a steel railing withstood. danger.c owns and feeds
   it. */
#ifndef JOX_RECORD_DANGER_WALL_LOADS_H
#define JOX_RECORD_DANGER_WALL_LOADS_H

#include <stdbool.h>

#include "base/format/json_writer.h"
#include "base/sections.h"
#include "record/frame.h"

#define JOX_RAIL_LIMIT 4500.0 /* N */
extern const char jox_rail_what[], jox_rail_source[];

typedef struct JoxDangerPiece {
    JoxV2 from, to; /* m */
    float load;     /* N: exponential mean over 1 s */
    float most;     /* N: greatest mean */
    double most_time;
    double seconds, first; /* s: total time above JOX_RAIL_LIMIT, and the first time; NAN: never */
} JoxDangerPiece;

typedef struct JoxDangerWalls {
    JoxDangerPiece *items;
    uint32_t count, capacity;
    uint32_t *order; /* piece of each wall load in the last frame */
    uint32_t order_capacity;
    bool known;    /* a frame had wall loads */
    uint32_t over; /* pieces that exceeded the limit at any time */
    double piece_s, longest;
    /* indices of the first piece over the limit and of the one with the greatest load */
    uint32_t first, most;
} JoxDangerWalls;

/* Takes the wall loads of a frame. `share` is its weight in the means. */
void jox_danger_walls_frame(JoxDangerWalls *walls, const JoxFrame *frame, double duration,
                            float share);
/* Returns the greatest mean load of any piece at present, N; NAN if unknown. */
double jox_danger_walls_greatest_load(const JoxDangerWalls *walls);
/* Returns the middle of a piece, m. */
static inline JoxV2 jox_danger_piece_middle(const JoxDangerPiece *piece) {
    return jox_scale(jox_add(piece->from, piece->to), 0.5f);
}
/* Returns a point of a piece in plan, on the sheet of its middle. */
JoxV2 jox_danger_piece_in_plan(const JoxStoreys *storeys, const JoxDangerPiece *piece, JoxV2 point);
/* Returns the greatest load of a piece over its length, N/m. */
double jox_danger_piece_line_load(const JoxDangerPiece *piece);
/* Writes "walls": {...}, or null without wall loads. `end` is the time of the last frame, s. */
void jox_danger_walls_json(const JoxDangerWalls *walls, const JoxStoreys *storeys, double end,
                           JoxJson *json);
void jox_danger_walls_sections(JoxDangerWalls *walls, JoxSections *sections);
void jox_danger_walls_free(JoxDangerWalls *walls);

#endif
