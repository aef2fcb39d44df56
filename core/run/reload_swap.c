/* Swaps loaded machines for the running ones between two steps, on the stepping thread. */
#include <ctype.h>
#include <stdio.h>
#include <string.h>

#include "base/format/plurals.h"
#include "base/mem.h"
#include "run/group_links.h"
#include "run/input_log.h"
#include "run/reload_batch.h"
#include "run/scene_machines.h"
#include "run/tags_and_teams.h"

/* Writes the number of agents in each state: "  Circle 31204  Exit 310". */
static void write_census(const JoxMachine *machine, const uint32_t *people, JoxText *out) {
    char number[JOX_NOUN];
    for (uint32_t s = 0; s < machine->state_count; s++)
        if (people[s])
            jox_text_printf(out, "  %s %s", machine->states[s].name,
                            jox_number_text(number, people[s]));
}

/* Says why a batch is not taken, and which versions go on. */
static void report_refusal(JoScene *scene, JoxBatch *batch, const char *path, const char *why) {
    const JoxMachineRun *machines = &scene->world->machines;
    char number[JOX_NOUN];
    if (why)
        jox_diag_error(&batch->diagnostics, ((JoxPosition){path, 0, 0, 0}), "cannot-swap", NULL,
                       "%s", why);
    jox_run_call_diagnosed(scene->diagnosed, scene->diagnosed_context, batch->parts,
                           &batch->diagnostics);
    jox_run_report_diagnostics(scene->message, scene->message_context, &batch->diagnostics, NULL);
    jox_run_call_diagnosed(scene->diagnosed, scene->diagnosed_context, batch->parts, NULL);
    for (uint32_t c = 0; c < batch->count; c++) {
        if (batch->changes[c].added)
            continue;
        const JoxMachine *machine = machines->set->items[batch->changes[c].index];
        char version[JOX_VERSION_TEXT];
        jox_machine_version(machine, version);
        jox_run_say(scene, " %c%s%s%s keeps running; %s unaffected.\n",
                    toupper((unsigned char)*version), version + 1, batch->count > 1 ? " of " : "",
                    batch->count > 1 ? machine->name : "",
                    jox_noun(number, machines->agents->count, "agent"));
    }
    if (batch->count == 0)
        jox_run_say(scene, " The scene goes on as it was.\n");
}

/* Adds the machines that others become, and links the states that become them. */
static void link_batch(JoScene *scene, JoxBatch *batch) {
    JoxMachineRun *machines = &scene->world->machines;
    for (uint32_t c = 0; c < batch->count; c++) {
        JoxChange *change = &batch->changes[c];
        if (!change->added)
            continue;
        JoxMachine *machine = jox_loaded_machine(change->loaded);
        jox_lua_adopt(scene->lua, change->loaded);
        jox_run_number_tags_and_teams(scene, machine);
        change->index = jox_machines_add(machines, machine);
        jox_run_tell_replaced(scene, change->index);
    }
    jox_run_link_groups(scene, scene->spec, NULL);
    for (uint32_t m = 0; m < machines->set->count; m++) {
        JoxDiagnostics none = {0};
        jox_run_link_becomes(scene, machines->set->built[m], &none);
        jox_diag_free(&none);
    }
}

/* Gives agents the values that the scene sets and the old version had no slot for. */
static void give_new_values(JoScene *scene, const JoxChange *change, const JoxMachine *old,
                            const JoxMachine *next) {
    const JoxSceneSpec *spec = scene->spec;
    for (uint32_t s = 0; s < next->own_count; s++) {
        bool known = !*next->own[s].name;
        for (uint32_t o = 0; o < old->own_count && !known; o++)
            known = strcmp(old->own[o].name, next->own[s].name) == 0;
        for (uint32_t g = 0; g < spec->group_count && !known; g++)
            for (uint32_t k = 0; k < spec->groups[g].set_count; k++)
                if (strcmp(spec->groups[g].set[k].name, next->own[s].name) == 0 &&
                    spec->groups[g].set[k].kind != JOX_SET_ANTIPODE)
                    jox_run_give_group_value(scene, (int32_t)change->index, g,
                                             &spec->groups[g].set[k]);
    }
}

static bool same_states(const JoxMachine *a, const JoxMachine *b) {
    bool same = a->state_count == b->state_count;
    for (uint32_t s = 0; same && s < a->state_count; s++)
        same = strcmp(a->states[s].name, b->states[s].name) == 0;
    return same;
}

