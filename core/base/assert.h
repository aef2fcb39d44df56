/* Assertions for our own mistakes and for misuse of the C API; users' files get diagnostics. */
#ifndef JOX_BASE_ASSERT_H
#define JOX_BASE_ASSERT_H

/* Reports a broken expectation through the handler (default: print; abort in debug builds). */
void jox_assert_failed(const char *condition, const char *file, int line);

/* Reports `condition`, the text of one that a JOX_MUST found broken; NULL reports nothing. */
void jox_assert_no_fault(const char *condition, const char *file, int line);

/* Replaces the handler; NULL restores the default. The handler may return. */
typedef void JoxAssertHandler(const char *condition, const char *file, int line);
void jox_assert_set_handler(JoxAssertHandler *handler);

/* Checks an invariant of the engine; compiled out of release builds. */
#ifdef NDEBUG
#define JOX_ASSERT(condition) ((void)(0 && (condition))) /* never evaluated */
#else
#define JOX_ASSERT(condition)                                                                      \
    ((condition) ? (void)0 : jox_assert_failed(#condition, __FILE__, __LINE__))
#endif

/* Calls a function that checks invariants, and may be slow, in builds with assertions alone. */
#ifdef NDEBUG
#define JOX_CHECK(call) ((void)(0 && ((call), 1))) /* never evaluated */
#else
#define JOX_CHECK(call) (call)
#endif

/* For functions that check data and return the first broken condition, as source text, or NULL at
   their end. Their callers assert on it (JOX_NO_FAULT), or report a file that has such data. */
#define JOX_MUST(condition)                                                                        \
    do {                                                                                           \
        if (!(condition))                                                                          \
            return #condition;                                                                     \
    } while (0)

/* Asserts that a function of JOX_MUST found no broken condition. */
#define JOX_NO_FAULT(call) jox_assert_no_fault((call), __FILE__, __LINE__)

/* Checks an argument of a public call. Misuse is reported in every build, and the calling function
   returns `result`. */
#define JOX_REQUIRE(condition, result)                                                             \
    do {                                                                                           \
        if (!(condition)) {                                                                        \
            jox_assert_failed(#condition, __FILE__, __LINE__);                                     \
            return result;                                                                         \
        }                                                                                          \
    } while (0)

#endif
