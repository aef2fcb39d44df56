/* A scene on its live page, driven by a client: messages, commands, and that the input log replays
   to the same state. */
#include "unit/live_session.h"

static void new_page_gets_scene_errors_frames_and_status(void **state) {
    (void)state;
    write_test_file("scene.yaml", SCENE);
    write_test_file("walker.lua", WALKER);
    begin_session(0);
    join_session();
    int kind;
    size_t length;
    char *message = get_message(session.fd, &kind, &length, 20.0);
    assert_non_null(message);
    assert_int_equal(kind, FRAME_TEXT); /* the scene message comes first */
    assert_non_null(
        strstr(message, "{\"type\": \"scene\", \"protocol\": 8, \"session\": \"live\""));
    free(message);
    wait_for_json("\"type\": \"errors\"", "\"errors\": []");
    uint32_t first = wait_for_tick();
    double begun = clock_now();
    uint32_t tick = first;
    while (tick < first + 20)
        tick = wait_for_tick();
    double took = clock_now() - begun; /* 20 steps of 0.05 s in real time */
    assert_true(took > 0.8);
    const char *status = wait_for_json("\"type\": \"status\"", NULL);
    assert_true(read_member(status, "agents") == 30);
    assert_non_null(strstr(status, "\"paused\": false"));
    end_session();
    assert_true(session.good);
    assert_non_null(session.summary);
    jo_free(session.summary);
}

static void pause_step_and_speed_commands(void **state) {
    (void)state;
    begin_session(0);
    join_session();
    send_command("{\"do\": \"pause\", \"on\": true}");
    wait_for_json("\"status\"", "\"paused\": true");
    double tick = read_member(wait_for_json("\"status\"", "\"paused\": true"), "tick");
    usleep(300000);
    assert_true(read_member(wait_for_json("\"status\"", NULL), "tick") == tick);
    send_command("{\"do\": \"step\", \"n\": 7}");
    double then = tick;
    for (int i = 0; i < 8 && then == tick; i++)
        then = read_member(wait_for_json("\"status\"", NULL), "tick");
    assert_true(read_member(wait_for_json("\"status\"", "\"paused\": true"), "tick") == tick + 7);
    send_command("{\"do\": \"speed\", \"factor\": 10}");
    send_command("{\"do\": \"pause\", \"on\": false}");
    wait_for_json("\"status\"", "\"paused\": false");
    double from = read_member(last, "time");
    while (read_member(wait_for_json("\"status\"", NULL), "time") < from + 5.0)
        ;
    assert_true(read_member(last, "speed") == 10);
    send_command("{\"do\": \"speed\", \"factor\": -1}");
    wait_for_json("\"refused\"", "\"do\": \"speed\"");
    send_command("{\"do\": \"step\", \"n\": 1e9}");
    wait_for_json("\"refused\"", "\"do\": \"step\"");
    send_command("{\"do\": \"dance\"}");
    wait_for_json("\"refused\"", "no such command");
    send_command("{\"do\": \"colour\", \"by\": \"taste\"}");
    wait_for_json("\"refused\"", "\"do\": \"colour\"");
    send_command("not a command");
    double dropped = 0;
    for (int i = 0; i < 8 && dropped < 2; i++)
        dropped = read_member(wait_for_json("\"status\"", NULL), "dropped");
    assert_true(dropped == 2); /* the unknown command and the text that is no command */
    end_session();
    jo_free(session.summary);
}

