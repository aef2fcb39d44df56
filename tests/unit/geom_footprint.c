/* Tests the nearest point of a footprint against a plain search of all edges, bitwise. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "base/number/random.h"
#include "geom/objects.h"

static uint32_t drawn;

static float draw_footprint_number(void) {
    return (float)jox_random_unit(7, drawn++, 0, JOX_DRAW_FILL, 0);
}

static JoxFootprintPoint find_nearest_plainly(const JoxObject *body, JoxV2 point) {
    const uint32_t count = body->footprint_count;
    float nearest2 = INFINITY, deepest = -INFINITY;
    JoxFootprintPoint inside = {{1.0f, 0.0f}, point, 0.0f};
    JoxV2 on_border = point;
    for (uint32_t i = 0; i < count; i++) {
        const JoxV2 a = body->footprint[i], edge = jox_sub(body->footprint[(i + 1) % count], a);
        const JoxV2 to = jox_sub(point, a);
        const float length2 = jox_length2(edge);
        if (!(length2 > 0.0f))
            continue;
        const float along = jox_clampf(jox_dot(to, edge) / length2, 0.0f, 1.0f);
        const JoxV2 at = jox_add(a, jox_scale(edge, along));
        const float away2 = jox_length2(jox_sub(point, at));
        if (away2 < nearest2) {
            nearest2 = away2;
            on_border = at;
        }
        const JoxV2 outward = jox_scale(jox_v2(edge.y, -edge.x), 1.0f / sqrtf(length2));
        const float height = jox_dot(to, outward);
        if (height > deepest) {
            deepest = height;
            inside =
                (JoxFootprintPoint){outward, jox_sub(point, jox_scale(outward, height)), height};
        }
    }
    const JoxV2 away = jox_sub(point, on_border);
    const float gap = jox_length(away);
    if (!(deepest > 0.0f) || !(gap > 0.0f))
        return inside;
    return (JoxFootprintPoint){jox_scale(away, 1.0f / gap), on_border, gap};
}

/* Makes a ring of 3 to 16 corners on an ellipse anywhere. */
static JoxObject make_footprint_ring(uint32_t trial) {
    JoxObject body = {.footprint_count = 3 + trial % 14};
    const float x = 60.0f * draw_footprint_number() - 30.0f,
                y = 10.0f * draw_footprint_number() - 5.0f, turn = 6.28f * draw_footprint_number();
    const float size = trial % 50 ? 0.1f + 0.6f * draw_footprint_number() : 8.0f,
                flat = trial % 3 ? 1.0f : 0.05f;
    for (uint32_t k = 0; k < body.footprint_count; k++) {
        const float angle = 6.2831853f * (float)k / (float)body.footprint_count;
        const float u = size * cosf(angle), v = size * flat * sinf(angle);
        body.footprint[k] =
            jox_v2(x + cosf(turn) * u - sinf(turn) * v, y + sinf(turn) * u + cosf(turn) * v);
    }
    body.position = (JoxV3){x, y, 1.0f};
    body.disc = size;
    return body;
}

static JoxV2 interpolate_points(JoxV2 a, JoxV2 b, float share) {
    return jox_add(a, jox_scale(jox_sub(b, a), share));
}

static JoxV2 draw_query(const JoxObject *body, uint32_t query) {
    const JoxV2 *corners = body->footprint, centre = {body->position.x, body->position.y};
    const float reach = body->disc * (query % 3 == 0 ? 0.3f : query % 3 == 1 ? 1.1f : 4.0f);
    if (query == 0)
        return corners[1];
    if (query == 1)
        return interpolate_points(corners[0], corners[1], draw_footprint_number());
    if (query == 2)
        return interpolate_points(corners[body->footprint_count - 1], corners[0], 0.5f);
    if (query == 3)
        return centre;
    return jox_add(centre, jox_v2(reach * (2.0f * draw_footprint_number() - 1.0f),
                                  reach * (2.0f * draw_footprint_number() - 1.0f)));
}

static uint32_t inside_or_on;

static void compare_nearest(const JoxObject *body, JoxV2 point) {
    const JoxFootprintPoint wanted = find_nearest_plainly(body, point);
    const JoxFootprintPoint found = jox_footprint_nearest(body, point);
    inside_or_on += wanted.gap <= 0.0f;
    if (memcmp(&wanted, &found, sizeof found) != 0)
        fail_msg("of %u corners: gap %.9g is not %.9g", body->footprint_count, (double)found.gap,
                 (double)wanted.gap);
}

static void nearest_points_agree_with_a_plain_search(void **state) {
    (void)state;
    const uint32_t trials = 20000, queries = 20;
    for (uint32_t trial = 0; trial < trials; trial++) {
        const JoxObject body = make_footprint_ring(trial);
        for (uint32_t query = 0; query < queries; query++)
            compare_nearest(&body, draw_query(&body, query));
    }
    assert_in_range(inside_or_on, trials, trials * queries - trials); /* both kinds of points
                                                                         occurred */
}

static void degenerate_rings_agree_with_a_plain_search(void **state) {
    (void)state;
    for (uint32_t trial = 0; trial < 2000; trial++) {
        JoxObject body = make_footprint_ring(trial);
        const JoxV2 near = draw_query(&body, 5);
        body.footprint[1] = body.footprint[0]; /* an edge of length 0 */
        compare_nearest(&body, near);
        for (uint32_t k = 0; k < body.footprint_count; k++) /* a ring shrunk to a point */
            body.footprint[k] = body.footprint[0];
        compare_nearest(&body, near);
        body = make_footprint_ring(trial);
        body.footprint[trial % body.footprint_count].y += 1e30f;
        compare_nearest(&body, near);
        compare_nearest(&body, interpolate_points(body.footprint[0], body.footprint[1], 0.5f));
        body = make_footprint_ring(trial);
        for (uint32_t k = 0; k < body.footprint_count; k++)
            body.footprint[k].x += 1e20f;
        compare_nearest(&body, near);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nearest_points_agree_with_a_plain_search),
        cmocka_unit_test(degenerate_rings_agree_with_a_plain_search),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
