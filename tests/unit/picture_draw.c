/* Top views: draws one crowd as an image and as SVG and looks at pixels and elements. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "base/mem.h"
#include "geom/place_kinds.h"
#include "picture/draw.h"
#include "picture/palette.h"

enum { WIDTH = 1280, HEIGHT = 640 };

/* fontconfig keeps what it has looked up while the process lives, behind pointers that
   LeakSanitizer cannot follow. */
__attribute__((visibility("default"))) const char *__lsan_default_suppressions(void);
const char *__lsan_default_suppressions(void) {
    return "leak:libfontconfig\n";
}

/* A hall of 20 m by 10 m: a solid in its middle, a gate on the right, a person in state 1 at (5,
   5), one in state 2 at (5, 8), and a box at (15, 5). */
typedef struct Hall {
    JoxPicture picture;
    JoxFrame frame;
    JoxWalls walls;
    JoxPlace place;
    JoxV2 ring[4];
    JoxDrawnBody body;
    uint32_t key[2], state[2];
    uint16_t group[2];
    float x[2], y[2], vx[2], vy[2], radius[2], face_x[2], face_y[2], force[2];
    const char *states[3], *groups[1];
} Hall;

static void make_hall(Hall *h) {
    *h = (Hall){.x = {5, 5},
                .y = {5, 8},
                .vx = {1, 0},
                .vy = {0, 0.5f},
                .radius = {0.5f, 0.5f},
                .face_x = {1, 0},
                .face_y = {0, 1},
                .force = {0, 500},
                .key = {7, 3},
                .state = {1, 2},
                .states = {"", "Walk", "Sit & <eat>"},
                .groups = {"all"}};
    const JoxV2 solid[4] = {{9, 4}, {11, 4}, {11, 6}, {9, 6}}, gate[2] = {{18, 2}, {18, 8}};
    jox_walls_add_solid(&h->walls, solid, 4, INFINITY);
    jox_walls_add_polyline(&h->walls, gate, 2, false, INFINITY);
    jox_walls_name(&h->walls, 1, "exit \"A\"", false);
    h->ring[0] = jox_v2(1, 1);
    h->ring[1] = jox_v2(3, 1);
    h->ring[2] = jox_v2(3, 3);
    h->ring[3] = jox_v2(1, 3);
    static char stand[] = "stand";
    h->place = (JoxPlace){.name = stand, .kind = JOX_PLACE_POLYGON, .points = h->ring, .count = 4};
    h->place.centre = jox_v2(2, 2);
    h->body = (JoxDrawnBody){
        .name = "box", .ring = {{14, 4}, {16, 4}, {16, 6}, {14, 6}}, .count = 4, .at = {15, 5}};
    h->frame = (JoxFrame){.time = 12.5,
                          .count = 2,
                          .keys = 8,
                          .key = h->key,
                          .x = h->x,
                          .y = h->y,
                          .vx = h->vx,
                          .vy = h->vy,
                          .radius = h->radius,
                          .force = h->force,
                          .group = h->group,
                          .groups = h->groups,
                          .group_count = 1,
                          .state = h->state,
                          .states = h->states,
                          .state_count = 3};
    h->picture = (JoxPicture){.title = "A hall",
                              .frame = &h->frame,
                              .face_x = h->face_x,
                              .face_y = h->face_y,
                              .walls = &h->walls,
                              .places = &h->place,
                              .place_count = 1,
                              .bodies = &h->body,
                              .body_count = 1,
                              .colour = JOX_SHOW_STATE,
                              .radius = 0.2f,
                              .high = {20, 10}};
}

/* Returns the pixel of a point, m. The map takes the full width less 16 px at the left and, on
   the right, the legend's 206 px and 16 px. */
static JoxV2 to_picture_pixel(float x, float y) {
    float scale = (WIDTH - 206 - 32) / 20.0f, tall = 10 * scale;
    float spare = 0.5f * (HEIGHT - 46 - 16 - tall);
    return jox_v2(16 + x * scale, HEIGHT - 16 - spare - y * scale);
}

