/* Tests machines that are built by hand: conditions, chance, order of hooks, counters, queues,
   kicks, reload. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "base/mem.h"
#include "geom/place_kinds.h"
#include "machine/run.h"

/* A small world around machines: agents without neighbours, places given by each test. */
typedef struct Fixture {
    JoxAgents agents;
    JoxNeighbours neighbours;
    JoxObjects objects;
    JoxMachineSet set;
    JoxMachineState state;
    JoxMachineRun machines;
} Fixture;

static JoxMachine *new_machine(uint32_t states) {
    JoxMachine *m = jox_alloc(1, sizeof *m);
    m->name = jox_strdup("m");
    m->path = jox_strdup("m.lua");
    m->vm = -1;
    m->state_count = states;
    m->states = jox_alloc(states, sizeof *m->states);
    for (uint32_t s = 0; s < states; s++) {
        char name[2] = {(char)('A' + s), 0};
        m->states[s] = jox_state_blank(jox_strdup(name));
    }
    return m;
}

static int32_t append_expression(JoxMachine *m, const JoxInstruction *code, uint32_t count) {
    m->expressions = jox_realloc(m->expressions, m->expression_count + 1, sizeof *m->expressions);
    JoxExpression *p = &m->expressions[m->expression_count];
    p->code = jox_alloc(count, sizeof *code);
    memcpy(p->code, code, count * sizeof *code);
    p->count = count;
    return (int32_t)m->expression_count++;
}

static JoxTransition *add_transition(JoxMachine *m, uint16_t from, uint16_t to, int32_t when) {
    JoxState *s = &m->states[from];
    s->transitions = jox_realloc(s->transitions, s->transition_count + 1, sizeof *s->transitions);
    JoxTransition *t = &s->transitions[s->transition_count++];
    *t = jox_transition_blank(jox_strdup(m->states[to].name));
    t->to = to;
    t->when = when;
    return t;
}

static int16_t add_place_target(JoxMachine *m, int32_t place) {
    m->targets = jox_realloc(m->targets, m->target_count + 1, sizeof *m->targets);
    m->targets[m->target_count] =
        (JoxTarget){.kind = JOX_TARGET_PLACE, .arg = place, .name = jox_strdup("place")};
    return (int16_t)m->target_count++;
}

static void set_up_fixture(Fixture *f, JoxMachine *machine, uint32_t agents) {
    *f = (Fixture){0};
    f->machines = (JoxMachineRun){.set = &f->set,
                                  .state = &f->state,
                                  .agents = &f->agents,
                                  .neighbours = &f->neighbours,
                                  .objects = &f->objects,
                                  .seed = 7,
                                  .dt = 0.1};
    f->neighbours = (JoxNeighbours){
        .agents = 4096, .stride = 1, .index = jox_alloc(4096, 4), .count = jox_alloc(4096, 1)};
    jox_machines_add(&f->machines, machine);
    for (uint32_t i = 0; i < agents; i++) {
        jox_agents_add(&f->agents);
        jox_machines_spawn(&f->machines, i, 0, NULL, NULL);
    }
}

static void run_step(Fixture *f) {
    jox_machines_think(&f->machines, NULL);
    jox_machines_prefer(&f->machines, NULL);
    f->machines.tick++;
}

static void tear_down_fixture(Fixture *f) {
    jox_machines_free(&f->machines);
    jox_agents_free(&f->agents);
    jox_neighbours_free(&f->neighbours);
}

/* Adds a condition that holds once the state has lasted `seconds`. */
static int32_t add_time_condition(JoxMachine *m, double seconds) {
    const JoxInstruction code[] = {
        {.op = JOX_OP_CONST, .number = seconds, .target = -1, .place = -1},
        {.op = JOX_OP_AFTER, .target = -1, .place = -1}};
    return append_expression(m, code, 2);
}

