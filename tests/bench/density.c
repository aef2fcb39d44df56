/* What a sample of local density and flow costs on the Mataf: 35,000 people, 100 m x 100 m, between
   the walls of scenes/tawaf.yaml; and the plain Gaussian of each person, added up cell by cell,
   which heeds no walls. And what it costs when the walls change. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "base/mem.h"
#include "record/fields/density.h"

enum { PEOPLE = 35000, ROUNDS = 20, FIELDS = 3 };
static const double PI = 3.14159265358979;
static const float SIZE = 50.0f, CELL = 0.316f;

static float x[PEOPLE], y[PEOPLE], vx[PEOPLE], vy[PEOPLE];
static float *fields[FIELDS];

static double read_cpu_time(void) {
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + (double)t.tv_nsec * 1e-9;
}

/* Between the Kaaba and the edge of the Mataf, denser inside. */
static void gather(void) {
    uint32_t dice = 1;
    for (int i = 0; i < PEOPLE; i++) {
        float at[2];
        for (int k = 0; k < 2; k++) {
            dice = dice * 1664525u + 1013904223u;
            at[k] = (float)(dice >> 8) / 16777216.0f;
        }
        float r = 14.0f + 34.0f * at[0] * sqrtf(at[0]), a = 6.2831853f * at[1];
        x[i] = r * cosf(a);
        y[i] = r * sinf(a);
        vx[i] = 0.5f;
        vy[i] = -0.5f;
    }
}

static JoxWalls walls(float shift) {
    JoxWalls walls = {0};
    const JoxV2 kaaba[] = {{5.68f, -6.35f}, {5.38f, 6.82f}, {-5.91f, 6.23f}, {-5.6f, -6.95f}};
    const JoxV2 hatim[] = {{5.38f, 6.82f},   {4.47f, 9.61f}, {2.3f, 11.56f}, {-0.56f, 12.17f},
                           {-3.34f, 11.26f}, {-5.3f, 9.09f}, {-5.91f, 6.23f}};
    const JoxV2 maqam[] = {{15.8f + shift, -1.5f},
                           {16.8f + shift, -1.5f},
                           {16.8f + shift, -0.5f},
                           {15.8f + shift, -0.5f}};
    jox_walls_add_solid(&walls, kaaba, 4, 13);
    jox_walls_add_polyline(&walls, hatim, 7, false, 1.3f);
    jox_walls_add_solid(&walls, maqam, 4, 3);
    return walls;
}

/* The Gaussian of each, cut off at three standard deviations. */
static void add_up(const JoxDensity *d) {
    const int reach = (int)(3.0f * JOX_DENSITY_KERNEL / d->cell);
    for (int f = 0; f < FIELDS; f++)
        memset(fields[f], 0, (size_t)d->columns * d->rows * sizeof(float));
    for (int i = 0; i < PEOPLE; i++) {
        const float weights[FIELDS] = {1.0f, 0.5f, -0.5f};
        float across[64], up[64];
        int column = (int)floorf((x[i] - d->low.x) / d->cell) - reach;
        int row = (int)floorf((y[i] - d->low.y) / d->cell) - reach;
        for (int k = 0; k <= 2 * reach; k++) {
            float dx = d->low.x + ((float)(column + k) + 0.5f) * d->cell - x[i];
            float dy = d->low.y + ((float)(row + k) + 0.5f) * d->cell - y[i];
            across[k] = expf(-dx * dx) / (float)PI;
            up[k] = expf(-dy * dy);
        }
        for (int r = 0; r <= 2 * reach; r++)
            for (int f = 0; f < FIELDS && row + r >= 0 && row + r < (int)d->rows; f++) {
                float *line = fields[f] + (size_t)(row + r) * d->columns, w = weights[f] * up[r];
                for (int c = column < 0 ? -column : 0;
                     c <= 2 * reach && column + c < (int)d->columns; c++)
                    line[column + c] += w * across[c];
            }
    }
}

static void sample(JoxDensity *d) {
    const JoxDensityCrowd crowd = {.count = PEOPLE, .x = x, .y = y, .weights = {NULL, vx, vy}};
    jox_density_sample(d, &crowd, FIELDS, fields);
}

int main(void) {
    JoxDensity *d =
        jox_density_create((JoxV2){-SIZE, -SIZE}, (JoxV2){SIZE, SIZE}, CELL, JOX_DENSITY_KERNEL);
    JoxWalls stand = walls(0.0f), other = walls(0.1f);
    double plain = INFINITY, within = INFINITY, open = INFINITY, change = INFINITY;
    gather();
    for (int f = 0; f < FIELDS; f++)
        fields[f] = jox_alloc((size_t)d->columns * d->rows, sizeof(float));
    for (int round = 0; round < ROUNDS; round++) { /* the best of each, in turns */
        double t0 = read_cpu_time();
        add_up(d);
        double t1 = read_cpu_time();
        jox_density_walls(d, NULL);
        sample(d);
        double t2 = read_cpu_time();
        jox_density_walls(d, round % 2 ? &stand : &other);
        double t3 = read_cpu_time();
        sample(d);
        double t4 = read_cpu_time();
        plain = fmin(plain, t1 - t0);
        open = fmin(open, t2 - t1);
        change = fmin(change, t3 - t2);
        within = fmin(within, t4 - t3);
    }
    printf("35,000 people, 3 fields of %u cells\n", d->columns * d->rows);
    printf("  Gaussians added up       %6.2f ms\n", 1e3 * plain);
    printf("  density without walls    %6.2f ms, ratio %.2f\n", 1e3 * open, open / plain);
    printf("  density within walls     %6.2f ms, ratio %.2f\n", 1e3 * within, within / plain);
    printf("  when the walls change    %6.2f ms\n", 1e3 * change);
    for (int f = 0; f < FIELDS; f++)
        jox_free(fields[f]);
    jox_walls_free(&stand);
    jox_walls_free(&other);
    jox_density_free(d);
    return 0;
}
