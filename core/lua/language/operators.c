/* Operators of expressions: arithmetic and & | ~; methods are in methods.c. Operators that Lua
 * would evaluate wrongly are refused with the right spelling. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "lua/language/vocabulary.h"

enum { MOST_SUMMANDS = 64 };

/* Returns the number of terms of a steering sum, at most MOST_SUMMANDS + 1. */
static int count_summands(const JoxNode *steer) {
    int n = 0;
    for (; steer && n <= MOST_SUMMANDS; steer = steer->next)
        n++;
    return n;
}

/* Pushes a copy of a steering sum with every weight multiplied. */
static JoxNode *push_scaled_steer(lua_State *L, JoxNode *steer, JoxNode *by) {
    JOX_ASSERT(steer->kind == JOX_NODE_STEER && by);
    JoxNode *node = jox_node_push(L, JOX_NODE_STEER);
    JoxPosition position = node->position;
    *node = *steer;
    node->position = position;
    if (steer->weight) {
        node->weight = jox_node_push_operation(L, JOX_NODE_NUMBER, JOX_OP_MUL, steer->weight, by);
        lua_pop(L, 1);
    } else {
        node->weight = by;
    }
    if (steer->next) {
        node->next = push_scaled_steer(L, steer->next, by);
        lua_pop(L, 1);
    }
    return node;
}

/* Computes a number, or a steering (what an agent steers by) from two added ones or one times a
   number; pushes one value. */
static int apply_arithmetic(lua_State *L, int op, const char *sign) {
    if (jox_node_is_error(L, 1) || jox_node_is_error(L, 2))
        return jox_node_push_error(L);
    JoxNode *a = jox_node_number(L, 1), *b = jox_node_number(L, 2);
    if (a && b) {
        jox_node_push_operation(L, JOX_NODE_NUMBER, op, a, b);
        return 1;
    }
    JoxNode *left = jox_node_get(L, 1), *right = jox_node_get(L, 2);
    int terms = (left && left->kind == JOX_NODE_STEER ? count_summands(left) : 0) +
                (right && right->kind == JOX_NODE_STEER ? count_summands(right) : 0);
    if (terms > MOST_SUMMANDS)
        return luaL_error(L, "a steering of so many terms");
    luaL_checkstack(L, 3 * MOST_SUMMANDS, NULL);
    if (op == JOX_OP_MUL && a && right && right->kind == JOX_NODE_STEER) {
        push_scaled_steer(L, right, a);
        return 1;
    }
    if (op == JOX_OP_MUL && b && left && left->kind == JOX_NODE_STEER) {
        push_scaled_steer(L, left, b);
        return 1;
    }
    if (op == JOX_OP_ADD && left && right && left->kind == JOX_NODE_STEER &&
        right->kind == JOX_NODE_STEER) {
        JoxNode *sum = jox_node_push(L, JOX_NODE_STEER), *last = sum;
        JoxPosition position = sum->position;
        *sum = *left;
        sum->position = position;
        while (last->next) { /* copied, as a value never changes */
            JoxNode *copy = jox_node_push(L, JOX_NODE_STEER);
            *copy = *last->next;
            last->next = copy;
            last = copy;
            lua_pop(L, 1);
        }
        last->next = right;
        return 1;
    }
    bool condition =
        (left && left->kind == JOX_NODE_CONDITION) || (right && right->kind == JOX_NODE_CONDITION);
    return jox_word_error(
        L, sign, "bad-operand",
        condition
            ? "Put parentheses about the number: (150 * now.speed):below(3). To compute with a "
              "condition: either(stuck(5), 2, 0.5)"
            : NULL,
        "'%s' cannot join %s and %s", sign, jox_node_kind(L, 1), jox_node_kind(L, 2));
}

static int meta_add(lua_State *L) {
    return apply_arithmetic(L, JOX_OP_ADD, "+");
}
static int meta_sub(lua_State *L) {
    return apply_arithmetic(L, JOX_OP_SUB, "-");
}
static int meta_mul(lua_State *L) {
    return apply_arithmetic(L, JOX_OP_MUL, "*");
}
static int meta_div(lua_State *L) {
    return apply_arithmetic(L, JOX_OP_DIV, "/");
}

static int meta_unm(lua_State *L) {
    if (jox_node_is_error(L, 1))
        return jox_node_push_error(L);
    JoxNode *a = jox_node_number(L, 1);
    if (!a)
        return jox_word_error(L, "-", "bad-operand", NULL, "'-' needs a number, not %s",
                              jox_node_kind(L, 1));
    jox_node_push_operation(L, JOX_NODE_NUMBER, JOX_OP_NEG, a, NULL);
    return 1;
}

/* Returns the condition at a stack index; NULL if it is something else. */
static JoxNode *get_condition(lua_State *L, int index) {
    JoxNode *node = jox_node_get(L, index);
    return node && node->kind == JOX_NODE_CONDITION ? node : NULL;
}

