/* Agents' columns, handles, sorting; the pool of threads. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "agents/agents.h"
#include "base/mem.h"
#include "base/number/random.h"
#include "task/pool.h"

static uint64_t hash_of(JoxAgents *a) {
    JoxSections s = jox_sections_hash();
    jox_agents_sections(a, &s);
    return jox_hash_end(&s.hash);
}

static void columns_follow_their_agent(void **state) {
    (void)state;
    JoxAgents a = {0};
    jox_agents_widen(&a, 2, 3);
    for (uint32_t i = 0; i < 300; i++) {
        uint32_t at = jox_agents_add(&a);
        a.x[at] = (float)i;
        a.tags[at] = (uint64_t)i << 40;
        jox_own_set(&a, at, 1, i);
        a.memory[at * a.memory_stride + 2] = 2.0 * i;
    }
    uint32_t order[300];
    for (uint32_t i = 0; i < 300; i++)
        order[i] = i * 7 % 300;
    jox_agents_permute(&a, order, (uint64_t[300]){0});
    jox_agents_widen(&a, 5, 4);
    for (uint32_t i = 0; i < 300; i++) {
        uint32_t id = a.id[i];
        assert_int_equal(id, order[i]);
        assert_int_equal(jox_agents_find(&a, id), i);
        assert_int_equal(a.slot_index[a.slot[i]], i);
        assert_true(a.x[i] == (float)id && a.tags[i] == (uint64_t)id << 40);
        assert_true(jox_own(&a, i, 1) == id && jox_own(&a, i, 4) == 0);
        assert_true(a.memory[i * 4 + 2] == 2.0 * id);
    }
    jox_agents_free(&a);
}

/* A column of own values takes memory only while somebody's differs from the others'. */
static void own_values_of_all_are_held_once(void **state) {
    (void)state;
    JoxAgents a = {0};
    jox_agents_widen(&a, 2, 0);
    for (uint32_t i = 0; i < 100; i++) {
        const uint32_t at = jox_agents_add(&a);
        a.machine[at] = 0;
        jox_own_set(&a, at, 0, -0.0);
        jox_own_set(&a, at, 1, i < 99 ? 3.0 : 4.0);
    }
    assert_true(!a.own[0].mask && signbit(jox_own(&a, 50, 0)));
    assert_true(a.own[1].mask);
    jox_shared_settle(&a);
    assert_true(jox_own(&a, 0, 1) == 3.0 && jox_own(&a, 98, 1) == 3.0 && jox_own(&a, 99, 1) == 4.0);
    const uint64_t differing = hash_of(&a);
    jox_own_set(&a, 99, 1, 3.0);
    jox_own_set(&a, 7, 0, 0.0); /* another bit: another value */
    jox_own_set(&a, 7, 0, -0.0);
    const uint64_t before = hash_of(&a);
    assert_true(a.own[0].mask && a.own[1].mask && before != differing);
    jox_shared_settle(&a);
    assert_true(!a.own[0].mask && !a.own[1].mask && hash_of(&a) == before);
    assert_true(jox_own(&a, 99, 1) == 3.0 && signbit(jox_own(&a, 7, 0)));
    jox_agents_free(&a);
}

/* So does a column of a parameter; a packet reads it wherever it begins. */
static void parameters_of_all_are_held_once(void **state) {
    (void)state;
    const JoxParameter p = JOX_PARAM_speed;
    JoxAgents a = {0};
    for (uint32_t i = 0; i < 100; i++)
        jox_param_set(&a, p, jox_agents_add_alike(&a), 2.0f);
    assert_true(!a.param[p].mask && jox_param(&a, p, 99) == 2.0f);
    for (uint32_t k = 0; k < JOX_AGENTS_PADDING; k++)
        assert_true(jox_params(&a, p, 96)[k] == 2.0f);
    const uint32_t other = jox_agents_add(&a); /* with the default */
    assert_true(a.param[p].mask && jox_param(&a, p, other) == 1.3f);
    assert_true(jox_param(&a, p, 0) == 2.0f && jox_param(&a, p, 99) == 2.0f);
    assert_true(jox_param_greatest(&a, p) == 2.0f && jox_params(&a, p, other)[0] == 1.3f);
    assert_true(jox_param(&a, p, jox_agents_add_alike(&a)) == 1.3f);
    assert_true(!a.param[JOX_PARAM_mass].mask && jox_param_greatest(&a, JOX_PARAM_mass) == 70.0f);
    uint32_t order[102];
    for (uint32_t i = 0; i < 102; i++)
        order[i] = 101 - i;
    jox_agents_permute(&a, order, (uint64_t[102]){0});
    assert_true(jox_param(&a, p, 0) == 1.3f && jox_param(&a, p, 2) == 2.0f);
    jox_shared_settle(&a);
    assert_true(a.param[p].mask);
    a.removed[0] = a.removed[1] = 1;
    jox_agents_compact(&a);
    const uint64_t each = hash_of(&a);
    jox_shared_settle(&a);
    assert_true(!a.param[p].mask && jox_param(&a, p, 50) == 2.0f && hash_of(&a) == each);
    jox_agents_free(&a);
}

