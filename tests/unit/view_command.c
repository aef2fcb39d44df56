/* Tests of reading the page's commands: flat JSON objects are read, anything else is refused. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "view/command.h"

static void flat_json_commands_are_read(void **state) {
    (void)state;
    JoxCommand command;
    assert_true(
        jox_command_read(" {\"do\" : \"input\", \"line\":\"open \\\"Tor \\u00fc\\\" \xc3\xa4\","
                         "\"n\": -1.5e2 , \"on\":true, \"off\":false,\"slot\":null } ",
                         &command));
    assert_string_equal(command.verb, "input");
    assert_string_equal(jox_command_text(&command, "line", "?"), "open \"Tor \xc3\xbc\" \xc3\xa4");
    assert_true(jox_command_number(&command, "n", 0) == -150.0);
    assert_true(jox_command_bool(&command, "on", false));
    assert_false(jox_command_bool(&command, "off", true));
    assert_string_equal(jox_command_text(&command, "n", "?"), "?"); /* a number, not a text */
    assert_true(jox_command_number(&command, "slot", 7) == 7);
    assert_true(jox_command_read("{\"do\": \"\\ud83d\\ude00\"}", &command));
    assert_string_equal(command.verb, "\xf0\x9f\x98\x80");
    static const char *const BAD[] = {"{\"do\": \"a\", }",
                                      "{\"do\": \"a\" \"b\": 1}",
                                      "{\"do\": \"\xff\"}",
                                      "{\"do\": \"\xc0\x80\"}",
                                      "{\"do\": \"\xed\xa0\x80\"}",
                                      "{\"do\": \"a\", \"b\": 1e999}",
                                      "{\"do\": \"a\", \"b\": 0x10}",
                                      "{\"do\": \"a\", \"b\": +1}",
                                      "{\"do\": \"a\", \"b\": inf}",
                                      "{\"do\": \"\\u0007\"}",
                                      "{\"do\": \"\x1b[2J\"}",
                                      "{\"do\": \"\\ude00\"}",
                                      "{\"do\": \"a\"",
                                      "{\"do\": \"a",
                                      "{do: \"a\"}"};
    for (size_t i = 0; i < sizeof BAD / sizeof *BAD; i++)
        if (jox_command_read(BAD[i], &command))
            fail_msg("%s", BAD[i]);
    char many[1024] = "{\"do\": \"a\"";
    for (int i = 0; i < JOX_COMMAND_MOST_KEYS; i++)
        snprintf(many + strlen(many), 32, ", \"k%d\": 1", i);
    strcat(many, "}");
    assert_false(jox_command_read(many, &command));
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(flat_json_commands_are_read)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
