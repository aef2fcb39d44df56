/* Creates, frees and configures the stages of force; begins a step; lists what outlasts it. */
#include <math.h>

#include "agents/torso.h"
#include "base/assert.h"
#include "base/mem.h"
#include "force/contact/contacts.h"
#include "force/push/pushes.h"
#include "force/stages/kernels.h"
#include "force/support/supports.h"

#define X(name, isa) [isa] = jox_record_packets_##name,
static JoxRecordKernel *const KERNELS[JOX_ISA_ROOM] = {JOX_ISAS(X)};
#undef X

JoxForceOptions jox_force_default_options(void) {
    return (JoxForceOptions){
        .iterations = 60, .tolerance = 2.0f, .reach = 0.6f, .filter = 0.13f, .least = 0.05f};
}

void jox_forces_set_options(JoxForces *f, const JoxForceOptions *options) {
    f->options = options ? *options : jox_force_default_options();
}

void jox_forces_set_isa(JoxForces *f, JoIsa isa) {
    JOX_ASSERT(jox_isa_runs(isa));
    f->isa = isa;
}

void jox_forces_set_memory(JoxForces *f, JoxStageMemory *memory) {
    f->memory = memory;
}

float jox_force_passing_reach(const JoxForces *f) {
    return f->options.reach;
}

JoxForces *jox_forces_create(const JoxForceOptions *options) {
    JoxForces *f = jox_alloc(1, sizeof *f);
    f->pushes = jox_alloc(1, sizeof *f->pushes);
    f->supports = jox_alloc(1, sizeof *f->supports);
    f->contacts = jox_alloc(1, sizeof *f->contacts);
    jox_forces_set_options(f, options);
    f->isa = jox_isa_resolve(JO_ISA_WIDEST);
    f->memory = &f->own_memory;
    return f;
}

void jox_forces_free(JoxForces *f) {
    if (!f)
        return;
    jox_transfers_free(&f->transfers);
    jox_chunk_memory_free(&f->found_memory);
    jox_chunk_memory_free(&f->pair_memory);
    jox_impulses_free(&f->impulses);
    jox_pushes_free(f->pushes);
    jox_supports_free(f->supports);
    jox_contacts_free(f->contacts);
    jox_stage_memory_free(&f->own_memory);
    jox_free(f);
}

/* Zeroes the columns of agents [begin, end) that do not carry over from the last step. */
static void zero_columns(const JoxForces *f, uint32_t begin, uint32_t end) {
    JoxAgents *a = f->step.agents;
#define ZERO_SCRATCH(column) jox_mem_fill((column) + begin, 0, (end - begin) * sizeof *(column));
#define ZERO_STATE(column)
#define ZERO(X, keep, role, name, label) ZERO_##keep(a->name##_x) ZERO_##keep(a->name##_y)
    JOX_FORCE_TERMS(ZERO, )
    ZERO_SCRATCH(f->pushes->reactions)
    ZERO_SCRATCH(a->compression)
    ZERO_SCRATCH(a->load)
    ZERO_SCRATCH(a->contacts)
#undef ZERO
#undef ZERO_STATE
#undef ZERO_SCRATCH
}

/* Begins the step for the agents of a chunk. */
static void begin_agents(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    const JoxForces *f = context;
    zero_columns(f, begin, end);
    KERNELS[f->isa](f, begin, end);
}

_Static_assert(sizeof(JoxContactMotion) == sizeof(JoxAgentRecord), "motions replace records");

/* Returns the stage memory for so many agents, bytes: records, padded to packets, which motions
   replace, and what contact/layout.c takes. */
static size_t measure_stage_memory(size_t agents) {
    return jox_stage_memory_bytes(agents + JOX_LANES, sizeof(JoxAgentRecord)) +
           jox_stage_memory_bytes(agents, sizeof(uint64_t));
}

void jox_force_begin(JoxForces *f, const JoxStep *step, const JoxForceInputs *inputs) {
    const JoxTiming *timing = &step->timing;
    JOX_ASSERT(step->agents && step->neighbours && timing->dt > 0.0 && timing->planning_time > 0.0);
    JOX_ASSERT(timing->response > 0.0 && timing->interval > 0.0 && timing->interval_response > 0.0);
    f->step = *step;
    f->in = *inputs;
    f->totals = (JoxForceTotals){0};
    f->impulses.count = f->impulses.sorted_count = 0;
    f->contacts->known = false;
    f->contacts->drives.count = f->contacts->touches.count = 0;
    f->contacts->walls.count = f->contacts->pairs.count = 0;
    JoxAgents *a = step->agents;
    uint32_t n = a->count;
    f->chunks = (n + JOX_FORCE_GRAIN - 1) / JOX_FORCE_GRAIN;
    JOX_RESERVE(f->transfers.starts, f->transfers.start_capacity, (size_t)n + 1);
    jox_pushes_start_step(f);
    jox_stage_memory_begin(f->memory, measure_stage_memory(n));
    f->records = jox_stage_memory_take(f->memory, (size_t)n + JOX_LANES, sizeof *f->records);
    JOX_ASSERT(step->neighbours->agents >= n || n == 0);
    f->widest = jox_agents_widest(a, f->options.literal);
    if (n)
        jox_decay(&f->decay, jox_param(a, JOX_PARAM_damping, 0), (float)timing->dt);
    jox_parallel_for(step->pool, n, JOX_FORCE_GRAIN, begin_agents, f);
    f->has_bodies = n && step->objects && step->objects->grid.columns;
}

static void list_kept_impulses(JoxSections *s, const char *name, JoxKeptImpulses *kept) {
    JOX_SECTION_ARRAY(s, name, kept->items, kept->count, kept->capacity);
    for (size_t k = 0; s->mode == JOX_SECTIONS_RESTORE && k < kept->count; k++) {
        const JoxKeptImpulse *one = &kept->items[k];
        const float least = jox_minf(one->impulse, one->borne);
        if (!(least >= 0.0f && one->impulse + one->borne + fabsf(one->parted) < INFINITY))
            jox_sections_fail(s, name, "an impulse of a contact pulls, or is no number");
    }
}

void jox_forces_sections(JoxForces *f, JoxSections *s) {
    jox_sections_module(s, "force");
    JoxKeptImpulses *kept = f->contacts->kept;
    list_kept_impulses(s, "pairs", &kept[JOX_KEPT_PAIRS]);
    list_kept_impulses(s, "walls", &kept[JOX_KEPT_WALLS]);
    list_kept_impulses(s, "touches", &kept[JOX_KEPT_TOUCHES]);
}

JoxForceTotals jox_force_totals(const JoxForces *f) {
    return f->totals;
}

const JoxKeptImpulse *jox_force_kept_impulses(const JoxForces *f, JoxKeptKind kind, size_t *count) {
    *count = f->contacts->kept[kind].count;
    return f->contacts->kept[kind].items;
}

const JoxImpulse *jox_force_impulses(JoxForces *f, uint32_t *count) {
    return jox_impulses_sort(&f->impulses, count);
}
