/* A saved state of bodies goes on as the run itself did, to the bit: walls that break before and
   after, bodies that came and went, that are carried, pushed, and asleep. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "body/image.h"

enum { SAVED = JOX_BODIES_REINSERT_STEPS, LAST = SAVED + 200 };

static JoxBodies *create(void) {
    JoxBodiesDef def = jox_bodies_def();
    JoxBodies *b = jox_bodies_create(&def);
    JoxWalls walls = {0};
    const JoxV2 corners[] = {{-9, -9}, {9, -9}, {9, 9}, {-9, 9}};
    jox_walls_add_polyline(&walls, corners, 4, true, 3.0f);
    jox_bodies_set_walls(b, &walls, 3.0f);
    jox_walls_free(&walls);
    return b;
}

static uint32_t add(JoxBodies *b, JoxBodyDef def, const char *name, double x, double y, double z) {
    const double at[3] = {x, y, z};
    memcpy(def.position, at, sizeof at);
    def.name = name;
    JoxText why = {0};
    uint32_t row = jox_bodies_add(b, &def, &why);
    if (row == JOX_NO_BODY)
        fail_msg("%s", why.data);
    return row;
}

static JoxBodyDef blocks(double bond) {
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

static void fill(JoxBodies *b) {
    JoxBodyDef box = jox_body_def(), ball = box, tin = box, hull = box, table = box;
    for (int i = 0; i < 4; i++)
        add(b, box, i ? NULL : "lowest", 5, 5, 0.5 + i);
    ball.shape.kind = JOX_SHAPE_SPHERE;
    ball.shape.size[0] = 0.11;
    ball.mass = 0.4;
    ball.velocity[0] = 9;
    ball.restitution = 0.8;
    for (int i = 0; i < 5; i++)
        add(b, ball, i ? NULL : "ball", -5, 0.1 * i, 1.0 + 0.3 * i);
    tin.shape.kind = JOX_SHAPE_CYLINDER;
    tin.shape.size[0] = 0.3;
    tin.shape.size[1] = 0.8;
    tin.turn[1] = 0.6;
    tin.turn[3] = 0.8;
    add(b, tin, "tin", 0, 5, 1.5);
    static const double POINTS[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0.2, 0.2, 1, 0.8, 0.7, 0.6};
    hull.shape.kind = JOX_SHAPE_HULL;
    hull.shape.points = POINTS;
    hull.shape.point_count = 5;
    add(b, hull, "hull", 0, 6, 2.5);
    JoxBodyPart parts[2] = {{.mass = 20, .position = {0, 0, 0.7}}, {.density = 300}};
    parts[0].shape.size[0] = parts[0].shape.size[1] = 1.2;
    parts[0].shape.size[2] = 0.1;
    parts[1].shape.size[0] = parts[1].shape.size[1] = 0.2;
    parts[1].shape.size[2] = 1.4;
    table.shape.kind = JOX_SHAPE_COMPOUND;
    table.shape.parts = parts;
    table.shape.part_count = 2;
    add(b, table, "table", -3, 5, 1.0);
    table.still = true;
    add(b, table, "post", -5, 5, 0.7);
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
    add(b, door, "door", 3, 5, 0.3);
    bar.shape.size[0] = 4;
    bar.kinematic = true;
    bar.spin[2] = 0.4;
    add(b, bar, "bar", -1, 4, 0.6);
    add(b, blocks(400), "early", 0, -3, 0.5);
    add(b, blocks(3000), "late", 0, -5, 0.5);
}

/* What is done to the bodies before a step follows from its number alone. */
static void act(JoxBodies *b, uint32_t tick) {
    uint32_t early = jox_bodies_find_name(b, "early"), late = jox_bodies_find_name(b, "late");
    JoxImpulse pushes[] = {{.object = early, .point = {0.7f, -3.1f, 0.9f}, .impulse = {0, 40, 0}},
                           {.object = late, .point = {0.7f, -5.1f, 0.9f}, .impulse = {0, 400, 0}}};
    if (tick > 60 && tick < 80)
        jox_bodies_impulses(b, pushes, 1);
    if (tick > SAVED + 40 && tick < SAVED + 60)
        jox_bodies_impulses(b, pushes + 1, 1);
    const uint32_t door = jox_bodies_find_name(b, "door"), bar = jox_bodies_find_name(b, "bar");
    if (tick >= SAVED - 40 && tick % 7 == 0) /* it meets somebody */
        jox_bodies_hold_up(b, door, 0.0f);
    if (tick % 5 < 2) /* in the step that is saved, too */
        jox_bodies_hold_up(b, bar, 0.25f);
    uint32_t ball = jox_bodies_find_name(b, "ball"), tin = jox_bodies_find_name(b, "tin");
    if (tick == SAVED - 20)
        jox_bodies_hold(b, ball, 7);
    if (tick >= SAVED - 20 && tick < SAVED + 30)
        jox_bodies_carry(b, ball, (JoxV3){0.05f * (float)(tick % 60), -1, 1.2f}, (JoxV3){1, 0, 0});
    if (tick == SAVED + 30)
        jox_bodies_let_go(b, ball, (JoxV3){0, 6, 2});
    if (tick % 7 == 0)
        jox_bodies_force(b, tin, (JoxV3){30, 0, 0});
    if (tick == SAVED - 5 || tick == SAVED + 25) {
        JoxBodyDef box = jox_body_def();
        box.velocity[1] = -6;
        add(b, box, "thrown", 1, 8, 1);
    }
    if (tick == SAVED - 9 || tick == SAVED + 60)
        jox_bodies_set_velocity(b, bar, (JoxV3){0.3f, tick > SAVED ? -0.5f : 0.2f, 0},
                                (JoxV3){0, 0, 0.6f});
    if (tick == SAVED + 90)
        jox_bodies_remove(b, jox_bodies_find_name(b, "hull"));
}

