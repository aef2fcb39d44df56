/* Any bytes as a recording, SQLite or text: read frame by frame, read whole, and for its plan. */

#include "support/recording.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    fuzz_recording(fuzz_write("f.sqlite", data, size));
    return 0;
}
