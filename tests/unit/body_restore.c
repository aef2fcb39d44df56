/* A run from a saved state of bodies equals the original bit for bit: walls break before and
   after, bodies are added, removed, carried, pushed, and asleep. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "body/image.h"

enum { SAVED = JOX_BODIES_REINSERT_STEPS, LAST = SAVED + 200 };

static JoxBodies *create_walled_bodies(void) {
    JoxBodiesDef def = jox_bodies_def();
    JoxBodies *b = jox_bodies_create(&def);
    JoxWalls walls = {0};
    const JoxV2 corners[] = {{-9, -9}, {9, -9}, {9, 9}, {-9, 9}};
    jox_walls_add_polyline(&walls, corners, 4, true, 3.0f);
    jox_bodies_set_walls(b, &walls, 3.0f);
    jox_walls_free(&walls);
    return b;
}

static uint32_t add_named_body(JoxBodies *b, JoxBodyDef def, const char *name, double x, double y,
                               double z) {
    const double at[3] = {x, y, z};
    memcpy(def.position, at, sizeof at);
    def.name = name;
    JoxText why = {0};
    uint32_t row = jox_bodies_add(b, &def, &why);
    if (row == JOX_NO_BODY)
        fail_msg("%s", why.data);
    return row;
}

static JoxBodyDef make_wall_of_thirty_blocks(double bond) {
    JoxBodyDef d = jox_body_def();
    d.shape.kind = JOX_SHAPE_BLOCKS;
    const double size[3] = {0.4, 0.2, 0.2};
    const uint32_t count[3] = {6, 1, 5};
    memcpy(d.shape.size, size, sizeof size);
    memcpy(d.shape.count, count, sizeof count);
    d.shape.bond = bond;
    d.mass = 200;
    d.tags = (uint64_t)1 << 40;
    return d;
}

static void add_all_kinds_of_bodies(JoxBodies *b) {
    JoxBodyDef box = jox_body_def(), ball = box, tin = box, hull = box, table = box;
    for (int i = 0; i < 4; i++)
        add_named_body(b, box, i ? NULL : "lowest", 5, 5, 0.5 + i);
    ball.shape.kind = JOX_SHAPE_SPHERE;
    ball.shape.size[0] = 0.11;
    ball.mass = 0.4;
    ball.velocity[0] = 9;
    ball.restitution = 0.8;
    for (int i = 0; i < 5; i++)
        add_named_body(b, ball, i ? NULL : "ball", -5, 0.1 * i, 1.0 + 0.3 * i);
    tin.shape.kind = JOX_SHAPE_CYLINDER;
    tin.shape.size[0] = 0.3;
    tin.shape.size[1] = 0.8;
    tin.turn[1] = 0.6;
    tin.turn[3] = 0.8;
    add_named_body(b, tin, "tin", 0, 5, 1.5);
    static const double POINTS[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0.2, 0.2, 1, 0.8, 0.7, 0.6};
    hull.shape.kind = JOX_SHAPE_HULL;
    hull.shape.points = POINTS;
    hull.shape.point_count = 5;
    add_named_body(b, hull, "hull", 0, 6, 2.5);
    JoxBodyPart parts[2] = {{.mass = 20, .position = {0, 0, 0.7}}, {.density = 300}};
    parts[0].shape.size[0] = parts[0].shape.size[1] = 1.2;
    parts[0].shape.size[2] = 0.1;
    parts[1].shape.size[0] = parts[1].shape.size[1] = 0.2;
    parts[1].shape.size[2] = 1.4;
    table.shape.kind = JOX_SHAPE_COMPOUND;
    table.shape.parts = parts;
    table.shape.part_count = 2;
    add_named_body(b, table, "table", -3, 5, 1.0);
    table.still = true;
    add_named_body(b, table, "post", -5, 5, 0.7);
    JoxBodyDef door = box, bar = box;
    double points[] = {3, 5, 0.3, 5, 3, 0.3, 8, 5, 0.6};
    door.kinematic = true;
    door.path = (JoxBodyPath){.points = points,
                              .count = 3,
                              .end = JO_PATH_BACK,
                              .speed = 0.7,
                              .wait = 0.6,
                              .reopens = true};
    door.force_limit = 200;
    add_named_body(b, door, "door", 3, 5, 0.3);
    bar.shape.size[0] = 4;
    bar.kinematic = true;
    bar.spin[2] = 0.4;
    add_named_body(b, bar, "bar", -1, 4, 0.6);
    add_named_body(b, make_wall_of_thirty_blocks(400), "early", 0, -3, 0.5);
    add_named_body(b, make_wall_of_thirty_blocks(3000), "late", 0, -5, 0.5);
}

/* Acts on the bodies before a step; the actions depend on its number alone. */
static void act_before_step(JoxBodies *b, uint32_t tick) {
    uint32_t early = jox_bodies_find_name(b, "early"), late = jox_bodies_find_name(b, "late");
    JoxImpulse pushes[] = {{.object = early, .point = {0.7f, -3.1f, 0.9f}, .impulse = {0, 40, 0}},
                           {.object = late, .point = {0.7f, -5.1f, 0.9f}, .impulse = {0, 400, 0}}};
    if (tick > 60 && tick < 80)
        jox_bodies_impulses(b, pushes, 1);
    if (tick > SAVED + 40 && tick < SAVED + 60)
        jox_bodies_impulses(b, pushes + 1, 1);
    const uint32_t door = jox_bodies_find_name(b, "door"), bar = jox_bodies_find_name(b, "bar");
    if (tick >= SAVED - 40 && tick % 7 == 0) /* people hold it up */
        jox_bodies_hold_up(b, door, 0.0f);
    if (tick % 5 < 2) /* also in the saved step */
        jox_bodies_hold_up(b, bar, 0.25f);
    uint32_t ball = jox_bodies_find_name(b, "ball"), tin = jox_bodies_find_name(b, "tin");
    if (tick == SAVED - 20)
        jox_bodies_set_carrier(b, ball, 7);
    if (tick >= SAVED - 20 && tick < SAVED + 30)
        jox_bodies_carry(b, ball, (JoxV3){0.05f * (float)(tick % 60), -1, 1.2f}, (JoxV3){1, 0, 0});
    if (tick == SAVED + 30)
        jox_bodies_end_carrying(b, ball, (JoxV3){0, 6, 2});
    if (tick % 7 == 0)
        jox_bodies_force(b, tin, (JoxV3){30, 0, 0});
    if (tick == SAVED - 5 || tick == SAVED + 25) {
        JoxBodyDef box = jox_body_def();
        box.velocity[1] = -6;
        add_named_body(b, box, "thrown", 1, 8, 1);
    }
    if (tick == SAVED - 9 || tick == SAVED + 60)
        jox_bodies_set_velocity(b, bar, (JoxV3){0.3f, tick > SAVED ? -0.5f : 0.2f, 0},
                                (JoxV3){0, 0, 0.6f});
    if (tick == SAVED + 90)
        jox_bodies_remove(b, jox_bodies_find_name(b, "hull"));
}