static void expect_pixel_colour(const uint8_t *pixels, float x, float y, JoxInk ink) {
    JoxV2 at = to_picture_pixel(x, y);
    const uint8_t *p = pixels + 4 * ((size_t)at.y * WIDTH + (size_t)at.x);
    if (abs(p[2] - ink.r) > 2 || abs(p[1] - ink.g) > 2 || abs(p[0] - ink.b) > 2)
        fail_msg("at %g, %g m: #%02x%02x%02x, not #%02x%02x%02x", (double)x, (double)y, p[2], p[1],
                 p[0], ink.r, ink.g, ink.b);
}

static void draws_each_thing_at_its_place(void **state) {
    (void)state;
    Hall h;
    make_hall(&h);
    JoxCanvas *canvas = jox_canvas_image(WIDTH, HEIGHT);
    if (!canvas)
        skip();
    jox_draw(canvas, &h.picture);
    const uint8_t *pixels = jox_canvas_pixels(canvas);
    expect_pixel_colour(pixels, 4.8f, 5,
                        (JoxInk){0x00, 0x72, 0xb2, 1}); /* the first of the classes */
    expect_pixel_colour(pixels, 5, 7.8f, (JoxInk){0xe6, 0x9f, 0x00, 1});   /* the second */
    expect_pixel_colour(pixels, 10, 5, (JoxInk){0xa3, 0xac, 0xb5, 1});     /* the solid */
    expect_pixel_colour(pixels, 15, 5, (JoxInk){0xc4, 0xa4, 0x84, 1});     /* the body */
    expect_pixel_colour(pixels, 18, 3, (JoxInk){0xa4, 0x26, 0x12, 1});     /* the gate */
    expect_pixel_colour(pixels, 13, 9, (JoxInk){0xf8, 0xf8, 0xf6, 1});     /* the floor */
    expect_pixel_colour(pixels, 21, -0.5f, (JoxInk){0xff, 0xff, 0xff, 1}); /* outside */
    /* the first person looks to the right: the heading's mark is there */
    JoxV2 at = to_picture_pixel(5.3f, 5);
    const uint8_t *mark = pixels + 4 * ((size_t)at.y * WIDTH + (size_t)at.x);
    assert_true(mark[0] < 0x60 && mark[1] < 0x60 && mark[2] < 0x60);
    /* A given colour is that state's alone: the other state takes another colour. */
    const JoxColour given[3] = {0, 0, JOX_COLOUR_GIVEN | 0x0072b2};
    h.frame.state_colours = given;
    jox_draw(canvas, &h.picture);
    expect_pixel_colour(jox_canvas_pixels(canvas), 4.8f, 5, (JoxInk){0xe6, 0x9f, 0x00, 1});
    expect_pixel_colour(jox_canvas_pixels(canvas), 5, 7.8f, (JoxInk){0x00, 0x72, 0xb2, 1});
    h.frame.state_colours = NULL;
    /* An open gate is a dashed line, with floor between the dashes. */
    h.walls.rings[1].open = true;
    jox_draw(canvas, &h.picture);
    uint32_t bare = 0, red = 0;
    for (float y = 2.5f; y < 7.5f; y += 0.02f) {
        JoxV2 on = to_picture_pixel(18, y);
        const uint8_t *p = jox_canvas_pixels(canvas) + 4 * ((size_t)on.y * WIDTH + (size_t)on.x);
        bare += p[0] > 0xe0;
        red += p[0] < 0x90;
    }
    assert_true(bare > 50 && red > 50);
    jox_canvas_free(canvas);
    jox_walls_free(&h.walls);
}

