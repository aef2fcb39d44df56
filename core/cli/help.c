/* Formats the help of commands and the manual page from the rows of their options. */
#include <string.h>

#include "base/text.h"
#include "cli/cli.h"

enum { WIDTH = 80, HELP_COLUMN = 21 };

#define X(name) &cli_##name,
const CliCommand *const cli_commands[] = {CLI_COMMANDS(X)};
#undef X
const size_t cli_command_count = sizeof cli_commands / sizeof *cli_commands;

void cli_wrap_text(JoxText *out, const char *text, size_t length, int at, int indent) {
    const char *end = text + length;
    bool first = true;
    while (text < end) {
        size_t word = strcspn(text, " \n");
        word = word < (size_t)(end - text) ? word : (size_t)(end - text);
        if (!first && at + 1 + (int)word > WIDTH) {
            jox_text_printf(out, "\n%*s", indent, "");
            at = indent;
        } else if (!first) {
            jox_text_append(out, " ", 1);
            at++;
        }
        jox_text_append(out, text, word);
        at += (int)word;
        text += word + (text + word < end);
        first = false;
    }
    jox_text_append(out, "\n", 1);
}

/* Appends paragraphs, one a line, wrapped; those that begin with a blank stay as they are. */
static void add_paragraphs(JoxText *out, const char *text) {
    while (text && *text) {
        size_t n = strcspn(text, "\n");
        if (*text == ' ' || n == 0) {
            jox_text_append(out, text, n);
            jox_text_append(out, "\n", 1);
        } else {
            cli_wrap_text(out, text, n, 0, 0);
        }
        text += n + (text[n] == '\n');
    }
}

/* Appends "--seed N" or "--view[=PORT]". */
static void add_option_name(JoxText *out, const CliOption *o) {
    jox_text_printf(out, "--%s", o->name);
    if (o->argument)
        jox_text_printf(out, o->only_equals ? "[=%s]" : " %s", o->argument);
}

static void add_option_meaning(JoxText *out, const CliOption *o) {
    jox_text_add(out, o->help);
    if (o->standard)
        jox_text_printf(out, " (default: %s)", o->standard);
}

/* Appends an option and its meaning, in two columns. */
static void add_option(JoxText *out, const CliOption *o) {
    JoxText name = {0}, meaning = {0};
    if (o->kind == CLI_HEADING) {
        jox_text_printf(out, "\n%s\n", o->name);
        return;
    }
    if (!o->help)
        return;
    add_option_name(&name, o);
    add_option_meaning(&meaning, o);
    jox_text_printf(out, "  %-*s", HELP_COLUMN - 2, name.data);
    if (name.length + 2 >= HELP_COLUMN)
        jox_text_printf(out, "\n%*s", HELP_COLUMN, "");
    cli_wrap_text(out, meaning.data, meaning.length, HELP_COLUMN, HELP_COLUMN);
    jox_text_free(&name);
    jox_text_free(&meaning);
}

char *cli_format_help(const CliCommand *command) {
    JoxText out = {0};
    const char *line = command->usage;
    for (bool first = true; first || *line; first = false) {
        size_t n = strcspn(line, "\n");
        jox_text_printf(&out, "%s jostle %s %.*s\n", first ? "usage:" : "      ", command->name,
                        (int)n, line);
        line += n + (line[n] == '\n');
    }
    if (command->about) {
        jox_text_add(&out, "\n");
        add_paragraphs(&out, command->about);
    }
    if (command->option_count)
        jox_text_add(&out, "\n");
    for (size_t o = 0; o < command->option_count; o++)
        add_option(&out, &command->options[o]);
    if (command->notes) {
        jox_text_add(&out, "\n");
        add_paragraphs(&out, command->notes);
    }
    return out.data;
}

/* ---- the manual page ---- */

