/* What the library tells of a run, as values of Lua. */
#ifndef JOSTLE_LUA_FIGURES_H
#define JOSTLE_LUA_FIGURES_H

#include <lua.h>

/* Pushes what `push` makes of a struct that the library returned, which is freed in any case; NULL
   is an error: memory is out. */
int jol_push(lua_State *L, lua_CFunction push, void *told);
/* For it: of a JoFigures, in their order, tables within each other; one that is not known is nil.
 */
int jol_push_figures(lua_State *L);
/* Of a JoTable, its columns by name and unit, as lists. */
int jol_push_table(lua_State *L);

#endif
