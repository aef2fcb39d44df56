/* The walking law against a plain reference, which judges one direction at a time in double
   precision: over random neighbourhoods, each with constants drawn anew. The free path before a
   wall is found by walking in small steps. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "agents/torso.h"
#include "base/number/elementary.h"
#include "base/number/random.h"
#include "geom/polygon.h"
#include "nav/nav_state.h"
#include "unit/nav_plain.h"

enum { OTHERS = 9, EDGES = 3, DIRECTIONS = 11, PACKETS = 3000 };
static const double PI = 3.14159265358979323846, INTERVAL = 0.05;

/* ---- neighbourhoods ---- */

typedef struct Packet {
    uint32_t number, drawn;
    JoxWalkLaw law;
    JoxAgents agents;
    JoxNeighbours neighbours;
    JoxWalls walls;
    JoxV2 ends[EDGES][2];
    JoxNav *nav;
    uint32_t me;    /* index of the walker, with id 0 */
    uint32_t edges; /* number of walls */
    bool on_edge; /* rounding decides whether an agent is in the way or minded, or a wall is touched
                   */
} Packet;

static double draw_law_value(Packet *p, double from, double to) {
    return from + (to - from) * jox_random_unit(9, p->number, 0, JOX_DRAW_FILL, p->drawn++);
}

/* Draws constants within a third of their defaults; time gaps neither differ nor wander, and
   eagerness stays as given. */
static void draw_law(Packet *p) {
    p->law = jox_walk_law();
#define X(name, unit, least, greatest, value, meaning)                                             \
    p->law.name = fmin(fmax(p->law.name * draw_law_value(p, 0.67, 1.33), least), greatest);
    JOX_WALK_CONSTANTS(X)
#undef X
    p->law.gap_spread = p->law.gap_noise = 0.0;
    p->law.eager_rise = p->law.eager_fall = 60.0;
}

static void add_law_agent(Packet *p, double x, double y) {
    JoxAgents *a = &p->agents;
    uint32_t i = jox_agents_add(a);
    double angle = draw_law_value(p, 0.0, 2.0 * PI),
           speed = draw_law_value(p, 0.0, 1) < 0.2 ? 0.0 : draw_law_value(p, 0.3, 1.8);
    double heading = angle + draw_law_value(p, -0.7, 0.7), moves = draw_law_value(p, 0.0, 1.4);
    a->x[i] = a->prev_x[i] = (float)x;
    a->y[i] = a->prev_y[i] = (float)y;
    a->pref_x[i] = (float)(speed * jox_cos(angle));
    a->pref_y[i] = (float)(speed * jox_sin(angle));
    a->vx[i] = (float)(moves * jox_cos(heading));
    a->vy[i] = (float)(moves * jox_sin(heading));
    a->eager[i] = (float)draw_law_value(p, 0.0, 1.0);
    a->course_x[i] = (float)jox_cos(heading);
    a->course_y[i] = (float)jox_sin(heading);
    a->bound[i] = draw_law_value(p, 0.0, 1.0) < 0.5 ? 1 : 0;
    a->way_left[i] = (float)draw_law_value(p, 0.0, 9.0);
    jox_param_set(a, JOX_PARAM_radius, i, (float)draw_law_value(p, 0.15, 0.25));
    jox_param_set(a, JOX_PARAM_time_gap, i, (float)draw_law_value(p, 0.4, 1.6));
}

