/* Replaces the server in builds without libwebsockets (VIEW=0): opening it fails with the
   reason. */
#include "view/view_threads.h"

JoxView *jox_view_open(const JoxViewOptions *options, JoxText *why) {
    (void)options;
    jox_text_add(why, "this build has no live page: it was made without libwebsockets (VIEW=0)");
    return NULL;
}

void jox_view_close(JoxView *view) {
    (void)view;
}
