/* Pi, for angles in radians. Cast to float where floats are computed. */
#ifndef JOX_BASE_PI_H
#define JOX_BASE_PI_H

#define JOX_PI 3.14159265358979323846
#define JOX_TURN (2.0 * JOX_PI)     /* a full turn, rad */
#define JOX_DEGREE (JOX_PI / 180.0) /* rad */

#endif