/* More numbers an agent than there are agents. */
static void rows_may_be_wide(void **state) {
    (void)state;
    enum { WIDE = 4000 };
    static const uint32_t ORDER[] = {1, 2, 0};
    JoxAgents a = {0};
    jox_agents_widen(&a, 1, WIDE);
    for (uint32_t i = 0; i < 3; i++) {
        const uint32_t at = jox_agents_add(&a);
        a.tags[at] = 100 + i;
        for (uint32_t m = 0; m < WIDE; m++)
            a.memory[at * WIDE + m] = i * WIDE + m;
    }
    jox_agents_permute(&a, ORDER, (uint64_t[3]){0});
    for (uint32_t i = 0; i < 3; i++) {
        assert_int_equal(a.tags[i], 100 + ORDER[i]);
        for (uint32_t m = 0; m < WIDE; m++)
            assert_true(a.memory[i * WIDE + m] == ORDER[i] * WIDE + m);
    }
    jox_agents_free(&a);
}

/* The cells of an agent say what its id is, in columns of all widths and kinds. */
static void check_cells(const JoxAgents *a) {
    for (uint32_t i = 0; i < a->count; i++) {
        const uint32_t id = a->id[i];
        assert_true(a->x[i] == (float)id && a->tags[i] == 1000 + id && a->team[i] == id % 7);
        assert_true(a->contacts[i] == id % 5 &&
                    jox_param(a, JOX_PARAM_mass, i) == 50.0f + (float)id);
        assert_true(jox_own(a, i, 0) == 2.0 * id && a->memory[i] == 3.0 * id);
    }
}

/* Each who comes turns the order round, from the first few, whose columns stand side by side, to
   many. */
static void a_few_become_many(void **state) {
    (void)state;
    enum { MANY = 200 };
    uint32_t order[MANY];
    uint64_t room[MANY];
    JoxAgents a = {0};
    jox_agents_widen(&a, 1, 1);
    for (uint32_t n = 1; n <= MANY; n++) {
        const uint32_t i = jox_agents_add(&a), id = a.id[i];
        a.x[i] = (float)id;
        a.tags[i] = 1000 + id;
        a.team[i] = (uint16_t)(id % 7);
        a.contacts[i] = (uint8_t)(id % 5);
        jox_param_set(&a, JOX_PARAM_mass, i, 50.0f + (float)id);
        jox_own_set(&a, i, 0, 2.0 * id);
        a.memory[i] = 3.0 * id;
        check_cells(&a);
        for (uint32_t k = 0; k < n; k++)
            order[k] = n - 1 - k;
        jox_agents_permute(&a, order, room);
        check_cells(&a);
    }
    jox_agents_free(&a);
}

static void removing_keeps_order_and_retires_handles(void **state) {
    (void)state;
    JoxAgents a = {0};
    for (uint32_t i = 0; i < 10; i++)
        jox_agents_add(&a);
    uint32_t slot = a.slot[3], generation = a.slot_generation[slot];
    a.removed[3] = a.removed[7] = 1;
    assert_int_equal(jox_agents_compact(&a), 2);
    assert_int_equal(a.count, 8);
    assert_int_equal(a.id[3], 4);
    assert_int_equal(jox_agents_find(&a, 3), JOX_NO_INDEX);
    assert_int_equal(a.slot_index[slot], JOX_NO_INDEX);
    assert_int_equal(a.slot_generation[slot], generation + 1);
    uint32_t at = jox_agents_add(&a);
    assert_int_equal(a.id[at], 10); /* slots are used again, ids never */
    uint32_t by_id[9];
    jox_agents_by_id(&a, by_id);
    for (int i = 1; i < 9; i++)
        assert_true(a.id[by_id[i - 1]] < a.id[by_id[i]]);
    jox_agents_free(&a);
}

