/* Views of other agents and of bodies, which functions of behaviours get. */
#ifndef JOX_LUA_LANGUAGE_VIEWS_H
#define JOX_LUA_LANGUAGE_VIEWS_H

#include "lua/language/script.h"

typedef struct JoxView JoxView;

/* Registers views, and makes those that calls share. */
void jox_views_open(JoxScript *script);
/* Registers a type of userdata by its functions for reading and writing fields. */
void jox_view_add_type(lua_State *L, const char *type, lua_CFunction index, lua_CFunction newindex);
/* Pushes a view of an agent; the list of shared views is on top of the stack. */
JoxView *jox_view_push(lua_State *L, JoxScript *script, uint32_t agent);
/* Pushes whom a number means (JOX_WHO_BODY): a view, the name of a place, or nil. */
void jox_view_push_somebody(lua_State *L, JoxScript *script, double who);
/* Pushes a value of an agent's memory, whose first slot is `memory`; a list as a table of its own.
 */
void jox_view_push_memory(lua_State *L, JoxScript *script, const JoxMachine *machine,
                          const double *memory, int32_t slot);
/* Sets memory that is a list to the items of the table at a stack index; raises an error if they do
   not fit. */
void jox_view_set_list(lua_State *L, const JoxScript *script, double *memory, int32_t index,
                       int at);
/* Returns the value at a stack index as memory of the slot's kind; raises an error if it has
   another. */
double jox_view_check_memory(lua_State *L, const JoxScript *script, const JoxMemorySlot *slot,
                             int index);
/* The functions me.tell and me.told. */
int jox_me_tell(lua_State *L);
int jox_me_told(lua_State *L);

#endif
