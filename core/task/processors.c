#include "task/processors.h"

#include <sched.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/file.h"

enum { MOST = 64, PATH_LENGTH = 4096 };

/* Reads the first line of a file; false if there is none. */
static bool read_first_line(char *line, int size, const char *path) {
    FILE *file = jox_file_open(path, "r");
    const bool read = file && fgets(line, size, file);
    if (file)
        jox_file_close(file);
    return read;
}

static uint32_t round_quota_up(double quota, double period) {
    if (!(quota > 0.0 && period > 0.0))
        return UINT32_MAX;
    const double processors = quota / period;
    const uint32_t whole = processors < 1e6 ? (uint32_t)processors : 1000000;
    return whole + ((double)whole < processors);
}

/* Reads the quota of one group, in processors: cpu.max of version 2, or two files of version 1.
   UINT32_MAX: none. */
static uint32_t read_group_quota(const char *folder) {
    char path[PATH_LENGTH + 32], line[128];
    double quota = 0.0, period = 0.0;
    snprintf(path, sizeof path, "%s/cpu.max", folder);
    if (read_first_line(line, sizeof line, path))
        return sscanf(line, "%lf %lf", &quota, &period) == 2 ? round_quota_up(quota, period)
                                                             : UINT32_MAX;
    snprintf(path, sizeof path, "%s/cpu.cfs_quota_us", folder);
    if (!read_first_line(line, sizeof line, path))
        return UINT32_MAX;
    quota = strtod(line, NULL); /* -1: no quota */
    snprintf(path, sizeof path, "%s/cpu.cfs_period_us", folder);
    period = read_first_line(line, sizeof line, path) ? strtod(line, NULL) : 0.0;
    return round_quota_up(quota, period);
}

/* Returns the least quota of a group and of all groups that contain it. Inside a container the path
   may be that of the outer system, while only the mounted root exists here. */
static uint32_t find_least_quota(const char *root, const char *group) {
    char folder[PATH_LENGTH];
    uint32_t least = UINT32_MAX;
    const size_t kept = strlen(root);
    const int length = snprintf(folder, sizeof folder, "%s%s", root, group);
    if (length < 0 || (size_t)length >= sizeof folder)
        return UINT32_MAX;
    for (;;) {
        const uint32_t quota = read_group_quota(folder);
        least = quota < least ? quota : least;
        char *slash = strrchr(folder + kept, '/');
        if (!slash)
            return least;
        *slash = '\0';
    }
}

/* Lines of `list` are "0::/group" of version 2, "4:cpu,cpuacct:/group" of version 1. */
uint32_t jox_processors_quota(const char *list, const char *root) {
    FILE *file = jox_file_open(list, "r");
    char line[PATH_LENGTH], folder[PATH_LENGTH + 16];
    uint32_t least = UINT32_MAX;
    while (file && fgets(line, sizeof line, file)) {
        line[strcspn(line, "\n")] = '\0';
        char *kinds = strchr(line, ':'), *group = kinds ? strchr(kinds + 1, ':') : NULL;
        if (!group)
            continue;
        *group++ = '\0';
        const bool second = kinds[1] == '\0';
        if (!second && strcmp(kinds + 1, "cpu") != 0 && strncmp(kinds + 1, "cpu,", 4) != 0)
            continue;
        snprintf(folder, sizeof folder, second ? "%s" : "%s/cpu", root);
        const uint32_t quota = find_least_quota(folder, group);
        least = quota < least ? quota : least;
    }
    if (file)
        jox_file_close(file);
    return least;
}

uint32_t jox_count_processors(void) {
    cpu_set_t set;
    const int listed = sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 1;
    const uint32_t quota = jox_processors_quota("/proc/self/cgroup", "/sys/fs/cgroup");
    const uint32_t count = (uint32_t)listed < quota ? (uint32_t)listed : quota;
    return count < 1 ? 1 : count > MOST ? MOST : count;
}
