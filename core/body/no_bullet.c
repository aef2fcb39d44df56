/* Stand-in for bullet*.cc in a build without Bullet: adding a body fails, and all other calls do
   nothing. */
#include "base/mem.h"
#include "body/image.h"

struct JoxBodies {
    uint32_t nothing;
};

JoxBodies *jox_bodies_create(const JoxBodiesDef *def) {
    (void)def;
    return jox_alloc(1, sizeof(JoxBodies));
}
void jox_bodies_free(JoxBodies *bodies) {
    jox_free(bodies);
}
void jox_bodies_set_sheets(JoxBodies *bodies, float origin, float pitch) {
    (void)bodies, (void)origin, (void)pitch;
}

void jox_bodies_set_walls(JoxBodies *bodies, const JoxWalls *walls, float height) {
    (void)bodies, (void)walls, (void)height;
}
uint32_t jox_bodies_add(JoxBodies *bodies, const JoxBodyDef *def, JoxText *error) {
    (void)bodies, (void)def;
    if (error)
        jox_text_add(error, "this build has no Bullet, so it cannot simulate bodies");
    return JOX_NO_BODY;
}
bool jox_bodies_remove(JoxBodies *bodies, uint32_t row) {
    return (void)bodies, (void)row, false;
}
uint32_t jox_bodies_count(const JoxBodies *bodies) {
    return (void)bodies, 0;
}
uint32_t jox_bodies_rows(const JoxBodies *bodies) {
    return (void)bodies, 0;
}
uint32_t jox_bodies_id(const JoxBodies *bodies, uint32_t row) {
    return (void)bodies, (void)row, JOX_NO_BODY;
}
uint32_t jox_bodies_find(const JoxBodies *bodies, uint32_t id) {
    return (void)bodies, (void)id, JOX_NO_BODY;
}
uint32_t jox_bodies_find_name(const JoxBodies *bodies, const char *name) {
    return (void)bodies, (void)name, JOX_NO_BODY;
}
const char *jox_bodies_name(const JoxBodies *bodies, uint32_t row) {
    return (void)bodies, (void)row, "";
}
bool jox_bodies_pose(const JoxBodies *bodies, uint32_t row, JoxPose *pose) {
    (void)bodies, (void)row;
    *pose = (JoxPose){0};
    return false;
}
bool jox_bodies_describe_part(const JoxBodies *bodies, uint32_t row, uint32_t part,
                              JoxBodyLook *out) {
    (void)bodies, (void)row, (void)part;
    *out = (JoxBodyLook){0};
    return false;
}
bool jox_bodies_set_velocity(JoxBodies *bodies, uint32_t row, JoxV3 velocity, JoxV3 spin) {
    return (void)bodies, (void)row, (void)velocity, (void)spin, false;
}
bool jox_bodies_place(JoxBodies *bodies, uint32_t row, const double position[3],
                      const double turn[4]) {
    return (void)bodies, (void)row, (void)position, (void)turn, false;
}
bool jox_bodies_set_carrier(JoxBodies *bodies, uint32_t row, uint32_t agent_id) {
    return (void)bodies, (void)row, (void)agent_id, false;
}
void jox_bodies_carry(JoxBodies *bodies, uint32_t row, JoxV3 centre, JoxV3 velocity) {
    (void)bodies, (void)row, (void)centre, (void)velocity;
}
void jox_bodies_end_carrying(JoxBodies *bodies, uint32_t row, JoxV3 velocity) {
    (void)bodies, (void)row, (void)velocity;
}
bool jox_bodies_force(JoxBodies *bodies, uint32_t row, JoxV3 force) {
    return (void)bodies, (void)row, (void)force, false;
}
bool jox_bodies_impulse_sum(const JoxBodies *bodies, uint32_t row, double impulse[3],
                            double turn[3]) {
    (void)bodies, (void)row;
    for (int i = 0; i < 3; i++)
        impulse[i] = turn[i] = 0.0;
    return false;
}
void jox_bodies_reset_impulse_sums(JoxBodies *bodies) {
    (void)bodies;
}
bool jox_bodies_hold_up(JoxBodies *bodies, uint32_t row, float share) {
    (void)bodies, (void)row, (void)share;
    return false;
}

bool jox_bodies_ends_run(const JoxBodies *bodies, uint32_t row) {
    (void)bodies, (void)row;
    return false;
}

uint32_t jox_bodies_impulses(JoxBodies *bodies, const JoxImpulse *impulses, uint32_t count) {
    return (void)bodies, (void)impulses, count;
}
JoxBodiesReport jox_bodies_step(JoxBodies *bodies, float dt, JoxDisc *discs, uint32_t disc_count) {
    (void)bodies, (void)dt, (void)discs, (void)disc_count;
    return (JoxBodiesReport){0};
}
void jox_bodies_momentum(const JoxBodies *bodies, double out[3]) {
    (void)bodies;
    out[0] = out[1] = out[2] = 0.0;
}
bool jox_bodies_any_fast(const JoxBodies *bodies, float dt) {
    return (void)bodies, (void)dt, false;
}
void jox_bodies_objects(JoxBodies *bodies, JoxObjects *objects) {
    (void)bodies;
    objects->rows = NULL;
    objects->count = objects->capacity = 0;
}
bool jox_bodies_bonds(const JoxBodies *bodies, uint32_t row, JoxBodyBonds *bonds) {
    (void)bodies, (void)row;
    *bonds = (JoxBodyBonds){0};
    return false;
}
void jox_bodies_reinsert(JoxBodies *bodies) {
    (void)bodies;
}
void jox_bodies_capture(const JoxBodies *bodies, JoxBodiesImage *image) {
    (void)bodies;
    jox_bodies_image_free(image);
}
bool jox_bodies_rebuild(JoxBodies *bodies, const JoxBodiesImage *image, JoxText *error) {
    (void)bodies;
    if (image->body_count && error)
        jox_text_add(error, "this build has no Bullet, so it cannot simulate bodies");
    return image->body_count == 0;
}
void jox_bodies_sections(JoxBodies *bodies, JoxSections *sections) {
    JoxBodiesImage image = {0};
    JoxText wrong = {0};
    jox_bodies_image_sections(&image, sections);
    if (sections->mode == JOX_SECTIONS_RESTORE && !sections->failed &&
        !jox_bodies_rebuild(bodies, &image, &wrong))
        jox_sections_fail(sections, "bodies", wrong.data);
    jox_text_free(&wrong);
    jox_bodies_image_free(&image);
}
void jox_bodies_hash(const JoxBodies *bodies, JoxHash *hash) {
    JoxSections sections = jox_sections_hash();
    jox_bodies_sections((JoxBodies *)bodies, &sections); /* hashing does not change them */
    const uint64_t sum = jox_hash_end(&sections.hash);
    jox_hash_add(hash, &sum, sizeof sum);
}
void jox_bodies_set_timed(JoxBodies *bodies, bool timed) {
    (void)bodies, (void)timed;
}
bool jox_bodies_available(void) {
    return false;
}
