#include "fuzz.h"

#include <stdlib.h>

#include "live/page.h"

JoxView *fuzz_server(void) {
    static JoxLivePage page;
    if (!page.server) {
        const JoxViewOptions options = {.page = "build/page"};
        JoError error = {0};
        if (!jox_live_page_open(&page, &options, &error))
            abort();
    }
    return page.server;
}