static uint64_t hash_restored_bodies(const JoxBodies *b) {
    JoxHash hash = jox_hash_begin();
    jox_bodies_hash(b, &hash);
    return jox_hash_end(&hash);
}

static uint32_t run_bodies(JoxBodies *b, uint32_t from, uint32_t until, uint64_t *hashes) {
    uint32_t cut = 0;
    for (uint32_t tick = from; tick < until; tick++) {
        hashes[tick] = hash_restored_bodies(b);
        JoxDisc disc = {.x = 3, .y = 0.2f, .radius = 0.3f, .mass = 70};
        act_before_step(b, tick);
        if (tick % JOX_BODIES_REINSERT_STEPS == 0)
            jox_bodies_reinsert(b);
        JoxObjects objects = {0};
        jox_bodies_objects(b, &objects);
        JoxBodiesReport report = jox_bodies_step(b, 0.05f, &disc, 1);
        for (uint32_t k = 0; k < report.break_count; k++)
            cut += report.breaks[k].bonds;
    }
    return cut;
}

static void expect_equal_hashes(const uint64_t *one, const uint64_t *other) {
    for (uint32_t tick = SAVED; tick < LAST; tick++)
        if (one[tick] != other[tick])
            fail_msg("hashes differ from step %u on, saved at %d", tick, SAVED);
}