/* Whoever leaves: cells of every width stay with their agents, and these in their order. */
static void whatever_leaves_the_rest_keeps_its_cells(void **state) {
    (void)state;
    enum { COUNT = 200, STRIDE = 3 };
    for (uint32_t round = 0; round < 100; round++) {
        JoxAgents a = {0};
        uint32_t kept[COUNT], stay = 0;
        jox_agents_widen(&a, 1, STRIDE);
        for (uint32_t i = 0; i < COUNT; i++) {
            jox_agents_add(&a);
            a.tags[i] = 1000 + i;
            a.contacts[i] = (uint8_t)i;
            a.team[i] = (uint16_t)(300 + i);
            a.load[i] = (float)i;
            jox_own_set(&a, i, 0, i);
            a.memory[i * STRIDE + 2] = i;
            a.removed[i] = jox_random_unit(7, i, round, JOX_DRAW_FILL, 0) < 0.01 * round;
            if (!a.removed[i])
                kept[stay++] = i;
        }
        assert_int_equal(jox_agents_compact(&a), COUNT - stay);
        assert_int_equal(a.count, stay);
        for (uint32_t i = 0; i < stay; i++) {
            assert_true(a.id[i] == kept[i] && a.by_rank[i] == i && a.tags[i] == 1000 + kept[i]);
            assert_true(a.contacts[i] == kept[i] && a.team[i] == 300 + kept[i]);
            assert_true(a.load[i] == (float)kept[i] && jox_own(&a, i, 0) == kept[i]);
            assert_true(a.memory[i * STRIDE + 2] == kept[i] && a.speed_limit[i] > 0.0f);
        }
        jox_agents_free(&a);
    }
}

/* A million births and deaths among 100: no table grows with the number of ids ever given. */
static void turnover_takes_no_memory(void **state) {
    (void)state;
    JoxAgents a = {0};
    uint64_t allocations = 0;
    for (uint32_t i = 0; i < 100; i++)
        jox_agents_add(&a);
    for (uint32_t round = 0; round < 20000; round++) {
        uint32_t order[100], by_id[100], gone = 0;
        for (uint32_t i = 0; i < 100; i++)
            order[i] = (i * 37 + round) % 100;
        jox_agents_permute(&a, order, (uint64_t[100]){0});
        for (uint32_t i = 0; i < 100; i++)
            a.removed[i] = i % 2 == 0;
        gone = a.id[50];
        assert_int_equal(jox_agents_compact(&a), 50);
        assert_int_equal(jox_agents_find(&a, gone), JOX_NO_INDEX);
        for (int i = 0; i < 50; i++)
            jox_agents_add(&a);
        jox_agents_by_id(&a, by_id);
        for (uint32_t n = 0; n < 100; n++) {
            assert_true(n == 0 || a.id[by_id[n]] > a.id[by_id[n - 1]]);
            assert_int_equal(jox_agents_find(&a, a.id[by_id[n]]), by_id[n]);
        }
        if (round == 100)
            allocations = jox_alloc_count();
    }
    assert_int_equal(a.next_id, 100 + 1000000);
    assert_int_equal(jox_alloc_count(), allocations);
    assert_int_equal(jox_agents_find(&a, a.next_id), JOX_NO_INDEX);
    jox_agents_free(&a);
}

static void a_new_agent_has_the_defaults(void **state) {
    (void)state;
    JoxAgents a = {0};
    uint32_t i = jox_agents_add(&a);
    assert_true(jox_param(&a, JOX_PARAM_radius, i) == 0.2f &&
                jox_param(&a, JOX_PARAM_mass, i) == 70.0f);
    assert_true(fabsf(jox_param(&a, JOX_PARAM_push_angle, i) - 0.5f) < 1e-6f);
    assert_true(isinf(a.lasts[i]) && a.goal[i] == -1);
    assert_true(jox_parameter_store(JOX_PARAM_mass, NAN) == 70.0f);
    assert_true(jox_parameter_store(JOX_PARAM_mass, -1e300) == 1.0f);
    assert_int_equal(jox_parameter_find("horizon"), JOX_PARAM_horizon);
    assert_int_equal(jox_parameter_find("horizont"), -1);
    jox_agents_free(&a);
}

typedef struct Count {
    uint32_t hits[1000];
    uint32_t chunk_begins[1000];
} Count;

static void hit(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    Count *count = context;
    count->chunk_begins[begin] = end;
    for (uint32_t i = begin; i < end; i++)
        count->hits[i]++;
}

static void every_index_runs_once_in_the_same_chunks(void **state) {
    (void)state;
    Count one = {0};
    jox_parallel_for(NULL, 1000, 64, hit, &one);
    for (uint32_t threads = 1; threads <= 4; threads++) {
        JoxPool *pool = jox_pool_create(threads);
        for (int round = 0; round < 200; round++) {
            Count many = {0};
            jox_parallel_for(pool, 1000, 64, hit, &many);
            assert_memory_equal(&many, &one, sizeof one);
        }
        jox_parallel_for(pool, 0, 64, hit, &one);
        jox_pool_free(pool);
    }
}

