/* Pictures through gnuplot: a script and its data in a folder, and the PNG that comes of them. */
#ifndef JOX_PICTURE_PLOT_H
#define JOX_PICTURE_PLOT_H

#include <stdbool.h>
#include <stdio.h>

#include "base/text.h"
#include "geom/walls.h"
#include "record/regions.h"

/* Makes the folder, and those above it. False with a sentence in `error`. */
bool jox_plot_folder(const char *folder, JoxText *error);
/* regions.png: mean speed of each region as bars. */
bool jox_plot_regions(const char *folder, const JoxRegions *regions, const char *title,
                      JoxText *error);

/* For further pictures: files of the folder, and gnuplot on a script of it. Texts go into
   scripts by jox_quote_gnuplot, data into files. */
FILE *jox_plot_open(const char *folder, const char *name, JoxText *error);
bool jox_plot_close(FILE *file, const char *what, JoxText *error);
/* Without a shell, and without the user's own settings of gnuplot. A gnuplot that hangs is ended
   after some minutes; _within: once it has said nothing for so many seconds. */
bool jox_plot_draw(const char *folder, const char *script, JoxText *error);
bool jox_plot_draw_within(const char *folder, const char *script, int seconds, JoxText *error);
/* The terminal (PNG, or SVG on white) of so many pixels, its font, the colours of values, and the
   file STEM.png or STEM.svg that it writes. */
void jox_plot_begin(FILE *script, const char *stem, bool svg, int width, int height);
void jox_plot_title(FILE *script, const char *title);
/* STEM.ENDING as a quoted name of a file. */
void jox_plot_file(FILE *script, const char *stem, const char *ending);
/* Writes walls.dat, and what draws it behind another thing of a plot command: open walls dashed. */
bool jox_plot_walls(const char *folder, const JoxWalls *walls, JoxText *error);
void jox_plot_wall_lines(FILE *script, const JoxWalls *walls, const char *width);

#endif
