/* Dormant memory: slots of earlier versions of a machine that the present version does not name.
   They are kept hidden until a later version names them again. Called by replace.c. */
#include <stdio.h>
#include <string.h>

#include "base/mem.h"
#include "machine/machine_parts.h"

const char *jox_name_before(const JoxMachine *old, const JoxMachine *next, JoxPart part,
                            const char *name) {
    for (uint32_t r = 0; r < next->renamed_count && !jox_machine_has(old, part, name); r++)
        if (strcmp(next->renamed[r].to, name) == 0 &&
            jox_machine_has(old, part, next->renamed[r].from) &&
            !jox_machine_has(next, part, next->renamed[r].from))
            return next->renamed[r].from;
    return name;
}

/* Returns the identity that a slot of the new version had in the old one; `buffer` may hold it. */
static const char *find_old_identity(const JoxMachine *old, const JoxMachine *next, uint32_t slot,
                                     char buffer[256]) {
    const char *is = jox_memory_identity(&next->memory[slot]);
    const char *state = *is == *JOX_IDENTITY_CAME_FROM ? is + 1 : NULL;
    const char *owner = state ? state : jox_identity_owner(is);
    const char *before =
        jox_name_before(old, next, state ? JOX_PART_STATE : JOX_PART_MEMORY, owner ? owner : is);
    if (!owner || strlen(before) > 250)
        return before;
    snprintf(buffer, 256, "%.*s%s", (int)(owner - is), is, before);
    return buffer;
}

int32_t jox_memory_before(const JoxMachine *old, const JoxMachine *next, uint32_t slot) {
    char buffer[256];
    const JoxMemorySlot *now = &next->memory[slot];
    const char *before = find_old_identity(old, next, slot, buffer);
    uint32_t nth = 0; /* several states may have counters of the same name */
    for (uint32_t s = 0; s < slot; s++)
        nth += next->memory[s].kind == now->kind &&
               strcmp(jox_memory_identity(&next->memory[s]), jox_memory_identity(now)) == 0;
    for (uint32_t s = 0; s < old->memory_count; s++)
        if (old->memory[s].kind == now->kind &&
            strcmp(jox_memory_identity(&old->memory[s]), before) == 0 && nth-- == 0)
            return (int32_t)s;
    return -1;
}

/* Returns whether an old slot continues in the new version. */
static bool continues_slot(const JoxMachine *old, const JoxMachine *next, uint32_t slot) {
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

/* Removes the oldest dormant slots beyond JOX_MOST_DORMANT; the oldest come first. */
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

/* Returns the old name of the memory that the new version renames to a dormant slot's name, and
   that replaces it; NULL: none. */
static const char *find_replacing_name(const JoxMachine *old, const JoxMachine *next,
                                       const JoxMemorySlot *slot) {
    const char *is = jox_memory_identity(slot);
    const char *name = jox_identity_owner(is) ? jox_identity_owner(is) : is;
    const char *before = jox_name_before(old, next, JOX_PART_MEMORY, name);
    return slot->dormant && strcmp(before, name) != 0 ? before : NULL;
}

void jox_dormant_keep(const JoxMachine *old, JoxMachine *next) {
    for (int dormant = 1; dormant >= 0; dormant--) /* oldest first */
        for (uint32_t s = 0; s < old->memory_count; s++) {
            const JoxMemorySlot *slot = &old->memory[s];
            if (slot->dormant == (dormant != 0) && *jox_memory_identity(slot) &&
                !continues_slot(old, next, s) && !find_replacing_name(old, next, slot))
                jox_dormant_add(next, jox_memory_identity(slot), slot->kind, slot->initial);
        }
    drop_oldest(next);
}

/* ---- messages ---- */

/* Returns whether the slot is memory of the behaviour's author, not a hidden one or a post. */
static bool is_named_by_author(const JoxMemorySlot *slot) {
    const char *identity = jox_memory_identity(slot);
    return *identity > *JOX_IDENTITY_ITEM && strcmp(identity, "home x") != 0 &&
           strcmp(identity, "home y") != 0;
}

static const char *describe_kind(const JoxMemorySlot *slot) {
    static const char *const KINDS[] = {[JOX_MEMORY_NUMBER] = "a number",
                                        [JOX_MEMORY_BOOLEAN] = "true or false",
                                        [JOX_MEMORY_SOMEBODY] = "somebody",
                                        [JOX_MEMORY_LIST] = "a list of numbers",
                                        [JOX_MEMORY_PEOPLE] = "a list of somebody"};
    return KINDS[slot->kind];
}

/* Returns the slot of the new version that has the name of `slot` but another kind, or -1. */
static int32_t find_slot_of_other_kind(const JoxMachine *next, const JoxMemorySlot *slot) {
    for (uint32_t s = 0; s < next->memory_count; s++)
        if (*next->memory[s].name && strcmp(next->memory[s].name, jox_memory_identity(slot)) == 0 &&
            next->memory[s].kind != slot->kind)
            return (int32_t)s;
    return -1;
}

/* Tells that a memory changed its kind, so that its old values become dormant. */
static void tell_kind_changed(const JoxMachine *old, const JoxMachine *next,
                              const JoxMemorySlot *now, uint32_t other, const char *people,
                              JoxText *out) {
    jox_text_printf(out, " memory '%.60s' was %s and is %s now: ", jox_memory_identity(now),
                    describe_kind(now), describe_kind(&next->memory[other]));
    if (jox_memory_before(old, next, other) < 0)
        jox_text_printf(out, "%s start with its initial value, and ", people);
    jox_text_printf(out, "their old values are kept until it is %s again\n", describe_kind(now));
}

/* Tells which dormant memory the new version drops. */
static void tell_dropped(const JoxMachine *old, const JoxMachine *next, JoxText *out) {
    for (uint32_t s = 0; s < old->memory_count; s++) {
        const JoxMemorySlot *slot = &old->memory[s];
        if (!slot->dormant || !is_named_by_author(slot) || continues_slot(old, next, s))
            continue;
        const char *by = find_replacing_name(old, next, slot);
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
        if (was && !was->dormant && !now->dormant && now->capacity < was->capacity)
            jox_text_printf(out,
                            " the list '%.60s' holds at most %u items now: where there are more, "
                            "the oldest are dropped\n",
                            now->name, now->capacity);
        if (!was || was->dormant == now->dormant || !is_named_by_author(now))
            continue;
        const char *name = jox_memory_identity(now);
        const int32_t other = now->dormant ? find_slot_of_other_kind(next, now) : -1;
        if (other >= 0)
            tell_kind_changed(old, next, now, (uint32_t)other, people, out);
        else if (now->dormant)
            jox_text_printf(out, " memory '%.60s' of %s is kept until a version names it again\n",
                            name, people);
        else
            jox_text_printf(
                out,
                " memory '%.60s' of %s has the value again that it had when it was last named\n",
                name, people);
    }
    tell_dropped(old, next, out);
}