static void colours_follow_values_and_scales(void **state) {
    (void)state;
    Hall h;
    make_hall(&h);
    JoxCanvas *canvas = jox_canvas_image(WIDTH, HEIGHT);
    if (!canvas)
        skip();
    h.picture.colour = JOX_SHOW_SPEED; /* 1 and 0.5 m/s of 2: bins 16 and 8 of 32 */
    h.picture.colour_most = 2;
    jox_draw(canvas, &h.picture);
    expect_pixel_colour(jox_canvas_pixels(canvas), 4.8f, 5, jox_palette_calm(16.5f / 32));
    expect_pixel_colour(jox_canvas_pixels(canvas), 5, 7.8f, jox_palette_calm(8.5f / 32));
    h.picture.colour = JOX_SHOW_DIRECTION;
    jox_draw(canvas, &h.picture);
    for (uint32_t i = 0; i < 2; i++) { /* the nearest of 32 directions */
        const float turn = atan2f(h.frame.vy[i], h.frame.vx[i]) / 6.2831853f;
        expect_pixel_colour(jox_canvas_pixels(canvas), i ? 5 : 4.8f, i ? 7.8f : 5,
                            jox_palette_way(roundf(32 * turn) / 32));
    }
    h.picture.colour = JOX_SHOW_FORCE;
    h.picture.colour_most = 400; /* the value of 500 is above the bar's end: last colour */
    jox_draw(canvas, &h.picture);
    expect_pixel_colour(jox_canvas_pixels(canvas), 4.8f, 5, jox_palette_value(0.5f / 32));
    expect_pixel_colour(jox_canvas_pixels(canvas), 5, 7.8f, jox_palette_value(31.5f / 32));
    /* The floor: a field with cells of 1 m, whose upper right quarter has the greatest value. */
    JoxDensity *grid = jox_density_create(jox_v2(0, 0), jox_v2(20, 10), 1, 1);
    assert_true(grid->columns == 20 && grid->rows == 10);
    for (uint32_t r = 5; r < 10; r++)
        for (uint32_t c = 10; c < 20; c++)
            grid->now[r * 20 + c] = 7;
    h.picture.colour = JOX_SHOW_NOTHING;
    h.picture.floor = JOX_SHOW_DENSITY;
    h.picture.floor_most = 8;
    h.picture.grid = grid;
    h.picture.field = grid->now;
    jox_draw(canvas, &h.picture);
    expect_pixel_colour(jox_canvas_pixels(canvas), 13, 9, jox_palette_value(28.5f / 32));
    expect_pixel_colour(jox_canvas_pixels(canvas), 16.5f, 7.5f, jox_palette_value(28.5f / 32));
    expect_pixel_colour(jox_canvas_pixels(canvas), 13, 2, (JoxInk){0xf8, 0xf8, 0xf6, 1});
    expect_pixel_colour(jox_canvas_pixels(canvas), 7, 9, (JoxInk){0xf8, 0xf8, 0xf6, 1});
    jox_density_free(grid);
    jox_canvas_free(canvas);
    jox_walls_free(&h.walls);
}

static char *draw_svg(const JoxPicture *picture) {
    char path[] = "/tmp/jostle-draw-XXXXXX";
    size_t length;
    JoxText error = {0};
    int file = mkstemp(path);
    assert_true(file >= 0);
    close(file);
    JoxCanvas *canvas = jox_canvas_svg(WIDTH, HEIGHT);
    jox_draw(canvas, picture);
    assert_true(jox_canvas_write(canvas, path, &error));
    jox_canvas_free(canvas);
    char *text = jox_read_file(path, 1 << 24, &length);
    assert_non_null(text);
    unlink(path);
    return text;
}

