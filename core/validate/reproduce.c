/* jo_reproduce: loads claims, plans and executes the runs they share, measures their figures and
   writes the results. `jostle reproduce` is the caller. */
#include "validate/reproduce.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/assert.h"
#include "base/file.h"
#include "base/format/path.h"
#include "base/format/plurals.h"
#include "base/guard.h"
#include "base/hash.h"
#include "base/mem.h"
#include "base/sort.h"
#include "run/messages.h"

JoReproduceDef jo_default_reproduce_def(void) {
    long cores = sysconf(_SC_NPROCESSORS_ONLN);
    return (JoReproduceDef){.folder = "scenes/claims",
                            .out = "build/out/reproduce",
                            .jobs = cores > 0 ? (uint32_t)cores : 1};
}

/* ---- claims ---- */

/* Returns whether a claim is in a group: a standard's name for its tests, "paper" for claims
   whose id is a number, "real" for the others. */
static bool is_in_group(const JoxClaim *claim, const char *group) {
    if (jox_claim_is_standard(claim))
        return jox_claim_is_in_standard(claim, group);
    return strcmp(group, isdigit((unsigned char)*claim->id) ? "paper" : "real") == 0;
}

/* Returns whether the def selects a claim, by id, group, file name or path, or selects all. */
static bool is_wanted_claim(const JoReproduceDef *def, const JoxClaim *claim) {
    for (size_t c = 0; c < def->claim_count; c++) {
        const char *file = jox_path_name(claim->path);
        size_t stem = jox_path_stem(file);
        if (strcmp(def->claims[c], claim->id) == 0 || strcmp(def->claims[c], claim->also) == 0 ||
            is_in_group(claim, def->claims[c]) ||
            (strncmp(def->claims[c], file, stem) == 0 && def->claims[c][stem] == 0) ||
            strcmp(def->claims[c], claim->path) == 0)
            return true;
    }
    return def->claim_count == 0 && (!def->standards || jox_claim_is_standard(claim));
}

/* Lists the paths of the Lua files in a folder, for the caller to free. */
static char **list_claim_files(const char *folder, size_t *count) {
    char **files = NULL;
    size_t capacity = 0;
    *count = 0;
    char **names = jox_folder_names(folder, false);
    for (char **name = names; name && *name; name++) {
        const char *dot = strrchr(*name, '.');
        if (!dot || strcmp(dot, ".lua") != 0)
            continue;
        JoxText path = {0};
        jox_text_printf(&path, "%s/%s", folder, *name);
        JOX_RESERVE(files, capacity, *count + 1);
        files[(*count)++] = path.data;
    }
    jox_free(names);
    return files;
}

/* Orders claims: the paper's by number first, then others by letter and number. */
static int compare_claim_ids(const void *left, const void *right, const void *context) {
    (void)context;
    const char *a = ((const JoxOutcome *)left)->claim->id;
    const char *b = ((const JoxOutcome *)right)->claim->id;
    if (isdigit((unsigned char)*a) != isdigit((unsigned char)*b))
        return isdigit((unsigned char)*a) ? -1 : 1;
    if (!isdigit((unsigned char)*a) && *a != *b)
        return *a < *b ? -1 : 1;
    char *a_rest, *b_rest;
    long x = strtol(isdigit((unsigned char)*a) ? a : a + 1, &a_rest, 10);
    long y = strtol(isdigit((unsigned char)*b) ? b : b + 1, &b_rest, 10);
    if (x == y && *a_rest == '.' && *b_rest == '.') { /* N2.9 before N2.10 */
        x = strtol(a_rest + 1, NULL, 10);
        y = strtol(b_rest + 1, NULL, 10);
    }
    return x != y ? (x < y ? -1 : 1) : strcmp(a, b);
}

