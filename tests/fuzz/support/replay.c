/* Replaces libFuzzer in builds without it: runs a target on every file of the arguments, also below
   folders, and with --mutate N on N mutations of each, the same every time.
     TARGET [--mutate N] FILE|FOLDER... */
#include <ftw.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fuzz.h"

enum { LARGEST = 1 << 20 };
static uint64_t inputs, dice;
static long mutations;

static uint32_t roll(size_t sides) {
    dice = dice * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)(dice >> 33) % (uint32_t)sides;
}

/* Changes a byte, removes some bytes, or copies some over others; returns the new size. */
static size_t mutate_input(uint8_t *data, size_t size) {
    const size_t from = roll(size), at = roll(size);
    size_t n = 1 + roll(16);
    switch (roll(4)) {
    case 0:
        data[at] = (uint8_t)roll(256);
        return size;
    case 1:
        data[at] ^= (uint8_t)(1u << roll(8));
        return size;
    case 2:
        n = n < size - at ? n : size - at;
        memmove(data + at, data + at + n, size - at - n);
        return size > n ? size - n : size;
    default:
        n = n < size - from ? n : size - from;
        n = n < size - at ? n : size - at;
        memmove(data + at, data + from, n);
        return size;
    }
}

/* Runs the target on a copy of exact size, so that a sanitizer sees reads beyond it. */
static void run_input(const uint8_t *data, size_t size) {
    uint8_t *copy = malloc(size ? size : 1);
    if (!copy)
        abort();
    memcpy(copy, data, size);
    LLVMFuzzerTestOneInput(copy, size);
    free(copy);
    inputs++;
}

static int run_input_file(const char *path, const struct stat *info, int kind, struct FTW *walk) {
    static uint8_t whole[LARGEST], changed[LARGEST];
    (void)info;
    (void)walk;
    if (kind != FTW_F)
        return 0;
    FILE *file = fopen(path, "rb");
    if (!file) {
        perror(path);
        return 1;
    }
    const size_t size = fread(whole, 1, sizeof whole, file);
    fclose(file);
    fprintf(stderr, "%s\n", path);
    run_input(whole, size);
    dice = size;
    for (long m = 0; size > 0 && m < mutations; m++) {
        size_t now = size;
        memcpy(changed, whole, size);
        for (uint32_t k = 1 + roll(4); k > 0; k--)
            now = mutate_input(changed, now);
        run_input(changed, now);
    }
    return 0;
}

int main(int argc, char **argv) {
    int first = 1, status = 0;
    if (argc > 2 && !strcmp(argv[1], "--mutate")) {
        mutations = strtol(argv[2], NULL, 10);
        first = 3;
    }
    for (int a = first; a < argc && status == 0; a++)
        status = nftw(argv[a], run_input_file, 16, FTW_PHYS);
    printf("%llu inputs\n", (unsigned long long)inputs);
    return status == 0 && inputs > 0 ? 0 : 1;
}
