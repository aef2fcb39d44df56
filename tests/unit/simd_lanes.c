/* Tests every operation on lanes against plain C, on the numbers at which instruction sets differ.
   Covers the four lanes of SSE2 and NEON, which each x86-64 and AArch64 has; wider sets are
   compared through the kernels. */
#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#if defined __x86_64__
#define JOX_ISA_sse2
#elif defined __aarch64__
#define JOX_ISA_neon
#elif defined __wasm_simd128__
#define JOX_ISA_wasm
#endif
#include "simd/lanes.h"

static const float FLOATS[] = {0.0f,
                               -0.0f,
                               1.0f,
                               -1.0f,
                               0.1f,
                               1e-40f, /* denormal */
                               -FLT_TRUE_MIN,
                               FLT_MIN,
                               FLT_MAX,
                               -FLT_MAX,
                               3.5f,
                               -2.75f,
                               2147483520.0f, /* the last float below 2^31 */
                               2147483648.0f,
                               -2147483648.0f,
                               -2147483904.0f,
                               1e20f,
                               INFINITY,
                               -INFINITY,
                               NAN};
static const int32_t INTS[] = {0, 1, -1, 7, -8, 0x12345678, INT32_MAX, INT32_MIN};
enum { FLOAT_COUNT = sizeof FLOATS / sizeof *FLOATS, INT_COUNT = sizeof INTS / sizeof *INTS };

