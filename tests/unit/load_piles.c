/* Loads in random piles in valleys: people of all sizes under forces of their own, each resting on
   two others or on another and a wall. With two contacts a person, equilibrium determines all
   forces. */
#include "base/number/random.h"
#include "unit/load_at_rest.h"

enum { PILES = 60, MOST_TRIES = 400 };
static const double CLEAR = 0.006; /* m, least gap between people who do not touch */
static const double LEAST = 0.06;  /* least contact force, relative to the pile's greatest */

static double draw(uint64_t pile, uint32_t what, double low, double high) {
    return low + (high - low) * jox_random_unit(pile, what, 0, JOX_DRAW_AIM, 2);
}

/* A wall of the valley: the line n . p = 0, with the normal n upwards. */
typedef struct Line {
    double x, y;
} Line;

/* Places a disc so that it touches two others, on the left of the direction from a to b. */
static bool place_upon_discs(const Disc *a, const Disc *b, double radius, Disc *out) {
    double dx = b->x - a->x, dy = b->y - a->y, d = hypot(dx, dy);
    double from = a->radius + radius, to = b->radius + radius;
    double along = (from * from - to * to + d * d) / (2.0 * d), up = from * from - along * along;
    if (!(up > 0.0))
        return false;
    out->x = a->x + (along * dx - sqrt(up) * dy) / d;
    out->y = a->y + (along * dy + sqrt(up) * dx) / d;
    return true;
}

/* Places a disc so that it touches a wall and another disc, farther up the wall. */
static bool place_upon_wall(const Line *wall, const Disc *a, double radius, Disc *out) {
    double above = a->x * wall->x + a->y * wall->y - radius, reach = a->radius + radius;
    double rest = reach * reach - above * above;
    double up = wall->x < 0.0 ? 1.0 : -1.0; /* along (y, -x) of the normal */
    if (!(rest > 0.0))
        return false;
    out->x = a->x - above * wall->x + up * sqrt(rest) * wall->y;
    out->y = a->y - above * wall->y - up * sqrt(rest) * wall->x;
    return true;
}

/* Whether a disc touches two things, and no other thing is near. */
static bool has_two_contacts(const Setup *s, const Line walls[2], const Disc *d) {
    uint32_t touches = 0;
    for (int w = 0; w < 2; w++) {
        double gap = d->x * walls[w].x + d->y * walls[w].y - d->radius;
        touches += fabs(gap) < 1e-6;
        if (fabs(gap) >= 1e-6 && gap < CLEAR)
            return false;
    }
    for (uint32_t i = 0; i < s->disc_count; i++) {
        double gap =
            hypot(d->x - s->discs[i].x, d->y - s->discs[i].y) - d->radius - s->discs[i].radius;
        touches += fabs(gap) < 1e-6;
        if (fabs(gap) >= 1e-6 && gap < CLEAR)
            return false;
    }
    return touches == 2;
}

/* Whether every contact of the pile presses, and none of them weakly. */
static bool is_firm(const Setup *s) {
    Contact contacts[MOST_CONTACTS];
    double rest, least = INFINITY, most = 0.0;
    uint32_t n;
    if (!solve_contacts(s, contacts, &n, &rest) || n != 2 * s->disc_count || rest > 1e-3)
        return false;
    for (uint32_t c = 0; c < n; c++) {
        least = fmin(least, contacts[c].newtons);
        most = fmax(most, contacts[c].newtons);
    }
    return least > LEAST * most;
}

/* Tries to add a person at a random place. */
static void add_disc(Setup *s, const Line walls[2], uint64_t pile, uint32_t attempt) {
    uint32_t own = 100 + 10 * attempt;
    double newtons = draw(pile, own, 150.0, 600.0), lean = draw(pile, own + 1, -0.3, 0.3);
    Disc d = {.radius = draw(pile, own + 2, 0.14, 0.26), .mass = draw(pile, own + 3, 40.0, 100.0)};
    d.force_x = newtons * sin(lean);
    d.force_y = -newtons * cos(lean);
    const Disc *one = &s->discs[(uint32_t)draw(pile, own + 4, 0.0, s->disc_count)];
    const Disc *two = &s->discs[(uint32_t)draw(pile, own + 5, 0.0, s->disc_count)];
    const Line *wall = &walls[draw(pile, own + 6, 0.0, 1.0) < 0.5];
    bool there = draw(pile, own + 7, 0.0, 1.0) < 0.5 ? place_upon_wall(wall, one, d.radius, &d)
                                                     : place_upon_discs(one, two, d.radius, &d);
    if (!there || !has_two_contacts(s, walls, &d) || hypot(d.x, d.y) > 2.5)
        return;
    s->discs[s->disc_count++] = d;
    if (!is_firm(s))
        s->disc_count--;
}

static Setup make_pile(uint64_t pile) {
    double left = draw(pile, 0, 0.5, 1.1), right = draw(pile, 1, 0.5, 1.1);
    const Line walls[2] = {{sin(left), cos(left)}, {-sin(right), cos(right)}};
    Setup s = {.disc_count = 1, .wall_count = 1, .loose_y = 0.003};
    double radius = draw(pile, 2, 0.14, 0.26), det = sin(left + right);
    s.discs[0] = (Disc){.x = radius * (cos(right) - cos(left)) / det,
                        .y = radius * (sin(left) + sin(right)) / det,
                        .force_y = -draw(pile, 3, 150.0, 600.0),
                        .radius = radius};
    s.walls[0] = (Wall){.xy = {-3 * cos(left), 3 * sin(left), 0, 0, 3 * cos(right), 3 * sin(right)},
                        .corners = 3};
    uint32_t most = (uint32_t)draw(pile, 4, 2.0, 10.0);
    for (uint32_t attempt = 0; attempt < MOST_TRIES && s.disc_count < most; attempt++)
        add_disc(&s, walls, pile, attempt);
    return s;
}

static void piles_bear_loads_of_equilibrium(void **state) {
    (void)state;
    int off = 0, people = 0;
    for (uint64_t pile = 0; pile < PILES; pile++) {
        Setup s = make_pile(pile);
        Figures hand[MOST_DISCS];
        solve_figures(&s, hand);
        int runs = count_off(&s, hand);
        if (runs)
            print_error("  that was pile %u of %u people\n", (unsigned)pile, s.disc_count);
        off += runs > 0;
        people += (int)s.disc_count;
    }
    assert_true(people > 4 * PILES); /* the piles are large */
    if (off)
        fail_msg("%d of %d piles are off", off, PILES);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(piles_bear_loads_of_equilibrium)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
