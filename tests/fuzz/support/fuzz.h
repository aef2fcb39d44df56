/* What the fuzz targets share. A target is a file of tests/fuzz with LLVMFuzzerTestOneInput;
   libFuzzer drives it (`make fuzz`), or replay.c, with inputs that are there already. */
#ifndef JOSTLE_FUZZ_H
#define JOSTLE_FUZZ_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "../../messages.h"
#include "base/format/diag.h"
#include "jostle_tools.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* A finding: says what did not hold, and aborts. */
#define FUZZ_CHECK(condition) ((condition) ? (void)0 : fuzz_failed(#condition, __FILE__, __LINE__))
__attribute__((noreturn)) void fuzz_failed(const char *condition, const char *file, int line);

/* A copy with a zero behind it, to be freed by free(). */
char *fuzz_text(const uint8_t *data, size_t size);
/* Writes a file into the temporary folder of this process, where NAME may have folders; its path
   holds until the next call but three. The folder is removed at the end. */
const char *fuzz_write(const char *name, const void *data, size_t size);
const char *fuzz_path(const char *name);
/* Prints the errors as text and as JSON, checks that each says something, and frees them. */
void fuzz_end_diagnostics(JoxDiagnostics *diagnostics);
/* A scene of `path` that says nothing; steps it so many times, asks for its figures, frees it.
   NULL is fine. */
JoScene *fuzz_load(const char *path, const char *text, uint32_t threads);
void fuzz_run(JoScene *scene, int steps);

/* The server of pages, one for all inputs: to open a port takes longer than to run a scene. */
struct JoxView *fuzz_server(void);

#endif
