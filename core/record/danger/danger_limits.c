/* Published limits, the dose of load, and the figures of danger in summaries. */
#include <math.h>
#include <stdio.h>

#include "base/number/elementary.h"
#include "record/danger/danger_parts.h"
#include "record/storey_figures.h"

const char *const jox_danger_names[] = {"density", "pressure", "compression",
                                        "load",    "dose",     "voronoi"};
const char *const jox_danger_titles[] = {
    ("density " JOX_DENSITY_BY), "crowd pressure", "compression",
    "load from one side",        "dose of load",   "Voronoi density of a person (cell within 1 m)"};
const char *const jox_danger_units[] = {"1/m2", "1/s2", "N/m", "N", "", "1/m2"};

const JoxDangerLimit jox_danger_limits[JOX_DANGER_LIMITS] = {
    {"density_5", "density of 5 per m\xc2\xb2 " JOX_DENSITY_BY, JOX_DANGER_DENSITY, 5.0,
     "anything more crowded can become dangerous; dangerous crowd forces begin at 5.55",
     "G. K. Still, in the press, 30 October 2022; Fruin, in Wirz et al., EPJ Data Science 2, 5, "
     "2013"},
    {"density_7", "density of 7 per m\xc2\xb2 " JOX_DENSITY_BY, JOX_DANGER_DENSITY, 7.0,
     "the crowd becomes almost a fluid mass; shock waves run through it",
     "J. J. Fruin, The causes and prevention of crowd disasters, 1993"},
    {"voronoi_5", "Voronoi density of 5 per m\xc2\xb2", JOX_DANGER_VORONOI, 5.0,
     "the same limit for the space of single people: values scatter more and are higher",
     "as for a density of 5; cells as in Steffen and Seyfried, Physica A 389, 1902, 2010"},
    {"voronoi_7", "Voronoi density of 7 per m\xc2\xb2", JOX_DANGER_VORONOI, 7.0,
     "the same limit for the space of single people",
     "as for a density of 7; cells as in Steffen and Seyfried, Physica A 389, 1902, 2010"},
    {"pressure_002", "crowd pressure of 0.02 per s\xc2\xb2", JOX_DANGER_PRESSURE, 0.02,
     "crowd turbulence sets in", "Helbing, Johansson, Al-Abideen, Phys. Rev. E 75, 046109, 2007"},
    /* Men pushed against a flat bar 100 mm wide; 800 N where they could brace themselves. */
    {"load_623", "load of 623 N", JOX_DANGER_LOAD, 623.0,
     "the most that men bore for a short time against a bar 100 mm wide; women bore less",
     "Evans and Hayden 1971, in Lee and Hughes, Accid. Anal. Prev. 38, 2006, 712-722"},
    {"load_1112", "load of 1112 N", JOX_DANGER_LOAD, JOX_DOSE_LOW,
     "death estimated within 4 to 6 minutes",
     "Hopkins et al. 1993, in Lee and Hughes, Accid. Anal. Prev. 38, 2006, 712-722"},
    {"load_6227", "load of 6227 N", JOX_DANGER_LOAD, JOX_DOSE_HIGH,
     "death estimated within 15 seconds",
     "Hopkins et al. 1993, in Lee and Hughes, Accid. Anal. Prev. 38, 2006, 712-722"},
    {"dose_1", "dose of load of 1", JOX_DANGER_DOSE, 1.0,
     "the load lasted until the estimated time of death",
     "our interpolation between the two estimates of Hopkins et al. 1993"},
};

double jox_danger_lowest_limit(JoxDangerMeasure measure) {
    double least = NAN;
    for (int l = 0; l < JOX_DANGER_LIMITS; l++)
        if (jox_danger_limits[l].measure == measure)
            least = fmin(least, jox_danger_limits[l].value);
    return least;
}

const char jox_danger_dose_text[] =
    "Dose of load is the sum over time of dt / t(F), where t is the time after which death is "
    "estimated at the load F. Two such times are published, 1112 N for 5 minutes (the middle of 4 "
    "to 6) and 6227 N for 15 s; between them the power law t = 300 s (1112 N / F)^1.739 through "
    "both is our interpolation, not a measurement. Below 1112 N nothing is known but that men "
    "held 623 N for a short time, and women less. The cautious reading is taken: the same law is "
    "extended below 1112 N without limit (14 minutes at 623 N, 49 at 300 N) and above 6227 N, and "
    "no recovery is assumed.";

