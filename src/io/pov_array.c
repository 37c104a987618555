/* Arrays. */
#include "io/pov_reader.h"

struct pov_value *pov_element(struct pov *p, struct pov_array *a)
{
	size_t index = 0;
	bool relations = p->relations, blanks = p->blanks;
	p->relations = true;
	p->blanks = false;
	for (int k = 0; k < a->dimensions; k++) {
		pov_expect(p, '[');
		double x = pov_float(p);
		pov_expect(p, ']');
		if (pov_stopped(p))
			break;
		if (!(x > -1 && x < (double)a->size[k])) {
			pov_refuse(p, "subscript %g is not within an array of %zu", x, a->size[k]);
			break;
		}
		index = index * a->size[k] + (size_t)trunc(x);
	}
	p->relations = relations;
	p->blanks = blanks;
	return pov_stopped(p) ? NULL : &a->all[index];
}

/* Values of dimension k from index on; returns behind the last possible one. */
static void read_list(struct pov *p, struct pov_array *a, int k, size_t index)
{
	size_t step = 1, n = 0;
	for (int i = k + 1; i < a->dimensions; i++)
		step *= a->size[i];
	pov_expect(p, '{');
	while (!pov_stopped(p) && pov_peek(p)->kind != '}') {
		if (n == a->size[k]) {
			pov_refuse(p, "more than %zu values for an array", a->size[k]);
			return;
		}
		/* An element may be left out between commas. */
		if (pov_peek(p)->kind != ',') {
			if (k + 1 < a->dimensions && k + 1 < DIMENSIONS_MOST)
				read_list(p, a, k + 1, index + n * step);
			else
				a->all[index + n] = pov_value_read(p);
		}
		n++;
		pov_accept(p, ',');
	}
	pov_expect(p, '}');
}

/* An array without sizes takes them from its values; lists within it are arrays of their own. */
static struct pov_value read_unsized(struct pov *p)
{
	struct pov_value *all = NULL;
	size_t n = 0, room = 0;
	if (!pov_enter(p) || !pov_expect(p, '{'))
		return value_number(0);
	while (!pov_stopped(p) && pov_peek(p)->kind != '}') {
		if ((all = pov_grow(p, all, n, &room, sizeof *all)) == NULL)
			return value_number(0);
		all[n] = pov_peek(p)->kind == '{' ? read_unsized(p) : pov_value_read(p);
		n++;
		pov_accept(p, ',');
	}
	pov_expect(p, '}');
	p->nested--;
	struct pov_array *a = pov_alloc(p, 1, sizeof *a);
	if (a)
		*a = (struct pov_array){ .dimensions = 1, .size = { n }, .count = n, .all = all };
	return a ? (struct pov_value){ .type = TYPE_ARRAY, .array = a } : value_number(0);
}

struct pov_value pov_array_read(struct pov *p)
{
	size_t size[DIMENSIONS_MOST];
	int dimensions = 0;
	double count = 1;
	bool relations = p->relations;
	pov_accept_word(p, WORD_mixed);
	p->relations = true;
	while (!pov_stopped(p) && pov_accept(p, '[')) {
		if (dimensions == DIMENSIONS_MOST) {
			pov_refuse(p, "more than %d dimensions", DIMENSIONS_MOST);
			return value_number(0);
		}
		size[dimensions] = (size_t)pov_integer(p, "the size of an array", 1, 4e9);
		count *= (double)size[dimensions++];
		pov_expect(p, ']');
	}
	p->relations = relations;
	if (pov_stopped(p))
		return value_number(0);
	if (dimensions == 0)
		return read_unsized(p);
	if (count * sizeof(struct pov_value) + (double)p->mem.held > (double)p->options->budget.bytes) {
		pov_stop(p, STATUS_INPUT, "an array of %.0f elements exceeds the budget of %zu bytes", count, p->options->budget.bytes);
		return value_number(0);
	}
	struct pov_array *a = array_new(&p->mem, dimensions, size, (size_t)count);
	if (!a) {
		pov_stop(p, STATUS_ENVIRONMENT, "out of memory");
		return value_number(0);
	}
	if (pov_peek_operator(p)->kind == '{')
		read_list(p, a, 0, 0);
	return (struct pov_value){ .type = TYPE_ARRAY, .array = a };
}
