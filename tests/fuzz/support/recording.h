#ifndef JOSTLE_FUZZ_RECORDING_H
#define JOSTLE_FUZZ_RECORDING_H

#include "fuzz.h"

/* Reads a recording in every way, and checks that what comes out is whole. */
void fuzz_recording(const char *path);

#endif