static void svg_has_layers_classes_and_texts(void **state) {
    (void)state;
    static const char *const wanted[] = {
        "<g id=\"walls\"",
        "<g id=\"places\"",
        "<g id=\"bodies\"",
        "<g id=\"people\"",
        "class=\"state-Walk\"",
        "class=\"state-Sit----eat-\"",
        "class=\"gate closed\"",
        "<title>exit &quot;A&quot;</title>",
        ">exit &quot;A&quot;</text>",
        ">Sit &amp; &lt;eat&gt;</text>",
        "<title>box</title>",
        ">stand</text>",
        ">A hall</text>",
        ">t = 12.50 s</text>",
        ">2 people</text>",
        ">2 m</text>",
        "<circle id=\"p7\"",
        "<circle id=\"p3\"",
    };
    Hall h;
    make_hall(&h);
    char *text = draw_svg(&h.picture), place[96];
    for (size_t i = 0; i < sizeof wanted / sizeof *wanted; i++)
        if (!strstr(text, wanted[i]))
            fail_msg("%s is missing", wanted[i]);
    JoxV2 at = to_picture_pixel(5, 8); /* compared to 0.1 px */
    snprintf(place, sizeof place, "<circle id=\"p3\" cx=\"%.1f", (double)at.x);
    assert_non_null(strstr(text, place));
    assert_non_null(strstr(text, "</svg>"));
    jox_free(text);
    /* People outside the area are not drawn, and the legend says "in all". */
    h.picture.high = jox_v2(20, 6);
    text = draw_svg(&h.picture);
    assert_non_null(strstr(text, "id=\"p7\""));
    assert_null(strstr(text, "id=\"p3\""));
    assert_non_null(strstr(text, ">2 people in all</text>"));
    jox_free(text);
    jox_walls_free(&h.walls);
}

/* Floor and scenery are drawn paler than they are, beneath people; over a field as outlines. */
static void scenery_is_drawn_beneath_people(void **state) {
    (void)state;
    Hall h;
    make_hall(&h);
    JoxV2 lawn[4] = {{4, 4}, {8, 4}, {8, 9.5f}, {4, 9.5f}}, tree = {13, 8}, cube = {10, 5};
    char carrier[] = "box";
    const JoxScenery scenery[] = {
        {.kind = JOX_SCENERY_KIND_TREE, .at = &tree, .at_count = 1, .size = {2, 2, 6}},
        {.kind = JOX_SCENERY_KIND_AREA, .through = lawn, .through_count = 4},
        {.kind = JOX_SCENERY_KIND_KAABA, .at = &cube, .at_count = 1, .size = {1.6, 1.6, 3}},
        {.kind = JOX_SCENERY_KIND_BLOCK,
         .at = &tree,
         .at_count = 1,
         .size = {5, 5, 1},
         .colour = JOX_COLOUR_GIVEN | 0xff0000,
         .body = carrier},
        {.kind = JOX_SCENERY_KIND_LINE, .through = lawn, .through_count = 2, .size = {0, 0.2, 0}}};
    h.picture.ground = 1; /* marble */
    h.picture.scenery = scenery;
    h.picture.scenery_count = 5;
    JoxCanvas *canvas = jox_canvas_image(WIDTH, HEIGHT);
    if (canvas) {
        jox_draw(canvas, &h.picture);
        const uint8_t *pixels = jox_canvas_pixels(canvas);
        expect_pixel_colour(pixels, 18.5f, 9, (JoxInk){0xef, 0xee, 0xea, 1}); /* marble, 0.4 */
        expect_pixel_colour(pixels, 13, 8.5f, (JoxInk){0xba, 0xce, 0xab, 1}); /* leaves, 0.45 */
        expect_pixel_colour(pixels, 7, 9, (JoxInk){0xdc, 0xe1, 0xd3, 1});     /* area, 0.45 */
        expect_pixel_colour(pixels, 10, 5, (JoxInk){0x73, 0x72, 0x70, 1});    /* the cube, 0.6 */
        expect_pixel_colour(pixels, 4.8f, 5, (JoxInk){0x00, 0x72, 0xb2, 1});  /* a person */
        float field[200] = {0};
        JoxDensity *grid = jox_density_create((JoxV2){0, 0}, (JoxV2){20, 10}, 1.0f, 1.0f);
        h.picture.grid = grid;
        h.picture.field = field;
        h.picture.floor = JOX_SHOW_DENSITY;
        h.picture.floor_most = 8;
        jox_draw(canvas, &h.picture);
        expect_pixel_colour(jox_canvas_pixels(canvas), 13, 8.5f, (JoxInk){0xf8, 0xf8, 0xf6, 1});
        jox_density_free(grid);
        h.picture.grid = NULL;
        h.picture.floor = JOX_SHOW_NOTHING;
    }
    char *text = draw_svg(&h.picture);
    const char *layer = strstr(text, "<g id=\"scenery\"");
    assert_non_null(layer);
    const char *const ORDER[] = {"class=\"area\"", "class=\"line\"", "class=\"tree\"",
                                 "class=\"kaaba\"", "<g id=\"places\""};
    for (int k = 0; k < 5; k++) { /* flat things first, then what stands */
        layer = strstr(layer, ORDER[k]);
        assert_non_null(layer);
    }
    assert_null(strstr(text, "class=\"block\"")); /* the body that carries it is drawn */
    jox_free(text);
    jox_canvas_free(canvas);
    jox_walls_free(&h.walls);
}

