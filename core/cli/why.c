/* The command `why`: simulates a scene to a time, and prints why agents stay in their states. */
#include <stdio.h>

#include "base/format/path.h"
#include "cli/cli.h"

typedef struct Why {
    JoSceneDef def;
    JoWhyDef asked;
    CliList sets, mods;
    const char *from;
    double at;
    uint64_t agent;
    bool of_scene, has_at, has_agent, quiet, trusted;
} Why;

static bool read_why_isa(void *options, const char *text, char why[160]) {
    return cli_read_isa(&((Why *)options)->def.isa, text, why);
}

static const CliOption OPTIONS[] = {
    {"agent", "ID", "ask about the agent with this id", CLI_TO(Why, agent),
     CLI_GIVEN(Why, has_agent), CLI_RANGE(0, UINT32_MAX)},
    {"group", "NAME", "ask about the people of this group, state by state",
     CLI_TO(Why, asked.group)},
    {"state", "NAME",
     "ask about the people in this state; if nobody is in it, about those who could go there",
     CLI_TO(Why, asked.state)},
    {"to", "NAME",
     "show the transitions to this state alone, of those who could go there; with --agent, or "
     "those "
     "to the next state on the shortest way there",
     CLI_TO(Why, asked.to)},
    {"at", "S", "ask after S simulated seconds", "the scene's duration, or the checkpoint",
     CLI_TO(Why, at), CLI_GIVEN(Why, has_at), CLI_RANGE(0, 1e7)},
    {"from", "CHECKPOINT",
     "go on from a checkpoint of `jostle run --checkpoint`, a file or their folder, instead of "
     "simulating SCENE from its beginning",
     CLI_TO(Why, from)},
    {"json", NULL, "print one JSON object", CLI_TO(Why, asked.json)},
    {"quiet", NULL, "print no progress", CLI_TO(Why, quiet)},
    CLI_ISA_OPTION(read_why_isa),
    CLI_TRUSTED_OPTION(Why),
    {"for a scene, as for `jostle run`:", .kind = CLI_HEADING},
    CLI_SCENE_OPTIONS(Why, def),
};

/* Confines the process to what the scene or the checkpoint needs; it writes nothing. */
static void confine_why(const Why *why) {
    CliReach reach = {0};
    JoxText above = {0};
    if (why->from) {
        jox_text_printf(&above, "%.*s/..", (int)jox_path_folder(why->from), why->from);
        cli_reach_folder(&reach, jox_path_folder(why->from) ? above.data : ".");
        cli_reach_file(&reach, why->from);
        cli_reach_folder(&reach, why->from);
        cli_reach_folder(&reach, ".");
    } else {
        cli_reach_def(&reach, &why->def);
    }
    cli_confine_work(&reach, why->trusted);
    jox_text_free(&above);
}

/* Simulates up to the time that is asked about; false with `error`. */
static bool simulate_until(const Why *why, JoScene *scene, JoError *error) {
    JoWorld *world = jo_scene_world(scene);
    const double dt = jo_scene_stats(scene).dt;
    const double at = why->has_at ? why->at
                      : why->from ? jo_world_time(world)
                                  : jo_scene_duration(scene);
    const uint64_t until = (uint64_t)(at / dt + 0.5);
    if (!why->quiet && until > jo_world_tick(world))
        jo_scene_show_progress(scene, (double)until * dt);
    bool ok = true;
    if (why->asked.has_agent)
        jo_scene_follow(scene, why->asked.agent);
    while (ok && jo_world_tick(world) < until && !cli_signal)
        ok = jo_scene_step(scene, error);
    return ok;
}

/* Answers for a scene that was loaded or resumed; returns an exit status. */
static int answer_why(const Why *why, JoScene *scene) {
    JoError error = {0};
    JoWorld *world = jo_scene_world(scene);
    if (why->has_at && why->at + 0.5 * jo_scene_stats(scene).dt < jo_world_time(world)) {
        fprintf(stderr, "jostle why: the checkpoint is of %g s, after the %g s asked about\n",
                jo_world_time(world), why->at);
        return JO_USAGE;
    }
    if (!simulate_until(why, scene, &error))
        return cli_report_error(&cli_why, &error, false);
    char *text = cli_signal ? NULL : jo_scene_why(scene, &why->asked, &error);
    if (!cli_signal && !text)
        return cli_report_error(&cli_why, &error, false);
    const int status = text ? cli_write(&cli_why, "-", text) : JO_OK;
    jo_free(text);
    return status;
}

