/* The kernel of agents' records, which contacts read; a lane is an agent. */
#include "agents/torso_lanes.h"
#include "force/stages/kernels.h"

void JOX_WIDE(jox_record_packets)(const JoxForces *f, uint32_t begin, uint32_t end) {
    const JoxAgents *a = f->step.agents;
    for (uint32_t i = begin; i < end; i += JOX_WIDTH) {
        const JoxFloats record[4] = {jf_load(a->contact_radius + i), jox_outer_lanes(a, i),
                                     jox_param_lanes(a, JOX_PARAM_mass, i),
                                     ji_as_floats(ji_load(a->id + i))};
        float *rows[JOX_WIDTH];
        JOX_UNROLL
        for (uint32_t lane = 0; lane < JOX_WIDTH; lane++)
            rows[lane] = &f->records[i + lane].radius;
        jf_put_rows(rows, record);
    }
}
