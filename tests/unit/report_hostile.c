/* Hostile names in everything written for gnuplot, browsers and tables: they must stay plain
   text. */
#include <dirent.h>
#include <expat.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include "base/format/quote.h"
#include "base/mem.h"
#include "picture/canvas.h"
#include "picture/html.h"
#include "picture/palette.h"
#include "picture/paths.h"
#include "picture/plot.h"
#include "picture/probe_files.h"
#include "report/danger_outputs.h"

/* Names that would create a file "pwned..." if a program interpreted them. */
static const char *const HOSTILE[] = {
    "`touch pwned1`",
    "$(touch pwned2)",
    "\"; system('touch pwned3') #",
    "'; system \"touch pwned4\" #",
    "'.system('touch pwned5').'",
    "| touch pwned6",
    "< touch pwned7",
    "\n!touch pwned8\n",
    "a'\nset output 'pwned9'\nplot x\n",
    "</script></title></text><script>alert(1)</script>",
    "\"><img src=x onerror=alert(1)>",
    "'; DROP TABLE trajectory_data; --",
    "@pwned %s %n %999999d \\",
    "{/Symbol a}_x^2 & co",
    "../../pwned10",
    "-e quit",
    "\xff\xfe bytes \x01\x1b[31m",
    "",
};
enum { HOSTILE_COUNT = sizeof HOSTILE / sizeof *HOSTILE, PEOPLE = 6 };

static char folder[] = "/tmp/jostle-hostile-XXXXXX";
static JoxWalls walls;

/* ---- checks of the output ---- */

static char *read_whole_file(const char *path, size_t *length) {
    char *text = jox_read_file(path, (size_t)64 << 20, length);
    assert_non_null(text);
    return text;
}

static void refuse_script_elements(void *context, const char *name, const char **attributes) {
    (void)context;
    assert_string_not_equal(name, "script");
    assert_string_not_equal(name, "img");
    for (; *attributes; attributes += 2)
        assert_int_not_equal(strncmp(attributes[0], "on", 2), 0);
}

/* Fails unless a file is well-formed XML without elements and attributes that can run scripts. */
static void expect_valid_svg(const char *path) {
    size_t length;
    char *text = read_whole_file(path, &length);
    XML_Parser parser = XML_ParserCreate(NULL);
    XML_SetStartElementHandler(parser, refuse_script_elements);
    if (XML_Parse(parser, text, (int)length, 1) != XML_STATUS_OK)
        fail_msg("%s:%lu: %s", path, XML_GetCurrentLineNumber(parser),
                 XML_ErrorString(XML_GetErrorCode(parser)));
    XML_ParserFree(parser);
    jox_free(text);
}

static bool has_suffix(const char *name, const char *ending) {
    size_t n = strlen(name), m = strlen(ending);
    return n >= m && strcmp(name + n - m, ending) == 0;
}

/* Fails if a name was interpreted, an SVG is invalid, or there are fewer than `least` pictures;
   then empties the folder. */
static void check_and_empty_folder(int least) {
    DIR *listing = opendir(".");
    int pictures = 0;
    struct dirent *entry;
    while ((entry = readdir(listing))) {
        const char *name = entry->d_name;
        if (strcmp(name, ".") == 0 || strcmp(name, "..") == 0)
            continue;
        if (strncmp(name, "pwned", 5) == 0 && !strchr(name, '.'))
            fail_msg("a name was obeyed: %s", name);
        if (has_suffix(name, ".svg"))
            expect_valid_svg(name);
        struct stat info;
        assert_int_equal(stat(name, &info), 0);
        bool picture = has_suffix(name, ".svg") || has_suffix(name, ".png");
        assert_true(!picture || info.st_size > 100);
        pictures += picture;
        assert_int_equal(unlink(name), 0);
    }
    closedir(listing);
    assert_true(access("/tmp/pwned10", F_OK) != 0);
    assert_true(pictures >= least);
}

static void expect_success(bool good, JoxText *error) {
    if (!good)
        fail_msg("%s", error->data);
}

/* ---- writers ---- */

