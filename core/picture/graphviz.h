/* Graphs through Graphviz: a text in its language becomes a picture. The program `dot` may be
   missing. jo_graph_draw (report/machine_graph.c) is the caller. */
#ifndef JOX_PICTURE_GRAPHVIZ_H
#define JOX_PICTURE_GRAPHVIZ_H

#include <stdbool.h>

#include "base/text.h"

/* Draws a graph into a file; `format` is one of Graphviz: "svg", "png" or "pdf". Kills a `dot` that
   says and ends nothing for a minute. False with a sentence in `error`; the file is then as it
   was. */
bool jox_graphviz_draw(const char *graph, const char *format, const char *path, JoxText *error);

#endif
