/* Functions of a scene, compiled to trees. */
#ifndef IO_POV_PROGRAM_H
#define IO_POV_PROGRAM_H

#include "io/pov_value.h"

enum { SLOTS_MOST = 72 }; /* parameters and the variables of sum and prod */

enum pov_node_kind {
	NODE_NUMBER,
	NODE_SLOT,     /* a parameter or variable */
	NODE_OPERATE,  /* word: an operator */
	NODE_SIGN,     /* word: '-' or '!' */
	NODE_CHOOSE,   /* condition ? yes : no */
	NODE_MATH,     /* word: a built-in function */
	NODE_CALL,     /* another function; slot: the component wanted of what gives vectors */
	NODE_SPLINE,   /* slot: the component */
	NODE_SUM, NODE_PRODUCT, /* over slot: from, to, term */
	NODE_UNKNOWN
};

/* Operands are 'first' and its nexts, in order. */
struct pov_node {
	enum pov_node_kind kind;
	uint32_t word;
	int slot, count;
	double number;
	const struct pov_program *program;
	const struct pov_spline_curve *spline;
	struct pov_node *first, *next;
};

/* root NULL: the function gives vectors: those of a spline, or points moved by a matrix, or internal is not 0: one of POV-Ray's own,
 * by number; none of them: unknown. weight: nodes that one call visits, about. unknown: its values are not known here. */
struct pov_program {
	int parameters;
	const struct pov_node *root;
	const struct pov_spline_curve *spline;
	const struct matrix *matrix;
	int internal;
	double weight;
	bool unknown;
};

/* The value for arguments[parameters]; component: of functions that give vectors. */
double program_value(const struct pov_program *f, const double *arguments, int component);

/* POV-Ray's internal functions by number: how many arguments it takes, 0: it is not known here; and its value. */
int internal_arguments(int number);
double internal_value(int number, const double *arguments);

#endif