static const float X[2][PEOPLE] = {{0.5f, 1.5f, 2.5f, 3.5f, 4.5f, 5.5f},
                                   {2.6f, 3.6f, 4.6f, 5.6f, 6.6f, 7.6f}};
static const float Y[PEOPLE] = {1, 1.5f, 2, 2.5f, 3, 3.5f};

static void region_plots_survive_hostile_names(void **state) {
    (void)state;
    static const JoxV2 square[] = {{0, 0}, {8, 0}, {8, 4}, {0, 4}};
    for (int h = 0; h < HOSTILE_COUNT; h++) {
        JoxText error = {0};
        JoxRegions *regions = jox_regions_create();
        jox_regions_add(regions, HOSTILE[h], square, 4);
        jox_regions_frame(regions, X[1], Y, X[0], Y, PEOPLE, 1.0);
        expect_success(jox_plot_regions(folder, regions, HOSTILE[h], &error), &error);
        check_and_empty_folder(1);
        jox_regions_free(regions);
        jox_text_free(&error);
    }
}

static void path_plots_survive_hostile_names(void **state) {
    (void)state;
    for (int h = 0; h < HOSTILE_COUNT; h++) {
        JoxText error = {0};
        JoxPaths *all = jox_paths_create();
        const char *names[] = {HOSTILE[h], "others"};
        for (uint32_t i = 0; i < PEOPLE; i++)
            for (int f = 0; f < 2; f++)
                jox_paths_add(all, i, false, i % 2, (float)f, X[f][i], Y[i]);
        expect_success(jox_plot_paths(folder, all, names, NULL, 2, &walls, NULL, jox_v2(0, 0),
                                      jox_v2(8, 4), HOSTILE[h], &error),
                       &error);
        check_and_empty_folder(1);
        jox_paths_free(all);
        jox_text_free(&error);
    }
}

static JoxFrame make_crowd_frame(int f) {
    static const uint32_t key[PEOPLE] = {0, 1, 2, 3, 4, 5};
    static float v[PEOPLE], compression[PEOPLE] = {9000, 9000}, load[PEOPLE] = {3000, 3000};
    return (JoxFrame){.time = 20.0 * f,
                      .count = PEOPLE,
                      .keys = PEOPLE,
                      .key = key,
                      .x = X[f],
                      .y = Y,
                      .vx = v,
                      .vy = v,
                      .compression = compression,
                      .load = load};
}

static void probe_plots_survive_hostile_names(void **state) {
    (void)state;
    static const JoxV2 lines[] = {{2, 0}, {2, 4}, {2.2f, 0}, {2.2f, 4}};
    static const JoxV2 square[] = {{0, 0}, {8, 0}, {8, 4}, {0, 4}};
    for (int kind = 0; kind < JOX_PROBE_VISIT; kind++)
        /* each name with one kind of probe */
        for (int h = kind; h < HOSTILE_COUNT; h += JOX_PROBE_VISIT) {
            JoxText error = {0};
            bool within = kind == JOX_PROBE_MEASURE;
            const JoxProbeDef def = {.name = HOSTILE[h],
                                     .kind = (JoxProbeKind)kind,
                                     .until = INFINITY,
                                     .points = within ? square : lines,
                                     .count = kind == JOX_PROBE_FLOW      ? 2
                                              : kind == JOX_PROBE_WINDING ? 1
                                                                          : 4,
                                     .every = 1.0,
                                     .cutoff = 2.0,
                                     .high = {8, 4},
                                     .cell = 0.5,
                                     .kernel = 1.0,
                                     .rows = 1.0,
                                     .onset = 0.1};
            JoxProbe *probe = jox_probe_create(&def);
            for (int f = 0; f < 2; f++) {
                JoxFrame frame = make_crowd_frame(f);
                jox_probe_frame(probe, &frame);
            }
            expect_success(jox_probe_write(probe, folder, &walls, HOSTILE[h], &error), &error);
            check_and_empty_folder(2);
            jox_probe_free(probe);
            jox_text_free(&error);
        }
}

