/* What the files of the library share: our versions of Lua's own functions, and text. */
#ifndef JOX_LUA_VM_LIBRARY_H
#define JOX_LUA_VM_LIBRARY_H

#include "lua/vm/vm.h"

/* Each list ends with a NULL name. */
extern const luaL_Reg jox_library_base[], jox_library_math[], jox_library_string[],
    jox_library_table[];

/* Pushes the text of any value; never an address. A userdata is called what the field "__kind" of
   its metatable says. */
const char *jox_library_text(lua_State *L, int index, size_t *length);
/* The kind of a value as scripts know it. */
const char *jox_library_kind(lua_State *L, int index);
/* Order of strings byte by byte, whatever the locale. */
int jox_library_compare(const char *a, size_t a_length, const char *b, size_t b_length);

/* Text that grows in Lua's memory, so that an error leaks nothing. Keeps one stack slot. */
typedef struct JoxScratch {
    lua_State *L;
    char *data;
    size_t length, capacity;
    int slot;
} JoxScratch;
void jox_scratch_open(JoxScratch *scratch, lua_State *L, size_t capacity);
void jox_scratch_add(JoxScratch *scratch, const char *text, size_t length);
void jox_scratch_push(JoxScratch *scratch); /* the text as a Lua string */

#endif
