/* Checks loads of people at rest under external forces, without friction: contacts follow from the
   geometry, their forces from equilibrium, and the engine must find the same at every time step. */
#ifndef TESTS_UNIT_LOAD_AT_REST_H
#define TESTS_UNIT_LOAD_AT_REST_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "jostle.h"

enum {
    MOST_DISCS = 26,
    MOST_CORNERS = 24,
    MOST_WALLS = 5,
    MOST_BODIES = 4,
    MOST_CONTACTS = 60,
    DIRECTIONS = 3600
};
static const double PI = 3.14159265358979323846, RADIUS = 0.2, MASS = 70.0;
static const double SECONDS = 5.0, LAST = 1.0; /* s: length of a run; its last part is averaged */
static const double SETTLED = 4.0;             /* s: the averaged part if bodies tremble */
static const double WITHIN = 0.03;             /* relative error allowed against equilibrium */
static const double LENGTH_WITHIN = 0.01; /* relative change of a row's length over time steps */
static const double STEPS[] = {0.1, 0.05, 0.025, 0.0125, 0.00625};
enum { STEP_COUNT = 5 };

typedef struct Disc {
    double x, y;             /* m, position at equilibrium */
    double force_x, force_y; /* N, external */
    double radius, mass;     /* 0: 0.2 m, 70 kg */
} Disc;

typedef struct Wall {
    double xy[2 * MOST_CORNERS];
    uint32_t corners;
    bool solid; /* a polygon, else a thin line */
} Wall;

typedef struct Setup {
    Disc discs[MOST_DISCS];
    uint32_t disc_count;
    Wall walls[MOST_WALLS];
    uint32_t wall_count;
    JoBodyDef bodies[MOST_BODIES];
    uint32_t body_count;
    double loose_x, loose_y; /* people start at their positions times 1 + these */
    bool central;            /* forces point to the first disc */
    bool trembles; /* rigid bodies rest on friction against each other: contact forces vary
                      from step to step, so only a longer mean is checked */
} Setup;

/* Forces on a person. */
typedef struct Figures {
    double load, compression; /* N, N/m */
} Figures;

typedef struct Readings {
    Figures mean[MOST_DISCS], last[MOST_DISCS]; /* over the averaged part; of the last step */
    double length;                              /* m, from the first disc to the last */
    double moved; /* m, greatest distance of a disc from its position at equilibrium */
} Readings;

/* ---- equilibrium ---- */

typedef struct Contact {
    uint32_t disc;
    int64_t other; /* a disc, or -1 */
    double x, y;   /* unit vector of the force on `disc` */
    double newtons;
} Contact;

static inline double get_radius(const Disc *d) {
    return d->radius > 0.0 ? d->radius : RADIUS;
}

static inline void add_contact(Contact *out, uint32_t *count, uint32_t disc, int64_t other,
                               double dx, double dy, double reach) {
    double distance = hypot(dx, dy);
    if (fabs(distance - reach) > 1e-4)
        return;
    assert_true(*count < MOST_CONTACTS);
    out[(*count)++] = (Contact){disc, other, dx / distance, dy / distance, 0.0};
}

/* Adds the contact of a disc with a side, at the side's nearest point, if they touch there. */
static inline void add_side_contact(Contact *out, uint32_t *count, const Setup *s, uint32_t i,
                                    double ax, double ay, double bx, double by) {
    const Disc *d = &s->discs[i];
    double ux = bx - ax, uy = by - ay;
    double t = ((d->x - ax) * ux + (d->y - ay) * uy) / (ux * ux + uy * uy);
    t = fmin(1.0, fmax(0.0, t));
    add_contact(out, count, i, -1, d->x - ax - t * ux, d->y - ay - t * uy, get_radius(d));
}

static inline void compute_corner(const JoBodyDef *b, uint32_t k, double out[2]) {
    double x = (k == 0 || k == 3 ? -0.5 : 0.5) * b->size[0], y = (k < 2 ? -0.5 : 0.5) * b->size[1];
    out[0] = b->x + x * cos(b->turn) - y * sin(b->turn);
    out[1] = b->y + x * sin(b->turn) + y * cos(b->turn);
}