static void operators_compute(void **state) {
    (void)state;
    static const struct {
        JoxOp op;
        double a, b, c, result;
    } CASES[] = {
        {JOX_OP_ADD, 2, 3, 0, 5},    {JOX_OP_SUB, 2, 3, 0, -1},  {JOX_OP_MUL, 2, 3, 0, 6},
        {JOX_OP_DIV, 3, 2, 0, 1.5},  {JOX_OP_DIV, 3, 0, 0, 0},   {JOX_OP_MIN, 2, 3, 0, 2},
        {JOX_OP_MAX, 2, 3, 0, 3},    {JOX_OP_NEG, 2, 0, 0, -2},  {JOX_OP_ABS, -2, 0, 0, 2},
        {JOX_OP_SQRT, 9, 0, 0, 3},   {JOX_OP_SQRT, -9, 0, 0, 0}, {JOX_OP_CLAMP, 5, 1, 3, 3},
        {JOX_OP_CLAMP, -5, 1, 3, 1}, {JOX_OP_GT, 2, 2, 0, 0},    {JOX_OP_GE, 2, 2, 0, 1},
        {JOX_OP_LT, 1, 2, 0, 1},     {JOX_OP_LE, 3, 2, 0, 0},    {JOX_OP_EQ, 2, 2, 0, 1},
        {JOX_OP_AND, 1, 0, 0, 0},    {JOX_OP_OR, 1, 0, 0, 1},    {JOX_OP_NOT, 0, 0, 0, 1}};
    for (size_t i = 0; i < sizeof CASES / sizeof *CASES; i++) {
        JoxMachine *m = new_machine(1);
        const JoxInstruction code[] = {
            {.op = JOX_OP_CONST, .to = 0, .number = CASES[i].a, .target = -1, .place = -1},
            {.op = JOX_OP_CONST, .to = 1, .number = CASES[i].b, .target = -1, .place = -1},
            {.op = JOX_OP_CONST, .to = 2, .number = CASES[i].c, .target = -1, .place = -1},
            {.op = CASES[i].op, .a = 0, .b = 1, .c = 2, .target = -1, .place = -1},
            /* kept above zero, so that a parameter can hold it */
            {.op = JOX_OP_CONST, .to = 1, .number = 10, .target = -1, .place = -1},
            {.op = JOX_OP_ADD, .a = 0, .b = 1, .target = -1, .place = -1}};
        m->states[0].param[JOX_PARAM_push] =
            (JoxValue){JOX_VALUE_EXPRESSION, 0, append_expression(m, code, 6), 0, 0};
        Fixture f;
        set_up_fixture(&f, m, 1);
        run_step(&f);
        assert_true(fabsf(jox_param(&f.agents, JOX_PARAM_push, 0) - (float)(CASES[i].result + 10)) <
                    1e-5f);
        tear_down_fixture(&f);
    }
}

static void the_first_transition_that_holds_wins(void **state) {
    (void)state;
    JoxMachine *m = new_machine(3);
    add_transition(m, 0, 1, add_time_condition(m, 0.3));
    add_transition(m, 0, 2, add_time_condition(m, 0.2));
    Fixture f;
    set_up_fixture(&f, m, 300); /* more than a batch */
    run_step(&f);
    run_step(&f);
    assert_int_equal(f.agents.state[299], 0);
    run_step(&f); /* 0.2 s in the state */
    for (uint32_t i = 0; i < 300; i++)
        assert_int_equal(f.agents.state[i], 2);
    assert_int_equal(f.machines.taken_count, 300);
    tear_down_fixture(&f);
}

static void chance_is_rolled_once_each_time_the_condition_turns_true(void **state) {
    (void)state;
    JoxMachine *m = new_machine(2);
    add_transition(m, 0, 1, add_time_condition(m, 0.1))->chance =
        (JoxValue){JOX_VALUE_CONST, 0.3, 0, 0, 0};
    Fixture f;
    set_up_fixture(&f, m, 2000);
    for (int i = 0; i < 50; i++)
        run_step(&f);
    uint32_t gone = 0;
    for (uint32_t i = 0; i < 2000; i++)
        gone += f.agents.state[i] == 1;
    assert_true(gone > 500 && gone < 700); /* 600 +- 5 sigma; rolled each step, nearly all */
    tear_down_fixture(&f);
}

