/* Tests of the plan of a sweep, the names of its variants, and the encoding of curves and
   fields. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "base/clock.h"
#include "base/format/piece_file.h"
#include "base/mem.h"
#include "sweep/sweep.h"

static void every_combination_is_a_variant(void **state) {
    (void)state;
    static const char *const SETS[] = {"groups.a.count=1, 2 ,3",
                                       "groups.a.set.speed=normal(1, 2),4", "walls.0.name='x,y'"};
    JoxSweepPlan plan;
    JoError error;
    assert_true(jox_sweep_make_plan(&plan, SETS, 3, 7, 5, &error));
    assert_int_equal(plan.variant_count, 6);
    assert_string_equal(plan.variants[0].key,
                        "groups.a.count=1\ngroups.a.set.speed=normal(1, 2)\nwalls.0.name='x,y'");
    assert_string_equal(plan.variants[3].sets[0], "groups.a.count=2");
    assert_string_equal(plan.variants[3].sets[1], "groups.a.set.speed=4");
    assert_int_equal(plan.first_seed, 7);
    jox_sweep_free_plan(&plan);
    assert_true(jox_sweep_make_plan(&plan, NULL, 0, 1, 1, &error));
    assert_int_equal(plan.variant_count, 1);
    assert_string_equal(plan.variants[0].key, "");
    jox_sweep_free_plan(&plan);
}

static void malformed_lists_are_refused(void **state) {
    (void)state;
    static const struct {
        const char *set, *why;
    } BAD[] = {{"groups", "PATH=VALUE"}, {"=3", "PATH=VALUE"},     {"a=", "empty"},
               {"a=1,,2", "empty"},      {"a=1,", "empty"},        {"a= ,1", "empty"},
               {"a=1,2,1", "twice"},     {"a=[1,2", "not closed"}, {"a=1]", "not closed"},
               {"a='1,2", "not closed"}, {"b=3", "is set twice"}};
    for (size_t b = 0; b < sizeof BAD / sizeof *BAD; b++) {
        const char *const sets[] = {"b=1", BAD[b].set};
        JoxSweepPlan plan;
        JoError error = {0};
        if (jox_sweep_make_plan(&plan, sets, 2, 1, 1, &error) || !strstr(error.text, BAD[b].why))
            fail_msg("'%s': %s", BAD[b].set, error.text);
        assert_int_equal(error.code, JO_USAGE);
        jox_sweep_free_plan(&plan);
    }
}

static void check_variant_names(const char *const *keys, const char *const *wanted,
                                uint32_t count) {
    char *names[8];
    jox_sweep_name_variants(keys, count, names);
    for (uint32_t k = 0; k < count; k++) {
        assert_string_equal(names[k], wanted[k]);
        jox_free(names[k]);
    }
}

static void variants_are_named_by_what_differs(void **state) {
    (void)state;
    check_variant_names((const char *const[]){"x.a=1\nx.b=2", "x.a=1\nx.b=3"},
                        (const char *const[]){"b=2", "b=3"}, 2);
    /* The short names would be equal */
    check_variant_names((const char *const[]){"x.n=1\ny.n=2", "x.n=2\ny.n=3"},
                        (const char *const[]){"x.n=1, y.n=2", "x.n=2, y.n=3"}, 2);
    /* Equal short names, but only one varies */
    check_variant_names((const char *const[]){"x.n=1\ny.n=2", "x.n=2\ny.n=2"},
                        (const char *const[]){"n=1", "n=2"}, 2);
    check_variant_names((const char *const[]){"walls.3.open=true", "walls.3.open=false"},
                        (const char *const[]){"walls.3.open=true", "walls.3.open=false"}, 2);
    check_variant_names((const char *const[]){"3.open=1", "3.open=2"},
                        (const char *const[]){"3.open=1", "3.open=2"}, 2);
    check_variant_names((const char *const[]){"a=1", "a=1\nb=2"}, (const char *const[]){"", "b=2"},
                        2);
    check_variant_names((const char *const[]){"a=1"}, (const char *const[]){""}, 1);
}

/* Comparing each name with every other would take minutes. */
static void naming_many_variants_takes_linear_time(void **state) {
    enum { MANY = 50000, BYTES = 48 };
    (void)state;
    char *bytes = jox_alloc(MANY, BYTES);
    const char **keys = jox_alloc(MANY, sizeof *keys);
    char **names = jox_alloc(MANY, sizeof *names);
    for (uint32_t k = 0; k < MANY; k++) {
        keys[k] = bytes + (size_t)k * BYTES;
        snprintf(bytes + (size_t)k * BYTES, BYTES, "a.b=5\na.c=6\na.n=%u\nc.b=7", k);
    }
    const double begun = jox_clock_cpu();
    jox_sweep_name_variants(keys, MANY, names);
    assert_true(jox_clock_cpu() - begun < 5.0);
    assert_string_equal(names[MANY - 1], "n=49999");
    for (uint32_t k = 0; k < MANY; k++)
        jox_free(names[k]);
    jox_free(names);
    jox_free(keys);
    jox_free(bytes);
}

static void curves_and_fields_survive_encoding(void **state) {
    (void)state;
    char curve_name[] = "people inside", field_name[] = "density", unit[] = "1/m2", none[] = "";
    double points[] = {0, 5, 1, NAN, 2, 3};
    float values[] = {1, 2, 3, 4, 5, NAN};
    JoxText pieces = {0};
    JoxPiece piece;
    char why[200];
    size_t at = 0;
    jox_pieces_begin(&pieces);
    jox_sweep_put_curve(&pieces, &(JoxSweepCurve){curve_name, none, points, 3, 3});
    jox_sweep_put_field(&pieces, &(JoxSweepField){field_name, unit, -1, 2, 0.5, 3, 2, values});
    jox_pieces_end(&pieces);
    JoxSweepCurve curve;
    JoxSweepField field;
    assert_true(jox_pieces_next(&pieces, &at, &piece, why));
    assert_true(jox_sweep_get_curve(piece.data, piece.length, &curve));
    assert_string_equal(curve.name, "people inside");
    assert_true(curve.count == 3 && curve.points[4] == 2 && isnan(curve.points[3]));
    jox_sweep_free_curve(&curve);
    for (size_t cut = 0; cut < piece.length; cut++)
        assert_false(jox_sweep_get_curve(piece.data, cut, &curve));
    assert_true(jox_pieces_next(&pieces, &at, &piece, why));
    assert_true(jox_sweep_get_field(piece.data, piece.length, &field));
    assert_true(field.columns == 3 && field.rows == 2 && field.values[4] == 5 && field.cell == 0.5);
    assert_string_equal(field.unit, "1/m2");
    jox_sweep_free_field(&field);
    for (size_t cut = 0; cut < piece.length; cut++)
        assert_false(jox_sweep_get_field(piece.data, cut, &field));
    jox_text_free(&pieces);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_combination_is_a_variant),
                                       cmocka_unit_test(malformed_lists_are_refused),
                                       cmocka_unit_test(variants_are_named_by_what_differs),
                                       cmocka_unit_test(naming_many_variants_takes_linear_time),
                                       cmocka_unit_test(curves_and_fields_survive_encoding)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
