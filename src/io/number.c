#include "io/number.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void number_write(struct text *out, double x, int digits)
{
	char piece[40];
	int n = 0;
	if (digits >= 15 && fabs(x) < 1e15 && x == floor(x) && (x != 0 || !signbit(x))) {
		text_add(out, piece, (size_t)snprintf(piece, sizeof piece, "%.0f", x));
		return;
	}
	for (int tried = digits < 15 ? digits : 15; tried <= digits; tried++) {
		n = snprintf(piece, sizeof piece, "%.*g", tried, x);
		if (digits < 15 || strtod(piece, NULL) == x)
			break;
	}
	text_add(out, piece, (size_t)n);
}

void number_write_row(struct text *out, const char *before, const double *x, int n, const char *between, int digits)
{
	text_add(out, before, strlen(before));
	for (int i = 0; i < n; i++) {
		if (i)
			text_add(out, between, strlen(between));
		number_write(out, x[i], digits);
	}
}
