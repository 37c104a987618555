#include "cost/fit.h"

#include <math.h>

struct exponential fit_exponential(const double *x, const double *y, size_t count)
{
	double n = 0, mean_x = 0, mean_y = 0, square = 0, cross = 0;
	for (size_t i = 0; i < count; i++)
		if (y[i] > 0) {
			n++;
			mean_x += x[i];
			mean_y += log(y[i]);
		}
	mean_x /= n;
	mean_y /= n;
	for (size_t i = 0; i < count; i++)
		if (y[i] > 0) {
			square += (x[i] - mean_x) * (x[i] - mean_x);
			cross += (x[i] - mean_x) * (log(y[i]) - mean_y);
		}
	double rate = square > 0 ? cross / square : NAN;
	return (struct exponential){ exp(mean_y - rate * mean_x), rate };
}

double fit_minimum(struct exponential falling, struct exponential rising)
{
	double b = -falling.rate, d = rising.rate;
	return b > 0 && d > 0 ? log(falling.factor * b / (rising.factor * d)) / (b + d) : NAN;
}
