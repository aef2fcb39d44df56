/* The parameters of an agent: one list that defines the columns, the names in behaviours, and the
   reference pages. */
#ifndef JOX_AGENTS_PARAMETERS_H
#define JOX_AGENTS_PARAMETERS_H

#include <stdbool.h>
#include <stdint.h>

/* X(name, unit, least, greatest, default, meaning). Angles are in degrees, and stored as their
   cosine. Defaults are those of people in a dense crowd. */
#define JOX_PARAMETERS(X)                                                                          \
    X(speed, "m/s", 0, 20, 1.3, "wanted speed")                                                    \
    X(max_speed, "m/s", 0, 30, 1.8, "hard cap on speed; only a contact impulse exceeds it")        \
    X(perception, "m", 0, 100, 3, "radius within which neighbours and bodies are seen")            \
    X(neighbours, "", 0, 16, 10, "greatest number of neighbours that are considered")              \
    X(horizon, "s", 0.01, 30, 0.5, "time ahead for which other agents are avoided")                \
    X(wall_horizon, "s", 0.01, 30, 0.3, "time ahead for which walls are avoided")                  \
    X(push, "N", 0, 5000, 0, "force with which an agent pushes agents in its way")                 \
    X(push_reach, "m", 0, 2, 0.1, "greatest gap over which an agent pushes")                       \
    X(push_angle, "degree", 0, 180, 60, "half-angle of the cone in which an agent pushes")         \
    X(absorb, "", 0, 1, 0.8, "share of a force that is passed on (k of equations 8 and 9)")        \
    X(brace_angle, "degree", 0, 180, 60, "half-angle of the cone that takes a passed-on force")    \
    X(yield, "", 0, 1, 0.5, "share of mutual avoidance that the agent takes; 0.5 is reciprocal")   \
    X(radius, "m", 0.02, 5, 0.2, "radius of the disc for which an agent keeps room as it walks")   \
    X(breadth, "m", 0, 10, 0,                                                                      \
      "breadth of the torso across the shoulders; 0: 2.25 times the radius")                       \
    X(depth, "m", 0, 10, 0,                                                                        \
      "depth of the torso; 0: 1.25 times the radius; a disc unless less than the breadth")         \
    X(mass, "kg", 1, 10000, 70, "mass")                                                            \
    X(restitution, "", 0, 1, 0, "restitution of contacts between agents")                          \
    X(damping, "1/s", 0, 50, 2.5, "how fast the feet stop a velocity given by force")              \
    X(brace, "N", 0, 5000, 200, "force of others that the feet of an agent under way withstand")   \
    X(time_gap, "s", 0, 10, 0,                                                                     \
      "time gap kept to people ahead, by the walking law; 0: velocities are chosen by ORCA")       \
    X(haste, "", 0, 1, 0.5, "motivation: 0 calm, 0.5 normal, 1 keen; bounds eagerness")            \
    X(step_back, "m/s", 0, 2, 0.11,                                                                \
      "speed at which an agent that stands steps back to where it stood before it was moved")      \
    X(balance, "m", 0, 2, 0,                                                                       \
      "longest step by which an agent that forces throw regains its balance; 0: it never falls")   \
    X(stance, "m", 0, 1, 0,                                                                        \
      "how far to either side of an agent that stands its feet are; they hold it against forces "  \
      "from the side")                                                                             \
    X(rise, "s", 0, 1e6, 5, "time that an agent lies after a fall, until it gets up")              \
    X(stair_up, "m/s", 0, 5, 0,                                                                    \
      "wanted speed up stairs, along the slope; 0: that of level ground, lessened by the slope")   \
    X(stair_down, "m/s", 0, 5, 0, "the same down stairs")                                          \
    X(escalator_walk, "", 0, 1, 0.25,                                                              \
      "chance that an agent walks on a running escalator; otherwise it stands on it")              \
    X(lifts, "", 0, 1, 0.5,                                                                        \
      "how an agent gets to other storeys: 0 never by a lift, 0.5 either by stairs or by a lift "  \
      "that takes less time, 1 only by lifts and ramps, as it cannot use stairs")

typedef enum JoxParameter {
#define X(name, unit, least, greatest, value, meaning) JOX_PARAM_##name,
    JOX_PARAMETERS(X)
#undef X
        JOX_PARAM_COUNT
} JoxParameter;
/* Parameters from this one on have an own value only in machines that give them one, or of which a
   group of the scene sets them: otherwise each new parameter would change the draws of all. */
enum { JOX_FIRST_RARE_PARAM = JOX_PARAM_stair_up };

typedef struct JoxParameterInfo {
    const char *name, *unit, *meaning;
    double least, greatest, value;
} JoxParameterInfo;

extern const JoxParameterInfo jox_parameters[JOX_PARAM_COUNT];

/* Returns the index of a parameter by name, or -1. */
int jox_parameter_find(const char *name);
/* Returns what to use in place of a parameter, or a constant of the walking law, that there is no
   more; NULL for any other name. */
const char *jox_parameter_successor(const char *name);
/* Finds the value of a word: haste is calm (0), normal (0.5) or keen (1), lifts never,
   either or only. Returns false if the
   parameter has no such word. */
bool jox_parameter_level(JoxParameter parameter, const char *word, double *value);
/* Returns the n-th word of a parameter, from 0; NULL beyond the last. */
const char *jox_parameter_word(JoxParameter parameter, uint32_t n);
/* Returns whether a parameter has an effect in literal mode, which no equation of the paper has
   otherwise. */
bool jox_parameter_acts_in_literal(JoxParameter parameter);
/* Converts a value in the parameter's unit to the form that columns store: itself, or an angle's
   cosine. The value is first clamped to [least, greatest]; NaN becomes the default. */
float jox_parameter_store(JoxParameter parameter, double value);
/* Converts `count` values and stores them in the cells of `agents` in a column. */
void jox_parameter_store_all(JoxParameter parameter, const double *values, const uint32_t *agents,
                             uint32_t count, float *column);
/* Returns whether a number is valid as a stored value of the parameter. */
bool jox_parameter_is_stored(JoxParameter parameter, float stored);
/* Converts a stored value back to the parameter's unit. */
double jox_parameter_value(JoxParameter parameter, float stored);

#endif
