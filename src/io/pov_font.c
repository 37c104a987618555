#include "io/pov_font.h"

#ifdef HAVE_FREETYPE

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

enum { PIECES = 6 }; /* of a curve */

/* One letter while it is drawn. */
struct pen {
	struct pov_outline *outline;
	double x, y, scale;
	double at[2]; /* where the pen is, in font units */
};

static void add(struct pen *p, double x, double y)
{
	pov_outline_add(p->outline, p->x + p->scale * x, p->y + p->scale * y);
}

static void put(struct pen *p, const FT_Vector *to)
{
	p->at[0] = (double)to->x;
	p->at[1] = (double)to->y;
}

static int move_to(const FT_Vector *to, void *context)
{
	struct pen *p = context;
	if (p->outline->count)
		pov_outline_close(p->outline);
	put(p, to);
	add(p, p->at[0], p->at[1]);
	return 0;
}

static int line_to(const FT_Vector *to, void *context)
{
	struct pen *p = context;
	put(p, to);
	add(p, p->at[0], p->at[1]);
	return 0;
}

static int cubic_to(const FT_Vector *b, const FT_Vector *c, const FT_Vector *to, void *context)
{
	struct pen *p = context;
	for (int k = 1; k <= PIECES; k++) {
		double t = (double)k / PIECES, s = 1 - t, w[4] = { s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t };
		add(p, w[0] * p->at[0] + w[1] * (double)b->x + w[2] * (double)c->x + w[3] * (double)to->x,
		    w[0] * p->at[1] + w[1] * (double)b->y + w[2] * (double)c->y + w[3] * (double)to->y);
	}
	put(p, to);
	return 0;
}

static int conic_to(const FT_Vector *b, const FT_Vector *to, void *context)
{
	struct pen *p = context;
	for (int k = 1; k <= PIECES; k++) {
		double t = (double)k / PIECES, s = 1 - t, w[3] = { s * s, 2 * s * t, t * t };
		add(p, w[0] * p->at[0] + w[1] * (double)b->x + w[2] * (double)to->x,
		    w[0] * p->at[1] + w[1] * (double)b->y + w[2] * (double)to->y);
	}
	put(p, to);
	return 0;
}

/* Fonts of symbols have their letters in the private range. */
static FT_UInt find_glyph(FT_Face face, uint32_t code)
{
	FT_UInt glyph = FT_Get_Char_Index(face, code);
	return glyph ? glyph : FT_Get_Char_Index(face, 0xf000 + code);
}

static int draw_letters(FT_Face face, const struct pov_text *t, struct pov_outline *outlines)
{
	static const FT_Outline_Funcs pens = { move_to, line_to, conic_to, cubic_to, 0, 0 };
	struct pen pen = { .scale = 1.0 / face->units_per_EM };
	FT_UInt before = 0;
	for (size_t i = 0; i < t->count; i++) {
		FT_UInt glyph = find_glyph(face, t->codes[i]);
		FT_Vector kern = { 0, 0 };
		if (FT_Load_Glyph(face, glyph, FT_LOAD_NO_SCALE) != 0 || face->glyph->format != FT_GLYPH_FORMAT_OUTLINE)
			return 1;
		if (i && FT_HAS_KERNING(face) && FT_Get_Kerning(face, before, glyph, FT_KERNING_UNSCALED, &kern) == 0)
			pen.x += pen.scale * (double)kern.x;
		if (i == 0)
			pen.x = -pen.scale * (double)face->glyph->metrics.horiBearingX;
		pen.outline = &outlines[i];
		if (FT_Outline_Decompose(&face->glyph->outline, &pens, &pen) != 0)
			return 1;
		if (outlines[i].count)
			pov_outline_close(&outlines[i]);
		pen.x += pen.scale * (double)face->glyph->metrics.horiAdvance + t->offset.x;
		pen.y += t->offset.y;
		before = glyph;
	}
	return 0;
}

int pov_font_outlines(const struct pov_text *t, struct pov_outline *outlines, const char **why)
{
	FT_Library library;
	FT_Face face;
	*why = "text whose font cannot be read";
	if (!t->font || FT_Init_FreeType(&library) != 0)
		return 1;
	int status = 1;
	if (FT_New_Memory_Face(library, t->font, (FT_Long)t->font_size, 0, &face) == 0 && FT_IS_SCALABLE(face))
		status = draw_letters(face, t, outlines);
	FT_Done_FreeType(library); /* closes the face */
	return status;
}

#else

int pov_font_outlines(const struct pov_text *t, struct pov_outline *outlines, const char **why)
{
	(void)t;
	(void)outlines;
	*why = "text, without FreeType";
	return 1;
}

#endif
