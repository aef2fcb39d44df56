/* Writes standards.html, for authorities: each test of a standard with its source, plan,
   criterion, figures and verdict. */
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "picture/html.h"
#include "picture/plot.h"
#include "validate/reproduce.h"

enum { MOST_SETS = 60 };

static const char PAGE[] = "standards.html";

/* The standards, found by the first letter of a claim's id. */
static const struct Standard {
    char letter;
    const char *group, *name, *left_out;
} STANDARDS[] = {
    {'R', "rimea", "RiMEA 4.1.1", "none"},
    {'I', "imo", "IMO MSC.1/Circ.1533", "7 (a table of men of 30 to 50)"},
    {'N', "nist", "NIST TN 1822", "2.5 and 2.6 (smoke), 5.1"},
    {'O', "iso", "ISO 20414:2020, where it differs from the others",
     "18 and 19 (smoke and dose); 14, 15 and 16 are 2.9, 3.2 and 3.3 of NIST"},
};
enum { STANDARD_COUNT = sizeof STANDARDS / sizeof *STANDARDS };

/* Returns whether a claim is a test of a standard, by either of its ids. */
static bool is_test_of(const JoxClaim *claim, const struct Standard *standard) {
    return *claim->id == standard->letter || *claim->also == standard->letter;
}

bool jox_claim_is_in_standard(const JoxClaim *claim, const char *group) {
    for (int s = 0; s < STANDARD_COUNT; s++)
        if (is_test_of(claim, &STANDARDS[s]) &&
            (strcmp(group, "standards") == 0 || strcmp(group, STANDARDS[s].group) == 0))
            return true;
    return false;
}

bool jox_claim_is_standard(const JoxClaim *claim) {
    return jox_claim_is_in_standard(claim, "standards");
}

/* ---- plans ---- */

/* Draws the scene of a claim's first run at its start, by a process `jostle render`. */
static bool draw_test_plan(const JoxReproduction *all, const JoxOutcome *outcome,
                           const char *path) {
    const JoxClaimRun *run = &outcome->claim->runs[0];
    const char *arguments[2 * MOST_SETS + 8] = {all->def->program, "render", run->scene,
                                                "--quiet",         "--out",  path};
    int n = 6, status = 0;
    for (uint32_t s = 0; s < run->set_count && s < MOST_SETS; s++) {
        arguments[n++] = "--set";
        arguments[n++] = run->sets[s];
    }
    const pid_t child = fork();
    if (child == 0) { /* by descriptor: buffered output of stdio is left to the parent */
        const int nowhere = open("/dev/null", O_WRONLY);
        if (nowhere >= 0) {
            dup2(nowhere, 1);
            dup2(nowhere, 2);
        }
        execv(all->def->program, (char **)(uintptr_t)arguments);
        _exit(127);
    }
    return child > 0 && waitpid(child, &status, 0) == child && status == 0;
}

static void put_test_plan(FILE *out, const JoxReproduction *all, const JoxOutcome *outcome) {
    char name[100], path[1400];
    snprintf(name, sizeof name, "plan-%.40s.png", outcome->claim->id);
    snprintf(path, sizeof path, "%s/%s", all->def->out, name);
    fputs("<div class=plan>\n", out); /* wide enough to read the names */
    if (draw_test_plan(all, outcome, path))
        jox_html_picture(out, name, NULL, "the set-up at the beginning");
    else
        fputs("<p class=out>The plan could not be drawn.</p>\n", out);
    fputs("</div>\n", out);
}

/* ---- the page ---- */

/* Writes a table of standards: tests passed and failed, and tests not covered. */
static void put_standards_summary(FILE *out, const JoxReproduction *all) {
    jox_html_table(out, "standard|tests|pass|fail|not covered");
    for (int s = 0; s < STANDARD_COUNT; s++) {
        uint32_t tests = 0, passes = 0;
        for (uint32_t o = 0; o < all->outcome_count; o++)
            if (is_test_of(all->outcomes[o].claim, &STANDARDS[s])) {
                tests++;
                passes += jox_outcome_holds(&all->outcomes[o]);
            }
        jox_html_row(out);
        jox_html_cell(out, STANDARDS[s].name);
        jox_html_cell_number(out, tests, "");
        jox_html_cell_number(out, passes, "");
        jox_html_cell_number(out, tests - passes, "");
        jox_html_cell(out, STANDARDS[s].left_out);
    }
    jox_html_table_end(out);
}

static void put_test_verdict(FILE *out, bool inside, bool thin) {
    fprintf(out, "<td class=%s>%s%s", inside ? "in" : "out", inside ? "passes" : "fails",
            thin ? ", thin" : "");
}

static void put_ids(FILE *out, const JoxClaim *claim) {
    jox_html_text(out, claim->id);
    if (*claim->also) {
        fputs(", ", out);
        jox_html_text(out, claim->also);
    }
}

/* Writes a table of all tests with links and verdicts. */
static void put_overview(FILE *out, const JoxReproduction *all) {
    jox_html_table(out, "test|what|verdict");
    for (uint32_t o = 0; o < all->outcome_count; o++) {
        const JoxOutcome *outcome = &all->outcomes[o];
        if (!jox_claim_is_standard(outcome->claim))
            continue;
        jox_html_row(out);
        fprintf(out, "<td><a href=\"#t%u\">", o);
        put_ids(out, outcome->claim);
        fputs("</a>", out);
        jox_html_cell(out, outcome->claim->title);
        put_test_verdict(out, jox_outcome_holds(outcome), outcome->inside && outcome->thin);
    }
    jox_html_table_end(out);
}

