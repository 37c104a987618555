#include "io/pov_program.h"

#include "io/pov_reader.h"

#include <string.h>

enum { ROUNDS_MOST = 1000000 };

static double evaluate(const struct pov_node *n, double *slots);

static double repeat(const struct pov_node *n, double *slots)
{
	double from = evaluate(n->first, slots), to = evaluate(n->first->next, slots), sum = n->kind == NODE_PRODUCT;
	const struct pov_node *term = n->first->next->next;
	for (long i = 0; i < ROUNDS_MOST && from + (double)i <= to + 1e-10; i++) {
		slots[n->slot] = from + (double)i;
		double x = evaluate(term, slots);
		sum = n->kind == NODE_PRODUCT ? sum * x : sum + x;
	}
	return sum;
}

/* A function of numbers or of the scene. */
static double call(const struct pov_node *n, double *slots)
{
	double a[SLOTS_MOST], r = 0;
	int i = 0;
	for (const struct pov_node *c = n->first; c; c = c->next)
		a[i++] = evaluate(c, slots);
	if (n->kind == NODE_CALL)
		return program_value(n->program, a, n->slot);
	pov_math(n->word, a, i, &r);
	return r;
}

/* The operators that most functions are made of stand here for speed. */
static double operate(uint32_t op, double a, double b)
{
	switch (op) {
	case '+': return a + b;
	case '-': return a - b;
	case '*': return a * b;
	default: return number_operate(op, a, b);
	}
}

static double evaluate(const struct pov_node *n, double *slots)
{
	switch (n->kind) {
	case NODE_NUMBER: return n->number;
	case NODE_SLOT: return slots[n->slot];
	case NODE_OPERATE: return operate(n->word, evaluate(n->first, slots), evaluate(n->first->next, slots));
	case NODE_SIGN: return n->word == '-' ? -evaluate(n->first, slots) : fabs(evaluate(n->first, slots)) < 1e-10;
	case NODE_CHOOSE: return evaluate(value_true(evaluate(n->first, slots)) ? n->first->next : n->first->next->next, slots);
	case NODE_SUM: case NODE_PRODUCT: return repeat(n, slots);
	case NODE_SPLINE: {
		struct pov_value v = pov_spline_value(n->spline, evaluate(n->first, slots), n->word);
		return value_component(&v, n->slot);
	}
	case NODE_UNKNOWN: return 0.5;
	case NODE_MATH: case NODE_CALL: break;
	}
	return call(n, slots);
}

double program_value(const struct pov_program *f, const double *arguments, int component)
{
	if (f->root) {
		double slots[SLOTS_MOST];
		slots[2] = 0; /* z of a function of u and v */
		memcpy(slots, arguments, (size_t)f->parameters * sizeof *slots);
		return evaluate(f->root, slots);
	}
	if (f->spline) {
		struct pov_value v = pov_spline_value(f->spline, arguments[0], 0);
		return value_component(&v, component);
	}
	if (f->matrix && component < 3)
		return matrix_point(vec(arguments[0], arguments[1], arguments[2]), f->matrix).a[component];
	return f->unknown ? 0.5 : internal_value(f->internal, arguments);
}
