/* Lua states: the limit of memory, the budget of instructions, the protected call. Counts of
   instructions decide what a function may do, so that runs are equal on all machines; the clock
   ends only a load, or a run that counts cannot explain. */
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/clock.h"
#include "base/guard.h"
#include "base/mem.h"
#include "lua/vm/vm.h"

enum {
    FIRST_CHECK = 100,
    CHECK_EVERY = 1000,
    MOST_NAMES = 4096,
    SAMPLED = 64,
    SUSPECTED = 64,
    CHARGES_TIMED = 32,
    LEAST_BUDGET = 1000,
    SAID = 20
};
/* Limits in seconds of processor time: of a load with the default budget; of all calls beyond what
   their instructions explain; of one instruction, ten times the usual. */
static const double LOAD_SECONDS = 0.35, STALL_SECONDS = 0.5, STEP_SECONDS = 150e-9;
/* Time of one call besides its instructions, s: with reading the clock, a cold cache and a busy
   machine. */
static const double CALL_SECONDS = 20e-6;
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(NDEBUG)
static const double SLOWER = 4.0;
#elif defined(__wasm__)
static const double SLOWER = 10.0; /* no clock of processor time: other load counts, too */
#else
static const double SLOWER = 1.0;
#endif

JoxLuaLimits jox_lua_default_limits(void) {
    return (JoxLuaLimits){20000000, 100000, 20000000, 32u << 20, 2u << 20, 256u << 10, 20};
}

/* The debug hook of Lua: checks the budget, or calls the watcher of calls. */
static void run_debug_hook(lua_State *L, lua_Debug *debug);

/* Installs the debug hook to run every so many instructions and, while loading with a watcher, at
   calls and returns. */
static void set_hook(JoxVm *vm, uint32_t every) {
    const int calls = vm->loading && vm->watch ? LUA_MASKCALL | LUA_MASKRET : 0;
    lua_sethook(vm->L, run_debug_hook, LUA_MASKCOUNT | calls, (int)every);
}

/* Makes the debug hook run at the very next instruction instead of within the next thousand. */
static void stop_soon(JoxVm *vm) {
    vm->left = 0;
    if (vm->running)
        set_hook(vm, 1);
}

/* Returns whether a new block holds the keys of a table: a power of two of slots. Growing it is one
   instruction that takes time quadratic in colliding keys, so such blocks are limited to half the
   size. */
static bool is_hash_part(size_t old, size_t size) {
    enum { SLOT = 24 };
    size_t count = size / SLOT;
    return old == 0 && size % SLOT == 0 && (count & (count - 1)) == 0;
}

/* lua_Alloc within the limit of memory; large blocks are charged to the budget. */
static void *allocate_block(void *context, void *memory, size_t old, size_t size) {
    JoxVm *vm = context;
    if (!memory)
        old = 0; /* Lua then passes a type here */
    JOX_ASSERT(vm->used >= old);
    if (size == 0) {
        vm->used -= old;
        jox_give_back(memory);
        return NULL;
    }
    const JoxLuaLimits *limits = &vm->group->limits;
    const size_t most = is_hash_part(old, size) ? limits->block / 2 : limits->block;
    uint64_t cost = size > old ? (size - old) >> 2 : 0; /* one instruction can copy megabytes */
    void *result = NULL;
    if (size <= old || (size <= most && vm->used - old + size <= limits->memory))
        vm->no_memory = !(result = jox_try_realloc(memory, size));
    if (result)
        vm->used = vm->used - old + size;
    else
        cost += vm->used >> 4; /* Lua now collects garbage in the whole state */
    if (vm->left > cost)
        vm->left -= cost;
    else if (cost > 0)
        stop_soon(vm);
    return result;
}

/* Returns the limit of a load, s, in proportion to its budget of instructions. */
static double get_load_limit(const JoxVm *vm) {
    double share = (double)vm->group->limits.load_instructions / 20e6;
    return LOAD_SECONDS * SLOWER * (share > 1.0 ? share : 1.0);
}

/* Returns the time by which calls are watched, s. The clock of the wall is read in a twentieth of
   the time that the clock of the processor takes, and never passes slower: the latter is read
   while the former finds calls that last too long. */
static double read_watch(const JoxVm *vm) {
    return vm->suspected > 0 ? jox_clock_thread() : jox_clock_wall();
}

/* Begins to watch the time of the present call. */
static void start_watch(JoxVm *vm) {
    vm->watch_from = read_watch(vm);
    vm->watch_left = vm->left;
}

/* Adds up the time by which calls exceed what their instructions explain, times `weight` and at
   most `most`, s. Some instructions take unbounded time, as a look-up among colliding keys or a
   comparison of long strings; past the limit the run has to end. */
