#include "simd/isa.h"

#include <stdio.h>
#include <string.h>

static const struct {
    JoIsa isa;
    const char *name;
} ALL[] = {{JO_ISA_SCALAR, "scalar"}, {JO_ISA_SSE2, "sse2"}, {JO_ISA_AVX2, "avx2"},
           {JO_ISA_AVX512, "avx512"}, {JO_ISA_NEON, "neon"}, {JO_ISA_WASM, "wasm"}};
enum { COUNT = sizeof ALL / sizeof *ALL };

bool jox_isa_runs(JoIsa isa) {
    switch (isa) {
    case JO_ISA_SCALAR:
        return true;
#if defined __x86_64__ /* also tests whether the system saves the registers */
    case JO_ISA_SSE2:
        return true;
    case JO_ISA_AVX2:
        return __builtin_cpu_supports("avx2");
    case JO_ISA_AVX512:
        return __builtin_cpu_supports("avx512f");
#elif defined __aarch64__
    case JO_ISA_NEON:
        return true;
#elif defined __wasm_simd128__
    case JO_ISA_WASM:
        return true;
#endif
    default:
        return false;
    }
}

JoIsa jox_isa_resolve(JoIsa isa) {
    JoIsa widest = JO_ISA_SCALAR;
    for (int k = 0; k < COUNT; k++)
        if (jox_isa_runs(ALL[k].isa))
            widest = ALL[k].isa;
    return isa == JO_ISA_WIDEST ? widest : isa;
}

const char *jox_isa_name(JoIsa isa) {
    for (int k = 0; k < COUNT; k++)
        if (ALL[k].isa == isa)
            return ALL[k].name;
    return isa == JO_ISA_WIDEST ? "widest" : "unknown";
}

JoIsa jox_isa_named(const char *name) {
    for (int k = 0; k < COUNT; k++)
        if (strcmp(ALL[k].name, name) == 0)
            return ALL[k].isa;
    return JO_ISA_WIDEST;
}

void jox_isa_list(char *text, size_t size) {
    size_t used = 0;
    text[0] = '\0';
    for (int k = 0; k < COUNT; k++)
        if (jox_isa_runs(ALL[k].isa) && used < size)
            used +=
                (size_t)snprintf(text + used, size - used, "%s%s", used ? ", " : "", ALL[k].name);
}
