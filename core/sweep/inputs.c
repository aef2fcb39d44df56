#include "sweep/inputs.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "base/clock.h"
#include "base/guard.h"
#include "run/messages.h"
#include "run/read_scene.h"

/* Variants refused for the same reason until reading stops, if none has loaded */
enum { MOST_ALIKE = 20 };

JoSceneDef jox_sweep_scene_def(const JoSweepDef *def, const JoxSweepVariant *variant,
                               uint64_t seed) {
    JoSceneDef scene = def->scene;
    const char **sets = jox_alloc(scene.override_count + variant->set_count + 1, sizeof *sets);
    for (size_t o = 0; o < scene.override_count; o++)
        sets[o] = scene.overrides[o];
    for (uint32_t k = 0; k < variant->set_count; k++)
        sets[scene.override_count + k] = variant->sets[k];
    scene.overrides = sets;
    scene.override_count += variant->set_count;
    scene.seed = seed;
    scene.has_seed = true;
    scene.threads = scene.threads ? scene.threads : 1;
    return scene;
}

/* Asks the def's `vet` whether the scene may be loaded; without one, it may. */
static bool is_vetted(const JoSweepDef *def, const JoSceneDef *scene, JoError *error) {
    const JoxOutside outside = jox_guard_leave();
    const bool good = !def->vet || def->vet(def->vet_context, scene, error);
    jox_guard_return(outside);
    return good;
}

static void add_load_message(void *context, const char *text) {
    jox_text_add(context, text);
}

/* Loads a scene without placing people, and adds all texts that it read to `files`. Messages are
   passed on only if loading fails. */
static bool load_dry(const JoSweepDef *def, const JoSceneDef *vetted, JoxOverlay *files,
                     JoError *error) {
    JoSceneDef dry = *vetted;
    JoxText said = {0};
    dry.dry = true;
    dry.resumable = true; /* so that the scene keeps its texts */
    dry.message = add_load_message;
    dry.message_context = &said;
    JoScene *scene = jo_scene_load(&dry, error);
    const bool good = scene != NULL;
    if (good)
        jox_run_collect_texts(scene, files);
    jo_scene_free(scene);
    if (!good && said.data)
        jox_run_send_message(def->message, def->message_context, said.data);
    jox_text_free(&said);
    return good;
}

/* "a.yaml:3:5: unknown key" */
static char *describe_refusal(const JoError *error) {
    JoxText text = {0};
    if (*error->file)
        jox_text_printf(&text, "%s:%d:%d: ", error->file, (int)error->line, (int)error->column);
    jox_text_printf(&text, "it does not load: %s", error->text);
    return text.data;
}

/* Returns whether to read on after `read` variants, of which the first `alike` were refused for the
   same reason; reading thousands that fail alike takes minutes. Returns false with `error` if
   stopped. */
static bool may_read_on(const JoSweepDef *def, uint32_t alike, uint32_t read, uint32_t all,
                        JoError *error) {
    if (def->stop && __atomic_load_n(def->stop, __ATOMIC_RELAXED)) {
        jox_error(error, JO_FAILED,
                  "interrupted while it read the variants, %u of %u; none was run", read, all);
        return false;
    }
    if (alike < MOST_ALIKE || read == all)
        return true;
    jox_error(error, JO_INPUT,
              "the first %u of %u variants do not load, all for the same reason: %s", alike, all,
              "mend that, or give others first");
    return false;
}

/* Shows on stderr how many variants are read, if reading takes longer than a second. On a terminal
   this is one line, rewritten and erased at the end; else a line every 10 s. `shown` is when the
   last line was shown, s of wall time, at first the beginning; negative once a line stands. */
static void show_reading(const JoSweepDef *def, uint32_t read, uint32_t all, double *shown) {
    static const double FIRST = 1.0, REWRITTEN = 0.2, EACH_LINE = 10.0; /* s */
    const bool terminal = isatty(2), last = read == all;
    const double now = jox_clock_wall();
    const bool any = *shown < 0.0; /* a line stands already */
    const double since = now - fabs(*shown), least = !terminal ? EACH_LINE
                                                     : any     ? REWRITTEN
                                                               : FIRST;
    if (def->quiet || (last ? !(terminal && any) : since < least))
        return;
    *shown = -now;
    if (last)
        fputs("\r\033[K", stderr);
    else
        fprintf(stderr, "%s%u of %u variants read%s", terminal ? "\r\033[K" : "", read, all,
                terminal ? "" : "\n");
}