static void colour_and_field_commands(void **state) {
    (void)state;
    begin_session(0);
    join_session();
    wait_for_json("\"type\": \"scene\"", NULL);
    send_command("{\"do\": \"field\", \"of\": \"pressure\"}");
    int kind;
    size_t length;
    bool came = false;
    for (double until = clock_now() + 20.0; clock_now() < until && !came;) {
        char *message = get_message(session.fd, &kind, &length, 20.0);
        assert_non_null(message);
        uint32_t head[2] = {0};
        memcpy(head, message, length >= 8 && kind == FRAME_BINARY ? 8 : 0);
        came = kind == FRAME_BINARY && head[0] == 3;
        if (came)
            assert_int_equal(head[1], 1); /* pressure, not density */
        free(message);
    }
    assert_true(came);
    send_command("{\"do\": \"colour\", \"by\": \"speed\"}");
    send_command("{\"do\": \"field\", \"of\": \"none\"}");
    send_command("{\"do\": \"field\", \"of\": \"smell\"}");
    wait_for_json("\"refused\"", "\"do\": \"field\"");
    for (double until = clock_now() + 0.7; clock_now() < until;) {
        char *message = get_message(session.fd, &kind, &length, 20.0);
        assert_non_null(message);
        uint32_t head = 0;
        memcpy(&head, message, length >= 8 && kind == FRAME_BINARY ? 4 : 0);
        free(message);
        assert_int_not_equal(head, 3);
    }
    end_session();
    jo_free(session.summary);
}

static void finished_scene_pauses_and_restarts(void **state) {
    (void)state;
    begin_session(0.5);
    join_session();
    wait_for_json("\"say\"", "0.5 s are over");
    wait_for_json("\"status\"", "\"paused\": true");
    assert_true(read_member(last, "tick") == 10);
    assert_non_null(strstr(last, "\"end\": {\"why\": \"time\", \"failure\": null, \"time\": 0.5, "
                                 "\"seed\": 3, \"people\": 30, \"left\": 0, \"inside\": 30, "
                                 "\"last\": null"));
    assert_non_null(strstr(last, "scene.yaml --seed 3 --for 0.5 --report report\""));
    assert_non_null(strstr(last, "changed.yaml --seed 3 --seeds 10 --for 0.5 --out compared\""));
    send_command("{\"do\": \"restart\", \"seed\": 77}");
    wait_for_json("\"type\": \"scene\"", "\"seed\": 77, \"restarts\": true");
    wait_for_json("\"say\"", "0.5 s are over");
    send_command("{\"do\": \"restart\", \"seed\": 0.5}");
    wait_for_json("\"refused\"", "\"do\": \"restart\"");
    send_command("{\"do\": \"pause\", \"on\": false}"); /* continues beyond its end */
    while (read_member(wait_for_json("\"status\"", NULL), "time") < 0.7)
        ;
    assert_non_null(strstr(last, "\"end\": null"));
    end_session();
    assert_true(session.good);
    jo_free(session.summary);
}

/* Reads the first bytes of a file of the folder. */
static const char *read_test_file(const char *name, char text[4096]) {
    FILE *file = fopen(test_path(name), "r");
    assert_non_null(file);
    text[fread(text, 1, 4095, file)] = '\0';
    fclose(file);
    return text;
}

/* A restart writes to files of its own: the first run's, and files of others, stay as they are. */
static void restart_keeps_files_of_earlier_runs(void **state) {
    (void)state;
    write_test_file("log-2.txt", "mine");
    begin_session(0);
    join_session();
    send_command("{\"do\": \"input\", \"line\": \"open gate\"}");
    wait_for_json("\"status\"", "\"gate\": true");
    send_command("{\"do\": \"restart\", \"seed\": 77}");
    wait_for_json("\"say\"", "Restarted; written to ");
    assert_non_null(strstr(last, "/log-3.txt\""));
    end_session();
    jo_free(session.summary);
    char text[4096];
    assert_string_equal(read_test_file("log-2.txt", text), "mine");
    assert_non_null(strstr(read_test_file("log.txt", text), "open gate"));
    assert_non_null(strstr(read_test_file("log-3.txt", text), "77"));
    assert_null(strstr(text, "open gate"));
    unlink(test_path("log-2.txt"));
    unlink(test_path("log-3.txt"));
}