static void open_law(Packet *p, uint32_t number) {
    *p = (Packet){.number = number};
    draw_law(p);
    p->nav = jox_nav_create(&p->law);
    add_law_agent(p, 0.0, 0.0);
    int others = 1 + (int)draw_law_value(p, 0.0, OTHERS);
    for (int k = 0; k < others; k++) {
        double far = draw_law_value(p, 0.35, 2.5), angle = draw_law_value(p, 0.0, 2.0 * PI);
        add_law_agent(p, far * jox_cos(angle), far * jox_sin(angle));
    }
    p->edges = draw_law_value(p, 0.0, 1.0) < 0.5 ? 0 : EDGES;
    for (uint32_t k = 0; k < p->edges; k++) {
        for (int e = 0; e < 2; e++)
            p->ends[k][e] =
                (JoxV2){(float)draw_law_value(p, -1.0, 1.0), (float)draw_law_value(p, -1.0, 1.0)};
        jox_walls_add_polyline(&p->walls, p->ends[k], 2, false, INFINITY);
    }
    if (p->edges)
        jox_nav_set_walls(p->nav, &p->walls);
    jox_nav_sort(p->nav, &p->agents, 0);
    jox_nav_perceive(p->nav, &p->agents, &p->neighbours, NULL);
    while (p->agents.id[p->me] != 0)
        p->me++;
}

static void close_law(Packet *p) {
    jox_nav_free(p->nav);
    jox_agents_free(&p->agents);
    jox_walls_free(&p->walls);
    jox_neighbours_free(&p->neighbours);
}

/* ---- the reference ---- */

typedef struct Way {
    double x, y, allowed, worth; /* unit; m/s */
} Way;

static void lower_to(double *value, double to) {
    *value = to < *value ? to : *value;
}

static double radii(const Packet *p, uint32_t j) {
    const JoxParameterColumn radius = p->agents.param[JOX_PARAM_radius];
    return (double)jox_at(radius, p->me) + (double)jox_at(radius, j);
}

/* Limits a way by an agent that goes first: the speed that keeps the time gap, in the way or beside
   it, eased from the wanted speed. */
static void limit_by_leader(Packet *p, Way *w, uint32_t j, double wanted) {
    const JoxAgents *a = &p->agents;
    const JoxWalkLaw *law = &p->law;
    double eager = (double)a->eager[p->me], r = radii(p, j);
    double room = 1.0 - law->room_eager * eager, width = law->width * r * room;
    double along = (double)a->x[j] * w->x + (double)a->y[j] * w->y;
    double aside = fabs(w->x * (double)a->y[j] - w->y * (double)a->x[j]), q = aside / width;
    p->on_edge |= fabs(q - 1.0) < 1e-5 || fabs(aside - sqrt(3.0) * along) < 1e-5;
    if (along <= 0.0 || (q >= 1.0 && aside >= sqrt(3.0) * along))
        return;
    double gap = (double)jox_param(a, JOX_PARAM_time_gap, p->me) * (1.0 - law->gap_eager * eager);
    double free = along - law->length * r * room * sqrt(fmax(0.0, 1.0 - q * q * q * q * q * q));
    if (q >= 1.0)
        free = hypot(along, law->flank / (1.0 - law->flank_eager * eager) * aside) -
               law->length * r * room;
    double ahead = fmax(0.0, (double)a->vx[j] * w->x + (double)a->vy[j] * w->y);
    double speed = (free + law->ahead_share * gap * ahead) / (gap + law->ahead_share * gap);
    if (speed > 0.0)
        speed /= pow(1.0 + pow(law->ease * speed / wanted, 4.0), 0.25);
    lower_to(&w->allowed, speed);
    lower_to(&w->worth, speed);
}

/* Returns the distance at which ways that cross pass, m: less in a crowd, where chests turn. */
static double measure_cross_width(const Packet *p, uint32_t j) {
    const JoxNeighbours *n = &p->neighbours;
    double density = 0.0;
    if (n->count[p->me] > JOX_CROWD_RANK)
        density = (JOX_CROWD_RANK + 1) / (PI * fmax(1e-4, (double)n->crowding2[p->me]));
    double turned = fmin(fmax(density - p->law.turned, 0.0), 1.0);
    double chest = (double)p->agents.contact_radius[p->me] /
                   (double)jox_param(&p->agents, JOX_PARAM_radius, p->me);
    return p->law.width_cross * radii(p, j) * (1.0 + (chest - 1.0) * turned);
}