static uint64_t hash_of(const JoxBodies *b) {
    JoxHash hash = jox_hash_begin();
    jox_bodies_hash(b, &hash);
    return jox_hash_end(&hash);
}

static uint32_t run(JoxBodies *b, uint32_t from, uint32_t until, uint64_t *hashes) {
    uint32_t cut = 0;
    for (uint32_t tick = from; tick < until; tick++) {
        hashes[tick] = hash_of(b);
        JoxDisc disc = {.x = 3, .y = 0.2f, .radius = 0.3f, .mass = 70};
        act(b, tick);
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

static void first_differing(const uint64_t *one, const uint64_t *other) {
    for (uint32_t tick = SAVED; tick < LAST; tick++)
        if (one[tick] != other[tick])
            fail_msg("hashes differ from step %u on, saved at %d", tick, SAVED);
}

static void a_restored_run_goes_on_alike(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    static uint64_t hashes[LAST], again[LAST];
    JoxBodies *b = create();
    JoxBodiesImage image = {0};
    fill(b);
    assert_true(run(b, 0, SAVED, hashes) > 0); /* one wall broke before, */
    jox_bodies_capture(b, &image);
    assert_true(run(b, SAVED, LAST, hashes) > 0); /* one breaks after */
    assert_true(jox_bodies_rebuild(b, &image, NULL));
    run(b, SAVED, LAST, again);
    first_differing(hashes, again);
    jox_bodies_free(b);

    b = create(); /* where there were no bodies at all */
    JoxText why = {0};
    assert_true(jox_bodies_rebuild(b, &image, &why));
    assert_string_equal(jox_bodies_name(b, jox_bodies_find_name(b, "table")), "table");
    run(b, SAVED, LAST, again);
    first_differing(hashes, again);
    jox_bodies_free(b);
    jox_bodies_image_free(&image);
}

/* The same through sections: saved to a buffer, read back, compared. */
static void sections_hold_all_there_is(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    static uint64_t hashes[LAST], again[LAST];
    JoxBodies *b = create(), *other = create();
    fill(b);
    run(b, 0, SAVED, hashes);
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
    run(b, SAVED, LAST, hashes);
    run(other, SAVED, LAST, again);
    first_differing(hashes, again);
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

static void flip(void *context, const char *section, size_t index, void *cell, size_t size,
                 bool hashed) {
    Flip *flip = context;
    uint8_t *bytes = cell;
    assert_true(hashed);
    for (size_t at = 0; at < size; at++, flip->count++) {
        bytes[at] ^= 0x10;
        if (hash_of(flip->bodies) == flip->before)
            fail_msg("byte %zu of %s[%zu] is no part of the hash", at, section, index);
        bytes[at] ^= 0x10;
    }
}

static void each_cell_is_hashed(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    JoxBodies *b = create();
    fill(b);
    Flip context = {b, hash_of(b), 0};
    JoxSections s = jox_sections_visit(flip, &context);
    jox_bodies_sections(b, &s);
    assert_true(context.count > 10000);
    assert_true(hash_of(b) == context.before);
    jox_bodies_free(b);
}

/* In the step of a re-insertion nothing that stands jumps, and what sleeps goes on sleeping. */
static void re_insertion_moves_nothing(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    JoxBodies *b = create();
    uint32_t rows[7];
    for (int i = 0; i < 5; i++)
        rows[i] = add(b, jox_body_def(), "box", 5, 5, 0.5 + i);
    rows[5] = add(b, blocks(3000), "wall", 0, 0, 0.5);
    rows[6] = add(b, jox_body_def(), "asleep", -5, 5, 0.5);
    JoxPose before[7], after;
    for (uint32_t i = 0; i < 5 * JOX_BODIES_REINSERT_STEPS; i++) {
        const JoxImpulse nudges[] = {
            {.object = rows[4], .point = {5, 5, 4.5f}, .impulse = {0, 0, -1}},
            {.object = rows[5], .point = {0, 0, 1}, .impulse = {0, 0, -1}}};
        jox_bodies_impulses(b, nudges, 2); /* keep them awake */
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

/* Whatever is wrong in an image, it is refused, and the bodies stay as they were. */
static void broken_images_are_refused(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    static uint64_t hashes[LAST];
    JoxBodies *b = create();
    fill(b);
    run(b, 0, 100, hashes);
    JoxBodiesImage image = {0};
    jox_bodies_capture(b, &image);
    const uint64_t before = hash_of(b);
    JoxBodyRecord *door = image.bodies;
    while (!door->path_count)
        door++;
    struct {
        void *cell;
        uint32_t wrong;
    } changes[] = {{&image.counters.next_id, 3},
                   {&image.counters.row_count, 2},
                   {&image.counters.row_count, 60000}, /* more than there ever were */
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
                   {(uint32_t *)&door->path_speed + 1, 0xbff00000}, /* -1 or so */
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
        assert_true(hash_of(b) == before);
        memcpy(changes[k].cell, &kept, sizeof kept);
    }
    image.counters.next_id = image.counters.row_count = 1 << 24; /* they would take gigabytes */
    assert_false(jox_bodies_rebuild(b, &image, NULL));
    assert_true(hash_of(b) == before);
    jox_bodies_capture(b, &image);
    image.parts[0].size[0] = -1.0; /* found where the shape is made */
    assert_false(jox_bodies_rebuild(b, &image, NULL));
    assert_true(hash_of(b) == before);
    jox_bodies_free(b);
    jox_bodies_image_free(&image);
}

/* What is looked at between two steps, as behind a restored state, is as it was. */
static void looking_changes_nothing(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    JoxBodies *b = create();
    JoxObjects objects = {0};
    JoxBodyDef small = jox_body_def();
    small.shape.kind = JOX_SHAPE_SPHERE;
    small.shape.size[0] = 0.11;
    const uint32_t ball = add(b, small, "ball", 0, 0, 0.5);
    jox_bodies_objects(b, &objects);
    jox_bodies_step(b, 0.05f, NULL, 0);
    assert_true(jox_bodies_hold(b, ball, 1));
    jox_bodies_let_go(b, ball, (JoxV3){0, 30, 0}); /* fast from here on */
    const uint64_t before = hash_of(b);
    jox_bodies_objects(b, &objects);
    assert_true(hash_of(b) == before);
    jox_bodies_free(b);
}

/* Nothing can break off a single block: it is saved and restored like a box. */
static void a_single_block_is_restored(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    JoxBodies *b = create();
    JoxBodyDef one = blocks(400);
    one.shape.count[0] = one.shape.count[2] = 1;
    add(b, one, "one", 0, 0, 1);
    JoxBodiesImage image = {0};
    JoxText why = {0};
    jox_bodies_capture(b, &image);
    const uint64_t before = hash_of(b);
    if (!jox_bodies_rebuild(b, &image, &why))
        fail_msg("%s", why.data);
    assert_true(hash_of(b) == before);
    jox_bodies_free(b);
    jox_bodies_image_free(&image);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(looking_changes_nothing),
                                       cmocka_unit_test(a_single_block_is_restored),
                                       cmocka_unit_test(a_restored_run_goes_on_alike),
                                       cmocka_unit_test(sections_hold_all_there_is),
                                       cmocka_unit_test(each_cell_is_hashed),
                                       cmocka_unit_test(re_insertion_moves_nothing),
                                       cmocka_unit_test(broken_images_are_refused)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