static void check_time(JoxVm *vm, double weight, double most) {
    if (vm->untimed)
        return;
    double now = read_watch(vm);
    double beyond = now - vm->watch_from - CALL_SECONDS * SLOWER -
                    (double)(vm->watch_left - vm->left) * STEP_SECONDS * SLOWER;
    if (beyond > 0.0 && vm->suspected == 0) { /* or this thread has had to wait */
        vm->suspected = SUSPECTED;
        start_watch(vm);
        return;
    }
    beyond = beyond * weight < most ? beyond * weight : most;
    vm->beyond = vm->beyond + beyond > 0.0 ? vm->beyond + beyond : 0.0;
    vm->watch_from = now;
    vm->watch_left = vm->left;
    if (vm->beyond > STALL_SECONDS * SLOWER && !vm->group->stalled[0])
        snprintf(vm->group->stalled, sizeof vm->group->stalled, "%s", vm->sources[0]->path);
}

/* Starts the time of a load with its first call. */
static void start_load_time(JoxVm *vm) {
    if (vm->deadline <= 0.0)
        vm->deadline = jox_clock_thread() + get_load_limit(vm);
}

/* Rest of a source to be compiled. */
typedef struct Piece {
    JoxVm *vm;
    const char *text;
    size_t length;
} Piece;

/* lua_Reader: gives the compiler the source in small pieces and checks the time between them, as
   names in deeply nested functions compile slowly. */
static const char *next_piece(lua_State *L, void *context, size_t *size) {
    enum { PIECE = 512 };
    Piece *p = context;
    const char *text = p->text;
    if (jox_clock_thread() > p->vm->deadline)
        luaL_error(L, "it took too long to compile");
    *size = p->length < PIECE ? p->length : PIECE;
    p->text += *size;
    p->length -= *size;
    return *size > 0 ? text : NULL;
}

bool jox_vm_compile(JoxVm *vm, size_t number) {
    JOX_ASSERT(number < vm->source_count);
    char chunk[24];
    snprintf(chunk, sizeof chunk, "=b%zu", number);
    start_load_time(vm);
    Piece piece = {vm, vm->sources[number]->text, vm->sources[number]->length};
    return lua_load(vm->L, next_piece, &piece, chunk, "t") == LUA_OK;
}

bool jox_vm_stops_within(JoxVm *vm, size_t number, size_t length) {
    JOX_ASSERT(number < vm->source_count && length <= vm->sources[number]->length);
    Piece piece = {vm, vm->sources[number]->text, length};
    const int top = lua_gettop(vm->L);
    bool stops = false;
    if (lua_load(vm->L, next_piece, &piece, "=part", "t") != LUA_OK) {
        const char *why = lua_tostring(vm->L, -1);
        stops = why && !strstr(why, "near <eof>");
    }
    lua_settop(vm->L, top);
    return stops;
}

int jox_vm_stop(lua_State *L) {
    JoxVm *vm = jox_vm_of(L);
    vm->over = true;
    stop_soon(vm);
    return lua_error(L);
}

/* Raises the error of a spent budget, at the script's line of `level`. */
static int raise_over_budget(lua_State *L, int level) {
    luaL_where(L, level);
    lua_pushliteral(L, "it ran for too long (over its budget of instructions) and was stopped");
    lua_concat(L, 2);
    return jox_vm_stop(L);
}

/* Takes the instructions since the last check from the budget. Once it is spent the hook fails at
   every instruction, so that pcall cannot go on. */
static void count_instructions(JoxVm *vm) {
    lua_State *L = vm->L;
    bool good = !vm->over && !vm->starved && vm->left > vm->interval;
    if (good)
        vm->left -= vm->interval;
    if (vm->loading) {
        good = good && jox_clock_thread() < vm->deadline;
    } else if (vm->interval == CHECK_EVERY) {
        check_time(vm, 1.0, 1e9);
        good = good && !vm->group->stalled[0];
    } else if (good) {
        start_watch(vm);
    }
    if (!good)
        raise_over_budget(L, 0);
    if (vm->interval != CHECK_EVERY) {
        vm->interval = CHECK_EVERY;
        set_hook(vm, CHECK_EVERY);
    }
}

static void run_debug_hook(lua_State *L, lua_Debug *debug) {
    JoxVm *vm = jox_vm_of(L);
    if (debug->event == LUA_HOOKCOUNT)
        count_instructions(vm);
    else if (!vm->over && vm->running)
        vm->watch(L, debug);
}