static void outlines_of_bodies_follow_their_rotation(void **state) {
    (void)state;
    const float half = 0.70710678f, none[4] = {0, 0, 0, 1}, about_z[4] = {0, 0, half, half},
                about_x[4] = {half, 0, 0, half};
    JoxDrawnBody drawn;
    /* A plank of 4 m by 1 m, rotated by a quarter turn: 1 m along x, 4 m along y. */
    JoxBodyLook plank = {.kind = JOX_SHAPE_BOX, .size = {4, 1, 0.2f}, .turn = {0, 0, 0, 1}};
    assert_true(jox_draw_outline(&plank, (JoxV3){10, 5, 1}, about_z, &drawn));
    assert_int_equal(drawn.count, 4);
    for (uint32_t c = 0; c < 4; c++) {
        assert_float_equal(fabsf(drawn.ring[c].x - 10), 0.5, 1e-4);
        assert_float_equal(fabsf(drawn.ring[c].y - 5), 2, 1e-4);
    }
    assert_true(jox_polygon_area(drawn.ring, 4) > 0);
    assert_float_equal(drawn.low, 0.9, 1e-4);
    assert_float_equal(drawn.top, 1.1, 1e-4);
    jox_draw_mark_high(&drawn, 1);
    assert_false(drawn.high);
    /* Rotated about x it stands on its edge: its thickness of 0.2 m is seen. */
    assert_true(jox_draw_outline(&plank, (JoxV3){0, 0, 3}, about_x, &drawn));
    for (uint32_t c = 0; c < drawn.count; c++)
        assert_float_equal(fabsf(drawn.ring[c].y), 0.1, 1e-4);
    jox_draw_mark_high(&drawn, 1);
    assert_true(drawn.high);
    /* A part beside the body's origin rotates about that origin. */
    plank.at = (JoxV3){2, 0, 0};
    assert_true(jox_draw_outline(&plank, (JoxV3){0, 0, 1}, about_z, &drawn));
    assert_float_equal(drawn.at.x, 0, 1e-4);
    assert_float_equal(drawn.at.y, 2, 1e-4);
    /* An upright cylinder is a disc, a lying one a rectangle of its length. */
    JoxBodyLook drum = {.kind = JOX_SHAPE_CYLINDER, .size = {0.5f, 3}, .turn = {0, 0, 0, 1}};
    assert_true(jox_draw_outline(&drum, (JoxV3){0, 0, 1.5f}, none, &drawn));
    assert_int_equal(drawn.count, 0);
    assert_float_equal(drawn.radius, 0.5, 1e-6);
    assert_float_equal(drawn.low, 0, 1e-6);
    assert_true(jox_draw_outline(&drum, (JoxV3){0, 0, 0.5f}, about_x, &drawn));
    assert_in_range(drawn.count, 4, JOX_OUTLINE_POINTS);
    assert_float_equal(jox_polygon_area(drawn.ring, drawn.count), 3, 0.05);
    /* A hull, and positions that are not finite. */
    const JoxV3 corners[4] = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0.5f, 0.5f, 2}};
    JoxBodyLook hull = {
        .kind = JOX_SHAPE_HULL, .turn = {0, 0, 0, 1}, .corners = corners, .corner_count = 4};
    assert_true(jox_draw_outline(&hull, (JoxV3){0, 0, 0}, none, &drawn));
    assert_int_equal(drawn.count, 3);
    assert_false(jox_draw_outline(&hull, (JoxV3){NAN, 0, 0}, none, &drawn));
    drum.size[0] = INFINITY;
    assert_false(jox_draw_outline(&drum, (JoxV3){0, 0, 0}, about_x, &drawn));
}

