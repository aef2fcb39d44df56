/* Reading walls from files: the walls that each geometry becomes, and errors by line and column. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>
#include <sqlite3.h>

#include "base/mem.h"
#include "scene/scene.h"
#include "scene/wall_files/wall_file.h"
#include "unit/test_folder.h"

static bool read_plan(const char *text, JoxWalls *walls, JoxDiagnostics *diagnostics) {
    JoxWallFileOptions options = {.unit = 1.0, .height = 3.0f};
    return jox_wall_file_read("plan.wkt", text, strlen(text), &options, walls, diagnostics);
}

static void polygon_is_walkable_floor(void **state) {
    (void)state;
    JoxWalls walls = {0};
    JoxDiagnostics diagnostics = {0};
    assert_true(read_plan("POLYGON ((0 0, 10 0, 10 8, 0 8, 0 0),\n (4 4, 4 5, 5 5, 5 4, 4 4))",
                          &walls, &diagnostics));
    assert_int_equal(diagnostics.errors, 0);
    assert_int_equal(walls.ring_count, 3); /* both sides of the outer ring, and the hole */
    assert_false(walls.rings[0].solid);
    assert_false(walls.rings[1].solid);
    assert_true(walls.rings[2].solid);
    assert_int_equal(walls.rings[2].count, 4);
    for (uint32_t v = 0; v < 4; v++) {
        JoxV2 corner = walls.vertices[walls.rings[2].first + v].point;
        assert_true(corner.x >= 4 && corner.x <= 5 && corner.y >= 4 && corner.y <= 5);
    }
    jox_walls_free(&walls);
}

static void every_geometry_is_read(void **state) {
    (void)state;
    static const struct {
        const char *text;
        uint32_t rings, vertices;
    } CASES[] = {
        {"LINESTRING (0 0, 3 0)", 1, 2},
        {"linestring(0 0,3 0,3 2)", 1, 4},
        {"LINESTRING (0 0, 3 0, 3 2, 0 0)", 2, 6}, /* ends where it begins: closed */
        {"MULTILINESTRING ((0 0, 1 0), (5 5, 6 5, 6 6))", 2, 6},
        {"MULTIPOLYGON (((0 0, 2 0, 2 2, 0 0)), ((5 5, 7 5, 7 7, 5 5)))", 4, 12},
        {"GEOMETRYCOLLECTION (POLYGON ((0 0, 2 0, 2 2, 0 0)), LINESTRING (0 1, 1 1))", 3, 8},
        {"GEOMETRYCOLLECTION (GEOMETRYCOLLECTION (LINESTRING (0 1, 1 1)), POLYGON EMPTY)", 1, 2},
        {"POLYGON Z ((0 0 1, 2 0 1, 2 2 1, 0 0 1))", 2, 6},
        {"LINESTRING (0 0 5, 3 0 5)\nLINESTRING (0 1, 3 1)\n", 2, 4},
        {"LINESTRING (0 0, 0 0, 3e0 0, 3 0)", 1, 2}, /* repeated points are one point */
        {"\xef\xbb\xbfLINESTRING (-.5 +1., 3 0)", 1, 2},
    };
    for (size_t c = 0; c < sizeof CASES / sizeof *CASES; c++) {
        JoxWalls walls = {0};
        JoxDiagnostics diagnostics = {0};
        if (!read_plan(CASES[c].text, &walls, &diagnostics))
            fail_msg("%s: %s", CASES[c].text, diagnostics.items[0].message);
        if (walls.ring_count != CASES[c].rings || walls.count != CASES[c].vertices)
            fail_msg("%s: %u rings, %u vertices", CASES[c].text, walls.ring_count, walls.count);
        jox_walls_free(&walls);
    }
}

