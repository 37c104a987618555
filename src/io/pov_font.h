/* The outlines of letters from TrueType fonts, by FreeType where it was there at build. */
#ifndef IO_POV_FONT_H
#define IO_POV_FONT_H

#include "io/pov_outline.h"

/* Fill outlines[t->count] (opened, empty), one a letter, at their places along the line: one em is one unit, each pen step the letter's
 * advance, the kerning of the pair and the text's offset. The line starts where the first letter's ink does. Letters the font
 * lacks are its empty box. 0, or 1 and *why: no usable font,
 * or no FreeType. The z of the offset does nothing. */
int pov_font_outlines(const struct pov_text *t, struct pov_outline *outlines, const char **why);

#endif
