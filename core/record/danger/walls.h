/* Loads on walls, by pieces of at most a metre: what each bears, held on average for a second like
   what people bear, the greatest of it, and since when it is more than a rail stood. */
#ifndef JOX_RECORD_DANGER_WALLS_H
#define JOX_RECORD_DANGER_WALLS_H

#include <stdbool.h>

#include "base/format/json_writer.h"
#include "base/sections.h"
#include "record/frame.h"

#define JOX_RAIL_LIMIT 4500.0 /* N */
extern const char jox_rail_what[], jox_rail_source[];

typedef struct JoxDangerPiece {
    JoxV2 from, to; /* m */
    float load;     /* N: mean of the last second */
    float most;     /* N: greatest of that */
    double most_time;
    double seconds, first; /* s over JOX_RAIL_LIMIT, and when for the first time; NAN: never */
} JoxDangerPiece;

typedef struct JoxDangerWalls {
    JoxDangerPiece *items;
    uint32_t count, capacity;
    uint32_t *order; /* by load of the frame before: its piece */
    uint32_t order_capacity;
    bool known;    /* some frame had loads of walls */
    uint32_t over; /* pieces that were ever over the limit */
    double piece_s, longest;
    uint32_t first, most; /* pieces: the first over the limit, that of the greatest load */
} JoxDangerWalls;

/* `share`: of this frame in the mean. */
void jox_danger_walls_frame(JoxDangerWalls *walls, const JoxFrame *frame, double duration,
                            float share);
/* Greatest load of any piece now, N; NAN if it is not known. */
double jox_danger_walls_now(const JoxDangerWalls *walls);
/* N per metre of a piece's length, at its greatest load. */
double jox_danger_piece_line_load(const JoxDangerPiece *piece);
/* Adds "walls": {...}; null where no loads of walls are known. `end`: of what was measured, s. */
void jox_danger_walls_json(const JoxDangerWalls *walls, double end, JoxJson *json);
void jox_danger_walls_sections(JoxDangerWalls *walls, JoxSections *sections);
void jox_danger_walls_free(JoxDangerWalls *walls);

#endif