/* Adds an error about an unknown claim, with the most similar id, file name or group as a hint. */
static void add_no_claim_error(const char *asked, char *const *files, size_t count,
                               const JoxText *ids, const char *folder,
                               JoxDiagnostics *diagnostics) {
    static const char *const GROUPS[] = {"paper", "real", "rimea",    "imo",
                                         "nist",  "iso",  "standards"};
    enum { GROUP_COUNT = sizeof GROUPS / sizeof *GROUPS };
    char hint[JOX_HINT];
    char **names = jox_alloc(2 * count + GROUP_COUNT, sizeof *names);
    size_t n = 0;
    for (size_t f = 0; f < count; f++) {
        const char *file = jox_path_name(files[f]);
        names[n++] = jox_strndup(file, jox_path_stem(file));
    }
    for (const char *id = ids->data; id && *id; id += strcspn(id, " ") + 1)
        if (n < 2 * count)
            names[n++] = jox_strndup(id, strcspn(id, " "));
    for (size_t g = 0; g < GROUP_COUNT; g++)
        names[n++] = jox_strdup(GROUPS[g]);
    const char *near = jox_did_you_mean(asked, (const char *const *)names, n, hint);
    jox_diag_error(diagnostics, ((JoxPosition){folder, 0, 0, 0}), "no-claim",
                   near ? near : "jostle reproduce --list names all", "there is no claim '%.100s'",
                   asked);
    for (size_t k = 0; k < n; k++)
        jox_free(names[k]);
    jox_free(names);
}

/* Loads the selected claims of the folder, sorted by id, with errors for unknown selections. */
static void load_claims(JoxReproduction *all, JoxDiagnostics *diagnostics) {
    JoxText ids = {0};
    size_t count, capacity = 0;
    char **files = list_claim_files(all->def->folder, &count);
    for (size_t f = 0; f < count; f++) {
        JoxClaim *claim = jox_claim_load(files[f], all->def->quick, diagnostics);
        bool wanted = claim && is_wanted_claim(all->def, claim);
        if (claim)
            jox_text_printf(&ids, "%s ", claim->id);
        if (wanted && all->def->quick && claim->too_long && all->def->claim_count == 0) {
            jox_text_printf(&all->left_out, "%s%s", all->left_out.length ? ", " : "", claim->id);
            wanted = false;
        }
        if (wanted) {
            jox_claim_add_sets(claim, all->def->sets, all->def->set_count);
            JOX_RESERVE(all->outcomes, capacity, all->outcome_count + 1);
            all->outcomes[all->outcome_count++] = (JoxOutcome){.claim = claim};
        } else {
            jox_claim_free(claim);
        }
    }
    if (all->outcome_count)
        jox_sort(all->outcomes, all->outcome_count, sizeof *all->outcomes, compare_claim_ids, NULL,
                 NULL);
    if (count == 0)
        jox_diag_error(diagnostics, ((JoxPosition){all->def->folder, 0, 0, 0}), "no-claims",
                       "Run it in the project's folder, or name one: --claims DIR",
                       "there are no claims in this folder");
    for (size_t c = 0; c < all->def->claim_count && diagnostics->errors == 0; c++) {
        bool found = false;
        JoReproduceDef one = {.claims = &all->def->claims[c], .claim_count = 1};
        for (uint32_t o = 0; o < all->outcome_count; o++)
            found |= is_wanted_claim(&one, all->outcomes[o].claim);
        if (!found)
            add_no_claim_error(all->def->claims[c], files, count, &ids, all->def->folder,
                               diagnostics);
    }
    for (size_t f = 0; f < count; f++)
        jox_free(files[f]);
    jox_free(files);
    jox_text_free(&ids);
}

/* ---- runs ---- */

/* Returns the index of the job of a run and seed, which is added unless there is an equal one.
   `pictures`: it writes a report too, which takes time. */
static uint32_t add_run_job(JoxReproduction *all, const JoxClaimRun *run, uint64_t seed,
                            bool pictures) {
    JoxText key = {0}, folder = {0};
    char hash[65];
    jox_text_printf(&key, "%s\n%s\nseed %llu\ndt %.9g\nduration %.9g\n", all->program_sha256,
                    run->scene, (unsigned long long)seed, run->dt, run->duration);
    for (uint32_t s = 0; s < run->set_count; s++)
        jox_text_printf(&key, "set %s\n", run->sets[s]);
    for (uint32_t j = 0; j < all->job_count; j++)
        if (strcmp(all->jobs[j].key, key.data) == 0) {
            all->jobs[j].pictures |= pictures;
            jox_text_free(&key);
            return j;
        }
    /* The folder's name leaves out the program's hash (the first 64 characters), so that runs of
       a new program replace old ones. */
    jox_sha256_hex(key.data + 64, key.length - 64, hash);
    const char *file = jox_path_name(run->scene);
    jox_text_printf(&folder, "%s/runs/%.*s-%.10s-%llu", all->def->out, (int)jox_path_stem(file),
                    file, hash, (unsigned long long)seed);
    JOX_RESERVE(all->jobs, all->job_capacity, all->job_count + 1);
    all->jobs[all->job_count] = (JoxJob){
        .key = key.data, .folder = folder.data, .run = run, .seed = seed, .pictures = pictures};
    return all->job_count++;
}

