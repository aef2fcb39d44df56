/* Parses a command's arguments by the rows of its options; also messages and exit statuses that
   commands share. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "cli/cli.h"

/* The arguments of one call, and the next one to be read. */
typedef struct Reading {
    const CliCommand *command;
    int argc, next;
    char **argv;
    char *options; /* the struct that CLI_TO refers to */
} Reading;

int cli_report_misuse(const CliCommand *command, const char *why) {
    fprintf(stderr, "jostle %s: %s\nTry 'jostle %s --help'.\n", command->name, why, command->name);
    return JO_USAGE;
}

int cli_report_unknown(const CliCommand *command, const char *what, const char *given,
                       const char *const *names, size_t count) {
    char why[400], hint[JOX_HINT];
    const char *near = jox_did_you_mean(given, names, count, hint);
    JoxText all = {0};
    for (size_t n = 0; n < count && !near; n++)
        jox_text_printf(&all, "%s%s", n ? ", " : "; there are ", names[n]);
    snprintf(why, sizeof why, "there is no %s '%.60s'%s%.260s", what, given, near ? ". " : "",
             near       ? near
             : all.data ? all.data
                        : "");
    jox_text_free(&all);
    return cli_report_misuse(command, why);
}

static int refuse_option(const CliCommand *command, const CliOption *option, const char *why) {
    char text[320];
    snprintf(text, sizeof text, "--%s %s", option->name, why);
    return cli_report_misuse(command, text);
}

/* Appends a text to a list, allocated on first use for `room` texts; JO_FAILED with a message if
   memory is out. */
static int append_text(const CliCommand *command, CliList *list, int room, const char *text) {
    if (!list->items)
        list->items = calloc((size_t)room, sizeof *list->items);
    if (!list->items) {
        fprintf(stderr, "jostle %s: out of memory\n", command->name);
        return JO_FAILED;
    }
    list->items[list->count++] = text;
    return CLI_GO_ON;
}

static const CliOption *find_option(const CliCommand *command, const char *name) {
    for (size_t o = 0; o < command->option_count; o++)
        if (command->options[o].kind != CLI_HEADING && !strcmp(command->options[o].name, name))
            return &command->options[o];
    return NULL;
}

static int refuse_unknown_option(const CliCommand *command, const char *name) {
    const char *names[64];
    char text[200];
    size_t count = 0;
    for (size_t o = 0; o < command->option_count && count < 63; o++)
        if (command->options[o].kind != CLI_HEADING)
            names[count++] = command->options[o].name;
    names[count++] = "help";
    const char *near = jox_suggest(name, names, count);
    snprintf(text, sizeof text, "unknown option --%.60s%s%s%s", name,
             near ? ". Did you mean --" : "", near ? near : "", near ? "?" : "");
    return cli_report_misuse(command, text);
}

static int read_double(const Reading *r, const CliOption *o, const char *text) {
    char *end, why[200];
    const bool any = o->least >= o->greatest;
    const double value = strtod(text, &end);
    if (end != text && !*end && isfinite(value) &&
        (any || (value >= o->least && value <= o->greatest))) {
        memcpy(r->options + o->at, &value, sizeof value);
        return CLI_GO_ON;
    }
    if (any)
        snprintf(why, sizeof why, "takes a number, not '%.60s'", text);
    else
        snprintf(why, sizeof why, "takes a number from %g to %g, not '%.60s'", o->least,
                 o->greatest, text);
    return refuse_option(r->command, o, why);
}

static int read_whole_number(const Reading *r, const CliOption *o, const char *text) {
    char *end, why[200];
    const bool any = o->least >= o->greatest;
    const uint64_t least = any ? 0 : (uint64_t)o->least;
    const uint64_t most = !any                 ? (uint64_t)o->greatest
                          : o->kind == CLI_U64 ? UINT64_MAX
                          : o->kind == CLI_U32 ? UINT32_MAX
                                               : INT32_MAX;
    errno = 0;
    const unsigned long long value = strtoull(text, &end, 10);
    if (end == text || *end || strchr(text, '-') || errno || value < least || value > most) {
        snprintf(why, sizeof why, "takes a whole number from %llu to %llu, not '%.60s'",
                 (unsigned long long)least, (unsigned long long)most, text);
        return refuse_option(r->command, o, why);
    }
    const uint64_t wide = value;
    /* An int has the same bits, as its allowed values are not negative. */
    const uint32_t narrow = (uint32_t)value;
    if (o->kind == CLI_U64)
        memcpy(r->options + o->at, &wide, sizeof wide);
    else
        memcpy(r->options + o->at, &narrow, sizeof narrow);
    return CLI_GO_ON;
}

/* Stores the value of an option by its kind; CLI_GO_ON, or JO_USAGE with a message. */
static int store_value(const Reading *r, const CliOption *o, const char *text) {
    char why[200];
    bool yes = true;
    switch (o->kind) {
    case CLI_FLAG:
        memcpy(r->options + o->at, &yes, sizeof yes);
        return CLI_GO_ON;
    case CLI_TEXT:
        if (!*text)
            return refuse_option(r->command, o, "needs a value, not ''");
        if (o->writes && !cli_ending_fits(o, text, why))
            return refuse_option(r->command, o, why);
        memcpy(r->options + o->at, &text, sizeof text);
        return CLI_GO_ON;
    case CLI_LIST:
        return append_text(r->command, (CliList *)(void *)(r->options + o->at), r->argc, text);
    case CLI_DOUBLE:
        return read_double(r, o, text);
    case CLI_READ:
        return o->read(r->options, text, why) ? CLI_GO_ON : refuse_option(r->command, o, why);
    default:
        return read_whole_number(r, o, text);
    }
}

