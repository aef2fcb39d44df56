/* A scene on its live page, driven as a browser would: what comes, what can be done, and that a
   session replays to its state. */
#include "unit/live_session.h"

static void pages_are_greeted_and_shown_the_run(void **state) {
    (void)state;
    write_file("scene.yaml", SCENE);
    write_file("walker.lua", WALKER);
    begin(0);
    join();
    int kind;
    size_t length;
    char *message = get_message(session.fd, &kind, &length, 20.0);
    assert_non_null(message);
    assert_int_equal(kind, FRAME_TEXT); /* before anything else */
    assert_non_null(
        strstr(message, "{\"type\": \"scene\", \"protocol\": 3, \"session\": \"live\""));
    free(message);
    hear("\"type\": \"errors\"", "\"errors\": []");
    uint32_t first = see();
    double begun = clock_now();
    uint32_t tick = first;
    while (tick < first + 20)
        tick = see();
    double took = clock_now() - begun; /* 20 steps of 0.05 s in real time */
    assert_true(took > 0.8);
    const char *status = hear("\"type\": \"status\"", NULL);
    assert_true(number_of(status, "agents") == 30);
    assert_non_null(strstr(status, "\"paused\": false"));
    end();
    assert_true(session.good);
    assert_non_null(session.summary);
    jo_free(session.summary);
}

static void a_run_is_paused_stepped_and_hurried(void **state) {
    (void)state;
    begin(0);
    join();
    say("{\"do\": \"pause\", \"on\": true}");
    hear("\"status\"", "\"paused\": true");
    double tick = number_of(hear("\"status\"", "\"paused\": true"), "tick");
    usleep(300000);
    assert_true(number_of(hear("\"status\"", NULL), "tick") == tick);
    say("{\"do\": \"step\", \"n\": 7}");
    double then = tick;
    for (int i = 0; i < 8 && then == tick; i++)
        then = number_of(hear("\"status\"", NULL), "tick");
    assert_true(number_of(hear("\"status\"", "\"paused\": true"), "tick") == tick + 7);
    say("{\"do\": \"speed\", \"factor\": 10}");
    say("{\"do\": \"pause\", \"on\": false}");
    hear("\"status\"", "\"paused\": false");
    double from = number_of(last, "time");
    while (number_of(hear("\"status\"", NULL), "time") < from + 5.0)
        ;
    assert_true(number_of(last, "speed") == 10);
    say("{\"do\": \"speed\", \"factor\": -1}");
    hear("\"refused\"", "\"do\": \"speed\"");
    say("{\"do\": \"step\", \"n\": 1e9}");
    hear("\"refused\"", "\"do\": \"step\"");
    say("{\"do\": \"dance\"}");
    hear("\"refused\"", "no such command");
    say("{\"do\": \"colour\", \"by\": \"taste\"}");
    hear("\"refused\"", "\"do\": \"colour\"");
    say("not a command");
    double dropped = 0;
    for (int i = 0; i < 8 && dropped < 2; i++)
        dropped = number_of(hear("\"status\"", NULL), "dropped");
    assert_true(dropped == 2); /* the dance too */
    end();
    jo_free(session.summary);
}

static void colours_and_fields_are_as_asked(void **state) {
    (void)state;
    begin(0);
    join();
    hear("\"type\": \"scene\"", NULL);
    say("{\"do\": \"field\", \"of\": \"pressure\"}");
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
            assert_int_equal(head[1], 1); /* pressure, and not the other */
        free(message);
    }
    assert_true(came);
    say("{\"do\": \"colour\", \"by\": \"speed\"}");
    say("{\"do\": \"field\", \"of\": \"none\"}");
    say("{\"do\": \"field\", \"of\": \"smell\"}");
    hear("\"refused\"", "\"do\": \"field\"");
    for (double until = clock_now() + 0.7; clock_now() < until;) {
        char *message = get_message(session.fd, &kind, &length, 20.0);
        assert_non_null(message);
        uint32_t head = 0;
        memcpy(&head, message, length >= 8 && kind == FRAME_BINARY ? 4 : 0);
        free(message);
        assert_int_not_equal(head, 3);
    }
    end();
    jo_free(session.summary);
}

