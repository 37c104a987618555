/* A number known but for the sampling error of what it was found from. */
#ifndef BASE_ESTIMATE_H
#define BASE_ESTIMATE_H

/* low .. high: 95 % interval. NAN: not known. */
struct estimate {
	double mean, low, high;
};

#endif
