/* Functions that the fuzz targets share. A target is a file of tests/fuzz with
   LLVMFuzzerTestOneInput, which libFuzzer calls (`make fuzz`), or replay.c, with known inputs. */
#ifndef JOSTLE_FUZZ_H
#define JOSTLE_FUZZ_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "../../messages.h"
#include "base/format/diag.h"
#include "jostle_tools.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* Prints a condition that does not hold, and aborts: a finding. */
#define FUZZ_CHECK(condition) ((condition) ? (void)0 : fuzz_failed(#condition, __FILE__, __LINE__))
__attribute__((noreturn)) void fuzz_failed(const char *condition, const char *file, int line);

/* Returns a copy with a zero at its end, to be freed by free(). */
char *fuzz_text(const uint8_t *data, size_t size);
/* Writes a file, NAME or FOLDER/NAME, into the temporary folder of this process, which is removed
   at the end. Returned paths are valid until the fourth call after. */
const char *fuzz_write(const char *name, const void *data, size_t size);
const char *fuzz_path(const char *name);
/* Prints the errors as text and as JSON, checks that each says something, and frees them. */
void fuzz_end_diagnostics(JoxDiagnostics *diagnostics);
/* Loads a scene that prints nothing, from a text or (NULL) a file; NULL if it has errors. */
JoScene *fuzz_load(const char *path, const char *text, uint32_t threads);
/* Runs a scene, or NULL, for some steps, asks for its summary, and frees it. */
void fuzz_run(JoScene *scene, int steps);

/* Returns the server of live pages, one for all inputs, since opening a port takes longer than a
 * run. */
struct JoxView *fuzz_server(void);

#endif
