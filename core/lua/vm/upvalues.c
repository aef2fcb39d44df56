/* Whether a function assigns what it did not declare: it would remember where neither a reload nor
   a checkpoint looks. Lua tells by its compiled form alone, which is read here: version 5.4. */
#include <string.h>

#include "base/mem.h"
#include "base/text.h"
#include "lua/internal.h"

enum { OPCODE_SETUPVAL = 10, DEEPEST = 250, MOST_PROTOTYPES = 65536 };

/* A function in the compiled form; offsets are into it. */
typedef struct Prototype {
    int32_t parent; /* -1 for the outermost */
    size_t code, upvalues, lines;
    uint32_t code_count, upvalue_count, line_count;
    int first_line;
    size_t steps; /* absolute lines: pairs of instruction and line */
    uint32_t step_count;
    size_t names; /* of upvalues */
    uint32_t name_count;
} Prototype;

typedef struct Reader {
    const unsigned char *data;
    size_t length, at;
    bool bad;
    Prototype *items;
    size_t count, capacity;
    int source;
} Reader;

static unsigned read_byte(Reader *r) {
    if (r->at >= r->length) {
        r->bad = true;
        return 0;
    }
    return r->data[r->at++];
}

static void skip(Reader *r, size_t count, size_t size) {
    if (count > (r->length - r->at) / size)
        r->bad = true;
    else
        r->at += count * size;
}

/* Seven bits a byte, the highest first; the last byte has its top bit set. */
static size_t read_size(Reader *r) {
    size_t n = 0;
    for (int i = 0; i < 10; i++) {
        unsigned b = read_byte(r);
        n = n << 7 | (b & 0x7f);
        if (b & 0x80)
            return n;
    }
    r->bad = true;
    return 0;
}

static uint32_t read_count(Reader *r) {
    size_t n = read_size(r);
    r->bad |= n > r->length && n > 0x7fffffff;
    return r->bad ? 0 : (uint32_t)n;
}

/* A text; its length is stored plus one, 0 for none. */
static const char *read_text(Reader *r, size_t *length) {
    size_t n = read_size(r);
    *length = n > 0 ? n - 1 : 0;
    const char *text = (const char *)r->data + r->at;
    skip(r, *length, 1);
    return n > 0 && !r->bad ? text : NULL;
}

static void read_constants(Reader *r) {
    uint32_t count = read_count(r);
    size_t length;
    for (uint32_t i = 0; i < count && !r->bad; i++)
        switch (read_byte(r)) {
        case 0x03: /* integer */
        case 0x13: /* float */
            skip(r, 8, 1);
            break;
        case 0x04: /* short and long text */
        case 0x14:
            read_text(r, &length);
            break;
        case 0x00: /* nil, false, true */
        case 0x01:
        case 0x11:
            break;
        default:
            r->bad = true;
        }
}

static void read_debug(Reader *r, Prototype *p) {
    size_t length;
    p->line_count = read_count(r);
    p->lines = r->at;
    skip(r, p->line_count, 1);
    p->step_count = read_count(r);
    p->steps = r->at;
    for (uint32_t i = 0; i < p->step_count && !r->bad; i++) {
        read_size(r);
        read_size(r);
    }
    uint32_t locals = read_count(r);
    for (uint32_t i = 0; i < locals && !r->bad; i++) {
        read_text(r, &length);
        read_size(r);
        read_size(r);
    }
    p->name_count = read_count(r);
    p->names = r->at;
    for (uint32_t i = 0; i < p->name_count && !r->bad; i++)
        read_text(r, &length);
}

static void read_function(Reader *r, int32_t parent, int depth) {
    if (depth > DEEPEST || r->count >= MOST_PROTOTYPES) {
        r->bad = true;
        return;
    }
    size_t length;
    const char *source = read_text(r, &length);
    if (source && parent < 0 && length >= 3 && length < 12 && source[0] == '=') {
        r->source = 0;
        for (size_t i = 2; i < length; i++)
            r->source = r->source * 10 + (source[i] - '0');
    }
    Prototype p = {.parent = parent, .first_line = (int)read_size(r)};
    read_size(r);
    skip(r, 3, 1); /* parameters, varargs, stack */
    p.code_count = read_count(r);
    p.code = r->at;
    skip(r, p.code_count, 4);
    read_constants(r);
    p.upvalue_count = read_count(r);
    p.upvalues = r->at;
    skip(r, p.upvalue_count, 3);
    JOX_RESERVE(r->items, r->capacity, r->count + 1);
    int32_t self = (int32_t)r->count++;
    uint32_t nested = read_count(r);
    for (uint32_t i = 0; i < nested && !r->bad; i++)
        read_function(r, self, depth + 1);
    read_debug(r, &p);
    r->items[self] = p;
}

