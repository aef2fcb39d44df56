/* Writes the page of jo_reproduce's results, index.html. */
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/utsname.h>
#include <time.h>

#include "agents/parameters.h"
#include "base/file.h"
#include "base/format/plurals.h"
#include "base/mem.h"
#include "force/force.h"
#include "picture/html.h"
#include "picture/plot.h"
#include "validate/reproduce.h"

static void put_bound(FILE *out, double bound) {
    char text[JOX_BOUND_SIZE];
    jox_bound_write(text, bound);
    jox_html_text(out, text);
}

/* ---- where and when ---- */

/* Reads the value behind ": ", or the rest, of the first line of a file that begins with `key`;
   "" if there is none. */
static void read_line_value(const char *path, const char *key, char *out, size_t size) {
    char line[512];
    FILE *file = jox_file_open(path, "r");
    *out = 0;
    while (file && fgets(line, sizeof line, file))
        if (strncmp(line, key, strlen(key)) == 0) {
            const char *at = strchr(line, ':');
            snprintf(out, size, "%s", at ? at + 2 : line + strlen(key));
            out[strcspn(out, "\n")] = 0;
            break;
        }
    if (file)
        jox_file_close(file);
}

/* Reads the first 12 characters of the commit of a checkout in the working folder, or "". */
static void read_commit(char *out, size_t size) {
    char head[512], path[600];
    read_line_value(".git/HEAD", "", head, sizeof head);
    if (strncmp(head, "refs/", 5) == 0) {
        snprintf(path, sizeof path, ".git/%s", head);
        read_line_value(path, "", head, sizeof head);
    }
    snprintf(out, size, "%.12s", head);
}

void jox_reproduce_describe_run(const JoxReproduction *all, char *out, size_t size) {
    char cpu[128], commit[32], day[32];
    struct utsname system;
    time_t now = time(NULL);
    struct tm tm;
    uname(&system);
    read_line_value("/proc/cpuinfo", "model name", cpu, sizeof cpu);
    read_commit(commit, sizeof commit);
    strftime(day, sizeof day, "%Y-%m-%d", gmtime_r(&now, &tm));
    uint32_t reused = 0;
    for (uint32_t j = 0; j < all->job_count; j++)
        reused += all->jobs[j].reused;
    snprintf(out, size, "%s, Jostle %s%s%s, %s, %s %s, %u runs in %.0f s%s", day, jo_version(),
             *commit ? ", commit " : "", commit, *cpu ? cpu : system.machine, system.sysname,
             system.machine, all->job_count - reused, all->seconds,
             all->def->quick ? ", quick" : "");
    if (reused > 0) {
        const size_t used = strlen(out);
        snprintf(out + used, size - used, ", %u done before", reused);
    }
    for (size_t s = 0; s < all->def->set_count; s++) {
        size_t used = strlen(out);
        snprintf(out + used, size - used, "%s %s", s ? "," : ", with", all->def->sets[s]);
    }
}

/* ---- the page ---- */

/* Writes the cell of a figure's null, which is evidence where it is out of the band, and ends the
   row. */
static void put_null_figure(FILE *out, const JoxOutcome *outcome, uint32_t f) {
    const JoxClaimFigure *figure = &outcome->claim->figures[f];
    if (outcome->null.runs) {
        const JoxVerdict *v = &outcome->null.verdicts[f];
        fprintf(out, "<td class=%s>", !figure->reported && v->inside ? "out" : "n");
        jox_html_number(out, v->mean);
        fputs(!figure->reported && v->inside ? ", in band too" : "", out);
    }
    fputs("</tr>\n", out);
}

/* Writes a table of a claim's figures with their bands and verdicts. */
static void put_claim_figures(FILE *out, const JoxOutcome *outcome) {
    fputs("<div class=scroll><table><tr><th>figure<th>source<th>mean<th>95&nbsp;% "
          "bound<th>seeds<th>least "
          "to most of them<th>band<th>verdict",
          out);
    fputs(outcome->null.runs ? "<th>null</tr>\n" : "</tr>\n", out);
    for (uint32_t f = 0; f < outcome->claim->figure_count; f++) {
        const JoxClaimFigure *figure = &outcome->claim->figures[f];
        const JoxVerdict *v = &outcome->own.verdicts[f];
        char seeds[JOX_SEEDS_SIZE];
        fputs("<tr><td>", out);
        jox_html_text(out, *figure->what ? figure->what : figure->name);
        fputs("<td>", out);
        jox_html_text(out, figure->expected);
        fputs("<td class=n>", out);
        jox_html_number(out, v->mean);
        fputc(' ', out);
        jox_html_text(out, figure->unit);
        fputs("<td class=n>", out);
        put_bound(out, v->bound);
        fprintf(out, "<td class=n>%s<td class=n>", jox_seeds_write(seeds, v->seeds, v->most_seeds));
        jox_html_number(out, v->least);
        fputs(" to ", out);
        jox_html_number(out, v->most);
        fputs("<td>", out);
        jox_reproduce_put_band(out, figure, "&ndash;");
        fprintf(out, "<td class=%s>%s",
                figure->reported ? "none"
                : v->inside      ? "in"
                                 : "out",
                jox_figure_verdict(figure, v));
        put_null_figure(out, outcome, f);
    }
    fputs("</table></div>\n", out);
}

