/* Makes scenes from random bytes by the engine's table of keys: well-formed, and often valid. */
#ifndef JOSTLE_FUZZ_MAKE_SCENE_H
#define JOSTLE_FUZZ_MAKE_SCENE_H

#include <stddef.h>
#include <stdint.h>

#include "base/text.h"

/* A hall of FUZZ_HALL_X by FUZZ_HALL_Y metres from the origin, closed by walls without a name. */
enum { FUZZ_HALL_X = 20, FUZZ_HALL_Y = 10 };

/* Appends a scene, the same for the same bytes. */
void fuzz_make_scene(const uint8_t *data, size_t size, JoxText *out);

#endif
