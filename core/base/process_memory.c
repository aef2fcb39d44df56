#include "base/process_memory.h"

#include <stdio.h>
#include <unistd.h>

JoxProcessMemory jox_read_process_memory(void) {
    unsigned long long pages[2] = {0, 0};
    FILE *file = fopen("/proc/self/statm", "r");
    if (file && fscanf(file, "%llu %llu", &pages[0], &pages[1]) != 2)
        pages[0] = pages[1] = 0;
    if (file)
        fclose(file);
    const uint64_t size = (uint64_t)sysconf(_SC_PAGESIZE);
    return (JoxProcessMemory){pages[0] * size, pages[1] * size};
}
