/* The stage prefer: the velocity that a state's steering asks for, and the direction that agents
   face. A batch of one state is computed term by term; terms with a kernel run in lanes. */
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "machine/kernels.h"

#define X(name, isa)                                                                               \
    [isa] = {jox_steer_orbit_##name, jox_steer_arrive_##name, jox_steer_add_##name,                \
             jox_steer_finish_##name, jox_steer_face_##name},
static const struct Kernels {
    JoxSteerKernel *orbit, *arrive, *add, *finish, *face;
} KERNELS[JOX_ISA_ROOM] = {JOX_ISAS(X)};
#undef X

typedef struct Prefer {
    JoxMachineRun *run;
    const struct Kernels *kernels;
} Prefer;

/* Turns an agent to the target that its state faces. */
static void face_target(const JoxMachineRun *run, const JoxState *state, uint32_t i) {
    JoxAgents *a = run->agents;
    JoxSpot spot = jox_target_find(run, i, state->face);
    JoxV2 way = {spot.x - a->x[i], spot.y - a->y[i]};
    if (!spot.found || !(jox_length2(way) > 0.0f))
        return;
    way = jox_unit(way);
    a->face_x[i] = way.x;
    a->face_y[i] = way.y;
}

static bool steers_by_function(const JoxState *state) {
    return state->steer_count > 0 && state->steer[0].kind == JOX_STEER_FUNCTION;
}

/* Evaluates the weight of a term for a batch. */
static void evaluate_weights(const JoxMachineRun *run, const JoxMachine *machine,
                             const JoxValue *weight, JoxRegisters registers, JoxSteer *s) {
    const bool computed = weight->kind == JOX_VALUE_EXPRESSION;
    if (computed)
        jox_eval(run, machine, &machine->expressions[weight->index], s->index, s->count, registers);
    if (weight->kind == JOX_VALUE_UNSET)
        for (uint32_t n = 0; n < s->count; n++)
            s->by[n] = 1.0f;
    else
        for (uint32_t n = 0; n < s->count; n++)
            s->by[n] = computed ? (float)registers[0][n]
                                : (float)jox_value(run, machine, weight, s->index[n]);
}

/* Computes the term orbit for a batch: at once if the place is the same for all agents. */
static void steer_orbit_batch(const Prefer *p, const JoxSteerTerm *term, JoxSteer *s) {
    const JoxMachineRun *run = p->run;
    const JoxMachine *machine = jox_machine_of(run, s->index[0]);
    const bool same = term->target < 0 || machine->targets[term->target].kind == JOX_TARGET_PLACE;
    const uint32_t step = same ? s->count : 1;
    for (uint32_t n = 0; n < s->count; n += step) {
        int32_t place = jox_target_place(run, s->index[n], term->target);
        s->place = place < 0 ? NULL : &run->places[place];
        s->begin = n;
        s->end = n + step;
        p->kernels->orbit(s);
    }
}

/* Computes the term drift, whose components may be expressions. */
static void steer_drift_batch(const JoxMachineRun *run, const JoxMachine *machine,
                              const JoxSteerTerm *term, JoxRegisters registers, JoxSteer *s) {
    float *const ways[] = {s->way_x, s->way_y};
    for (int k = 0; k < 2; k++) {
        const JoxValue *value = &term->drift[k];
        const bool computed = value->kind == JOX_VALUE_EXPRESSION;
        if (computed)
            jox_eval(run, machine, &machine->expressions[value->index], s->index, s->count,
                     registers);
        for (uint32_t n = 0; n < s->count; n++) {
            const double number =
                computed ? registers[0][n] : jox_value(run, machine, value, s->index[n]);
            ways[k][n] = fabs(number) <= JOX_MOST_DRIFT ? (float)number : 0.0f;
        }
    }
}

/* Computes the velocities of a term for a batch, as far as weights count (jox_weight_counts). */
static void evaluate_term(const Prefer *p, const JoxMachine *machine, const JoxSteerTerm *term,
                          JoxRegisters registers, JoxSteer *s) {
    s->args = term->args;
    if (term->kind == JOX_STEER_DRIFT) {
        steer_drift_batch(p->run, machine, term, registers, s);
        return;
    }
    if (term->kind == JOX_STEER_ORBIT) {
        steer_orbit_batch(p, term, s);
        return;
    }
    if (term->kind == JOX_STEER_SEEK || term->kind == JOX_STEER_ALONG) {
        jox_steer_place(p->run, machine, term, s);
        if (term->kind == JOX_STEER_SEEK)
            p->kernels->arrive(s);
        return;
    }
    if (term->kind == JOX_STEER_FIELD) {
        jox_steer_field(p->run, machine, term, s);
        return;
    }
    if (term->kind == JOX_STEER_RIDE) {
        jox_steer_ride(p->run, machine, term, s);
        return;
    }
    for (uint32_t n = 0; n < s->count; n++) {
        const uint32_t i = s->index[n];
        JoxV2 way = {0.0f, 0.0f};
        if (jox_weight_counts(s->by[n]))
            way = term->kind == JOX_STEER_EVADE
                      ? jox_steer_evade(p->run, i, jox_unit(jox_v2(s->ahead_x[n], s->ahead_y[n])))
                      : jox_steer_word(p->run, i, term);
        s->way_x[n] = way.x;
        s->way_y[n] = way.y;
    }
}

/* Sums the weighted terms of a state. Terms evade come last, since they are sideways to the sum of
   the others. */
static void sum_terms(const Prefer *p, const JoxMachine *machine, const JoxState *state,
                      JoxRegisters registers, JoxSteer *s) {
    memset(s->sum_x, 0, sizeof s->sum_x);
    memset(s->sum_y, 0, sizeof s->sum_y);
    for (int evades = 0; evades < 2; evades++)
        for (uint32_t t = steers_by_function(state); t < state->steer_count; t++) {
            const JoxSteerTerm *term = &state->steer[t];
            if ((term->kind == JOX_STEER_EVADE) != evades)
                continue;
            if (evades && !s->leads) {
                memcpy(s->ahead_x, s->sum_x, sizeof s->ahead_x);
                memcpy(s->ahead_y, s->sum_y, sizeof s->ahead_y);
                s->leads = true;
            }
            evaluate_weights(p->run, machine, &term->weight, registers, s);
            evaluate_term(p, machine, term, registers, s);
            p->kernels->add(s);
        }
}

/* Lists the agents of a batch, and fills the rest of the array with the last one. */
static void list_batch_agents(const JoxMachineRun *run, const JoxBatchRange *batch, JoxSteer *s) {
    s->agents = run->agents;
    s->count = batch->count;
    s->leads = false;
    for (uint32_t n = 0; n < JOX_BATCH; n++)
        s->index[n] =
            run->scratch->grouped[batch->begin + (n < batch->count ? n : batch->count - 1)];
}

/* Computes preferred velocities and facing directions of one batch. */
static void prefer_batch(const Prefer *p, const JoxBatchRange *batch, JoxRegisters registers) {
    const JoxMachineRun *run = p->run;
    const JoxMachine *machine = run->set->items[batch->machine];
    const JoxState *state = &machine->states[batch->state];
    JoxAgents *a = run->agents;
    JoxSteer s;
    list_batch_agents(run, batch, &s);
    if (state->face < 0)
        p->kernels->face(&s);
    for (uint32_t n = 0; n < s.count; n++) {
        if (state->face >= 0)
            face_target(run, state, s.index[n]);
        if (a->bound[s.index[n]])
            a->bound[s.index[n]] = 0;
    }
    if (steers_by_function(state) && state->steer_count == 1)
        return;
    sum_terms(p, machine, state, registers, &s);
    p->kernels->finish(&s);
}

static void prefer_range(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    const Prefer *p = context;
    const JoxMachineScratch *scratch = p->run->scratch;
    JOX_ASSERT(worker < scratch->workers);
    for (uint32_t b = begin; b < end; b++)
        prefer_batch(p, &scratch->batches[b], scratch->registers[worker]);
}

/* Calls steering functions in Lua, by id. */
static void call_steering_functions(JoxMachineRun *run) {
    JoxAgents *a = run->agents;
    bool any = false;
    for (uint32_t b = 0; b < run->scratch->batch_count; b++) {
        const JoxBatchRange *batch = &run->scratch->batches[b];
        any |= steers_by_function(&run->set->items[batch->machine]->states[batch->state]);
    }
    for (uint32_t rank = 0; any && rank < a->count; rank++) {
        uint32_t i = a->by_rank[rank];
        if (a->machine[i] == JOX_NO_MACHINE)
            continue;
        const JoxMachine *machine = jox_machine_of(run, i);
        const JoxState *state = &machine->states[a->state[i]];
        if (!steers_by_function(state))
            continue;
        double v[2] = {0.0, 0.0};
        bool good = run->call && run->call(run->call_context, machine, state->steer[0].hook,
                                           JOX_HOOK_STEER, i, v);
        good = good && fabs(v[0]) <= 100.0 && fabs(v[1]) <= 100.0;
        a->pref_x[i] = good ? (float)v[0] : 0.0f;
        a->pref_y[i] = good ? (float)v[1] : 0.0f;
    }
}

void jox_machines_prefer(JoxMachineRun *run, JoxPool *pool) {
    if (run->set->count == 0)
        return;
    JOX_CHECK(jox_groups_check(run));
    jox_rows_form(run);
    jox_gatherings_form(run);
    jox_leads_form(run);
    Prefer prefer = {run, &KERNELS[jox_isa_resolve(run->isa)]};
    jox_parallel_for(pool, run->scratch->batch_count, 1, prefer_range, &prefer);
    call_steering_functions(run);
    jox_machines_stay_in(run);
    jox_machines_mind_stairs(run, pool);
    JOX_CHECK(jox_preferred_check(run));
    if (run->bracket)
        run->bracket(run->call_context, false);
}
