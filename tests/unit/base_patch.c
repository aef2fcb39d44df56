/* The list of changes that patches make: parents of paths, order, conflicts between mods, targets.
   Merging itself is tested with trees of YAML and of Lua, in tests/scenes/mods.sh. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "base/format/patch.h"

static JoxPatchChange make_patch_change(const char *path, int32_t mod, int line) {
    return (JoxPatchChange){
        .path = (char *)path, .from = "there", .mod = mod, .position = {"a.lua", line, 1, 2}};
}

static void changes_lead_to_paths_below_them(void **state) {
    (void)state;
    static const struct {
        const char *set, *path, *rest; /* rest: NULL if `set` is no parent of `path` */
    } CASES[] = {
        {"", "a.b", "a.b"},         {"a", "a.b", "b"},  {"a.b", "a.b", ""},
        {"a.b", "a", NULL},         {"a", "ab", NULL},  {"a.@Exit", "a.@Exit.chance", "chance"},
        {"a.@Exit", "a.@Ex", NULL}, {"b", "a.b", NULL},
    };
    for (size_t i = 0; i < sizeof CASES / sizeof *CASES; i++) {
        const JoxPatchChange c = make_patch_change(CASES[i].set, -1, 1);
        const char *rest = NULL;
        bool leads = jox_patch_leads(&c, CASES[i].path, &rest);
        assert_int_equal(leads, CASES[i].rest != NULL);
        if (leads)
            assert_string_equal(rest, CASES[i].rest);
    }
    char path[JOX_PATCH_PATH];
    jox_patch_join(path, "a", "b");
    assert_string_equal(path, "a.b");
    jox_patch_join(path, "", "b");
    assert_string_equal(path, "b");
    jox_patch_join(path, "a", "");
    assert_string_equal(path, "a");
}

static void the_last_change_wins_and_conflicts_are_named(void **state) {
    (void)state;
    JoxMod mods[3] = {{.name = "first"}, {.name = "second"}, {.name = "third", .after = 3}};
    JoxPatchChanges changes = {0};
    JoxDiagnostics diagnostics = {0};
    jox_patch_keep(&changes, make_patch_change("a", -1, 1), mods, &diagnostics);
    jox_patch_keep(&changes, make_patch_change("a.b", 0, 2), mods, &diagnostics);
    jox_patch_keep(&changes, make_patch_change("a.c", 1, 3), mods, &diagnostics);
    assert_int_equal(diagnostics.count, 0); /* different paths */
    jox_patch_keep(&changes, make_patch_change("a.b.d", 2, 4), mods, &diagnostics);
    assert_int_equal(diagnostics.count, 0); /* the later mod depends on the earlier one */
    jox_patch_keep(&changes, make_patch_change("a.b.e", 1, 5), NULL, &diagnostics);
    assert_int_equal(diagnostics.count, 0); /* without a list of mods */
    jox_patch_keep(&changes, make_patch_change("a.b.f", 1, 6), mods, &diagnostics);
    assert_int_equal(diagnostics.count, 1);
    assert_string_equal(diagnostics.items[0].code, "mod-conflict");
    assert_int_equal(diagnostics.items[0].line, 6);
    assert_int_equal(jox_patch_leading(&changes, "a.b.f.g")->position.line, 6);
    assert_int_equal(jox_patch_leading(&changes, "a.b")->position.line, 2);
    assert_int_equal(jox_patch_leading(&changes, "a.x")->position.line, 1);
    assert_null(jox_patch_leading(&changes, "b"));
    jox_patch_changes_free(&changes);
    assert_int_equal(changes.count, 0);
    jox_diag_free(&diagnostics);
}

static void too_many_changes_give_one_error(void **state) {
    (void)state;
    JoxPatchChanges changes = {0};
    JoxDiagnostics diagnostics = {0};
    for (int i = 0; i < 5000; i++)
        jox_patch_keep(&changes, make_patch_change("a", -1, i), NULL, &diagnostics);
    assert_int_equal(diagnostics.errors, 1);
    assert_in_range(changes.count, 4096, 4097);
    jox_patch_changes_free(&changes);
    jox_diag_free(&diagnostics);
}

static void target_names_a_file_or_a_file_of_a_mod(void **state) {
    (void)state;
    JoxMod mods[1] = {{.name = "odd", .folder = "mods/odd"}};
    assert_true(jox_patch_is_target("yard", "scenes/yard.yaml", mods, 1));
    assert_true(jox_patch_is_target("yard", "yard.yaml", mods, 1));
    assert_false(jox_patch_is_target("yar", "scenes/yard.yaml", mods, 1));
    assert_false(jox_patch_is_target("yards", "scenes/yard.yaml", mods, 1));
    assert_false(jox_patch_is_target("odd:yard", "scenes/yard.yaml", mods, 1));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(changes_lead_to_paths_below_them),
        cmocka_unit_test(the_last_change_wins_and_conflicts_are_named),
        cmocka_unit_test(too_many_changes_give_one_error),
        cmocka_unit_test(target_names_a_file_or_a_file_of_a_mod),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