/* Joins two conditions; pushes one value. */
static int apply_logic(lua_State *L, int op, const char *sign) {
    if (jox_node_is_error(L, 1) || jox_node_is_error(L, 2))
        return jox_node_push_error(L);
    JoxNode *a = get_condition(L, 1), *b = get_condition(L, 2);
    if (!a || !b)
        return jox_word_error(L, sign, "bad-operand",
                              "A number becomes a condition by :above, :below, :at_least, :at_most "
                              "or :is",
                              "'%s' joins conditions, not %s", sign, jox_node_kind(L, a ? 2 : 1));
    jox_node_push_operation(L, JOX_NODE_CONDITION, op, a, b);
    return 1;
}

static int meta_and(lua_State *L) {
    return apply_logic(L, JOX_OP_AND, "&");
}
static int meta_or(lua_State *L) {
    return apply_logic(L, JOX_OP_OR, "|");
}

static int meta_not(lua_State *L) {
    if (jox_node_is_error(L, 1))
        return jox_node_push_error(L);
    JoxNode *a = get_condition(L, 1);
    if (!a)
        return jox_word_error(L, "~", "bad-operand",
                              "A number becomes a condition by :above, :below, :at_least, :at_most "
                              "or :is",
                              "'~' negates a condition, not %s", jox_node_kind(L, 1));
    jox_node_push_operation(L, JOX_NODE_CONDITION, JOX_OP_NOT, a, NULL);
    return 1;
}

/* Reports an operator that Lua would accept and evaluate wrongly. */
static int refuse_operator(lua_State *L, const char *sign, const char *hint) {
    bool poison = jox_node_is_error(L, 1) || jox_node_is_error(L, 2);
    if (poison)
        return jox_node_push_error(L);
    return jox_word_error(L, sign, "bad-operator", hint,
                          "'%s' does not work on values of behaviours", sign);
}
static int meta_lt(lua_State *L) {
    return refuse_operator(L, "<", "Write :below(n) or :above(n)");
}
static int meta_le(lua_State *L) {
    return refuse_operator(L, "<=", "Write :at_most(n) or :at_least(n)");
}
static int meta_eq(lua_State *L) {
    return refuse_operator(L, "==", "Write :is(n)");
}
static int meta_concat(lua_State *L) {
    return refuse_operator(L, "..", "Use & between conditions");
}
static int meta_len(lua_State *L) {
    const JoxNode *node = jox_node_get(L, 1);
    const bool list = node && node->kind == JOX_NODE_LIST;
    return refuse_operator(L, "#", list ? "Use .size" : "Use count(place)");
}
static int meta_pow(lua_State *L) {
    return refuse_operator(L, "^", "Multiply: x * x");
}
static int meta_mod(lua_State *L) {
    return refuse_operator(L, "%", "There is no remainder");
}
static int meta_idiv(lua_State *L) {
    return refuse_operator(L, "//", "Use /");
}
static int meta_bxor(lua_State *L) {
    return refuse_operator(L, "~", "Use & and | with ~ before a condition");
}
static int meta_newindex(lua_State *L) {
    return refuse_operator(L, ".", "Values cannot be changed");
}

static int meta_call(lua_State *L) {
    if (jox_node_is_error(L, 1))
        return jox_node_push_error(L);
    const JoxNode *called = jox_node_get(L, 1);
    if (called && called->op == JOX_OP_MESSAGE && called->field)
        return jox_word_error(L, called->field, "bad-call",
                              "Of a certain sender: when = need & same(need.sender, mine.asked). "
                              "Messages have no filters",
                              "a message has no ':%s': what follows the dot is a value that it "
                              "carries",
                              called->field);
    const bool table = lua_type(L, 2) == LUA_TTABLE;
    return jox_word_error(L, "(", "bad-call", table ? "Is a comma missing after it?" : NULL,
                          "%s cannot be called", jox_node_kind(L, 1));
}

const luaL_Reg jox_operators[] = {{"__add", meta_add},
                                  {"__sub", meta_sub},
                                  {"__mul", meta_mul},
                                  {"__div", meta_div},
                                  {"__unm", meta_unm},
                                  {"__band", meta_and},
                                  {"__bor", meta_or},
                                  {"__bnot", meta_not},
                                  {"__lt", meta_lt},
                                  {"__le", meta_le},
                                  {"__eq", meta_eq},
                                  {"__concat", meta_concat},
                                  {"__len", meta_len},
                                  {"__pow", meta_pow},
                                  {"__mod", meta_mod},
                                  {"__idiv", meta_idiv},
                                  {"__bxor", meta_bxor},
                                  {"__call", meta_call},
                                  {"__index", jox_node_index},
                                  {"__newindex", meta_newindex},
                                  {NULL, NULL}};
