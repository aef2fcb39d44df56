/* Limits of a script, and the record of its files. Included by the VM and, through lua/loader.h, by
   the tools. */
#ifndef JOX_LUA_VM_SCRIPT_LIMITS_H
#define JOX_LUA_VM_SCRIPT_LIMITS_H

#include <stddef.h>
#include <stdint.h>

/* Limits of each script. A script that exceeds them is stopped and reported by name. */
typedef struct JoxLuaLimits {
    uint64_t load_instructions; /* instructions of one load; default 20 million */
    uint64_t hook_instructions; /* instructions of one call of a function; default 100,000 */
    uint64_t step_instructions; /* instructions of all functions of a behaviour in one step; default
                                   20 million; past that each call has 1,000 */
    size_t memory;              /* bytes of one Lua state; default 32 MB */
    size_t block;               /* bytes of one allocation; default 2 MB */
    size_t source;              /* bytes of one file; default 256 KB */
    uint32_t print_lines; /* lines of `print` in a second of simulated time, 5 times as many in a
                             load; default 20 */
} JoxLuaLimits;
JoxLuaLimits jox_lua_default_limits(void);

/* A file that a script was made of. */
typedef struct JoxLuaFile {
    char *path;
    char sha256[65];
} JoxLuaFile;

/* Receives lines that scripts print and reports of their failures; `text` is whole lines. */
typedef void JoxLuaComplain(void *context, const char *text);

#endif
