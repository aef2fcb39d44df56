/* The last answer of the WebAssembly module: the text that a call returns besides its number. */
#include "base/format/json_writer.h"
#include "base/guard.h"
#include "base/mem.h"
#include "wasm/module.h"

static const char OUT_OF_MEMORY[] = "{\"errors\": [{\"message\": \"out of memory\"}]}";
static const char *answer = "";
static char *owned; /* `answer`, if it is to be freed */

static void own_answer(char *text) {
    jo_free(owned);
    owned = text;
    answer = owned ? owned : "";
}

void jox_module_answer(JoxText *text) {
    own_answer(jox_disown(text->data));
    *text = (JoxText){0};
}

bool jox_module_answer_text(char *text) {
    own_answer(text);
    return text != NULL;
}

static void write_error(const JoError *error) {
    JOX_GUARD (NULL, NULL)
        return;
    JoxText text = {0};
    JoxJson json = jox_json_begin(&text, 0);
    jox_json_object(&json, NULL);
    jox_json_array(&json, "errors");
    jox_json_object(&json, NULL);
    jox_json_string(&json, "file", error->file);
    jox_json_integer(&json, "line", error->line);
    jox_json_integer(&json, "column", error->column);
    jox_json_string(&json, "severity", "error");
    jox_json_string(&json, "message", error->text);
    jox_json_end(&json);
    jox_json_end(&json);
    jox_json_end(&json);
    jox_module_answer(&text);
}

void jox_module_answer_error(const JoError *error) {
    own_answer(NULL);
    answer = OUT_OF_MEMORY; /* unless there is memory to say something else */
    write_error(error);
}

/* Returns the last answer; valid until the next call. */
JOX_MODULE_CALL const char *jostle_answer(void) {
    return answer;
}