static void a_scene_that_is_over_waits_and_is_restarted(void **state) {
    (void)state;
    begin(0.5);
    join();
    hear("\"say\"", "0.5 s are over");
    hear("\"status\"", "\"paused\": true");
    assert_true(number_of(last, "tick") == 10);
    say("{\"do\": \"restart\", \"seed\": 77}");
    hear("\"type\": \"scene\"", "\"seed\": 77");
    hear("\"say\"", "0.5 s are over");
    say("{\"do\": \"restart\", \"seed\": 0.5}");
    hear("\"refused\"", "\"do\": \"restart\"");
    say("{\"do\": \"pause\", \"on\": false}"); /* beyond its end */
    while (number_of(hear("\"status\"", NULL), "time") < 0.7)
        ;
    end();
    assert_true(session.good);
    jo_free(session.summary);
}

/* Sum of the pushes of an agent in the log, N, at a tick. */
static void logged_push(double tick, uint32_t agent, double sum[2]) {
    FILE *file = fopen(in_folder("log.txt"), "r");
    assert_non_null(file);
    char line[2048];
    sum[0] = sum[1] = 0.0;
    while (fgets(line, sizeof line, file)) {
        double at, x, y;
        uint32_t whom;
        if (sscanf(line, "%lf push %u %lf %lf", &at, &whom, &x, &y) == 4 && at == tick &&
            whom == agent) {
            sum[0] += x;
            sum[1] += y;
        }
    }
    fclose(file);
}

static void a_push_that_is_repeated_counts_once_a_step(void **state) {
    (void)state;
    JoxText scene = {0};
    const char *view = strstr(SCENE, "view:"), *rest = strchr(view, '\n') + 1;
    jox_text_printf(&scene, "%.*sview: {tools: [push]}\n%s", (int)(view - SCENE), SCENE, rest);
    write_file("scene.yaml", scene.data);
    jox_text_free(&scene);
    begin(0);
    join();
    say("{\"do\": \"restart\"}");
    say("{\"do\": \"pause\", \"on\": true}");
    hear("\"status\"", "\"paused\": true");
    const double tick = number_of(last, "tick");
    for (int n = 0; n < 20; n++) {
        say("{\"do\": \"input\", \"line\": \"push 1 %d -75.25\"}", 100 + n);
        say("{\"do\": \"input\", \"line\": \"push 2 0 300\"}");
    }
    say("{\"do\": \"step\", \"n\": 1}");
    while (number_of(hear("\"status\"", NULL), "tick") == tick)
        ;
    say("{\"do\": \"input\", \"line\": \"push 1 50 0\"}");
    say("{\"do\": \"input\", \"line\": \"push 1 1 2 3\"}");
    hear("\"refused\"", "push");
    end();
    assert_true(session.good);
    jo_free(session.summary);
    double sum[2];
    logged_push(tick, 1, sum);
    assert_true(sum[0] == 119.0 && sum[1] == -75.25);
    logged_push(tick, 2, sum);
    assert_true(sum[0] == 0.0 && sum[1] == 300.0);
    logged_push(tick + 1, 1, sum);
    assert_true(sum[0] == 50.0 && sum[1] == 0.0);
    write_file("scene.yaml", SCENE);
}

static void what_people_do_replays_to_the_same_state(void **state) {
    (void)state;
    begin(0);
    join();
    say("{\"do\": \"input\", \"line\": \"signal go\"}");
    say("{\"do\": \"input\", \"line\": \"open gate\"}");
    hear("\"status\"", "\"gate\": true");
    say("{\"do\": \"input\", \"line\": \"push 1 300 0\"}"); /* not offered by the scene */
    hear("\"refused\"", "view: {tools: [push]}");
    say("{\"do\": \"input\", \"line\": \"open window\"}");
    hear("\"refused\"", "window");
    say("{\"do\": \"input\", \"line\": \"files 1\"}");
    hear("\"refused\"", "\"do\": \"input\"");
    say("{\"do\": \"input\", \"line\": \"set walker Walk speed 0.8\"}");
    say("{\"do\": \"lua\", \"machine\": \"walker\", \"state\": \"Walk\", \"parameter\": \"speed\","
        " \"value\": 0.8}");
    hear("\"lua\"", "speed = 0.8");
    usleep(400000);
    say("{\"do\": \"pause\", \"on\": true}");
    hear("\"status\"", "\"paused\": true");
    double ticks = number_of(last, "tick");
    end();
    assert_true(session.good);
    const char *live = strstr(session.summary, "\"hash\": ");
    assert_non_null(live);

    JoSceneDef def = jo_default_scene_def();
    def.path = in_folder("scene.yaml");
    def.input_log = in_folder("log.txt");
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
    assert_true(number_of(session.summary, "steps") == ticks);
    jo_free(summary);
    jo_free(session.summary);
    jo_scene_free(scene);
}