static JoxAgents crowd(void) {
    JoxAgents a = {0};
    jox_agents_widen(&a, 2, 1);
    for (uint32_t i = 0; i < 120; i++) {
        uint32_t at = jox_agents_add(&a);
        a.x[at] = (float)(i * 37 % 120);
        a.machine[at] = 0;
        jox_own_set(&a, at, 0, 5.0);
        jox_own_set(&a, at, 1, i);
        a.removed[at] = i % 5 == 2;
    }
    jox_agents_compact(&a);
    jox_agents_add(&a);
    return a;
}

static void shuffle(JoxAgents *a) {
    uint32_t order[200];
    for (uint32_t i = 0; i < a->count; i++)
        order[i] = a->count - 1 - i;
    jox_agents_permute(a, order, (uint64_t[200]){0});
}

/* Neither the order in memory, nor scratch, nor the width of rows is part of the state, and what is
   restored goes on as the original does: the next handles are the same, too. */
static void state_is_restored_whatever_the_order(void **state) {
    (void)state;
    JoxAgents a = crowd(), b = {0};
    JoxText saved = {0};
    shuffle(&a);
    JoxSections s = jox_sections_save(&saved);
    jox_agents_sections(&a, &s);
    assert_true(jox_sections_end(&s));
    uint64_t hash = hash_of(&a);
    jox_agents_widen(&b, 4, 1); /* its machines need more */
    s = jox_sections_restore(saved.data, saved.length);
    jox_agents_sections(&b, &s);
    assert_true(jox_sections_end(&s));
    assert_int_equal(b.own_count, 4);
    assert_true(!b.own[0].mask && b.own[1].mask && jox_own(&b, 3, 0) == 5.0);
    jox_agents_forget(&b);
    assert_true(isnan(b.forced_x[0]) && b.x[3] == 4 * 37 % 120);
    assert_true(hash_of(&b) == hash);
    for (int round = 0; round < 3; round++) {
        for (uint32_t i = 0; i < a.count; i++)
            a.removed[i] = a.id[i] % 7 == 3;
        for (uint32_t i = 0; i < b.count; i++)
            b.removed[i] = b.id[i] % 7 == 3;
        assert_int_equal(jox_agents_compact(&a), jox_agents_compact(&b));
        for (int born = 0; born < 5; born++)
            assert_int_equal(a.slot[jox_agents_add(&a)], b.slot[jox_agents_add(&b)]);
        assert_true(hash_of(&a) == hash_of(&b));
        shuffle(&a);
    }
    jox_text_free(&saved);
    jox_agents_free(&a);
    jox_agents_free(&b);
}

static void what_is_no_state_is_refused(void **state) {
    (void)state;
    JoxAgents a = crowd(), b = {0};
    JoxText saved = {0};
    a.slot[3] = a.slot[4];
    JoxSections s = jox_sections_save(&saved);
    jox_agents_sections(&a, &s);
    jox_sections_end(&s);
    s = jox_sections_restore(saved.data, saved.length);
    jox_agents_sections(&b, &s);
    assert_false(jox_sections_end(&s));
    assert_string_equal(s.wrong, "agents.slot: two agents have one slot");
    assert_int_equal(b.count, 0);
    jox_text_free(&saved);
    jox_agents_free(&a);
    jox_agents_free(&b);
}

/* Where there never was anybody, there are no columns yet. */
static void nobody_is_restored(void **state) {
    (void)state;
    JoxAgents a = {0}, b = {0};
    JoxText saved = {0};
    JoxSections s = jox_sections_save(&saved);
    jox_agents_sections(&a, &s);
    jox_sections_end(&s);
    s = jox_sections_restore(saved.data, saved.length);
    jox_agents_sections(&b, &s);
    assert_true(jox_sections_end(&s));
    assert_true(b.count == 0 && hash_of(&a) == hash_of(&b));
    assert_true(jox_param(&b, JOX_PARAM_mass, jox_agents_add(&b)) == 70.0f);
    jox_text_free(&saved);
    jox_agents_free(&a);
    jox_agents_free(&b);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(columns_follow_their_agent),
        cmocka_unit_test(own_values_of_all_are_held_once),
        cmocka_unit_test(parameters_of_all_are_held_once),
        cmocka_unit_test(rows_may_be_wide),
        cmocka_unit_test(a_few_become_many),
        cmocka_unit_test(removing_keeps_order_and_retires_handles),
        cmocka_unit_test(whatever_leaves_the_rest_keeps_its_cells),
        cmocka_unit_test(turnover_takes_no_memory),
        cmocka_unit_test(a_new_agent_has_the_defaults),
        cmocka_unit_test(every_index_runs_once_in_the_same_chunks),
        cmocka_unit_test(state_is_restored_whatever_the_order),
        cmocka_unit_test(what_is_no_state_is_refused),
        cmocka_unit_test(nobody_is_restored),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
