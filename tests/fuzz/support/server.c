#include "fuzz.h"

#include <stdlib.h>

#include "live/page.h"

JoxView *fuzz_server(void) {
    static JoxLivePage page;
    if (!page.server) {
        JoError error = {0};
        if (!jox_live_page_open(&page, NULL, 0, "build/page", NULL, &error))
            abort();
    }
    return page.server;
}