static void run_ends_once_all_have_left(void **state) {
    (void)state;
    write_test_file("scene.yaml", "jostle: 1\nduration: 1000\n"
                                  "places: {door: {polygon: [[0, 0], [4, 0], [4, 4], [0, 4]]}}\n"
                                  "groups: {people: {behaviour: walker.lua, count: 5, fill: grid, "
                                  "in: door}}\n"
                                  "sources: [{at: door, like: people, times: [0.5]}]\n");
    write_test_file("walker.lua",
                    "return machine { name = \"walker\", version = 1, start = \"Go\",\n"
                    "  states = { Go = { steer = hold, { to = \"Out\", when = after "
                    "(0.2) } }, Out = { removes = true } } }\n");
    begin_session(0);
    join_session();
    wait_for_json("\"say\"", "everybody has left");
    wait_for_json("\"status\"", "\"end\": {\"why\": \"left\""); /* not before the source ends */
    assert_non_null(strstr(last, "\"paused\": true"));
    assert_non_null(strstr(last, "\"people\": 6, \"left\": 6, \"inside\": 0"));
    assert_non_null(strstr(last, "\"exits\": [{\"name\": \"door\", \"people\": 6, \"last\": "));
    const char *density = strstr(last, "\"density\": {");
    assert_non_null(density);
    assert_true(read_member(density, "most") > 0.2);
    assert_true(strstr(density, "\"where\": \", in door\""));
    const double left_at = read_member(last, "time");
    send_command("{\"do\": \"pause\", \"on\": false}"); /* goes on, and is not paused again */
    while (read_member(wait_for_json("\"status\"", NULL), "time") < left_at + 0.3)
        ;
    assert_non_null(strstr(last, "\"paused\": false"));
    end_session();
    jo_free(session.summary);
    write_test_file("scene.yaml", SCENE);
    write_test_file("walker.lua", WALKER);
}

static void reload_is_told_as_data(void **state) {
    (void)state;
    begin_session(0);
    join_session();
    wait_for_json("\"errors\"", "\"errors\": []");
    JoxText text = {0};
    jox_text_add(&text, WALKER);
    memcpy(strstr(text.data, "1.2"), "1.0", 3);
    write_test_file("walker.lua", text.data);
    wait_for_json("\"type\": \"reloaded\"", "walker.lua\", \"time\": ");
    assert_non_null(strstr(last, "\"machine\": \"walker\", \"before\": [{\"state\": \"Stand\", "
                                 "\"people\": 30}, {\"state\": \"Walk\", \"people\": 0}], "
                                 "\"after\": [{\"state\": \"Stand\", \"people\": 30}"));
    text.length = 0;
    jox_text_add(&text, SCENE);
    memcpy(strstr(text.data, "[0, 20]]}"), "[0, 19]]}", 9);
    write_test_file("scene.yaml", text.data);
    wait_for_json("\"type\": \"reloaded\"", "scene.yaml\", \"time\": ");
    assert_non_null(strstr(last, "\"done\": \"places\", \"later\": \"where people start"));
    jox_text_add(&text, "floor: grass\nscenery: [{kind: tree, at: [2, 3]}]\n");
    write_test_file("scene.yaml", text.data);
    wait_for_json("\"type\": \"reloaded\"", "scene.yaml\", \"time\": ");
    assert_non_null(strstr(last, "\"done\": \"floor, scenery\", \"later\": \"\""));
    end_session();
    jox_text_free(&text);
    jo_free(session.summary);
    write_test_file("scene.yaml", SCENE);
    write_test_file("walker.lua", WALKER);
}

/* Sums the pushes on an agent at a tick in the input log, N. */
static void sum_logged_pushes(double tick, uint32_t agent, double sum[2]) {
    FILE *file = fopen(test_path("log-2.txt"), "r"); /* of the run after the restart */
    assert_non_null(file);
    char line[2048];
    sum[0] = sum[1] = 0.0;
    while (fgets(line, sizeof line, file)) {
        double at, x, y;
        uint32_t pushed;
        if (sscanf(line, "%lf push %u %lf %lf", &at, &pushed, &x, &y) == 4 && at == tick &&
            pushed == agent) {
            sum[0] += x;
            sum[1] += y;
        }
    }
    fclose(file);
}

