/* Constants of the walking law, one set for all crowds; core/walking.md explains them. The law
   itself is in nav/walk/walk.c. */
#ifndef JOX_AGENTS_WALK_LAW_H
#define JOX_AGENTS_WALK_LAW_H

/* X(name, unit, least, greatest, default, meaning). R: the sum of two people's radii. */
#define JOX_WALK_CONSTANTS(X)                                                                      \
    X(width, "", 0.1, 3, 1.2, "breadth of free way that a follower needs, in R")                   \
    X(flank, "", 0.6, 20, 2.15, "weight of the lateral distance of people beside the way")         \
    X(flank_eager, "", 0, 0.9, 0.38, "share of their nearness that eager people ignore")           \
    X(room_eager, "", 0, 0.9, 0.235, "share of breadth and room that eager people do without")     \
    X(width_cross, "", 0.1, 3, 0.8, "lateral distance at which crossing ways pass, in R")          \
    X(turned, "1/m2", 0, 20, 1.4, "density from which on people turn a shoulder to who crosses")   \
    X(length, "", 0.1, 3, 1.045, "length of way that the person ahead takes up, in R")             \
    X(ahead_share, "", 0, 2, 0.54, "share of the time gap over which people are extrapolated")     \
    X(ease, "", 0, 1, 0.75, "how gradually people slow down behind others: 0 at once")             \
    X(gap_eager, "", 0, 0.95, 0.07, "share of the time gap that eager people do without")          \
    X(gap_spread, "", 0, 0.9, 0.1, "greatest part by which people's time gaps differ")             \
    X(gap_noise, "", 0, 2, 0.45, "greatest logarithm by which a person's time gap wanders")        \
    X(crowded, "1/m2", 0, 20, 2.6, "density from which on people grow eager")                      \
    X(crowded_bound, "1/m2", 0, 20, 1.3, "density from which on those grow eager who have a goal") \
    X(eager_normal, "", 0, 1, 0.62, "least eagerness in a normal crowd: calm 0, keen 1")           \
    X(eager_most, "", 0, 1, 0.4, "greatest eagerness in a calm or normal crowd: keen 1")           \
    X(rivals, "", 0, 16, 4.5, "neighbours on converging ways, from which on people compete")       \
    X(rivals_more, "", 0.1, 16, 3, "as many more of these make anybody as eager as keen people")   \
    X(eager_rise, "s", 0.05, 60, 1, "time in which eagerness rises")                               \
    X(eager_fall, "s", 0.05, 60, 10, "time in which eagerness falls")                              \
    X(cross_time, "s", 0.05, 10, 0.35, "time gap kept to people who cross")                        \
    X(contact_time, "s", 0.05, 20, 2.6, "time to a contact below which a way is worth less")       \
    X(wall_time, "s", 0.05, 10, 0.35, "time kept to walls when going aside")                       \
    X(wall_reach, "", 0, 3, 0.75, "distance kept to walls when going aside, in reaches")           \
    X(turn_cost, "", 0, 5, 0.48, "cost of turning from the course, in wanted speeds")              \
    X(right, "", -1, 1, 0.058, "value of going aside to the right, in wanted speeds")              \
    X(course_time, "s", 0.01, 10, 0.2, "time in which the course follows the way chosen")          \
    X(start_time, "s", 0.01, 5, 0.145, "time in which people reach a speed")                       \
    X(stop_time, "s", 0.01, 5, 0.32, "time in which they slow down and turn")                      \
    X(stair_gap_up, "", 0.1, 5, 2, "factor of the time gap up a stair of 30 degrees")              \
    X(stair_gap_down, "", 0.1, 5, 1.65, "factor of the time gap down a stair of 30 degrees")       \
    X(close, "m", 0, 5, 0.5, "gap below which other people restrict velocities")                   \
    X(close_time, "s", 0.01, 5, 0.1, "time in which such a gap may be used up")                    \
    X(crowd_slowing, "m2", 0, 20, 0.6, "cost of a way through people held up, a person per m2")

typedef struct JoxWalkLaw {
#define X(name, unit, least, greatest, value, meaning) double name;
    JOX_WALK_CONSTANTS(X)
#undef X
} JoxWalkLaw;

/* Returns the default constants. */
static inline JoxWalkLaw jox_walk_law(void) {
    return (JoxWalkLaw){
#define X(name, unit, least, greatest, value, meaning) .name = value,
        JOX_WALK_CONSTANTS(X)
#undef X
    };
}

#endif
