/* The two signs that a simulation is denser than people can be, and their sentence for users. */
#include "record/danger/trust.h"

#include "record/fields/density.h"

bool jox_trust_holds(double overlap_p99, double density_max) {
    return !(overlap_p99 > JOX_TRUST_OVERLAP) && !(density_max > JOX_TRUST_DENSITY);
}

void jox_trust_append_signs(double overlap_p99, double depth_p99, double density_max,
                            JoxText *out) {
    const bool deep = overlap_p99 > JOX_TRUST_OVERLAP, dense = density_max > JOX_TRUST_DENSITY;
    if (!deep && !dense)
        return;
    jox_text_add(out, "Loads and densities are not to be trusted where it is dense: ");
    if (deep)
        jox_text_printf(out,
                        "bodies overlap by %.0f %% of their depth (99th percentile; real ones by "
                        "less than %.0f %%), those that touch by %.0f mm%s",
                        100.0 * overlap_p99, 100.0 * JOX_TRUST_OVERLAP, 1e3 * depth_p99,
                        dense ? ", and " : "");
    if (dense)
        jox_text_printf(out,
                        "the density " JOX_DENSITY_BY
                        " reached %.1f per m\xc2\xb2, and the densest "
                        "crowds known about %.0f",
                        density_max, JOX_TRUST_DENSITY);
    jox_text_add(out, ".");
}