/* Replaces a run's seeds by those of the option --seeds; a run with one seed keeps one. */
static void choose_seeds(const JoxReproduction *all, JoxClaimRun *run) {
    if (!all->seeds)
        return;
    run->first_seed = all->first_seed;
    run->seeds = run->seeds > 1 ? all->seeds : 1;
}

/* Creates the jobs of a claim's runs, or of its null's. */
static void plan_claim_runs(JoxReproduction *all, const JoxClaim *claim, bool pictures,
                            JoxMeasured *m) {
    m->jobs = jox_alloc(claim->run_count, sizeof *m->jobs);
    m->verdicts = jox_alloc(claim->figure_count, sizeof *m->verdicts);
    for (uint32_t r = 0; r < claim->run_count; r++) {
        JoxClaimRun *run = &m->runs[r];
        choose_seeds(all, run);
        m->seeds = run->seeds > m->seeds ? run->seeds : m->seeds;
        m->jobs[r] = jox_alloc(run->seeds, sizeof **m->jobs);
        for (uint32_t s = 0; s < run->seeds; s++)
            m->jobs[r][s] = add_run_job(all, run, run->first_seed + s, pictures && s == 0);
    }
}

/* Creates the jobs of all claims. */
static void plan_runs(JoxReproduction *all) {
    for (uint32_t o = 0; o < all->outcome_count; o++) {
        JoxOutcome *outcome = &all->outcomes[o];
        JoxClaim *claim = outcome->claim;
        outcome->own.runs = claim->runs;
        outcome->null.runs = claim->null_runs;
        plan_claim_runs(all, claim, claim->picture_count > 0, &outcome->own);
        if (claim->null_runs)
            plan_claim_runs(all, claim, false, &outcome->null);
    }
}

/* ---- measuring ---- */

/* Returns the failure of one of the jobs, or NULL. */
static const char *find_failure(const JoxReproduction *all, const JoxClaim *claim,
                                const JoxMeasured *m) {
    for (uint32_t r = 0; r < claim->run_count; r++)
        for (uint32_t s = 0; s < m->runs[r].seeds; s++)
            if (all->jobs[m->jobs[r][s]].state == JOX_JOB_FAILED)
                return all->jobs[m->jobs[r][s]].failure;
    return NULL;
}

/* Measures the figures of a claim with each seed of its runs, or of its null's, and computes the
   verdicts. Runs with fewer seeds repeat theirs. Without its cause a figure may not exist: the null
   may leave it out, and misses its band. */
static void measure_runs(const JoxReproduction *all, const JoxClaim *claim, JoxMeasured *m) {
    const char *failure = find_failure(all, claim, m);
    double *values = jox_alloc(claim->figure_count, sizeof *values);
    double *all_values = jox_alloc((size_t)claim->figure_count * m->seeds, sizeof *all_values);
    const char **folders = jox_alloc(claim->run_count, sizeof *folders);
    JoxText why = {0};
    if (failure)
        jox_text_add(&why, failure);
    for (uint32_t s = 0; s < m->seeds && why.length == 0; s++) {
        for (uint32_t r = 0; r < claim->run_count; r++)
            folders[r] = all->jobs[m->jobs[r][s % m->runs[r].seeds]].folder;
        jox_claim_measure(claim, folders, m->runs == claim->runs, values, &why);
        for (uint32_t f = 0; f < claim->figure_count; f++)
            all_values[f * m->seeds + s] = values[f];
    }
    m->failure = why.data;
    for (uint32_t f = 0; f < claim->figure_count; f++) {
        const JoxClaimFigure *figure = &claim->figures[f];
        double *of_figure = &all_values[f * m->seeds];
        for (uint32_t s = 0; why.length && s < m->seeds; s++)
            of_figure[s] = NAN;
        m->verdicts[f] = jox_verdict(of_figure, m->seeds, figure->low, figure->high);
        m->verdicts[f].inside &= !figure->sure || !m->verdicts[f].thin;
    }
    jox_free(all_values);
    jox_free(values);
    jox_free(folders);
}

