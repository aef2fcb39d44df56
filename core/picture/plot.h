/* Plots through gnuplot: a script and its data in a folder, and the PNG or SVG that gnuplot
   makes of them. Used by probes' files, reports, claims, comparisons and timings. Texts go into
   scripts by jox_quote_gnuplot. All functions that return false or NULL leave a sentence in
   `error`. */
#ifndef JOX_PICTURE_PLOT_H
#define JOX_PICTURE_PLOT_H

#include <stdbool.h>
#include <stdio.h>
#include <sys/types.h>

#include "base/text.h"
#include "geom/walls.h"
#include "record/regions.h"

/* Creates a folder and the folders above it. */
bool jox_plot_folder(const char *folder, JoxText *error);
/* Writes regions.csv and draws regions.png: the mean speed of each region as bars, m/s. There is no
   picture if nobody was seen in a region. */
bool jox_plot_regions(const char *folder, const JoxRegions *regions, const char *title,
                      JoxText *error);

/* Open a file of the folder for writing, and close it. The file replaces an older one of its
   name only when it is closed. */
FILE *jox_plot_open(const char *folder, const char *name, JoxText *error);
bool jox_plot_close(FILE *file, const char *what, JoxText *error);
/* Run gnuplot on a script inside the folder, without a shell and without the user's gnuplot
   settings. A gnuplot that has written nothing for `seconds` (300 for the first) is killed. */
bool jox_plot_draw(const char *folder, const char *script, JoxText *error);
bool jox_plot_draw_within(const char *folder, const char *script, int seconds, JoxText *error);
/* Reads a child's output until it ends and keeps the last `size` - 1 characters in `last`, as
   gnuplot states the reason last. Kills a child that writes nothing for so many seconds. */
void jox_plot_read_last_output(int pipe, pid_t child, int seconds, char *last, size_t size);
/* Writes a script's beginning: the terminal (PNG, or SVG on white), its size in pixels and font,
   the colour palette of values, and the output file STEM.png or STEM.svg. */
void jox_plot_begin(FILE *script, const char *stem, bool svg, int width, int height);
/* Writes the command that sets a plot's title. */
void jox_plot_title(FILE *script, const char *title);
/* Writes STEM.ENDING as a quoted file name. */
void jox_plot_file(FILE *script, const char *stem, const char *ending);
/* Write walls.dat, where the panels of storeys are (NULL: as positions), and the elements that draw
   it at the end of a plot command; open gates are dashed. */
struct JoxPanels;
bool jox_plot_walls(const char *folder, const JoxWalls *walls, const struct JoxPanels *panels,
                    JoxText *error);
void jox_plot_wall_lines(FILE *script, const JoxWalls *walls, const char *width);

#endif
