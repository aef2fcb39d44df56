/* Reads any bytes as a recording in SQLite or text: by frames, as a whole, and its plan. */
#include "support/recording.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    fuzz_recording(fuzz_write("f.sqlite", data, size));
    return 0;
}
