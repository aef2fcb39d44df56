/* Outlines of bodies from above, part by part, for worlds and for recordings. */
#include <math.h>

#include "body/footprint.h"

#include "base/mem.h"
#include "base/number/pi.h"
#include "base/sort.h"
#include "picture/draw_parts.h"

enum { RIM = 16, MOST_CORNERS = 256 }; /* points of a cylinder's rim; corners of a part */
/* Least cosine of a cylinder's tilt at which it is drawn as a disc. */
static const float UPRIGHT = 0.9999f;

/* Rotates a vector by a unit quaternion (x, y, z, w). */
static JoxV3 rotate_vector(const float q[4], JoxV3 v) {
    JoxV3 t = {2 * (q[1] * v.z - q[2] * v.y), 2 * (q[2] * v.x - q[0] * v.z),
               2 * (q[0] * v.y - q[1] * v.x)};
    return (JoxV3){v.x + q[3] * t.x + q[1] * t.z - q[2] * t.y,
                   v.y + q[3] * t.y + q[2] * t.x - q[0] * t.z,
                   v.z + q[3] * t.z + q[0] * t.y - q[1] * t.x};
}

static JoxV3 add_vectors(JoxV3 a, JoxV3 b) {
    return (JoxV3){a.x + b.x, a.y + b.y, a.z + b.z};
}

/* Lists the corners of a part in its own frame, m; for a cylinder, points of both rims. Returns
   their number. */
static uint32_t list_corners(const JoxBodyLook *look, JoxV3 out[MOST_CORNERS]) {
    const float *s = look->size;
    uint32_t count = 0;
    if (look->kind == JOX_SHAPE_BOX)
        for (int c = 0; c < 8; c++)
            out[count++] = (JoxV3){c & 1 ? s[0] / 2 : -s[0] / 2, c & 2 ? s[1] / 2 : -s[1] / 2,
                                   c & 4 ? s[2] / 2 : -s[2] / 2};
    else if (look->kind == JOX_SHAPE_CYLINDER)
        for (int c = 0; c < 2 * RIM; c++) {
            float angle = (float)JOX_TURN * (float)(c / 2) / RIM;
            out[count++] =
                (JoxV3){s[0] * cosf(angle), s[0] * sinf(angle), c & 1 ? s[1] / 2 : -s[1] / 2};
        }
    else
        for (; count < look->corner_count && count < MOST_CORNERS; count++)
            out[count] = look->corners[count];
    return count;
}

static int compare_points_by_x(const void *a, const void *b, const void *context) {
    (void)context;
    const JoxV2 *p = a, *q = b;
    if (p->x != q->x)
        return p->x < q->x ? -1 : 1;
    return (p->y > q->y) - (p->y < q->y);
}

/* Finds the convex hull, counter-clockwise (A. M. Andrew, 1979). Sorts `points`. Returns the
   number of corners in `out`. */
static uint32_t find_convex_hull(JoxV2 *points, uint32_t count, JoxV2 out[2 * MOST_CORNERS]) {
    uint32_t n = 0;
    jox_sort(points, count, sizeof *points, compare_points_by_x, NULL, NULL);
    for (int side = 0; side < 2; side++) {
        uint32_t least = n + 1;
        for (uint32_t i = 0; i < count; i++) {
            JoxV2 p = points[side ? count - 1 - i : i];
            while (n > least &&
                   jox_det(jox_sub(out[n - 1], out[n - 2]), jox_sub(p, out[n - 2])) <= 0.0f)
                n--;
            out[n++] = p;
        }
        n--; /* the last point of one side is the first of the other */
    }
    return n;
}