void jox_vm_charge(lua_State *L, uint64_t steps) {
    JoxVm *vm = jox_vm_of(L);
    JOX_ASSERT(vm->L == L);
    if (!vm->running)
        return; /* called by the engine, outside of a script */
    bool late =
        vm->loading && vm->charges++ % CHARGES_TIMED == 0 &&
        jox_clock_thread() > vm->deadline; /* colliding keys cost time that counts do not see */
    if (vm->over || vm->starved || late || vm->left <= steps)
        raise_over_budget(L, 1);
    vm->left -= steps;
}

JoxVm *jox_vm_of(lua_State *L) {
    return *(JoxVm **)lua_getextraspace(L);
}

/* Closes the state after the heap has failed. Finalizers must not see the VM, which may be half
   freed. */
static void release_state(void *state) {
    *(JoxVm **)lua_getextraspace((lua_State *)state) = NULL;
    lua_close(state);
}

/* Called at an error outside of a protected call, where only memory can run out. */
static int abort_state(lua_State *L) {
    (void)L;
    jox_out_of_memory(0);
}

bool jox_vm_open(JoxVm *vm, JoxVmGroup *group, lua_CFunction open) {
    JOX_ASSERT(!vm->L && !vm->group);
    vm->group = group;
    vm->L = lua_newstate(allocate_block, vm);
    if (!vm->L)
        jox_out_of_memory(0);
    jox_heap_register(vm->L, release_state);
    lua_atpanic(vm->L, abort_state);
    *(JoxVm **)lua_getextraspace(vm->L) = vm;
    lua_pushcfunction(vm->L, open);
    bool good = lua_pcall(vm->L, 0, 0, 0) == LUA_OK;
    if (!good && vm->no_memory)
        jox_out_of_memory(0);
    JOX_ASSERT(!good || lua_gettop(vm->L) == 0);
    return good;
}

void jox_vm_close(JoxVm *vm) {
    JOX_ASSERT(!vm->running);
    jox_heap_unregister(vm->L);
    lua_close(vm->L);
    JOX_ASSERT(vm->used == 0);
    for (size_t i = 0; i < vm->name_count; i++)
        jox_free(vm->names[i]);
    for (size_t i = 0; i < vm->source_count; i++) {
        jox_source_free(vm->sources[i]);
        jox_free(vm->sources[i]);
    }
    for (uint32_t i = 0; i < vm->file_count; i++)
        jox_free(vm->files[i].path);
    for (uint32_t i = 0; i < vm->tried_count; i++)
        jox_free(vm->tried[i]);
    jox_free(vm->tried);
    jox_text_free(&vm->printed_text);
    jox_free(vm->names);
    jox_free(vm->sources);
    jox_free(vm->files);
    *vm = (JoxVm){0};
}

const char *jox_vm_intern(JoxVm *vm, const char *name) {
    jox_vm_charge(vm->L, vm->name_count / 8 + 1);
    for (size_t i = 0; i < vm->name_count; i++)
        if (strcmp(vm->names[i], name) == 0)
            return vm->names[i];
    if (vm->name_count >= MOST_NAMES)
        luaL_error(vm->L, "it uses over %d names", MOST_NAMES);
    JOX_RESERVE(vm->names, vm->name_capacity, vm->name_count + 1);
    return vm->names[vm->name_count++] = jox_strdup(name);
}

int jox_vm_source(const JoxVm *vm, const char *chunk) {
    int number, used = 0;
    if (sscanf(chunk, "b%d%n", &number, &used) != 1 || chunk[used] || number < 0 ||
        (size_t)number >= vm->source_count)
        return -1;
    return number;
}

JoxPosition jox_vm_place(lua_State *L) {
    const JoxVm *vm = jox_vm_of(L);
    lua_Debug debug;
    for (int level = 1, number; lua_getstack(L, level, &debug); level++)
        if (lua_getinfo(L, "Sl", &debug) && debug.currentline > 0 &&
            (number = jox_vm_source(vm, debug.short_src)) >= 0)
            return (JoxPosition){vm->sources[number]->path, debug.currentline, 0, 0};
    return (JoxPosition){0};
}

const char *jox_vm_split(const JoxVm *vm, const char *message, int *line, size_t *source) {
    int number, used = 0;
    *line = 0;
    *source = 0;
    if (sscanf(message, "b%d:%d: %n", &number, line, &used) == 2 && used > 0) {
        *source = number > 0 && (size_t)number < vm->source_count ? (size_t)number : 0;
        return message + used;
    }
    *line = 0;
    return message;
}

/* Message handler of lua_pcall: keeps the stack of a failure, frames in script files only,
   innermost first. */