static uint32_t get_float_bits(float x) {
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

/* Asserts the bits of all lanes; any NaN equals any other. */
static void assert_floats(JoxFloats lanes, const float *expected) {
    float is[JOX_WIDTH];
    jf_store(is, lanes);
    for (int l = 0; l < JOX_WIDTH; l++)
        if (!isnan(is[l]) || !isnan(expected[l]))
            assert_int_equal(get_float_bits(is[l]), get_float_bits(expected[l]));
}
static void assert_ints(JoxInts lanes, const int32_t *expected) {
    uint32_t is[JOX_WIDTH];
    ji_store(is, lanes);
    for (int l = 0; l < JOX_WIDTH; l++)
        assert_int_equal((int32_t)is[l], expected[l]);
}

/* Assert that an operation on lanes equals the scalar expression `plain` in each lane. */
#define FLOATS_GIVE(lanes, plain)                                                                  \
    do {                                                                                           \
        float expected[JOX_WIDTH];                                                                 \
        for (int l = 0; l < JOX_WIDTH; l++) {                                                      \
            const float a = fa[l], b = fb[l];                                                      \
            (void)a, (void)b;                                                                      \
            expected[l] = plain;                                                                   \
        }                                                                                          \
        assert_floats(lanes, expected);                                                            \
    } while (0)
#define INTS_GIVE(lanes, plain)                                                                    \
    do {                                                                                           \
        int32_t expected[JOX_WIDTH];                                                               \
        for (int l = 0; l < JOX_WIDTH; l++) {                                                      \
            const float a = fa[l], b = fb[l];                                                      \
            const int32_t i = ia[l], j = ib[l];                                                    \
            (void)a, (void)b, (void)i, (void)j;                                                    \
            expected[l] = (int32_t)(plain);                                                        \
        }                                                                                          \
        assert_ints(lanes, expected);                                                              \
    } while (0)
#define MASK_IS(mask, plain)                                                                       \
    do {                                                                                           \
        uint32_t set = 0;                                                                          \
        for (int l = 0; l < JOX_WIDTH; l++) {                                                      \
            const float a = fa[l], b = fb[l];                                                      \
            const int32_t i = ia[l], j = ib[l];                                                    \
            (void)a, (void)b, (void)i, (void)j;                                                    \
            set |= (uint32_t)(plain) << l;                                                         \
        }                                                                                          \
        assert_int_equal(jm_bits(mask), set);                                                      \
    } while (0)

static void check_float_operations(const float *fa, const float *fb) {
    const int32_t ia[JOX_WIDTH] = {0}, ib[JOX_WIDTH] = {0};
    JoxFloats a_ = jf_load(fa), b_ = jf_load(fb);
    FLOATS_GIVE(a_ + b_, a + b);
    FLOATS_GIVE(a_ - b_, a - b);
    FLOATS_GIVE(a_ * b_, a * b);
    FLOATS_GIVE(a_ / b_, a / b);
    FLOATS_GIVE(jf_sqrt(a_), sqrtf(a));
    FLOATS_GIVE(-a_, -a);
    FLOATS_GIVE(jf_abs(a_), fabsf(a));
    FLOATS_GIVE(jf_min(a_, b_), a < b ? a : b);
    FLOATS_GIVE(jf_max(a_, b_), a > b ? a : b);
    FLOATS_GIVE(jf_select(jf_lt(a_, b_), a_, b_), a < b ? a : b);
    FLOATS_GIVE(ji_as_floats(jf_bits(a_)), a);
    FLOATS_GIVE(jf_next(a_), ((void)a, fa[l + 1 < JOX_WIDTH ? l + 1 : l]));
    const uint32_t back[JOX_WIDTH] = {3, 0, 0, 2};
    FLOATS_GIVE(jf_arrange(a_, ji_load(back)), ((void)a, fa[back[l]]));
    MASK_IS(jf_lt(a_, b_), a < b);
    MASK_IS(jf_le(a_, b_), a <= b);
    MASK_IS(jm_and(jf_le(a_, b_), jf_le(b_, a_)), a == b);
    MASK_IS(jm_or(jf_lt(a_, b_), jf_lt(b_, a_)), a < b || b < a);
    MASK_IS(jm_without(jf_le(a_, b_), jf_lt(a_, b_)), a == b);
    INTS_GIVE(jf_to_ints(a_), a >= -2147483648.0f && a < 2147483648.0f ? (int32_t)a : INT32_MIN);
    INTS_GIVE(jf_bits(a_), get_float_bits(a));
}

static void check_int_operations(const int32_t *ia, const int32_t *ib) {
    const float fa[JOX_WIDTH] = {0}, fb[JOX_WIDTH] = {0};
    JoxInts i_ = ji_load((const uint32_t *)ia), j_ = ji_load((const uint32_t *)ib);
    INTS_GIVE(ji_add(i_, j_), (uint32_t)i + (uint32_t)j);
    INTS_GIVE(ji_sub(i_, j_), (uint32_t)i - (uint32_t)j);
    INTS_GIVE(ji_and(i_, j_), i & j);
    INTS_GIVE(ji_or(i_, j_), i | j);
    INTS_GIVE(ji_shift_left(i_, 3), (uint32_t)i << 3);
    INTS_GIVE(ji_shift_right(i_, 5), (uint32_t)i >> 5);
    INTS_GIVE(ji_opaque(i_), i);
    INTS_GIVE(ji_select(ji_less(i_, j_), i_, j_), i < j ? i : j);
    MASK_IS(ji_less(i_, j_), i < j);
    MASK_IS(ji_equal(i_, j_), i == j);
    float expected[JOX_WIDTH];
    for (int l = 0; l < JOX_WIDTH; l++)
        expected[l] = (float)ia[l];
    assert_floats(ji_to_floats(i_), expected);
}

static void lanes_compute_as_plain_c(void **state) {
    (void)state;
    for (int k = 0; k < FLOAT_COUNT * FLOAT_COUNT; k++) {
        float a[JOX_WIDTH], b[JOX_WIDTH]; /* each pair is tested in each lane */
        for (int l = 0; l < JOX_WIDTH; l++) {
            int pair = (k + 7 * l) % (FLOAT_COUNT * FLOAT_COUNT);
            a[l] = FLOATS[pair / FLOAT_COUNT];
            b[l] = FLOATS[pair % FLOAT_COUNT];
        }
        check_float_operations(a, b);
    }
    for (int k = 0; k < INT_COUNT * INT_COUNT; k++) {
        int32_t a[JOX_WIDTH], b[JOX_WIDTH];
        for (int l = 0; l < JOX_WIDTH; l++) {
            int pair = (k + 5 * l) % (INT_COUNT * INT_COUNT);
            a[l] = INTS[pair / INT_COUNT];
            b[l] = INTS[pair % INT_COUNT];
        }
        check_int_operations(a, b);
    }
}

static void loads_and_picks_keep_lane_order(void **state) {
    (void)state;
    float records[40], expected[JOX_WIDTH];
    int32_t lane[JOX_WIDTH], table[10];
    uint32_t at[JOX_WIDTH];
    for (int k = 0; k < 40; k++)
        records[k] = (float)k + 0.5f;
    for (int k = 0; k < 10; k++)
        table[k] = 100 - k;
    for (int l = 0; l < JOX_WIDTH; l++) {
        lane[l] = l;
        at[l] = (uint32_t)((3 * l + 1) % 10);
    }
    assert_ints(ji_lane(), lane);
    JoxFloats out[4], out_at[4];
    jf_records(records, ji_load(at), out);
    jf_records_at(records, at, out_at);
    for (int c = 0; c < 4; c++) {
        for (int l = 0; l < JOX_WIDTH; l++)
            expected[l] = records[4 * at[l] + (uint32_t)c];
        assert_floats(out[c], expected);
        assert_floats(out_at[c], expected);
    }
    float lists[JOX_WIDTH * 7 + 4];
    for (int k = 0; k < JOX_WIDTH * 7 + 4; k++)
        lists[k] = (float)k - 3.25f;
    jf_fours(lists + 2, 7, out);
    for (int c = 0; c < 4; c++) {
        for (int l = 0; l < JOX_WIDTH; l++)
            expected[l] = lists[2 + 7 * l + c];
        assert_floats(out[c], expected);
    }
    const float *from[JOX_WIDTH];
    float *to[JOX_WIDTH], written[JOX_WIDTH][4];
    for (int l = 0; l < JOX_WIDTH; l++) {
        from[l] = records + 4 * at[l] + 1;
        to[l] = written[JOX_WIDTH - 1 - l];
    }
    jf_rows(from, out);
    jf_put_rows(to, out);
    for (int c = 0; c < 4; c++) {
        for (int l = 0; l < JOX_WIDTH; l++)
            expected[l] = from[l][c];
        assert_floats(out[c], expected);
        for (int l = 0; l < JOX_WIDTH; l++)
            assert_true(to[l][c] == from[l][c]);
    }
    for (int l = 0; l < JOX_WIDTH; l++) {
        expected[l] = records[at[l]];
        lane[l] = table[at[l]];
    }
    assert_floats(jf_pick(records, ji_load(at)), expected);
    assert_floats(jf_pick_at(records, at), expected);
    assert_ints(ji_pick((const uint32_t *)table, ji_load(at)), lane);
    for (int l = 0; l < JOX_WIDTH; l++)
        expected[l] = 2.5f;
    assert_floats(jf_set(2.5f), expected);
    for (uint32_t bits = 0; bits < 1u << JOX_WIDTH; bits++)
        assert_int_equal(jm_bits(jm_of_bits(bits)), bits);
}

static void bytes_keep_lane_order(void **state) {
    (void)state;
    uint8_t bytes[256], out[JOX_WIDTH];
    int32_t expected[JOX_WIDTH];
    for (int k = 0; k < 256; k++)
        bytes[k] = (uint8_t)(167 * k + 3); /* a permutation of all values */
    for (int k = 0; k + JOX_WIDTH <= 256; k++) {
        for (int l = 0; l < JOX_WIDTH; l++)
            expected[l] = bytes[k + l];
        assert_ints(ji_load_bytes(bytes + k), expected);
        const JoxInts high = ji_set((int32_t)0x8a7b0500); /* only the low byte is stored */
        ji_store_bytes(out, ji_or(ji_load_bytes(bytes + k), high));
        assert_memory_equal(out, bytes + k, JOX_WIDTH);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lanes_compute_as_plain_c),
        cmocka_unit_test(loads_and_picks_keep_lane_order),
        cmocka_unit_test(bytes_keep_lane_order),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
