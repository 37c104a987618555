/* Plots drawn by gnuplot from a script and data that stay beside them, so that anyone can change them. */
#ifndef REPORT_PLOT_H
#define REPORT_PLOT_H

#include "io/text.h"

/* A plot being put together. The script refers to the data by the name 'NAME.dat' and sets no terminal and no output. */
struct plot {
	const char *name;
	struct text script, data;
};

/* Write FOLDER/plots/NAME.gp and NAME.dat and have gnuplot draw FOLDER/plots/NAME.svg. *drawn: false where there is no gnuplot; that
 * is no error. 0, or -1 and *e: disk, memory, gnuplot refuses the script. */
int plot_draw(const struct plot *p, const char *folder, bool *drawn, struct err *e);

void plot_free(struct plot *p);

#endif
