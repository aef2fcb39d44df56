/* Edits of what was saved as sections (base/sections.h), with a checksum that is right: a number
   becomes another, a cell that of its neighbour, a list longer or shorter. */
#ifndef JOSTLE_FUZZ_EDITS_H
#define JOSTLE_FUZZ_EDITS_H

#include "base/sections.h"

/* Walks over the sections; called with FUZZ_SHOW=1, to print what each edit changes. */
typedef void FuzzWalk(void *context, JoxSections *sections);

/* By bytes, 16 for each edit. */
void fuzz_edit(JoxText *state, const uint8_t *data, size_t size, FuzzWalk *walk, void *context);

#endif