/* Measures a claim and its null. */
static void measure_claim(const JoxReproduction *all, JoxOutcome *outcome) {
    const JoxClaim *claim = outcome->claim;
    measure_runs(all, claim, &outcome->own);
    if (claim->null_runs)
        measure_runs(all, claim, &outcome->null);
    outcome->inside = !outcome->own.failure;
    outcome->proves_nothing = claim->null_runs != NULL;
    for (uint32_t f = 0; f < claim->figure_count; f++) {
        if (claim->figures[f].reported)
            continue;
        outcome->inside &= outcome->own.verdicts[f].inside;
        outcome->thin |= outcome->own.verdicts[f].thin;
        outcome->proves_nothing &=
            outcome->null.failure || !claim->null_runs || outcome->null.verdicts[f].inside;
    }
}

/* ---- the call ---- */

static void write_message(const JoReproduceDef *def, const char *text) {
    if (def->message)
        jox_run_send_message(def->message, def->message_context, text);
    else
        fputs(text, stdout);
}

static void append_figure(JoxText *out, double value) {
    jox_text_printf(out, isfinite(value) ? "%.4g" : "-", value);
}

/* Prints a claim, and unless claims are only listed, its figures with their verdicts. */
static void print_outcome(const JoReproduceDef *def, const JoxOutcome *outcome) {
    const JoxClaim *claim = outcome->claim;
    JoxText out = {0};
    jox_text_printf(&out, "%s  %s (%s)%s%s%s\n", claim->id, claim->title, claim->source,
                    *claim->level ? ", " : "", claim->level,
                    def->list                 ? ""
                    : !outcome->inside        ? ": MISSES"
                    : outcome->proves_nothing ? ": NO EVIDENCE, its null is in band too"
                                              : ": in band");
    if (claim->null_text)
        jox_text_printf(&out, "   null: %s\n", claim->null_text);
    if (*claim->no_null)
        jox_text_printf(&out, "   no null: %s\n", claim->no_null);
    for (uint32_t f = 0; f < claim->figure_count && !def->list; f++) {
        const JoxClaimFigure *figure = &claim->figures[f];
        const JoxVerdict *v = &outcome->own.verdicts[f];
        char bound[JOX_BOUND_SIZE], seeds[JOX_NOUN];
        jox_text_printf(&out, "   %-24s source %-12s measured ", figure->name,
                        *figure->expected ? figure->expected : "-");
        append_figure(&out, v->mean);
        jox_bound_write(bound, v->bound);
        jox_text_printf(&out, "%s%s (", *bound ? " " : "", bound);
        append_figure(&out, v->least);
        jox_text_add(&out, " to ");
        append_figure(&out, v->most);
        jox_text_printf(&out, ", %s) %s", jox_noun(seeds, v->seeds, "seed"), figure->unit);
        if (figure->reported)
            jox_text_add(&out, ", reported");
        else
            jox_text_printf(&out, ", band %.4g to %.4g: %s%s", figure->low, figure->high,
                            v->inside ? "in" : "OUT", v->thin ? ", thin" : "");
        if (!figure->reported && claim->null_runs) {
            jox_text_add(&out, "; null ");
            append_figure(&out, outcome->null.verdicts[f].mean);
            jox_text_add(&out, outcome->null.verdicts[f].inside ? ", in band too" : ", out");
        }
        jox_text_add(&out, "\n");
    }
    if (outcome->own.failure)
        jox_text_printf(&out, "   %s\n", outcome->own.failure);
    if (outcome->null.failure)
        jox_text_printf(&out, "   null: %s\n", outcome->null.failure);
    write_message(def, out.data);
    jox_text_free(&out);
}

static void free_measured(JoxMeasured *m, uint32_t run_count) {
    for (uint32_t r = 0; m->jobs && r < run_count; r++)
        jox_free(m->jobs[r]);
    jox_free(m->jobs);
    jox_free(m->verdicts);
    jox_free(m->failure);
}

