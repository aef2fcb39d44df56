/* Public call of jostle_host.h: sets the allocator of a program. */
#include "base/assert.h"
#include "base/guard.h"
#include "base/mem.h"
#include "jostle_host.h"

bool jo_set_allocator(const JoAllocator *allocator, JoError *error) {
    JOX_REQUIRE(!allocator || (allocator->allocate && allocator->reallocate && allocator->release),
                false);
    if (jox_set_allocator(allocator))
        return true;
    jox_error(error, JO_USAGE,
              "an allocator is set before all else: memory has been allocated already");
    return false;
}
