/* Memory that a version of a machine lacks and an earlier one had: it is kept, out of sight, until
   a later version names it again. */
#include <stdio.h>
#include <string.h>

#include "base/mem.h"
#include "machine/internal.h"

const char *jox_name_before(const JoxMachine *old, const JoxMachine *next, JoxPart part,
                            const char *name) {
    for (uint32_t r = 0; r < next->renamed_count && !jox_machine_has(old, part, name); r++)
        if (strcmp(next->renamed[r].to, name) == 0 &&
            jox_machine_has(old, part, next->renamed[r].from) &&
            !jox_machine_has(next, part, next->renamed[r].from))
            return next->renamed[r].from;
    return name;
}

/* What a slot of the new version was in the old one: its identity then. */
static const char *identity_before(const JoxMachine *old, const JoxMachine *next, uint32_t slot,
                                   char buffer[256]) {
    const char *is = jox_memory_identity(&next->memory[slot]);
    const bool counter = *is == *JOX_IDENTITY_ANGLE || *is == *JOX_IDENTITY_BEGUN;
    const char *before = jox_name_before(old, next, JOX_PART_MEMORY, is + counter);
    if (!counter || strlen(before) > 250)
        return before;
    snprintf(buffer, 256, "%c%s", *is, before);
    return buffer;
}

int32_t jox_memory_before(const JoxMachine *old, const JoxMachine *next, uint32_t slot) {
    char buffer[256];
    const JoxMemorySlot *now = &next->memory[slot];
    const char *before = identity_before(old, next, slot, buffer);
    uint32_t nth = 0; /* states may have counters of the same name */
    for (uint32_t s = 0; s < slot; s++)
        nth += next->memory[s].kind == now->kind &&
               strcmp(jox_memory_identity(&next->memory[s]), jox_memory_identity(now)) == 0;
    for (uint32_t s = 0; s < old->memory_count; s++)
        if (old->memory[s].kind == now->kind &&
            strcmp(jox_memory_identity(&old->memory[s]), before) == 0 && nth-- == 0)
            return (int32_t)s;
    return -1;
}

/* Whether an old slot goes on in the new version. */
static bool goes_on(const JoxMachine *old, const JoxMachine *next, uint32_t slot) {
    for (uint32_t s = 0; s < next->memory_count; s++)
        if (jox_memory_before(old, next, s) == (int32_t)slot)
            return true;
    return false;
}

void jox_dormant_add(JoxMachine *machine, const char *identity, JoxMemoryKind kind,
                     double initial) {
    machine->memory =
        jox_realloc(machine->memory, machine->memory_count + 1, sizeof *machine->memory);
    machine->memory[machine->memory_count++] = (JoxMemorySlot){.name = jox_strdup(""),
                                                               .identity = jox_strdup(identity),
                                                               .dormant = true,
                                                               .kind = kind,
                                                               .initial = initial};
}

/* Takes the oldest dormant slots out beyond what is kept: they were added first. */
static void drop_oldest(JoxMachine *machine) {
    uint32_t dormant = 0, kept = 0;
    for (uint32_t s = 0; s < machine->memory_count; s++)
        dormant += machine->memory[s].dormant;
    for (uint32_t s = 0; s < machine->memory_count; s++) {
        if (machine->memory[s].dormant && dormant > JOX_MOST_DORMANT) {
            dormant--;
            jox_free(machine->memory[s].name);
            jox_free(machine->memory[s].identity);
        } else {
            machine->memory[kept++] = machine->memory[s];
        }
    }
    machine->memory_count = kept;
}

/* Name of the memory that the new version renames to a dormant slot's name, in whose place it
   comes; NULL: there is none. */
static const char *replaced_by(const JoxMachine *old, const JoxMachine *next,
                               const JoxMemorySlot *slot) {
    const char *is = jox_memory_identity(slot);
    const char *name = is + (*is == *JOX_IDENTITY_ANGLE || *is == *JOX_IDENTITY_BEGUN);
    const char *before = jox_name_before(old, next, JOX_PART_MEMORY, name);
    return slot->dormant && strcmp(before, name) != 0 ? before : NULL;
}

