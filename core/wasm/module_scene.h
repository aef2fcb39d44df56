/* An open scene of the WebAssembly module. */
#ifndef JOX_WASM_MODULE_SCENE_H
#define JOX_WASM_MODULE_SCENE_H

#include "live/scene_page.h"
#include "view/worker.h"
#include "wasm/module.h"

typedef struct JoxModuleScene {
    JoxHeap *heap;     /* heap of the page; the scene has its own */
    JoxScenePage page; /* its loop is the host's */
    JoViewDef def;
    char *path;
    const char **sets, **mods;
    char *said;            /* what the scene has said since the host last asked; or NULL */
    JoxDiagnostics errors; /* of a reload */
    bool reported;         /* the last answer has the errors of the load */
    JoxWorkerMessage message;
} JoxModuleScene;

#endif
