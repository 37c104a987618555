/* Exponential fits of cost curves (Subramanian and Fussell 1990, section 6). */
#ifndef COST_FIT_H
#define COST_FIT_H

#include <stddef.h>

/* y = factor * exp(rate * x) */
struct exponential {
	double factor, rate;
};

/* The exponential that fits count points best in the logarithm, by least squares. Points with y <= 0 are left out; fewer than two
 * different x: NAN. */
struct exponential fit_exponential(const double *x, const double *y, size_t count);

/* Where falling + rising is least: ln(a b / (c d)) / (b + d) for a e^(-b x) + c e^(d x); NAN where it has no minimum. */
double fit_minimum(struct exponential falling, struct exponential rising);

#endif