void jox_dormant_keep(const JoxMachine *old, JoxMachine *next) {
    for (int dormant = 1; dormant >= 0; dormant--) /* the oldest first */
        for (uint32_t s = 0; s < old->memory_count; s++) {
            const JoxMemorySlot *slot = &old->memory[s];
            if (slot->dormant == (dormant != 0) && *jox_memory_identity(slot) &&
                !goes_on(old, next, s) && !replaced_by(old, next, slot))
                jox_dormant_add(next, jox_memory_identity(slot), slot->kind, slot->initial);
        }
    drop_oldest(next);
}

/* ---- what people are told ---- */

static bool is_written(const JoxMemorySlot *slot) {
    const char *identity = jox_memory_identity(slot);
    return *identity > '\2' && strcmp(identity, "home x") != 0 && strcmp(identity, "home y") != 0;
}

static const char *kind_of(const JoxMemorySlot *slot) {
    return slot->kind == JOX_MEMORY_BOOLEAN ? "true or false" : "a number";
}

/* Slot of the new version with the name of an old one that it does not go on from; -1: none. */
static int32_t of_other_kind(const JoxMachine *next, const JoxMemorySlot *slot) {
    for (uint32_t s = 0; s < next->memory_count; s++)
        if (*next->memory[s].name && strcmp(next->memory[s].name, jox_memory_identity(slot)) == 0 &&
            next->memory[s].kind != slot->kind)
            return (int32_t)s;
    return -1;
}

/* Tells of a memory that is now of another kind, which people may have had of that kind before. */
static void tell_of_kind(const JoxMachine *old, const JoxMachine *next, const JoxMemorySlot *now,
                         uint32_t other, const char *people, JoxText *out) {
    jox_text_printf(out, " memory '%.60s' was %s and is %s now: ", jox_memory_identity(now),
                    kind_of(now), kind_of(&next->memory[other]));
    if (jox_memory_before(old, next, other) < 0)
        jox_text_printf(out, "%s begin with what it begins with, and ", people);
    jox_text_printf(out, "what they had is kept until it is %s again\n", kind_of(now));
}

/* Tells of dormant memory that the new version no longer keeps. */
static void tell_of_dropped(const JoxMachine *old, const JoxMachine *next, JoxText *out) {
    for (uint32_t s = 0; s < old->memory_count; s++) {
        const JoxMemorySlot *slot = &old->memory[s];
        if (!slot->dormant || !is_written(slot) || goes_on(old, next, s))
            continue;
        const char *by = replaced_by(old, next, slot);
        const char *name = jox_memory_identity(slot);
        if (by)
            jox_text_printf(out,
                            " memory '%.60s' that was kept is dropped: '%.60s' is renamed to it\n",
                            name, by);
        else
            jox_text_printf(out,
                            " memory '%.60s', which no version named for long, is dropped: at most "
                            "%d are kept\n",
                            name, JOX_MOST_DORMANT);
    }
}

void jox_dormant_tell(const JoxMachine *old, const JoxMachine *next, const char *people,
                      JoxText *out) {
    for (uint32_t s = 0; s < next->memory_count; s++) {
        const JoxMemorySlot *now = &next->memory[s];
        const int32_t from = jox_memory_before(old, next, s);
        const JoxMemorySlot *was = from < 0 ? NULL : &old->memory[from];
        if (!was || was->dormant == now->dormant || !is_written(now))
            continue;
        const char *name = jox_memory_identity(now);
        const int32_t other = now->dormant ? of_other_kind(next, now) : -1;
        if (other >= 0)
            tell_of_kind(old, next, now, (uint32_t)other, people, out);
        else if (now->dormant)
            jox_text_printf(out, " memory '%.60s' of %s is kept until a version names it again\n",
                            name, people);
        else
            jox_text_printf(out, " memory '%.60s' of %s is what it was when it was last named\n",
                            name, people);
    }
    tell_of_dropped(old, next, out);
}
