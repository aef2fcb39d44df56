/* Rows of the table of keys (key_table.c, with its macros) on what a report states: who made it,
   and the criteria that a run is held against. */
#ifndef JOX_SCENE_REPORT_KEY_ROWS_H
#define JOX_SCENE_REPORT_KEY_ROWS_H

/* clang-format off */
#define JOX_REPORT_KEY_ROWS                                                                          \
    {"report", "author", TEXT, "", 0, 0, "", TO(JoxSceneReport, author), .meaning = "who prepared it"}, \
    {"report", "organisation", TEXT, "", 0, 0, "", TO(JoxSceneReport, organisation), .meaning = "the author's organisation; at the top of each printed page"}, \
    {"report", "project", TEXT, "", 0, 0, "", TO(JoxSceneReport, project), .meaning = "project or client"}, \
    {"report", "reference", TEXT, "", 0, 0, "", TO(JoxSceneReport, reference), .meaning = "number of the document and its revision"}, \
    {"report", "checked_by", TEXT, "", 0, 0, "", TO(JoxSceneReport, checked_by), .meaning = "who checks it"}, \
    {"report", "approved_by", TEXT, "", 0, 0, "", TO(JoxSceneReport, approved_by), .meaning = "who approves it"}, \
    {"report", "date", TEXT, "", 0, 0, "", TO(JoxSceneReport, date), .meaning = "date of the report, as it is to be printed; else that of the environment's SOURCE_DATE_EPOCH, else today, in UTC"}, \
    {"report", "notes", TEXT, "", 0, 0, "", TO(JoxSceneReport, notes), .meaning = "assumptions and sources of the inputs, for the section on inputs"},
/* clang-format on */

/* A group's or a profile's source. */
#define JOX_BASIS_KEY_ROW                                                                          \
    {"group",                                                                                      \
     "basis",                                                                                      \
     TEXT,                                                                                         \
     "",                                                                                           \
     0,                                                                                            \
     0,                                                                                            \
     "",                                                                                           \
     TO(JoxGroup, basis),                                                                          \
     .example = "basis: count of 12 May 2025",                                                     \
     .meaning = "where its numbers come from (a count, a standard, an assumption), for reports"},

#endif
