/* Reads the files of a script within the limits. The loader calls it for the script itself,
   `require` and mods for further files. */
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "base/assert.h"
#include "base/file.h"
#include "base/hash.h"
#include "base/mem.h"
#include "base/overlay.h"
#include "lua/vm/vm.h"

/* Returns whether a quoted string has an escape for a zero byte; its place is in *offset. */
static bool has_zero_escape(const JoxToken *t, uint32_t *offset) {
    for (uint32_t k = 0; k + 1 < t->length; k++) {
        if (t->text[k] != '\\')
            continue;
        const char *escape = t->text + k + 1;
        const size_t left = t->length - k - 1;
        size_t digits = 0;
        *offset = k++;
        if (*escape == '0') {
            while (digits < left && digits < 3 && escape[digits] == '0')
                digits++;
            if (digits == 3 || digits == left || escape[digits] < '0' || escape[digits] > '9')
                return true;
        } else if (*escape == 'x' && left >= 3 && escape[1] == '0' && escape[2] == '0') {
            return true;
        } else if (*escape == 'u' && left >= 3 && escape[1] == '{') {
            for (digits = 2; digits < left && escape[digits] == '0';)
                digits++;
            if (digits > 2 && digits < left && escape[digits] == '}')
                return true;
        }
    }
    return false;
}

/* Refuses strings with a zero byte, at which C would cut them. No string of a behaviour has one, as
   string.char and string.format make none. */
static bool refuse_zeros(const JoxSource *source, JoxDiagnostics *diagnostics) {
    uint32_t offset;
    for (size_t i = 0; i < source->token_count; i++) {
        const JoxToken *t = &source->tokens[i];
        const bool quoted = t->kind == JOX_TOKEN_STRING && strchr("\"'", t->text[-1]);
        if (!quoted || !has_zero_escape(t, &offset))
            continue;
        jox_diag_error(
            diagnostics,
            jox_position_in(source->path, source->text, (size_t)(t->text - source->text) + offset),
            "bad-text", "Take the escape out", "a text has no zero byte");
        return true;
    }
    return false;
}

/* Refuses a file that names _ENV: assigning it would redefine every other name. */
static bool refuse_env(const JoxSource *source, JoxDiagnostics *diagnostics) {
    for (size_t i = 0; i < source->token_count; i++) {
        const JoxToken *t = &source->tokens[i];
        if (t->kind != JOX_TOKEN_NAME || !jox_token_is(t, "_ENV"))
            continue;
        jox_diag_error(diagnostics,
                       ((JoxPosition){source->path, t->line, t->column, t->end_column}),
                       "unknown-word", "Words and locals are all that a behaviour can use",
                       "'_ENV' cannot be used");
        return true;
    }
    return false;
}

JoxSource *jox_vm_read(JoxVm *vm, const char *path, const char *given, size_t length,
                       JoxPosition from, JoxDiagnostics *diagnostics) {
    const size_t limit = vm->group->limits.source;
    char large[64], unread[JOX_UNREAD];
    const char *wrong = NULL;
    snprintf(large, sizeof large, "the file is over %zu KB", limit >> 10);
    struct stat info;
    char *text = NULL;
    bool disk = !given && !jox_overlay_file(path);
    if (given) {
        text = jox_strndup(given, length);
    } else if (disk && lstat(path, &info) == 0 && S_ISLNK(info.st_mode)) {
        wrong = "symbolic links are not followed";
    } else if (!(text = jox_read_file(path, limit, &length))) {
        wrong = errno == EFBIG ? large : jox_unread_text(path, errno, unread);
    }
    if (text && length > limit)
        wrong = large;
    else if (text && length > 0 && text[0] == '\x1b')
        wrong = "this is compiled Lua; only source is loaded";
    if (wrong) {
        jox_free(text);
        jox_diag_error(diagnostics, from.file ? from : ((JoxPosition){path, 0, 0, 0}),
                       "unreadable-file", NULL, "cannot load '%s': %s", path, wrong);
        return NULL;
    }
    if (!jox_diag_check_text(diagnostics, path, text, length)) {
        jox_free(text);
        return NULL;
    }
    memset(text, ' ', jox_byte_order_mark_length(text, length));
    JOX_RESERVE(vm->files, vm->file_capacity, vm->file_count + 1);
    JoxLuaFile *file = &vm->files[vm->file_count++];
    file->path = jox_strdup(path);
    jox_sha256_hex(given ? given : text, length, file->sha256);
    JOX_RESERVE(vm->sources, vm->source_capacity, vm->source_count + 1);
    JoxSource *source = vm->sources[vm->source_count++] = jox_alloc(1, sizeof *source);
    JOX_ASSERT(vm->source_count == vm->file_count);
    *source = (JoxSource){.path = jox_strdup(path), .text = text, .length = length};
    jox_source_scan(source);
    return refuse_env(source, diagnostics) || refuse_zeros(source, diagnostics) ? NULL : source;
}

void jox_vm_note_path(JoxVm *vm, const char *path) {
    for (uint32_t i = 0; i < vm->tried_count; i++)
        if (strcmp(vm->tried[i], path) == 0)
            return;
    JOX_RESERVE(vm->tried, vm->tried_capacity, vm->tried_count + 1);
    vm->tried[vm->tried_count++] = jox_strdup(path);
}
