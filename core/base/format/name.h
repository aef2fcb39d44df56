/* What names may look like that people give: of groups, places, regions, states, teams, tags,
   probes, bodies and walls. They appear in files, pictures and pages. */
#ifndef JOX_BASE_FORMAT_NAME_H
#define JOX_BASE_FORMAT_NAME_H

#include <stdbool.h>

/* Letters and marks of any script, digits, spaces, '_', '-' and '.', from 1 to 100 bytes of UTF-8;
   no space, '-' or '.' at the beginning, no space at the end. */
bool jox_name_is_plain(const char *name);
/* The same for people. */
#define JOX_NAME_RULE                                                                              \
    "Letters, digits, spaces, _ - and . are allowed (not a space, - or . at the beginning)"

#endif
