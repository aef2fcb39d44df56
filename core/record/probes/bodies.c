/* Probe `bodies`: how far each body that can be pushed has moved, turned about the vertical axis,
   and tilted, since it was first seen; at the end, and at most. Bodies that are fixed or driven are
   left out. */
#include <math.h>

#include "base/mem.h"
#include "base/number/rotation.h"
#include "record/probes/probe_parts.h"
#include "record/storey_figures.h"

static const float TURNED = 10.0f;  /* degrees: turns beyond this count */
static const float TOPPLED = 45.0f; /* degrees: tilts beyond this count as toppled */

typedef struct Body {
    uint32_t known; /* 0 or 1 */
    JoxV3 from, at; /* m: centre of mass, at first and now */
    float first_turn[4];
    float peak;         /* m: greatest distance from `from` in the plane */
    float turned, tilt; /* degrees, now */
    float peak_tilt;    /* degrees */
} Body;

typedef struct Bodies {
    Body *bodies; /* by id of the body */
    uint32_t capacity;
    char **names; /* by id; NULL: none */
    uint32_t name_count, name_capacity;
} Bodies;

static float measure_distance(const Body *b) {
    return jox_length(jox_v2(b->at.x - b->from.x, b->at.y - b->from.y));
}

/* Keeps a copy of a body's name when it is first seen: the body may be gone at the end. */
static void keep_name(Bodies *s, const JoxObject *object) {
    JOX_RESERVE(s->names, s->name_capacity, object->id + 1);
    while (s->name_count <= object->id)
        s->names[s->name_count++] = NULL;
    if (object->name && object->name[0])
        s->names[object->id] = jox_strdup(object->name);
}

static void take_bodies_frame(const JoxProbeDef *def, void *state, const JoxFrame *frame,
                              const uint8_t *seen) {
    Bodies *s = state;
    (void)def, (void)seen;
    for (uint32_t o = 0; frame->objects && o < frame->objects->count; o++) {
        const JoxObject *object = &frame->objects->rows[o];
        if (!object->live || !object->moves)
            continue;
        JOX_RESERVE_ZEROED(s->bodies, s->capacity, object->id + 1);
        Body *b = &s->bodies[object->id];
        if (!b->known) {
            *b = (Body){.known = 1, .from = object->position};
            for (int k = 0; k < 4; k++)
                b->first_turn[k] = object->turn[k];
            keep_name(s, object);
        }
        b->at = object->position;
        b->peak = jox_maxf(b->peak, measure_distance(b));
        const JoxTurnAndTilt since = jox_split_rotation(b->first_turn, object->turn);
        b->turned = (float)since.turned;
        b->tilt = (float)since.tilt;
        b->peak_tilt = jox_maxf(b->peak_tilt, b->tilt);
    }
}

static void add_bodies_figures(const JoxProbeDef *def, const void *state, JoxFigures *out) {
    const Bodies *s = state;
    uint32_t count = 0, moved = 0, turned = 0, toppled = 0;
    double sum = 0.0, greatest = NAN;
    for (uint32_t k = 0; k < s->capacity; k++) {
        const Body *b = &s->bodies[k];
        if (!b->known)
            continue;
        const double distance = (double)measure_distance(b);
        count++;
        sum += distance;
        greatest = fmax(greatest, distance);
        moved += distance > def->onset;
        turned += fabsf(b->turned) > TURNED;
        toppled += b->tilt > TOPPLED;
    }
    static const char *const WHY = "not known: there was no body, or a recording that has none";
    jox_figure_add(out, "bodies", "bodies", "", count);
    jox_figure_add(out, "moved", "bodies farther from their first place than the onset", "", moved);
    jox_figure_add(out, "turned", "bodies turned by more than 10 degrees", "", turned);
    jox_figure_add(out, "toppled", "bodies tilted by more than 45 degrees", "", toppled);
    jox_figure_add(out, "mean", "mean displacement at the end", "m", count ? sum / count : NAN);
    jox_figure_set_reason(out, WHY);
    jox_figure_add(out, "greatest", "greatest displacement at the end", "m", greatest);
    jox_figure_set_reason(out, WHY);
}

static void list_bodies_sections(void *state, JoxSections *sections) {
    Bodies *s = state;
    JOX_SECTION_ROOM(sections, "bodies", s->bodies, s->capacity);
    const uint32_t names = (uint32_t)jox_section_count(sections, "names", s->name_count, 1);
    while (s->name_count < names) { /* when restoring: the names follow below */
        JOX_RESERVE(s->names, s->name_capacity, s->name_count + 1);
        s->names[s->name_count++] = NULL;
    }
    for (uint32_t n = 0; n < s->name_count; n++)
        jox_section_string(sections, "name", &s->names[n]);
}

static void write_bodies_csv(const JoxProbeDef *def, const void *state, FILE *out) {
    const Bodies *s = state;
    fputs("body,name,x [m],y [m],z [m],dx [m],dy [m],dz [m],moved [m],peak [m],turned [deg],"
          "tilt [deg],peak_tilt [deg]",
          out);
    jox_csv_put_storey_title(out, def->storeys);
    fputc('\n', out);
    for (uint32_t k = 0; k < s->capacity; k++) {
        const Body *b = &s->bodies[k];
        if (!b->known)
            continue;
        const JoxV2 at = {b->from.x, b->from.y}, plan = jox_in_plan(def->storeys, at);
        fprintf(out, "%u,%s,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f,%.2f,%.2f,%.2f", k,
                k < s->name_count && s->names[k] ? s->names[k] : "", (double)plan.x, (double)plan.y,
                (double)b->from.z, (double)(b->at.x - b->from.x), (double)(b->at.y - b->from.y),
                (double)(b->at.z - b->from.z), (double)measure_distance(b), (double)b->peak,
                (double)b->turned, (double)b->tilt, (double)b->peak_tilt);
        jox_csv_put_storey(out, def->storeys, at, true);
        fputc('\n', out);
    }
}

static void plot_bodies(const JoxProbeDef *def, const void *state, bool walls, JoxText *out) {
    const Bodies *s = state;
    double most = NAN;
    (void)def;
    for (uint32_t k = 0; k < s->capacity; k++)
        most = s->bodies[k].known ? fmax(most, (double)measure_distance(&s->bodies[k])) : most;
    if (isnan(most)) {
        jox_plot_reason(out, "no body was seen");
        return;
    }
    jox_text_printf(out,
                    "set size ratio -1\nset xlabel 'x (m)'\nset ylabel 'y (m)'\nunset key\n"
                    "set cblabel 'distance from where first seen (m)'\nset cbrange [0:%g]\nplot ",
                    most > 0.0 ? most : 1.0);
    if (walls)
        jox_text_add(out, "'walls.dat' using 1:2 with lines lw 2 lc 'black', ");
    jox_text_add(out, "csv skip 1 using 3:4 with points pt 4 ps 0.8 lc '#888888', "
                      "'' skip 1 using 3:4:6:7:9 with vectors head filled size graph 0.012,20 "
                      "lw 1.5 lc palette\n");
}

static void free_body_names(void *state) {
    Bodies *s = state;
    for (uint32_t n = 0; n < s->name_count; n++)
        jox_free(s->names[n]);
}

const JoxProbeCalls jox_probe_bodies = {
    JOX_PROBE_KIND(Bodies, bodies, 1000, 800),
    .frame = take_bodies_frame,
    .pace = JOX_PACE_TENTH,
    .owned = {JOX_OWNED(Bodies, bodies), JOX_OWNED(Bodies, names)},
    .release = free_body_names,
};
