/* What people give bodies in a step, counted. */
#include <cstring>

#include "body/bullet.h"

void jox_row_count_impulse(JoxRow *r, const btVector3 &impulse, const btVector3 &arm) {
    const btVector3 turn = arm.cross(impulse);
    for (int i = 0; i < 3; i++) {
        r->given[i] += double(impulse[i]);
        r->given[3 + i] += double(turn[i]);
    }
}

bool jox_bodies_given(const JoxBodies *b, uint32_t row, double impulse[3], double turn[3]) {
    const JoxRow *r = jox_row_of(b, row);
    for (int i = 0; i < 3; i++) {
        impulse[i] = r ? r->given[i] : 0;
        turn[i] = r ? r->given[3 + i] : 0;
    }
    return r != nullptr;
}

void jox_bodies_count_impulses(JoxBodies *b) {
    for (uint32_t k = 0; k < b->live; k++)
        memset(b->rows[b->order[k]].given, 0, sizeof b->rows[0].given);
}