static void repeated_push_counts_once_per_step(void **state) {
    (void)state;
    JoxText scene = {0};
    const char *view = strstr(SCENE, "view:"), *rest = strchr(view, '\n') + 1;
    jox_text_printf(&scene, "%.*sview: {tools: [push]}\n%s", (int)(view - SCENE), SCENE, rest);
    write_test_file("scene.yaml", scene.data);
    jox_text_free(&scene);
    begin_session(0);
    join_session();
    send_command("{\"do\": \"restart\"}");
    send_command("{\"do\": \"pause\", \"on\": true}");
    wait_for_json("\"status\"", "\"paused\": true");
    const double tick = read_member(last, "tick");
    for (int n = 0; n < 20; n++) {
        send_command("{\"do\": \"input\", \"line\": \"push 1 %d -75.25\"}", 100 + n);
        send_command("{\"do\": \"input\", \"line\": \"push 2 0 300\"}");
    }
    send_command("{\"do\": \"step\", \"n\": 1}");
    while (read_member(wait_for_json("\"status\"", NULL), "tick") == tick)
        ;
    send_command("{\"do\": \"input\", \"line\": \"push 1 50 0\"}");
    send_command("{\"do\": \"input\", \"line\": \"push 1 1 2 3\"}");
    wait_for_json("\"refused\"", "push");
    end_session();
    assert_true(session.good);
    jo_free(session.summary);
    double sum[2];
    sum_logged_pushes(tick, 1, sum);
    assert_true(sum[0] == 119.0 && sum[1] == -75.25);
    sum_logged_pushes(tick, 2, sum);
    assert_true(sum[0] == 0.0 && sum[1] == 300.0);
    sum_logged_pushes(tick + 1, 1, sum);
    assert_true(sum[0] == 50.0 && sum[1] == 0.0);
    unlink(test_path("log-2.txt"));
    write_test_file("scene.yaml", SCENE);
}

static void input_log_replays_to_the_same_hash(void **state) {
    (void)state;
    begin_session(0);
    join_session();
    send_command("{\"do\": \"input\", \"line\": \"signal go\"}");
    send_command("{\"do\": \"input\", \"line\": \"open gate\"}");
    wait_for_json("\"status\"", "\"gate\": true");
    send_command("{\"do\": \"input\", \"line\": \"push 1 300 0\"}"); /* a tool that the scene does
                                                                        not allow */
    wait_for_json("\"refused\"", "view: {tools: [push]}");
    send_command("{\"do\": \"input\", \"line\": \"open window\"}");
    wait_for_json("\"refused\"", "window");
    send_command("{\"do\": \"input\", \"line\": \"files 1\"}");
    wait_for_json("\"refused\"", "\"do\": \"input\"");
    send_command("{\"do\": \"input\", \"line\": \"set walker Walk speed 0.8\"}");
    send_command(
        "{\"do\": \"lua\", \"machine\": \"walker\", \"state\": \"Walk\", \"parameter\": \"speed\","
        " \"value\": 0.8}");
    wait_for_json("\"lua\"", "speed = 0.8");
    usleep(400000);
    send_command("{\"do\": \"pause\", \"on\": true}");
    wait_for_json("\"status\"", "\"paused\": true");
    double ticks = read_member(last, "tick");
    end_session();
    assert_true(session.good);
    const char *live = strstr(session.summary, "\"hash\": ");
    assert_non_null(live);

    JoSceneDef def = jo_default_scene_def();
    def.path = test_path("scene.yaml");
    def.input_log = test_path("log.txt");
    def.named_mods_only = true;
    JoError error = {0};
    JoScene *scene = jo_scene_load(&def, &error);
    if (!scene)
        fail_msg("%s", error.text);
    for (int i = 0; i < (int)ticks; i++)
        assert_true(jo_scene_step(scene, &error));
    char *summary = jo_scene_summary(scene);
    const char *again = strstr(summary, "\"hash\": ");
    assert_int_equal(strncmp(live, again, 26), 0);
    assert_true(read_member(session.summary, "steps") == ticks);
    jo_free(summary);
    jo_free(session.summary);
    jo_scene_free(scene);
}