void jox_reproduce_put_pictures(FILE *out, const JoxReproduction *all, const JoxOutcome *outcome) {
    const JoxClaim *claim = outcome->claim;
    for (uint32_t p = 0; !outcome->own.failure && p < claim->plot_count; p++) {
        char name[200], link[256];
        jox_reproduce_plot_name(claim, &claim->plots[p], name, sizeof name);
        snprintf(link, sizeof link, "plots/%s.png", name);
        jox_html_picture(out, link, NULL, claim->plots[p].title);
    }
    for (uint32_t p = 0; p < claim->picture_count; p++)
        for (uint32_t r = 0; r < claim->run_count; r++) {
            if (strcmp(claim->runs[r].name, claim->pictures[p].run) != 0)
                continue;
            const JoxJob *job = &all->jobs[outcome->own.jobs[r][0]];
            char path[1400];
            struct stat info;
            snprintf(path, sizeof path, "%s/%s", job->folder, claim->pictures[p].file);
            if (stat(path, &info) != 0) {
                fputs("<p class=out>The run ", out);
                jox_html_text(out, claim->runs[r].name);
                fputs(" left no ", out);
                jox_html_text(out, claim->pictures[p].file);
                fputs(".</p>\n", out);
                continue;
            }
            const char *link = path + strlen(all->def->out) + 1;
            char caption[200];
            snprintf(caption, sizeof caption, "%.90s: %.90s", claim->runs[r].name,
                     claim->pictures[p].file);
            jox_html_picture(out, link, NULL, caption);
        }
}

/* Writes the commands of a claim's runs and the text of their scenes. */
static void put_claim_runs(FILE *out, const JoxReproduction *all, const JoxOutcome *outcome) {
    fputs("<details><summary>Runs and their scenes</summary>\n", out);
    for (uint32_t r = 0; r < outcome->claim->run_count; r++) {
        const JoxClaimRun *run = &outcome->claim->runs[r];
        const JoxJob *job = &all->jobs[outcome->own.jobs[r][0]];
        size_t length;
        fputs("<p><b>", out);
        jox_html_text(out, run->name);
        fputs("</b>: <code>jostle run ", out);
        jox_html_argument(out, run->scene);
        if (run->dt > 0.0)
            fprintf(out, " --dt %g", run->dt);
        if (run->duration > 0.0)
            fprintf(out, " --for %g", run->duration);
        for (uint32_t s = 0; s < run->set_count; s++) {
            fputs(" --set ", out);
            jox_html_argument(out, run->sets[s]);
        }
        fprintf(out, "</code>, seeds %llu to %llu, ", (unsigned long long)run->first_seed,
                (unsigned long long)(run->first_seed + run->seeds - 1));
        jox_html_text(out, job->folder);
        fputs("\n<pre>", out);
        char *text = jox_read_file(run->scene, (size_t)1 << 20, &length);
        jox_html_text(out, text ? text : "");
        jox_free(text);
        fputs("</pre>\n", out);
    }
    fputs("</details>\n", out);
}

/* Writes what was tried, for a claim that misses. */
static void put_tried(FILE *out, const JoxOutcome *outcome) {
    if (outcome->inside || outcome->claim->tried_count == 0)
        return;
    fputs("<p>What was tried:</p>\n<ul>\n", out);
    for (uint32_t t = 0; t < outcome->claim->tried_count; t++) {
        fputs("<li>", out);
        jox_html_text(out, outcome->claim->tried[t]);
        fputs("</li>\n", out);
    }
    fputs("</ul>\n", out);
}

