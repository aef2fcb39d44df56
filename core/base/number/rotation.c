#include "base/number/rotation.h"

#include <math.h>

#include "base/number/elementary.h"
#include "base/number/pi.h"

JoxTurnAndTilt jox_split_rotation(const float from[4], const float to[4]) {
    const float *f = from; /* the rotation is to * from^-1 */
    const double x =
        (double)to[0] * f[3] - (double)to[3] * f[0] - (double)to[1] * f[2] + (double)to[2] * f[1];
    const double y =
        (double)to[1] * f[3] - (double)to[3] * f[1] - (double)to[2] * f[0] + (double)to[0] * f[2];
    const double z =
        (double)to[2] * f[3] - (double)to[3] * f[2] - (double)to[0] * f[1] + (double)to[1] * f[0];
    const double w =
        (double)to[3] * f[3] + (double)to[0] * f[0] + (double)to[1] * f[1] + (double)to[2] * f[2];
    const double upright = sqrt(z * z + w * w), tilted = sqrt(x * x + y * y);
    double turned = upright > 0.0 ? 2.0 * jox_atan2(z, w) : 0.0;
    turned -= JOX_TURN * floor(turned / JOX_TURN + 0.5);
    return (JoxTurnAndTilt){turned / JOX_DEGREE, 2.0 * jox_atan2(tilted, upright) / JOX_DEGREE};
}
