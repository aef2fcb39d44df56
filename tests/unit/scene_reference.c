/* The table of keys and what is printed from it: examples show every key and can be read, pages and
   schemas agree with the table, and the files of scripts/ are up to date.
   `scene_reference --write` writes them. */
#include "base/mem.h"
#include "scene/format/keys.h"
#include "unit/scene_texts.h"

static bool is_owner(const char *name, size_t length) {
    return jox_owner_find(&jox_scene_format, name, length) != NULL;
}

/* Marks in `seen` the keys of the table that a tree uses. The first `length` bytes of `content`
   (see JoxKey) say what the node holds. */
static void mark_keys(const JoxReader *reader, const JoxYaml *node, const char *content,
                      size_t length, bool *seen) {
    if (length && (content[length - 1] == '*' || content[length - 1] == ']')) {
        size_t inner = length - 1;
        while (content[length - 1] == ']' && content[inner] != '[')
            inner--;
        assert_int_equal(node->kind, content[length - 1] == '*' ? JOX_YAML_MAP : JOX_YAML_LIST);
        for (uint32_t i = 0; i < node->count; i++)
            mark_keys(reader, node->items[i], content, inner, seen);
    } else if (is_owner(content, length)) {
        char owner[32];
        snprintf(owner, sizeof owner, "%.*s", (int)length, content);
        assert_true(jox_owner_check_keys(reader, node, owner));
        for (uint32_t i = 0; i < node->count; i++) {
            const JoxKey *key = jox_key_find(&jox_scene_format, owner, node->keys[i]);
            assert_non_null(key);
            seen[key - jox_scene_format.keys] = true;
            if (key->content)
                mark_keys(reader, node->items[i], key->content, strlen(key->content), seen);
        }
    }
}

static bool belongs_to_mods(const char *owner) {
    return !strcmp(owner, "mod") || !strcmp(owner, "setting");
}

static void examples_show_every_key(void **state) {
    (void)state;
    int missing = 0;
    for (size_t o = 0; o < jox_scene_format.owner_count; o++) {
        const char *owner = jox_scene_format.owners[o].name;
        bool *seen = calloc(jox_scene_format.key_count, sizeof *seen);
        for (size_t e = 0; e < jox_scene_example_count; e++) {
            if (strcmp(jox_scene_examples[e].owner, owner) != 0)
                continue;
            JoxArena *arena = jox_arena_create();
            JoxYamlFiles *files = jox_arena_take(arena, 1, sizeof *files);
            JoxDiagnostics d = {0};
            const char *yaml = jox_scene_examples[e].yaml;
            char *own = jox_arena_text(arena, yaml); /* without the files that it includes */
            char *include = strstr(own, "include:");
            if (include)
                memcpy(include, "without:", 8);
            JoxYaml *root = jox_yaml_read(arena, "example.yaml", own, strlen(own), files, &d);
            assert_non_null(root);
            for (uint32_t k = 0; include && k < root->count; k++)
                if (!strcmp(root->keys[k], "without"))
                    root->keys[k] = "include";
            const char *root_owner = belongs_to_mods(owner) ? "mod" : "scene";
            mark_keys(&(JoxReader){.arena = arena, .diagnostics = &d, .format = &jox_scene_format},
                      root, root_owner, strlen(root_owner), seen);
            if (d.count)
                print_diagnostics(&d, yaml);
            assert_int_equal(d.count, 0);
            jox_arena_free(arena);
        }
        for (size_t k = 0; k < jox_scene_format.key_count; k++) {
            const JoxKey *key = &jox_scene_format.keys[k];
            bool of_mod = !strcmp(key->name, "mods") || !strcmp(key->name, "patch") ||
                          !strcmp(key->name, "replace");
            if (strcmp(key->owner, owner) != 0 || seen[k] || (!strcmp(owner, "scene") && of_mod))
                continue;
            print_message("no example of %s shows '%s'\n", owner, key->name);
            missing++;
        }
        free(seen);
    }
    assert_int_equal(missing, 0);
}

static void examples_read_without_diagnostics(void **state) {
    (void)state;
    for (size_t e = 0; e < jox_scene_example_count; e++) {
        const JoxExample *example = &jox_scene_examples[e];
        if (belongs_to_mods(example->owner))
            continue;
        JoxDiagnostics d = {0};
        JoxSceneSpec *scene = jox_scene_read_text("scenes/example.yaml", example->yaml,
                                                  strlen(example->yaml), NULL, &d);
        if (!scene || d.count)
            print_diagnostics(&d, example->yaml);
        assert_non_null(scene);
        assert_int_equal(d.count, 0);
        jox_scene_free(scene);
        jox_diag_free(&d);
    }
}

