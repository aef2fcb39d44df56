/* Parses lines as the arguments of a command, which are read or refused with a sentence. */
#include <stdlib.h>
#include <string.h>

#include "cli/cli.h"
#include "support/fuzz.h"

enum {
    MOST = 64,
    ROOM = 1 << 14
}; /* arguments; bytes, more than the options of any command take */

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static char options[ROOM];
    char *text = fuzz_text(data, size), *argv[MOST + 1];
    int argc = 0;
    for (char *line = text; line && argc < MOST;) {
        char *end = strchr(line, '\n');
        if (end)
            *end = 0;
        argv[argc++] = line;
        line = end ? end + 1 : NULL;
    }
    argv[argc] = NULL;
    for (size_t c = 0; c < cli_command_count; c++) {
        const CliCommand *command = cli_commands[c];
        if (strcmp(command->name, argv[0]) != 0)
            continue;
        CliList plain = {0};
        memset(options, 0, sizeof options);
        const int status = cli_parse(command, argc, argv, options, &plain);
        FUZZ_CHECK(status == CLI_GO_ON || status == JO_OK || status == JO_USAGE);
        FUZZ_CHECK(status != CLI_GO_ON || plain.count >= command->least);
        FUZZ_CHECK(!command->most || plain.count <= command->most);
        cli_free(command, options, &plain);
    }
    free(text);
    return 0;
}