static inline uint32_t find_contacts(const Setup *s, Contact out[MOST_CONTACTS]) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < s->disc_count; i++) {
        const Disc *d = &s->discs[i];
        for (uint32_t k = i + 1; k < s->disc_count; k++)
            add_contact(out, &count, i, k, d->x - s->discs[k].x, d->y - s->discs[k].y,
                        get_radius(d) + get_radius(&s->discs[k]));
        for (uint32_t w = 0; w < s->wall_count; w++) {
            const Wall *wall = &s->walls[w];
            for (uint32_t c = 0; c + !wall->solid < wall->corners; c++) {
                const double *a = wall->xy + (size_t)2 * c;
                const double *b = wall->xy + (size_t)2 * ((c + 1) % wall->corners);
                add_side_contact(out, &count, s, i, a[0], a[1], b[0], b[1]);
            }
        }
        for (uint32_t b = 0; b < s->body_count; b++)
            for (uint32_t c = 0; c < 4; c++) {
                double from[2], to[2];
                compute_corner(&s->bodies[b], c, from);
                compute_corner(&s->bodies[b], (c + 1) % 4, to);
                add_side_contact(out, &count, s, i, from[0], from[1], to[0], to[1]);
            }
    }
    return count;
}

/* Solves the square system a x = b in place, with pivoting; false if it is singular. */
static inline bool solve_linear(double a[MOST_CONTACTS][MOST_CONTACTS + 1], uint32_t n) {
    for (uint32_t c = 0; c < n; c++) {
        uint32_t best = c;
        for (uint32_t r = c + 1; r < n; r++)
            if (fabs(a[r][c]) > fabs(a[best][c]))
                best = r;
        if (!(fabs(a[best][c]) > 1e-6))
            return false;
        for (uint32_t k = 0; k <= n; k++) {
            double kept = a[c][k];
            a[c][k] = a[best][k];
            a[best][k] = kept;
        }
        for (uint32_t r = 0; r < n; r++) {
            double share = r == c ? 0.0 : a[r][c] / a[c][c];
            for (uint32_t k = c; k <= n && share != 0.0; k++)
                a[r][k] -= share * a[c][k];
        }
    }
    for (uint32_t c = 0; c < n; c++)
        a[c][n] /= a[c][c];
    return true;
}

/* Returns the load of n forces: the greatest sum of positive components along one direction, N. */
static inline double compute_load(const double *x, const double *y, uint32_t n) {
    double greatest = 0.0;
    for (int k = 0; k < DIRECTIONS; k++) {
        double c = cos(2.0 * PI * k / DIRECTIONS), s = sin(2.0 * PI * k / DIRECTIONS), sum = 0.0;
        for (uint32_t i = 0; i < n; i++)
            sum += fmax(0.0, x[i] * c + y[i] * s);
        greatest = fmax(greatest, sum);
    }
    return greatest;
}

/* Solves the forces of all contacts, by least squares over the equations of equilibrium, two for
   each disc. *rest: greatest residual of an equation, N. False if they do not determine the
   forces. */
static inline bool solve_contacts(const Setup *s, Contact *contacts, uint32_t *count,
                                  double *rest) {
    static double rows[2 * MOST_DISCS][MOST_CONTACTS], normal[MOST_CONTACTS][MOST_CONTACTS + 1];
    uint32_t n = find_contacts(s, contacts), equations = 2 * s->disc_count;
    double forces[2 * MOST_DISCS];
    memset(rows, 0, sizeof rows);
    memset(normal, 0, sizeof normal);
    for (uint32_t i = 0; i < s->disc_count; i++) {
        forces[2 * i] = -s->discs[i].force_x;
        forces[2 * i + 1] = -s->discs[i].force_y;
    }
    for (uint32_t c = 0; c < n; c++) {
        const Contact *k = &contacts[c];
        rows[2 * k->disc][c] = k->x;
        rows[2 * k->disc + 1][c] = k->y;
        if (k->other >= 0) {
            rows[2 * k->other][c] = -k->x;
            rows[2 * k->other + 1][c] = -k->y;
        }
    }
    for (uint32_t a = 0; a < n; a++)
        for (uint32_t e = 0; e < equations; e++) {
            for (uint32_t b = 0; b < n; b++)
                normal[a][b] += rows[e][a] * rows[e][b];
            normal[a][n] += rows[e][a] * forces[e];
        }
    *count = n;
    if (!solve_linear(normal, n))
        return false;
    *rest = 0.0;
    for (uint32_t e = 0; e < equations; e++) {
        double missed = forces[e];
        for (uint32_t c = 0; c < n; c++)
            missed -= rows[e][c] * normal[c][n];
        *rest = fmax(*rest, fabs(missed));
    }
    for (uint32_t c = 0; c < n; c++)
        contacts[c].newtons = normal[c][n];
    return true;
}

