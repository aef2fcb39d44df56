/* The section on the author's criteria, on the pages of reports: figure, limit, verdict, and how it
   was measured. */
#include "picture/html.h"
#include "report/page_parts.h"

void jox_page_say_criteria(const JoxVerdict *verdicts, uint32_t count, JoxText *out) {
    uint32_t met = 0;
    for (uint32_t k = 0; k < count; k++)
        met += verdicts[k].kind == JOX_VERDICT_MET;
    if (count)
        jox_text_printf(out, "%u of %u met in this run", met, count);
    for (uint32_t k = 0, told = 0; k < count; k++)
        if (verdicts[k].kind != JOX_VERDICT_MET)
            jox_text_printf(out, "%s%.60s: %s", told++ ? ", " : "; ", verdicts[k].criterion->name,
                            jox_verdict_names[verdicts[k].kind]);
}

void jox_page_put_criteria(FILE *out, const JoxSubject *s, const JoxVerdict *verdicts,
                           uint32_t count) {
    JoxPageTable table = jox_page_table(
        s, "criteria", "criterion|verdict|>figure|>at most|unit|how it was measured");
    if (count == 0)
        return;
    jox_html_heading(out, "Criteria");
    for (uint32_t k = 0; k < count; k++) {
        const JoxVerdict *v = &verdicts[k];
        char limit[32];
        snprintf(limit, sizeof limit, "%.6g", v->limit);
        jox_table_text(&table, v->criterion->name);
        jox_table_text(&table, jox_verdict_names[v->kind]);
        jox_table_number(&table, v->figure);
        jox_table_text(&table, limit);
        jox_table_unit(&table, v->unit);
        jox_table_text(&table, v->how);
    }
    jox_table_put(out, &table);
    if (s->simulated)
        jox_html_statement(
            out, "One run is one seed.",
            "Another seed gives other figures, and a figure near its limit may be met by chance: "
            "jostle run SCENE --seeds 20 --summary FILE gives the share of seeds that meet each "
            "criterion, as the mean of criteria.NAME.met. Limits and margins are the author's.");
}
