/* Pages and files that are made of the vocabulary. */
#ifndef JOX_LUA_REFERENCE_H
#define JOX_LUA_REFERENCE_H

#include "base/text.h"

/* Every word, parameter and key with its example, as Markdown. */
void jox_lua_reference(JoxText *out);
/* Definitions for lua-language-server (---@meta). */
void jox_lua_definitions(JoxText *out);
/* A standard for luacheck: the text of .luacheckrc. */
void jox_lua_luacheck(JoxText *out);
/* A whole behaviour that uses example number n, for a yard with the places yard, mid, post, row,
   ends (a set of post and far), the tag people, and a ball; false where there are no more. The
   name says what it is of. A patch has `of_mod` set: it is a mod's file, with a setting `reach`. */
bool jox_lua_example(size_t n, JoxText *name, JoxText *out, bool *of_mod);

#endif