/* An `@`, which is removed, marks the position of the error; a second one ends the text. */
static void errors_have_positions(void **state) {
    (void)state;
    static const struct {
        const char *text, *says;
    } CASES[] = {
        {"@", "begins with the name"},
        {"@POINT (1 2)", "'POINT' is no geometry"},
        {"@CIRCULARSTRING (1 2, 3 4, 5 6)", "is no geometry"},
        {"@{\"type\": 3}", "begins with the name"},
        {"POLYGON @EMPTI", "'(' was expected"},
        {"POLYGON EMPTY@", "no walls"},
        {"POLYGON (@0 0, 1 0)", "'(' was expected"},
        {"POLYGON (@(0 0, 4 0, 4 4))", "does not end where it begins"},
        {"POLYGON (@(0 0, 4 0, 0 0))", "three corners"},
        {"POLYGON (@(0 0, 0 0, 0 0, 0 0))", "three corners"},
        {"POLYGON ((0 0, 2 2, @2 0, 0 2, 0 0))", "crosses or touches"},
        {"POLYGON ((0 0, 4 0, 4 4, 0 0)@", "ends where ')'"},
        {"POLYGON ((0 0, 4 @zero, 4 4, 0 0))", "a number was expected"},
        {"POLYGON ((0 0, 4 0,\n  4 @4x, 0 0))", "no number"},
        {"LINESTRING (0 0, 1 @0x10)", "no number"},
        {"LINESTRING (0 0, 1 @-inf)", "no number"},
        {"LINESTRING (0 0, 1 @1e999)", "no number"},
        {"LINESTRING (0 0, @1@", "a number was expected"},
        {"LINESTRING @(3 3)", "two points"},
        {"LINESTRING (0 0,\n\n @452000.5 5411000)", "over 10 km"},
        {"LINESTRING (0 0, 1 0)\n@garbage (", "'GARBAGE' is no geometry"},
        {"LINESTRING (0 0, 1 0)@)", "begins with the name"},
        {"@<svg/>", "this XML is a <svg>"},
        {"@<geometry unit='cm'/>", "not in 'cm'"},
        {"<geometry>\n</geometry>@", "no walls"},
        {"<geometry>\n</@metry>", "no XML: mismatched tag"},
        {"<geometry><polygon><vertex px='1' py='0'/>@<vertex px='2'/></polygon></geometry>",
         "a vertex needs px and py"},
        {"<geometry><polygon>\n @<vertex px='1' py='0x1'/></polygon></geometry>",
         "'0x1' is no number"},
        {"<geometry><polygon><vertex px='1' py='1'/>\n@</polygon></geometry>", "two points"},
        {"<geometry><polygon>@<vertex px='1' py='20000'/></polygon></geometry>", "over 10 km"},
        {"<geometry><transition id='1'><vertex px='1' py='2'/>@</transition></geometry>",
         "a transition has two points"},
        {"<geometry>@<transition/></geometry>", "needs an id"},
        {"<!DOCTYPE g@><geometry/>", "no document type"},
    };
    for (size_t c = 0; c < sizeof CASES / sizeof *CASES; c++) {
        char text[256];
        const char *at = strchr(CASES[c].text, '@'), *second = strchr(at + 1, '@');
        snprintf(text, sizeof text, "%.*s%s", (int)(at - CASES[c].text), CASES[c].text, at + 1);
        if (second)
            text[second - CASES[c].text - 1] = 0;
        int line = 1, column = 1;
        for (const char *s = CASES[c].text; s < (second ? second - 1 : at); s++) {
            column = *s == '\n' ? 1 : column + 1;
            line += *s == '\n';
        }
        JoxWalls walls = {0};
        JoxDiagnostics diagnostics = {0};
        assert_false(read_plan(text, &walls, &diagnostics));
        assert_int_equal(diagnostics.errors, 1);
        const JoxDiagnostic *d = &diagnostics.items[0];
        if (!strstr(d->message, CASES[c].says) || d->line != line || d->column != column)
            fail_msg("%s: %d:%d: %s", CASES[c].text, d->line, d->column, d->message);
        jox_diag_free(&diagnostics);
        jox_walls_free(&walls);
    }
}

static void deep_and_large_plans_are_refused(void **state) {
    (void)state;
    enum { DEEP = 100000, MANY = 200001 };
    JoxWalls walls = {0};
    JoxDiagnostics diagnostics = {0};
    JoxText text = {0};
    for (int i = 0; i < DEEP; i++)
        jox_text_add(&text, "GEOMETRYCOLLECTION(");
    assert_false(read_plan(text.data, &walls, &diagnostics));
    assert_non_null(strstr(diagnostics.items[0].message, "too deep"));
    jox_diag_free(&diagnostics);
    jox_text_free(&text);
    jox_text_add(&text, "LINESTRING (0 0");
    for (int i = 1; i < MANY; i++)
        jox_text_printf(&text, ", %d %d", i % 1000, i / 1000);
    jox_text_add(&text, ")");
    assert_false(read_plan(text.data, &walls, &diagnostics));
    assert_non_null(strstr(diagnostics.items[0].message, "at most 200000 points"));
    jox_diag_free(&diagnostics);
    jox_text_free(&text);
    jox_walls_free(&walls);
}