static void each_page_inspects_its_own_agent(void **state) {
    (void)state;
    begin_session(0);
    join_session();
    send_command("{\"do\": \"inspect\", \"slot\": 4}");
    wait_for_json("\"inspect\"", "\"agent\": {\"id\": 4, \"slot\": 4");
    wait_for_json("\"inspect\"", "\"seen\": true"); /* after the next step */
    int first = session.fd;
    join_session();
    send_command("{\"do\": \"inspect\", \"slot\": 7}");
    wait_for_json("\"inspect\"", "\"agent\": {\"id\": 7, \"slot\": 7");
    int second = session.fd;
    session.fd = first; /* the first page still has its agent, and ends its own inspection */
    wait_for_json("\"inspect\"", "\"agent\": {\"id\": 4, \"slot\": 4");
    wait_for_json("\"inspect\"", "\"agent\": {\"id\": 4, \"slot\": 4");
    send_command("{\"do\": \"inspect\", \"slot\": null}");
    wait_for_json("\"inspect\"", "\"agent\": null");
    session.fd = second;
    wait_for_json("\"inspect\"", "\"agent\": {\"id\": 7, \"slot\": 7");
    close(first);
    send_command("{\"do\": \"pause\", \"on\": true}");
    wait_for_json("\"status\"", "\"paused\": true");
    send_command("{\"do\": \"inspect\", \"slot\": 9}"); /* shown at once, in a pause too */
    wait_for_json("\"inspect\"", "\"seen\": true");
    send_command("{\"do\": \"inspect\", \"slot\": 1000000}");
    wait_for_json("\"inspect\"", "\"agent\": null");
    end_session();
    jo_free(session.summary);
}

static void file_errors_are_sent_until_mended(void **state) {
    (void)state;
    char wrong[1024];
    begin_session(0);
    join_session();
    wait_for_json("\"errors\"", "\"errors\": []");
    snprintf(wrong, sizeof wrong, "%s", WALKER);
    memcpy(strstr(wrong, "away_from"), "awax_from", 9);
    write_test_file("walker.lua", wrong);
    wait_for_json("\"type\": \"errors\"", "walker.lua\", \"line\": 5, \"column\": 22");
    assert_non_null(strstr(last, "awax_from"));
    assert_non_null(strstr(last, "\"source\": \"    Walk = { steer = awax_from \\\"yard\\\" },\""));
    assert_non_null(strstr(last, "\"hint\": \"Did you mean 'away_from'"));
    int first = session.fd;
    join_session(); /* a later page gets the errors too */
    wait_for_json("\"type\": \"errors\"", "awax_from");
    close(first);
    send_command("{\"do\": \"pause\", \"on\": true}"); /* files are loaded in a pause too */
    wait_for_json("\"status\"", "\"paused\": true");
    write_test_file("scene.yaml", "jostle: 1\nnonsense: 3\n");
    wait_for_json("\"type\": \"errors\"", "nonsense");
    assert_non_null(strstr(last, "awax_from")); /* errors of the other file stay */
    send_command("{\"do\": \"restart\"}");      /* fails: the present run goes on */
    wait_for_json("\"refused\"", "\"do\": \"restart\"");
    write_test_file("scene.yaml", SCENE);
    write_test_file("walker.lua", WALKER);
    wait_for_json("\"type\": \"errors\"", "\"errors\": []");
    assert_true(read_member(wait_for_json("\"status\"", NULL), "tick") > 0);
    end_session();
    assert_true(session.good);
    jo_free(session.summary);
}

static void view_that_cannot_start_returns_an_error(void **state) {
    (void)state;
    write_test_file("scene.yaml", "jostle: 1\nnonsense: 3\n");
    begin_session(0);
    end_session();
    assert_false(session.good);
    assert_int_equal(session.error.code, JO_INPUT);
    assert_int_equal(session.error.line, 2);
    JoError error = {0};
    JoViewDef def = jo_default_view_def();
    def.scene.path = "x.yaml";
    def.page = "/nowhere";
    assert_false(jo_view(&def, &error));
    assert_int_equal(error.code, JO_FAILED);
    assert_non_null(strstr(error.text, "/nowhere"));
}