double jox_danger_dose_rate(double load) {
    /* ln(300 s / 15 s) / ln(6227 N / 1112 N). Below 1 N, where a dose of 1 would take two years,
       the dose is 0. */
    static const double EXPONENT = 1.738939;
    return load < 1.0 ? 0.0 : jox_pow(load / JOX_DOSE_LOW, EXPONENT) / 300.0;
}

/* ---- figures ---- */

double jox_danger_minutes_since(const JoxDanger *d, double first) {
    return isfinite(first) ? (d->last_frame - first) / 60.0 : NAN;
}

JoxDangerCount jox_danger_count(const JoxDanger *d, int limit) {
    return d->counts[limit];
}

JoxDangerMost jox_danger_most(const JoxDanger *d, JoxDangerMeasure measure) {
    JoxDangerMost most = d->most[measure];
    bool read = d->samples > 0;
    if (measure == JOX_DANGER_PRESSURE)
        read = isfinite(most.value); /* measured in some cell at some time */
    else if (measure == JOX_DANGER_COMPRESSION)
        read = d->has_compression;
    else if (measure == JOX_DANGER_LOAD || measure == JOX_DANGER_DOSE)
        read = d->has_load;
    else if (measure == JOX_DANGER_VORONOI)
        read = false;              /* unmeasured in sparse crowds */
    if (isnan(most.value) && read) /* for example, nobody was pressed */
        most.value = 0.0;
    return most;
}

bool jox_danger_has_measure(const JoxDanger *d, JoxDangerMeasure measure) {
    if (measure == JOX_DANGER_VORONOI) /* nobody is over a limit where it is not measured */
        return d->samples > 0;
    return isfinite(jox_danger_most(d, measure).value);
}

/* Writes "NAMESUFFIX": VALUE. */
static void write_suffixed_number(JoxJson *json, const char *name, const char *suffix,
                                  double value) {
    char key[64];
    snprintf(key, sizeof key, "%s%s", name, suffix);
    jox_json_number(json, key, value);
}

void jox_danger_json(const JoxDanger *d, JoxJson *json) {
    const JoxStoreys *storeys = jox_density_storeys_of(d->local->grid);
    char prefix[64];
    jox_json_whole(json, "samples", d->samples);
    for (int m = 0; m < JOX_DANGER_MEASURES; m++) {
        JoxDangerMost most = jox_danger_most(d, (JoxDangerMeasure)m);
        bool read = isfinite(most.time);
        write_suffixed_number(json, jox_danger_names[m], "_max", most.value);
        write_suffixed_number(json, jox_danger_names[m], "_max_s", most.time);
        snprintf(prefix, sizeof prefix, "%s_max_", jox_danger_names[m]);
        jox_json_add_position(json, prefix, storeys, most.at, read);
        if (m >= JOX_DANGER_FIRST_BORNE)
            write_suffixed_number(json, jox_danger_names[m], "_max_person",
                                  read ? most.person : NAN);
    }
    jox_json_object(json, "limits");
    for (int l = 0; l < JOX_DANGER_LIMITS; l++) {
        const JoxDangerCount *count = &d->counts[l];
        bool seen = isfinite(count->first);
        bool read = jox_danger_has_measure(d, jox_danger_limits[l].measure);
        jox_json_object(json, jox_danger_limits[l].key);
        jox_json_number(json, "people", read ? count->people : NAN);
        jox_json_number(json, "limit", jox_danger_limits[l].value);
        jox_json_number(json, "person_s", read ? count->person_s : NAN);
        jox_json_number(json, "longest_s", read ? count->longest : NAN);
        jox_json_number(json, "first_s", count->first);
        jox_json_add_position(json, "first_", storeys, count->first_at, seen);
        jox_json_number(json, "since_min", jox_danger_minutes_since(d, count->first));
        jox_json_end(json);
    }
    jox_json_end(json);
    jox_json_object(json, "level_person_s"); /* person-seconds at Fruin's levels for queues */
    for (int k = 0; k < JOX_LEVELS; k++)
        jox_json_number(json, jox_levels[k].name, d->level_s[k]);
    jox_json_end(json);
    jox_leaving_json(&d->leaving, json);
    jox_congestion_json(&d->congestion, d->local->grid, json);
    jox_danger_areas_json(&d->areas, json);
    jox_danger_lines_json(&d->lines, d->congestion.begun, d->last_frame, json);
    jox_danger_walls_json(&d->walls, storeys, d->last_frame, json);
    jox_danger_stairs_json(&d->stairs, storeys, json);
}
