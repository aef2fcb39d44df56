/* Without libwebsockets there is no live page; it is said when one is asked for. */
#include "view/internal.h"

JoxView *jox_view_open(const JoxViewOptions *options, JoxText *why) {
    (void)options;
    jox_text_add(why, "this build has no live page: it was made without libwebsockets (VIEW=0)");
    return NULL;
}

void jox_view_close(JoxView *view) {
    (void)view; /* there is none */
}