static const char GAME[] = "jostle: 1\n"
                           "seed: 3\n"
                           "duration: 1000\n"
                           "player: people\n"
                           "groups:\n"
                           "  people: {behaviour: stander.lua, at: [[0, 0], [3, 0]]}\n"
                           "  others: {behaviour: stander.lua, at: [[6, 0]]}\n"
                           "tally: {people: {group: people}, others: {group: others}}\n"
                           "game: {ours: people, theirs: others, time: 1, rounds: 3,\n"
                           "       levels: {easy: {}, hard: {group: others, set: {speed: 2}}}}\n";

/* Rounds of a match have the next seed and logs of their own; a side that is two ahead has won. */
static void match_is_played_round_by_round(void **state) {
    (void)state;
    write_test_file("scene.yaml", GAME);
    begin_session(0);
    join_session();
    wait_for_json("\"type\": \"scene\"", "\"levels\": [\"easy\", \"hard\"]");
    send_command("{\"do\": \"speed\", \"factor\": 20}");
    wait_for_json("\"status\"", "\"game\": {\"on\": false");
    send_command("{\"do\": \"play\", \"level\": \"medium\"}");
    wait_for_json("\"refused\"", "no such level");
    send_command("{\"do\": \"play\", \"level\": \"hard\"}");
    wait_for_json("\"type\": \"scene\"", "\"level\": \"hard\"");
    assert_non_null(strstr(last, "\"seed\": 3"));
    wait_for_json("\"status\"", "\"winner\": \"ours\"");
    assert_non_null(strstr(last, "\"paused\": true"));
    assert_non_null(strstr(last, "\"round\": 1, \"won\": [1, 0, 0], \"match_over\": false"));
    send_command("{\"do\": \"play\"}");
    wait_for_json("\"type\": \"scene\"", "\"seed\": 4");
    wait_for_json("\"status\"", "\"round\": 2, \"won\": [2, 0, 0], \"match_over\": true");
    send_command("{\"do\": \"play\"}"); /* a new match at the same level */
    wait_for_json("\"type\": \"scene\"", "\"seed\": 5");
    assert_non_null(strstr(last, "\"level\": \"hard\""));
    wait_for_json("\"status\"", "\"round\": 1, \"won\": [1, 0, 0]");
    end_session();
    assert_true(session.good);
    jo_free(session.summary);
    char log[4096] = "";
    FILE *file = fopen(test_path("log-3.txt"), "r"); /* of the third start: the second round */
    assert_non_null(file);
    assert_true(fread(log, 1, sizeof log - 1, file) > 0);
    fclose(file);
    assert_non_null(strstr(log, "began 4 "));
    assert_non_null(strstr(log, "0 player 0 0 0"));
    write_test_file("scene.yaml", SCENE);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(new_page_gets_scene_errors_frames_and_status),
        cmocka_unit_test(pause_step_and_speed_commands),
        cmocka_unit_test(colour_and_field_commands),
        cmocka_unit_test(finished_scene_pauses_and_restarts),
        cmocka_unit_test(restart_keeps_files_of_earlier_runs),
        cmocka_unit_test(run_ends_once_all_have_left),
        cmocka_unit_test(reload_is_told_as_data),
        cmocka_unit_test(repeated_push_counts_once_per_step),
        cmocka_unit_test(input_log_replays_to_the_same_hash),
        cmocka_unit_test(each_page_inspects_its_own_agent),
        cmocka_unit_test(file_errors_are_sent_until_mended),
        cmocka_unit_test(view_that_cannot_start_returns_an_error),
        cmocka_unit_test(match_is_played_round_by_round),
    };
    return cmocka_run_group_tests(tests, make_session_folder, remove_test_folder);
}