static void put_claim(FILE *out, const JoxReproduction *all, const JoxOutcome *outcome) {
    const JoxClaim *claim = outcome->claim;
    fprintf(out, "<h2 id=\"c%u\">", (unsigned)(outcome - all->outcomes));
    jox_html_text(out, claim->id);
    fputs(": ", out);
    jox_html_text(out, claim->title);
    fprintf(out, " &ndash; <span class=%s>%s</span></h2>\n<p>",
            jox_outcome_holds(outcome) ? "in" : "out", jox_outcome_verdict(outcome));
    jox_html_text(out, claim->text);
    fputs("<br><small>Source: ", out);
    jox_html_text(out, claim->source);
    if (*claim->level) {
        fputs("<br>Haste: ", out);
        jox_html_text(out, claim->level);
        fputc('.', out);
    }
    if (*claim->calibrated || *claim->held_out) {
        fputs(*claim->calibrated ? "<br>Calibrated: " : "<br>Held out: ", out);
        jox_html_text(out, *claim->calibrated ? claim->calibrated : claim->held_out);
    }
    if (claim->null_text) {
        char seeds[JOX_SEEDS_SIZE], noun[JOX_NOUN];
        const JoxMeasured *null = &outcome->null;
        fprintf(out, "<br>Null, which must miss a band, %s %s: ",
                jox_seeds_write(seeds, null->fewest_seeds, null->seeds),
                jox_noun_alone(noun, null->seeds, "seed"));
        jox_html_text(out, claim->null_text);
    }
    if (*claim->no_null) {
        fputs("<br>No null: ", out);
        jox_html_text(out, claim->no_null);
    }
    fputs("</small></p>\n", out);
    if (outcome->own.failure) {
        fputs("<pre class=out>", out);
        jox_html_text(out, outcome->own.failure);
        fputs("</pre>\n", out);
    }
    put_claim_figures(out, outcome);
    put_tried(out, outcome);
    jox_reproduce_put_pictures(out, all, outcome);
    put_claim_runs(out, all, outcome);
}

/* Writes a table of the engine's default parameters. */
static void put_defaults(FILE *out) {
    JoxForceOptions force = jox_force_default_options();
    fputs("<h2>Defaults of the engine</h2>\n<p>Common to all claims; the next table lists what "
          "scenes "
          "and behaviours set to other values.</p><div "
          "class=scroll><table><tr><th>parameter<th>value"
          "<th>unit<th>meaning</tr>\n",
          out);
    for (int p = 0; p < JOX_PARAM_COUNT; p++) {
        const JoxParameterInfo *info = &jox_parameters[p];
        fprintf(out, "<tr><td>%s<td class=n>%g<td>%s<td>%s</tr>\n", info->name, info->value,
                info->unit, info->meaning);
    }
    fprintf(out,
            "<tr><td>reach<td class=n>%g<td>m<td>gap over which a braced person passes a force on"
            "</tr>\n<tr><td>filter<td class=n>%g<td>s<td>time over which passed-on forces arrive"
            "</tr>\n<tr><td>iterations<td class=n>%u<td><td>passes over the contacts of a step"
            "</tr>\n</table></div>\n",
            (double)force.reach, (double)force.filter, force.iterations);
}

static bool write_claims_page(const JoxReproduction *all, const char *when, JoxText *error) {
    FILE *out = jox_plot_open(all->def->out, "index.html", error);
    uint32_t inside = 0;
    if (!out)
        return false;
    for (uint32_t o = 0; o < all->outcome_count; o++)
        inside += jox_outcome_holds(&all->outcomes[o]);
    jox_html_begin(out, "What Jostle reproduces");
    fprintf(out, "<p>%u of %u claims in band. ", inside, all->outcome_count);
    jox_html_text(out, when);
    fputs(".", out);
    if (all->cut.length) {
        fputs(" " JOX_SAYS_QUICK, out);
        jox_html_text(out, all->cut.data);
        fputs(".", out);
    }
    fprintf(out, "</p>\n<p>%u of %u figures with a band are in it.", all->count.inside,
            all->count.banded);
    fputs("</p>\n<div class=scroll><table><tr><th>claim<th>what<th>source<th>figures in band"
          "<th>verdict</tr>\n",
          out);
    for (uint32_t o = 0; o < all->outcome_count; o++) {
        const JoxOutcome *outcome = &all->outcomes[o];
        fprintf(out, "<tr><td><a href=\"#c%u\">", o);
        jox_html_text(out, outcome->claim->id);
        fputs("</a><td>", out);
        jox_html_text(out, outcome->claim->title);
        fputs("<td>", out);
        jox_html_text(out, outcome->claim->source);
        fprintf(out, "<td class=n>%u of %u<td class=%s>%s</tr>\n", outcome->count.inside,
                outcome->count.banded, jox_outcome_holds(outcome) ? "in" : "out",
                jox_outcome_verdict(outcome));
    }
    fputs("</table></div>\n", out);
    for (uint32_t o = 0; o < all->outcome_count; o++)
        put_claim(out, all, &all->outcomes[o]);
    jox_reproduce_put_failures(all, out);
    put_defaults(out);
    jox_reproduce_put_deviations(all, out);
    jox_html_end(out);
    return jox_plot_close(out, "index.html", error);
}

bool jox_reproduce_write(const JoxReproduction *all, JoxText *error) {
    char when[512];
    jox_reproduce_describe_run(all, when, sizeof when);
    return jox_plot_folder(all->def->out, error) && jox_reproduce_draw_plots(all, error) &&
           write_claims_page(all, when, error) && jox_reproduce_write_table(all, when, error) &&
           jox_reproduce_write_json(all, error);
}