static void rows_are_complete(void **state) {
    (void)state;
    for (size_t k = 0; k < jox_scene_format.key_count; k++) {
        const JoxKey *key = &jox_scene_format.keys[k];
        bool holds = key->type == JOX_TYPE_TABLE || key->type == JOX_TYPE_LIST ||
                     key->type == JOX_TYPE_VALUES || key->type == JOX_TYPE_POINTS;
        const bool single = key->content && (!strcmp(key->content, "draw") ||
                                             !strcmp(key->content, "plain")); /* of any kind */
        if (!is_owner(key->owner, strlen(key->owner)) || (holds && !key->content) ||
            (!holds && key->content && !single) || !key->meaning || !*key->meaning ||
            !key->default_text || !key->unit)
            fail_msg("the row %s.%s", key->owner, key->name);
        for (size_t other = 0; other < k; other++)
            if (!strcmp(jox_scene_format.keys[other].owner, key->owner))
                assert_string_not_equal(jox_scene_format.keys[other].name, key->name);
        bool known = !*key->unit;
        for (size_t u = 0; u < jox_scene_unit_count; u++)
            known |= !strcmp(jox_scene_units[u].kind, key->unit);
        assert_true(known);
    }
    char name[64]; /* choices of an enumeration are in its order */
    const char *fills = jox_key_find(&jox_scene_format, "group", "fill")->choices;
    assert_true(jox_choice_name(fills, JOX_FILL_HEX, name, sizeof name) && !strcmp(name, "hex"));
    assert_true(jox_choice_name(fills, JOX_FILL_GRID, name, sizeof name) && !strcmp(name, "grid"));
    assert_true(jox_choice_name(fills, JOX_FILL_RANDOM, name, sizeof name) &&
                !strcmp(name, "random"));
    assert_true(jox_choice_name(fills, JOX_FILL_CIRCLE, name, sizeof name) &&
                !strcmp(name, "circle"));
    assert_false(jox_choice_name(fills, JOX_FILL_AT, name, sizeof name));
    for (size_t a = 0; a < jox_scene_alternative_count; a++)
        for (int i = 0; jox_choice_name(jox_scene_alternatives[a].keys, i, name, sizeof name); i++)
            assert_non_null(jox_key_find(&jox_scene_format, jox_scene_alternatives[a].owner, name));
}

/* Each row says how its value is stored, in a way that fits its type: so no key is documented that
   is not read. */
static void every_key_is_stored(void **state) {
    (void)state;
    for (size_t k = 0; k < jox_scene_format.key_count; k++) {
        const JoxKey *key = &jox_scene_format.keys[k];
        const JoxOwner *owner = jox_owner_find(&jox_scene_format, key->owner, strlen(key->owner));
        bool good = key->store != JOX_STORE_UNSET &&
                    (key->store == JOX_STORE_READ) == !!key->read &&
                    (!key->selected_kind || owner->kind_offset != 0);
        if (key->store == JOX_STORE_ITEMS)
            good &= key->content &&
                    jox_owner_find(&jox_scene_format, key->content, strcspn(key->content, "*["));
        if (key->store == JOX_STORE_STRUCT)
            good &= key->type == JOX_TYPE_TABLE && key->content;
        if (key->store == JOX_STORE_BOOL)
            good &= key->type == JOX_TYPE_BOOL || key->choices;
        if (key->store == JOX_STORE_TEXT)
            good &= key->type == JOX_TYPE_TEXT && !key->choices;
        if (key->store == JOX_STORE_DOUBLES3)
            good &= key->type == JOX_TYPE_POINT3;
        if (key->choices && *key->default_text && *key->default_text != '!' &&
            key->type == JOX_TYPE_TEXT)
            good &= jox_choice_find(key->choices, key->default_text) >= 0;
        /* JOX_STORE_OF takes members of other types, as pointers and enumerations, for structs. */
        if (key->type == JOX_TYPE_NUMBER || key->type == JOX_TYPE_WHOLE)
            good &= key->store != JOX_STORE_STRUCT && key->store != JOX_STORE_TEXT;
        if (!good)
            fail_msg("the row %s.%s", key->owner, key->name);
    }
}

/* Each kind of place is a key of a place, by its name. */
static void kinds_of_places_are_keys(void **state) {
    (void)state;
    for (int p = 0; p < (int)jox_place_kind_count; p++) {
        const JoxKey *key = jox_key_find(&jox_scene_format, "place", jox_place_kinds[p].name);
        assert_non_null(key);
        assert_int_equal(key->selected_kind, 1 + p);
    }
}

/* Reads a schema as a tree: JSON is YAML. */
static JoxYaml *read_schema(JoxArena *arena, const char *root) {
    JoxText text = {0};
    JoxDiagnostics d = {0};
    JoxYamlFiles *files = jox_arena_take(arena, 1, sizeof *files);
    jox_scene_print_json_schema(root, &text);
    JoxYaml *tree = jox_yaml_read(arena, "schema.json", text.data, text.length, files, &d);
    if (!tree)
        print_diagnostics(&d, "schema");
    assert_non_null(tree);
    jox_text_free(&text);
    jox_diag_free(&d);
    return tree;
}

static void check_references(const JoxYaml *node, const JoxYaml *definitions) {
    const JoxYaml *to = jox_yaml_get(node, "$ref");
    if (to && to->kind == JOX_YAML_SCALAR) {
        assert_true(!strncmp(to->text, "#/definitions/", 14));
        if (!jox_yaml_get(definitions, to->text + 14))
            fail_msg("the schema lacks %s", to->text);
    }
    for (uint32_t i = 0; i < node->count; i++)
        check_references(node->items[i], definitions);
}

