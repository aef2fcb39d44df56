/* The kernel of programs: what is arithmetic, or is read from the agents' columns. Arithmetic is of
   vectors of the compiler's, as wide as the instruction set's, each number as plain C has it. */
#include <math.h>
#include <string.h>

#include "machine/kernels.h"
#include "simd/lanes.h"

enum { BYTES = JOX_WIDTH > 4 ? 4 * JOX_WIDTH : 16, NUMBERS = BYTES / sizeof(double), PACKET = 8 };
_Static_assert(JOX_BATCH % PACKET == 0 && PACKET % NUMBERS == 0, "registers hold whole vectors");

typedef double Numbers __attribute__((vector_size(BYTES)));
typedef int64_t Marks __attribute__((vector_size(BYTES))); /* all bits where something holds */

static inline Numbers load(const double *from) {
    Numbers a;
    memcpy(&a, from, sizeof a);
    return a;
}

static inline Numbers pick(Marks where, Numbers a, Numbers b) {
    return (Numbers)((where & (Marks)a) | (~where & (Marks)b));
}

static inline Numbers magnitude(Numbers a) {
    return (Numbers)((Marks)a & INT64_MAX);
}

/* 1 where something holds, else 0. */
static inline Numbers truth(Marks where) {
    const Numbers one = (Numbers){0.0} + 1.0;
    return (Numbers)(where & (Marks)one);
}

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

/* Of registers, in whole vectors: those behind `count` are room. What a vector gives is written
   when all of it is read, as one register may be read and written. */
#define EACH(expression)                                                                           \
    for (uint32_t n = 0; n < count; n += NUMBERS) {                                                \
        const Numbers out = (expression);                                                          \
        memcpy(to + n, &out, sizeof out);                                                          \
    }                                                                                              \
    break
#define A load(a + n)
#define B load(b + n)
#define C load(c + n)
/* Of agent `i`, whose figures no register holds. */
#define EACH_AGENT(expression)                                                                     \
    for (uint32_t n = 0; n < count; n++) {                                                         \
        const uint32_t i = agents[n];                                                              \
        to[n] = (expression);                                                                      \
    }                                                                                              \
    break

static void fill(double *to, uint32_t count, double number) {
    for (uint32_t n = 0; n < count; n++)
        to[n] = number;
}

/* Roots are no operation of vectors. */
static void root(double *to, const double *a, uint32_t count) {
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
        fill(to, count, in->number);
        break;
    case JOX_OP_NOW:
        measure(run, agents, count, (JoxNow)in->arg, to);
        break;
    case JOX_OP_OWN: {
        const double *cells = g->own[arg].cells;
        if (!g->own[arg].mask) {
            fill(to, count, cells[0]);
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
        EACH(pick(B == zero, zero, A / B));
    case JOX_OP_MIN:
        EACH(pick(A < B, A, B));
    case JOX_OP_MAX:
        EACH(pick(A > B, A, B));
    case JOX_OP_NEG:
        EACH(-A);
    case JOX_OP_ABS:
        EACH(magnitude(A));
    case JOX_OP_SQRT:
        root(to, a, count);
        break;
    case JOX_OP_CLAMP:
        EACH(pick(A < B, B, pick(A > C, C, A)));
    case JOX_OP_GT:
        EACH(truth(A > B));
    case JOX_OP_GE:
        EACH(truth(A >= B));
    case JOX_OP_LT:
        EACH(truth(A < B));
    case JOX_OP_LE:
        EACH(truth(A <= B));
    case JOX_OP_EQ:
        EACH(truth(A == B));
    case JOX_OP_AND:
        EACH(truth((A != zero) & (B != zero)));
    case JOX_OP_OR:
        EACH(truth((A != zero) | (B != zero)));
    case JOX_OP_NOT:
        EACH(truth(A == zero));
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