static void free_reproduction(JoxReproduction *all) {
    for (uint32_t o = 0; o < all->outcome_count; o++) {
        JoxOutcome *outcome = &all->outcomes[o];
        free_measured(&outcome->own, outcome->claim->run_count);
        free_measured(&outcome->null, outcome->claim->run_count);
        jox_claim_free(outcome->claim);
    }
    for (uint32_t j = 0; j < all->job_count; j++) {
        jox_free(all->jobs[j].key);
        jox_free(all->jobs[j].folder);
        jox_free(all->jobs[j].failure);
    }
    jox_free(all->outcomes);
    jox_free(all->jobs);
    jox_text_free(&all->left_out);
}

/* Executes and measures all claims, writes the results and prints a summary. Sets the number of
   claims not in band. */
static bool run_and_measure(JoxReproduction *all, size_t *missed, JoError *error) {
    double begun = jox_clock_wall();
    plan_runs(all);
    if (!jox_reproduce_run(all)) {
        jox_error(error, JO_FAILED, "interrupted; what was done is kept in %s", all->def->out);
        return false;
    }
    all->seconds = jox_clock_wall() - begun;
    for (uint32_t o = 0; o < all->outcome_count; o++) {
        measure_claim(all, &all->outcomes[o]);
        print_outcome(all->def, &all->outcomes[o]);
        *missed += !jox_outcome_holds(&all->outcomes[o]);
    }
    JoxText why = {0}, out = {0};
    const bool good = jox_reproduce_write(all, &why) &&
                      (!all->def->standards || jox_reproduce_write_standards(all, &why));
    if (!good)
        jox_error(error, JO_FAILED, "%s", why.data);
    jox_text_printf(&out, "%u of %u claims in band", all->outcome_count - (uint32_t)*missed,
                    all->outcome_count);
    for (uint32_t o = 0, n = 0; o < all->outcome_count; o++)
        if (!jox_outcome_holds(&all->outcomes[o]))
            jox_text_printf(&out, "%s%s",
                            n++ ? ", " : "; these miss: ", all->outcomes[o].claim->id);
    if (all->left_out.length)
        jox_text_printf(&out, "\nleft out with --quick: %s", all->left_out.data);
    jox_text_printf(&out, "\nreport: %s/index.html\n", all->def->out);
    if (all->def->standards)
        jox_text_printf(&out, "standards: %s/standards.html\n", all->def->out);
    write_message(all->def, out.data);
    jox_text_free(&why);
    jox_text_free(&out);
    return good;
}

/* Loads the claims, and lists them or runs and measures them. */
static bool reproduce_claims(const JoReproduceDef *def, size_t *missed, JoError *error) {
    JoxReproduction all = {.def = def};
    JoxDiagnostics diagnostics = {0};
    size_t length;
    *missed = 0;
    char *program = def->program ? jox_read_file(def->program, (size_t)256 << 20, &length) : NULL;
    if (program)
        jox_sha256_hex(program, length, all.program_sha256);
    jox_free(program);
    if (!def->list && !*all.program_sha256) {
        jox_error(error, JO_FAILED, "the program that runs the scenes, %s, cannot be read",
                  def->program);
        return false;
    }
    if (def->seeds && !jox_seeds_read(def->seeds, &all.first_seed, &all.seeds))
        jox_diag_error(&diagnostics, ((JoxPosition){"--seeds", 0, 0, 0}), "bad-seeds",
                       "--seeds 101, or --seeds 101-110",
                       "'%.60s' is no seed, and no range of up to 1000", def->seeds);
    load_claims(&all, &diagnostics);
    bool good = diagnostics.errors == 0;
    jox_run_report_diagnostics(def->message, def->message_context, &diagnostics, error);
    for (uint32_t o = 0; good && def->list && o < all.outcome_count; o++)
        print_outcome(def, &all.outcomes[o]);
    if (good && !def->list)
        good = run_and_measure(&all, missed, error);
    free_reproduction(&all);
    return good;
}

bool jo_reproduce(const JoReproduceDef *def, size_t *missed, JoError *error) {
    JOX_REQUIRE(def && missed && (def->program || def->list) && def->jobs > 0, false);
    JOX_GUARD (NULL, error)
        return false;
    return reproduce_claims(def, missed, error);
}