static void restored_run_equals_the_original(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    static uint64_t hashes[LAST], again[LAST];
    JoxBodies *b = create_walled_bodies();
    JoxBodiesImage image = {0};
    add_all_kinds_of_bodies(b);
    assert_true(run_bodies(b, 0, SAVED, hashes) > 0); /* one wall breaks before the save */
    jox_bodies_capture(b, &image);
    assert_true(run_bodies(b, SAVED, LAST, hashes) > 0); /* one breaks after it */
    assert_true(jox_bodies_rebuild(b, &image, NULL));
    run_bodies(b, SAVED, LAST, again);
    expect_equal_hashes(hashes, again);
    jox_bodies_free(b);

    b = create_walled_bodies(); /* a world without bodies */
    JoxText why = {0};
    assert_true(jox_bodies_rebuild(b, &image, &why));
    assert_string_equal(jox_bodies_name(b, jox_bodies_find_name(b, "table")), "table");
    run_bodies(b, SAVED, LAST, again);
    expect_equal_hashes(hashes, again);
    jox_bodies_free(b);
    jox_bodies_image_free(&image);
}

/* The same through sections: saves to a buffer, restores, compares. */
static void sections_hold_the_complete_state(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    static uint64_t hashes[LAST], again[LAST];
    JoxBodies *b = create_walled_bodies(), *other = create_walled_bodies();
    add_all_kinds_of_bodies(b);
    run_bodies(b, 0, SAVED, hashes);
    JoxText buffer = {0};
    JoxSections s = jox_sections_save(&buffer);
    jox_bodies_sections(b, &s);
    assert_true(jox_sections_end(&s));
    s = jox_sections_restore(buffer.data, buffer.length);
    jox_bodies_sections(other, &s);
    if (!jox_sections_end(&s))
        fail_msg("%s", s.wrong);
    s = jox_sections_compare(buffer.data, buffer.length);
    jox_bodies_sections(other, &s);
    assert_true(jox_sections_end(&s));
    run_bodies(b, SAVED, LAST, hashes);
    run_bodies(other, SAVED, LAST, again);
    expect_equal_hashes(hashes, again);
    s = jox_sections_compare(buffer.data, buffer.length);
    jox_bodies_sections(b, &s);
    assert_false(jox_sections_end(&s));
    assert_non_null(strstr(s.wrong, "bodies."));
    jox_text_free(&buffer);
    jox_bodies_free(b);
    jox_bodies_free(other);
}

typedef struct Flip {
    const JoxBodies *bodies;
    uint64_t before;
    uint32_t count;
} Flip;

static void flip_each_byte(void *context, const char *section, size_t index, void *cell,
                           size_t size, bool hashed) {
    Flip *flip = context;
    uint8_t *bytes = cell;
    assert_true(hashed);
    for (size_t at = 0; at < size; at++, flip->count++) {
        bytes[at] ^= 0x10;
        if (hash_restored_bodies(flip->bodies) == flip->before)
            fail_msg("byte %zu of %s[%zu] is no part of the hash", at, section, index);
        bytes[at] ^= 0x10;
    }
}

static void each_byte_of_body_state_is_hashed(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    JoxBodies *b = create_walled_bodies();
    add_all_kinds_of_bodies(b);
    Flip context = {b, hash_restored_bodies(b), 0};
    JoxSections s = jox_sections_visit(flip_each_byte, &context);
    jox_bodies_sections(b, &s);
    assert_true(context.count > 10000);
    assert_true(hash_restored_bodies(b) == context.before);
    jox_bodies_free(b);
}

