/* Writes the results of jo_reproduce as a Markdown table and as JSON. */
#include <math.h>
#include <stdio.h>

#include "base/format/json_writer.h"
#include "base/format/quote.h"
#include "picture/plot.h"
#include "validate/reproduce.h"

void jox_reproduce_put_band(FILE *out, const JoxClaimFigure *figure, const char *dash) {
    if (figure->low == -INFINITY && figure->high == INFINITY)
        fputs(dash, out);
    else if (figure->low == -INFINITY)
        fprintf(out, "at most %.4g", figure->high);
    else if (figure->high == INFINITY)
        fprintf(out, "at least %.4g", figure->low);
    else
        fprintf(out, "%.4g to %.4g", figure->low, figure->high);
    if (figure->sure)
        fputs(", with the 95 % bound", out);
}

void jox_reproduce_add_counts(const JoxReproduction *all, JoxText *out) {
    const char *before = ": ";
    if (all->count.banded == 0)
        return;
    jox_text_printf(out, "%u of %u figures in band (%.1f %%)", all->count.inside, all->count.banded,
                    100.0 * all->count.inside / all->count.banded);
    for (uint32_t o = 0; o < all->outcome_count; o++) {
        const JoxFigureCount *count = &all->outcomes[o].count;
        if (count->banded == 0)
            continue;
        jox_text_printf(out, "%s%s %u of %u", before, all->outcomes[o].claim->id, count->inside,
                        count->banded);
        before = ", ";
    }
}

const char *jox_figure_verdict(const JoxClaimFigure *figure, const JoxVerdict *verdict) {
    if (figure->reported)
        return "reported";
    if (verdict->thin)
        return verdict->inside ? "in band, thin" : "misses, thin";
    return verdict->inside ? "in band" : "misses";
}

static void put_markdown_cell(FILE *out, const char *text) {
    jox_quote_put(out, jox_quote_markdown, text);
    fputs(" | ", out);
}

/* Writes table.md: a row per figure, and below it what was tried for claims that miss, and a table
   by scene. */
bool jox_reproduce_write_table(const JoxReproduction *all, const char *when, JoxText *error) {
    FILE *out = jox_plot_open(all->def->out, "table.md", error);
    if (!out)
        return false;
    jox_quote_put(out, jox_quote_markdown, when);
    fputc('.', out);
    if (all->cut.length) {
        fputs(" " JOX_SAYS_QUICK, out);
        jox_quote_put(out, jox_quote_markdown, all->cut.data);
        fputc('.', out);
    }
    JoxText counts = {0};
    jox_reproduce_add_counts(all, &counts);
    if (counts.length)
        fputs("\n\n", out);
    jox_quote_put(out, jox_quote_markdown, counts.length ? counts.data : "");
    jox_text_free(&counts);
    fputs(
        "\n\n| claim | haste | constants | figure | source | mean | 95 % | seeds | band | verdict "
        "| null |\n|---|---|---|---|---|---|---|---|---|---|---|\n",
        out);
    for (uint32_t o = 0; o < all->outcome_count; o++)
        for (uint32_t f = 0; f < all->outcomes[o].claim->figure_count; f++) {
            const JoxClaim *claim = all->outcomes[o].claim;
            const JoxClaimFigure *figure = &claim->figures[f];
            const JoxVerdict *v = &all->outcomes[o].own.verdicts[f];
            char bound[JOX_BOUND_SIZE], seeds[JOX_SEEDS_SIZE];
            fputs("| ", out);
            jox_quote_put(out, jox_quote_markdown, f ? "" : claim->id);
            fputc(' ', out);
            put_markdown_cell(out, f ? "" : claim->title);
            put_markdown_cell(out, f ? "" : claim->level);
            put_markdown_cell(out, f                    ? ""
                                   : *claim->calibrated ? "calibrated"
                                   : *claim->held_out   ? "held out"
                                                        : "");
            put_markdown_cell(out, *figure->what ? figure->what : figure->name);
            put_markdown_cell(out, figure->expected);
            if (isfinite(v->mean)) {
                fprintf(out, "%.4g ", v->mean);
                put_markdown_cell(out, figure->unit);
            } else {
                fputs("not measured | ", out);
            }
            jox_bound_write(bound, v->bound);
            fprintf(out, "%s | %s | ", bound, jox_seeds_write(seeds, v->seeds, v->most_seeds));
            jox_reproduce_put_band(out, figure, "");
            fprintf(out, " | %s | ", jox_figure_verdict(figure, v));
            const JoxVerdict *null = &all->outcomes[o].null.verdicts[f];
            if (all->outcomes[o].null.runs && !isfinite(null->mean))
                fputs("not measured", out);
            else if (all->outcomes[o].null.runs)
                fprintf(out, "%.4g%s", null->mean,
                        !figure->reported && null->inside ? ", in band too" : "");
            fputs(" |\n", out);
        }
    for (uint32_t o = 0; o < all->outcome_count; o++) {
        const JoxClaim *claim = all->outcomes[o].claim;
        if (all->outcomes[o].inside || claim->tried_count == 0)
            continue;
        fputc('\n', out);
        jox_quote_put(out, jox_quote_markdown, claim->id);
        fputs(" misses. What was tried:\n\n", out);
        for (uint32_t t = 0; t < claim->tried_count; t++) {
            fputs("- ", out);
            jox_quote_put(out, jox_quote_markdown, claim->tried[t]);
            fputc('\n', out);
        }
    }
    jox_reproduce_write_failures(all, out);
    return jox_plot_close(out, "table.md", error);
}

static void write_json_count(JoxJson *json, const JoxFigureCount *count) {
    jox_json_integer(json, "figures_in_band", count->inside);
    jox_json_integer(json, "figures_with_band", count->banded);
}

/* Writes results.json: verdicts by claim and figure, and, as "all", the count of all figures. */
bool jox_reproduce_write_json(const JoxReproduction *all, JoxText *error) {
    JoxText text = {0};
    JoxJson json = jox_json_begin(&text, 1);
    jox_json_object(&json, NULL);
    for (uint32_t o = 0; o < all->outcome_count; o++) {
        const JoxOutcome *outcome = &all->outcomes[o];
        jox_json_object(&json, outcome->claim->id);
        jox_json_bool(&json, "inside", outcome->inside);
        jox_json_bool(&json, "proves_nothing", outcome->proves_nothing);
        write_json_count(&json, &outcome->count);
        jox_json_object(&json, "figures");
        for (uint32_t f = 0; f < outcome->claim->figure_count; f++) {
            const JoxVerdict *v = &outcome->own.verdicts[f];
            jox_json_object(&json, outcome->claim->figures[f].name);
            jox_json_number(&json, "mean", v->mean);
            jox_json_number(&json, "least", v->least);
            jox_json_number(&json, "most", v->most);
            jox_json_number(&json, "bound", v->bound);
            jox_json_integer(&json, "seeds", v->seeds);
            jox_json_bool(&json, "thin", v->thin);
            jox_json_bool(&json, "inside", v->inside);
            if (outcome->null.runs)
                jox_json_number(&json, "null", outcome->null.verdicts[f].mean);
            jox_json_end(&json);
        }
        jox_json_end(&json);
        jox_json_end(&json);
    }
    jox_json_object(&json, "all");
    write_json_count(&json, &all->count);
    jox_json_end(&json);
    jox_json_end(&json);
    jox_text_append(&text, "\n", 1);
    FILE *out = jox_plot_open(all->def->out, "results.json", error);
    if (out)
        fputs(text.data, out);
    jox_text_free(&text);
    return out && jox_plot_close(out, "results.json", error);
}