/* Writes a row of a test's figure, with the figure of the wrong input if there is one. */
static void put_test_figure(FILE *out, const JoxOutcome *outcome, uint32_t f) {
    const JoxClaimFigure *figure = &outcome->claim->figures[f];
    const JoxVerdict *v = &outcome->own.verdicts[f];
    char bound[JOX_BOUND_SIZE], seeds[JOX_SEEDS_SIZE];
    jox_html_row(out);
    jox_html_cell(out, *figure->what ? figure->what : figure->name);
    jox_html_cell(out, figure->expected);
    jox_html_cell_number(out, v->mean, figure->unit);
    jox_bound_write(bound, v->bound);
    jox_html_cell(out, bound);
    jox_html_cell_number(out, v->p95, figure->unit);
    jox_html_cell_number(out, v->most, figure->unit);
    jox_html_cell(out, jox_seeds_write(seeds, v->seeds, v->most_seeds));
    if (figure->reported)
        jox_html_cell(out, "reported");
    else
        put_test_verdict(out, v->inside, v->thin);
    if (outcome->null.runs)
        jox_html_cell_number(out, outcome->null.verdicts[f].mean, figure->unit);
    if (outcome->null.runs && !figure->reported)
        fputs(outcome->null.verdicts[f].inside                 ? ", passes"
              : jox_verdict_misses(&outcome->null.verdicts[f]) ? ", fails"
                                                               : ", not measured",
              out);
}

/* Writes the section of a test: text, source, plan, figures and pictures. */
static void put_test(FILE *out, const JoxReproduction *all, const JoxOutcome *outcome) {
    const JoxClaim *claim = outcome->claim;
    fprintf(out, "<h2 id=\"t%u\">", (unsigned)(outcome - all->outcomes));
    jox_html_text(out, claim->title);
    fprintf(out, " &ndash; <span class=%s>%s</span></h2>\n",
            jox_outcome_holds(outcome) ? "in" : "out",
            jox_outcome_holds(outcome) ? "passes" : "fails");
    jox_html_paragraph(out, claim->text);
    fputs("<p><small>Source: ", out);
    jox_html_text(out, claim->source);
    fputs(".<br>Haste of the people: ", out);
    jox_html_text(out, *claim->level ? claim->level : "as the scene says");
    if (claim->null_text) {
        fputs(".<br>Wrong input, with which the test must fail: ", out);
        jox_html_text(out, claim->null_text);
    }
    if (*claim->no_null) {
        fputs(".<br>No wrong input: ", out);
        jox_html_text(out, claim->no_null);
    }
    fputs(".</small></p>\n", out);
    if (outcome->own.failure)
        jox_html_paragraph(out, outcome->own.failure);
    if (outcome->null.failure)
        jox_html_paragraph(out, outcome->null.failure);
    else if (outcome->inside && outcome->proves_nothing)
        jox_html_paragraph(out, "It does not fail with the wrong input, and so shows nothing.");
    put_test_plan(out, all, outcome);
    jox_html_table(out, outcome->null.runs
                            ? "figure|criterion|mean|95 % bound|95 % of runs|most|runs|verdict|"
                              "with the wrong input"
                            : "figure|criterion|mean|95 % bound|95 % of runs|most|runs|verdict");
    for (uint32_t f = 0; f < claim->figure_count; f++)
        put_test_figure(out, outcome, f);
    jox_html_table_end(out);
    jox_reproduce_put_pictures(out, all, outcome);
}

bool jox_reproduce_write_standards(const JoxReproduction *all, JoxText *error) {
    char when[512];
    FILE *out = jox_plot_open(all->def->out, PAGE, error);
    if (!out)
        return false;
    jox_reproduce_describe_run(all, when, sizeof when);
    jox_html_begin(out, "Tests of standards");
    jox_html_paragraph(out, when);
    if (all->cut.length) {
        JoxText quick = {0};
        jox_text_printf(&quick, JOX_SAYS_QUICK "%s.", all->cut.data);
        jox_html_paragraph(out, quick.data);
        jox_text_free(&quick);
    }
    jox_html_paragraph(
        out,
        "All people follow one walking law with one set of constants, which no test changes; "
        "speeds, sizes and times before people move are set as the test states them. Each figure "
        "is the mean over runs that differ only by the seed of their random numbers, with its "
        "95 % bound. A verdict is thin if other seeds might change it. Tests that fail are shown "
        "as failing. Each that has a wrong input is also run with it: one that does not fail with "
        "it shows nothing, and fails.");
    jox_html_paragraph(
        out, "Set-ups and criteria are those of open implementations of the tests, which are named "
             "with each; the texts of the standards themselves were not consulted. A test says "
             "that a model does what it was asked, not that a scenario is safe.");
    put_standards_summary(out, all);
    put_overview(out, all);
    for (uint32_t o = 0; o < all->outcome_count; o++)
        if (jox_claim_is_standard(all->outcomes[o].claim))
            put_test(out, all, &all->outcomes[o]);
    jox_html_end(out);
    return jox_plot_close(out, PAGE, error);
}
