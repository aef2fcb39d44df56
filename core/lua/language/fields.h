/* Fields of `me` and of views besides what a machine adds: their names, found by address, and their
   values. */
#ifndef JOX_LUA_LANGUAGE_FIELDS_H
#define JOX_LUA_LANGUAGE_FIELDS_H

#include "lua/language/script.h"

/* Fields besides memory and parameters. */
typedef enum {
    FIELD_X,
    FIELD_Y,
    FIELD_STOREY,
    FIELD_HEIGHT,
    FIELD_VX,
    FIELD_VY,
    FIELD_ID,
    FIELD_TIME,
    FIELD_TIME_IN_STATE,
    FIELD_DENSITY,
    FIELD_PUSHED,
    FIELD_COMPRESSION,
    FIELD_LOAD,
    FIELD_FALLEN,
    FIELD_TEAM,
    FIELD_GOAL,
    FIELD_STATE,
    FIELD_MACHINE,
    FIELD_NEIGHBOURS,
    FIELD_SIGNAL,
    FIELD_TELL,
    FIELD_TOLD,
    FIELD_HOLDING,
    FIELD_STRIKER,
    FIELD_IN_SIGHT,
    FIELD_COUNT
} JoxFieldKind;

/* Returns the entry of a key by its address, or the empty entry where it belongs. */
static inline JoxField *jox_field_find(JoxScript *script, const void *key) {
    const uintptr_t bits = (uintptr_t)key >> 4;
    for (uint32_t at = (uint32_t)(bits ^ bits >> 9);; at++) {
        JoxField *field = &script->fields[at % JOX_FIELDS];
        if (field->key == key || !field->key)
            return field;
    }
}

/* Adds the names of all fields and parameters. Raises errors, as the next one does: call both
   within jox_vm_call. */
void jox_fields_open(JoxScript *script);
/* Returns the text of the key at stack index 2; "?" if it is none. */
const char *jox_field_key(lua_State *L);
/* Returns the memory of a machine that the key at stack index 2, whose entry is `field`, names; -1
   if there is none. */
int32_t jox_field_slot(lua_State *L, const JoxScript *script, const JoxMachine *machine,
                       const JoxField *field);
/* Pushes a value of the agent besides its memory, state and machine; false if the field is none. */
bool jox_field_push(lua_State *L, const JoxMachineRun *machines, uint32_t i, const JoxField *field);

#endif
