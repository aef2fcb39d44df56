/* The command `graph`: draws the states and transitions of a behaviour by jo_graph. */
#include <stdio.h>
#include <string.h>

#include "base/format/path.h"
#include "cli/cli.h"

typedef struct Graph {
    JoSceneDef def;
    CliList sets, mods;
    const char *out, *behaviour;
    bool of_scene, text, trusted;
} Graph;

static const CliOption OPTIONS[] = {
    {"out", "FILE",
     "FILE.svg, FILE.png or FILE.pdf, drawn by the program dot of Graphviz; or FILE.dot, the graph "
     "as text",
     "NAME.svg here", CLI_TO(Graph, out), .writes = "svg png pdf dot"},
    {"dot", NULL, "print the graph as text, in the language of Graphviz; draw nothing",
     CLI_TO(Graph, text)},
    {"behaviour", "NAME", "of a scene: the behaviour to draw, by its name or its file",
     "the only one", CLI_TO(Graph, behaviour)},
    CLI_TRUSTED_OPTION(Graph),
    {"for a scene, as for `jostle run`:", .kind = CLI_HEADING},
    CLI_SCENE_OPTIONS(Graph, def),
};

static bool ends_with(const char *text, const char *end) {
    const size_t n = strlen(text), m = strlen(end);
    return n > m && strcmp(text + n - m, end) == 0;
}

/* Makes the default output, NAME.svg in the present folder, of the behaviour's name or the file's.
 */
static void make_default_output(const Graph *graph, char out[512]) {
    const char *name = jox_path_name(graph->behaviour ? graph->behaviour : graph->def.path);
    const char *dot = strrchr(name, '.');
    snprintf(out, 512, "%.*s.svg", dot && dot > name && dot - name < 400 ? (int)(dot - name) : 400,
             name);
}

/* Confines the process to reading the files, and to drawing into the output's folder. */
static void confine_graph(const Graph *graph, const char *out) {
    CliReach reach = {CLI_READING, .programs = true};
    cli_reach_def(&reach, &graph->def);
    cli_reach_output(&reach, out);
    cli_confine_work(&reach, graph->trusted);
}

static int draw_graph(const Graph *graph) {
    JoError error = {0};
    char usual[512];
    make_default_output(graph, usual);
    const char *out = graph->text ? "-" : graph->out ? graph->out : usual;
    int status = cli_check_apart(&cli_graph, &out, 1, &graph->def.path, 1, NULL);
    if (status != JO_OK)
        return status;
    if (graph->text)
        cli_output_is_data();
    confine_graph(graph, out);
    char *text = jo_graph(&graph->def, graph->behaviour, &error);
    if (!text)
        return cli_report_error(&cli_graph, &error, *error.file != 0);
    if (graph->text || ends_with(out, ".dot"))
        status = cli_write(&cli_graph, out, text);
    else if (!jo_graph_draw(text, out, &error))
        status = cli_report_error(&cli_graph, &error, false);
    jo_free(text);
    return status;
}

static int run_graph(int argc, char **argv) {
    Graph graph = {.def = jo_default_scene_def()};
    CliList plain = {0};
    int status = cli_parse(&cli_graph, argc, argv, &graph, &plain);
    if (status == CLI_GO_ON) {
        const bool is_lua = ends_with(plain.items[0], ".lua");
        const bool of_scene = graph.of_scene || graph.def.has_seed || graph.def.has_dt;
        const char *wrong = graph.text && graph.out ? "--dot prints the graph: take --out FILE.dot"
                            : is_lua && (graph.behaviour || of_scene)
                                ? "--behaviour and the options of scenes are for scenes (.yaml); "
                                  "this is a behaviour"
                                : NULL;
        graph.def.overrides = graph.sets.items;
        graph.def.override_count = graph.sets.count;
        graph.def.mods = graph.mods.items;
        graph.def.mod_count = graph.mods.count;
        graph.def.no_density = true;
        if (!wrong)
            graph.def.path =
                is_lua ? plain.items[0] : cli_scene(&cli_graph, plain.items[0], &graph.mods);
        if (is_lua && !wrong && !cli_check_exists(&cli_graph, graph.def.path))
            graph.def.path = NULL;
        status = wrong            ? cli_report_misuse(&cli_graph, wrong)
                 : graph.def.path ? draw_graph(&graph)
                                  : JO_INPUT;
    }
    cli_free(&cli_graph, &graph, &plain);
    return status;
}

const CliCommand cli_graph = {
    .name = "graph",
    .what = "draw the states and transitions of a behaviour",
    .usage = "BEHAVIOUR.lua|SCENE [--behaviour NAME] [--out FILE | --dot]",
    .about =
        "Draws a behaviour as a graph: a box for each state, in its colour, with what it does; an "
        "arrow for each transition, with its condition as the file has it, its chance and what it "
        "sets. A dot marks where agents begin, a double frame where they leave the world or take "
        "up another behaviour; numbers are the order in which the transitions of a state are "
        "tried. States of a machine within a state stand in a frame. Runs nothing.",
    .notes = "examples:\n"
             "  jostle graph behaviours/tawaf.lua\n"
             "  jostle graph families --behaviour companion --out companion.png\n"
             "  jostle graph behaviours/dodgeball.lua --dot | dot -Tpdf > dodgeball.pdf\n"
             "\n"
             "exit status: 0 done, 1 it could not be drawn or written, 2 wrong usage, 3 bad input",
    .options = OPTIONS,
    .option_count = sizeof OPTIONS / sizeof *OPTIONS,
    .takes = "behaviour or scene",
    .least = 1,
    .most = 1,
    .none_said = "no behaviour and no scene given",
    .run = run_graph,
};
