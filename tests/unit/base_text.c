/* Text, JSON escapes, suggestions, diagnostics. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "base/format/diag.h"
#include "base/format/name.h"
#include "base/format/plurals.h"
#include "base/text.h"

static void json_escapes_any_bytes(void **state) {
    (void)state;
    JoxText text = {0};
    jox_text_json(&text, "a\"b\\c\n\x01\xff\xc3\xa9");
    assert_string_equal(text.data, "\"a\\\"b\\\\c\\u000a\\u0001\\ufffd\xc3\xa9\"");
    jox_text_free(&text);
}

static void suggestions_are_near_or_absent(void **state) {
    (void)state;
    const char *names[] = {"stuck", "after", "inside", "crosses"};
    assert_string_equal(jox_suggest("stuk", names, 4), "stuck");
    assert_string_equal(jox_suggest("isnide", names, 4), "inside");
    assert_null(jox_suggest("elephant", names, 4));
    char hint[JOX_HINT] = "as it was";
    assert_null(jox_did_you_mean("elephant", names, 4, hint));
    assert_string_equal(hint, "as it was");
    assert_string_equal(jox_did_you_mean("aftre", names, 4, hint), "Did you mean 'after'?");
}

static void a_diagnostic_prints_its_place(void **state) {
    (void)state;
    JoxDiagnostics d = {0};
    jox_diag_add(&d, JOX_SEVERITY_ERROR, (JoxPosition){"x.lua", 2, 3, 6}, "unknown-word",
                 "Did you mean 'abc'?", "machine m > state S", NULL, "unknown word '%s'", "abd");
    const char *source = "first\n  abd()\n";
    jox_diag_attach_source(&d, "x.lua", source, strlen(source));
    JoxText text = {0};
    jox_diag_print(&d, &text);
    assert_string_equal(text.data, "x.lua:2:3: unknown word 'abd'. Did you mean 'abc'?\n"
                                   "    2 |   abd()\n"
                                   "      |   ^^^\n"
                                   " machine m > state S\n");
    jox_text_free(&text);
    jox_diag_json(&d, &text);
    assert_non_null(strstr(text.data, "\"line\": 2, \"column\": 3, \"end\": 6"));
    jox_text_free(&text);
    jox_diag_free(&d);
}

static void surplus_diagnostics_are_counted(void **state) {
    (void)state;
    JoxDiagnostics d = {0};
    for (int i = 0; i < 100; i++)
        jox_diag_error(&d, ((JoxPosition){"f", i + 1, 1, 2}), "flood", NULL, "error %d", i);
    assert_int_equal(d.errors, 100);
    assert_int_equal(d.count, 20);
    JoxText text = {0};
    jox_diag_print(&d, &text);
    assert_non_null(strstr(text.data, "80 more errors"));
    jox_text_free(&text);
    jox_diag_free(&d);
}

static void text_is_cleaned_for_terminals(void **state) {
    (void)state;
    char text[] = "a\033[2J\n\tb\x7f \xc3\xa4 \xc2\x9b \xff\xc3";
    jox_text_clean(text);
    assert_string_equal(text, "a?[2J  b? \xc3\xa4 ?? ??");
}

static void names_follow_the_rule(void **state) {
    (void)state;
    static const char *const GOOD[] = {"a",
                                       "9",
                                       "_x",
                                       "red team",
                                       "door-1.b",
                                       "\xc3\xa4rzte",
                                       "\xd9\x85\xd9\x86\xd9\x89",
                                       "\xe4\xba\xba\xe7\xbe\xa4",
                                       "\xe0\xa4\xad\xe0\xa5\x80\xe0\xa4\xa1\xe0\xa4\xbc"};
    static const char *const BAD[] = {"",
                                      " a",
                                      "a ",
                                      "-a",
                                      ".a",
                                      "a`b",
                                      "a'b",
                                      "a\"b",
                                      "a$b",
                                      "a\nb",
                                      "a<b",
                                      "a;b",
                                      "a/b",
                                      "a@b",
                                      "a%b",
                                      "a|b",
                                      "a\\b",
                                      "\x7f",
                                      "\xff",
                                      "\xc2\x85",
                                      "\xe2\x80\xae"
                                      "a",
                                      "\xf0\x9f\x98\x80",
                                      "\xe2\x80\x9c",
                                      "\xef\xbb\xbf"
                                      "a"};
    char longest[102];
    for (size_t k = 0; k < sizeof GOOD / sizeof *GOOD; k++)
        assert_true(jox_name_is_plain(GOOD[k]));
    for (size_t k = 0; k < sizeof BAD / sizeof *BAD; k++)
        if (jox_name_is_plain(BAD[k]))
            fail_msg("a name: '%s'", BAD[k]);
    memset(longest, 'a', sizeof longest);
    longest[101] = 0;
    assert_false(jox_name_is_plain(longest));
    longest[100] = 0;
    assert_true(jox_name_is_plain(longest));
}

static void nouns_agree_with_numbers(void **state) {
    (void)state;
    char out[JOX_NOUN];
    assert_string_equal(jox_noun(out, 1, "agent"), "1 agent");
    assert_string_equal(jox_noun(out, 0, "agent"), "0 agents");
    assert_string_equal(jox_noun(out, 35000, "person|people"), "35,000 people");
    assert_string_equal(jox_noun(out, 1, "person|people"), "1 person");
    assert_string_equal(jox_noun(out, 2, "body"), "2 bodies");
    assert_string_equal(jox_noun(out, 2, "way"), "2 ways");
    assert_string_equal(jox_noun_alone(out, 1, "is|are"), "is");
    assert_string_equal(jox_number_text(out, 18446744073709551615u), "18,446,744,073,709,551,615");
    assert_string_equal(jox_number_text(out, 999), "999");
    assert_string_equal(jox_article("event"), "an");
    assert_string_equal(jox_article("probe"), "a");
    char longest[300];
    memset(longest, 'x', sizeof longest - 1);
    longest[sizeof longest - 1] = 0;
    assert_int_equal(strlen(jox_noun(out, 12, longest)),
                     JOX_NOUN - 1); /* cut to the size of `out` */
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nouns_agree_with_numbers),
        cmocka_unit_test(text_is_cleaned_for_terminals),
        cmocka_unit_test(json_escapes_any_bytes),
        cmocka_unit_test(suggestions_are_near_or_absent),
        cmocka_unit_test(a_diagnostic_prints_its_place),
        cmocka_unit_test(surplus_diagnostics_are_counted),
        cmocka_unit_test(names_follow_the_rule),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