static void a_drawn_duration_ends_the_state(void **state) {
    (void)state;
    JoxMachine *m = new_machine(2);
    m->states[0].has_lasts = true;
    m->states[0].lasts = (JoxDist){.kind = JOX_DIST_UNIFORM, .a = 1.0, .b = 2.0};
    const JoxInstruction lasted[] = {{.op = JOX_OP_LASTED, .target = -1, .place = -1}};
    add_transition(m, 0, 1, append_expression(m, lasted, 1));
    Fixture f;
    set_up_fixture(&f, m, 200);
    for (int step = 0; step < 30; step++) {
        run_step(&f);
        for (uint32_t i = 0; i < 200; i++) {
            if (step < 9)
                assert_int_equal(f.agents.state[i], 0);
            if (step > 21)
                assert_int_equal(f.agents.state[i], 1);
        }
    }
    tear_down_fixture(&f);
}

static uint32_t calls[64];
static uint32_t call_count;

static bool note_call(void *context, const JoxMachine *machine, int32_t hook, JoxHookKind kind,
                      uint32_t agent, double result[2]) {
    (void)machine;
    (void)kind;
    (void)result;
    const JoxAgents *a = context;
    if (call_count < 64)
        calls[call_count++] = a->id[agent] * 10 + (uint32_t)hook;
    return true;
}

static void hooks_run_by_id_whatever_the_order_in_memory(void **state) {
    (void)state;
    JoxMachine *m = new_machine(2);
    add_transition(m, 0, 1, add_time_condition(m, 0.1))->on_take = 2;
    m->states[0].on_exit = 1;
    m->states[1].on_enter = 3;
    Fixture f;
    set_up_fixture(&f, m, 4);
    f.machines.call = note_call;
    f.machines.call_context = &f.agents;
    const uint32_t order[] = {2, 0, 3, 1};
    jox_agents_permute(&f.agents, order, (uint64_t[4]){0});
    call_count = 0;
    run_step(&f);
    run_step(&f);
    const uint32_t expected[] = {1, 2, 3, 11, 12, 13, 21, 22, 23, 31, 32, 33};
    assert_int_equal(call_count, 12);
    assert_memory_equal(calls, expected, sizeof expected);
    tear_down_fixture(&f);
}

/* Moves agent 0 round the origin by `turns`, in steps of 9 degrees. */
static void walk_round(Fixture *f, double *angle, double turns) {
    int steps = (int)(fabs(turns) * 40 + 0.5);
    for (int i = 0; i < steps; i++) {
        f->agents.prev_x[0] = f->agents.x[0];
        f->agents.prev_y[0] = f->agents.y[0];
        *angle += turns > 0 ? 6.283185307179586 / 40 : -6.283185307179586 / 40;
        f->agents.x[0] = (float)(5.0 * cos(*angle));
        f->agents.y[0] = (float)(5.0 * sin(*angle));
        run_step(f);
    }
}

