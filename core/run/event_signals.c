/* Numbers the signals that events give. build_scene.c calls it for a scene that begins,
   reload_scene.c for one that was edited. */
#include <string.h>

#include "run/event_signals.h"
#include "run/run.h"

enum { MOST_NAMES = 256 };

void jox_run_number_event_signals(JoScene *scene, JoxDiagnostics *diagnostics) {
    JoxMachineRun *machines = &scene->world->machines;
    const char *names[MOST_NAMES];
    uint32_t count = 0;
    bool hooks = false;
    for (uint32_t m = 0; m < machines->set->count; m++) {
        const JoxMachine *machine = machines->set->items[m];
        hooks |= machine->hook_count > 0;
        for (uint32_t n = 0; n < machine->name_count && count < MOST_NAMES; n++)
            if (machine->names[n].uses & JOX_NAME_HEARD)
                names[count++] = machine->names[n].text;
    }
    for (uint32_t e = 0; e < scene->spec->event_count; e++) {
        const JoxEvent *event = &scene->spec->events[e];
        bool heard = event->kind != JOX_EVENT_SIGNAL || hooks;
        if (event->kind == JOX_EVENT_SIGNAL)
            jox_machines_name(machines, event->name); /* a step finds it by this name */
        for (uint32_t n = 0; n < count && !heard; n++)
            heard = strcmp(names[n], event->name) == 0;
        char hint[JOX_HINT];
        if (!heard && diagnostics)
            jox_diag_warn(diagnostics, event->position, "unheard-signal",
                          jox_did_you_mean(event->name, names, count, hint),
                          "no machine of the scene hears the signal '%.60s'", event->name);
    }
}