/* Replaces each byte of a valid plan by others: it is read, or refused with an error. */
static void mutated_plans_are_read_or_refused(void **state) {
    (void)state;
    static const char GOOD[] =
        "GEOMETRYCOLLECTION (POLYGON ((0 0, 9 0, 9 9, 0 9, 0 0), (1 1, 1 2, 2 "
        "2, 1 1)), MULTILINESTRING ((0 1, 1 1e1), (3 3, 4 4)))";
    static const char BYTES[] = "()0 ,.e-Z\n\0\xff";
    for (size_t at = 0; at + 1 < sizeof GOOD; at++)
        for (size_t b = 0; b < sizeof BYTES; b++) {
            char text[sizeof GOOD];
            JoxWalls walls = {0};
            JoxDiagnostics diagnostics = {0};
            JoxWallFileOptions options = {.unit = 1.0, .height = 3.0f};
            memcpy(text, GOOD, sizeof GOOD);
            text[at] = BYTES[b];
            bool good =
                jox_wall_file_read("plan", text, sizeof GOOD - 1, &options, &walls, &diagnostics);
            assert_int_equal(diagnostics.errors, good ? 0 : 1);
            assert_true(!good || walls.ring_count > 0);
            jox_diag_free(&diagnostics);
            jox_walls_free(&walls);
        }
}

/* ---- JuPedSim's XML ---- */

/* Whether there is a wall with these points and this name, or NULL. */
static bool has_ring(const JoxWalls *walls, bool solid, const char *name, const JoxV2 *points,
                     uint32_t count) {
    for (uint32_t r = 0; r < walls->ring_count; r++) {
        const struct JoxWallRing *ring = &walls->rings[r];
        if (ring->solid != solid || !ring->name != !name || ring->count != count ||
            (name && (strcmp(ring->name, name) != 0 || !ring->open)))
            continue;
        uint32_t found = 0;
        for (uint32_t k = 0; k < count; k++)
            for (uint32_t v = 0; v < count; v++) {
                JoxV2 p = walls->vertices[ring->first + v].point;
                if (jox_length(jox_sub(p, points[k])) < 1e-4f) {
                    found++;
                    break;
                }
            }
        if (found == count)
            return true;
    }
    return false;
}

static void jupedsim_rooms_become_walls_and_doors(void **state) {
    (void)state;
    size_t length;
    char *text = jox_read_file("tests/data/rooms.xml", 1 << 20, &length);
    assert_non_null(text);
    JoxWalls walls = {0};
    JoxDiagnostics diagnostics = {0};
    if (!read_plan(text, &walls, &diagnostics))
        fail_msg("%d:%d: %s", diagnostics.items[0].line, diagnostics.items[0].column,
                 diagnostics.items[0].message);
    assert_int_equal(diagnostics.count, 0);
    /* Pieces that meet are one line; a thin wall has two sides. The wall between two rooms is there
     * once. */
    const JoxV2 hall[] = {{8, 3}, {8, 6}, {0, 6}, {0, 0}, {0, 6}, {8, 6}};
    assert_true(has_ring(&walls, false, NULL, hall, 6));
    const JoxV2 beside[] = {{4, 0}, {8, 0}, {8, 2}, {8, 0}};
    assert_true(has_ring(&walls, false, NULL, beside, 4));
    const JoxV2 corridor[] = {{8, 0}, {12, 0}};
    assert_true(has_ring(&walls, false, NULL, corridor, 2));
    const JoxV2 table[] = {{2, 2}, {2, 3}, {4, 3}, {4, 2}};
    assert_true(has_ring(&walls, true, NULL, table, 4));
    const JoxV2 door[] = {{8, 2}, {8, 3}}, exit[] = {{12, 0}, {12, 3}};
    assert_true(has_ring(&walls, false, "door-3", door, 2));
    assert_true(has_ring(&walls, false, "door-4", exit, 2));
    assert_int_equal(walls.ring_count, 8); /* also the niche, and the corridor's other side */
    for (uint32_t r = 0; r < walls.ring_count; r++)
        assert_float_equal(walls.rings[r].height, walls.rings[r].solid ? 0.8 : 3.0, 1e-6);
    jox_walls_free(&walls);
    jox_free(text);
}