static void circuits_count_from_the_line_and_back_again(void **state) {
    (void)state;
    JoxV2 ring[] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, line[] = {{1, 0}, {9, 0}};
    JoxPlace places[] = {
        {.name = "k", .kind = JOX_PLACE_POLYGON, .points = ring, .count = 4, .start = 1},
        {.name = "l", .kind = JOX_PLACE_LINE, .points = line, .count = 2, .start = -1}};
    jox_place_finish(&places[0]);
    jox_place_finish(&places[1]);
    JoxMachine *m = new_machine(1);
    m->memory = jox_alloc(3, sizeof *m->memory);
    for (int i = 0; i < 3; i++)
        m->memory[i].name = jox_strdup(i ? "" : "laps");
    m->memory_count = 3;
    m->counters = jox_alloc(1, sizeof *m->counters);
    m->counters[0] = (JoxCounter){add_place_target(m, 0), 0, 1, 2, -1};
    m->counter_count = 1;
    Fixture f;
    set_up_fixture(&f, m, 1);
    f.machines.places = places;
    f.machines.place_count = 2;
    double angle = -1.0;
    f.agents.x[0] = (float)(5.0 * cos(angle));
    f.agents.y[0] = (float)(5.0 * sin(angle));
    walk_round(&f, &angle, 0.125); /* not yet at the start line */
    assert_true(f.agents.memory[0] == 0.0 && f.agents.memory[2] == 0.0);
    walk_round(&f, &angle, 7.2); /* across it, and seven times round */
    assert_true(f.agents.memory[0] == 7.0);
    walk_round(&f, &angle, -3.0);
    assert_true(f.agents.memory[0] == 4.0);
    walk_round(&f, &angle, 3.0);
    assert_true(f.agents.memory[0] == 7.0);
    tear_down_fixture(&f);
}

static void a_queue_keeps_its_order(void **state) {
    (void)state;
    JoxV2 tail[] = {{0, 0}, {10, 0}};
    JoxPlace place = {.name = "q",
                      .kind = JOX_PLACE_QUEUE,
                      .points = tail,
                      .count = 2,
                      .spacing = 0.5f,
                      .start = -1};
    jox_place_finish(&place);
    JoxMachine *m = new_machine(2);
    int16_t target = add_place_target(m, 0);
    m->states[1].steer[0] = (JoxSteerTerm){.kind = JOX_STEER_QUEUE, .target = target, .hook = -1};
    m->states[1].steer_count = 1;
    /* Agents nearer than x metres join the queue; x grows with time, so that they join one by
       one. */
    const JoxInstruction near[] = {
        {.op = JOX_OP_NOW, .arg = JOX_NOW_time, .target = -1, .place = -1},
        {.op = JOX_OP_NEAR, .target = target, .place = -1}};
    add_transition(m, 0, 1, append_expression(m, near, 2));
    Fixture f;
    set_up_fixture(&f, m, 3);
    f.machines.places = &place;
    f.machines.place_count = 1;
    const float away[] = {0.55f, 0.25f, 0.85f}; /* joins second, first, third */
    for (int i = 0; i < 3; i++)
        f.agents.y[i] = away[i];
    for (int i = 0; i < 11; i++)
        run_step(&f);
    /* The first aims at the head, the second at 0.5 m, the third at 1 m along the tail. */
    assert_true(fabsf(f.agents.pref_x[1]) < 1e-3f);
    assert_true(f.agents.pref_x[0] > 0.1f && f.agents.pref_x[2] > f.agents.pref_x[0]);
    tear_down_fixture(&f);
}

static void a_reload_keeps_states_and_memory_by_name(void **state) {
    (void)state;
    JoxMachine *old = new_machine(2);
    old->memory = jox_alloc(1, sizeof *old->memory);
    old->memory[0].name = jox_strdup("laps");
    old->memory_count = 1;
    add_transition(old, 0, 1, add_time_condition(old, 0.1));
    Fixture f;
    set_up_fixture(&f, old, 5);
    run_step(&f);
    run_step(&f);
    f.agents.memory[3 * f.agents.memory_stride] = 6.0;
    uint32_t entered = f.agents.entered[3];

    JoxMachine *lacking = new_machine(1);
    char why[128];
    JoxReplacement *replacement = jox_replacement_prepare(old, lacking, 7, f.agents.next_id);
    assert_non_null(jox_machines_refuses(&f.machines, 0, replacement, why, sizeof why));
    jox_replacement_free(replacement);
    assert_non_null(strstr(why, "5 agents are in 'B'"));
    lacking->renamed = jox_alloc(1, sizeof *lacking->renamed);
    lacking->renamed[0] = (struct JoxRenamed){jox_strdup("B"), jox_strdup("A")};
    lacking->renamed_count = 1;
    replacement = jox_replacement_prepare(old, lacking, 7, f.agents.next_id);
    assert_null(jox_machines_refuses(&f.machines, 0, replacement, why, sizeof why));
    jox_replacement_free(replacement);
    jox_machine_free(lacking);

    JoxMachine *next = new_machine(3);
    next->memory = jox_alloc(2, sizeof *next->memory);
    next->memory[0].name = jox_strdup("added");
    next->memory[0].initial = 2.0;
    next->memory[1].name = jox_strdup("laps");
    next->memory_count = 2;
    replacement = jox_replacement_prepare(old, next, 7, f.agents.next_id);
    jox_machine_free(jox_machines_replace(&f.machines, 0, replacement));
    jox_replacement_free(replacement);
    const double *memory = f.agents.memory + 3 * f.agents.memory_stride;
    assert_true(memory[0] == 2.0 && memory[1] == 6.0);
    assert_int_equal(f.agents.state[3], 1);
    assert_int_equal(f.agents.entered[3], entered);
    assert_int_equal(f.set.items[0]->reloads, 1);
    tear_down_fixture(&f);
}

