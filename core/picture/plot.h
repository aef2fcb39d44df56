/* Pictures through gnuplot: a script and its data in a folder, and the PNG that comes of them. */
#ifndef JOX_PICTURE_PLOT_H
#define JOX_PICTURE_PLOT_H

#include <stdbool.h>
#include <stdio.h>

#include "base/text.h"
#include "geom/walls.h"
#include "record/density.h"
#include "record/regions.h"

/* Makes the folder, and those above it. False with a sentence in `error`. */
bool jox_plot_folder(const char *folder, JoxText *error);
/* density.png: mean density over the frames, walls drawn, the greatest value of `peak` named. */
bool jox_plot_density(const char *folder, const JoxDensity *density, const JoxDensity *peak,
                      const JoxWalls *walls, const char *title, JoxText *error);
/* regions.png: mean speed of each region as bars. */
bool jox_plot_regions(const char *folder, const JoxRegions *regions, const char *title,
                      JoxText *error);

/* For further pictures: files of the folder, and gnuplot on a script of it. */
FILE *jox_plot_open(const char *folder, const char *name, JoxText *error);
bool jox_plot_close(FILE *file, const char *what, JoxText *error);
bool jox_plot_draw(const char *folder, const char *script, JoxText *error);
/* The text in quotes, without what gnuplot would take for more than text. */
void jox_plot_quote(FILE *script, const char *text);
void jox_plot_title(FILE *script, const char *title);
/* Writes walls.dat, and what draws it behind another thing of a plot command: open walls dashed. */
bool jox_plot_walls(const char *folder, const JoxWalls *walls, JoxText *error);
void jox_plot_wall_lines(FILE *script, const JoxWalls *walls, const char *width);

#endif
