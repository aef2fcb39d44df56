/* The stage prefer: the velocity that the state's steering asks for, and where the agent looks. A
   batch of one state is done term by term, in lanes where the word has a kernel. */
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

/* Where agents of a state look that is about something. */
static void look(const JoxMachineRun *run, const JoxState *state, uint32_t i) {
    JoxAgents *a = run->agents;
    JoxSpot spot = jox_target_find(run, i, state->face);
    JoxV2 way = {spot.x - a->x[i], spot.y - a->y[i]};
    if (!spot.found || !(jox_length2(way) > 0.0f))
        return;
    way = jox_unit(way);
    a->face_x[i] = way.x;
    a->face_y[i] = way.y;
}

static bool is_function(const JoxState *state) {
    return state->steer_count == 1 && state->steer[0].kind == JOX_STEER_FUNCTION;
}

/* Weights of a term, for all of a batch. */
static void weigh(const JoxMachineRun *run, const JoxMachine *machine, const JoxValue *weight,
                  JoxRegisters registers, JoxSteer *s) {
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

/* Round a place: all of a batch at once where it is the same for all of them. */
static void orbit(const Prefer *p, const JoxSteerTerm *term, JoxSteer *s) {
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

/* Along a vector whose figures may be computed, for all of a batch. */
static void drift(const JoxMachineRun *run, const JoxMachine *machine, const JoxSteerTerm *term,
                  JoxRegisters registers, JoxSteer *s) {
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

/* What a term asks of a batch, into its ways. Weights that are 0, or no numbers that count, as of a
   target that is infinitely far, are not asked for. */
static void ask(const Prefer *p, const JoxMachine *machine, const JoxSteerTerm *term,
                JoxRegisters registers, JoxSteer *s) {
    s->args = term->args;
    if (term->kind == JOX_STEER_DRIFT) {
        drift(p->run, machine, term, registers, s);
        return;
    }
    if (term->kind == JOX_STEER_ORBIT) {
        orbit(p, term, s);
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

/* The weighted sum of a state's terms; those that evade come last, as they go by where the others
   lead. */
static void sum_terms(const Prefer *p, const JoxMachine *machine, const JoxState *state,
                      JoxRegisters registers, JoxSteer *s) {
    memset(s->sum_x, 0, sizeof s->sum_x);
    memset(s->sum_y, 0, sizeof s->sum_y);
    for (int evades = 0; evades < 2; evades++)
        for (uint32_t t = 0; t < state->steer_count; t++) {
            const JoxSteerTerm *term = &state->steer[t];
            if ((term->kind == JOX_STEER_EVADE) != evades)
                continue;
            if (evades && !s->leads) {
                memcpy(s->ahead_x, s->sum_x, sizeof s->ahead_x);
                memcpy(s->ahead_y, s->sum_y, sizeof s->ahead_y);
                s->leads = true;
            }
            weigh(p->run, machine, &term->weight, registers, s);
            ask(p, machine, term, registers, s);
            p->kernels->add(s);
        }
}

/* The agents of a batch, the last of them again up to a whole packet. */
static void begin_batch(const JoxMachineRun *run, const JoxBatchRange *batch, JoxSteer *s) {
    s->agents = run->agents;
    s->count = batch->count;
    s->leads = false;
    for (uint32_t n = 0; n < JOX_BATCH; n++)
        s->index[n] =
            run->scratch->grouped[batch->begin + (n < batch->count ? n : batch->count - 1)];
}

static void prefer_batch(const Prefer *p, const JoxBatchRange *batch, JoxRegisters registers) {
    const JoxMachineRun *run = p->run;
    const JoxMachine *machine = run->set->items[batch->machine];
    const JoxState *state = &machine->states[batch->state];
    JoxAgents *a = run->agents;
    JoxSteer s;
    begin_batch(run, batch, &s);
    if (state->face < 0)
        p->kernels->face(&s);
    for (uint32_t n = 0; n < s.count; n++) {
        if (state->face >= 0)
            look(run, state, s.index[n]);
        if (a->bound[s.index[n]])
            a->bound[s.index[n]] = 0;
    }
    if (is_function(state))
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

/* Steering by plain Lua functions, by id. */
static void ask_functions(JoxMachineRun *run) {
    JoxAgents *a = run->agents;
    bool any = false;
    for (uint32_t b = 0; b < run->scratch->batch_count; b++) {
        const JoxBatchRange *batch = &run->scratch->batches[b];
        any |= is_function(&run->set->items[batch->machine]->states[batch->state]);
    }
    for (uint32_t rank = 0; any && rank < a->count; rank++) {
        uint32_t i = a->by_rank[rank];
        if (a->machine[i] == JOX_NO_MACHINE)
            continue;
        const JoxMachine *machine = jox_machine_of(run, i);
        const JoxState *state = &machine->states[a->state[i]];
        if (!is_function(state))
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
    Prefer prefer = {run, &KERNELS[jox_isa_resolve(run->isa)]};
    jox_parallel_for(pool, run->scratch->batch_count, 1, prefer_range, &prefer);
    ask_functions(run);
    JOX_CHECK(jox_preferred_check(run));
    if (run->bracket)
        run->bracket(run->call_context, false);
}