/* Appends counts of transitions as "A>B=5 A>C=0 ". */
static void append_count(void *context, const char *from, const char *to, uint64_t taken) {
    char *out = context;
    size_t n = strlen(out);
    snprintf(out + n, 256 - n, "%s>%s=%llu ", from, to, (unsigned long long)taken);
}

static void transitions_are_counted_over_all_versions(void **state) {
    (void)state;
    JoxMachine *old = new_machine(3);
    add_transition(old, 0, 1, add_time_condition(old, 0.1));
    add_transition(old, 0, 2, add_time_condition(old, 9));
    add_transition(old, 1, 0, add_time_condition(old, 0.1));
    Fixture f;
    set_up_fixture(&f, old, 5);
    for (int k = 0; k < 4; k++) /* in B from the second step, in A at the third, in B at the
                                   fourth */
        run_step(&f);
    char counts[256] = "";
    jox_machines_taken(&f.machines, 0, append_count, counts);
    assert_string_equal(counts, "A>B=10 A>C=0 B>A=5 ");

    /* In this version B is called K, nothing leads back to A, and two transitions lead to K. */
    JoxMachine *next = new_machine(3);
    next->states[1].name[0] = 'K';
    next->renamed = jox_alloc(1, sizeof *next->renamed);
    next->renamed[0] = (struct JoxRenamed){jox_strdup("B"), jox_strdup("K")};
    next->renamed_count = 1;
    JoxTransition *kept = add_transition(next, 0, 1, add_time_condition(next, 0.1));
    kept->id[0] = 'B';
    add_transition(next, 0, 1, add_time_condition(next, 9));
    add_transition(next, 1, 2, add_time_condition(next, 0.1));
    JoxReplacement *replacement = jox_replacement_prepare(old, next, 7, f.agents.next_id);
    jox_machine_free(jox_machines_replace(&f.machines, 0, replacement));
    jox_replacement_free(replacement);
    run_step(&f);
    counts[0] = 0;
    jox_machines_taken(&f.machines, 0, append_count, counts);
    assert_string_equal(counts, "A>K=10 K>C=5 B>A=5 ");
    tear_down_fixture(&f);
}

/* Returns a machine whose only state kicks a ball at place 0 by 3 m/s, `lift` degrees upwards. */
static JoxMachine *new_kicking_machine(JoxValue lift) {
    JoxMachine *m = new_machine(1);
    m->states[0].kick_at = add_place_target(m, 0);
    m->targets = jox_realloc(m->targets, 2, sizeof *m->targets);
    m->targets[1] = (JoxTarget){.kind = JOX_TARGET_NEAREST, .arg = 4, .name = jox_strdup("ball")};
    m->target_count = 2;
    m->states[0].kick = 1;
    m->states[0].kick_impulse = (JoxValue){JOX_VALUE_CONST, 3.0, 0, 0, 0};
    m->states[0].kick_lift = lift;
    return m;
}

