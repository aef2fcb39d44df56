/* The text of input logs: every verb is read as it is written, every mistake has its place, and no
   text whatever does harm. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/mem.h"
#include "base/number/random.h"
#include "world/verbs/verb_table.h"

static const char ALL[] = "# a comment\n"
                          "\n"
                          "0 player 3 1.5 -0.25\n"
                          "1 throw ball 1 2 0.5 3 0 4\n"
                          "1 throw \"red ball\" here 3 0 4 0.1 0.2 0.3   # and why\n"
                          "2 box 1 2 1.5 5 0 3 0.4 10\n"
                          "2 grab 7 1 2 0.5\n"
                          "3 drag 7 1 3 0.5\n"
                          "3 release 7\n"
                          "4 push 12 300 -20.125\n"
                          "5 open gate\n"
                          "5 close \"say \\\"so\\\" \\\\ twice\"\n"
                          "6 signal run\n"
                          "7 set walker Walk speed 1.2\n"
                          "7 began 18446744073709551615 0.05\n"
                          "7 made \"a b.lua\" 0c8e\n"
                          "8 before 1\n"
                          "a.lua 4\n"
                          "a\n"
                          "b\n"
                          "\n"
                          "8 files 2\n"
                          "a.lua 3\n"
                          "# 2\n"
                          "\"b c.lua\" 0\n"
                          "\n"
                          "9 signal \"#1\"\n"
                          "10 spawn visitors 3 4.5\n"
                          "10 remove 7\n"
                          "10 teleport 7 3 4.5\n"
                          "10 goal 7 \"the exit\"\n"
                          "10 state 7 Flee\n"
                          "10 memory 7 hits 2\n"
                          "10 parameter 7 speed 1.6\n"
                          "11 impulse 0 20 0 0\n"
                          "11 impulse 0 20 0 0 1 2 0.5\n"
                          "11 place 0 1 2 0.5\n"
                          "11 place 0 1 2 0.5 0 0 0.6 0.8\n"
                          "11 velocity 0 1 0 0\n"
                          "11 delete 0\n"
                          "12 wall barrier 0 0 4 0\n"
                          "12 wall barrier 0 0 4 0 4 1 0 1\n"
                          "12 unwall barrier\n"
                          "13 setting gentle-queue manner \"quite rude\"\n"
                          "14 lift east out_of_use\n";
enum { IN_ALL = 35 };

static JoxDiagnostics wrong;

static JoxInputLog parse(const char *text, size_t length) {
    JoxInputLog log = {0};
    jox_diag_free(&wrong);
    bool good = jox_input_parse(&log, "x.input", text, length, &wrong);
    assert_int_equal(good, wrong.errors == 0);
    return log;
}

static JoxText write_all(const JoxInputLog *log) {
    JoxText text = {0};
    for (size_t e = 0; e < log->count; e++)
        jox_input_write(&log->entries[e], &text);
    return text;
}

static void each_verb_is_read(void **state) {
    (void)state;
    JoxInputLog log = parse(ALL, sizeof ALL - 1);
    assert_int_equal(wrong.errors, 0);
    assert_int_equal(log.count, IN_ALL);
    const JoxInputEntry *e = log.entries;
    for (uint32_t v = 0; v < jox_input_verb_count; v++) { /* none is left out above */
        bool there = false;
        for (int k = 0; k < IN_ALL; k++)
            there |= e[k].verb == (JoxInputVerb)v;
        assert_true(there);
    }
    assert_int_equal(e[0].number, 3);
    assert_true(e[0].numbers[0] == 1.5 && e[0].numbers[1] == -0.25);
    assert_false(e[1].here);
    assert_true(e[1].numbers[5] == 4.0 && e[1].given == 6);
    assert_string_equal(e[2].names[0], "red ball");
    assert_true(e[2].here && e[2].given == 9 && e[2].numbers[3] == 3.0 && e[2].numbers[8] == 0.3);
    assert_true(e[3].numbers[6] == 0.4 && e[3].numbers[7] == 10.0);
    assert_string_equal(e[9].names[0], "say \"so\" \\ twice");
    assert_string_equal(e[11].names[2], "speed");
    assert_int_equal(e[15].number, 2);
    assert_int_equal(e[14].files[0].length, 4);
    assert_memory_equal(e[14].files[0].text, "a\nb\n", 4);
    assert_string_equal(e[15].files[1].path, "b c.lua");
    assert_int_equal(e[16].tick, 9);
    assert_int_equal(e[16].line, 27);
    assert_string_equal(e[16].names[0], "#1");
    jox_input_free(&log);
}

