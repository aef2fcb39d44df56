/* Assertions for our own mistakes and for misuse of the C API; users' files get diagnostics. */
#ifndef JOX_BASE_ASSERT_H
#define JOX_BASE_ASSERT_H

/* Reports a broken expectation through the handler (default: print; abort in debug builds). */
void jox_assert_failed(const char *condition, const char *file, int line);

/* The same of a condition that somebody found not to hold; NULL: all hold. */
void jox_assert_no_fault(const char *condition, const char *file, int line);

/* Replaces the handler; NULL restores the default. The handler may return. */
typedef void JoxAssertHandler(const char *condition, const char *file, int line);
void jox_assert_set_handler(JoxAssertHandler *handler);

/* Internal invariants: compiled out of release builds. */
#ifdef NDEBUG
#define JOX_ASSERT(condition) ((void)(0 && (condition))) /* never evaluated */
#else
#define JOX_ASSERT(condition)                                                                      \
    ((condition) ? (void)0 : jox_assert_failed(#condition, __FILE__, __LINE__))
#endif

/* Calls a function of checks, which may be slow, in builds with assertions alone. */
#ifdef NDEBUG
#define JOX_CHECK(call) ((void)(0 && ((call), 1))) /* never evaluated */
#else
#define JOX_CHECK(call) (call)
#endif

/* In a function that looks for faults: it returns what does not hold, as the code has it, for an
   assertion, or for who read it from a file; NULL at its end. */
#define JOX_MUST(condition)                                                                        \
    do {                                                                                           \
        if (!(condition))                                                                          \
            return #condition;                                                                     \
    } while (0)

/* Expects that such a function found none. */
#define JOX_NO_FAULT(call) jox_assert_no_fault((call), __FILE__, __LINE__)

/* Misuse of the public API: reported in every build, then the function returns `result`. */
#define JOX_REQUIRE(condition, result)                                                             \
    do {                                                                                           \
        if (!(condition)) {                                                                        \
            jox_assert_failed(#condition, __FILE__, __LINE__);                                     \
            return result;                                                                         \
        }                                                                                          \
    } while (0)

#endif
