#include "world/statistics.h"

#include <math.h>
#include <string.h>

#include "agents/torso.h"
#include "base/assert.h"

/* Returns the bin of a share of the range that the bins cover. */
static int find_bin(float share, int bins) {
    const int bin = (int)(share * (float)bins);
    return bin < bins ? bin : bins - 1;
}

/* Bins all agents by their deepest overlap with a neighbour, as a share of their depth, and those
   that overlap anyone by that overlap in metres. */
static void sample_overlaps(JoxStatistics *s, const JoxAgents *a, const JoxNeighbours *n) {
    for (uint32_t i = 0; i < a->count; i++) {
        float deepest = 0.0f;
        const float reach = 2.0f * n->widest;
        for (uint32_t k = 0; k < n->count[i]; k++) {
            uint32_t j = n->index[jox_neighbour_at(n, i, k)]; /* agents moved since */
            if (jox_length2(jox_offset(a, i, j)) < reach * reach)
                deepest = jox_maxf(deepest, -jox_torso_gap(a, i, j));
        }
        JOX_ASSERT(deepest >= 0.0f && a->contact_radius[i] > 0.0f);
        const float depth = 2.0f * jox_agent_torso(a, i, false).radius;
        s->overlap[find_bin(deepest / depth, JOX_OVERLAP_BINS)]++;
        if (deepest > 0.0f) {
            s->overlap_depth[find_bin(deepest / JOX_OVERLAP_DEPTH, JOX_OVERLAP_BINS)]++;
            s->overlapping++;
        }
    }
    s->overlap_samples += a->count;
}

/* Returns how many bytes have a bit set. */
static uint64_t count_bit(const uint8_t *bytes, uint32_t count, uint8_t bit) {
    const uint64_t bits = bit * UINT64_C(0x0101010101010101);
    uint64_t sum = 0;
    uint32_t i = 0;
    for (; i + 8 <= count; i += 8) {
        uint64_t eight;
        memcpy(&eight, bytes + i, sizeof eight);
        sum += (uint64_t)__builtin_popcountll(eight & bits);
    }
    for (; i < count; i++)
        sum += (bytes[i] & bit) != 0;
    return sum;
}

void jox_statistics_observe(JoxStatistics *s, const JoxAgents *a, const JoxNeighbours *n,
                            uint64_t tick, double dt) {
    const uint64_t failed = count_bit(a->failed, a->count, 1);
    JOX_ASSERT(failed <= a->count);
    s->steps++;
    s->agent_steps += a->count;
    s->failures += failed;
    s->turned_aside += count_bit(a->plan_notes, a->count, JOX_NOTE_TURNED_ASIDE);
    s->plans_bounded += count_bit(a->plan_notes, a->count, JOX_NOTE_BOUNDED);
    s->parts_left_out += count_bit(a->plan_notes, a->count, JOX_NOTE_PARTS_LEFT_OUT);
    s->second_failures += failed;
    s->second_agent_steps += a->count;
    uint64_t per_second = (uint64_t)(1.0 / dt + 0.5);
    if ((tick + 1) % per_second != 0)
        return;
    sample_overlaps(s, a, n);
    double share =
        s->second_agent_steps ? (double)s->second_failures / (double)s->second_agent_steps : 0.0;
    JOX_ASSERT(share >= 0.0 && share <= 1.0);
    s->failure_peak = share > s->failure_peak ? share : s->failure_peak;
    s->second_failures = s->second_agent_steps = 0;
}

/* Returns the 99th percentile of binned samples, as a share of the range of the bins. */
static double find_p99(const uint64_t *bins, uint64_t samples) {
    const uint64_t above = samples / 100;
    uint64_t sum = 0;
    if (samples == 0)
        return NAN;
    for (int bin = JOX_OVERLAP_BINS - 1; bin >= 0; bin--) {
        sum += bins[bin];
        if (sum > above)
            return (double)bin / JOX_OVERLAP_BINS;
    }
    return 0.0;
}

double jox_statistics_overlap_p99(const JoxStatistics *s) {
    return find_p99(s->overlap, s->overlap_samples);
}

double jox_statistics_depth_p99(const JoxStatistics *s) {
    if (s->overlap_samples > 0 && s->overlapping == 0)
        return 0.0;
    return (double)JOX_OVERLAP_DEPTH * find_p99(s->overlap_depth, s->overlapping);
}

double jox_statistics_overlap_share(const JoxStatistics *s, double over) {
    uint64_t sum = 0;
    for (int bin = (int)(over * JOX_OVERLAP_BINS + 0.5); bin < JOX_OVERLAP_BINS; bin++)
        sum += s->overlap[bin];
    return s->overlap_samples ? (double)sum / (double)s->overlap_samples : NAN;
}
