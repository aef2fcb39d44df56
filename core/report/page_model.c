/* The facts on the model in the section on inputs of a run's page: how people walk, the step, what
   differs from defaults, what the command line set, mods, and the plan's size. */
#include <math.h>

#include "base/format/plurals.h"
#include "picture/html.h"
#include "report/page_inputs.h"
#include "run/orca_flow_note.h"
#include "run/run.h"

/* Appends the constants of the walking law that differ from their defaults. */
static void say_walking(const JoxWalkLaw *law, JoxText *out) {
    static const struct {
        const char *name;
        double value;
    } DEFAULTS[] = {
#define X(name, unit, least, greatest, value, meaning) {#name, value},
        JOX_WALK_CONSTANTS(X)
#undef X
    };
    const double used[] = {
#define X(name, unit, least, greatest, value, meaning) (double)law->name,
        JOX_WALK_CONSTANTS(X)
#undef X
    };
    for (size_t k = 0; k < sizeof used / sizeof *used; k++)
        if (fabs(used[k] - DEFAULTS[k].value) > 1e-6 * fabs(DEFAULTS[k].value))
            jox_text_printf(out, "%swalking.%s %.4g (default %.4g)", out->length ? ", " : "",
                            DEFAULTS[k].name, used[k], DEFAULTS[k].value);
}

/* Appends which groups choose velocities by the walking law, and which by ORCA. */
static void say_walk_kinds(const JoScene *scene, JoxText *out) {
    static const char *const LAWS[] = {"the walking law of Jostle (core/walking.md)", "ORCA"};
    const JoxSceneSpec *spec = scene->spec;
    for (int orca = 0; orca < 2; orca++) {
        uint32_t count = 0, told = 0;
        for (uint32_t g = 0; g < spec->group_count; g++)
            count += jox_run_group_walks_by(scene, g, orca);
        if (count == 0)
            continue;
        jox_text_printf(out, "%s%s: ", out->length ? "; " : "", LAWS[orca]);
        if (count == spec->group_count)
            jox_text_add(out, "all groups");
        for (uint32_t g = 0; g < spec->group_count && count < spec->group_count; g++)
            if (jox_run_group_walks_by(scene, g, orca))
                jox_text_printf(out, "%s%s", told++ ? ", " : "", spec->groups[g].name);
    }
    if (!out->length)
        jox_text_add(out, "nobody walks");
}

void jox_page_put_model(FILE *out, const JoScene *scene) {
    const JoxSceneSpec *spec = scene->spec;
    const JoWorldDef *def = &scene->world->model.def;
    JoxText other = {0}, sets = {0}, mods = {0}, plan = {0}, law = {0};
    char step[64];
    say_walking(&spec->walking, &other);
    if (fabs(spec->gravity - 9.81) > 1e-9)
        jox_text_printf(&other, "%sgravity %.4g m/s\xc2\xb2", other.length ? ", " : "",
                        spec->gravity);
    for (size_t k = 0; k < scene->def.override_count; k++)
        jox_text_printf(&sets, "%s%s", k ? "; " : "", scene->def.overrides[k]);
    for (uint32_t m = 0; m < scene->mods->count; m++)
        jox_text_printf(&mods, "%s%s %s", m ? ", " : "", scene->mods->items[m].name,
                        scene->mods->items[m].version);
    jox_text_noun(&plan, scene->world->model.all_walls.ring_count, "wall");
    jox_text_add(&plan, ", ");
    jox_text_noun(&plan, spec->place_count, "place");
    jox_text_add(&plan, ", ");
    jox_text_noun(&plan, spec->body_count, "body|bodies");
    if (spec->bounded)
        jox_text_printf(&plan, "; bounds (%.4g, %.4g) to (%.4g, %.4g) m%s", (double)spec->low.x,
                        (double)spec->low.y, (double)spec->high.x, (double)spec->high.y,
                        spec->periodic_x || spec->periodic_y ? ", periodic" : "");
    say_walk_kinds(scene, &law);
    jox_text_add(&law, !def->forces   ? "; no forces"
                       : def->literal ? "; forces by the equations as printed by Kim et al. 2014"
                                      : "; forces between people, walls and bodies");
    snprintf(step, sizeof step, "%g s%s", def->dt,
             spec->body_count ? "; rigid bodies (Bullet) at 1/60 s or less" : "");
    jox_html_facts(out);
    jox_html_fact(out, "Walking and forces", law.data);
    jox_html_fact(out, "Time step", step);
    jox_html_fact(out, "Differs from defaults", other.data ? other.data : "nothing");
    jox_html_fact(out, "Set for this run", sets.data ? sets.data : "nothing");
    jox_html_fact(out, "Mods", mods.data ? mods.data : "none");
    jox_html_fact(out, "Plan", plan.data);
    jox_html_fact(out, "Assumptions and sources", spec->report.notes);
    jox_html_table_end(out);
    jox_text_free(&other);
    jox_text_free(&sets);
    jox_text_free(&mods);
    jox_text_free(&plan);
    jox_text_free(&law);
}
