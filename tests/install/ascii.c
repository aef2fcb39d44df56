/* A scene as text: walls, bodies and people on a grid of characters, once a simulated second. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <jostle.h>

enum { WIDE = 78, HIGH = 24 };

typedef struct Canvas {
    char cells[HIGH][WIDE + 1];
    double low[2], size[2]; /* m */
} Canvas;

static void put_mark(Canvas *c, double x, double y, char mark) {
    const int column = (int)floor((x - c->low[0]) / c->size[0] * WIDE);
    const int row = HIGH - 1 - (int)floor((y - c->low[1]) / c->size[1] * HIGH);
    if (column >= 0 && column < WIDE && row >= 0 && row < HIGH)
        c->cells[row][column] = mark;
}

static void draw_world(Canvas *c, JoWorld *world, const double *walls, uint32_t wall_count) {
    for (int row = 0; row < HIGH; row++) {
        memset(c->cells[row], ' ', WIDE);
        c->cells[row][WIDE] = 0;
    }
    for (uint32_t k = 0; k < wall_count; k++)
        for (double t = 0; t <= 1; t += 1.0 / 128) {
            const double *edge = walls + 4 * k;
            put_mark(c, edge[0] + t * (edge[2] - edge[0]), edge[1] + t * (edge[3] - edge[1]), '#');
        }
    for (uint32_t slot = 0, found = 0; found < jo_world_body_count(world); slot++) {
        const JoBody body = jo_world_body_at(world, slot);
        const JoBodyState state = jo_body_state(world, body);
        if (!body.generation)
            continue;
        put_mark(c, state.x, state.y, 'O');
        found++;
    }
    const JoColumn x = jo_world_column(world, "x"), y = jo_world_column(world, "y"),
                   state = jo_world_column(world, "state");
    for (uint32_t i = 0; i < x.count; i++)
        put_mark(c, ((const float *)x.data)[i], ((const float *)y.data)[i],
                 (char)('a' + ((const uint16_t *)state.data)[i] % 26));
    for (int row = 0; row < HIGH; row++)
        puts(c->cells[row]);
}

int main(int argc, char **argv) {
    JoError error = {0};
    JoSceneDef def = jo_default_scene_def();
    def.path = argc > 1 ? argv[1] : "scenes/evacuation.yaml";
    const int seconds = argc > 2 ? atoi(argv[2]) : 10;
    JoScene *scene = jo_scene_load(&def, &error);
    if (!scene) {
        fprintf(stderr, "%s:%d: %s\n", error.file, error.line, error.text);
        return 1;
    }
    JoWorld *world = jo_scene_world(scene);
    const uint32_t count = jo_world_walls(world, NULL, 0);
    double *walls = calloc(count + 1, 4 * sizeof *walls);
    if (!walls)
        return 1;
    jo_world_walls(world, walls, count);
    Canvas canvas = {.low = {INFINITY, INFINITY}, .size = {-INFINITY, -INFINITY}};
    for (uint32_t k = 0; k < 4 * count;
         k++) { /* the extent of the walls; `size` holds the greatest corner until the end */
        canvas.low[k % 2] = fmin(canvas.low[k % 2], walls[k] - 0.5);
        canvas.size[k % 2] = fmax(canvas.size[k % 2], walls[k] + 0.5);
    }
    for (int k = 0; k < 2; k++)
        canvas.size[k] -= canvas.low[k];
    int good = count > 0;
    for (int second = 0; good && second <= seconds; second++) {
        printf("t = %.1f s, %u people\n", jo_world_time(world), jo_world_agent_count(world));
        draw_world(&canvas, world, walls, count);
        const double until = second + 1;
        while (good && jo_world_time(world) < until - 1e-9)
            good = jo_scene_step(scene, &error);
    }
    free(walls);
    jo_scene_free(scene);
    return good ? 0 : 1;
}
