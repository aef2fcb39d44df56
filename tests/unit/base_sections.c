/* The walk over the sections of a state: hash, save, restore, compare, visit. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "base/sections.h"

typedef struct Thing {
    uint64_t tick;
    float x[4];
    uint32_t order[4];
    uint16_t *list;
    uint32_t list_count;
    size_t list_capacity;
    double rows[4 * 3];
    char *name;
    uint32_t figure;
} Thing;

static void list_thing_sections(JoxSections *s, Thing *t, const uint32_t *order) {
    jox_sections_module(s, "thing");
    JOX_SECTION(s, "tick", t->tick);
    jox_section_ordered(s, "x", t->x, sizeof *t->x, 4, order);
    JOX_SECTION_ARRAY(s, "list", t->list, t->list_count, t->list_capacity);
    jox_section_rows(s, "rows", t->rows, 3, 4, order);
    jox_section_string(s, "name", &t->name);
    jox_sections_unhashed(s, true);
    JOX_SECTION(s, "figure", t->figure);
    jox_sections_unhashed(s, false);
}

static Thing make_thing(void) {
    Thing t = {.tick = 7, .x = {4, 3, 2, 1}, .order = {3, 2, 1, 0}, .figure = 9};
    for (uint16_t i = 0; i < 5; i++) {
        JOX_RESERVE(t.list, t.list_capacity, t.list_count + 1u);
        t.list[t.list_count++] = (uint16_t)(100 + i);
    }
    t.rows[4] = 2.5;
    t.name = jox_strdup("one");
    return t;
}

static void free_thing(Thing *t) {
    jox_free(t->list);
    jox_free(t->name);
}

static uint64_t hash_thing(Thing *t, const uint32_t *order) {
    JoxSections s = jox_sections_hash();
    list_thing_sections(&s, t, order);
    return jox_hash_end(&s.hash);
}

static JoxText save_thing(Thing *t) {
    JoxText out = {0};
    JoxSections s = jox_sections_save(&out);
    list_thing_sections(&s, t, t->order);
    assert_true(jox_sections_end(&s));
    return out;
}

static void saved_state_is_restored(void **state) {
    (void)state;
    Thing a = make_thing(), b = {.order = {0}};
    JoxText text = save_thing(&a);
    JoxSections s = jox_sections_restore(text.data, text.length);
    list_thing_sections(&s, &b, NULL);
    assert_true(jox_sections_end(&s));
    assert_true(b.tick == 7 && b.list_count == 5 && b.list[4] == 104 && b.figure == 9);
    assert_true(b.x[0] == 1 && b.x[3] == 4 && b.rows[2 * 3 + 1] == 2.5);
    assert_string_equal(b.name, "one");
    assert_true(hash_thing(&a, a.order) == hash_thing(&b, NULL));
    s = jox_sections_compare(text.data, text.length);
    list_thing_sections(&s, &a, a.order);
    assert_true(jox_sections_end(&s));
    jox_text_free(&text);
    free_thing(&a);
    free_thing(&b);
}

static void a_comparison_names_the_first_difference(void **state) {
    (void)state;
    Thing a = make_thing();
    JoxText text = save_thing(&a);
    a.x[a.order[2]] = 8;
    a.list[3] = 1;
    JoxSections s = jox_sections_compare(text.data, text.length);
    list_thing_sections(&s, &a, a.order);
    assert_false(jox_sections_end(&s));
    assert_true(s.differs && !s.failed);
    assert_string_equal(s.wrong, "thing.x: cell 2 of 4 differs");
    a.x[a.order[2]] = 3;
    a.list_count--;
    s = jox_sections_compare(text.data, text.length);
    list_thing_sections(&s, &a, a.order);
    assert_false(jox_sections_end(&s));
    assert_string_equal(s.wrong, "thing.list: cell 0 of 1 differs");
    jox_text_free(&text);
    free_thing(&a);
}

/* Every byte of the buffer that is another, and every length, is refused before anything is
   read. */
static void damaged_buffers_are_refused(void **state) {
    (void)state;
    Thing a = make_thing(), b = make_thing();
    JoxText text = save_thing(&a);
    b.tick = 8;
    for (size_t length = 0; length < text.length; length++) {
        JoxSections s = jox_sections_restore(text.data, length);
        list_thing_sections(&s, &b, NULL);
        assert_false(jox_sections_end(&s));
        assert_true(b.tick == 8 && b.x[0] == 4);
    }
    for (size_t i = 0; i < text.length; i++) {
        text.data[i] ^= 4;
        JoxSections s = jox_sections_restore(text.data, text.length);
        list_thing_sections(&s, &b, NULL);
        assert_false(jox_sections_end(&s));
        text.data[i] ^= 4;
        assert_true(s.failed && b.tick == 8 && b.x[0] == 4);
    }
    jox_text_free(&text);
    free_thing(&a);
    free_thing(&b);
}