static void each_page_inspects_somebody(void **state) {
    (void)state;
    begin(0);
    join();
    say("{\"do\": \"inspect\", \"slot\": 4}");
    hear("\"inspect\"", "\"agent\": {\"id\": 4, \"slot\": 4");
    hear("\"inspect\"", "\"seen\": true"); /* by then a step was looked at */
    int first = session.fd;
    join();
    say("{\"do\": \"inspect\", \"slot\": 7}");
    hear("\"inspect\"", "\"agent\": {\"id\": 7, \"slot\": 7");
    int second = session.fd;
    session.fd = first; /* which goes on with its own, and lets it go alone */
    hear("\"inspect\"", "\"agent\": {\"id\": 4, \"slot\": 4");
    hear("\"inspect\"", "\"agent\": {\"id\": 4, \"slot\": 4");
    say("{\"do\": \"inspect\", \"slot\": null}");
    hear("\"inspect\"", "\"agent\": null");
    session.fd = second;
    hear("\"inspect\"", "\"agent\": {\"id\": 7, \"slot\": 7");
    close(first);
    say("{\"do\": \"pause\", \"on\": true}");
    hear("\"status\"", "\"paused\": true");
    say("{\"do\": \"inspect\", \"slot\": 9}"); /* told at once, though no step is done */
    hear("\"inspect\"", "\"seen\": true");
    say("{\"do\": \"inspect\", \"slot\": 1000000}");
    hear("\"inspect\"", "\"agent\": null");
    end();
    jo_free(session.summary);
}

static void mistakes_are_shown_until_they_are_mended(void **state) {
    (void)state;
    char wrong[1024];
    begin(0);
    join();
    hear("\"errors\"", "\"errors\": []");
    snprintf(wrong, sizeof wrong, "%s", WALKER);
    memcpy(strstr(wrong, "away_from"), "awax_from", 9);
    write_file("walker.lua", wrong);
    hear("\"type\": \"errors\"", "walker.lua\", \"line\": 5, \"column\": 22");
    assert_non_null(strstr(last, "awax_from"));
    assert_non_null(strstr(last, "\"source\": \"    Walk = { steer = awax_from \\\"yard\\\" },\""));
    assert_non_null(strstr(last, "\"hint\": \"Did you mean 'away_from'"));
    int first = session.fd;
    join(); /* who comes later sees it too */
    hear("\"type\": \"errors\"", "awax_from");
    close(first);
    say("{\"do\": \"pause\", \"on\": true}"); /* and files are looked at in a pause */
    hear("\"status\"", "\"paused\": true");
    write_file("scene.yaml", "jostle: 1\nnonsense: 3\n");
    hear("\"type\": \"errors\"", "nonsense");
    assert_non_null(strstr(last, "awax_from")); /* each file has its own */
    say("{\"do\": \"restart\"}");               /* cannot be: the run goes on as it was */
    hear("\"refused\"", "\"do\": \"restart\"");
    write_file("scene.yaml", SCENE);
    write_file("walker.lua", WALKER);
    hear("\"type\": \"errors\"", "\"errors\": []");
    assert_true(number_of(hear("\"status\"", NULL), "tick") > 0);
    end();
    assert_true(session.good);
    jo_free(session.summary);
}

static void what_cannot_begin_says_why(void **state) {
    (void)state;
    write_file("scene.yaml", "jostle: 1\nnonsense: 3\n");
    begin(0);
    end();
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

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pages_are_greeted_and_shown_the_run),
        cmocka_unit_test(a_run_is_paused_stepped_and_hurried),
        cmocka_unit_test(colours_and_fields_are_as_asked),
        cmocka_unit_test(a_scene_that_is_over_waits_and_is_restarted),
        cmocka_unit_test(a_push_that_is_repeated_counts_once_a_step),
        cmocka_unit_test(what_people_do_replays_to_the_same_state),
        cmocka_unit_test(each_page_inspects_somebody),
        cmocka_unit_test(mistakes_are_shown_until_they_are_mended),
        cmocka_unit_test(what_cannot_begin_says_why),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
