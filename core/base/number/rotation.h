/* Rotations of bodies, as quaternions x, y, z, w. */
#ifndef JOX_BASE_ROTATION_H
#define JOX_BASE_ROTATION_H

/* A rotation as a turn about the vertical followed by a tilt, degrees. */
typedef struct JoxTurnAndTilt {
    double turned; /* anti-clockwise, -180 to 180 */
    double tilt;   /* angle between the axis that was vertical and the vertical, 0 to 180 */
} JoxTurnAndTilt;

/* Splits the rotation that leads from the orientation `from` to the orientation `to`. */
JoxTurnAndTilt jox_split_rotation(const float from[4], const float to[4]);

#endif
