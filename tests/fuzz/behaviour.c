/* Loads any bytes as a behaviour: a machine, or errors. */
#include "lua/loader.h"
#include "support/fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static const JoxScope ANY = {.complete = false};
    JoxDiagnostics diagnostics = {0};
    JoxLuaLimits limits = jox_lua_default_limits();
    limits.load_instructions = 500000; /* time for more inputs */
    JoxLua *lua = jox_lua_create(&limits);
    JoxMachine *machine =
        jox_lua_load_text(lua, "behaviours/fuzz.lua", (const char *)data, size, &ANY, &diagnostics);
    FUZZ_CHECK((machine != NULL) == (diagnostics.errors == 0));
    jox_machine_free(machine);
    jox_lua_free(lua);
    fuzz_end_diagnostics(&diagnostics);
    return 0;
}
