/* Prints a command for each run of a sweep, or its state: `jostle sweep --list` and `--status`. */
#include "cli/sweep_list.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/format/plurals.h"
#include "base/format/quote.h"
#include "base/mem.h"

typedef struct Lister {
    const CliSweep *sweep;
    JoxText begin; /* begin of each command: program, scene, options of all runs */
    bool any_missing;
    uint32_t unreadable;
} Lister;

static void add_option(JoxText *out, const char *name, const char *value) {
    jox_text_printf(out, " --%s ", name);
    jox_quote_shell(out, value);
}

/* Appends the options that all runs share. */
static void add_shared_options(JoxText *out, const CliSweep *sweep, const char *program) {
    const JoSweepDef *def = &sweep->def;
    jox_quote_shell(out, program);
    jox_text_add(out, " sweep ");
    jox_quote_shell(out, def->scene.path);
    for (size_t s = 0; s < def->set_count; s++)
        add_option(out, "set", def->sets[s]);
    for (size_t m = 0; m < def->scene.mod_count; m++)
        add_option(out, "mod", def->scene.mods[m]);
    jox_text_printf(out, " --seeds %u", def->seeds);
    if (def->scene.has_seed)
        jox_text_printf(out, " --seed %llu", (unsigned long long)def->scene.seed);
    if (sweep->has_seconds)
        jox_text_printf(out, " --for %.9g", def->seconds);
    if (def->steps)
        jox_text_printf(out, " --steps %llu", (unsigned long long)def->steps);
    if (def->scene.has_dt)
        jox_text_printf(out, " --dt %.9g", def->scene.dt);
    if (def->scene.threads)
        jox_text_printf(out, " --threads %u", def->scene.threads);
    if (def->scene.isa != JO_ISA_WIDEST)
        add_option(out, "isa", jo_isa_name(def->scene.isa));
    if (def->scene.input_log)
        add_option(out, "input", def->scene.input_log);
    jox_text_printf(out, "%s%s%s", def->scene.named_mods_only ? " --no-mods" : "",
                    sweep->trusted ? " --trusted" : "", def->again ? " --again" : "");
}

/* Counts a run whose file cannot be read, and says why. */
static void note_unreadable(Lister *l, const JoSweepRunState *run) {
    if (!run->reason)
        return;
    l->unreadable++;
    fprintf(stderr, "jostle sweep: run %u: %s\n", run->number, run->reason); /* names the file */
}

static void print_command(void *context, const JoSweepRunState *run) {
    Lister *l = context;
    note_unreadable(l, run);
    const bool left =
        !strcmp(run->state, "missing") || (l->sweep->def.again && !strcmp(run->state, "failed"));
    if (l->sweep->missing && !left)
        return;
    JoxText out = {0};
    add_option(&out, "out", run->part);
    printf("%s --only %u%s --quiet\n", l->begin.data, run->number, out.data);
    jox_text_free(&out);
}

static void print_state(void *context, const JoSweepRunState *run) {
    Lister *l = context;
    l->any_missing |= !strcmp(run->state, "missing");
    note_unreadable(l, run);
    printf("%u\t%s\t%s%sseed %llu\t%s\n", run->number, run->state, run->variant,
           *run->variant ? ", " : "", (unsigned long long)run->seed, run->part);
}

/* Makes the folder of the runs' files; false with a message. */
static bool make_parts_folder(const char *folder) {
    if (mkdir(folder, 0777) == 0 || errno == EEXIST)
        return true;
    fprintf(stderr, "jostle sweep: cannot make the folder '%s': %s\n", folder, strerror(errno));
    return false;
}

/* Appends the path of the folder of the runs' files: that of the sweep's file, with "-parts". */
static void add_parts_folder(JoxText *folder, const char *out) {
    static const char ENDING[] = ".sqlite";
    const size_t n = strlen(out), e = sizeof ENDING - 1;
    const size_t stem = n > e && !strcmp(out + n - e, ENDING) ? n - e : n;
    jox_text_printf(folder, "%.*s-parts", (int)stem, out);
}

/* Whether a command in one line can hold a text: it is UTF-8 without control characters. */
static bool fits_in_line(const char *text) {
    char *clean = jox_strdup(text ? text : "");
    jox_text_clean(clean);
    const bool fits = strcmp(clean, text ? text : "") == 0;
    jox_free(clean);
    return fits;
}

/* Returns the argument that no command in one line can hold; NULL: none. */
static const char *find_unfit_argument(const CliSweep *sweep, const char *program) {
    const JoSweepDef *def = &sweep->def;
    const char *const single[] = {program, def->scene.path, def->out, def->scene.input_log};
    for (size_t k = 0; k < sizeof single / sizeof *single; k++)
        if (!fits_in_line(single[k]))
            return single[k];
    for (size_t s = 0; s < def->set_count; s++)
        if (!fits_in_line(def->sets[s]))
            return def->sets[s];
    for (size_t m = 0; m < def->scene.mod_count; m++)
        if (!fits_in_line(def->scene.mods[m]))
            return def->scene.mods[m];
    return NULL;
}

/* Reports the argument that --list cannot print; returns the exit status. */
static int report_unfit_argument(const char *argument) {
    JoxText why = {0}, quoted = {0};
    jox_quote_shell(&quoted, argument);
    jox_text_printf(&why,
                    "--list prints each command in one line of UTF-8, which cannot hold the line "
                    "end or other byte shown as ' ' or '?' in %.300s: rename it",
                    quoted.data);
    const int status = cli_report_misuse(&cli_sweep, why.data);
    jox_text_free(&quoted);
    jox_text_free(&why);
    return status;
}

int cli_list_runs(const CliSweep *sweep) {
    char program[1024];
    JoError error = {0};
    JoxText folder = {0};
    Lister lister = {.sweep = sweep};
    const ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);
    program[length > 0 ? length : 0] = 0;
    const char *unfit = sweep->list ? find_unfit_argument(sweep, program) : NULL;
    if (unfit)
        return report_unfit_argument(unfit);
    add_parts_folder(&folder, sweep->def.out);
    add_shared_options(&lister.begin, sweep, program);
    int status =
        jo_sweep_runs(&sweep->def, &error) ? JO_OK : cli_report_error(&cli_sweep, &error, false);
    if (status == JO_OK) {
        cli_output_is_data();
        status = sweep->list && !make_parts_folder(folder.data) ? JO_FAILED : JO_OK;
    }
    if (status == JO_OK &&
        !jo_sweep_states(&sweep->def, folder.data, sweep->list ? print_command : print_state,
                         &lister, &error))
        status = cli_report_error(&cli_sweep, &error, false);
    if (status == JO_OK && lister.unreadable) {
        char what[JOX_NOUN];
        fprintf(stderr, "jostle sweep: %s cannot be read: remove each, and do its run again\n",
                jox_noun(what, lister.unreadable, "file"));
        status = JO_INPUT;
    }
    jox_text_free(&folder);
    jox_text_free(&lister.begin);
    return status == JO_OK && lister.any_missing ? JO_FAILED : status;
}