bool jox_draw_outline(const JoxBodyLook *look, JoxV3 at, const float turn[4], JoxDrawnBody *out) {
    JoxV3 middle = add_vectors(at, rotate_vector(turn, look->at)), corners[MOST_CORNERS];
    JoxV2 points[MOST_CORNERS], ring[2 * MOST_CORNERS];
    JoxV3 axis = rotate_vector(turn, rotate_vector(look->turn, (JoxV3){0, 0, 1}));
    *out = (JoxDrawnBody){.name = "", .at = {middle.x, middle.y}, .radius = look->size[0]};
    bool upright = look->kind == JOX_SHAPE_CYLINDER && fabsf(axis.z) >= UPRIGHT;
    if (look->kind == JOX_SHAPE_SPHERE || upright) {
        float half = upright ? look->size[1] / 2 : look->size[0];
        out->low = middle.z - half;
        out->top = middle.z + half;
        return isfinite(middle.x) && isfinite(middle.y);
    }
    uint32_t count = list_corners(look, corners);
    for (uint32_t c = 0; c < count; c++) {
        JoxV3 p = add_vectors(
            at, rotate_vector(turn, add_vectors(look->at, rotate_vector(look->turn, corners[c]))));
        if (!(isfinite(p.x) && isfinite(p.y)))
            return false;
        points[c] = jox_v2(p.x, p.y);
        out->low = c ? jox_minf(out->low, p.z) : p.z;
        out->top = c ? jox_maxf(out->top, p.z) : p.z;
    }
    if (count < 3)
        return false;
    count = find_convex_hull(points, count, ring);
    uint32_t every = (count + JOX_OUTLINE_POINTS - 1) / JOX_OUTLINE_POINTS;
    for (uint32_t c = 0; c < count; c += every)
        out->ring[out->count++] = ring[c];
    return true;
}

void jox_draw_mark_high(JoxDrawnBody *parts, size_t count) {
    bool touched = false;
    for (size_t p = 0; p < count; p++)
        touched |= parts[p].top > JOX_BAND_LOW && parts[p].low < JOX_BAND_HIGH;
    for (size_t p = 0; p < count; p++)
        parts[p].high = !touched;
}

/* Reads part `part` of body `body` from a source; returns false past the last part. */
typedef bool ReadPart(void *source, uint32_t body, uint32_t part, JoxBodyLook *out);

/* Appends the outlines of all parts of a body at a position and rotation. */
static void add_body_parts(JoxDrawnBodies *out, ReadPart *read_part, void *source, uint32_t body,
                           const char *name, JoxV3 at, const float turn[4]) {
    const size_t first = out->count;
    JoxBodyLook part;
    for (uint32_t n = 0; read_part(source, body, n, &part); n++) {
        JOX_RESERVE(out->items, out->capacity, out->count + 1);
        if (jox_draw_outline(&part, at, turn, &out->items[out->count]))
            out->items[out->count++].name = name;
    }
    if (out->count > first)
        jox_draw_mark_high(out->items + first, out->count - first);
}

static bool read_world_part(void *source, uint32_t row, uint32_t part, JoxBodyLook *out) {
    return jox_bodies_describe_part(source, row, part, out);
}

void jox_draw_add_bodies(JoxDrawnBodies *out, const JoxBodies *bodies) {
    for (uint32_t row = 0; bodies && row < jox_bodies_rows(bodies); row++) {
        JoxPose pose;
        if (jox_bodies_pose(bodies, row, &pose))
            add_body_parts(out, read_world_part, (void *)(uintptr_t)bodies, row,
                           jox_bodies_name(bodies, row), pose.position, pose.turn);
    }
}

/* Source of read_recorded_part. */
typedef struct Recorded {
    JoxTrajectoryReader *reader;
    uint32_t frame;
} Recorded;

static bool read_recorded_part(void *source, uint32_t body, uint32_t part, JoxBodyLook *out) {
    Recorded *recorded = source;
    return jox_trajectory_reader_part(recorded->reader, recorded->frame, body, part, out);
}

void jox_draw_add_recorded(JoxDrawnBodies *out, JoxTrajectoryReader *reader, double time) {
    Recorded recorded = {reader, jox_trajectory_reader_find(reader, time)};
    JoxTrajectoryReaderFrame frame;
    JoxText why = {0};
    if (jox_trajectory_reader_read(reader, recorded.frame, &frame, &why))
        for (uint32_t b = 0; b < frame.body_count; b++) {
            const JoxRecordBody *body = &frame.bodies[b];
            const float turn[4] = {body->qx, body->qy, body->qz, body->qw};
            add_body_parts(out, read_recorded_part, &recorded, body->id, "",
                           (JoxV3){body->x, body->y, body->z}, turn);
        }
    jox_text_free(&why);
}
