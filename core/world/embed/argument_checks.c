#include "world/embed/argument_checks.h"

#include "base/guard.h"

bool jox_argument_is_within(const char *field, const char *unit, double value, double least,
                            double greatest, JoError *error) {
    if (value >= least && value <= greatest)
        return true;
    jox_error(error, JO_INPUT, "%s must be from %g to %g %s, not %g", field, least, greatest, unit,
              value);
    return false;
}

bool jox_argument_is_one_of(const char *field, uint32_t value, uint32_t count, const char *values,
                            JoError *error) {
    if (value < count)
        return true;
    jox_error(error, JO_INPUT, "%s must be one of %s, not %d", field, values, (int)value);
    return false;
}
