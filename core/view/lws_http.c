/* Checks HTTP requests and answers them with the page's files, or with the reason of a refusal. */
#include <stdio.h>
#include <string.h>

#include "view/access.h"
#include "view/lws_server.h"

enum { REFUSED = 403, NOT_FOUND = 404, NO_METHOD = 405, FULL = 503 };

/* Answers with a status and a line of text; returns what libwebsockets expects. */
static int answer_text(struct lws *wsi, int status, const char *text) {
    unsigned char block[LWS_PRE + 1024], *begin = block + LWS_PRE, *p = begin;
    unsigned char *end = block + sizeof block;
    static const char MORE[] = "x-content-type-options: nosniff\r\ncache-control: no-store\r\n";
    size_t length = strlen(text);
    if (lws_add_http_common_headers(wsi, (unsigned)status, "text/plain; charset=utf-8", length, &p,
                                    end))
        return -1;
    memcpy(p, MORE, sizeof MORE - 1);
    p += sizeof MORE - 1;
    if (lws_finalize_write_http_header(wsi, begin, &p, end))
        return -1;
    memcpy(begin, text, length);
    return lws_write(wsi, begin, length, LWS_WRITE_HTTP_FINAL) < (int)length ? -1 : 1;
}

/* Copies the text of a header; false if it is missing, too long or sent more than once. */
static bool copy_header(struct lws *wsi, enum lws_token_indexes token, char *out, size_t size) {
    int n = lws_hdr_total_length(wsi, token);
    return n > 0 && (size_t)n < size && lws_hdr_copy(wsi, out, (int)size, token) == n;
}

/* Returns whether the request has the token in its query or, for a file (a socket has path NULL),
   in its path (*path then becomes what is behind it) or the pass in the page's cookie
   (*remembered). The cookie opens no socket, because browsers send cookies of 127.0.0.1 to any
   server on that host. A page for frames knows neither query nor cookie for its files. */
static bool has_token(const JoxView *view, struct lws *wsi, const char **path, bool *remembered) {
    char given[80], name[32], cookies[2048];
    const bool socket = !path;
    *remembered = false;
    if (!socket && *view->frame) {
        const char *rest = jox_access_skip_token(*path, view->token);
        *path = rest ? rest : *path;
        return rest;
    }
    const char *asked = lws_get_urlarg_by_name(wsi, "token=", given, sizeof given);
    if (asked)
        return jox_access_is_token(asked, view->token);
    if (socket)
        return false;
    snprintf(name, sizeof name, "jostle_%d", view->port);
    *remembered = copy_header(wsi, WSI_TOKEN_HTTP_COOKIE, cookies, sizeof cookies) &&
                  jox_access_find_cookie(cookies, name, given, sizeof given) &&
                  jox_access_is_token(given, view->pass);
    return *remembered;
}

/* Returns why a request is refused, or NULL. `path`: as of has_token. */
static const char *find_fault(const JoxView *view, struct lws *wsi, const char **path,
                              char host[256], bool *remembered) {
    if (!copy_header(wsi, WSI_TOKEN_HOST, host, 256) || !jox_access_host_is_clean(host))
        return "This request does not say which host it asks.\n";
    if (!view->any_host && !jox_access_is_local_host(host, view->port))
        return "Jostle answers at 127.0.0.1 and localhost only; --view-address ADDRESS changes "
               "that.\n";
    if (!has_token(view, wsi, path, remembered))
        return "This is a live page of Jostle. Open the whole address that 'jostle run --view' or "
               "your program gave, with its token.\n";
    return NULL;
}

void jox_http_drop_from_unknown(JoxView *view, const struct lws *wsi) {
    JoxTransport *t = view->transport;
    unsigned kept = 0;
    for (unsigned u = 0; u < t->unknown_count; u++)
        if (t->unknown[u] != wsi)
            t->unknown[kept++] = t->unknown[u];
    t->unknown_count = kept;
}

int jox_http_check_upgrade(JoxView *view, struct lws *wsi, const char *to) {
    char host[256], origin[256];
    bool remembered;
    if (strcasecmp(to, "websocket") != 0)
        return -1;
    const char *fault = find_fault(view, wsi, NULL, host, &remembered);
    if (!fault && (!copy_header(wsi, WSI_TOKEN_ORIGIN, origin, sizeof origin) ||
                   !jox_access_is_same_origin(origin, host)))
        fault = "This socket is for the page of the same address.\n";
    if (fault)
        return answer_text(wsi, REFUSED, fault);
    jox_http_drop_from_unknown(view, wsi);
    if (atomic_load(&view->clients) >= JOX_VIEW_CLIENTS)
        return answer_text(wsi, FULL, "Too many pages are connected.\n");
    return 0;
}

/* Formats the headers of a file and, if `cookie`, the cookie that opens the page's other files. A
   page for frames has no cookie: its files are opened by the token in their paths alone, so that
   nothing that a browser sends by itself lets a foreign page show them. */
static int format_headers(const JoxView *view, const char *host, bool cookie, char *out,
                          size_t size) {
    int n = snprintf(
        out, size,
        "content-security-policy: default-src 'none'; script-src 'self'; style-src 'self'; "
        "img-src 'self' data: blob:; font-src 'self'; connect-src 'self' ws://%s; "
        "base-uri 'none'; form-action 'none'; frame-ancestors %s\r\n"
        "x-content-type-options: nosniff\r\nreferrer-policy: no-referrer\r\n"
        "cross-origin-resource-policy: same-origin\r\ncross-origin-opener-policy: same-origin\r\n"
        "cache-control: no-store\r\n",
        host, *view->frame ? view->frame : "'none'");
    if (cookie && !*view->frame)
        n += snprintf(out + n, size - (size_t)n,
                      "set-cookie: jostle_%d=%s; Path=/; SameSite=Strict; HttpOnly\r\n", view->port,
                      view->pass);
    return n;
}

int jox_http_serve_file(JoxView *view, struct lws *wsi, const char *path) {
    char host[256], file[4096], headers[2048];
    bool remembered;
    int done;
    if (!lws_hdr_total_length(wsi, WSI_TOKEN_GET_URI)) {
        answer_text(wsi, NO_METHOD, "Only GET is answered.\n");
        return -1; /* closes the connection, and ignores a body */
    }
    const char *fault = find_fault(view, wsi, &path, host, &remembered);
    if (!fault)
        jox_http_drop_from_unknown(view, wsi);
    const char *name = strcmp(path, "/") == 0 ? "/index.html" : path;
    const char *type = jox_access_content_type(name);
    if (fault) {
        done = answer_text(wsi, REFUSED, fault);
    } else if (!type || !jox_access_find_file(view->page, name, file)) {
        done = answer_text(wsi, NOT_FOUND, "There is no such file.\n");
    } else {
        int n = format_headers(view, host, !remembered, headers, sizeof headers);
        done = lws_serve_http_file(wsi, file, type, headers, n);
        if (done == 0) /* libwebsockets is still sending it */
            return 0;
    }
    if (done < 0 || lws_http_transaction_completed(wsi))
        return -1;
    return 0;
}
