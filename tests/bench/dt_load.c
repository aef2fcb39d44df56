/* How mean load and compression of moving crowds depend on the step: for each of three scenes and
   each step the mean over people, time and seeds, its share of that at .05 s, and the standard
   error over seeds. Arguments: how many seeds (3), and the name of one scene. */
#include "unit/load_crowd.h"

static void add_share(CrowdMeans *to, CrowdMeans one, double share) {
    to->load += one.load * share;
    to->compression += one.compression * share;
    to->overlap += one.overlap * share;
    to->speed += one.speed * share;
}

int main(int argc, char **argv) {
    static const double steps[] = {0.05, 0.025, 0.0125};
    int seeds = argc > 1 ? atoi(argv[1]) : 3;
    printf("%-8s %7s %8s %7s %6s %12s %7s %6s %12s %11s\n", "scene", "dt_s", "load_N", "share",
           "error", "compress_N/m", "share", "error", "overlap_mm", "speed_m/s");
    for (int scene = 0; scene < CROWD_SCENES; scene++) {
        if (argc > 2 && strcmp(argv[2], crowd_scenes[scene]) != 0)
            continue;
        CrowdMeans first = {0};
        for (int k = 0; k < 3; k++) {
            CrowdMeans mean = {0};
            double load2 = 0.0, compression2 = 0.0;
            for (int seed = 1; seed <= seeds; seed++) {
                CrowdMeans one = crowd_means(scene, (uint64_t)seed, steps[k]);
                add_share(&mean, one, 1.0 / seeds);
                load2 += one.load * one.load / seeds;
                compression2 += one.compression * one.compression / seeds;
            }
            if (k == 0)
                first = mean;
            double n = seeds > 1 ? seeds - 1 : NAN;
            printf("%-8s %7g %8.1f %7.3f %6.3f %12.1f %7.3f %6.3f %12.2f %11.3f\n",
                   crowd_scenes[scene], steps[k], mean.load, mean.load / first.load,
                   sqrt(fmax(0.0, load2 - mean.load * mean.load) / n) / mean.load, mean.compression,
                   mean.compression / first.compression,
                   sqrt(fmax(0.0, compression2 - mean.compression * mean.compression) / n) /
                       mean.compression,
                   1e3 * mean.overlap, mean.speed);
            fflush(stdout);
        }
    }
    return 0;
}
