/* Chooses the claims that jo_reproduce runs, and loads them. */
#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "base/format/path.h"
#include "base/mem.h"
#include "base/sort.h"
#include "validate/reproduce.h"

/* Returns whether a claim is in a group: a standard's name for its tests, "paper" for claims
   whose id is a number, "real" for the others. */
static bool is_in_group(const JoxClaim *claim, const char *group) {
    if (jox_claim_is_standard(claim))
        return jox_claim_is_in_standard(claim, group);
    return strcmp(group, isdigit((unsigned char)*claim->id) ? "paper" : "real") == 0;
}

/* Returns whether a word of the caller names a claim itself: its id, file name or path. */
static bool is_named(const JoxClaim *claim, const char *asked) {
    const char *file = jox_path_name(claim->path);
    const size_t stem = jox_path_stem(file);
    return strcmp(asked, claim->id) == 0 || strcmp(asked, claim->also) == 0 ||
           strcmp(asked, claim->path) == 0 || (strncmp(asked, file, stem) == 0 && asked[stem] == 0);
}

/* Returns whether the def selects a claim, by name or group, or selects all. Sets found[c] of each
   word c that selects it. `named`: a word names the claim itself. */
static bool select_claim(const JoReproduceDef *def, const JoxClaim *claim, bool *found,
                         bool *named) {
    bool wanted = def->claim_count == 0 && (!def->standards || jox_claim_is_standard(claim));
    *named = false;
    for (size_t c = 0; c < def->claim_count; c++) {
        const bool by_name = is_named(claim, def->claims[c]);
        if (by_name || is_in_group(claim, def->claims[c]))
            wanted = found[c] = true;
        *named |= by_name;
    }
    return wanted;
}

/* Lists the paths of the Lua files in a folder, for the caller to free. */
static char **list_claim_files(const char *folder, size_t *count) {
    char **files = NULL;
    size_t capacity = 0;
    *count = 0;
    char **names = jox_folder_names(folder, false);
    for (char **name = names; name && *name; name++) {
        const char *dot = strrchr(*name, '.');
        if (!dot || strcmp(dot, ".lua") != 0)
            continue;
        JoxText path = {0};
        jox_text_printf(&path, "%s/%s", folder, *name);
        JOX_RESERVE(files, capacity, *count + 1);
        files[(*count)++] = path.data;
    }
    jox_free(names);
    return files;
}

/* Orders claims: the paper's by number first, then others by letter and number. */
static int compare_claim_ids(const void *left, const void *right, const void *context) {
    (void)context;
    const char *a = ((const JoxOutcome *)left)->claim->id;
    const char *b = ((const JoxOutcome *)right)->claim->id;
    if (isdigit((unsigned char)*a) != isdigit((unsigned char)*b))
        return isdigit((unsigned char)*a) ? -1 : 1;
    if (!isdigit((unsigned char)*a) && *a != *b)
        return *a < *b ? -1 : 1;
    char *a_rest, *b_rest;
    long x = strtol(isdigit((unsigned char)*a) ? a : a + 1, &a_rest, 10);
    long y = strtol(isdigit((unsigned char)*b) ? b : b + 1, &b_rest, 10);
    if (x == y && *a_rest == '.' && *b_rest == '.') { /* N2.9 before N2.10 */
        x = strtol(a_rest + 1, NULL, 10);
        y = strtol(b_rest + 1, NULL, 10);
    }
    return x != y ? (x < y ? -1 : 1) : strcmp(a, b);
}

/* Adds an error about an unknown claim, with the most similar id, file name or group as a hint. */
static void add_no_claim_error(const char *asked, char *const *files, size_t count,
                               const JoxText *ids, const char *folder,
                               JoxDiagnostics *diagnostics) {
    static const char *const GROUPS[] = {"paper", "real", "rimea",    "imo",
                                         "nist",  "iso",  "standards"};
    enum { GROUP_COUNT = sizeof GROUPS / sizeof *GROUPS };
    char hint[JOX_HINT];
    char **names = jox_alloc(2 * count + GROUP_COUNT, sizeof *names);
    size_t n = 0;
    for (size_t f = 0; f < count; f++) {
        const char *file = jox_path_name(files[f]);
        names[n++] = jox_strndup(file, jox_path_stem(file));
    }
    for (const char *id = ids->data; id && *id; id += strcspn(id, " ") + 1)
        if (n < 2 * count)
            names[n++] = jox_strndup(id, strcspn(id, " "));
    for (size_t g = 0; g < GROUP_COUNT; g++)
        names[n++] = jox_strdup(GROUPS[g]);
    const char *near = jox_did_you_mean(asked, (const char *const *)names, n, hint);
    jox_diag_error(diagnostics, ((JoxPosition){folder, 0, 0, 0}), "no-claim",
                   near ? near : "jostle reproduce --list names all", "there is no claim '%.100s'",
                   asked);
    for (size_t k = 0; k < n; k++)
        jox_free(names[k]);
    jox_free(names);
}

void jox_reproduce_load_claims(JoxReproduction *all, JoxDiagnostics *diagnostics) {
    JoxText ids = {0};
    size_t count, capacity = 0;
    char **files = list_claim_files(all->def->folder, &count);
    bool *found = jox_alloc(all->def->claim_count + 1, sizeof *found);
    for (size_t f = 0; f < count; f++) {
        JoxClaim *claim = jox_claim_load(files[f], all->def->quick, diagnostics);
        bool named;
        bool wanted = claim && select_claim(all->def, claim, found, &named);
        if (claim)
            jox_text_printf(&ids, "%s ", claim->id);
        if (wanted && all->def->quick && claim->too_long && !named) {
            jox_text_printf(&all->left_out, "%s%s", all->left_out.length ? ", " : "", claim->id);
            wanted = false;
        }
        if (wanted) {
            jox_claim_add_sets(claim, all->def->sets, all->def->set_count);
            JOX_RESERVE(all->outcomes, capacity, all->outcome_count + 1);
            all->outcomes[all->outcome_count++] = (JoxOutcome){.claim = claim};
        } else {
            jox_claim_free(claim);
        }
    }
    if (all->outcome_count)
        jox_sort(all->outcomes, all->outcome_count, sizeof *all->outcomes, compare_claim_ids, NULL,
                 NULL);
    for (uint32_t o = 1; o < all->outcome_count; o++)
        if (strcmp(all->outcomes[o].claim->id, all->outcomes[o - 1].claim->id) == 0)
            jox_diag_error(diagnostics, ((JoxPosition){all->outcomes[o].claim->path, 0, 0, 0}),
                           "same-claim", NULL, "%s has the id %s, too",
                           all->outcomes[o - 1].claim->path, all->outcomes[o].claim->id);
    for (uint32_t o = 0; o < all->outcome_count; o++)
        if (all->outcomes[o].claim->cut)
            jox_text_printf(&all->cut, "%s%s", all->cut.length ? ", " : "",
                            all->outcomes[o].claim->id);
    if (count == 0)
        jox_diag_error(diagnostics, ((JoxPosition){all->def->folder, 0, 0, 0}), "no-claims",
                       "Run it in the project's folder, or name one: --claims DIR",
                       "there are no claims in this folder");
    for (size_t c = 0; c < all->def->claim_count && diagnostics->errors == 0; c++)
        if (!found[c])
            add_no_claim_error(all->def->claims[c], files, count, &ids, all->def->folder,
                               diagnostics);
    for (size_t f = 0; f < count; f++)
        jox_free(files[f]);
    jox_free(files);
    jox_free(found);
    jox_text_free(&ids);
}