/* Appends text escaped for roff. */
static void add_roff(JoxText *out, const char *text, size_t length) {
    for (size_t i = 0; i < length; i++) {
        if (i == 0 && (text[i] == '.' || text[i] == '\''))
            jox_text_add(out, "\\&");
        if (text[i] == '\\')
            jox_text_add(out, "\\e");
        else if (text[i] == '-')
            jox_text_add(out, "\\-");
        else
            jox_text_append(out, text + i, 1);
    }
}

/* Appends paragraphs as roff; lines that begin with a blank are not filled. */
static void add_roff_paragraphs(JoxText *out, const char *text) {
    bool literal = false;
    while (text && *text) {
        size_t n = strcspn(text, "\n");
        bool as_is = *text == ' ';
        if (as_is != literal)
            jox_text_add(out, as_is ? ".nf\n" : ".fi\n");
        else if (!as_is && n)
            jox_text_add(out, ".PP\n");
        literal = as_is;
        add_roff(out, text, n);
        jox_text_add(out, n ? "\n" : "");
        text += n + (text[n] == '\n');
    }
    if (literal)
        jox_text_add(out, ".fi\n");
}

static void add_roff_option(JoxText *out, const CliOption *o) {
    JoxText text = {0};
    if (o->kind == CLI_HEADING) {
        jox_text_add(out, ".PP\n");
        add_roff(out, o->name, strlen(o->name));
        jox_text_add(out, "\n");
    } else if (o->help) {
        add_option_name(&text, o);
        jox_text_add(out, ".TP\n.B ");
        add_roff(out, text.data, text.length);
        jox_text_add(out, "\n");
        text.length = 0;
        add_option_meaning(&text, o);
        add_roff(out, text.data, text.length);
        jox_text_add(out, "\n");
    }
    jox_text_free(&text);
}

static void add_synopsis(JoxText *out, const CliCommand *command) {
    for (const char *line = command->usage; *line;) {
        size_t n = strcspn(line, "\n");
        jox_text_printf(out, ".B jostle %s\n", command->name);
        add_roff(out, line, n);
        jox_text_add(out, "\n.br\n");
        line += n + (line[n] == '\n');
    }
}

char *cli_format_manual(void) {
    JoxText out = {0};
    jox_text_printf(&out,
                    ".\\\" Made by `jostle reference manual`.\n"
                    ".TH JOSTLE 1 \"\" \"Jostle %s\" \"User Commands\"\n"
                    ".SH NAME\njostle \\- simulate dense crowds that push, with bodies and "
                    "behaviours in Lua\n.SH SYNOPSIS\n",
                    jo_version());
    for (size_t c = 0; c < cli_command_count; c++)
        add_synopsis(&out, cli_commands[c]);
    jox_text_add(&out,
                 ".SH DESCRIPTION\n"
                 "Jostle steps crowds of agents whose new velocities are small linear programs "
                 "over collision avoidance and physical forces, together with rigid bodies. "
                 "Scenes are YAML, behaviours are Lua.\n.SH OPTIONS\n"
                 ".TP\n.B \\-\\-help\nhelp, of the program or of a command\n"
                 ".TP\n.B \\-\\-version\nthe version\n");
    for (size_t c = 0; c < cli_command_count; c++) {
        const CliCommand *command = cli_commands[c];
        jox_text_printf(&out, ".SH JOSTLE %s\n", command->name);
        add_roff(&out, command->what, strlen(command->what));
        jox_text_add(&out, "\n");
        if (command->about) {
            jox_text_add(&out, ".PP\n");
            add_roff_paragraphs(&out, command->about);
        }
        for (size_t o = 0; o < command->option_count; o++)
            add_roff_option(&out, &command->options[o]);
        if (command->notes) {
            jox_text_add(&out, ".PP\n");
            add_roff_paragraphs(&out, command->notes);
        }
    }
    jox_text_add(&out, ".SH EXIT STATUS\n0 done, 1 the run failed, 2 wrong usage, 3 bad input.\n");
    return out.data;
}
