/* Reads any bytes as an input log; entries that are read must be equal after writing and
   reading. */
#include <stdlib.h>
#include <string.h>

#include "support/fuzz.h"
#include "world/input/input_entries.h"

/* Writes an entry, and reads and writes it again. */
static void read_back(const JoxInputEntry *entry) {
    JoxInputLog log = {0};
    JoxDiagnostics diagnostics = {0};
    JoxText first = {0}, second = {0};
    jox_input_write(entry, &first);
    FUZZ_CHECK(jox_input_parse(&log, "again", first.data, first.length, &diagnostics));
    FUZZ_CHECK(log.count == 1);
    jox_input_write(&log.entries[0], &second);
    FUZZ_CHECK(first.length == second.length && !memcmp(first.data, second.data, first.length));
    jox_text_free(&first);
    jox_text_free(&second);
    jox_input_free(&log);
    jox_diag_free(&diagnostics);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    JoxInputLog log = {0};
    JoxDiagnostics diagnostics = {0};
    char *text = fuzz_text(data, size);
    const bool good = jox_input_parse(&log, "fuzz.input", text, size, &diagnostics);
    FUZZ_CHECK(good == (diagnostics.errors == 0));
    for (size_t e = 0; good && e < log.count && e < 100; e++)
        read_back(&log.entries[e]);
    jox_input_free(&log);
    fuzz_end_diagnostics(&diagnostics);
    free(text);
    return 0;
}