static void each_example_is_right(void **state) {
    (void)state;
    for (uint32_t v = 0; v < jox_input_verb_count; v++) {
        JoxText text = {0};
        jox_text_printf(&text, "0 %s\n", jox_input_verbs[v].example);
        if (jox_input_verbs[v].words[0].kind == JOX_WORD_FILES)
            jox_text_add(&text, "a.lua 0\n\n");
        JoxInputLog log = parse(text.data, text.length);
        if (wrong.errors || log.count != 1 || log.entries[0].verb != (JoxInputVerb)v)
            fail_msg("%s", text.data);
        jox_input_free(&log);
        jox_text_free(&text);
    }
    JoxText page = {0};
    jox_input_append_reference(&page);
    const char *files = strstr(page.data, "    118 files");
    assert_non_null(files);
    JoxText block = {0};
    for (const char *line = files; *line; line = strchr(line, '\n') + 1) /* without the margin */
        jox_text_append(&block, line + (*line == ' ' ? 4 : 0),
                        strcspn(line, "\n") + 1 - (*line == ' ' ? 4 : 0));
    JoxInputLog log = parse(block.data, block.length);
    assert_int_equal(wrong.errors, 0);
    assert_int_equal(log.count, 2);
    assert_string_equal(log.entries[0].files[0].text, "return 1.25\n");
    jox_input_free(&log);
    jox_text_free(&block);
    jox_text_free(&page);
}

static void written_entry_reads_back(void **state) {
    (void)state;
    JoxInputLog log = parse(ALL, sizeof ALL - 1);
    JoxText once = write_all(&log);
    JoxInputLog again = parse(once.data, once.length);
    assert_int_equal(wrong.errors, 0);
    JoxText twice = write_all(&again);
    assert_string_equal(once.data, twice.data);
    assert_non_null(strstr(once.data, "throw \"red ball\" here 3 0 4 0.1 0.2 0.3\n"));
    jox_input_free(&log);
    jox_input_free(&again);
    jox_text_free(&once);
    jox_text_free(&twice);
}

static void numbers_keep_every_bit(void **state) {
    (void)state;
    for (uint32_t n = 0; n < 20000; n++) {
        double v = (jox_random_unit(1, n, 0, 0, 0) - 0.5) * (n % 3 ? 40.0 : 1e-7);
        JoxInputEntry entry = {.verb = JOX_INPUT_PLAYER, .numbers = {v, -v}, .given = 2};
        JoxText text = {0};
        jox_input_write(&entry, &text);
        JoxInputLog log = parse(text.data, text.length);
        assert_int_equal(log.count, 1);
        assert_true(log.entries[0].numbers[0] == v && log.entries[0].numbers[1] == -v);
        jox_input_free(&log);
        jox_text_free(&text);
    }
}

/* One wrong line each: its message and position. */
static void errors_have_positions(void **state) {
    (void)state;
    static const struct {
        const char *text;
        int line, column;
        const char *says, *hint;
    } CASES[] = {
        {"0 push 1 1 1\n\n 5 opn gate\n", 3, 4, "there is no verb 'opn'", "open"},
        {"0\n", 1, 2, "there is no verb", "Example"},
        {"x push 1 1 1\n", 1, 1, "TICK must be a number, not 'x'", "From 0"},
        {"1.5 push 1 1 1\n", 1, 1, "TICK must be a whole number", ""},
        {"-1 push 1 1 1\n", 1, 1, "TICK must be from 0", ""},
        {"5 push 1 1 1\n4 push 1 1 1\n", 2, 1, "ticks must not decrease: 4 comes behind 5", ""},
        {"0 push 1 1\n", 1, 11, "push expects: push AGENT FX FY", "Example: push"},
        {"0 push 1 1 1 1\n", 1, 14, "'1' is one word too many", ""},
        {"0 push 1 20000 1\n", 1, 10, "FX must be from -10000 to 10000 N, not 20000", ""},
        {"0 push 1 nan 1\n", 1, 10, "FX must be a number", ""},
        {"0 push 1 inf 1\n", 1, 10, "FX must be from", ""},
        {"0 push -1 1 1\n", 1, 8, "AGENT must be from 0", ""},
        {"0 player 1 \"2\" 1\n", 1, 12, "VX must be a number, not '2'", ""},
        {"0 open \"gate\n", 1, 8, "the name is not closed", "quote"},
        {"0 open \"\"\n", 1, 8, "WALL must have from 1 to 120 bytes", ""},
        {"0 open a\001b\n", 1, 8, "a control character", ""},
        {"0 throw ball here 1 2\n", 1, 22, "throw expects: throw BODY X Y Z VX VY VZ [WX WY WZ]",
         ""},
        {"0 throw ball 1 2 3 4 5 6 7\n", 1, 27, "throw expects", ""},
        {"0 box 0 0 1 0 0 0 9 1\n", 1, 19, "SIZE must be from 0.05 to 5 m, not 9", ""},
        {"0 files 0\n", 1, 9, "N must be from 1 to 1024 files, not 0", ""},
        {"0 files 1\n", 2, 1, "expected a file: PATH BYTES", "Example"},
        {"0 files 1\na.lua\nx\n", 2, 6, "how many bytes has 'a.lua'?", ""},
        {"0 files 1\na.lua 9\nx\n", 2, 7, "only 2 bytes follow, not 9", "cut off"},
        {"0 files 1\na.lua 1\nxyz\n", 2, 7, "behind 1 bytes 'a.lua' does not end", "Count"},
        {"0 files 1\na.lua 1e99\nxyz\n", 2, 7, "BYTES must be from 0", ""},
    };
    for (size_t c = 0; c < sizeof CASES / sizeof *CASES; c++) {
        JoxInputLog log = parse(CASES[c].text, strlen(CASES[c].text));
        if (wrong.count != 1 || !strstr(wrong.items[0].message, CASES[c].says) ||
            wrong.items[0].line != CASES[c].line || wrong.items[0].column != CASES[c].column ||
            !strstr(wrong.items[0].hint ? wrong.items[0].hint : "", CASES[c].hint))
            fail_msg("%s: %zu errors, %d:%d: %s (%s)", CASES[c].text, wrong.count,
                     wrong.count ? wrong.items[0].line : 0, wrong.count ? wrong.items[0].column : 0,
                     wrong.count ? wrong.items[0].message : "",
                     wrong.count && wrong.items[0].hint ? wrong.items[0].hint : "");
        assert_string_equal(wrong.items[0].file, "x.input");
        jox_input_free(&log);
    }
}

