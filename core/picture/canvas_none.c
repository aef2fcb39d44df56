/* Stubs that replace canvas_cairo.c in a build without cairo: pictures can then be SVG only. */
#include <stddef.h>

#include "picture/canvas.h"

JoxCanvas *jox_canvas_image(uint32_t width, uint32_t height) {
    (void)width;
    (void)height;
    return NULL;
}

const uint8_t *jox_canvas_pixels(JoxCanvas *canvas) {
    (void)canvas;
    return NULL;
}

bool jox_canvas_has_images(void) {
    return false;
}
