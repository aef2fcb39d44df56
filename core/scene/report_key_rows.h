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

/* Criteria. */
#define JOX_CRITERION_ROW(kind, name, unit, greatest, example_, meaning_)                          \
    {"criterion",                                                                                  \
     #name,                                                                                        \
     NUMBER,                                                                                       \
     unit,                                                                                         \
     0,                                                                                            \
     greatest,                                                                                     \
     "",                                                                                           \
     TO(JoxCriterion, limits[JOX_CRITERION_##kind]),                                               \
     SELECTS(JOX_CRITERION_##kind),                                                                \
     .example = example_,                                                                          \
     .meaning = meaning_},
#define JOX_CRITERION_KEY_ROWS                                                                     \
    JOX_CRITERION_KINDS(JOX_CRITERION_ROW){                                                        \
        "criterion",                                                                               \
        "margin",                                                                                  \
        NUMBER,                                                                                    \
        "",                                                                                        \
        1,                                                                                         \
        100,                                                                                       \
        "1",                                                                                       \
        TO(JoxCriterion, margin),                                                                  \
        .meaning = "of cleared: factor on the time required, for what a model does not know"},     \
        {"criterion",                                                                              \
         "at",                                                                                     \
         TEXT,                                                                                     \
         "",                                                                                       \
         0,                                                                                        \
         0,                                                                                        \
         "",                                                                                       \
         READ_TO(jox_key_read_place, JoxCriterion, place, place),                                  \
         .meaning = "of density: place in which it holds; everywhere without"},                    \
        {"criterion",                                                                              \
         "lasting",                                                                                \
         NUMBER,                                                                                   \
         "s",                                                                                      \
         0,                                                                                        \
         1e6,                                                                                      \
         "0",                                                                                      \
         TO(JoxCriterion, lasting),                                                                \
         .meaning = "of density: it may be exceeded for so long in all"},                          \
        {"criterion",                                                                              \
         "of",                                                                                     \
         TEXT,                                                                                     \
         "",                                                                                       \
         0,                                                                                        \
         0,                                                                                        \
         "",                                                                                       \
         READ(jox_key_read_criterion_probe),                                                       \
         .meaning = "of flow and waiting: name of the probe that measures it"},

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