static void single_line_is_read(void **state) {
    (void)state;
    static const char *const BAD[] = {"",         "   ",     "# only",    "0 open gate", "files 1",
                                      "before 1", "open",    "open a b",  "throw",       "set a b",
                                      "open \"a", "box 1 2", "open a\nb", "player 1 1 x"};
    JoxInputEntry entry;
    JoxText said = {0};
    for (size_t b = 0; b < sizeof BAD / sizeof *BAD; b++) {
        said.length = 0;
        if (jox_input_read_line(BAD[b], &entry, &said) || said.length < 10)
            fail_msg("'%s' was read, or not explained", BAD[b]);
    }
    said.length = 0;
    assert_true(jox_input_read_line("  open   gate  # now", &entry, &said));
    assert_string_equal(entry.names[0], "gate");
    assert_int_equal(entry.line, 0);
    jox_input_entry_free(&entry);
    char longest[5000];
    memset(longest, 'a', sizeof longest);
    memcpy(longest, "open ", 5);
    longest[4999] = 0;
    assert_false(jox_input_read_line(longest, &entry, &said));
    jox_text_free(&said);
}

/* Texts with bytes put in, taken out, doubled or cut: they are read or refused, and what is read is
   written and read again. */
static void random_text_does_no_harm(void **state) {
    (void)state;
    static const char BYTES[] = "0123456789-+.eE \t\r\n\"\\#abcfilesthrowhere\001\177\377\200";
    char text[2 * sizeof ALL];
    uint32_t read = 0, refused = 0;
    for (uint32_t n = 0; n < 12000; n++) {
        size_t length = sizeof ALL - 1;
        memcpy(text, ALL, length);
        uint32_t edits = 1 + (uint32_t)(jox_random_bits(2, n, 0, 0, 0) % 4);
        for (uint32_t k = 0; k < edits; k++) {
            uint64_t bits = jox_random_bits(2, n, k + 1, 0, 0);
            size_t at = (size_t)(bits >> 8) % length;
            char byte = BYTES[(bits >> 40) % (sizeof BYTES - 1)];
            switch (bits & 3) {
            case 0:
                text[at] = byte;
                break;
            case 1:
                memmove(text + at + 1, text + at, length - at);
                text[at] = byte;
                length++;
                break;
            case 2:
                memmove(text + at, text + at + 1, length - at - 1);
                length--;
                break;
            default:
                length = at > 20 ? at : length;
            }
        }
        char *exact = malloc(length); /* so that a byte too many is noticed */
        memcpy(exact, text, length);
        JoxInputLog log = parse(exact, length);
        free(exact);
        for (size_t d = 0; d < wrong.count; d++)
            assert_true(wrong.items[d].line > 0 && wrong.items[d].column > 0 &&
                        *wrong.items[d].message);
        *(wrong.errors ? &refused : &read) += 1;
        JoxText once = write_all(&log);
        JoxInputLog again = parse(once.data ? once.data : "", once.length);
        JoxText twice = write_all(&again);
        if (once.length != twice.length ||
            (once.length && memcmp(once.data, twice.data, once.length) != 0))
            fail_msg("case %u: written once:\n%s\nand again:\n%s", n, once.data, twice.data);
        jox_text_free(&once);
        jox_text_free(&twice);
        jox_input_free(&log);
        jox_input_free(&again);
    }
    assert_true(read > 400 && refused > 400);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_verb_is_read),        cmocka_unit_test(each_example_is_right),
        cmocka_unit_test(written_entry_reads_back), cmocka_unit_test(numbers_keep_every_bit),
        cmocka_unit_test(errors_have_positions),    cmocka_unit_test(single_line_is_read),
        cmocka_unit_test(random_text_does_no_harm),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    jox_diag_free(&wrong);
    return failed;
}
