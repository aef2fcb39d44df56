/* The kernel of programs: what is arithmetic, or is read from the agents' columns. Plain loops over
   the agents of a batch, which the compiler makes vector operations of. */
#include <math.h>
#include <string.h>

#include "machine/kernels.h"
#include "simd/lanes.h"

enum { PACKET = 8 };
_Static_assert(JOX_BATCH % PACKET == 0, "registers hold whole packets");

/* What can be measured of an agent, of `count` of them: one loop for each word. */
static void measure(const JoxMachineRun *run, const uint32_t *agents, uint32_t count, JoxNow what,
                    double *restrict to) {
    const JoxAgents *a = run->agents;
    switch (what) {
#define X(name, word, unit, meaning, value)                                                        \
    case JOX_NOW_##name:                                                                           \
        for (uint32_t n = 0; n < count; n++) {                                                     \
            const uint32_t i = agents[n];                                                          \
            (void)i;                                                                               \
            to[n] = (value);                                                                       \
        }                                                                                          \
        break;
        JOX_MEASURED(X)
#undef X
    case JOX_NOW_COUNT:
        break;
    }
}

/* Of registers, in whole packets: those behind `count` are room. What a packet gives is written
   when all of it is read, as one register may be read and written. */
#define EACH(expression)                                                                           \
    for (uint32_t first = 0; first < count; first += PACKET) {                                     \
        double out[PACKET];                                                                        \
        for (uint32_t lane = 0; lane < PACKET; lane++) {                                           \
            const uint32_t n = first + lane;                                                       \
            out[lane] = (expression);                                                              \
        }                                                                                          \
        memcpy(to + first, out, sizeof out);                                                       \
    }                                                                                              \
    break
/* Of agent `i`, whose figures no register holds. */
#define EACH_AGENT(expression)                                                                     \
    for (uint32_t n = 0; n < count; n++) {                                                         \
        const uint32_t i = agents[n];                                                              \
        to[n] = (expression);                                                                      \
    }                                                                                              \
    break

bool JOX_WIDE(jox_eval_numbers)(const JoxMachineRun *run, const JoxInstruction *in,
                                const uint32_t *agents, uint32_t count, JoxRegisters r) {
    const JoxAgents *g = run->agents;
    double *to = r[in->to];
    const double *a = r[in->a], *b = r[in->b], *c = r[in->c];
    switch ((JoxOp)in->op) {
    case JOX_OP_CONST:
        for (uint32_t n = 0; n < count; n++)
            to[n] = in->number;
        break;
    case JOX_OP_NOW:
        measure(run, agents, count, (JoxNow)in->arg, to);
        break;
    case JOX_OP_OWN:
        EACH_AGENT(jox_own(g, i, (uint32_t)in->arg));
    case JOX_OP_MEMORY:
        EACH_AGENT(g->memory[(size_t)i * g->memory_stride + (uint32_t)in->arg]);
    case JOX_OP_ADD:
        EACH(a[n] + b[n]);
    case JOX_OP_SUB:
        EACH(a[n] - b[n]);
    case JOX_OP_MUL:
        EACH(a[n] * b[n]);
    case JOX_OP_DIV:
        EACH(b[n] == 0.0 ? 0.0 : a[n] / b[n]);
    case JOX_OP_MIN:
        EACH(a[n] < b[n] ? a[n] : b[n]);
    case JOX_OP_MAX:
        EACH(a[n] > b[n] ? a[n] : b[n]);
    case JOX_OP_NEG:
        EACH(-a[n]);
    case JOX_OP_ABS:
        EACH(fabs(a[n]));
    case JOX_OP_SQRT:
        EACH(a[n] > 0.0 ? sqrt(a[n]) : 0.0);
    case JOX_OP_CLAMP:
        EACH(a[n] < b[n] ? b[n] : a[n] > c[n] ? c[n] : a[n]);
    case JOX_OP_GT:
        EACH(a[n] > b[n]);
    case JOX_OP_GE:
        EACH(a[n] >= b[n]);
    case JOX_OP_LT:
        EACH(a[n] < b[n]);
    case JOX_OP_LE:
        EACH(a[n] <= b[n]);
    case JOX_OP_EQ:
        EACH(a[n] == b[n]);
    case JOX_OP_AND:
        EACH(a[n] != 0.0 && b[n] != 0.0);
    case JOX_OP_OR:
        EACH(a[n] != 0.0 || b[n] != 0.0);
    case JOX_OP_NOT:
        EACH(a[n] == 0.0);
    case JOX_OP_AFTER:
        EACH_AGENT(jox_time_in_state(run, i) >= a[n] - 1e-9);
    case JOX_OP_LASTED:
        EACH_AGENT(jox_time_in_state(run, i) >= g->lasts[i] - 1e-6);
    case JOX_OP_STUCK:
        EACH_AGENT(g->still[i] >= a[n]);
    default:
        return false;
    }
    return true;
}
