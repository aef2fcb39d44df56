/* Reads any bytes as a recording in text. */
#include "support/recording.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    fuzz_recording(fuzz_write("f.txt", data, size));
    return 0;
}
