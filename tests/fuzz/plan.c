/* Reads walls from well-known text or XML. */
#include <math.h>
#include <stdlib.h>

#include "scene/wall_files/wall_file.h"
#include "support/fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    const JoxWallFileOptions options = {.unit = 1, .height = 3};
    JoxDiagnostics diagnostics = {0};
    JoxWalls walls = {0};
    char *text = fuzz_text(data, size);
    const bool good = jox_wall_file_read("fuzz.wkt", text, size, &options, &walls, &diagnostics);
    FUZZ_CHECK(good == (diagnostics.errors == 0));
    for (uint32_t v = 0; v < walls.count; v++)
        FUZZ_CHECK(isfinite(walls.vertices[v].point.x) && isfinite(walls.vertices[v].point.y));
    jox_walls_free(&walls);
    fuzz_end_diagnostics(&diagnostics);
    free(text);
    return 0;
}
