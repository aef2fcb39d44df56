/* Checks of arguments that public calls share. Each returns false with an error that names the
   field and what it may be. */
#ifndef JOX_WORLD_ARGUMENT_CHECKS_H
#define JOX_WORLD_ARGUMENT_CHECKS_H

#include "jostle.h"

/* Checks that a value is in a range; NaN is in none. `unit` is for the message. */
bool jox_argument_is_within(const char *field, const char *unit, double value, double least,
                            double greatest, JoError *error);
/* Checks that a value is one of an enumeration of `count` from 0 on, whose names are in `values`.
 */
bool jox_argument_is_one_of(const char *field, uint32_t value, uint32_t count, const char *values,
                            JoError *error);

#endif