/* Solves the contacts of a setup in which the discs are at rest and every contact presses. */
static inline uint32_t solve_balance(const Setup *s, Contact contacts[MOST_CONTACTS]) {
    uint32_t n;
    double rest;
    assert_true(solve_contacts(s, contacts, &n, &rest));
    assert_true(rest < 1e-3);
    for (uint32_t c = 0; c < n; c++)
        assert_true(contacts[c].newtons > 1.0);
    return n;
}

static inline void solve_figures(const Setup *s, Figures out[MOST_DISCS]) {
    Contact contacts[MOST_CONTACTS];
    uint32_t n = solve_balance(s, contacts);
    for (uint32_t i = 0; i < s->disc_count; i++) {
        double x[MOST_CONTACTS], y[MOST_CONTACTS], sum = 0.0;
        uint32_t own = 0;
        for (uint32_t c = 0; c < n; c++) {
            const Contact *k = &contacts[c];
            if (k->disc != i && k->other != (int64_t)i)
                continue;
            x[own] = k->x * (k->disc == i ? k->newtons : -k->newtons);
            y[own++] = k->y * (k->disc == i ? k->newtons : -k->newtons);
            sum += k->newtons;
        }
        double girth = 2.0 * PI * get_radius(&s->discs[i]);
        out[i] = (Figures){compute_load(x, y, own), sum / girth};
    }
}

/* ---- the engine ---- */

/* Perception range and number of neighbours, on which contacts must not depend; negative:
   default. */
typedef struct Sight {
    double perception, neighbours;
    const char *name;
} Sight;

static inline JoWorld *open_setup(const Setup *s, double dt, Sight sight, JoAgent *people) {
    JoError error = {0};
    JoWorldDef def = jo_default_world_def();
    def.dt = dt;
    JoWorld *world = jo_world_create(&def, &error);
    for (uint32_t w = 0; w < s->wall_count; w++) {
        const Wall *wall = &s->walls[w];
        if (!(wall->solid ? jo_world_add_solid : jo_world_add_line)(world, wall->xy, wall->corners,
                                                                    &error))
            fail_msg("%s", error.text);
    }
    for (uint32_t b = 0; b < s->body_count; b++)
        if (!jo_world_add_body(world, &s->bodies[b], &error).generation)
            fail_msg("%s", error.text);
    for (uint32_t i = 0; i < s->disc_count; i++) {
        const Disc *d = &s->discs[i];
        JoAgentDef agent = jo_default_agent_def();
        agent.x = d->x * (1.0 + s->loose_x);
        agent.y = d->y * (1.0 + s->loose_y);
        agent.radius = get_radius(d);
        agent.mass = d->mass > 0.0 ? d->mass : MASS;
        if (sight.perception >= 0.0)
            agent.perception = sight.perception;
        people[i] = jo_world_add_agent(world, &agent, &error);
        if (!people[i].generation)
            fail_msg("%s", error.text);
        jo_agent_set_parameter(world, people[i], "breadth", 2.0 * agent.radius, NULL);
        jo_agent_set_parameter(world, people[i], "depth", 2.0 * agent.radius, NULL);
        if (sight.neighbours >= 0.0)
            jo_agent_set_parameter(world, people[i], "neighbours", sight.neighbours, NULL);
    }
    return world;
}

static inline void apply_forces(const Setup *s, JoWorld *world, const JoAgent *people) {
    JoAgentState centre = jo_agent_state(world, people[0]);
    for (uint32_t i = 0; i < s->disc_count; i++) {
        double x = s->discs[i].force_x, y = s->discs[i].force_y;
        if (s->central && i > 0) {
            JoAgentState at = jo_agent_state(world, people[i]);
            double dx = centre.x - at.x, dy = centre.y - at.y, size = hypot(x, y);
            x = size * dx / hypot(dx, dy);
            y = size * dy / hypot(dx, dy);
        }
        jo_agent_apply_force(world, people[i], x, y);
    }
}

