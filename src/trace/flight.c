#include "trace/flight.h"

#include <stdlib.h>
#include <string.h>

/* Three numbers; returns what follows them, or NULL. */
static const char *read_point(const char *text, struct vec *p)
{
	for (int i = 0; i < 3; i++) {
		text += strspn(text, " \t\n");
		size_t length = strspn(text, "0123456789+-.eE");
		char *end;
		p->a[i] = strtod(text, &end);
		if (length == 0 || end != text + length || !isfinite(p->a[i]))
			return NULL;
		text = end;
	}
	return text + strspn(text, " \t\n");
}

int flight_parse(struct flight *f, const char *text, struct err *e)
{
	*f = (struct flight){ 0 };
	for (const char *at = text; at && *at; f->count++) {
		if (f->count == FLIGHT_PLACES)
			return err_at(e, STATUS_INPUT, NULL, 0, "flight: more than %d places", FLIGHT_PLACES);
		at = read_point(at + (f->count > 0), &f->from[f->count]);
		if (at && strncmp(at, "to", 2) == 0)
			at = read_point(at + 2, &f->at[f->count]);
		else
			at = NULL;
		if (!at || (*at && *at != ','))
			return err_at(e, STATUS_INPUT, NULL, 0, "flight: place %d is not of the form 'x y z to x y z', with commas between places",
			              f->count + 1);
		if (vec_length(vec_sub(f->at[f->count], f->from[f->count])) == 0)
			return err_at(e, STATUS_INPUT, NULL, 0, "flight: place %d looks at itself", f->count + 1);
	}
	return 0;
}

/* Between points[i] and the next, u from 0 to 1. */
static struct vec interpolate(const struct vec *points, int count, int i, double u)
{
	const struct vec a = points[i > 0 ? i - 1 : 0], b = points[i], c = points[i + 1], d = points[i + 2 < count ? i + 2 : count - 1];
	struct vec p;
	for (int k = 0; k < 3; k++) {
		double in = (c.a[k] - a.a[k]) / 2, out = (d.a[k] - b.a[k]) / 2, step = c.a[k] - b.a[k];
		p.a[k] = b.a[k] + u * (in + u * (3 * step - 2 * in - out + u * (in + out - 2 * step)));
	}
	return p;
}

void flight_place(const struct flight *f, double t, struct view *v)
{
	double along = t * (f->count - 1);
	int i = (int)along;
	v->given = true;
	v->window = false;
	if (i + 1 >= f->count) {
		v->from = f->from[f->count - 1];
		v->at = f->at[f->count - 1];
		return;
	}
	v->from = interpolate(f->from, f->count, i, along - i);
	v->at = interpolate(f->at, f->count, i, along - i);
}
