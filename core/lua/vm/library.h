/* Our versions of Lua's standard functions, and the text of values. sandbox.c puts the functions
   into the environment of scripts. */
#ifndef JOX_LUA_VM_LIBRARY_H
#define JOX_LUA_VM_LIBRARY_H

#include "lua/vm/vm.h"

/* Functions of each library; each list ends with a NULL name. */
extern const luaL_Reg jox_library_base[], jox_library_math[], jox_library_string[],
    jox_library_table[];

/* Pushes and returns the text of any value, never an address. A userdata is named by the field
   "__kind" of its metatable. */
const char *jox_library_text(lua_State *L, int index, size_t *length);
/* Returns the type name of a value as scripts see it: "table", "value". */
const char *jox_library_kind(lua_State *L, int index);
/* Compares strings byte by byte, in any locale; below, at or above 0 as strcmp. */
int jox_library_compare(const char *a, size_t a_length, const char *b, size_t b_length);

/* A text that grows in a Lua userdata, so that an error leaks nothing. Takes one stack slot until
   it is pushed. */
typedef struct JoxScratch {
    lua_State *L;
    char *data;
    size_t length, capacity;
    int slot;
} JoxScratch;
void jox_scratch_open(JoxScratch *scratch, lua_State *L, size_t capacity);
void jox_scratch_add(JoxScratch *scratch, const char *text, size_t length);
void jox_scratch_push(JoxScratch *scratch); /* replaces its slot by the text as a Lua string */

#endif