static inline Readings run_setup(const Setup *s, double dt, Sight sight) {
    JoAgent people[MOST_DISCS];
    Readings out = {0};
    JoWorld *world = open_setup(s, dt, sight, people);
    double seconds = SECONDS, part = LAST;
    if (s->trembles) {
        seconds += SETTLED;
        part = SETTLED;
    }
    int steps = (int)(seconds / dt + 0.5), first = (int)((seconds - part) / dt + 0.5);
    for (int step = 0; step < steps; step++) {
        apply_forces(s, world, people);
        jo_world_step(world, 1);
        for (uint32_t i = 0; i < s->disc_count && step >= first; i++) {
            JoAgentState a = jo_agent_state(world, people[i]);
            out.last[i] = (Figures){a.load, a.compression};
            out.mean[i].load += a.load / (steps - first);
            out.mean[i].compression += a.compression / (steps - first);
        }
    }
    assert_null(jo_world_failure(world));
    for (uint32_t i = 0; i < s->disc_count; i++) {
        JoAgentState a = jo_agent_state(world, people[i]);
        out.moved = fmax(out.moved, hypot(a.x - s->discs[i].x, a.y - s->discs[i].y));
    }
    JoAgentState a = jo_agent_state(world, people[0]);
    JoAgentState b = jo_agent_state(world, people[s->disc_count - 1]);
    out.length = hypot(a.x - b.x, a.y - b.y);
    jo_world_free(world);
    return out;
}

/* ---- comparison ---- */

static inline double compute_deviation(Figures a, Figures wanted) {
    return fmax(fabs(a.load / wanted.load - 1.0), fabs(a.compression / wanted.compression - 1.0));
}

static inline void print_figures(const char *what, const Figures *f, uint32_t n) {
    print_error("    %-18s", what);
    for (uint32_t i = 0; i < n; i++)
        print_error(" %.0f/%.0f", f[i].load, f[i].compression);
    print_error("\n");
}

/* Runs a setup at one time step; prints forces that are off, and returns 1 if there are any. */
static inline int compare_run(const Setup *s, const Figures *hand, double dt, Sight sight,
                              double *length) {
    Readings r = run_setup(s, dt, sight);
    double mean = 0.0, last = 0.0;
    for (uint32_t i = 0; i < s->disc_count; i++) {
        mean = fmax(mean, compute_deviation(r.mean[i], hand[i]));
        last = fmax(last, compute_deviation(r.last[i], hand[i]));
    }
    *length = r.length;
    if (mean <= WITHIN && (s->trembles || last <= WITHIN))
        return 0;
    print_error("  dt %g, %s: off by %.1f %% over the last seconds, %.1f %% in the last step; "
                "moved %.1f mm\n",
                dt, sight.name, 100.0 * mean, 100.0 * last, 1000.0 * r.moved);
    print_figures("wanted N and N/m", hand, s->disc_count);
    print_figures("read", r.mean, s->disc_count);
    return 1;
}

/* Runs a setup at every time step and with several perceptions, and compares its length over the
   time steps. Prints what is off, and returns how many runs are. */
static inline int count_off(const Setup *s, const Figures *hand) {
    static const Sight sights[] = {{-1, -1, "perception 3"},
                                   {-1, 2, "2 neighbours"},
                                   {0, -1, "perception 0"},
                                   {-1, 0, "0 neighbours"}};
    double least = INFINITY, most = 0.0;
    int off = 0;
    for (int k = 0; k < STEP_COUNT; k++)
        for (int sight = 0; sight < 4; sight++) {
            if (sight > 0 && k % 2 == 0)
                continue; /* other perceptions at two of the time steps alone */
            double length;
            off += compare_run(s, hand, STEPS[k], sights[sight], &length);
            if (sight == 0) {
                least = fmin(least, length);
                most = fmax(most, length);
            }
        }
    if (s->disc_count < 2 || most <= least * (1.0 + LENGTH_WITHIN))
        return off;
    print_error("  from the first to the last it is %.4f to %.4f m, by the step\n", least, most);
    return off + 1;
}

static inline void check_figures(const Setup *s, const Figures *hand) {
    int off = count_off(s, hand);
    if (off)
        fail_msg("%d figures or lengths are off", off);
}

/* Checks a setup against equilibrium, which must give the figures computed by hand (`given`), if
 * any. */
static inline void check_setup(const Setup *s, const Figures *given) {
    Figures hand[MOST_DISCS];
    solve_figures(s, hand);
    for (uint32_t i = 0; given && i < s->disc_count; i++)
        if (!(compute_deviation(hand[i], given[i]) < 1e-3))
            fail_msg("equilibrium gives disc %u %.1f N and %.1f N/m, not %.1f and %.1f", i,
                     hand[i].load, hand[i].compression, given[i].load, given[i].compression);
    check_figures(s, hand);
}

#endif