static void schemas_have_every_key(void **state) {
    (void)state;
    static const char *const ROOTS[] = {"scene", "mod"};
    for (int r = 0; r < 2; r++) {
        JoxArena *arena = jox_arena_create();
        const JoxYaml *root = read_schema(arena, ROOTS[r]);
        const JoxYaml *definitions = jox_yaml_get(root, "definitions");
        check_references(root, definitions);
        for (size_t k = 0; k < jox_scene_format.key_count; k++) {
            const JoxKey *key = &jox_scene_format.keys[k];
            if (belongs_to_mods(key->owner) != (r == 1))
                continue;
            const JoxYaml *owner =
                !strcmp(key->owner, ROOTS[r]) ? root : jox_yaml_get(definitions, key->owner);
            const JoxYaml *property = jox_yaml_get(jox_yaml_get(owner, "properties"), key->name);
            if (!property || !jox_yaml_get(property, "description"))
                fail_msg("the schema of %s lacks %s.%s", ROOTS[r], key->owner, key->name);
        }
        jox_arena_free(arena);
    }
}

/* Checks that a schema contains a text. */
static void expect_text(const char *schema, const char *line) {
    if (!strstr(schema, line))
        fail_msg("the schema lacks: %s", line);
}

static void schemas_agree_with_table(void **state) {
    (void)state;
    JoxText text = {0};
    jox_scene_print_json_schema("scene", &text);
    expect_text(
        text.data,
        "\"mode\": {\"description\": \"literal: the equations as they were "
        "printed (core/paper.md); parameters that they do not have are "
        "noted, as they then have no effect; default physical\", \"default\": \"physical\", "
        "\"enum\": [\"physical\", \"literal\"]}");
    expect_text(text.data, "{\"$ref\": \"#/definitions/drawn\"}, {\"enum\": [\"calm\", "
                           "\"normal\", \"keen\"]}]}"); /* haste, and units of others */
    expect_text(text.data, "{\"$ref\": \"#/definitions/drawn\"}, {\"$ref\": "
                           "\"#/definitions/unit_m_per_s\"}]}");
    expect_text(text.data,
                "\"step\": {\"description\": \"time step, in s; 0.001 to 0.2, default 0.05\", "
                "\"default\": 0.05, \"anyOf\": [{\"type\": \"number\", \"minimum\": 0.001, "
                "\"maximum\": 0.2}, {\"$ref\": \"#/definitions/unit_s\"}]}");
    expect_text(text.data, "\"unit_m_per_s\": {\"type\": \"string\", \"pattern\": "
                           "\"^[-+]?([0-9]+\\\\.?[0-9]*|\\\\.[0-9]+)([eE][-+]?[0-9]+)? "
                           "*(m/s|km/h)?$\"}");
    expect_text(text.data, "\"required\": [\"shape\", \"at\"]");
    expect_text(text.data, "{\"oneOf\": [{\"required\": [\"solid\"]}, {\"required\": [\"line\"]}, "
                           "{\"required\": [\"file\"]}]}");
    expect_text(text.data, "\"mass\": {\"description\": \"mass, in kg; 1 to 10000, default 70\"");
    jox_text_free(&text);
}

/* ---- files printed from the table ---- */

static const char *const MADE[] = {"scripts/scene.schema.json", "scripts/mod.schema.json",
                                   "scripts/scene.md"};

static void print_file(int n, JoxText *out) {
    if (n == 2)
        jox_scene_print_markdown(out);
    else
        jox_scene_print_json_schema(n == 0 ? "scene" : "mod", out);
}

static int write_files(void) {
    for (int n = 0; n < 3; n++) {
        JoxText text = {0};
        print_file(n, &text);
        FILE *file = fopen(MADE[n], "wb");
        bool written = file && fwrite(text.data, 1, text.length, file) == text.length;
        if (!file || fclose(file) != 0 || !written) {
            perror(MADE[n]);
            return 1;
        }
        jox_text_free(&text);
    }
    return 0;
}

static void files_are_up_to_date(void **state) {
    (void)state;
    for (int n = 0; n < 3; n++) {
        JoxText text = {0};
        size_t length = 0;
        print_file(n, &text);
        char *file = jox_read_file(MADE[n], 1 << 20, &length);
        if (!file || strcmp(file, text.data) != 0)
            fail_msg("%s is not what the table makes: run unit/scene_reference --write", MADE[n]);
        jox_free(file);
        jox_text_free(&text);
    }
}

int main(int argc, char **argv) {
    if (argc > 1 && !strcmp(argv[1], "--write"))
        return write_files();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_are_complete),
        cmocka_unit_test(every_key_is_stored),
        cmocka_unit_test(kinds_of_places_are_keys),
        cmocka_unit_test(examples_show_every_key),
        cmocka_unit_test(examples_read_without_diagnostics),
        cmocka_unit_test(schemas_have_every_key),
        cmocka_unit_test(schemas_agree_with_table),
        cmocka_unit_test(files_are_up_to_date),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