/* Reads one option, `word` without dashes, and the value that follows it. */
static int read_option(Reading *r, const char *word) {
    char name[64];
    const bool yes = true;
    const char *equals = strchr(word, '=');
    const char *value = equals ? equals + 1 : NULL;
    snprintf(name, sizeof name, "%.*s", equals ? (int)(equals - word) : 63, word);
    if (!strcmp(name, "help") || !strcmp(name, "h")) {
        char *help = cli_format_help(r->command);
        fputs(help ? help : "", stdout);
        jo_free(help);
        return JO_OK;
    }
    const CliOption *o = find_option(r->command, name);
    if (!o)
        return refuse_unknown_option(r->command, name);
    if (!o->argument && value)
        return refuse_option(r->command, o, "takes no value");
    if (o->argument && !o->only_equals && !value && r->next < r->argc)
        value = r->argv[r->next++];
    if (o->argument && !o->only_equals && !value)
        return refuse_option(r->command, o, "needs a value");
    if (o->given)
        memcpy(r->options + o->given - 1, &yes, sizeof yes);
    return value || !o->argument ? store_value(r, o, value) : CLI_GO_ON;
}

/* Adds a plain argument, if the command takes another one. */
static int read_plain_argument(const Reading *r, CliList *plain, const char *text) {
    char why[200];
    const CliCommand *command = r->command;
    if (command->takes && (command->most == 0 || plain->count < command->most))
        return append_text(command, plain, r->argc, text);
    if (command->takes && command->most == 1)
        snprintf(why, sizeof why, "one %s at a time; what is '%.60s'?", command->takes, text);
    else
        snprintf(why, sizeof why, "what is '%.60s'?", text);
    return cli_report_misuse(command, why);
}

int cli_parse(const CliCommand *command, int argc, char **argv, void *options, CliList *plain) {
    Reading r = {.command = command, .argc = argc, .next = 1, .argv = argv, .options = options};
    int status = CLI_GO_ON;
    while (status == CLI_GO_ON && r.next < argc) {
        const char *word = argv[r.next++];
        if (word[0] == '-' && word[1])
            status = read_option(&r, word + (word[1] == '-' ? 2 : 1));
        else
            status = read_plain_argument(&r, plain, word);
    }
    if (status == CLI_GO_ON && plain->count < command->least) {
        char why[200];
        snprintf(why, sizeof why, "no %s given", command->takes);
        status = cli_report_misuse(command, command->none_said ? command->none_said : why);
    }
    return status;
}

void cli_free(const CliCommand *command, void *options, CliList *plain) {
    for (size_t o = 0; o < command->option_count; o++)
        if (command->options[o].kind == CLI_LIST) {
            CliList *list = (CliList *)(void *)((char *)options + command->options[o].at);
            free(list->items);
            *list = (CliList){0};
        }
    free(plain->items);
    *plain = (CliList){0};
    cli_scenes_free();
}

bool cli_read_unit(double *metres, const char *text, char why[160]) {
    bool known = !strcmp(text, "m") || !strcmp(text, "cm");
    *metres = !strcmp(text, "cm") ? 0.01 : 1.0;
    if (!known)
        snprintf(why, 160, "is m or cm, not '%.60s'", text);
    return known;
}

bool cli_read_isa(JoIsa *isa, const char *text, char why[160]) {
    JoError error;
    bool known = jo_isa_find(text, isa, &error);
    if (!known)
        snprintf(why, 160, "is refused: %.140s", error.text);
    return known;
}

int cli_finish_run(const CliCommand *command, JoScene *scene, bool ok, JoError *error,
                   CliRunFiles *files) {
    JoError ending = {0};
    /* Finished also after an error, so that what was recorded is kept. */
    const bool ended = jo_scene_finish(scene, &ending);
    if (!ended)
        files->data = NULL;
    if (ok && !ended)
        *error = ending;
    return ok && ended ? JO_OK : cli_report_error(command, error, false);
}

bool cli_print_troubles(const CliCommand *command, const JoScene *scene) {
    JoTroubles *troubles = jo_scene_troubles(scene);
    const bool any = troubles && troubles->count > 0;
    for (uint32_t t = 0; any && t < troubles->count; t++)
        fprintf(stderr, "jostle %s: %s\n", command->name, troubles->items[t].text);
    jo_free(troubles);
    return any;
}

void cli_print(void *context, const char *text) {
    fputs(text, context);
    if (context == stdout)
        cli_flush(); /* main reports a failure */
    else
        fflush(context);
}

int cli_report_error(const CliCommand *command, const JoError *error, bool sent) {
    if (!sent)
        fprintf(stderr, "jostle %s: %s\n", command->name, error->text);
    return error->code ? (int)error->code : JO_FAILED;
}