/* In the step of a re-insertion standing bodies do not jump, and sleeping ones stay asleep. */
static void re_insertion_keeps_bodies_at_rest(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    JoxBodies *b = create_walled_bodies();
    uint32_t rows[7];
    for (int i = 0; i < 5; i++)
        rows[i] = add_named_body(b, jox_body_def(), "box", 5, 5, 0.5 + i);
    rows[5] = add_named_body(b, make_wall_of_thirty_blocks(3000), "wall", 0, 0, 0.5);
    rows[6] = add_named_body(b, jox_body_def(), "asleep", -5, 5, 0.5);
    JoxPose before[7], after;
    for (uint32_t i = 0; i < 5 * JOX_BODIES_REINSERT_STEPS; i++) {
        const JoxImpulse nudges[] = {
            {.object = rows[4], .point = {5, 5, 4.5f}, .impulse = {0, 0, -1}},
            {.object = rows[5], .point = {0, 0, 1}, .impulse = {0, 0, -1}}};
        jox_bodies_impulses(b, nudges, 2); /* keeps the bodies awake */
        for (int k = 0; k < 7; k++)
            jox_bodies_pose(b, rows[k], &before[k]);
        const bool anew = i % JOX_BODIES_REINSERT_STEPS == 0 && i > 0;
        if (anew)
            jox_bodies_reinsert(b);
        jox_bodies_step(b, 0.05f, NULL, 0);
        for (int k = 0; anew && k < 7; k++) {
            const float nearly = k < 6 ? 5e-4f : 0.0f; /* m */
            jox_bodies_pose(b, rows[k], &after);
            assert_float_equal(after.centre.x, before[k].centre.x, nearly);
            assert_float_equal(after.centre.y, before[k].centre.y, nearly);
            assert_float_equal(after.centre.z, before[k].centre.z, nearly);
            for (int q = 0; q < 4; q++)
                assert_float_equal(after.turn[q], before[k].turn[q], nearly);
        }
    }
    jox_bodies_free(b);
}

