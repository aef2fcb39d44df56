/* Levels of service A to F: Fruin, Pedestrian planning and design, 1971. For queues by the area per
   person; for walkways and stairs by flow and area. */
#ifndef JOX_RECORD_DANGER_LEVELS_H
#define JOX_RECORD_DANGER_LEVELS_H

enum { JOX_LEVELS = 6 };
typedef struct JoxLevel {
    const char *name;
    double queue_area; /* m2 per person: least area of the level in a queue; 0 for the last */
    double walk_area;  /* m2 per person: least area of the level on a walkway */
    /* 1/(m min): greatest flow of the level on a walkway; INFINITY for the last */
    double walk_flow;
    double stair_area, stair_flow; /* the same on stairs */
    const char *what;              /* description, for queues */
} JoxLevel;
extern const JoxLevel jox_levels[JOX_LEVELS];
extern const char jox_levels_source[];

/* Returns the level of a queue, an index in jox_levels, by its density, 1/m2. */
int jox_level_of_queue(double density);
/* Returns the level of a walkway, by its flow, 1/(m s). Levels E and F also follow from the density
   alone, 1/m2: a low flow because nobody can move is not good. NAN for the density if there is
   nobody. */
int jox_level_of_walkway(double flow, double density);
/* Returns the level of a stair in the same way. */
int jox_level_of_stair(double flow, double density);

#endif
