/* Kernel of expressions: arithmetic, and words that are read from the agents' columns. Arithmetic
   uses vectors of doubles as wide as the instruction set, with the results of scalar C. */
#include <math.h>
#include <string.h>

#include "machine/kernels.h"
#include "machine/lifts.h"
#include "simd/lanes.h"

enum { BYTES = JOX_WIDTH > 4 ? 4 * JOX_WIDTH : 16, NUMBERS = BYTES / sizeof(double), PACKET = 8 };
_Static_assert(JOX_BATCH % PACKET == 0 && PACKET % NUMBERS == 0, "registers hold whole vectors");

typedef double Numbers __attribute__((vector_size(BYTES)));
typedef int64_t Marks __attribute__((vector_size(BYTES))); /* all bits set where a condition
                                                              holds */

static inline Numbers load_numbers(const double *from) {
    Numbers a;
    memcpy(&a, from, sizeof a);
    return a;
}

static inline Numbers pick_numbers(Marks where, Numbers a, Numbers b) {
    return (Numbers)((where & (Marks)a) | (~where & (Marks)b));
}

static inline Numbers clear_signs(Numbers a) {
    return (Numbers)((Marks)a & INT64_MAX);
}

/* Returns 1 where a condition holds, else 0. */
static inline Numbers to_truth(Marks where) {
    const Numbers one = (Numbers){0.0} + 1.0;
    return (Numbers)(where & (Marks)one);
}

/* Writes one measured quantity of `count` agents, by a separate loop for each. */
static void measure_agents(const JoxMachineRun *run, const uint32_t *agents, uint32_t count,
                           JoxNow what, double *restrict to) {
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

/* Writes an expression of registers, by whole vectors; entries beyond `count` are spare. Each
   vector is read before it is written, as input and output may be the same register. */
#define EACH(expression)                                                                           \
    for (uint32_t n = 0; n < count; n += NUMBERS) {                                                \
        const Numbers out = (expression);                                                          \
        memcpy(to + n, &out, sizeof out);                                                          \
    }                                                                                              \
    break
#define A load_numbers(a + n)
#define B load_numbers(b + n)
#define C load_numbers(c + n)
/* Writes an expression of agent `i` that reads columns. */
#define EACH_AGENT(expression)                                                                     \
    for (uint32_t n = 0; n < count; n++) {                                                         \
        const uint32_t i = agents[n];                                                              \
        to[n] = (expression);                                                                      \
    }                                                                                              \
    break

static void fill_register(double *to, uint32_t count, double number) {
    for (uint32_t n = 0; n < count; n++)
        to[n] = number;
}

/* Takes square roots one by one, as vectors of doubles have no operator for them; 0 for negative
   numbers. */
static void take_roots(double *to, const double *a, uint32_t count) {
    for (uint32_t first = 0; first < count; first += PACKET) {
        double out[PACKET];
        for (uint32_t lane = 0; lane < PACKET; lane++)
            out[lane] = a[first + lane] > 0.0 ? sqrt(a[first + lane]) : 0.0;
        memcpy(to + first, out, sizeof out);
    }
}

bool JOX_WIDE(jox_eval_numbers)(const JoxMachineRun *run, const JoxInstruction *in,
                                const uint32_t *agents, uint32_t count, JoxRegisters r) {
    const JoxAgents *g = run->agents;
    double *to = r[in->to];
    const double *a = r[in->a], *b = r[in->b], *c = r[in->c];
    const uint32_t arg = (uint32_t)in->arg, stride = g->memory_stride;
    const Numbers zero = {0.0};
    switch ((JoxOp)in->op) {
    case JOX_OP_CONST:
        fill_register(to, count, in->number);
        break;
    case JOX_OP_NOW:
        measure_agents(run, agents, count, (JoxNow)in->arg, to);
        break;
    case JOX_OP_OWN: {
        const double *cells = g->own[arg].cells;
        if (!g->own[arg].mask) {
            fill_register(to, count, cells[0]);
            break;
        }
        EACH_AGENT(cells[i]);
    }
    case JOX_OP_MEMORY: {
        const double *cells = g->memory + arg;
        EACH_AGENT(cells[(size_t)i * stride]);
    }
    case JOX_OP_ADD:
        EACH(A + B);
    case JOX_OP_SUB:
        EACH(A - B);
    case JOX_OP_MUL:
        EACH((A) * (B));
    case JOX_OP_DIV:
        EACH(pick_numbers(B == zero, zero, A / B));
    case JOX_OP_MIN:
        EACH(pick_numbers(A < B, A, B));
    case JOX_OP_MAX:
        EACH(pick_numbers(A > B, A, B));
    case JOX_OP_NEG:
        EACH(-A);
    case JOX_OP_ABS:
        EACH(clear_signs(A));
    case JOX_OP_SQRT:
        take_roots(to, a, count);
        break;
    case JOX_OP_CLAMP:
        EACH(pick_numbers(A < B, B, pick_numbers(A > C, C, A)));
    case JOX_OP_EITHER:
        EACH(pick_numbers(A != zero, B, C));
    case JOX_OP_GT:
        EACH(to_truth(A > B));
    case JOX_OP_GE:
        EACH(to_truth(A >= B));
    case JOX_OP_LT:
        EACH(to_truth(A < B));
    case JOX_OP_LE:
        EACH(to_truth(A <= B));
    case JOX_OP_EQ:
        EACH(to_truth(A == B));
    case JOX_OP_AND:
        EACH(to_truth((A != zero) & (B != zero)));
    case JOX_OP_OR:
        EACH(to_truth((A != zero) | (B != zero)));
    case JOX_OP_NOT:
        EACH(to_truth(A == zero));
    case JOX_OP_AFTER:
        EACH_AGENT(jox_time_in_state(run, i) >= a[n] - 1e-9);
    case JOX_OP_LASTED:
        EACH_AGENT(jox_time_in_state(run, i) >= g->lasts[i] - 1e-6);
    case JOX_OP_DONE:
        EACH_AGENT(run->set->items[g->machine[i]]->states[g->state[i]].done >> arg & 1);
    case JOX_OP_OUTER_AFTER:
        EACH_AGENT(jox_time_since(run, i, arg) >= a[n] - 1e-9);
    case JOX_OP_OUTER_LASTED:
        EACH_AGENT(jox_time_since(run, i, arg) >=
                   g->memory[(size_t)i * stride + (uint32_t)in->number] - 1e-6);
    case JOX_OP_OUTER_TIME:
        EACH_AGENT(jox_time_since(run, i, arg));
    case JOX_OP_STUCK:
        EACH_AGENT(g->still[i] >= a[n]);
    case JOX_OP_FALLEN:
        EACH_AGENT(g->fallen[i] > 0.0f);
    default:
        return false;
    }
    return true;
}