/* An image with any invalid number is refused, and the bodies stay unchanged. */
static void invalid_images_are_refused(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    static uint64_t hashes[LAST];
    JoxBodies *b = create_walled_bodies();
    add_all_kinds_of_bodies(b);
    run_bodies(b, 0, 100, hashes);
    JoxBodiesImage image = {0};
    jox_bodies_capture(b, &image);
    const uint64_t before = hash_restored_bodies(b);
    JoxBodyRecord *door = image.bodies;
    while (!door->path_count)
        door++;
    struct {
        void *cell;
        uint32_t wrong;
    } changes[] = {{&image.counters.next_id, 3},
                   {&image.counters.row_count, 2},
                   {&image.counters.row_count, 60000}, /* more rows than ids were given */
                   {&image.bodies[3].row, image.bodies[2].row},
                   {&image.bodies[3].id, image.bodies[2].id},
                   {&image.bodies[1].activation, 77},
                   {&image.bodies[1].motion[10], 0x7fc00000}, /* not a number */
                   {&image.bodies[1].name_length, 900},
                   {&image.bodies[1].part_count, 2},
                   {&image.bodies[1].block_count, 1},
                   {&image.parts[0].kind, JOX_SHAPE_COMPOUND},
                   {&image.parts[0].point_count, 5},
                   {&image.blocks[2].cell[0], 4000},
                   {&image.bonds[2].b, 5000},
                   {&image.bonds[2].axis, 3},
                   {&image.contacts[0].impulse[0], 0x7f800000}, /* infinite */
                   {&door->still, JOX_BODY_STATIC},
                   {&door->still, 3},
                   {&door->path_count, 4},
                   {&door->path_end, JO_PATH_ROUND + 1},
                   {&door->path_back, 2},
                   {(uint32_t *)&door->force_limit + 1, 0xbff00000},
                   {(uint32_t *)&door->held_up + 1, 0x40000000}, /* 2 */
                   {&door->drive, 8},
                   {&image.bodies[1].drive, 1},
                   {&door->motion[9], 0x7e967699},                  /* 1e38 m */
                   {&door->motion[25], 0x501502f9},                 /* 1e10 m/s */
                   {(uint32_t *)&door->path_speed + 1, 0xbff00000}, /* about -1 */
                   {(uint32_t *)&image.path_points[4] + 1, 0x7ff80000},
                   {&image.point_count, 3}};
    for (size_t k = 0; k < sizeof changes / sizeof *changes; k++) {
        uint32_t kept;
        memcpy(&kept, changes[k].cell, sizeof kept);
        memcpy(changes[k].cell, &changes[k].wrong, sizeof kept);
        JoxText why = {0};
        if (jox_bodies_rebuild(b, &image, &why))
            fail_msg("change %zu was taken", k);
        assert_non_null(why.data);
        jox_text_free(&why);
        assert_true(hash_restored_bodies(b) == before);
        memcpy(changes[k].cell, &kept, sizeof kept);
    }
    image.counters.next_id = image.counters.row_count = 1 << 24; /* the rows would take gigabytes */
    assert_false(jox_bodies_rebuild(b, &image, NULL));
    assert_true(hash_restored_bodies(b) == before);
    jox_bodies_capture(b, &image);
    image.parts[0].size[0] = -1.0; /* refused when the shape is made */
    assert_false(jox_bodies_rebuild(b, &image, NULL));
    assert_true(hash_restored_bodies(b) == before);
    jox_bodies_free(b);
    jox_bodies_image_free(&image);
}

/* Reading the objects between two steps, or after a restore, changes no state. */
static void reading_objects_changes_no_state(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    JoxBodies *b = create_walled_bodies();
    JoxObjects objects = {0};
    JoxBodyDef small = jox_body_def();
    small.shape.kind = JOX_SHAPE_SPHERE;
    small.shape.size[0] = 0.11;
    const uint32_t ball = add_named_body(b, small, "ball", 0, 0, 0.5);
    jox_bodies_objects(b, &objects);
    jox_bodies_step(b, 0.05f, NULL, 0);
    assert_true(jox_bodies_set_carrier(b, ball, 1));
    jox_bodies_end_carrying(b, ball, (JoxV3){0, 30, 0}); /* fast from now on */
    const uint64_t before = hash_restored_bodies(b);
    jox_bodies_objects(b, &objects);
    assert_true(hash_restored_bodies(b) == before);
    jox_bodies_free(b);
}

/* A single block cannot break: it is saved and restored like a box. */
static void single_block_is_restored(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    JoxBodies *b = create_walled_bodies();
    JoxBodyDef one = make_wall_of_thirty_blocks(400);
    one.shape.count[0] = one.shape.count[2] = 1;
    add_named_body(b, one, "one", 0, 0, 1);
    JoxBodiesImage image = {0};
    JoxText why = {0};
    jox_bodies_capture(b, &image);
    const uint64_t before = hash_restored_bodies(b);
    if (!jox_bodies_rebuild(b, &image, &why))
        fail_msg("%s", why.data);
    assert_true(hash_restored_bodies(b) == before);
    jox_bodies_free(b);
    jox_bodies_image_free(&image);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(reading_objects_changes_no_state),
                                       cmocka_unit_test(single_block_is_restored),
                                       cmocka_unit_test(restored_run_equals_the_original),
                                       cmocka_unit_test(sections_hold_the_complete_state),
                                       cmocka_unit_test(each_byte_of_body_state_is_hashed),
                                       cmocka_unit_test(re_insertion_keeps_bodies_at_rest),
                                       cmocka_unit_test(invalid_images_are_refused)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
