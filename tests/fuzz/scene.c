/* Reads any bytes as a scene: it is read, or has errors. */
#include <string.h>

#include "scene/scene.h"
#include "support/fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    JoxDiagnostics diagnostics = {0};
    JoxSceneSpec *scene =
        jox_scene_read_text("tests/fuzz/fuzz.yaml", (const char *)data, size, NULL, &diagnostics);
    FUZZ_CHECK((scene != NULL) == (diagnostics.errors == 0));
    jox_scene_free(scene);
    fuzz_end_diagnostics(&diagnostics);
    return 0;
}
