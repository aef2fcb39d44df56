/* string.* of behaviours: without patterns, at most 1 MB, the same text in every locale. */
#include <stdio.h>
#include <string.h>

#include "lua/vm/library.h"

enum { LONGEST_STRING = 1 << 20, MOST_BYTES = 200, WIDEST = 99 };

static int string_len(lua_State *L) {
    size_t n;
    luaL_checklstring(L, 1, &n);
    lua_pushinteger(L, (lua_Integer)n);
    return 1;
}
/* Reads arguments i and j of a string of length n as a range from 1 to n; empty if i > j. */
static void read_range(lua_State *L, size_t n, lua_Integer i_else, lua_Integer *i, lua_Integer *j,
                       bool j_is_i) {
    lua_Integer length = (lua_Integer)n;
    *i = luaL_optinteger(L, 2, i_else);
    *j = luaL_optinteger(L, 3, j_is_i ? *i : -1);
    *i = *i < 0 ? (length + *i + 1 < 1 ? 1 : length + *i + 1) : *i == 0 ? 1 : *i;
    *j = *j < 0 ? length + *j + 1 : *j > length ? length : *j;
}
static int string_sub(lua_State *L) {
    size_t n;
    lua_Integer i, j;
    const char *s = luaL_checklstring(L, 1, &n);
    luaL_checkinteger(L, 2);
    read_range(L, n, 1, &i, &j, false);
    lua_pushlstring(L, i <= j ? s + i - 1 : "", i <= j ? (size_t)(j - i + 1) : 0);
    return 1;
}
static int string_byte(lua_State *L) {
    size_t n;
    lua_Integer i, j;
    const char *s = luaL_checklstring(L, 1, &n);
    read_range(L, n, 1, &i, &j, true);
    luaL_argcheck(L, j < i || j - i < MOST_BYTES, 3, "at most 200 bytes at once");
    luaL_checkstack(L, MOST_BYTES + 2, "bytes");
    for (lua_Integer k = i; k <= j; k++)
        lua_pushinteger(L, (unsigned char)s[k - 1]);
    return j < i ? 0 : (int)(j - i + 1);
}
static int string_char(lua_State *L) {
    JoxScratch out;
    int count = lua_gettop(L);
    jox_scratch_open(&out, L, (size_t)count);
    for (int i = 1; i <= count; i++) {
        lua_Integer code = luaL_checkinteger(L, i);
        luaL_argcheck(L, code >= 1 && code <= 255, i, "a byte of a text is from 1 to 255");
        jox_scratch_add(&out, &(char){(char)code}, 1);
    }
    jox_scratch_push(&out);
    return 1;
}
static int string_rep(lua_State *L) {
    size_t n, gap;
    const char *s = luaL_checklstring(L, 1, &n);
    lua_Integer times = luaL_checkinteger(L, 2);
    const char *between = luaL_optlstring(L, 3, "", &gap);
    if (times <= 0 || n + gap == 0)
        return lua_pushliteral(L, ""), 1;
    luaL_argcheck(L, n + gap <= LONGEST_STRING && times <= LONGEST_STRING / (lua_Integer)(n + gap),
                  2, "the result would be over 1 MB");
    jox_vm_charge(L, (uint64_t)times);
    JoxScratch out;
    jox_scratch_open(&out, L, (size_t)times * (n + gap));
    for (lua_Integer i = 0; i < times; i++) {
        if (i > 0)
            jox_scratch_add(&out, between, gap);
        jox_scratch_add(&out, s, n);
    }
    jox_scratch_push(&out);
    return 1;
}
/* Pushes the string with letters from `low` to `high` moved by `by`: changes their case. */
static int push_shifted_letters(lua_State *L, char low, char high, int by) {
    size_t n;
    const char *s = luaL_checklstring(L, 1, &n);
    char *p = lua_newuserdatauv(L, n + 1, 0);
    jox_vm_charge(L, n / 8);
    for (size_t i = 0; i < n; i++)
        p[i] = s[i] >= low && s[i] <= high ? (char)(s[i] + by) : s[i];
    lua_pushlstring(L, p, n);
    return 1;
}
static int string_upper(lua_State *L) {
    return push_shifted_letters(L, 'a', 'z', 'A' - 'a');
}
static int string_lower(lua_State *L) {
    return push_shifted_letters(L, 'A', 'Z', 'a' - 'A');
}
static int string_reverse(lua_State *L) {
    size_t n;
    const char *s = luaL_checklstring(L, 1, &n);
    char *p = lua_newuserdatauv(L, n + 1, 0);
    jox_vm_charge(L, n / 8);
    for (size_t i = 0; i < n; i++)
        p[i] = s[n - 1 - i];
    lua_pushlstring(L, p, n);
    return 1;
}

/* ---- search ---- */

/* find(text, what [, from [, true]]): finds plain text; a `what` that looks like a pattern is
   refused. */
static int string_find(lua_State *L) {
    size_t n, m;
    const char *s = luaL_checklstring(L, 1, &n), *what = luaL_checklstring(L, 2, &m);
    lua_Integer from = luaL_optinteger(L, 3, 1);
    from = from < 0 ? ((lua_Integer)n + from + 1 < 1 ? 1 : (lua_Integer)n + from + 1) : from;
    from = from == 0 ? 1 : from;
    if (!lua_toboolean(L, 4))
        for (size_t i = 0; i + 1 < m; i++)
            if (what[i] == '%' && strchr("acdglpsuwxACDGLPSUWX.%+-*?[]^$()b", what[i + 1]) &&
                what[i + 1])
                return luaL_error(L,
                                  "string.find searches for plain text, '%s' looks like a pattern; "
                                  "if it is meant so, write find(text, what, 1, true)",
                                  what);
    jox_vm_charge(L, (n + m) / 8);
    if (from > (lua_Integer)n + 1)
        return lua_pushnil(L), 1;
    const char *found = m == 0 ? s + from - 1 : memmem(s + from - 1, n + 1 - (size_t)from, what, m);
    if (!found)
        return lua_pushnil(L), 1;
    lua_pushinteger(L, found - s + 1);
    lua_pushinteger(L, found - s + (lua_Integer)m);
    return 2;
}
static int string_pattern(lua_State *L) {
    return luaL_error(L, "there are no patterns here, for their time has no bound; string.find "
                         "searches for plain text, string.sub and string.byte take it apart");
}

