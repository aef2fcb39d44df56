/* Writing and reading JSON: one layout, escapes, limits on what is read. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "base/format/json.h"
#include "base/format/json_writer.h"

static void a_document_on_one_line(void **state) {
    (void)state;
    JoxText out = {0};
    JoxJson json = jox_json_begin(&out, 0);
    jox_json_object(&json, NULL);
    jox_json_string(&json, "a \"key\"", "b\n\xff");
    jox_json_string(&json, "none", NULL);
    jox_json_format(&json, "path", "%s/%d\"", "x", 7);
    jox_json_array(&json, "list");
    jox_json_number(&json, NULL, 0.1);
    jox_json_number(&json, NULL, NAN);
    jox_json_digits(&json, NULL, 1.0 / 3.0, 3);
    jox_json_whole(&json, NULL, UINT64_MAX);
    jox_json_integer(&json, NULL, -5);
    jox_json_bool(&json, NULL, true);
    jox_json_object(&json, NULL);
    jox_json_end(&json);
    jox_json_array(&json, NULL);
    jox_json_end(&json);
    jox_json_end(&json);
    jox_json_numbers_of(&json, "point", (double[]){1, -INFINITY}, 2, 7);
    jox_json_end(&json);
    assert_string_equal(out.data, "{\"a \\\"key\\\"\": \"b\\u000a\\ufffd\", \"none\": null, "
                                  "\"path\": \"x/7\\\"\", \"list\": [0.1, null, 0.333, "
                                  "18446744073709551615, -5, true, {}, []], \"point\": [1, null]}");
    jox_text_free(&out);
}

static void outer_levels_have_lines(void **state) {
    (void)state;
    JoxText out = {0};
    JoxJson json = jox_json_begin(&out, 2);
    jox_json_object(&json, NULL);
    jox_json_bool(&json, "a", false);
    jox_json_object(&json, "b");
    jox_json_null(&json, "c");
    jox_json_array(&json, "d");
    jox_json_whole(&json, NULL, 1);
    jox_json_whole(&json, NULL, 2);
    jox_json_end(&json);
    jox_json_end(&json);
    jox_json_array(&json, "e");
    jox_json_object(&json, NULL);
    jox_json_whole(&json, "f", 3);
    jox_json_end(&json);
    jox_json_end(&json);
    jox_json_object(&json, "empty");
    jox_json_end(&json);
    jox_json_end(&json);
    assert_string_equal(out.data, "{\n \"a\": false,\n \"b\": {\n  \"c\": null,\n  \"d\": [1, 2]\n "
                                  "},\n \"e\": [\n  {\"f\": 3}\n ],\n \"empty\": {}\n}");
    jox_text_free(&out);
}

static bool list_item(void *context, const JoxJsonItem *item) {
    JoxText *list = context;
    jox_text_printf(list, "%d%d:%s=", (int)item->kind, item->depth, item->path);
    if (item->text)
        jox_text_printf(list, "%s;", item->text);
    else
        jox_text_printf(list, "%g;", item->number);
    return strcmp(item->path, "stop") != 0;
}

static const JoxJsonLimits LIMITS = {.length = 100, .items = 8, .depth = 3};

static void written_documents_are_read_back(void **state) {
    (void)state;
    JoxText list = {0};
    assert_true(jox_json_read("{\"a\": [1, true, null], \"b\": {\"c\": \"\\u00fc\\\"\"}}", LIMITS,
                              list_item, &list));
    assert_string_equal(list.data, "51:a=0;22:a.0=1;12:a.1=1;02:a.2=0;41:b=0;32:b.c=\xc3\xbc\";");
    jox_text_free(&list);
    assert_false(jox_json_read("{\"stop\": 1, \"b\": 2}", LIMITS, list_item, &list));
    assert_string_equal(list.data, "21:stop=1;"); /* the visitor ended the reading */
    jox_text_free(&list);
}

static void hostile_documents_are_refused_unread(void **state) {
    (void)state;
    char longer[120] = "{\"a\": \"", deep[] = "{\"a\": [[[[1]]]]}";
    memset(longer + 7, 'x', 100);
    strcpy(longer + 107, "\"}");
    const char *const BAD[] = {longer,
                               deep,
                               "{\"a\": [1,1,1,1,1,1,1,1,1]}",
                               "",
                               "7",
                               "[1]",
                               "{\"a\": 1e999}",
                               "{\"a\": NaN}",
                               "{\"a\": 0x1}",
                               "{\"a\": 1} x",
                               "{\"a\": \"\\u0000\"}",
                               "{\"\\u0000\": 1}",
                               "{\"a\": \"\x01\"}",
                               "{\"a\": \"\xe0\x80\x80\"}",
                               "{\"a\": \"\xf4\x90\x80\x80\"}",
                               "{\"a\": \"\\ud800\"}",
                               "{\"a\": \"",
                               "{\"a\": \"\\",
                               "{\"a\": [1}"};
    JoxText list = {0};
    for (size_t b = 0; b < sizeof BAD / sizeof *BAD; b++)
        if (jox_json_read(BAD[b], LIMITS, list_item, &list) || list.length)
            fail_msg("read: %s", BAD[b]);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_document_on_one_line),
                                       cmocka_unit_test(outer_levels_have_lines),
                                       cmocka_unit_test(written_documents_are_read_back),
                                       cmocka_unit_test(hostile_documents_are_refused_unread)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