static void danger_plots_survive_hostile_names(void **state) {
    (void)state;
    for (int h = 0; h < HOSTILE_COUNT; h++) {
        JoxText error = {0};
        JoxExits exits = {0};
        JoxDanger *measured = jox_danger_create(jox_v2(0, 0), jox_v2(8, 4), NULL);
        struct JoxExit *exit = jox_exits_get(&exits, HOSTILE[h]);
        exit->people = 3;
        exits.left = 3;
        for (int f = 0; f < 2; f++) {
            JoxFrame frame = make_crowd_frame(f);
            jox_danger_frame(measured, &frame, &exits);
        }
        expect_success(jox_danger_write(measured, folder, HOSTILE[h], &error), &error);
        check_and_empty_folder(4);
        jox_danger_free(measured);
        jox_exits_free(&exits);
        jox_text_free(&error);
    }
}

static void svg_survives_hostile_names(void **state) {
    (void)state;
    static const JoxV2 line[] = {{1, 1}, {50, 50}, {90, 10}};
    for (int h = 0; h < HOSTILE_COUNT; h++) {
        JoxText error = {0};
        JoxCanvas *canvas = jox_canvas_svg(400, 300);
        const JoxStyle style = {.line = {0, 0, 0, 1}, .fill = {9, 9, 9, 1}, .width = 1};
        jox_canvas_begin(canvas, HOSTILE[h]);
        jox_canvas_open(canvas, HOSTILE[h], HOSTILE[h], style);
        jox_canvas_line(canvas, line, 3, true, HOSTILE[h]);
        jox_canvas_disc(canvas, line[1], 4, HOSTILE[h]);
        jox_canvas_text(canvas, line[0], 12, JOX_ANCHOR_START, false, HOSTILE[h]);
        jox_canvas_close(canvas);
        expect_success(jox_canvas_write(canvas, "canvas.svg", &error), &error);
        check_and_empty_folder(1);
        jox_canvas_free(canvas);
        jox_text_free(&error);
    }
}

static void pages_survive_hostile_names(void **state) {
    (void)state;
    for (int h = 0; h < HOSTILE_COUNT; h++) {
        char *page = NULL;
        size_t size = 0;
        FILE *out = open_memstream(&page, &size);
        jox_html_begin(out, HOSTILE[h]);
        jox_html_heading(out, HOSTILE[h]);
        jox_html_paragraph(out, HOSTILE[h]);
        jox_html_table(out, HOSTILE[h]);
        jox_html_row(out);
        jox_html_cell(out, HOSTILE[h]);
        jox_html_cell_number(out, 1.0, HOSTILE[h]);
        jox_html_table_end(out);
        jox_html_argument(out, HOSTILE[h]);
        size_t plain = 0, tags = 0;
        fflush(out);
        for (const char *c = page; *c; c++)
            tags += *c == '<';
        jox_html_picture(out, HOSTILE[h], HOSTILE[h], HOSTILE[h]);
        fclose(out);
        for (const char *c = page; *c; c++)
            plain += *c == '<';
        assert_null(strstr(page, "<script"));
        assert_null(strstr(page, "<img src=x"));
        assert_int_equal(plain - tags, 7); /* the tags of figure, a, img and figcaption */
        free(page);
    }
}

/* ---- single functions ---- */

static void expect_quoted(JoxQuote *quote, const char *text, const char *wanted) {
    JoxText out = {0};
    quote(&out, text);
    assert_string_equal(out.data, wanted);
    jox_text_free(&out);
}

