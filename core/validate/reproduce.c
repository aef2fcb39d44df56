/* jo_reproduce: plans and executes the runs that claims share, measures their figures and
   writes the results. `jostle reproduce` is the caller. */
#include "validate/reproduce.h"

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
#include "run/messages.h"

JoReproduceDef jo_default_reproduce_def(void) {
    long cores = sysconf(_SC_NPROCESSORS_ONLN);
    return (JoReproduceDef){.folder = "scenes/claims",
                            .out = "build/out/reproduce",
                            .jobs = cores > 0 ? (uint32_t)cores : 1};
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
        if (r == 0 || run->seeds < m->fewest_seeds)
            m->fewest_seeds = run->seeds;
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

/* Computes the verdict on a figure from its values. As runs with fewer seeds repeat theirs, values
   that repeat with the seeds of a run count once. A figure that never changes does not tell from
   which runs it is. A null misses a band by its mean alone. */
static JoxVerdict judge_figure(const JoxClaim *claim, const JoxMeasured *m, const double *values,
                               const JoxClaimFigure *figure) {
    uint32_t seeds = m->seeds;
    bool changes = false;
    for (uint32_t s = 1; s < m->seeds; s++)
        changes |= values[s] != values[0];
    for (uint32_t r = 0; r < claim->run_count; r++) {
        const uint32_t period = m->runs[r].seeds;
        bool repeats = true;
        for (uint32_t s = period; s < m->seeds; s++)
            repeats &= values[s] == values[s - period];
        if (repeats && period < seeds)
            seeds = period;
    }
    JoxVerdict verdict = jox_verdict(values, seeds, figure->low, figure->high);
    if (figure->sure && m->runs == claim->runs) {
        verdict.thin |= isfinite(verdict.mean) && !isfinite(verdict.bound); /* one seed */
        verdict.inside &= !verdict.thin;
    }
    if (!changes)
        verdict.most_seeds = m->seeds;
    return verdict;
}

/* Measures the figures of a claim with each seed of its runs, or of its null's, and computes the
   verdicts. Runs with fewer seeds repeat theirs. Without its cause a figure may not exist: the null
   may leave it out. */
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
        m->verdicts[f] = judge_figure(claim, m, of_figure, figure);
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
        outcome->count.banded++;
        outcome->count.inside += outcome->own.verdicts[f].inside;
        outcome->inside &= outcome->own.verdicts[f].inside;
        outcome->thin |= outcome->own.verdicts[f].thin;
        if (claim->null_runs && !outcome->null.failure)
            outcome->proves_nothing &= !jox_verdict_misses(&outcome->null.verdicts[f]);
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
    char seeds[JOX_SEEDS_SIZE], noun[JOX_NOUN];
    JoxText out = {0};
    jox_text_printf(&out, "%s  %s (%s)%s%s%s\n", claim->id, claim->title, claim->source,
                    *claim->level ? ", " : "", claim->level,
                    def->list                 ? ""
                    : !outcome->inside        ? ": MISSES"
                    : outcome->null.failure   ? ": NO EVIDENCE, its null could not be measured"
                    : outcome->proves_nothing ? ": NO EVIDENCE, its null misses no band"
                                              : ": in band");
    if (claim->null_text && def->list)
        jox_text_printf(&out, "   null: %s\n", claim->null_text);
    else if (claim->null_text)
        jox_text_printf(&out, "   null, %s %s: %s\n",
                        jox_seeds_write(seeds, outcome->null.fewest_seeds, outcome->null.seeds),
                        jox_noun_alone(noun, outcome->null.seeds, "seed"), claim->null_text);
    if (*claim->no_null)
        jox_text_printf(&out, "   no null: %s\n", claim->no_null);
    for (uint32_t f = 0; f < claim->figure_count && !def->list; f++) {
        const JoxClaimFigure *figure = &claim->figures[f];
        const JoxVerdict *v = &outcome->own.verdicts[f];
        char bound[JOX_BOUND_SIZE];
        jox_text_printf(&out, "   %-24s source %-12s measured ", figure->name,
                        *figure->expected ? figure->expected : "-");
        append_figure(&out, v->mean);
        jox_bound_write(bound, v->bound);
        jox_text_printf(&out, "%s%s (", *bound ? " " : "", bound);
        append_figure(&out, v->least);
        jox_text_add(&out, " to ");
        append_figure(&out, v->most);
        jox_text_printf(&out, ", %s %s) %s", jox_seeds_write(seeds, v->seeds, v->most_seeds),
                        jox_noun_alone(noun, v->most_seeds, "seed"), figure->unit);
        if (figure->reported)
            jox_text_add(&out, ", reported");
        else
            jox_text_printf(&out, ", band %.4g to %.4g: %s%s", figure->low, figure->high,
                            v->inside ? "in" : "OUT", v->thin ? ", thin" : "");
        if (!figure->reported && claim->null_runs && !outcome->null.failure) {
            const JoxVerdict *null = &outcome->null.verdicts[f];
            jox_text_add(&out, "; null ");
            append_figure(&out, null->mean);
            jox_text_add(&out, null->inside               ? ", in band too"
                               : jox_verdict_misses(null) ? ", out"
                                                          : ", not measured");
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
    jox_text_free(&all->cut);
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
        all->count.inside += all->outcomes[o].count.inside;
        all->count.banded += all->outcomes[o].count.banded;
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
    if (all->count.banded)
        jox_text_add(&out, "\n");
    jox_reproduce_add_counts(all, &out);
    if (all->cut.length)
        jox_text_printf(&out,
                        "\nverdicts of --quick are not the published ones; cut to fewer seeds or "
                        "shorter runs: %s",
                        all->cut.data);
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
    jox_reproduce_load_claims(&all, &diagnostics);
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
