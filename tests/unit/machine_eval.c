/* Tests the kernel of expressions against one scalar expression per instruction, on every
   instruction set of the machine: random and special numbers (zeros of both signs, infinities,
   NaN), batches of any length, a separate output register and one that is also an input. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "agents/agents.h"
#include "base/number/random.h"
#include "machine/kernels.h"

#define X(name, isa) [isa] = jox_eval_numbers_##name,
static JoxEvalKernel *const KERNELS[JOX_ISA_ROOM] = {JOX_ISAS(X)};
#undef X

static JoxRegisters is, wanted;

/* Returns a random number, often one of a few special ones, so that operands are often equal. */
static double draw_special_number(uint32_t number, uint32_t drawn) {
    static const double HARD[] = {0.0, -0.0, 1.0, -1.0, INFINITY, -INFINITY, NAN, 1e-320, 1e308};
    const double unit = jox_random_unit(5, number, 0, JOX_DRAW_FILL, drawn);
    if (unit < 0.4)
        return HARD[(size_t)(unit / 0.4 * (sizeof HARD / sizeof *HARD))];
    return (unit - 0.7) * 40.0;
}

static double evaluate_plainly(JoxOp op, double a, double b, double c, bool *known) {
    switch (op) {
    case JOX_OP_CONST:
        return 2.5;
    case JOX_OP_ADD:
        return a + b;
    case JOX_OP_SUB:
        return a - b;
    case JOX_OP_MUL:
        return a * b;
    case JOX_OP_DIV:
        return b == 0.0 ? 0.0 : a / b;
    case JOX_OP_MIN:
        return a < b ? a : b;
    case JOX_OP_MAX:
        return a > b ? a : b;
    case JOX_OP_NEG:
        return -a;
    case JOX_OP_ABS:
        return fabs(a);
    case JOX_OP_SQRT:
        return a > 0.0 ? sqrt(a) : 0.0;
    case JOX_OP_CLAMP:
        return a < b ? b : a > c ? c : a;
    case JOX_OP_GT:
        return a > b;
    case JOX_OP_GE:
        return a >= b;
    case JOX_OP_LT:
        return a < b;
    case JOX_OP_LE:
        return a <= b;
    case JOX_OP_EQ:
        return a == b;
    case JOX_OP_AND:
        return a != 0.0 && b != 0.0;
    case JOX_OP_OR:
        return a != 0.0 || b != 0.0;
    case JOX_OP_NOT:
        return a == 0.0;
    default:
        *known = false;
        return 0.0;
    }
}

static bool is_same_number(double a, double b) {
    return (isnan(a) && isnan(b)) || memcmp(&a, &b, sizeof a) == 0;
}

/* Runs one instruction for `count` agents, into register `to`, and compares the results; false if
   it is not arithmetic. */
static bool compare_instruction(JoxEvalKernel *kernel, JoxOp op, uint8_t to, uint32_t count) {
    uint32_t agents[JOX_BATCH] = {0};
    JoxAgents none = {0};
    JoxMachineRun run = {.agents = &none};
    const JoxInstruction in = {.op = (uint8_t)op, .to = to, .a = 0, .b = 1, .c = 2, .number = 2.5};
    bool known = true;
    for (uint32_t k = 0; k < 4; k++)
        for (uint32_t n = 0; n < JOX_BATCH; n++)
            is[k][n] = draw_special_number(k * JOX_BATCH + n, (uint32_t)op * 4 + to);
    for (uint32_t n = 0; n < count; n++)
        wanted[to][n] = evaluate_plainly(op, is[0][n], is[1][n], is[2][n], &known);
    if (!known)
        return false;
    assert_true(kernel(&run, &in, agents, count, is));
    for (uint32_t n = 0; n < count; n++)
        if (!is_same_number(is[to][n], wanted[to][n]))
            fail_msg("operation %d, agent %u of %u: %g, not %g", op, n, count, is[to][n],
                     wanted[to][n]);
    return true;
}

static void arithmetic_is_as_written(void **state) {
    (void)state;
    uint32_t compared = 0;
    for (int isa = 0; isa < (int)JOX_ISA_ROOM; isa++)
        for (int op = 0; jox_isa_runs((JoIsa)isa) && op < JOX_OP_COUNT; op++)
            for (uint8_t to = 0; to < 4; to++) {
                const uint32_t counts[] = {1, 3, 8, 21, JOX_BATCH};
                for (size_t k = 0; k < sizeof counts / sizeof *counts; k++)
                    compared += compare_instruction(KERNELS[isa], (JoxOp)op, to, counts[k]);
            }
    assert_true(compared >= 19 * 4 * 5);
}

/* Words about other agents are left to the caller of the kernel. */
static void other_words_are_refused(void **state) {
    (void)state;
    uint32_t agents[JOX_BATCH] = {0};
    JoxAgents none = {0};
    JoxMachineRun run = {.agents = &none};
    for (int isa = 0; isa < (int)JOX_ISA_ROOM; isa++)
        for (int op = JOX_OP_DISTANCE; jox_isa_runs((JoIsa)isa) && op < JOX_OP_COUNT; op++) {
            const JoxInstruction in = {.op = (uint8_t)op};
            if (op != JOX_OP_AFTER && op != JOX_OP_LASTED && op != JOX_OP_STUCK &&
                op != JOX_OP_FALLEN && op != JOX_OP_DONE && op != JOX_OP_OUTER_AFTER &&
                op != JOX_OP_OUTER_LASTED && op != JOX_OP_OUTER_TIME)
                assert_false(KERNELS[isa](&run, &in, agents, 0, is));
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(arithmetic_is_as_written),
        cmocka_unit_test(other_words_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