static void read_header(Reader *r) {
    static const unsigned char START[] = "\x1bLua\x54\x00\x19\x93\r\n\x1a\n\x04\x08\x08";
    r->bad = r->length < 32 || memcmp(r->data, START, 15) != 0;
    r->at = 15 + 16 + 1; /* an integer and a float that tell byte order; number of upvalues */
}

/* ---- what was read ---- */

static int line_of(const Reader *r, const Prototype *p, uint32_t instruction) {
    Reader steps = {.data = r->data, .length = r->length, .at = p->steps};
    int line = p->first_line;
    for (uint32_t i = 0; i <= instruction && i < p->line_count; i++) {
        signed char by = (signed char)r->data[p->lines + i];
        if (by == -128) { /* its line is spelt out; these stand in order */
            read_size(&steps);
            line = (int)read_size(&steps);
        } else {
            line += by;
        }
    }
    return line;
}

static void name_of(const Reader *r, const Prototype *p, uint32_t upvalue, char name[64]) {
    Reader names = {.data = r->data, .length = r->length, .at = p->names};
    size_t length = 0;
    const char *text = NULL;
    for (uint32_t i = 0; i <= upvalue && i < p->name_count; i++)
        text = read_text(&names, &length);
    if (!text || upvalue >= p->name_count) {
        text = "?";
        length = 1;
    }
    length = length < 63 ? length : 63;
    memcpy(name, text, length);
    name[length] = 0;
}

/* Whether an upvalue comes from outside of the outermost function. */
static bool from_outside(const Reader *r, const Prototype *p, uint32_t upvalue) {
    while (p->parent >= 0) {
        if (upvalue >= p->upvalue_count)
            return true; /* never from a compiler */
        const unsigned char *kind = r->data + p->upvalues + 3 * (size_t)upvalue;
        if (kind[0])
            return false; /* a local of the function around it */
        upvalue = kind[1];
        p = &r->items[p->parent];
    }
    return true;
}

static bool find_assignment(const Reader *r, char name[64], int *line) {
    bool found = false;
    for (size_t i = 0; i < r->count; i++) {
        const Prototype *p = &r->items[i];
        for (uint32_t k = 0; k < p->code_count; k++) {
            const unsigned char *c = r->data + p->code + 4 * (size_t)k;
            uint32_t word;
            memcpy(&word, c, 4);
            if ((word & 0x7f) != OPCODE_SETUPVAL || !from_outside(r, p, word >> 16 & 0xff))
                continue;
            int at = line_of(r, p, k);
            if (found && at >= *line)
                continue;
            *line = at;
            name_of(r, p, word >> 16 & 0xff, name);
            found = true;
        }
    }
    return found;
}

static int keep_piece(lua_State *L, const void *piece, size_t size, void *context) {
    (void)L;
    jox_text_append(context, piece, size);
    return 0;
}

bool jox_upvalue_assigned(lua_State *L, int index, char name[64], int *line, int *source) {
    JoxText dump = {0};
    strcpy(name, "?");
    *line = *source = 0;
    if (lua_type(L, index) != LUA_TFUNCTION || lua_iscfunction(L, index))
        return false;
    lua_pushvalue(L, index);
    lua_dump(L, keep_piece, &dump, 0);
    lua_pop(L, 1);
    Reader r = {.data = (const unsigned char *)dump.data, .length = dump.length};
    read_header(&r);
    if (!r.bad)
        read_function(&r, -1, 0);
    r.bad |= r.at != r.length;
    bool found = r.bad || find_assignment(&r, name, line);
    *source = r.source;
    uint64_t cost = dump.length / 4;
    jox_free(r.items);
    jox_text_free(&dump);
    jox_vm_charge(L, cost);
    return found; /* what cannot be read is not trusted */
}

void jox_upvalue_self_check(lua_State *L) {
    static const char TEXT[] = "local counted, other = 0, 0\n"
                               "return function() local own = 0\n"
                               " return function() own = own + other\n counted = own end end";
    char name[64];
    int line = 0, source = -1;
    if (luaL_loadbufferx(L, TEXT, sizeof TEXT - 1, "=b7", "t") != LUA_OK)
        lua_error(L);
    lua_call(L, 0, 1);
    if (!jox_upvalue_assigned(L, -1, name, &line, &source) || strcmp(name, "counted") != 0 ||
        line != 4 || source != 7)
        luaL_error(L, "this Lua's compiled form is not the one that is understood");
    lua_pop(L, 1);
}