/* ---- format ---- */

typedef struct Spec {
    char flags[6];
    int width, precision; /* -1: not given */
    char kind;
} Spec;

/* Reads a conversion after its '%'; returns the character after it. */
static const char *read_spec(lua_State *L, const char *c, const char *end, Spec *spec) {
    size_t flags = 0;
    *spec = (Spec){.width = -1, .precision = -1};
    for (; c < end && *c && strchr("-+ #0", *c); c++)
        if (!strchr(spec->flags, *c) && flags < 5)
            spec->flags[flags++] = *c;
    for (int part = 0; part < 2; part++) {
        int *number = part ? &spec->precision : &spec->width;
        if (part && (c >= end || *c != '.'))
            break;
        c += part;
        *number = part ? 0 : -1;
        for (; c < end && *c >= '0' && *c <= '9'; c++) {
            *number = (*number < 0 ? 0 : *number) * 10 + (*c - '0');
            if (*number > WIDEST)
                luaL_error(L, "a width or precision of string.format is at most %d", WIDEST);
        }
    }
    spec->kind = c < end ? *c : 0;
    if (!spec->kind || !strchr("diuxXocsfFeEgG", spec->kind)) {
        char shown[2] = {spec->kind, 0};
        luaL_error(L, "string.format does not know '%%%s'; there are d i u x X o c s f e g", shown);
    }
    return c + 1;
}

/* Adds a text, padded with blanks to the width of the conversion. */
static void add_padded(JoxScratch *out, const Spec *spec, const char *text, size_t length) {
    size_t width = spec->width > 0 ? (size_t)spec->width : 0;
    size_t blanks = width > length ? width - length : 0;
    static const char SPACES[WIDEST + 1] =
        "                                                                                         "
        "          ";
    if (!strchr(spec->flags, '-'))
        jox_scratch_add(out, SPACES, blanks);
    jox_scratch_add(out, text, length);
    if (strchr(spec->flags, '-'))
        jox_scratch_add(out, SPACES, blanks);
}

static void format_number(JoxScratch *out, const Spec *spec, int index) {
    char pattern[32], text[512]; /* %99.99f of the greatest number has 409 characters */
    int at = snprintf(pattern, sizeof pattern, "%%%s", spec->flags);
    if (spec->width >= 0)
        at += snprintf(pattern + at, sizeof pattern - (size_t)at, "%d", spec->width);
    if (spec->precision >= 0)
        at += snprintf(pattern + at, sizeof pattern - (size_t)at, ".%d", spec->precision);
    bool whole = strchr("diuxXo", spec->kind) != NULL;
    snprintf(pattern + at, sizeof pattern - (size_t)at, "%s%c", whole ? "ll" : "", spec->kind);
    int length;
    if (whole) {
        long long n = (long long)luaL_checkinteger(out->L, index);
        length = snprintf(text, sizeof text, pattern, n);
    } else {
        double x = luaL_checknumber(out->L, index);
        length = snprintf(text, sizeof text, pattern, x == x ? x : __builtin_nan(""));
    }
    jox_scratch_add(out, text, (size_t)length);
}

static int string_format(lua_State *L) {
    size_t n;
    const char *c = luaL_checklstring(L, 1, &n), *end = c + n;
    int argument = 1;
    JoxScratch out;
    jox_scratch_open(&out, L, n + 64);
    while (c < end) {
        const char *percent = memchr(c, '%', (size_t)(end - c));
        jox_scratch_add(&out, c, (size_t)((percent ? percent : end) - c));
        if (!percent)
            break;
        c = percent + 1;
        if (c < end && *c == '%') {
            jox_scratch_add(&out, c++, 1);
            continue;
        }
        Spec spec;
        c = read_spec(L, c, end, &spec);
        if (++argument >= out.slot)
            return luaL_error(L, "string.format lacks a value for its %%%c", spec.kind);
        jox_vm_charge(L, 20);
        if (spec.kind == 's') {
            size_t length;
            const char *text = jox_library_text(L, argument, &length);
            if (spec.precision >= 0 && (size_t)spec.precision < length)
                length = (size_t)spec.precision;
            add_padded(&out, &spec, text, length);
            lua_pop(L, 1);
        } else if (spec.kind == 'c') {
            lua_Integer code = luaL_checkinteger(L, argument);
            luaL_argcheck(L, code >= 1 && code <= 255, argument,
                          "a byte of a text is from 1 to 255");
            add_padded(&out, &spec, &(char){(char)code}, 1);
        } else {
            format_number(&out, &spec, argument);
        }
    }
    jox_scratch_push(&out);
    return 1;
}

const luaL_Reg jox_library_string[] = {{"len", string_len},       {"sub", string_sub},
                                       {"byte", string_byte},     {"char", string_char},
                                       {"rep", string_rep},       {"upper", string_upper},
                                       {"lower", string_lower},   {"reverse", string_reverse},
                                       {"find", string_find},     {"format", string_format},
                                       {"match", string_pattern}, {"gmatch", string_pattern},
                                       {"gsub", string_pattern},  {NULL, NULL}};