/* Limits a way by an agent that crosses: the free path, and the time until the two meet. */
static void limit_by_crossing(Packet *p, Way *w, uint32_t j, double speed) {
    const JoxAgents *a = &p->agents;
    double x = (double)a->x[j], y = (double)a->y[j], width = measure_cross_width(p, j);
    double along = x * w->x + y * w->y, aside = w->x * y - w->y * x;
    if (fabs(aside) < width && along > 0.0) {
        double path = (along - sqrt(width * width - aside * aside)) / p->law.cross_time;
        lower_to(&w->allowed, path);
        lower_to(&w->worth, path);
    }
    double ux = speed * w->x - (double)a->vx[j], uy = speed * w->y - (double)a->vy[j];
    double u2 = ux * ux + uy * uy, closing = x * ux + y * uy;
    double apart2 = fmax(0.0, x * x + y * y - width * width);
    double meets = closing * closing - u2 * apart2;
    p->on_edge |= fabs(meets) < 1e-5 * closing * closing || fabs(fabs(aside) - width) < 1e-6;
    if (meets > 0.0 && closing > 0.0)
        lower_to(&w->worth, (closing - sqrt(meets)) / u2 * speed / p->law.contact_time);
}

static double measure_distance(const Packet *p, uint32_t edge, double x, double y) {
    JoxV2 at = {(float)x, (float)y};
    return (double)jox_length(
        jox_sub(jox_segment_nearest(p->ends[edge][0], p->ends[edge][1], at), at));
}

/* Limits a way by a wall: how far the walker gets before it is `keep` from it. */
static void limit_by_plain_wall(Packet *p, Way *w, uint32_t edge, double speed) {
    const double stride = 0.0005;
    const JoxAgents *a = &p->agents;
    const JoxV2 aside = jox_left((JoxV2){a->aim_x[p->me], a->aim_y[p->me]});
    double room = 1.0 - p->law.room_eager * (double)a->eager[p->me];
    double keep = p->law.wall_reach * room * (double)jox_torso_reach(a, p->me, aside), path = 0.0;
    if (measure_distance(p, edge, 0.0, 0.0) < keep) { /* too near: not towards it */
        JoxV2 off = jox_segment_nearest(p->ends[edge][0], p->ends[edge][1], (JoxV2){0, 0});
        path = (double)off.x * w->x + (double)off.y * w->y > 0.0 ? 0.0 : INFINITY;
    } else {
        double far = INFINITY; /* a grazing way may come too near between two strides */
        for (; path < speed * p->law.wall_time && far >= keep; path += far >= keep ? stride : 0.0) {
            far = measure_distance(p, edge, path * w->x, path * w->y);
            p->on_edge |= fabs(far - keep) < 2e-6;
        }
    }
    lower_to(&w->allowed, path / p->law.wall_time);
    lower_to(&w->worth, path / p->law.wall_time);
}

static bool is_hidden(const Packet *p, uint32_t j) {
    JoxV2 at = {p->agents.x[j], p->agents.y[j]};
    for (uint32_t k = 0; k < p->edges; k++)
        if (jox_segment_crossing(p->ends[k][0], p->ends[k][1], (JoxV2){0, 0}, at))
            return true;
    return false;
}

static Way judge_way(Packet *p, double degrees, double speed) {
    const JoxAgents *a = &p->agents;
    double angle = degrees / 180.0 * PI, c = jox_cos(angle), s = jox_sin(angle);
    double ax = (double)a->aim_x[p->me], ay = (double)a->aim_y[p->me];
    Way w = {c * ax - s * ay, c * ay + s * ax, speed, speed};
    for (uint32_t j = 0; j < a->count; j++) {
        JoxV2 offset = {a->x[j], a->y[j]};
        if (j == p->me || is_hidden(p, j))
            continue;
        Minds minds = plain_minds(a, p->me, j, offset);
        if (minds == MINDS_AHEAD)
            limit_by_leader(p, &w, j, speed);
        else if (minds == MINDS_CROSSING)
            limit_by_crossing(p, &w, j, speed);
    }
    for (uint32_t k = 0; k < p->edges && degrees != 0.0; k++)
        limit_by_plain_wall(p, &w, k, speed);
    return w;
}