/* Hostile names and numbers, as a recording may contain: invalid UTF-8, markup, NAN, an unknown
   group. */
static void draws_hostile_names_and_numbers(void **state) {
    (void)state;
    Hall h;
    make_hall(&h);
    char long_title[1000];
    memset(long_title, 'W', sizeof long_title);
    long_title[sizeof long_title - 1] = 0;
    memcpy(long_title, "\xff\x01</title>", 10);
    h.picture.title = long_title;
    h.picture.colour = JOX_SHOW_GROUP;
    h.group[0] = 0;
    h.group[1] = 65535; /* a group without a name */
    h.vx[0] = NAN;
    h.picture.face_x = NULL;
    h.x[1] = 1e30f;
    char *text = draw_svg(&h.picture);
    assert_null(strstr(text, "nan"));
    assert_null(strstr(text, "\xff"));
    assert_null(strchr(text, 1));
    assert_non_null(strstr(text, "class=\"group-all\""));
    assert_non_null(strstr(text, ">none</text>"));
    jox_free(text);
    h.picture.colour = JOX_SHOW_SPEED;
    h.picture.colour_most = 2;
    text = draw_svg(&h.picture);
    assert_non_null(strstr(text, "id=\"p7\""));
    jox_free(text);
    h.frame.count = 0;
    text = draw_svg(&h.picture);
    assert_non_null(strstr(text, ">0 people</text>"));
    jox_free(text);
    jox_walls_free(&h.walls);
}

/* Returns lightness in thousandths of white, with the weights of ITU-R BT.709. */
static int measure_lightness(JoxInk ink) {
    return (int)(0.8 * (213 * ink.r + 715 * ink.g + 72 * ink.b) / 204);
}

static void greater_values_are_darker_and_classes_differ(void **state) {
    (void)state;
    JoxInk low = jox_palette_value(-1), high = jox_palette_value(2);
    assert_true(measure_lightness(low) > 900 && measure_lightness(high) < 150);
    for (int k = 1; k <= 64; k++)
        assert_true(measure_lightness(jox_palette_value((float)k / 64)) <
                    measure_lightness(jox_palette_value((float)(k - 1) / 64)));
    for (uint32_t a = 0; a < 24; a++) /* classes differ */
        for (uint32_t b = 0; b < a; b++) {
            JoxInk p = jox_palette_class(a), q = jox_palette_class(b);
            assert_true(abs(p.r - q.r) + abs(p.g - q.g) + abs(p.b - q.b) > 40);
        }
}

static void picture_sizes_are_even_and_bounded(void **state) {
    (void)state;
    static const JoxV2 areas[] = {{20, 10}, {1, 1}, {1000, 1}, {1, 1000}, {3, 4}};
    for (size_t i = 0; i < sizeof areas / sizeof *areas; i++) {
        uint32_t width, height;
        jox_draw_size(&(JoxPicture){.high = areas[i]}, &width, &height);
        assert_true(width % 2 == 0 && height % 2 == 0);
        assert_in_range(width, 600, 1280);
        assert_in_range(height, 400, 1100);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(draws_each_thing_at_its_place),
        cmocka_unit_test(colours_follow_values_and_scales),
        cmocka_unit_test(svg_has_layers_classes_and_texts),
        cmocka_unit_test(scenery_is_drawn_beneath_people),
        cmocka_unit_test(outlines_of_bodies_follow_their_rotation),
        cmocka_unit_test(draws_hostile_names_and_numbers),
        cmocka_unit_test(greater_values_are_darker_and_classes_differ),
        cmocka_unit_test(picture_sizes_are_even_and_bounded),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