/* Loads each variant once, for its first seed. */
static bool load_variants(const JoSweepDef *def, const JoxSweepPlan *plan, const char *const *names,
                          JoxOverlay *files, char **refused, double *shown, JoError *error) {
    uint32_t loaded = 0, alike = 0, first = plan->variant_count;
    for (uint32_t v = 0; v < plan->variant_count; v++) {
        JoError why = {0};
        show_reading(def, v, plan->variant_count, shown);
        if (def->only && (def->only - 1) / plan->seeds != v)
            continue;
        JoSceneDef scene = jox_sweep_scene_def(def, &plan->variants[v], plan->first_seed);
        const bool good = is_vetted(def, &scene, &why) && load_dry(def, &scene, files, &why);
        jox_free((void *)(uintptr_t)scene.overrides);
        loaded += good;
        if (!may_read_on(def, 0, v, plan->variant_count, error))
            return false;
        if (good)
            continue;
        if (why.code == JO_FAILED) { /* the program failed, not the scene */
            *error = why;
            return false;
        }
        refused[v] = describe_refusal(&why);
        first = v < first ? v : first;
        alike += loaded == 0 && alike == v && !strcmp(refused[v], refused[0]);
        if (!may_read_on(def, alike, v + 1, plan->variant_count, error))
            return false;
    }
    files->sealed = true;
    if (loaded == 0 && !def->only)
        jox_error(error, JO_INPUT, "%s%s does not load",
                  *names[first] ? "the variant " : "the scene", names[first]);
    return loaded > 0 || def->only;
}

bool jox_sweep_load_inputs(const JoSweepDef *def, const JoxSweepPlan *plan,
                           const char *const *names, JoxOverlay *files, char **refused,
                           JoError *error) {
    double shown = jox_clock_wall();
    const bool good = load_variants(def, plan, names, files, refused, &shown, error);
    show_reading(def, plan->variant_count, plan->variant_count, &shown);
    return good;
}

bool jox_sweep_note_settings(const JoxSweepStore *store, const JoSweepDef *def,
                             JoxText *differences, JoError *error) {
    char until[64] = "", step[48] = "";
    JoxText sets = {0}, mods = {0};
    if (def->steps)
        snprintf(until, sizeof until, "%llu steps", (unsigned long long)def->steps);
    else if (!isnan(def->seconds))
        snprintf(until, sizeof until, "%.9g s", def->seconds);
    if (def->scene.has_dt)
        snprintf(step, sizeof step, "%.9g s", def->scene.dt);
    for (size_t o = 0; o < def->scene.override_count; o++)
        jox_text_printf(&sets, "%s%s", o ? "\n" : "", def->scene.overrides[o]);
    for (size_t m = 0; m < def->scene.mod_count; m++)
        jox_text_printf(&mods, "%s%s", m ? " " : "", def->scene.mods[m]);
    const struct {
        const char *key, *value;
    } shared[] = {{"scene", def->scene.path},
                  {"version", jo_version()},
                  {"duration", until},
                  {"step", step},
                  {"settings of all", sets.data ? sets.data : ""},
                  {"mods", mods.data ? mods.data : ""},
                  {"input log", def->scene.input_log ? def->scene.input_log : ""}};
    bool good = true;
    for (size_t k = 0; good && k < sizeof shared / sizeof *shared; k++)
        good = jox_sweep_note_value(store, shared[k].key, shared[k].value, differences, error);
    jox_text_free(&sets);
    jox_text_free(&mods);
    return good;
}

bool jox_sweep_note_inputs(const JoxSweepStore *store, const JoSweepDef *def,
                           const JoxOverlay *files, JoxText *differences, JoError *error) {
    bool good = jox_sweep_note_settings(store, def, differences, error);
    for (size_t f = 0; good && f < files->count; f++)
        good = jox_sweep_note_input(store, files->files[f].path, files->files[f].text,
                                    files->files[f].length, differences, error);
    return good;
}
