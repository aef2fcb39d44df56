/* Pages and files generated from the vocabulary. The command `jostle reference` prints them. */
#ifndef JOX_LUA_BEHAVIOUR_REFERENCE_H
#define JOX_LUA_BEHAVIOUR_REFERENCE_H

#include "base/text.h"

/* Prints every word, parameter and key with its example, as Markdown. */
void jox_lua_reference(JoxText *out);
/* Prints definitions for lua-language-server (---@meta). */
void jox_lua_definitions(JoxText *out);
/* Prints the configuration of luacheck, .luacheckrc. */
void jox_lua_luacheck(JoxText *out);
/* Prints example number n as a whole behaviour and its name; false past the last. The scene must be
   a yard with the places yard, mid, post, row and ends (a set of post and far), the tag people, and
   a ball. *of_mod: it is a mod's file, and the mod has a setting `reach`. */
bool jox_lua_example(size_t n, JoxText *name, JoxText *out, bool *of_mod);

#endif