static void unusual_xml_is_read(void **state) {
    (void)state;
#define POLYGON(points) "<geometry><subroom>" points "</subroom></geometry>"
#define V(x, y) "<vertex px='" #x "' py='" #y "'/>"
    static const struct {
        const char *text;
        uint32_t rings, vertices, warnings;
    } CASES[] = {
        {POLYGON("<polygon>" V(0, 0) V(3, 0) "</polygon>"), 1, 2, 0},
        {"\xef\xbb\xbf <geometry><polygon>" V(1e1, +.5) V(3, 0) "</polygon></geometry>", 1, 2, 0},
        {POLYGON("<polygon>" V(0, 0) V(3, 0) V(3, 3) V(0, 0) "</polygon>"), 2, 6, 0}, /* closed */
        {POLYGON("<polygon>" V(0, 0) V(3, 0) "</polygon><polygon>" V(3, 0) V(0, 0) "</polygon>"), 1,
         2, 0}, /* the same side twice */
        {POLYGON("<polygon>" V(0, 0) V(3, 0) "</polygon><polygon>" V(5, 0) V(7, 0) "</polygon>"), 2,
         4, 0},
        /* A side of a ring that is there already is left out. */
        {POLYGON("<polygon>" V(3, 0) V(3, 3) "</polygon><polygon>" V(0, 0) V(3, 0) V(3, 3)
                     V(0, 0) "</polygon>"),
         3, 6, 0},
        {POLYGON("<obstacle><polygon>" V(0, 0) V(3, 0) V(3, 3) V(0, 0) "</polygon></obstacle>"), 1,
         3, 0},
        {POLYGON("<obstacle><polygon>" V(0, 0) V(3, 0) V(3, 3) "</polygon></obstacle>"), 1, 4, 0},
        {"<geometry><subroom class='stair' A_x='0.5'><polygon>" V(0, 0)
             V(3, 0) "</polygon></subroom><subroom class='escalator_up'/></geometry>",
         1, 2, 1},
        {"<geometry><transitions><transition id='1'>" V(0, 0)
             V(3, 0) "<file>more.xml</file></transition></transitions></geometry>",
         1, 2, 1},
    };
    for (size_t c = 0; c < sizeof CASES / sizeof *CASES; c++) {
        JoxWalls walls = {0};
        JoxDiagnostics diagnostics = {0};
        if (!read_plan(CASES[c].text, &walls, &diagnostics))
            fail_msg("%s: %s", CASES[c].text, diagnostics.items[0].message);
        if (walls.ring_count != CASES[c].rings || walls.count != CASES[c].vertices ||
            diagnostics.warnings != CASES[c].warnings)
            fail_msg("%s: %u rings, %u vertices, %zu warnings", CASES[c].text, walls.ring_count,
                     walls.count, diagnostics.warnings);
        jox_diag_free(&diagnostics);
        jox_walls_free(&walls);
    }
}

static void mutated_xml_is_read_or_refused(void **state) {
    (void)state;
    static const char BYTES[] = "<>/\"'& 09-\n\0\xff";
    size_t length;
    char *text = jox_read_file("tests/data/rooms.xml", 1 << 20, &length);
    for (size_t at = 0; at < length; at++)
        for (size_t b = 0; b < sizeof BYTES; b++) {
            JoxWalls walls = {0};
            JoxDiagnostics diagnostics = {0};
            JoxWallFileOptions options = {.unit = 1.0, .height = 3.0f};
            char was = text[at];
            text[at] = BYTES[b];
            bool good = jox_wall_file_read("plan", text, length, &options, &walls, &diagnostics);
            text[at] = was;
            assert_int_equal(diagnostics.errors, good ? 0 : 1);
            assert_true(!good || walls.ring_count > 0);
            jox_diag_free(&diagnostics);
            jox_walls_free(&walls);
        }
    jox_free(text);
}

/* ---- in scenes ---- */

static JoxSceneSpec *load_walls(const char *walls, JoxDiagnostics *diagnostics) {
    char text[512];
    snprintf(text, sizeof text,
             "jostle: 1\nwalls: [%s]\ngroups: {g: {behaviour: stander, at: [[5, 2]]}}\n", walls);
    JoxSceneSpec *scene =
        jox_scene_read_text(test_path("scene.yaml"), text, strlen(text), NULL, diagnostics);
    if (!scene)
        print_message("%s\n", diagnostics->items[0].message);
    return scene;
}

static void scene_reads_walls_from_file(void **state) {
    (void)state;
    JoxDiagnostics diagnostics = {0};
    write_test_file("plan.wkt",
                    "POLYGON ((45200000 541100000, 45201000 541100000, 45201000 541100800, "
                    "45200000 541100000))");
    JoxSceneSpec *scene = load_walls("{file: plan.wkt, unit: 1 cm, origin: [45200000, 541100000], "
                                     "name: hall, height: 2}",
                                     &diagnostics);
    assert_non_null(scene);
    assert_int_equal(scene->walls.ring_count, 2);
    assert_string_equal(scene->walls.rings[1].name, "hall");
    assert_float_equal(scene->walls.rings[0].height, 2, 1e-6);
    float most = 0;
    for (uint32_t v = 0; v < scene->walls.count; v++)
        most = jox_maxf(most, scene->walls.vertices[v].point.y);
    assert_float_equal(most, 8, 1e-4);
    assert_int_equal(scene->file_count, 2); /* the plan is listed with its hash */
    assert_int_equal(strlen(scene->files[1].sha256), 64);
    jox_scene_free(scene);
}

