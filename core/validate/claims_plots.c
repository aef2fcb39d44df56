/* Reads `plots` of a claim file: curves and maps of the claim's figures. */
#include <math.h>
#include <string.h>

#include "base/mem.h"
#include "validate/claims_parts.h"

static const char *const KINDS[] = {"figures", "points", "line", "map"};
enum { KIND_COUNT = sizeof KINDS / sizeof *KINDS, MOST_POINTS = 10000 };

/* Returns the index of the figure named on top of the stack. */
static uint32_t find_figure(lua_State *L, const JoxClaim *claim, const JoxClaimPlot *plot) {
    const char *name = lua_type(L, -1) == LUA_TSTRING ? lua_tostring(L, -1) : NULL;
    for (uint32_t f = 0; name && f < claim->figure_count; f++)
        if (strcmp(claim->figures[f].name, name) == 0)
            return f;
    luaL_error(L, "plot '%s': there is no figure '%s'", plot->name,
               name ? name : lua_typename(L, lua_type(L, -1)));
    return 0;
}

/* Returns element n of the point on top of the stack. */
static double read_coordinate(lua_State *L, const JoxClaimPlot *plot, int n) {
    double value = lua_rawgeti(L, -1, n) == LUA_TNUMBER ? lua_tonumber(L, -1) : NAN;
    lua_pop(L, 1);
    if (!isfinite(value))
        luaL_error(L, "plot '%s': a point begins with numbers: { x, y } or { x, \"figure\" }",
                   plot->name);
    return value;
}

/* Reads the list of points on top: { x, y } or { x, "figure" }; for a map { x, y, "figure" }. */
static void read_plot_points(lua_State *L, const JoxClaim *claim, const JoxClaimPlot *plot,
                             JoxClaimCurve *curve) {
    lua_Integer count = luaL_len(L, -1);
    if (count < 1 || count > MOST_POINTS)
        luaL_error(L, "plot '%s': a curve has from 1 to %d points", plot->name, MOST_POINTS);
    curve->points = jox_alloc((size_t)count, sizeof *curve->points);
    for (lua_Integer p = 1; p <= count; p++) {
        JoxClaimPoint *point = &curve->points[curve->count];
        if (lua_rawgeti(L, -1, p) != LUA_TTABLE)
            luaL_error(L, "plot '%s': point %d is no table", plot->name, (int)p);
        point->x = read_coordinate(L, plot, 1);
        if (curve->kind != JOX_CURVE_FIGURES)
            point->y = read_coordinate(L, plot, 2);
        if (curve->kind == JOX_CURVE_FIGURES || curve->kind == JOX_CURVE_MAP) {
            lua_rawgeti(L, -1, curve->kind == JOX_CURVE_MAP ? 3 : 2);
            point->figure = find_figure(L, claim, plot);
            lua_pop(L, 1);
        }
        curve->count++;
        lua_pop(L, 1);
    }
}

/* Reads the curve on top: { "label", figures = {...} }. */
static void read_curve(lua_State *L, const JoxClaim *claim, const JoxClaimPlot *plot,
                       JoxClaimCurve *curve) {
    int kinds = 0;
    if (!lua_istable(L, -1) || lua_rawgeti(L, -1, 1) != LUA_TSTRING)
        luaL_error(L, "plot '%s': a curve is { \"label\", figures = { { x, \"figure\" } } }",
                   plot->name);
    curve->label = jox_strdup(lua_tostring(L, -1));
    lua_pop(L, 1);
    jox_claim_check_keys(L, "a curve", KINDS, JOX_CURVE_MAP);
    for (int k = 0; k < JOX_CURVE_MAP; k++) {
        if (lua_getfield(L, -1, KINDS[k]) == LUA_TTABLE && kinds++ == 0) {
            curve->kind = (JoxCurveKind)k;
            read_plot_points(L, claim, plot, curve);
        }
        lua_pop(L, 1);
    }
    if (kinds != 1)
        luaL_error(L, "plot '%s': a curve has one of figures, points and line", plot->name);
}

static bool is_plain_name(const char *name) {
    size_t plain = strspn(name, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_");
    return *name && name[plain] == 0 && plain <= 40;
}

/* Reads the plot on top. */
static void read_plot(lua_State *L, const JoxClaim *claim, JoxClaimPlot *plot) {
    static const char *const KEYS[] = {"name", "title", "x", "y", "z", "map"};
    if (!lua_istable(L, -1))
        luaL_error(L, "each of plots is a table");
    jox_claim_check_keys(L, "a plot", KEYS, sizeof KEYS / sizeof *KEYS);
    plot->name = jox_claim_read_text(L, "a plot", "name", true);
    plot->title = jox_claim_read_text(L, "a plot", "title", true);
    plot->x = jox_claim_read_text(L, "a plot", "x", true);
    plot->y = jox_claim_read_text(L, "a plot", "y", true);
    if (!is_plain_name(plot->name))
        luaL_error(L, "plot '%s': a name has letters, digits, - and _", plot->name);
    bool map = lua_getfield(L, -1, "map") == LUA_TTABLE;
    lua_Integer count = map ? 1 : luaL_len(L, -2);
    if (map && luaL_len(L, -2) > 0)
        luaL_error(L, "plot '%s' is a map or has curves, not both", plot->name);
    if (count < 1 || count > 12)
        luaL_error(L, "plot '%s' needs a map, or from 1 to 12 curves", plot->name);
    plot->curves = jox_alloc((size_t)count, sizeof *plot->curves);
    plot->curve_count = (uint32_t)count;
    if (map) {
        plot->curves[0].kind = JOX_CURVE_MAP;
        read_plot_points(L, claim, plot, &plot->curves[0]);
    }
    lua_pop(L, 1);
    plot->z = jox_claim_read_text(L, "a plot", "z", map);
    for (lua_Integer c = 0; c < count && !map; c++) {
        lua_rawgeti(L, -1, c + 1);
        read_curve(L, claim, plot, &plot->curves[c]);
        lua_pop(L, 1);
    }
}

void jox_claim_read_plots(lua_State *L, JoxClaim *claim) {
    int type = lua_getfield(L, -1, "plots");
    if (type != LUA_TNIL && type != LUA_TTABLE)
        luaL_error(L, "plots = { { name = \"speed\", title = ..., x = ..., y = ..., curves } }");
    claim->plot_count = type == LUA_TTABLE ? (uint32_t)luaL_len(L, -1) : 0;
    claim->plots = jox_alloc(claim->plot_count + 1, sizeof *claim->plots);
    for (uint32_t p = 0; p < claim->plot_count; p++) {
        lua_rawgeti(L, -1, (lua_Integer)p + 1);
        read_plot(L, claim, &claim->plots[p]);
        for (uint32_t other = 0; other < p; other++)
            if (strcmp(claim->plots[other].name, claim->plots[p].name) == 0)
                luaL_error(L, "there are two plots '%s'", claim->plots[p].name);
        lua_pop(L, 1);
    }
    lua_pop(L, 1);
}

void jox_claim_free_plots(JoxClaim *claim) {
    for (uint32_t p = 0; claim->plots && p < claim->plot_count; p++) {
        JoxClaimPlot *plot = &claim->plots[p];
        for (uint32_t c = 0; c < plot->curve_count; c++) {
            jox_free(plot->curves[c].label);
            jox_free(plot->curves[c].points);
        }
        void *owned[] = {plot->name, plot->title, plot->x, plot->y, plot->z, plot->curves};
        for (size_t k = 0; k < sizeof owned / sizeof *owned; k++)
            jox_free(owned[k]);
    }
    jox_free(claim->plots);
}
