#include "figures.h"

#include <lauxlib.h>
#include <math.h>

#include "jostle.h"

/* A figure; one that is not known is nil. */
static void push_figure(lua_State *L, const JoFigure *figure) {
    if (figure->kind == JO_FIGURE_TABLE || figure->kind == JO_FIGURE_LIST)
        lua_newtable(L);
    else if (figure->kind == JO_FIGURE_TRUTH)
        lua_pushboolean(L, figure->number != 0.0);
    else if (figure->kind == JO_FIGURE_TEXT)
        lua_pushstring(L, figure->text);
    else if (figure->kind != JO_FIGURE_NUMBER)
        lua_pushnil(L);
    else if (figure->number == floor(figure->number) && fabs(figure->number) < 9e15)
        lua_pushinteger(L, (lua_Integer)figure->number);
    else
        lua_pushnumber(L, figure->number);
}

/* The one of depth d lies in the table at d places above the base. */
int jol_push_figures(lua_State *L) {
    const JoFigures *figures = lua_touserdata(L, 1);
    const int base = lua_gettop(L);
    lua_newtable(L);
    for (uint32_t k = 0; k < figures->count; k++) {
        const JoFigure *figure = &figures->items[k];
        lua_settop(L, base + figure->depth);
        luaL_checkstack(L, 4, "the figures are nested too deep");
        push_figure(L, figure);
        lua_pushvalue(L, -1);
        if (figure->name)
            lua_setfield(L, -3, figure->name);
        else
            lua_rawseti(L, -3, (lua_Integer)lua_rawlen(L, -3) + 1);
    }
    lua_settop(L, base + 1);
    return 1;
}

int jol_push_table(lua_State *L) {
    const JoTable *table = lua_touserdata(L, 1);
    lua_newtable(L);
    for (uint32_t c = 0; c < table->column_count; c++) {
        const JoTableColumn *column = &table->columns[c];
        if (*column->unit)
            lua_pushfstring(L, "%s [%s]", column->name, column->unit);
        else
            lua_pushstring(L, column->name);
        lua_createtable(L, (int)table->row_count, 0);
        for (uint32_t r = 0; r < table->row_count; r++) {
            if (column->texts)
                lua_pushstring(L, column->texts[r]);
            else
                lua_pushnumber(L, column->numbers[r]);
            lua_rawseti(L, -2, (lua_Integer)r + 1);
        }
        lua_rawset(L, -3);
    }
    return 1;
}

int jol_push(lua_State *L, lua_CFunction push, void *told) {
    if (!told)
        return luaL_error(L, "out of memory");
    lua_pushcfunction(L, push);
    lua_pushlightuserdata(L, told);
    const int status = lua_pcall(L, 1, 1, 0);
    jo_free(told);
    return status == LUA_OK ? 1 : lua_error(L);
}
