#include "body/body.h"

JoxBodyDef jox_body_def(void) {
    return (JoxBodyDef){.shape = {.kind = JOX_SHAPE_BOX, .size = {1, 1, 1}},
                        .mass = 10,
                        .friction = 0.6,
                        .force_limit = JOX_DRIVE_FORCE};
}

JoxBodiesDef jox_bodies_def(void) {
    return (JoxBodiesDef){.gravity = 9.81,
                          .ground = true,
                          .kill_height = -50,
                          .most_change = 500,
                          .person_height = 1.75,
                          .person_hardness = 0.5};
}