static int explain_scene(Why *why) {
    JoError error = {0};
    char *note = NULL;
    cli_catch_signals(false);
    confine_why(why);
    if (why->asked.json)
        cli_output_is_data();
    JoScene *scene = why->from ? jo_scene_resume(&why->def, why->from, &note, &error)
                               : jo_scene_load(&why->def, &error);
    if (!scene)
        return cli_report_error(&cli_why, &error, !why->from);
    const int status = answer_why(why, scene);
    jo_free(note);
    jo_scene_free(scene);
    return cli_add_signal_status(status);
}

/* Returns what is wrong with the options together; NULL: nothing. */
static const char *find_why_misuse(const Why *why, const CliList *plain) {
    const bool many = why->asked.group || why->asked.state;
    return why->from && plain->count ? "--from goes without SCENE: the checkpoint has its scene"
           : why->from && (why->of_scene || why->def.has_seed || why->def.has_dt)
               ? "--from goes without options of a scene: the checkpoint has them"
           : !why->from && plain->count == 0 ? "no scene given"
           : why->has_agent && many
               ? "--agent asks about one agent: it goes with --to, not with --group or --state"
           : !why->has_agent && !many && !why->asked.to
               ? "say about whom: --agent ID, --group NAME, --state NAME or --to NAME"
               : NULL;
}

static int run_why(int argc, char **argv) {
    Why why = {.def = jo_default_scene_def(), .asked = jo_default_why_def()};
    CliList plain = {0};
    int status = cli_parse(&cli_why, argc, argv, &why, &plain);
    if (status == CLI_GO_ON) {
        const char *wrong = find_why_misuse(&why, &plain);
        why.asked.has_agent = why.has_agent;
        why.asked.agent = (uint32_t)why.agent;
        why.def.overrides = why.sets.items;
        why.def.override_count = why.sets.count;
        why.def.mods = why.mods.items;
        why.def.mod_count = why.mods.count;
        why.def.no_density = true;
        if (!wrong && !why.from)
            why.def.path = cli_scene(&cli_why, plain.items[0], &why.mods);
        status = wrong                      ? cli_report_misuse(&cli_why, wrong)
                 : why.from || why.def.path ? explain_scene(&why)
                                            : JO_INPUT;
    }
    cli_free(&cli_why, &why, &plain);
    return status;
}

const CliCommand cli_why = {
    .name = "why",
    .what = "explain why agents stay in their states",
    .usage = "SCENE --agent ID [--to NAME] [--at S] [options]\n"
             "SCENE [--group NAME] [--state NAME] [--to NAME] [--at S] [options]\n"
             "--from CHECKPOINT ...",
    .about =
        "Simulates a scene to a time and explains why transitions do not fire: how long the agents "
        "have been in their state, and for every transition out of it each term of its condition, "
        "with its value and its bound, and what there is where it does not hold. The transition "
        "that is nearest to firing comes first, and within it the terms that do not hold. Of many "
        "people, how many hold each term. Of an agent also where its steering leads, and what "
        "keeps "
        "take, kick, throw, grasp and face from their targets. Ids of agents are on the live page, "
        "in recordings, and "
        "in what `why` says of groups and states.",
    .notes = "examples:\n"
             "  jostle why office --agent 17 --at 30\n"
             "  jostle why tawaf --state ToStone --at 60\n"
             "  jostle why --from checkpoints --group people --json\n"
             "\n"
             "exit status: 0 answered, 1 the run failed, 2 wrong usage, also an agent, group or "
             "state that is not there, 3 bad input",
    .options = OPTIONS,
    .option_count = sizeof OPTIONS / sizeof *OPTIONS,
    .takes = "scene",
    .least = 0,
    .most = 1,
    .run = run_why,
};