/* Swaps the machines of a batch; the old ones go to `retired`. */
static void swap_machines(JoScene *scene, JoxBatch *batch, JoxRetired *retired) {
    JoxMachineRun *machines = &scene->world->machines;
    JoxText text = {0};
    uint32_t before[1000], after[1000];
    retired->machines = jox_alloc(batch->count + 1, sizeof *retired->machines);
    for (uint32_t c = 0; c < batch->count; c++) {
        JoxChange *change = &batch->changes[c];
        if (change->added)
            continue;
        double begun = jox_clock_wall();
        jox_machines_people(machines, change->index, before);
        JoxMachine *next = jox_loaded_machine(change->loaded);
        jox_run_number_tags_and_teams(scene, next);
        JoxMachine *old = jox_machines_replace(machines, change->index, change->replacement);
        jox_run_link_groups(scene, scene->spec, NULL);
        give_new_values(scene, change, old, next);
        retired->machines[retired->count++] = jox_lua_retire(scene->lua, old);
        jox_lua_adopt(scene->lua, change->loaded);
        jox_machines_people(machines, change->index, after);
        uint32_t people = 0;
        char number[JOX_NOUN], version[JOX_VERSION_TEXT];
        for (uint32_t s = 0; s < next->state_count; s++)
            people += after[s];
        if (!same_states(old, next)) /* a recording has to name the new states */
            jox_run_tell_replaced(scene, change->index);
        double took = jox_clock_wall() - begun;
        scene->swap_seconds = took > scene->swap_seconds ? took : scene->swap_seconds;
        jox_text_printf(&text, "%s: %s is live from t = %.2f s", next->path,
                        jox_machine_version(next, version), jo_world_time(scene->world));
        if (batch->written > 0.0)
            jox_text_printf(&text, " (saved %.0f ms ago, swapped in %.2f ms)",
                            (jox_clock_date() - batch->written) * 1e3, took * 1e3);
        jox_text_add(&text, "\n before:");
        write_census(old, before, &text);
        jox_text_add(&text, "\n after: ");
        write_census(next, after, &text);
        jox_text_add(&text, "\n");
        const size_t notes = text.length;
        if (people > 0)
            jox_replacement_tell(change->replacement, jox_noun(number, people, "person|people"),
                                 &text);
        jox_run_tell_reloaded(scene, &(JoxReloadNews){.path = next->path,
                                                      .old = old,
                                                      .next = next,
                                                      .before = before,
                                                      .after = after,
                                                      .notes = text.data + notes});
    }
    link_batch(scene, batch);
    if (text.data)
        jox_run_send_text(scene, text.data);
    jox_run_tell_reloaded(scene, NULL);
    jox_text_free(&text);
}

/* Notes the texts that differ from those that are live, for the input log. */
static void note_batch_files(JoScene *scene, const JoxBatch *batch, JoxReloadedFiles *reloaded) {
    for (uint32_t c = 0; c < batch->count; c++) {
        uint32_t count;
        const JoxLuaFile *files = jox_loaded_files(batch->changes[c].loaded, &count);
        for (uint32_t f = 0; f < count; f++) {
            size_t length;
            const char *text = jox_loaded_text(batch->changes[c].loaded, f, &length);
            jox_run_note_file(scene, reloaded, files[f].path, files[f].sha256, text, length);
        }
    }
    for (uint32_t f = 0; batch->spec && f < batch->spec->file_count; f++) {
        const JoxSceneFile *file = &batch->spec->files[f];
        jox_run_note_file(scene, reloaded, file->path, file->sha256, file->text, file->length);
    }
}

/* Takes the batch over. True if it is live. */
bool jox_batch_swap(JoScene *scene, JoxBatch *batch) {
    JoxReload *r = scene->reload;
    char why[256];
    bool live = false;
    const char *refused = NULL, *path = "";
    if (batch->said.length)
        jox_run_send_text(scene, batch->said.data);
    for (uint32_t c = 0; c < batch->count && !batch->failed && !refused; c++)
        if (!batch->changes[c].added) {
            path = batch->changes[c].path;
            if (batch->changes[c].edits != r->edits[batch->changes[c].index])
                jox_batch_compare(r, &batch->changes[c]); /* a parameter was set meanwhile */
            refused = jox_machines_refuses(&scene->world->machines, batch->changes[c].index,
                                           batch->changes[c].replacement, why, sizeof why);
        }
    JoxRetired *retired = jox_alloc(1, sizeof *retired);
    retired->batch = batch;
    if (batch->failed || refused) {
        report_refusal(scene, batch, path, refused);
    } else {
        jox_run_call_diagnosed(scene->diagnosed, scene->diagnosed_context, batch->parts,
                               &batch->diagnostics);
        jox_run_report_diagnostics(scene->message, scene->message_context, &batch->diagnostics,
                                   NULL);
        JoxReloadedFiles reloaded = {0};
        retired->live = live = true;
        if (scene->log)
            note_batch_files(scene, batch, &reloaded);
        swap_machines(scene, batch, retired);
        if (batch->spec)
            jox_run_reload_scene(scene, &batch->spec, batch->written);
        jox_run_log_files(scene, &reloaded);
        if (batch->sets)
            jox_setting_went_live(scene, &batch->setting);
    }
    atomic_store(&r->machine_count, scene->world->model.machines.count);
    retired->next = (JoxRetired *)atomic_load(&r->retired);
    while (
        !atomic_compare_exchange_weak(&r->retired, (uintptr_t *)&retired->next, (uintptr_t)retired))
        ;
    return live;
}