static void each_target_is_quoted_by_its_own_rules(void **state) {
    (void)state;
    expect_quoted(jox_quote_gnuplot, "it's `x` \\\n", "\"it\\047s \\140x\\140 \\134 \"");
    expect_quoted(jox_quote_gnuplot, "\xc3\xa4 \"@y\"", "\"\xc3\xa4 \\042\\100y\\042\"");
    expect_quoted(jox_quote_gnuplot_file, "< ls", "\"./\\074 ls\"");
    expect_quoted(jox_quote_gnuplot_file, "/tmp/x", "\"/tmp/x\"");
    expect_quoted(jox_quote_xml, "<a href=\"x\">'&\x01\n",
                  "&lt;a href=&quot;x&quot;&gt;&#39;&amp;?\n");
    expect_quoted(jox_quote_url, "a b\"\xc3\xa4/x.png", "a%20b%22%C3%A4/x.png");
    expect_quoted(jox_quote_css, "a b\"</\xc3\xa4\n", "\"a b\\000022\\00003c\\00002f\xc3\xa4 \"");
    expect_quoted(jox_quote_csv, "plain name", "plain name");
    expect_quoted(jox_quote_csv, "a,\"b\"", "\"a,\"\"b\"\"\"");
    expect_quoted(jox_quote_shell, "groups.g.count=3", "groups.g.count=3");
    expect_quoted(jox_quote_shell, "it's $(x)", "'it'\\''s $(x)'");
    expect_quoted(jox_quote_shell, "", "''");
    expect_quoted(jox_quote_markdown, "a|b <c> `d`", "a\\|b &lt;c> \\`d\\`");
    expect_quoted(jox_quote_file_name, "../a/b", "_._a_b");
    expect_quoted(jox_quote_file_name, "", "_");
}

/* A gnuplot that hangs is killed, and the error says so. */
static void hanging_gnuplot_is_killed(void **state) {
    (void)state;
    static const char HANGS[] = "#!/bin/sh\nexec sleep 1000\n";
    char *path = strdup(getenv("PATH"));
    JoxText error = {0};
    FILE *file = fopen("gnuplot", "w");
    fputs(HANGS, file);
    assert_int_equal(fclose(file) | chmod("gnuplot", 0700), 0);
    JoxText both = {0};
    jox_text_printf(&both, "%s:%s", folder, path);
    setenv("PATH", both.data, 1);
    assert_false(jox_plot_draw_within(".", "a.gp", 1, &error));
    assert_string_equal(error.data, "gnuplot could not draw ./a.gp: it said nothing for 1 s");
    setenv("PATH", path, 1);
    unlink("gnuplot");
    free(path);
    jox_text_free(&both);
    jox_text_free(&error);
}

/* The page's script lists the same colours as palette.c. */
static void live_page_has_the_same_class_colours(void **state) {
    (void)state;
    size_t length;
    char *script = read_whole_file(JOX_DATADIR "/core/view/page/draw/palette.js", &length),
         list[256] = "const CLASSES = [";
    for (uint32_t n = 0; n < 8; n++) {
        JoxInk ink = jox_palette_class(n);
        snprintf(list + strlen(list), sizeof list - strlen(list), "%s\"#%02x%02x%02x\"",
                 n ? ", " : "", ink.r, ink.g, ink.b);
    }
    strcat(list, "];");
    assert_non_null(strstr(script, list));
    assert_non_null(strstr(script, "c + 0.45 * (towards - c)"));
    JoxInk light = jox_palette_class(8); /* the first class, mixed with 45 % of white */
    assert_int_equal(light.r, lround(0x00 + 0.45 * (255 - 0x00)));
    assert_int_equal(light.g, lround(0x72 + 0.45 * (255 - 0x72)));
    jox_free(script);
}

static int enter_hostile_folder(void **state) {
    (void)state;
    static const JoxV2 room[] = {{0, 0}, {8, 0}, {8, 4}, {0, 4}};
    jox_walls_add_polyline(&walls, room, 4, true, INFINITY);
    return mkdtemp(folder) && chdir(folder) == 0 ? 0 : -1;
}

static int leave_hostile_folder(void **state) {
    (void)state;
    jox_walls_free(&walls);
    return chdir("/") == 0 && rmdir(folder) == 0 ? 0 : -1;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_target_is_quoted_by_its_own_rules),
        cmocka_unit_test(region_plots_survive_hostile_names),
        cmocka_unit_test(path_plots_survive_hostile_names),
        cmocka_unit_test(probe_plots_survive_hostile_names),
        cmocka_unit_test(danger_plots_survive_hostile_names),
        cmocka_unit_test(svg_survives_hostile_names),
        cmocka_unit_test(pages_survive_hostile_names),
        cmocka_unit_test(hanging_gnuplot_is_killed),
        cmocka_unit_test(live_page_has_the_same_class_colours),
    };
    return cmocka_run_group_tests(tests, enter_hostile_folder, leave_hostile_folder);
}
