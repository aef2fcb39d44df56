/* The title block of reports: who made it, when, for whom, lines to sign; and names of files as
   pages show them, which tell nothing of the machine. */
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "base/format/path.h"
#include "picture/html.h"
#include "picture/html_sections.h"
#include "report/page_parts.h"

static char *choose_text(const char *asked, const char *given) {
    return (char *)(uintptr_t)(asked ? asked : given);
}

JoxSceneReport jox_page_head(const JoxSceneReport *given, const JoReportHead *asked) {
    const JoxSceneReport none = {0}, *scene = given ? given : &none;
    return (JoxSceneReport){.author = choose_text(asked->author, scene->author),
                            .organisation = choose_text(asked->organisation, scene->organisation),
                            .project = choose_text(asked->project, scene->project),
                            .reference = choose_text(asked->reference, scene->reference),
                            .checked_by = choose_text(asked->checked_by, scene->checked_by),
                            .approved_by = choose_text(asked->approved_by, scene->approved_by),
                            .date = choose_text(asked->date, scene->date),
                            .notes = scene->notes};
}

/* Writes the date given, else that of SOURCE_DATE_EPOCH, else today's, in UTC. */
static void write_report_date(const JoxSceneReport *given, char date[64]) {
    const char *epoch = getenv("SOURCE_DATE_EPOCH");
    const time_t now = epoch && *epoch ? (time_t)strtoll(epoch, NULL, 10) : time(NULL);
    struct tm day;
    if (given && given->date)
        snprintf(date, 64, "%s", given->date);
    else if (!gmtime_r(&now, &day) || !strftime(date, 64, "%Y-%m-%d", &day))
        snprintf(date, 64, "unknown");
}

void jox_page_begin(FILE *out, const JoxSubject *s, const JoxSceneReport *given, const char *about,
                    const char *foot) {
    char date[64];
    JoxText title = {0};
    jox_text_printf(&title, "%s", s->title);
    jox_html_begin_printed(out, &(JoxHtmlHead){.title = title.data,
                                               .about = about,
                                               .right = given ? given->organisation : NULL,
                                               .foot = foot});
    jox_text_free(&title);
    write_report_date(given, date);
    jox_html_facts(out);
    if (given) {
        jox_html_fact(out, "Project", given->project);
        jox_html_fact(out, "Reference", given->reference);
        jox_html_fact(out, "Author", given->author);
        jox_html_fact(out, "Organisation", given->organisation);
    }
    jox_html_fact(out, "Date of this report", date);
}

void jox_page_put_signatures(FILE *out, const JoxSceneReport *given) {
    const char *const rows[][2] = {{"Prepared by", given ? given->author : NULL},
                                   {"Checked by", given ? given->checked_by : NULL},
                                   {"Approved by", given ? given->approved_by : NULL}};
    fputs("<div class=sign>", out);
    jox_html_table(out, "|name|date|signature");
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
        jox_html_row(out);
        jox_html_cell(out, rows[r][0]);
        jox_html_cell(out, rows[r][1] ? rows[r][1] : "");
        jox_html_cell(out, "");
        jox_html_cell(out, "");
    }
    jox_html_table_end(out);
    fputs("</div>\n", out);
}

/* Returns the part of a path below a folder of this machine; NULL: it is not below. */
static const char *part_below(const char *path, const char *folder, size_t length) {
    return length && strncmp(path, folder, length) == 0 && path[length] == '/' ? path + length + 1
                                                                               : NULL;
}

const char *jox_page_path(const char *path, const char *scene, char out[JOX_LONGEST_PATH]) {
    static const char *const FOLDERS[] = {"/behaviours/", "/scripts/", "/scenes/", "/mods/"};
    char clean[JOX_LONGEST_PATH], here[JOX_LONGEST_PATH];
    const char *shown = NULL;
    snprintf(clean, sizeof clean, "%s", path);
    jox_path_clean(clean);
    if (*clean != '/')
        shown = clean;
    if (!shown && getcwd(here, sizeof here))
        shown = part_below(clean, here, strlen(here));
    if (!shown && scene && jox_path_folder(scene) > 1)
        shown = part_below(clean, scene, jox_path_folder(scene) - 1);
    for (size_t f = 0; !shown && f < sizeof FOLDERS / sizeof *FOLDERS; f++) {
        const char *at = strstr(clean, FOLDERS[f]);
        shown = at ? at + 1 : NULL;
    }
    snprintf(out, JOX_LONGEST_PATH, "%s", shown ? shown : jox_path_name(clean));
    return out;
}