/* Place 0 of kicks, and a ball of 0.4 kg that the agent of a fixture touches. */
typedef struct Pitch {
    JoxV2 spot;
    JoxPlace place;
    JoxObject ball;
} Pitch;

static void set_up_pitch(Fixture *f, Pitch *pitch) {
    pitch->spot = (JoxV2){10, 0};
    pitch->place = (JoxPlace){.name = "p",
                              .kind = JOX_PLACE_POINT,
                              .points = &pitch->spot,
                              .count = 1,
                              .radius = 1,
                              .start = -1};
    jox_place_finish(&pitch->place);
    pitch->ball = (JoxObject){.live = true,
                              .in_band = true,
                              .moves = true,
                              .tags = 1 << 4,
                              .position = {0.3f, 0.0f, 0.1f},
                              .inverse_mass = 2.5f,
                              .round = 0.1f,
                              .disc = 0.1f};
    f->machines.places = &pitch->place;
    f->machines.place_count = 1;
    f->objects = (JoxObjects){.rows = &pitch->ball, .count = 1, .capacity = 1};
}

static void a_kick_sends_the_ball_towards_its_target(void **state) {
    (void)state;
    Fixture f;
    Pitch pitch;
    set_up_fixture(&f, new_kicking_machine((JoxValue){0}), 1);
    set_up_pitch(&f, &pitch);
    run_step(&f);
    assert_int_equal(f.machines.kick_count, 1);
    assert_true(fabsf(f.machines.kicks[0].impulse.x - 3.0f / 2.5f) < 1e-4f); /* 3 m/s for 0.4 kg */
    assert_true(fabsf(f.machines.kicks[0].impulse.y) < 1e-4f);
    assert_true(f.machines.kicks[0].impulse.z == 0.0f);
    assert_int_equal(f.agents.kicked[0], 1);
    run_step(&f); /* too soon for another kick */
    assert_int_equal(f.machines.kick_count, 0);
    assert_int_equal(f.agents.kicked[0], 0);
    tear_down_fixture(&f);
}

static void lift_turns_the_impulse_upwards_and_keeps_its_size(void **state) {
    (void)state;
    static const struct {
        double lift;
        float level, up;
    } KICKS[] = {{30, 0.866025f, 0.5f}, {90, 0, 1}, {200, 0, 1}, {-5, 1, 0}, {NAN, 1, 0}};
    for (size_t k = 0; k < sizeof KICKS / sizeof *KICKS; k++) {
        Fixture f;
        Pitch pitch;
        const JoxValue lift = {JOX_VALUE_CONST, KICKS[k].lift, 0, 0, 0};
        set_up_fixture(&f, new_kicking_machine(lift), 1);
        set_up_pitch(&f, &pitch);
        run_step(&f);
        assert_int_equal(f.machines.kick_count, 1);
        assert_true(fabsf(f.machines.kicks[0].impulse.x - 1.2f * KICKS[k].level) < 1e-5f);
        assert_true(fabsf(f.machines.kicks[0].impulse.z - 1.2f * KICKS[k].up) < 1e-5f);
        tear_down_fixture(&f);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(operators_compute),
        cmocka_unit_test(the_first_transition_that_holds_wins),
        cmocka_unit_test(chance_is_rolled_once_each_time_the_condition_turns_true),
        cmocka_unit_test(a_drawn_duration_ends_the_state),
        cmocka_unit_test(hooks_run_by_id_whatever_the_order_in_memory),
        cmocka_unit_test(circuits_count_from_the_line_and_back_again),
        cmocka_unit_test(a_queue_keeps_its_order),
        cmocka_unit_test(a_reload_keeps_states_and_memory_by_name),
        cmocka_unit_test(transitions_are_counted_over_all_versions),
        cmocka_unit_test(a_kick_sends_the_ball_towards_its_target),
        cmocka_unit_test(lift_turns_the_impulse_upwards_and_keeps_its_size),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
