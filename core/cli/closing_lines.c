/* Prints the last lines of a run, and the costs of Lua functions. */
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "base/format/plurals.h"
#include "base/mem.h"
#include "cli/cli.h"

/* Prints hints on parts of behaviours that had no effect, one a line. */
static void print_hints(const JoScene *scene) {
    JoHints *hints = jo_scene_hints(scene);
    if (hints && hints->count)
        fputs("Hints on the behaviours:\n", stderr);
    for (uint32_t h = 0; hints && h < hints->count; h++) {
        const JoHint *hint = &hints->items[h];
        fprintf(stderr, "  %s:%d: %s. %s\n", hint->file, hint->line, hint->text, hint->way_out);
    }
    jo_free(hints);
}

void cli_print_closing(const JoScene *scene, const CliRunFiles *files) {
    const struct {
        const char *what, *path, *more;
    } all[] = {{"report", files->report, "/index.html"}, {"tables", files->data, ""},
               {"recording", files->record, ""},         {"input log", files->log, ""},
               {"checkpoints", files->checkpoints, ""},  {"figures", files->summary, ""}};
    JoxText text = {0}, lines = {0};
    char *closing = jo_scene_closing(scene);
    if (!closing)
        return;
    jox_text_add(&text, closing);
    const char *before = " Files: ";
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        if (!all[k].path || strcmp(all[k].path, "-") == 0 || access(all[k].path, F_OK) != 0)
            continue;
        jox_text_printf(&text, "%s%s %s%s", before, all[k].what, all[k].path, all[k].more);
        before = ", ";
    }
    if (*before == ',')
        jox_text_add(&text, ".");
    cli_wrap_text(&lines, text.data, text.length, 0, 0);
    fputs(lines.data, stderr);
    print_hints(scene);
    jox_text_free(&text);
    jox_text_free(&lines);
    jo_free(closing);
}

const char *cli_add_page_file(CliPageFiles *files, const char *what, const char *path) {
    if (!path)
        return NULL;
    JOX_RESERVE(files->items, files->capacity, files->count + 1);
    files->items[files->count] = (struct CliPageFile){what, jox_strdup(path)};
    return files->items[files->count++].path;
}

void cli_print_page_files(CliPageFiles *files, bool quiet) {
    JoxText text = {0}, lines = {0};
    for (size_t f = 0; f < files->count; f++) {
        const struct CliPageFile *file = &files->items[f];
        if (access(file->path, F_OK) == 0)
            jox_text_printf(&text, "%s %s %s", text.length ? "," : "Files:", file->what,
                            file->path);
        jox_free(file->path);
    }
    jox_free(files->items);
    if (text.length && !quiet) {
        jox_text_add(&text, ".");
        cli_wrap_text(&lines, text.data, text.length, 0, 0);
        fputs(lines.data, stderr);
    }
    jox_text_free(&text);
    jox_text_free(&lines);
}

static void print_lua_cost(const JoLuaCost *cost, double stepping) {
    fprintf(stderr, "  %-52.100s %10llu calls %8.0f ns each %9.2f ms %6.2f %%%s\n", cost->where,
            (unsigned long long)cost->calls,
            cost->calls ? cost->seconds * 1e9 / (double)cost->calls : 0.0, cost->seconds * 1e3,
            stepping > 0.0 ? 100.0 * cost->seconds / stepping : 0.0,
            cost->suspended  ? "  suspended"
            : cost->failures ? "  failed at times"
                             : "");
}

void cli_print_lua_costs(const JoScene *scene) {
    JoLuaCosts *costs = jo_scene_lua_costs(scene);
    double all = 0.0;
    if (costs && costs->count)
        fprintf(stderr,
                "Plain Lua functions, each with its share of the %.2f ms that the steps took, with "
                "the functions called as people come in:\n",
                costs->stepping * 1e3);
    for (uint32_t first = 0, last; costs && first < costs->count; first = last) {
        const JoLuaCost *items = costs->items;
        uint64_t calls = 0;
        double seconds = 0.0;
        char functions[JOX_NOUN], told[JOX_NOUN];
        for (last = first; last < costs->count && !strcmp(items[last].file, items[first].file);
             last++) {
            calls += items[last].calls;
            seconds += items[last].seconds;
        }
        all += seconds;
        fprintf(stderr, "%s (%s): %s, %s, %.2f ms, %.2f %% of the steps\n", items[first].behaviour,
                items[first].file, jox_noun(functions, last - first, "plain function"),
                jox_noun(told, calls, "call"), seconds * 1e3,
                costs->stepping > 0.0 ? 100.0 * seconds / costs->stepping : 0.0);
        for (uint32_t k = first; k < last; k++)
            print_lua_cost(&items[k], costs->stepping);
    }
    if (costs && costs->count)
        fprintf(stderr, "the rest of the steps, without plain functions: %.2f ms, %.2f %%\n",
                (costs->stepping - all) * 1e3,
                costs->stepping > 0.0 ? 100.0 * (1.0 - all / costs->stepping) : 100.0);
    if (costs && costs->count == 0)
        fputs("no behaviour has a plain function\n", stderr);
    jo_free(costs);
}