static void scene_reads_walls_from_recording(void **state) {
    (void)state;
    const char *path = test_path("run.sqlite");
    sqlite3 *db;
    JoxDiagnostics diagnostics = {0};
    assert_int_equal(sqlite3_open(path, &db), SQLITE_OK);
    assert_int_equal(
        sqlite3_exec(db,
                     "CREATE TABLE geometry(hash INTEGER, wkt TEXT);"
                     "INSERT INTO geometry VALUES(1, 'POLYGON ((0 0, 9 0, 9 9, 0 0))')",
                     NULL, NULL, NULL),
        SQLITE_OK);
    sqlite3_close(db);
    JoxSceneSpec *scene = load_walls("{file: run.sqlite}", &diagnostics);
    assert_non_null(scene);
    assert_int_equal(scene->walls.ring_count, 2);
    jox_scene_free(scene);

    unlink(path);
    assert_int_equal(sqlite3_open(path, &db), SQLITE_OK);
    assert_int_equal(sqlite3_exec(db, "CREATE TABLE other(a)", NULL, NULL, NULL), SQLITE_OK);
    sqlite3_close(db);
    assert_null(load_walls("{file: run.sqlite}", &diagnostics));
    assert_non_null(strstr(diagnostics.items[0].message, "no table 'geometry'"));
    jox_diag_free(&diagnostics);
}

static void errors_in_wall_files_are_shown(void **state) {
    (void)state;
    JoxDiagnostics diagnostics = {0};
    write_test_file("bad.wkt", "LINESTRING (0 0,\n  1 nought)\n");
    assert_null(load_walls("{file: bad.wkt}", &diagnostics));
    const JoxDiagnostic *d = &diagnostics.items[0];
    assert_non_null(strstr(d->file, "bad.wkt"));
    assert_int_equal(d->line, 2);
    assert_int_equal(d->column, 5);
    assert_string_equal(d->source, "  1 nought)");
    jox_diag_free(&diagnostics);

    assert_null(load_walls("{file: nowhere.wkt}", &diagnostics));
    assert_string_equal(diagnostics.items[0].code, "unreadable-file");
    assert_int_equal(diagnostics.items[0].line, 2);
    jox_diag_free(&diagnostics);

    assert_null(load_walls("{file: bad.wkt, line: [[0, 0], [1, 1]]}", &diagnostics));
    assert_string_equal(diagnostics.items[0].code, "bad-wall");
    jox_diag_free(&diagnostics);
}

static void door_of_geometry_closes(void **state) {
    (void)state;
    JoxDiagnostics diagnostics = {0};
    write_test_file("rooms.xml",
                    "<geometry><polygon>" V(0, 0) V(3, 0) "</polygon><transition id='7'>" V(3, 0)
                        V(4, 0) "</transition></geometry>");
    JoxSceneSpec *scene =
        load_walls("{file: rooms.xml}]\nevents: [{at: 5, close: door-7}", &diagnostics);
    assert_non_null(scene);
    assert_int_equal(scene->event_count, 1);
    assert_string_equal(scene->walls.rings[1].name, "door-7");
    assert_true(scene->walls.rings[1].open);
    jox_scene_free(scene);

    assert_null(load_walls("{file: rooms.xml}]\nevents: [{at: 5, close: door-8}", &diagnostics));
    assert_non_null(strstr(diagnostics.items[0].hint, "door-7"));
    jox_diag_free(&diagnostics);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(polygon_is_walkable_floor),
        cmocka_unit_test(every_geometry_is_read),
        cmocka_unit_test(errors_have_positions),
        cmocka_unit_test(deep_and_large_plans_are_refused),
        cmocka_unit_test(mutated_plans_are_read_or_refused),
        cmocka_unit_test(jupedsim_rooms_become_walls_and_doors),
        cmocka_unit_test(unusual_xml_is_read),
        cmocka_unit_test(mutated_xml_is_read_or_refused),
        cmocka_unit_test(door_of_geometry_closes),
        cmocka_unit_test(scene_reads_walls_from_file),
        cmocka_unit_test(scene_reads_walls_from_recording),
        cmocka_unit_test(errors_in_wall_files_are_shown),
    };
    return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
