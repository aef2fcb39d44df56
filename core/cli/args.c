#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/cli.h"

const char *cli_next(CliArgs *args, const char **plain) {
    static char name[64];
    *plain = NULL;
    args->value = NULL;
    if (args->next >= args->argc)
        return NULL;
    char *word = args->argv[args->next++];
    if (word[0] != '-' || word[1] == 0) {
        *plain = word;
        return NULL;
    }
    word += word[1] == '-' ? 2 : 1;
    char *equals = strchr(word, '=');
    args->value = equals ? equals + 1 : NULL;
    snprintf(name, sizeof name, "%.*s", equals ? (int)(equals - word) : 63, word);
    return name;
}

const char *cli_value(CliArgs *args, const char *option) {
    if (args->value)
        return args->value;
    if (args->next < args->argc)
        return args->argv[args->next++];
    fprintf(stderr, "jostle %s: --%s needs a value\n", args->command, option);
    args->failed = true;
    return NULL;
}

double cli_number(CliArgs *args, const char *option, double least, double greatest) {
    const char *text = cli_value(args, option);
    if (!text)
        return least;
    char *end;
    double value = strtod(text, &end);
    if (end == text || *end || !(value >= least && value <= greatest)) {
        fprintf(stderr, "jostle %s: --%s takes a number from %g to %g, not '%s'\n", args->command,
                option, least, greatest, text);
        args->failed = true;
        return least;
    }
    return value;
}

uint64_t cli_whole(CliArgs *args, const char *option, uint64_t least, uint64_t greatest) {
    const char *text = cli_value(args, option);
    if (!text)
        return least;
    char *end;
    errno = 0;
    unsigned long long value = strtoull(text, &end, 10);
    if (end == text || *end || *text == '-' || errno || value < least || value > greatest) {
        fprintf(stderr, "jostle %s: --%s takes a whole number from %llu to %llu, not '%s'\n",
                args->command, option, (unsigned long long)least, (unsigned long long)greatest,
                text);
        args->failed = true;
        return least;
    }
    return value;
}

double cli_unit(CliArgs *args, const char *option) {
    const char *unit = cli_value(args, option);
    if (unit && strcmp(unit, "m") != 0 && strcmp(unit, "cm") != 0) {
        fprintf(stderr, "jostle %s: --%s is m or cm, not '%s'\n", args->command, option, unit);
        args->failed = true;
    }
    return unit && !strcmp(unit, "cm") ? 0.01 : 1.0;
}

int cli_write(const char *command, const char *path, const char *text) {
    if (!strcmp(path, "-")) {
        fputs(text, stdout);
        return JO_OK;
    }
    FILE *file = fopen(path, "w");
    bool good = file && fputs(text, file) >= 0;
    if (file && fclose(file) != 0)
        good = false;
    if (!good)
        fprintf(stderr, "jostle %s: cannot write '%s'\n", command, path);
    return good ? JO_OK : JO_FAILED;
}

int cli_unknown(CliArgs *args, const char *option, const char *const *known) {
    fprintf(stderr, "jostle %s: unknown option --%s", args->command, option);
    for (const char *const *k = known; *k; k++) {
        size_t shared = 0;
        while (option[shared] && option[shared] == (*k)[shared])
            shared++;
        if (shared >= 3 || (shared >= 2 && strlen(*k) <= 4)) {
            fprintf(stderr, ". Did you mean --%s?", *k);
            break;
        }
    }
    fprintf(stderr, "\nTry 'jostle %s --help'.\n", args->command);
    return JO_USAGE;
}