static int keep_traceback(lua_State *L) {
    JoxVm *vm = jox_vm_of(L);
    size_t used = 0;
    int shown = 0;
    vm->traceback[0] = 0;
    lua_Debug debug;
    for (int level = 1; shown < 10 && lua_getstack(L, level, &debug); level++) {
        lua_getinfo(L, "Sln", &debug);
        int number = debug.currentline < 1 ? -1 : jox_vm_source(vm, debug.short_src);
        if (number < 0)
            continue;
        char name[48]; /* may be any text: t["..."]() */
        snprintf(name, sizeof name, "%.40s", debug.name ? debug.name : "");
        jox_text_clean(name);
        used += (size_t)snprintf(vm->traceback + used, sizeof vm->traceback - used,
                                 "   at %.200s:%d%s%s%s\n", vm->sources[number]->path,
                                 debug.currentline, debug.name ? " in '" : "", name,
                                 debug.name ? "'" : "");
        shown++;
        if (used >= sizeof vm->traceback)
            break;
    }
    if (shown < 2) /* the message already names the only frame */
        vm->traceback[0] = 0;
    return 1;
}

bool jox_vm_may_say(JoxVm *vm, uint32_t second) {
    if (vm->complaint_second != second) {
        vm->complaint_second = second;
        vm->complaints = 0;
    }
    vm->complaints += vm->complaints < SAID + 1;
    return vm->complaints <= SAID;
}

/* Returns the budget of a call: reduced if earlier calls of this step have used up what they share.
 */
static uint64_t get_call_budget(JoxVm *vm, uint64_t instructions) {
    if (vm->calls == 0 || vm->step != vm->budget_step) {
        vm->budget_step = vm->step;
        vm->step_left = vm->group->limits.step_instructions;
    }
    uint64_t left = vm->step_left > LEAST_BUDGET ? vm->step_left : LEAST_BUDGET;
    return instructions < left ? instructions : left;
}

void jox_vm_push_handler(JoxVm *vm) {
    lua_pushcfunction(vm->L, keep_traceback);
}

bool jox_vm_call(JoxVm *vm, int arguments, int results, uint64_t instructions, const char **why,
                 int *line) {
    JOX_ASSERT(arguments >= 0 && lua_gettop(vm->L) > arguments);
    const int handler = lua_gettop(vm->L) - arguments;
    jox_vm_push_handler(vm);
    lua_insert(vm->L, handler);
    const bool good = jox_vm_call_handled(vm, arguments, results, instructions, why, line);
    if (good)
        lua_remove(vm->L, handler);
    return good;
}

bool jox_vm_call_handled(JoxVm *vm, int arguments, int results, uint64_t instructions,
                         const char **why, int *line) {
    JOX_ASSERT(!vm->running);
    const int handler = lua_gettop(vm->L) - arguments - 1;
    JOX_ASSERT(arguments >= 0 && handler > 0 && lua_iscfunction(vm->L, handler));
    vm->over = vm->starved = false;
    vm->failed_source = 0;
    vm->traceback[0] = 0;
    if (vm->loading)
        start_load_time(vm);
    else if (!vm->untimed)
        instructions = get_call_budget(vm, instructions);
    vm->left = instructions;
    const JoxNumeric before = jox_numeric_use(jox_numeric_plain());
    bool sampled = !vm->loading && vm->calls++ % SAMPLED == 0;
    vm->suspected -= vm->suspected > 0;
    if (sampled)
        start_watch(vm);
    vm->interval = vm->loading ? CHECK_EVERY : FIRST_CHECK;
    set_hook(vm, vm->interval);
    vm->running = true;
    int status = lua_pcall(vm->L, arguments, results, handler);
    vm->running = false;
    lua_sethook(vm->L, NULL, 0, 0);
    if (!vm->loading)
        vm->step_left -=
            instructions - vm->left < vm->step_left ? instructions - vm->left : vm->step_left;
    if (!vm->loading && vm->interval == CHECK_EVERY)
        check_time(vm, 1.0, 1e9);
    else if (sampled) /* a short call stands for SAMPLED others */
        check_time(vm, SAMPLED, 0.1);
    jox_numeric_use(before);
    if (status == LUA_OK)
        return true;
    if (vm->no_memory)
        jox_out_of_memory(0);
    static _Thread_local char text[512];
    *line = 0;
    *why = text;
    /* An error object that is no string is not converted, as that would run the script's code. */
    if (status == LUA_ERRMEM || vm->starved)
        snprintf(text, sizeof text, "it asked for too much memory and was stopped");
    else if (lua_type(vm->L, -1) == LUA_TSTRING)
        snprintf(text, sizeof text, "%s",
                 jox_vm_split(vm, lua_tostring(vm->L, -1), line, &vm->failed_source));
    else
        snprintf(text, sizeof text, "it raised an error that is a %s, not a text",
                 lua_typename(vm->L, lua_type(vm->L, -1)));
    jox_text_clean(text);
    lua_settop(vm->L, 0);
    return false;
}
