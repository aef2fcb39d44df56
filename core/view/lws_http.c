/* Requests: who asks, for what, and the page's files. */
#include <stdio.h>
#include <string.h>

#include "view/access.h"
#include "view/lws_server.h"

enum { REFUSED = 403, NOT_FOUND = 404, NO_METHOD = 405, FULL = 503 };

/* Answers with a line of text. */
static int refuse(struct lws *wsi, int status, const char *text) {
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

/* A header's text; false where it is missing, too long or has been sent more than once. */
static bool header(struct lws *wsi, enum lws_token_indexes token, char *out, size_t size) {
    int n = lws_hdr_total_length(wsi, token);
    return n > 0 && (size_t)n < size && lws_hdr_copy(wsi, out, (int)size, token) == n;
}

/* Whether the request has the token in its query or, for a file, the pass in the page's cookie
   (*remembered). Browsers send cookies of 127.0.0.1 to whatever serves there, so that the cookie
   opens no socket. */
static bool has_token(const JoxView *view, struct lws *wsi, bool socket, bool *remembered) {
    char given[80], name[32], cookies[2048];
    *remembered = false;
    const char *asked = lws_get_urlarg_by_name(wsi, "token=", given, sizeof given);
    if (asked)
        return jox_access_same(asked, view->token);
    if (socket)
        return false;
    snprintf(name, sizeof name, "jostle_%d", view->port);
    *remembered = header(wsi, WSI_TOKEN_HTTP_COOKIE, cookies, sizeof cookies) &&
                  jox_access_cookie(cookies, name, given, sizeof given) &&
                  jox_access_same(given, view->pass);
    return *remembered;
}

/* Why a request is refused, or NULL. */
static const char *find_fault(const JoxView *view, struct lws *wsi, bool socket, char host[256],
                              bool *remembered) {
    if (!header(wsi, WSI_TOKEN_HOST, host, 256) || !jox_access_host_is_clean(host))
        return "This request does not say which host it asks.\n";
    if (!view->any_host && !jox_access_host(host, view->port))
        return "Jostle answers at 127.0.0.1 and localhost only; --view-address ADDRESS changes "
               "that.\n";
    if (!has_token(view, wsi, socket, remembered))
        return "This is a live page of Jostle. Open the whole address that 'jostle run --view' "
               "printed, with its token.\n";
    return NULL;
}

void jox_http_is_known(JoxView *view, const struct lws *wsi) {
    JoxTransport *t = view->transport;
    unsigned kept = 0;
    for (unsigned u = 0; u < t->unknown_count; u++)
        if (t->unknown[u] != wsi)
            t->unknown[kept++] = t->unknown[u];
    t->unknown_count = kept;
}

int jox_http_upgrade(JoxView *view, struct lws *wsi, const char *to) {
    char host[256], origin[256];
    bool remembered;
    if (strcasecmp(to, "websocket") != 0)
        return -1;
    const char *fault = find_fault(view, wsi, true, host, &remembered);
    if (!fault &&
        (!header(wsi, WSI_TOKEN_ORIGIN, origin, sizeof origin) || !jox_access_origin(origin, host)))
        fault = "This socket is for the page of the same address.\n";
    if (fault)
        return refuse(wsi, REFUSED, fault);
    jox_http_is_known(view, wsi);
    if (atomic_load(&view->clients) >= JOX_VIEW_CLIENTS)
        return refuse(wsi, FULL, "Too many pages are connected.\n");
    return 0;
}

/* Headers of a file, and the cookie by which the page's own files are asked for. */
static int more_headers(const JoxView *view, const char *host, bool cookie, char *out,
                        size_t size) {
    int n = snprintf(
        out, size,
        "content-security-policy: default-src 'none'; script-src 'self'; style-src 'self'; "
        "img-src 'self' data: blob:; font-src 'self'; connect-src 'self' ws://%s; "
        "base-uri 'none'; form-action 'none'; frame-ancestors 'none'\r\n"
        "x-content-type-options: nosniff\r\nreferrer-policy: no-referrer\r\n"
        "cross-origin-resource-policy: same-origin\r\ncross-origin-opener-policy: same-origin\r\n"
        "cache-control: no-store\r\n",
        host);
    if (cookie)
        n += snprintf(out + n, size - (size_t)n,
                      "set-cookie: jostle_%d=%s; Path=/; SameSite=Strict; HttpOnly\r\n", view->port,
                      view->pass);
    return n;
}

int jox_http_answer(JoxView *view, struct lws *wsi, const char *path) {
    char host[256], file[4096], headers[2048];
    bool remembered;
    int done;
    if (!lws_hdr_total_length(wsi, WSI_TOKEN_GET_URI)) {
        refuse(wsi, NO_METHOD, "Only GET is answered.\n");
        return -1; /* with whatever else it sends */
    }
    const char *fault = find_fault(view, wsi, false, host, &remembered);
    if (!fault)
        jox_http_is_known(view, wsi);
    const char *name = strcmp(path, "/") == 0 ? "/index.html" : path;
    bool three = strncmp(name, "/three/", 7) == 0;
    const char *type = jox_access_type(name);
    if (fault) {
        done = refuse(wsi, REFUSED, fault);
    } else if (!type ||
               !jox_access_file(three ? view->three : view->page, name + (three ? 6 : 0), file)) {
        done = refuse(wsi, NOT_FOUND, "There is no such file.\n");
    } else {
        int n = more_headers(view, host, !remembered, headers, sizeof headers);
        done = lws_serve_http_file(wsi, file, type, headers, n);
        if (done == 0) /* it is under way */
            return 0;
    }
    if (done < 0 || lws_http_transaction_completed(wsi))
        return -1;
    return 0;
}
