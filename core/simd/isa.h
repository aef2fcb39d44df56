/* The instruction sets that kernels are compiled for, and which of them this machine runs. A world
   chooses one when it is created. */
#ifndef JOX_SIMD_ISA_H
#define JOX_SIMD_ISA_H

#include <stdbool.h>
#include <stddef.h>

#include "jostle.h"

/* Lists the instruction sets of this build as X(name, JoIsa), the narrowest first. */
#if defined __x86_64__
#define JOX_ISAS(X)                                                                                \
    X(scalar, JO_ISA_SCALAR)                                                                       \
    X(sse2, JO_ISA_SSE2) X(avx2, JO_ISA_AVX2) X(avx512, JO_ISA_AVX512)
#elif defined __aarch64__
#define JOX_ISAS(X) X(scalar, JO_ISA_SCALAR) X(neon, JO_ISA_NEON)
#elif defined __wasm_simd128__
#define JOX_ISAS(X) X(scalar, JO_ISA_SCALAR) X(wasm, JO_ISA_WASM)
#else
#define JOX_ISAS(X) X(scalar, JO_ISA_SCALAR)
#endif

/* Size of a table with an entry for each JoIsa; entries of sets that the build lacks stay NULL. */
enum { JOX_ISA_ROOM = JO_ISA_WASM + 1 };

/* Returns whether the build has kernels for it, and processor and system support it. */
bool jox_isa_runs(JoIsa isa);
/* Returns `isa`; for JO_ISA_WIDEST, the widest that runs. */
JoIsa jox_isa_resolve(JoIsa isa);
const char *jox_isa_name(JoIsa isa);
/* Returns the instruction set with a name; JO_ISA_WIDEST if there is none. */
JoIsa jox_isa_named(const char *name);
/* Writes the names of the instruction sets that run here, as "scalar, sse2". */
void jox_isa_list(char *text, size_t size);

#endif
