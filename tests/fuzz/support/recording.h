#ifndef JOSTLE_FUZZ_RECORDING_H
#define JOSTLE_FUZZ_RECORDING_H

#include "fuzz.h"

/* Reads a recording in every way, and checks the result. */
void fuzz_recording(const char *path);

#endif
