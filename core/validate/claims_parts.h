/* Declarations shared by claims*.c: reading a claim's table in Lua. Functions that find an error
   call luaL_error. */
#ifndef JOX_VALIDATE_CLAIMS_PARTS_H
#define JOX_VALIDATE_CLAIMS_PARTS_H

#include "lua/language/script.h"
#include "validate/claims.h"

/* The Lua state of a claim, which keeps its function `measure`. */
struct JoxClaimCode {
    JoxLua *lua;
    JoxScript *script;
    int measure; /* registry reference of the function */
};

/* A Lua function that defines the word `claim`, which fills in the claim stored as "jostle
   claim" in the registry. */
int jox_claim_set_words(lua_State *L);
void jox_claim_free_run(JoxClaimRun *run);

/* Read the table on top of the stack; `what` names it in errors. The first rejects keys that are
   not in `known`. */
void jox_claim_check_keys(lua_State *L, const char *what, const char *const *known, size_t count);
/* Returns a text, for the caller to free; "" if it is absent and not needed. */
char *jox_claim_read_text(lua_State *L, const char *what, const char *key, bool needed);
/* Returns a number, or `otherwise` if it is absent. */
double jox_claim_read_number(lua_State *L, const char *what, const char *key, double otherwise);

/* claims_plots.c: reads `plots` of the claim's table, after its figures. */
void jox_claim_read_plots(lua_State *L, JoxClaim *claim);
void jox_claim_free_plots(JoxClaim *claim);

#endif
