/* Edits a state that was saved as sections (base/sections.h), and corrects its checksum. An edit
   changes a number, copies a cell over another, or makes a list longer or shorter. */
#ifndef JOSTLE_FUZZ_EDITS_H
#define JOSTLE_FUZZ_EDITS_H

#include "base/sections.h"

/* Visits the sections that the state was saved from; called if FUZZ_SHOW is set, to name the edited
   section. */
typedef void FuzzWalk(void *context, JoxSections *sections);

/* Applies edits, of 16 bytes each. */
void fuzz_edit(JoxText *state, const uint8_t *data, size_t size, FuzzWalk *walk, void *context);

#endif
