/* math.* of behaviours. Uses our own elementary functions, which give the same bits on every
   machine. */
#include <math.h>

#include "base/number/elementary.h"
#include "base/number/pi.h"
#include "lua/vm/library.h"

static int push_function_value(lua_State *L, double (*f)(double)) {
    lua_pushnumber(L, f(luaL_checknumber(L, 1)));
    return 1;
}
static int math_sin(lua_State *L) {
    return push_function_value(L, jox_sin);
}
static int math_cos(lua_State *L) {
    return push_function_value(L, jox_cos);
}
static int math_tan(lua_State *L) {
    double x = luaL_checknumber(L, 1);
    lua_pushnumber(L, jox_sin(x) / jox_cos(x));
    return 1;
}
static int math_asin(lua_State *L) {
    double x = luaL_checknumber(L, 1);
    lua_pushnumber(L, jox_atan2(x, sqrt((1.0 - x) * (1.0 + x))));
    return 1;
}
static int math_acos(lua_State *L) {
    double x = luaL_checknumber(L, 1);
    lua_pushnumber(L, jox_atan2(sqrt((1.0 - x) * (1.0 + x)), x));
    return 1;
}
static int math_atan(lua_State *L) {
    lua_pushnumber(L, jox_atan2(luaL_checknumber(L, 1), luaL_optnumber(L, 2, 1.0)));
    return 1;
}
static int math_exp(lua_State *L) {
    return push_function_value(L, jox_exp);
}
static int math_log(lua_State *L) {
    double x = jox_log(luaL_checknumber(L, 1));
    lua_pushnumber(L, lua_isnoneornil(L, 2) ? x : x / jox_log(luaL_checknumber(L, 2)));
    return 1;
}
static int math_sqrt(lua_State *L) {
    return push_function_value(L, sqrt);
}
static int math_deg(lua_State *L) {
    lua_pushnumber(L, luaL_checknumber(L, 1) * (180.0 / JOX_PI));
    return 1;
}
static int math_rad(lua_State *L) {
    lua_pushnumber(L, luaL_checknumber(L, 1) * JOX_DEGREE);
    return 1;
}
static int math_abs(lua_State *L) {
    if (lua_isinteger(L, 1)) {
        lua_Unsigned n = (lua_Unsigned)lua_tointeger(L, 1);
        lua_pushinteger(L, lua_tointeger(L, 1) < 0 ? (lua_Integer)(0u - n) : (lua_Integer)n);
        return 1;
    }
    return push_function_value(L, fabs);
}

/* Pushes a whole number as a Lua integer if it fits, else as a float. */
static int push_whole(lua_State *L, double x) {
    if (x >= -9223372036854775808.0 && x < 9223372036854775808.0)
        lua_pushinteger(L, (lua_Integer)x);
    else
        lua_pushnumber(L, x);
    return 1;
}
static int math_floor(lua_State *L) {
    if (lua_isinteger(L, 1))
        return lua_settop(L, 1), 1;
    return push_whole(L, floor(luaL_checknumber(L, 1)));
}
static int math_ceil(lua_State *L) {
    if (lua_isinteger(L, 1))
        return lua_settop(L, 1), 1;
    return push_whole(L, ceil(luaL_checknumber(L, 1)));
}
static int math_modf(lua_State *L) {
    double x = luaL_checknumber(L, 1), whole = x < 0 ? ceil(x) : floor(x);
    lua_pushnumber(L, whole);
    lua_pushnumber(L, x == whole ? 0.0 : x - whole);
    return 2;
}
static int math_fmod(lua_State *L) {
    if (lua_isinteger(L, 1) && lua_isinteger(L, 2)) {
        lua_Integer a = lua_tointeger(L, 1), b = lua_tointeger(L, 2);
        luaL_argcheck(L, b != 0, 2, "zero");
        lua_pushinteger(L, b == -1 ? 0 : a % b);
        return 1;
    }
    lua_pushnumber(L, fmod(luaL_checknumber(L, 1), luaL_checknumber(L, 2)));
    return 1;
}
/* Pushes the greatest or least of the arguments. */
static int push_extreme(lua_State *L, bool greatest) {
    int best = 1, count = lua_gettop(L);
    luaL_checknumber(L, 1);
    for (int i = 1; i <= count; i++)
        if (lua_type(L, i) != LUA_TNUMBER)
            return luaL_typeerror(L, i, "number");
    for (int i = 2; i <= count; i++)
        if (lua_compare(L, greatest ? best : i, greatest ? i : best, LUA_OPLT))
            best = i;
    lua_pushvalue(L, best);
    return 1;
}
static int math_max(lua_State *L) {
    return push_extreme(L, true);
}
static int math_min(lua_State *L) {
    return push_extreme(L, false);
}
static int math_tointeger(lua_State *L) {
    int good = 0;
    luaL_checkany(L, 1);
    lua_Integer n = lua_type(L, 1) == LUA_TNUMBER ? lua_tointegerx(L, 1, &good) : 0;
    if (good)
        lua_pushinteger(L, n);
    else
        lua_pushnil(L);
    return 1;
}
static int math_type(lua_State *L) {
    luaL_checkany(L, 1);
    if (lua_type(L, 1) == LUA_TNUMBER)
        lua_pushstring(L, lua_isinteger(L, 1) ? "integer" : "float");
    else
        lua_pushnil(L);
    return 1;
}

const luaL_Reg jox_library_math[] = {
    {"sin", math_sin},   {"cos", math_cos},     {"tan", math_tan},   {"asin", math_asin},
    {"acos", math_acos}, {"atan", math_atan},   {"exp", math_exp},   {"log", math_log},
    {"sqrt", math_sqrt}, {"deg", math_deg},     {"rad", math_rad},   {"abs", math_abs},
    {"ceil", math_ceil}, {"floor", math_floor}, {"modf", math_modf}, {"fmod", math_fmod},
    {"max", math_max},   {"min", math_min},     {"type", math_type}, {"tointeger", math_tointeger},
    {NULL, NULL}};
