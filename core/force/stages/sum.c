/* The stage sum, equations 10 to 12: net force, half-plane and speed limit, by the kernel of the
   run's instruction set or as printed. */
#include "force/contact/contacts.h"
#include "force/stages/kernels.h"

#define X(name, isa) [isa] = jox_sum_packets_##name,
static JoxSumKernel *const KERNELS[JOX_ISA_ROOM] = {JOX_ISAS(X)};
#undef X

static void sum_forces_chunk(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    JoxForces *f = context;
    if (!f->options.literal)
        KERNELS[f->isa](f, begin, end);
    for (uint32_t i = begin; f->options.literal && i < end; i++)
        jox_literal_sum(f, i);
}

void jox_force_sum(JoxForces *f) {
    jox_parallel_for(f->step.pool, f->step.agents->count, JOX_FORCE_GRAIN, sum_forces_chunk, f);
    jox_contact_planes_make(f);
}
