/* Bodies for pictures: of the running world, or as a recording has them. */
#include "base/mem.h"
#include "render/render.h"

/* Adds parts of one body until `look` has no more. */
typedef bool Look(void *source, uint32_t body, uint32_t part, JoxBodyLook *out);

static void add(JoxRender *r, Look *look, void *source, uint32_t body, const char *name, JoxV3 at,
                const float turn[4]) {
    JoxPicture *p = &r->picture;
    uint32_t first = p->body_count;
    JoxBodyLook part;
    for (uint32_t n = 0; look(source, body, n, &part); n++) {
        JOX_RESERVE(r->bodies, r->body_capacity, p->body_count + 1);
        if (!jox_draw_outline(&part, at, turn, &r->bodies[p->body_count]))
            continue;
        r->bodies[p->body_count++].name = name;
    }
    jox_draw_reach(r->bodies + first, p->body_count - first);
}

static bool look_at_world(void *source, uint32_t row, uint32_t part, JoxBodyLook *out) {
    return jox_bodies_look(source, row, part, out);
}

static void add_all_of_world(JoxRender *r) {
    JoxBodies *bodies = r->scene->world->state.bodies;
    for (uint32_t row = 0; row < jox_bodies_rows(bodies); row++) {
        JoxPose pose;
        if (jox_bodies_pose(bodies, row, &pose))
            add(r, look_at_world, bodies, row, jox_bodies_name(bodies, row), pose.position,
                pose.turn);
    }
}

typedef struct Recorded {
    JoxTrajectoryReader *reader;
    uint32_t frame;
} Recorded;

static bool look_at_reel(void *source, uint32_t body, uint32_t part, JoxBodyLook *out) {
    Recorded *recorded = source;
    return jox_trajectory_reader_part(recorded->reader, recorded->frame, body, part, out);
}

static void add_all_of_reel(JoxRender *r) {
    Recorded recorded = {r->reader,
                         jox_trajectory_reader_find(r->reader, r->frame.time + 0.25 * r->pace)};
    JoxTrajectoryReaderFrame frame;
    JoxText why = {0};
    if (jox_trajectory_reader_read(r->reader, recorded.frame, &frame, &why))
        for (uint32_t b = 0; b < frame.body_count; b++) {
            const JoxRecordBody *body = &frame.bodies[b];
            const float turn[4] = {body->qx, body->qy, body->qz, body->qw};
            add(r, look_at_reel, &recorded, body->id, "", (JoxV3){body->x, body->y, body->z}, turn);
        }
    jox_text_free(&why);
}

void jox_render_bodies(JoxRender *r) {
    r->picture.body_count = 0;
    if (r->scene)
        add_all_of_world(r);
    else if (r->reader)
        add_all_of_reel(r);
    r->picture.bodies = r->bodies;
}