/* Returns the direction of greatest worth along the way; *lead: by how much it beats the next
   best. */
static Way choose_way(Packet *p, double cx, double cy, double speed, double *lead) {
    double most = -INFINITY;
    Way best = judge_way(p, 0.0, speed);
    *lead = fabs(best.worth - 0.98 * speed);
    if (best.worth >= 0.98 * speed)
        return best;
    double margin = INFINITY;
    for (int k = 0; k < DIRECTIONS; k++) {
        double degrees = 15.0 * (k - DIRECTIONS / 2);
        Way w = judge_way(p, degrees, speed);
        double worth = fmax(w.worth, -0.2) * jox_cos(degrees / 180.0 * PI);
        worth -= p->law.turn_cost * speed * (1.0 - (w.x * cx + w.y * cy));
        worth += degrees < 0.0 ? p->law.right * speed : 0.0;
        margin = worth > most ? worth - most : fmin(margin, most - worth);
        if (worth > most) {
            most = worth;
            best = w;
        }
    }
    *lead = fmin(*lead, margin);
    return best;
}

/* Applies the approach to a way's velocity within the interval. */
static void approach_way(const Packet *p, const Way *w, double *x, double *y) {
    double vx = (double)p->agents.vx[p->me], vy = (double)p->agents.vy[p->me];
    double start = fmin(1.0, INTERVAL / p->law.start_time);
    double stop = fmin(1.0, INTERVAL / p->law.stop_time), speed = fmax(w->allowed, 0.0);
    double now = sqrt(vx * vx + vy * vy), along = vx * w->x + vy * w->y;
    double kept = now * fmin(1.0, fmax(0.0, now > 0.0 ? 2.0 * along / now : 0.0));
    kept += (speed - kept) * (speed > kept ? start : stop);
    *x = w->x * kept + (vx - w->x * along) * (1.0 - stop);
    *y = w->y * kept + (vy - w->y * along) * (1.0 - stop);
}

/* ---- comparison ---- */

/* Returns the error of the engine's velocity, m/s; NAN where two directions are equally good, an
   agent is on an edge, or no agent wants to move. */
static double measure_error(uint32_t number, bool *aside) {
    Packet p;
    double x, y, lead, result = NAN;
    open_law(&p, number);
    JoxAgents *a = &p.agents;
    double cx = (double)a->course_x[p.me], cy = (double)a->course_y[p.me];
    JoxStep step = {
        .timing = jox_timing_at_once(INTERVAL), .agents = a, .neighbours = &p.neighbours};
    step.timing.seed = 1;
    jox_nav_walk(p.nav, &step);
    double px = (double)a->pref_x[p.me], py = (double)a->pref_y[p.me];
    double speed = sqrt(px * px + py * py);
    if (speed > 0.0) {
        Way w = choose_way(&p, cx, cy, speed, &lead);
        approach_way(&p, &w, &x, &y);
        *aside = w.x * px + w.y * py < 0.99 * speed;
        if (lead > 0.004 && !p.on_edge)
            result = hypot(x - (double)a->walk_x[p.me], y - (double)a->walk_y[p.me]);
    }
    close_law(&p);
    return result;
}

static void velocities_match_the_reference(void **state) {
    (void)state;
    int compared = 0, turned = 0;
    for (uint32_t number = 0; number < PACKETS; number++) {
        bool aside = false;
        double error = measure_error(number, &aside);
        if (isnan(error))
            continue;
        if (!(error < 0.004)) /* steps of half a millimetre towards walls */
            fail_msg("neighbourhood %u: %g m/s", number, error);
        compared++;
        turned += aside;
    }
    assert_true(compared > PACKETS / 2 && turned > PACKETS / 8);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(velocities_match_the_reference),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
