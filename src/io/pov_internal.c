/* Functions that POV-Ray calls internal, as far as their formulas are published with it. */
#include "io/pov_program.h"

bool internal_known(int number)
{
	(void)number;
	return false;
}

double internal_value(int number, const double *arguments)
{
	(void)number;
	(void)arguments;
	return 0;
}
