/* What the files of claims share. */
#ifndef JOX_VALIDATE_CLAIMS_PARTS_H
#define JOX_VALIDATE_CLAIMS_PARTS_H

#include "lua/language/script.h"
#include "validate/claims.h"

struct JoxClaimCode {
    JoxLua *lua;
    JoxScript *script;
    int measure; /* registry reference */
};

/* Makes the word `claim` known, which fills the claim under "jostle claim" of the registry. */
int jox_claim_words(lua_State *L);
void jox_claim_free_run(JoxClaimRun *run);

/* Of the table on top of the stack; errors of Lua say what is wrong with `what`. */
void jox_claim_known(lua_State *L, const char *what, const char *const *known, size_t count);
/* "" where it is absent and not needed; to be freed. */
char *jox_claim_text(lua_State *L, const char *what, const char *key, bool needed);
double jox_claim_number(lua_State *L, const char *what, const char *key, double otherwise);

/* claims_plots.c: `plots` of the claim's table, after its figures. */
void jox_claim_plots(lua_State *L, JoxClaim *claim);
void jox_claim_free_plots(JoxClaim *claim);

#endif
