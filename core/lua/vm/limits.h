/* What a script may use, and the files that it was made of: known outside of the VM too. */
#ifndef JOX_LUA_VM_LIMITS_H
#define JOX_LUA_VM_LIMITS_H

#include <stddef.h>
#include <stdint.h>

/* Every script works within these; over them it is stopped and named. */
typedef struct JoxLuaLimits {
    uint64_t load_instructions; /* of one load; default 20 million */
    uint64_t hook_instructions; /* of one call of a hook; default 100,000 */
    uint64_t step_instructions; /* of all of a behaviour's hooks in one step; default 20 million;
                                   then each hook has 1,000 */
    size_t memory;              /* bytes of one Lua state; default 32 MB */
    size_t block;               /* bytes of one allocation; default 2 MB */
    size_t source;              /* bytes of one file; default 256 KB */
    uint32_t print_lines;       /* of `print` in a simulated second; default 20; at load 5 times */
} JoxLuaLimits;
JoxLuaLimits jox_lua_default_limits(void);

/* Files that a script was made of, its own first. */
typedef struct JoxLuaFile {
    char *path;
    char sha256[65];
} JoxLuaFile;

/* Receives what scripts print and what is said of their failures: whole lines. */
typedef void JoxLuaComplain(void *context, const char *text);

#endif