static void list_others(JoxSections *s, Thing *t) {
    jox_sections_module(s, "thing");
    JOX_SECTION(s, "tick", t->tick);
    jox_section(s, "x", t->x, sizeof *t->x, 3);
}

static void another_format_is_refused(void **state) {
    (void)state;
    Thing a = make_thing(), b = {.order = {0}};
    JoxText text = save_thing(&a);
    JoxSections s = jox_sections_restore(text.data, text.length);
    list_others(&s, &b);
    assert_false(jox_sections_end(&s));
    assert_string_equal(s.wrong, "thing.x: the section has another number of cells");
    s = jox_sections_restore(text.data, text.length);
    jox_sections_module(&s, "thing");
    JOX_SECTION(&s, "time", b.tick);
    assert_string_equal(s.wrong, "thing.time: the state has another section in this place: it is "
                                 "of another version, or damaged");
    s = jox_sections_restore(text.data, text.length);
    jox_sections_module(&s, "thing");
    JOX_SECTION(&s, "tick", b.tick);
    assert_false(jox_sections_end(&s));
    assert_string_equal(s.wrong, "the state has sections that this world does not know");
    jox_text_free(&text);
    free_thing(&a);
}

static void invalid_booleans_are_refused(void **state) {
    (void)state;
    JoxText text = {0};
    unsigned char byte = 255;
    bool read = false;
    JoxSections s = jox_sections_save(&text);
    jox_section(&s, "open", &byte, sizeof byte, 1);
    assert_true(jox_sections_end(&s));
    s = jox_sections_restore(text.data, text.length);
    JOX_SECTION(&s, "open", read);
    assert_false(jox_sections_end(&s));
    assert_string_equal(s.wrong, "open: a cell is neither true nor false");
    jox_text_free(&text);
}

typedef struct Flip {
    Thing *thing;
    uint64_t hash;
    size_t cells, hashed;
} Flip;

static void check_flipped_cell(void *context, const char *section, size_t index, void *cell,
                               size_t size, bool hashed) {
    Flip *f = context;
    (void)index;
    for (size_t byte = 0; byte < size; byte++) {
        ((unsigned char *)cell)[byte] ^= 16;
        bool changed = hash_thing(f->thing, f->thing->order) != f->hash;
        ((unsigned char *)cell)[byte] ^= 16;
        if (changed != hashed)
            fail_msg("%s", section);
    }
    f->cells++;
    f->hashed += hashed;
}

static void each_cell_is_visited_and_hashed(void **state) {
    (void)state;
    Thing a = make_thing();
    Flip f = {.thing = &a, .hash = hash_thing(&a, a.order)};
    JoxSections s = jox_sections_visit(check_flipped_cell, &f);
    list_thing_sections(&s, &a, a.order);
    assert_int_equal(f.cells, 1 + 4 + 5 + 4 + 3 + 1);
    assert_int_equal(f.hashed, f.cells - 1);
    free_thing(&a);
}

/* The hash of a row does not depend on the width of the table. */
static void row_stride_is_not_hashed(void **state) {
    (void)state;
    double narrow[] = {1, 2, 0, 3}, wide[] = {1, 2, 0, 0, 3, 0}, moved[] = {1, 2, 3, 0};
    double *tables[] = {narrow, wide, moved};
    uint64_t hashes[3];
    for (int i = 0; i < 3; i++) {
        JoxSections s = jox_sections_hash();
        jox_section_rows(&s, "rows", tables[i], i == 1 ? 3 : 2, 2, NULL);
        hashes[i] = jox_hash_end(&s.hash);
    }
    assert_true(hashes[0] == hashes[1]); /* (1, 2) and (0, 3), with room for a third */
    assert_true(hashes[0] != hashes[2]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(saved_state_is_restored),
        cmocka_unit_test(invalid_booleans_are_refused),
        cmocka_unit_test(a_comparison_names_the_first_difference),
        cmocka_unit_test(damaged_buffers_are_refused),
        cmocka_unit_test(another_format_is_refused),
        cmocka_unit_test(each_cell_is_visited_and_hashed),
        cmocka_unit_test(row_stride_is_not_hashed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
