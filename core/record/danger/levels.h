/* Levels of service: Fruin, Pedestrian planning and design, 1971. Of queues by the area that each
   person has; of walkways by flow over a line and by area. */
#ifndef JOX_RECORD_DANGER_LEVELS_H
#define JOX_RECORD_DANGER_LEVELS_H

enum { JOX_LEVELS = 6 };
typedef struct JoxLevel {
    const char *name;
    double queue_area; /* m2 each: from this on, in a queue; 0 of the last */
    double walk_area;  /* m2 each: from this on, on a walkway */
    double walk_flow;  /* 1/(m min): up to this, on a walkway; INFINITY of the last */
    const char *what;  /* in queues */
} JoxLevel;
extern const JoxLevel jox_levels[JOX_LEVELS];
extern const char jox_levels_source[];

/* Of a queue with so many people per m2. */
int jox_level_of_queue(double density);
/* Of a walkway: by flow, 1/(m s); but E or F where the area alone says so, since a flow that is
   small because nobody can move is no good one. NAN of a density where nobody is. */
int jox_level_of_walkway(double flow, double density);

#endif
